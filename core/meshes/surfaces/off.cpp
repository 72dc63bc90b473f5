#include <fmt/format.h>

#include <array>
#include <vector>

#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {

std::string read_off(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file(), '#');
  const std::string_view word = scan.token("the word OFF");
  // what stands before OFF tells of further numbers after the coordinates: normals, colours, textures
  if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF" && word != "STOFF")
    scan.fail(fmt::format("found {}", in_quotes(word)), "the word OFF, COFF, NOFF, CNOFF or STOFF");
  if (scan.more_on_line() && scan.peek() == "BINARY") scan.fail("found a BINARY file", "text: save the mesh as ASCII");
  const std::uint64_t points = scan.count("the number of points");
  const std::uint64_t cells = scan.count("the number of polygons");
  scan.count("the number of edges");

  builder.reserve_points(scan.plausible(points, 6));
  for (std::uint64_t i = 0; i < points; ++i) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = scan.real({"a coordinate of point", i});
    builder.add_point(i, x, scan.line());
    while (scan.more_on_line()) scan.token("a property of a point");
  }
  std::vector<std::uint64_t> corners;
  for (std::uint64_t c = 0; c < cells; ++c) {
    const std::uint64_t size = scan.count({"the number of corners of polygon", c});
    const std::size_t line = scan.line();
    corners.clear();
    for (std::uint64_t k = 0; k < size; ++k) corners.push_back(scan.count({"a corner of polygon", c}));
    add_polygon(builder, corners, line);
    while (scan.more_on_line()) scan.token("the colour of a polygon");
  }
  if (!scan.at_end()) {
    const auto extra = scan.token("nothing");
    scan.fail(fmt::format("{} follows the last polygon", in_quotes(extra)), "as many as announced");
  }
  return "OFF";
}

}  // namespace dartboard
