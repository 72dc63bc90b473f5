#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/letter_case.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

/// The letters before OFF announce further numbers after the coordinates: normals, colours of red, green, blue and
/// opacity, textures.
struct Kind {
  std::string_view word;
  std::uint64_t further;
};
constexpr Kind kinds[] = {{"OFF", 0}, {"COFF", 4}, {"NOFF", 3}, {"CNOFF", 7}, {"STOFF", 2}};

/// The format of a point by the word: how many numbers follow its coordinates, and how many coordinates, if given.
struct PointLine {
  std::uint64_t further = 0, axes = 3;
  bool axes_follow = false;  // as the first number of the file
};

/// The word may be in small letters, be followed directly by the first number, or be missing before a number. The n of
/// nOFF, points of some dimension, is small: a capital N says that points have normals, and so does noff.
PointLine read_point_line(TextScanner& scan) {
  const std::string_view as_given = scan.peek();
  const std::string word = upper(as_given);
  if (as_given.starts_with("nOFF")) return scan.bytes(4, "the word nOFF"), PointLine{.axes_follow = true};
  if (word == "2OFF" || word == "3OFF")
    return scan.token("the word 2OFF"), PointLine{.axes = static_cast<std::uint64_t>(word[0] - '0')};
  const std::size_t letters = std::min(word.find_first_of("0123456789"), word.size());
  if (letters == 0 && !word.empty()) return {};
  for (const Kind& kind : kinds)
    if (kind.word == word.substr(0, letters)) {
      scan.bytes(letters, "the word OFF");
      return {.further = kind.further};
    }
  const std::string_view found = scan.token("the word OFF");
  scan.fail(fmt::format("found {}", in_quotes(found)), "the word OFF, COFF, NOFF, CNOFF, STOFF, nOFF or 2OFF");
}

struct Counts {
  std::uint64_t points, polygons;
};

/// Two or three counts; some writers leave out that of the edges, which is not used.
Counts read_counts(TextScanner& scan, FileNumbers& numbers) {
  Counts counts{};
  counts.points = numbers.count(Scalar::int32, "the number of points");
  const bool is_one_line = !numbers.is_binary() && scan.more_on_line();
  counts.polygons = numbers.count(Scalar::int32, "the number of polygons");
  if (!is_one_line || scan.more_on_line()) numbers.count(Scalar::int32, "the number of edges");
  if (is_one_line && scan.more_on_line())
    scan.fail(fmt::format("{} follows the numbers", in_quotes(scan.peek())), "those of points, polygons and edges");
  return counts;
}

/// In the text variant the further numbers end with the line.
void skip_line(TextScanner& scan, Wanted wanted) {
  while (scan.more_on_line()) scan.token(wanted);
}

/// In the binary variant: big-endian numbers of 32 bits, and after each polygon how many numbers its colour has.
void skip_properties(TextScanner& scan, FileNumbers& numbers, std::optional<std::uint64_t> many, const char* what) {
  if (!numbers.is_binary()) return skip_line(scan, what);
  numbers.skip(Scalar::float32, many ? *many : numbers.count(Scalar::int32, what), what);
}

}  // namespace

std::string read_off(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file(), '#');
  FileNumbers numbers(scan);
  PointLine said = read_point_line(scan);
  if (scan.more_on_line() && same_letters(scan.peek(), "BINARY")) {
    scan.token("BINARY");
    numbers.set_binary(true);
    numbers.begin();
  }
  const auto count = [&numbers](Wanted wanted) { return numbers.count(Scalar::int32, wanted); };
  if (said.axes_follow) said.axes = count("the number of coordinates of a point");
  if (said.axes != 2 && said.axes != 3)
    numbers.fail(fmt::format("points of {} coordinates", said.axes), "2 or 3 coordinates");
  const auto [points, cells] = read_counts(scan, numbers);

  builder.reserve_points(numbers.plausible(points, 4 * said.axes, 2 * said.axes));
  for (std::uint64_t i = 0; i < points; ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::uint64_t k = 0; k < said.axes; ++k)
      x[static_cast<int>(k)] = numbers.real(Scalar::float32, {"a coordinate of point", i});
    builder.add_point(i, x, numbers.line());
    skip_properties(scan, numbers, said.further, "a property of a point");
  }
  if (said.axes == 2) builder.notice_plane(points);
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
