#include "core/scene/output/write_vtu.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/meshes/text/base64.h"
#include "core/plain/error.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/output/atomic_file.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/output/write_pvd.h"

namespace dartboard::write_vtu_test {
namespace {

namespace fs = std::filesystem;

Frame frame_of(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  return make_simulated_body(problem, true)->frame({});
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// A folder that is removed at the end of the test.
struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("write_vtu_test-" + std::to_string(getpid()));
  ~TemporaryFolder() { fs::remove_all(path); }
};

// Every cell with its nodes as positions, which do not depend on the numbering of points.
std::vector<std::vector<Eigen::Vector3d>> places(const Mesh& mesh) {
  std::vector<std::vector<Eigen::Vector3d>> cells;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    cells.emplace_back();
    for (const std::uint32_t node : mesh.cell(c)) cells.back().push_back(mesh.points[node]);
  }
  return cells;
}

TEST(WriteVtu, IsReadBackWithEveryBit) {
  for (const Mesh& mesh : {kuhn_box(2, 1, 2, 0.1, 0.2, 3), hexahedron_box(2, 1, 1, 1.0 / 3), mixed_box(2, 2, 2, 0.7),
                           triangle_sheet(2, 3, 0.1), quad_sheet(3, 1, 0.3)}) {
    const Frame frame = frame_of(mesh);
    const LoadedMesh read = parse_mesh(to_vtu(frame), MeshFormat::vtu, "text");
    EXPECT_EQ(read.mesh.points, frame.mesh.points);
    EXPECT_EQ(read.mesh.kinds, frame.mesh.kinds);
    EXPECT_EQ(read.mesh.nodes, frame.mesh.nodes);
    EXPECT_TRUE(read.notices.empty()) << read.notices[0];  // nothing was inverted
  }
}

// Arrays of no, of less than one, and of several blocks of 128 KiB.
TEST(WriteVtu, IsReadBackWithEveryBitWhereItIsCompressed) {
  for (const Compressor compressor : {Compressor::zlib, Compressor::lz4})
    for (const Mesh& mesh : {Mesh{}, mixed_box(2, 2, 2, 0.7), kuhn_box(22, 20, 17, 0.1, 0.2, 3)}) {
      const Frame frame = mesh.points.empty() ? Frame{} : frame_of(mesh);
      const std::string text = to_vtu(frame, compressor);
      EXPECT_NE(text.find(fmt::format(" compressor=\"{}\"", vtk_name(compressor))), text.npos);
      if (mesh.points.empty()) continue;  // a file without a cell is no mesh
      const LoadedMesh read = parse_mesh(text, MeshFormat::vtu, "text");
      EXPECT_EQ(read.mesh.points, frame.mesh.points);
      EXPECT_EQ(read.mesh.kinds, frame.mesh.kinds);
      EXPECT_EQ(read.mesh.nodes, frame.mesh.nodes);
      if (mesh.cell_count() > 1000) {
        EXPECT_LT(text.size(), to_vtu(frame).size() / 2);
      }
    }
}

TEST(WriteVtu, WritesAFrameOfManyBlocksAsItsTextIs) {
  const Frame frame = frame_of(kuhn_box(9, 8, 7, 0.1, 0.2, 3));
  const std::string text = to_vtu(frame);
  EXPECT_EQ(parse_mesh(text, MeshFormat::vtu, "text").mesh.nodes, frame.mesh.nodes);
  const TemporaryFolder folder;
  fs::create_directory(folder.path);
  EXPECT_EQ(write_vtu(folder.path / "frame.vtu", frame), text.size());
  EXPECT_EQ(text_of(folder.path / "frame.vtu"), text);
}

TEST(Frame, HasTheCellsOfTheMeshRightHandedInTheirOrder) {
  for (const Mesh& mesh : {kuhn_box(2, 1, 2, 0.1, 0.2, 3), mixed_box(2, 2, 2, 0.7), hexahedron_box(1, 2, 1, 0.5)}) {
    const Frame frame = frame_of(mesh);
    ASSERT_EQ(frame.mesh.kinds, mesh.kinds);
    const auto here = places(frame.mesh), there = places(mesh);
    for (std::size_t c = 0; c < here.size(); ++c) {
      EXPECT_TRUE(std::is_permutation(here[c].begin(), here[c].end(), there[c].begin())) << c;
      EXPECT_GT(signed_measure(frame.mesh, c), 0.0) << c;
      EXPECT_EQ(frame.mesh_cell[c], c);
      EXPECT_EQ(frame.component[c], 0u);
    }
  }
}

TEST(WriteVtu, NamesItsDataAndTheTime) {
  Frame frame = frame_of(two_tetrahedra());
  frame.time = 0.5;
  const std::string text = to_vtu(frame);
  for (const char* name : {"velocity", "mass", "mesh_cell", "component", "TimeValue"})
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), text.npos) << name;
  EXPECT_NE(text.find("header_type=\"UInt64\""), text.npos);
}

TEST(WriteVtu, WritesAnEmptyBody) {
  const std::string text = to_vtu(Frame{});
  EXPECT_NE(text.find("NumberOfPoints=\"0\" NumberOfCells=\"0\""), text.npos);
  EXPECT_NE(text.find(">AAAAAAAAAAA=<"), text.npos);  // a length of 0 in 8 bytes
}

TEST(WriteVtu, RefusesColumnsOfAnotherLength) {
  Frame frame = frame_of(one_tetrahedron());
  frame.mass.pop_back();
  EXPECT_THROW(to_vtu(frame), InputError);
}

TEST(Base64Writer, GivesTheExamplesOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(encode_base64(""), "");
  EXPECT_EQ(encode_base64("f"), "Zg==");
  EXPECT_EQ(encode_base64("fo"), "Zm8=");
  EXPECT_EQ(encode_base64("foo"), "Zm9v");
  EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  EXPECT_EQ(decode_base64(encode_base64(all)), all);
}

TEST(Base64Writer, GivesEveryLengthThatIsReadBack) {
  std::string bytes;
  for (int k = 0; k < 40; ++k) {
    EXPECT_EQ(encode_base64(bytes).size(), (bytes.size() + 2) / 3 * 4);
    EXPECT_EQ(decode_base64(encode_base64(bytes)), bytes) << k;
    bytes += static_cast<char>(255 - 37 * k);
  }
}

TEST(Base64Writer, AddsToATextWhatItIsByItself) {
  std::string text = "before";
  append_base64(text, "foob");
  append_base64(text, "foobar");
  EXPECT_EQ(text, "beforeZm9vYg==Zm9vYmFy");
}

TEST(PvdFile, IsWholeAfterEveryFrameAndListsThemWithTheirTimes) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path);
  PvdFile list(folder.path / "frames.pvd");
  const std::string head =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  const std::string tail = "  </Collection>\n</VTKFile>\n";
  std::string entries = "    <DataSet timestep=\"0\" part=\"0\" file=\"a.vtu\"/>\n";
  list.add({0.0, "a.vtu"});
  EXPECT_EQ(text_of(folder.path / "frames.pvd"), head + entries + tail);
  entries += "    <DataSet timestep=\"0.10000000000000001\" part=\"0\" file=\"b.vtu\"/>\n";
  list.add({0.1, "b.vtu"});
  EXPECT_EQ(text_of(folder.path / "frames.pvd"), head + entries + tail);
  EXPECT_EQ(list.size(), 2u);
}

TEST(WriteWhole, SaysWhyAFileCannotBeWritten) {
  const TemporaryFolder folder;
  try {
    write_whole(folder.path / "nowhere" / "file", "text");
    FAIL() << "no error";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be written: No such file or directory"), std::string::npos)
        << error.what();
  }
}

TEST(SceneOutput, ListsAFrameAsSoonAsItIsThereAndLeavesNoPartOfOne) {
  const TemporaryFolder folder;
  SceneOutput output(folder.path / "below");
  output.write(frame_of(one_tetrahedron()));
  EXPECT_NE(text_of(folder.path / "below" / "frames.pvd").find("frame_000000.vtu"), std::string::npos);
  EXPECT_EQ(read_mesh(folder.path / "below" / "frame_000000.vtu").cell_count(), 1u);
  output.write(frame_of(two_tetrahedra()));
  EXPECT_EQ(read_mesh(folder.path / "below" / "frame_000001.vtu").cell_count(), 2u);
  for (const auto& entry : fs::directory_iterator(folder.path / "below"))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(SceneOutput, WritesOneRowPerDiagnostics) {
  const TemporaryFolder folder;
  SceneOutput output(folder.path);
  Diagnostics diagnostics;
  diagnostics.time = 0.1;
  output.write(diagnostics);
  const std::string text = text_of(folder.path / "diagnostics.csv");
  EXPECT_EQ(text, diagnostics_header() + diagnostics_row(diagnostics));
  const auto commas = [](const std::string& row) { return std::count(row.begin(), row.end(), ','); };
  EXPECT_EQ(commas(diagnostics_header()), commas(diagnostics_row(diagnostics)));
}

TEST(Diagnostics, HeadTheirColumnsWithTheUnitsOfTheBody) {
  EXPECT_NE(diagnostics_header(3).find(",boundary [m^2],largest principal stress [Pa],"), std::string::npos);
  EXPECT_NE(diagnostics_header(2).find(",boundary [m],largest principal stress [N/m],"), std::string::npos);
  EXPECT_NE(diagnostics_header(0).find(",boundary [m],largest tension [N],"), std::string::npos);
}

TEST(Diagnostics, LeaveAFieldEmptyForWhatIsNotFinite) {
  Diagnostics diagnostics;
  EXPECT_TRUE(is_finite(diagnostics));
  diagnostics.elastic = std::numeric_limits<double>::quiet_NaN();
  diagnostics.largest_stress = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_finite(diagnostics));
  EXPECT_EQ(diagnostics_row(diagnostics), "0,0,,0,0,0,0,0,0,0,0,0,0,0,0,0,0,,0\n");
}

TEST(SceneOutput, RefusesAFolderThatHoldsSomething) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path);
  std::ofstream(folder.path / "precious") << "kept";
  EXPECT_THROW(SceneOutput{folder.path}, IoError);
  EXPECT_THROW(SceneOutput{folder.path / "precious"}, IoError);
  EXPECT_EQ(text_of(folder.path / "precious"), "kept");
}

}  // namespace
}  // namespace dartboard::write_vtu_test
