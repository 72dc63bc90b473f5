// The binary variant of Medit, .meshb: after a header sections, each with its code, the place of the next one, the
// number of its lines, and the lines.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/formats/medit_sections.h"
#include "core/meshes/formats/mesh_formats.h"

namespace dartboard {
namespace {

constexpr std::int64_t dimension_code = 3, vertices_code = 4, edges_code = 5, end_code = 54, precision_code = 155;

/// Cells that a mesh here cannot hold: polygons, polyhedra, those of order 3 and 4, and those with nodes on some of
/// their edges.
bool is_other_cells(std::int64_t code) {
  return code == 46 || code == 47 || (code >= 88 && code <= 91) || (code >= 96 && code <= 103) ||
         (code >= 200 && code <= 208);
}

/// Sections that do not change the mesh: corners, normals, solutions, associations with a geometry, orders of nodes.
constexpr std::int64_t least_ignored = 11, largest_ignored = 240;

/// The numbers of a file by the types of its version.
class MeditNumbers : public FileNumbers {
 public:
  MeditNumbers(TextScanner& scan, bool big_endian) : FileNumbers(scan) { set_binary(big_endian); }

  void set_version(std::uint64_t version) {
    integer_ = version < 4 ? Scalar::int32 : Scalar::int64;
    place_ = version < 3 ? Scalar::int32 : Scalar::int64;
    real_ = version == 1 ? Scalar::float32 : Scalar::float64;
  }
  void set_real(Scalar type) { real_ = type; }

  std::uint64_t word(Wanted wanted) { return FileNumbers::count(Scalar::int32, wanted); }
  std::uint64_t place(Wanted wanted) { return FileNumbers::count(place_, wanted); }
  std::int64_t integer(Wanted wanted) { return FileNumbers::integer(integer_, wanted); }
  std::uint64_t count(Wanted wanted) { return FileNumbers::count(integer_, wanted); }
  double real(Wanted wanted) { return FileNumbers::real(real_, wanted); }
  /// The bytes of a line of so many numbers.
  std::uint64_t line_bytes(std::uint64_t reals, std::uint64_t integers) const {
    return reals * size_of(real_) + integers * size_of(integer_);
  }

 private:
  Scalar integer_ = Scalar::int32, place_ = Scalar::int32, real_ = Scalar::float64;
};

struct Reader {
  TextScanner& scan;
  MeditNumbers numbers;
  MeshBuilder& builder;
  std::uint64_t axes = 0;
  std::uint64_t next = 0;  // where the section after this one begins
  bool has_vertices = false;
};

/// The number of lines, which fill the section.
std::uint64_t read_count(Reader& r, const std::string& section, std::uint64_t line) {
  const std::uint64_t count = r.numbers.count(fmt::format("the number of lines of {}", section).c_str());
  const std::uint64_t bytes = r.next - std::min<std::uint64_t>(r.next, r.scan.place());
  if (bytes % line != 0 || bytes / line != count)
    r.numbers.fail(fmt::format("{} has {} lines in {} bytes", section, count, bytes),
                   fmt::format("{} bytes for each", line));
  return count;
}

void read_vertices(Reader& r) {
  if (r.has_vertices) r.numbers.fail("found Vertices again", "one section of vertices");
  r.has_vertices = true;
  const std::uint64_t count = read_count(r, "Vertices", r.numbers.line_bytes(r.axes, 1));
  r.builder.reserve_points(static_cast<std::size_t>(count));
  for (std::uint64_t i = 1; i <= count; ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::uint64_t k = 0; k < r.axes; ++k) x[static_cast<int>(k)] = r.numbers.real({"a coordinate of vertex", i});
    r.numbers.integer({"the reference of vertex", i});
    r.builder.add_point(i, x, 0);
  }
}

void read_cells(Reader& r, const MeditSection& section) {
  const auto size = static_cast<std::uint64_t>(section.nodes);
  const std::uint64_t count = read_count(r, std::string(section.keyword), r.numbers.line_bytes(0, size + 1));
  const std::string node = fmt::format("a vertex of {}", section.called());
  const std::string reference = fmt::format("the reference of {}", section.called());
  const std::size_t column = r.builder.tags().column("reference", true);
  std::array<std::uint64_t, 27> points{};
  const auto nodes = std::span(points).first(static_cast<std::size_t>(size));
  const auto corners = nodes.first(static_cast<std::size_t>(node_count(section.kind)));
  for (std::uint64_t i = 1; i <= count; ++i) {
    for (auto& p : nodes) p = r.numbers.count({node, i});
    r.builder.tags().set(column, r.builder.cell_count(), r.numbers.integer({reference, i}));
    r.builder.add_cell(section.kind, corners, 0, section.element);
  }
}

/// Read the section that changes the size of real numbers from that of the version.
void read_precision(Reader& r) {
  const std::uint64_t bits = r.numbers.count("the size of real numbers");
  if (bits != 32 && bits != 64) r.numbers.fail(fmt::format("real numbers of {} bits", bits), "32 or 64");
  r.numbers.set_real(bits == 32 ? Scalar::float32 : Scalar::float64);
}

void skip_rest(Reader& r) {
  const std::uint64_t here = std::min<std::uint64_t>(r.next, r.scan.place());
  r.numbers.skip(Scalar::uint8, r.next - here, "the rest of a section");
}

void read_section(Reader& r, std::int64_t code) {
  if (code == vertices_code) {
    read_vertices(r);
  } else if (const MeditSection* const cells = medit_section(code)) {
    read_cells(r, *cells);
  } else if (code == edges_code) {
    r.builder.skip(1, read_count(r, "Edges", r.numbers.line_bytes(0, 3)));
    skip_rest(r);
  } else if (code == precision_code) {
    read_precision(r);
  } else if (code >= least_ignored && code <= largest_ignored && !is_other_cells(code)) {
    r.builder.skip_section(fmt::format("of code {}", code));
    skip_rest(r);
  } else {
    r.numbers.fail(fmt::format("section {} is not one of a mesh that can be held", code),
                   "vertices, edges, triangles, quadrilaterals, tetrahedra, pyramids, prisms or hexahedra, of first "
                   "or second order");
  }
}

/// The code of a section and the place of the next one; false for the last.
bool read_head(Reader& r, std::int64_t& code) {
  code = static_cast<std::int64_t>(r.numbers.word("the code of a section"));
  r.next = r.numbers.place("the place of the next section");
  if (code == end_code) return false;
  // without an end a file may have lost its last sections, and a solid would pass for its surface
  const std::uint64_t size = r.scan.place() + r.scan.left();
  if (r.next <= r.scan.place() || r.next > size)
    r.numbers.fail(fmt::format("section {} has the next one at byte {}", code, r.next),
                   fmt::format("a place from {} to {}, and the section End", r.scan.place() + 1, size));
  return true;
}

void check_section_end(const Reader& r, std::int64_t code) {
  if (r.scan.place() != r.next)
    r.numbers.fail(fmt::format("section {} ends at byte {}", code, r.scan.place()),
                   fmt::format("{}, where it says that the next one begins", r.next));
}

}  // namespace

std::string read_medit_binary(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  Reader r{.scan = scan, .numbers = MeditNumbers(scan, text.front() == '\0'), .builder = builder};
  r.numbers.word("the number 1");
  const std::uint64_t version = r.numbers.word("the version of the format");
  if (version < 1 || version > 4) r.numbers.fail(fmt::format("version {}", version), "version 1, 2, 3 or 4");
  r.numbers.set_version(version);
  std::int64_t code = 0;
  if (!read_head(r, code) || code != dimension_code)
    r.numbers.fail(fmt::format("the first section is {}", code), "3, the dimension");
  r.axes = r.numbers.word("the dimension");
  if (r.axes != 2 && r.axes != 3) r.numbers.fail(fmt::format("dimension {}", r.axes), "dimension 2 or 3");
  check_section_end(r, code);
  while (read_head(r, code)) {
    read_section(r, code);
    check_section_end(r, code);
  }
  return fmt::format("Medit {} binary", version);
}

}  // namespace dartboard
