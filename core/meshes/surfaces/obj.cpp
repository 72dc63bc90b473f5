#include <fmt/format.h>

#include <charconv>
#include <map>
#include <vector>

#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

/// Numbers given to names in the order in which they occur, from 1.
class Names {
 public:
  Names(MeshBuilder& builder, std::string_view column) : builder_(builder), column_(column) {}

  void use(const std::string& name) {
    const auto at = numbers_.try_emplace(name, static_cast<std::int64_t>(numbers_.size()) + 1).first;
    current_ = at->second;
    const std::size_t column = builder_.tags().column(column_, true);
    builder_.tags().name_value(column, 2, current_, name);
  }
  /// Tag the cell that is added next with the present name.
  void tag_next() {
    if (current_ != 0) builder_.tags().set(builder_.tags().column(column_, true), builder_.cell_count(), current_);
  }

 private:
  MeshBuilder& builder_;
  std::string_view column_;
  std::map<std::string, std::int64_t> numbers_;
  std::int64_t current_ = 0;
};

struct Reader {
  TextScanner& scan;
  MeshBuilder& builder;
  Names groups{builder, "group"}, materials{builder, "material"};
  std::vector<std::uint64_t> corners = {};
  std::uint64_t in_the_plane = 0;  // points of two coordinates
};

/// The first of the numbers of a corner, as in 7/2/3; negative ones count from the last point backwards.
std::uint64_t read_corner(Reader& r) {
  const std::string_view word = r.scan.token("a corner of a face");
  const std::string_view number = word.substr(0, word.find('/'));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  const auto points = static_cast<std::int64_t>(r.builder.point_count());
  if (error != std::errc{} || end != number.data() + number.size() || value == 0)
    r.scan.fail(fmt::format("{} is no corner", in_quotes(word)), "a number of a point, from 1, as in 7 or 7/2/3");
  if (value < -points) r.scan.fail(fmt::format("corner {}", value), fmt::format("at least {}", -points));
  return static_cast<std::uint64_t>(value < 0 ? points + 1 + value : value);
}

/// A line that ends in \ continues in the next.
bool more_of_it(TextScanner& scan) {
  while (scan.more_on_line() && scan.peek() == "\\") scan.token("the next line"), scan.rest_of_line();
  return scan.more_on_line();
}

void read_face(Reader& r, std::size_t line) {
  r.corners.clear();
  while (more_of_it(r.scan)) r.corners.push_back(read_corner(r));
  r.groups.tag_next();
  r.materials.tag_next();
  add_polygon(r.builder, r.corners, line);
}

void read_line(Reader& r, std::string_view keyword) {
  const std::size_t line = r.scan.line();
  if (keyword == "v") {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    const std::uint64_t number = r.builder.point_count() + 1;
    for (int k = 0; k < 3; ++k) {
      const bool more = more_of_it(r.scan);
      if (k == 2 && !more) ++r.in_the_plane;
      if (k < 2 || more) x[k] = r.scan.real({"a coordinate of point", number});
    }
    r.builder.add_point(number, x, line);
    while (more_of_it(r.scan)) r.scan.token("a weight or colour");
  } else if (keyword == "f" || keyword == "fo") {
    read_face(r, line);
  } else if (keyword == "g" || keyword == "o") {
    r.groups.use(std::string(r.scan.rest_of_line()));
  } else if (keyword == "usemtl") {
    r.materials.use(std::string(r.scan.rest_of_line()));
  } else {
    if (keyword == "l") r.builder.skip(1);
    if (keyword == "p") r.builder.skip(0);
    while (more_of_it(r.scan)) r.scan.token("the rest of a line");
  }
}

bool is_known(std::string_view keyword) {
  for (std::string_view known :
       {"v", "f", "fo", "g",     "o",        "usemtl",   "mtllib", "vt",     "vn",     "vp",         "s",
        "l", "p", "mg", "bevel", "c_interp", "d_interp", "lod",    "usemap", "maplib", "shadow_obj", "trace_obj"})
    if (keyword == known) return true;
  return false;
}

}  // namespace

std::string read_obj(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file(), '#');
  Reader r{scan, builder};
  while (!scan.at_end()) {
    const std::string_view keyword = scan.token("a line");
    if (!is_known(keyword))
      scan.fail(fmt::format("found {}", in_quotes(keyword)),
                "v, f, g, o or another keyword of an OBJ file of polygons");
    read_line(r, keyword);
  }
  builder.notice_plane(r.in_the_plane);
  return "OBJ";
}

}  // namespace dartboard
