#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

/// What stands before OFF tells of further numbers after the coordinates: normals, colours of red, green, blue and
/// opacity, textures.
struct Kind {
  std::string_view word;
  std::uint64_t further;
};
constexpr Kind kinds[] = {{"OFF", 0}, {"COFF", 4}, {"NOFF", 3}, {"CNOFF", 7}, {"STOFF", 2}};

Kind read_kind(TextScanner& scan) {
  const std::string_view word = scan.token("the word OFF");
  for (const Kind& kind : kinds)
    if (kind.word == word) return kind;
  scan.fail(fmt::format("found {}", in_quotes(word)), "the word OFF, COFF, NOFF, CNOFF or STOFF");
}

/// As text the numbers that follow end with the line.
void skip_line(TextScanner& scan, Wanted wanted) {
  while (scan.more_on_line()) scan.token(wanted);
}

/// Bytes: numbers of 32 bits with the first byte first, and after each polygon how many numbers its colour has.
void skip_properties(TextScanner& scan, FileNumbers& numbers, std::optional<std::uint64_t> many, const char* what) {
  if (!numbers.is_binary()) return skip_line(scan, what);
  numbers.skip(Scalar::float32, many ? *many : numbers.count(Scalar::int32, what), what);
}

}  // namespace

std::string read_off(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file(), '#');
  FileNumbers numbers(scan);
  const Kind kind = read_kind(scan);
  if (scan.more_on_line() && scan.peek() == "BINARY") {
    scan.token("BINARY");
    numbers.set_binary(true);
    numbers.begin();
  }
  const auto count = [&numbers](Wanted wanted) { return numbers.count(Scalar::int32, wanted); };
  const std::uint64_t points = count("the number of points");
  const std::uint64_t cells = count("the number of polygons");
  count("the number of edges");

  builder.reserve_points(numbers.plausible(points, 12, 6));
  for (std::uint64_t i = 0; i < points; ++i) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = numbers.real(Scalar::float32, {"a coordinate of point", i});
    builder.add_point(i, x, numbers.line());
    skip_properties(scan, numbers, kind.further, "a property of a point");
  }
  std::vector<std::uint64_t> corners;
  for (std::uint64_t c = 0; c < cells; ++c) {
    const std::uint64_t size = count({"the number of corners of polygon", c});
    const std::size_t line = numbers.line();
    corners.clear();
    for (std::uint64_t k = 0; k < size; ++k) corners.push_back(count({"a corner of polygon", c}));
    add_polygon(builder, corners, line);
    skip_properties(scan, numbers, {}, "the colour of a polygon");
  }
  if (!scan.at_end()) {
    const auto extra = scan.token("nothing");
    scan.fail(fmt::format("{} follows the last polygon", in_quotes(extra)), "as many as announced");
  }
  return numbers.is_binary() ? "OFF binary" : "OFF";
}

}  // namespace dartboard
