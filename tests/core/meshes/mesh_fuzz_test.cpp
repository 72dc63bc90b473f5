// Whatever happens to a file, reading it gives a sound mesh or an IoError; anything else - another exception, a crash,
// a hang, a body with a hole in its indices - is a bug. Mutations of small valid files of every format reach deeper
// than random bytes: most of each file stays what the reader expects. The generator is std::mt19937_64, which the
// standard pins, and no distribution of the library is used, so a seed means the same file everywhere.
//
// The macro DARTBOARD_FUZZ_ROUNDS multiplies the work, for a run under the sanitizers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "tests/support/meshes/binary_mesh_samples.h"
#include "tests/support/meshes/mesh_samples.h"
#include "tests/support/meshes/meshb_samples.h"
#include "tests/support/meshes/vtk_polygon_samples.h"
#include "tests/support/meshes/writer_samples.h"

#ifndef DARTBOARD_FUZZ_ROUNDS
#define DARTBOARD_FUZZ_ROUNDS 1
#endif

namespace dartboard::mesh_fuzz_test {
namespace {

using namespace samples;

constexpr std::size_t mutations_per_sample = 1500 * DARTBOARD_FUZZ_ROUNDS;

struct Sample {
  std::string text;
  MeshFormat format;
};

std::vector<Sample> all_samples() {
  std::vector<Sample> all{{std::string(medit), MeshFormat::medit},
                          {tetgen(), MeshFormat::tetgen},
                          {std::string(gmsh1), MeshFormat::gmsh},
                          {std::string(gmsh2), MeshFormat::gmsh},
                          {std::string(gmsh4), MeshFormat::gmsh},
                          {gmsh2_binary(false), MeshFormat::gmsh},
                          {gmsh2_binary(true), MeshFormat::gmsh},
                          {gmsh41_binary(), MeshFormat::gmsh},
                          {std::string(vtk4), MeshFormat::vtk_legacy},
                          {std::string(vtk5), MeshFormat::vtk_legacy},
                          {vtk_binary(), MeshFormat::vtk_legacy},
                          {vtk_binary_offsets(), MeshFormat::vtk_legacy},
                          {std::string(vtu_ascii), MeshFormat::vtu},
                          {std::string(vtu_base64), MeshFormat::vtu},
                          {std::string(vtu_base64_wide), MeshFormat::vtu},
                          {stl_binary(), MeshFormat::stl},
                          {std::string(stl_text), MeshFormat::stl},
                          {std::string(obj), MeshFormat::obj},
                          {std::string(ply_text), MeshFormat::ply},
                          {ply_binary(false), MeshFormat::ply},
                          {ply_binary(true), MeshFormat::ply},
                          {std::string(off), MeshFormat::off},
                          {off_binary(), MeshFormat::off},
                          {off_binary("OFF"), MeshFormat::off},
                          {std::string(vtk_polygons), MeshFormat::vtk_legacy},
                          {vtk_polygons_binary(false), MeshFormat::vtk_legacy},
                          {vtk_polygons_binary(true), MeshFormat::vtk_legacy},
                          {std::string(medit_of_mmg), MeshFormat::medit},
                          {std::string(medit_of_bamg), MeshFormat::medit},
                          {std::string(gmsh2_of_groups), MeshFormat::gmsh},
                          {std::string(vtk_of_freefem), MeshFormat::vtk_legacy},
                          {std::string(vtk_in_small_letters), MeshFormat::vtk_legacy},
                          {std::string(off_of_one_line), MeshFormat::off},
                          {std::string(stl_in_capitals), MeshFormat::stl},
                          {std::string(obj_in_the_plane), MeshFormat::obj},
                          {std::string(off_in_the_plane), MeshFormat::off},
                          {std::string(ply_in_the_plane), MeshFormat::ply},
                          {std::string(medit_in_small_letters), MeshFormat::medit},
                          {std::string(vtu_with_ghosts), MeshFormat::vtk_legacy}};
  for (const int version : {1, 2, 3, 4}) all.push_back({meshb(version, version == 3), MeshFormat::medit});
  for (const auto& [encoding, compressor] : {std::pair{"raw", ""}, {"raw", "ZLib"}, {"base64", "LZ4"}})
    for (const bool wide : {false, true})
      all.push_back({vtu({.encoding = encoding, .compressor = compressor, .wide = wide}), MeshFormat::vtu});
  return all;
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string mutate(std::string text) {
    for (std::size_t times = 1 + below(3); times > 0; --times) mutate_once(text);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

  void mutate_once(std::string& text) {
    const std::size_t at = below(text.size()), length = below(std::min<std::size_t>(text.size() - at, 40) + 1);
    switch (below(8)) {
      case 0: flip_bit(text, at); break;
      case 1: text.erase(at, length); break;
      case 2: text.insert(at, text.substr(at, length)); break;
      case 3: text.insert(at, text.substr(below(text.size() + 1), length)); break;
      case 4: text.resize(at); break;
      case 5: text.replace(at, below(8), extreme_bytes()); break;
      default: replace_number(text, at); break;
    }
  }

  /// Four or eight bytes of a number that is very large, or small, or negative.
  std::string extreme_bytes() {
    std::string bytes(below(2) == 0 ? 4 : 8, below(2) == 0 ? '\0' : '\xff');
    if (below(2) == 0) bytes.front() = static_cast<char>(below(256));
    if (below(2) == 0) bytes.back() = static_cast<char>(below(128));
    return bytes;
  }

  void flip_bit(std::string& text, std::size_t at) {
    if (text.empty()) return;
    text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << below(8)));
  }

  void replace_number(std::string& text, std::size_t from) {
    static const char* const extremes[] = {"0",
                                           "-1",
                                           "1",
                                           "2",
                                           "3",
                                           "4",
                                           "5",
                                           "7",
                                           "11",
                                           "12",
                                           "13",
                                           "42",
                                           "255",
                                           "4294967295",
                                           "4294967296",
                                           "-2147483648",
                                           "9223372036854775807",
                                           "9223372036854775808",
                                           "-9223372036854775808",
                                           "6148914691236517206",
                                           "1e999",
                                           "1D0",
                                           "1.0D-999",
                                           "-1e999",
                                           "1e-999",
                                           "1e300",
                                           "-1e300",
                                           "1e150",
                                           "1e-150",
                                           "5e-324",
                                           "nan",
                                           "-nan",
                                           "inf",
                                           "0x10",
                                           "+1",
                                           "1.5",
                                           "1e",
                                           "--1",
                                           ".",
                                           "99999999999999999999999999"};
    const std::size_t begin = text.find_first_of("0123456789", from);
    if (begin == text.npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789.eE+-", begin), text.size());
    text.replace(begin, end - begin, extremes[below(std::size(extremes))]);
  }

  std::mt19937_64 random_;
};

/// The fault of a mesh, in words of its own: nothing here is shared with the check of the readers.
std::string flaw(const Mesh& mesh) {
  if (mesh.cell_count() == 0) return "no cells";
  if (mesh.first.size() != mesh.cell_count() + 1 || mesh.first.back() != mesh.nodes.size()) return "cells overlap";
  std::set<std::uint32_t> used;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    const std::set<std::uint32_t> nodes(cell.begin(), cell.end());
    if (static_cast<int>(nodes.size()) != node_count(mesh.kinds[c])) return "wrong or repeated nodes";
    if (*nodes.rbegin() >= mesh.points.size()) return "an index out of range";
    if (dimension(mesh.kinds[c]) != mesh.dimension()) return "mixed dimensions";
    const double measure = signed_measure(mesh, c);
    if (!(measure > 0.0) || std::isinf(measure)) return "a measure that is not positive";
    used.insert(nodes.begin(), nodes.end());
  }
  if (used.size() != mesh.points.size()) return "points of no cell";
  for (const auto& x : mesh.points)
    if (!x.allFinite()) return "a coordinate that is not finite";
  return "";
}

/// "file: ..." or "file:LINE: ...", and what was expected.
bool is_well_formed(const std::string& message) {
  return message.starts_with("file:") && message.find("; expected ") != message.npos;
}

/// Welding, and keeping crossed cells, also give a mesh or a reason.
void read_otherwise(const std::string& text, MeshFormat format) {
  try {
    parse_mesh(text, format, "file", {.weld = 0.25, .keep_crossed = true});
  } catch (const IoError&) {
  } catch (const InputError& error) {
    ASSERT_TRUE(is_well_formed(error.what())) << error.what();
  }
}

TEST(MeshFuzz, EveryMutationIsReadSoundlyOrRefusedWithAReason) {
  std::uint64_t seed = 20100601;
  std::size_t read = 0, refused = 0;
  for (const Sample& sample : all_samples()) {
    ASSERT_EQ(flaw(parse_mesh(sample.text, sample.format, "file").mesh), "");
    for (std::size_t k = 0; k < mutations_per_sample; ++k, ++seed) {
      const std::string text = Mutator(seed).mutate(sample.text);
      read_otherwise(text, sample.format);
      try {
        const LoadedMesh loaded = parse_mesh(text, sample.format, "file");
        ASSERT_EQ(flaw(loaded.mesh), "") << "seed " << seed << "\n" << text;
        ++read;
      } catch (const IoError& error) {
        ASSERT_TRUE(is_well_formed(error.what())) << "seed " << seed << ": " << error.what();
        ++refused;
      } catch (const std::exception& error) {
        FAIL() << "seed " << seed << ": " << error.what() << "\n" << text;
      }
    }
  }
  // the mutations are neither all fatal nor all harmless, or they would test nothing
  EXPECT_GT(read, refused / 50);
  EXPECT_GT(refused, read);
  RecordProperty("read", static_cast<int>(read));
  RecordProperty("refused", static_cast<int>(refused));
}

TEST(MeshFuzz, EveryPrefixOfAFileIsReadSoundlyOrRefused) {
  for (const Sample& sample : all_samples())
    for (std::size_t length = 0; length < sample.text.size(); ++length) {
      try {
        const LoadedMesh loaded = parse_mesh(std::string_view(sample.text).substr(0, length), sample.format, "file");
        ASSERT_EQ(flaw(loaded.mesh), "");
      } catch (const IoError& error) {
        ASSERT_TRUE(is_well_formed(error.what())) << error.what();
      }
    }
}

}  // namespace
}  // namespace dartboard::mesh_fuzz_test
