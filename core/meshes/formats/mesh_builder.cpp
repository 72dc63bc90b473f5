#include "core/meshes/formats/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/cell_limits.h"
#include "core/base/counted.h"
#include "core/meshes/text/letter_case.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

std::uint32_t narrow_line(std::size_t line) { return static_cast<std::uint32_t>(std::min<std::size_t>(line, none)); }

std::size_t last_line_of(std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  const bool ends_with_line = text.empty() || text.back() == '\n';
  return std::max<std::size_t>(1, lines + (ends_with_line ? 0 : 1));
}

/// "the file has 2 edges and no cells"
std::string without_cells(std::uint64_t points, std::uint64_t edges) {
  std::vector<std::string> parts;
  if (edges != 0) parts.push_back(counted(edges, "edge"));
  if (points != 0) parts.push_back(counted(points, "point element"));
  return fmt::format("the file has {}{}no cells", fmt::join(parts, ", "), parts.empty() ? "" : " and ");
}

}  // namespace

MeshBuilder::MeshBuilder(std::string point_file, std::string cell_file)
    : point_file_(std::move(point_file)), cell_file_(std::move(cell_file)) {}

void MeshBuilder::reserve_points(std::size_t count) {
  point_numbers_.reserve(point_numbers_.size() + count);
  points_.reserve(points_.size() + count);
  point_lines_.reserve(point_lines_.size() + count);
}

void MeshBuilder::add_point(std::uint64_t number, const Eigen::Vector3d& x, std::size_t line) {
  if (points_.size() == none) fail_at(point_file_, line, "found 2^32 points", "fewer: points are numbered in 32 bits");
  point_numbers_.push_back(number);
  points_.push_back(x);
  point_lines_.push_back(narrow_line(line));
}

void MeshBuilder::add_cell(CellKind kind, std::span<const std::uint64_t> corners, std::size_t line,
                           std::string_view element) {
  if (cell_points_.size() + corners.size() > none)
    fail_at(cell_file_, line, "found cells with 2^32 nodes altogether", "fewer: nodes are counted in 32 bits");
  const auto known = std::ranges::find(element_names_, element);
  elements_.push_back(static_cast<std::uint8_t>(known - element_names_.begin()));
  if (known == element_names_.end()) element_names_.emplace_back(element);
  kinds_.push_back(kind);
  cell_points_.insert(cell_points_.end(), corners.begin(), corners.end());
  all_cell_lines_.push_back(narrow_line(line));
}

void MeshBuilder::leave_out(std::size_t cell) {
  if (left_out_.size() <= cell) left_out_.resize(cell + 1, false);
  if (!left_out_[cell]) ++left_out_count_;
  left_out_[cell] = true;
}

std::size_t MeshBuilder::leave_out_further_groups(std::size_t tags) {
  using Key = std::tuple<CellKind, std::array<std::uint64_t, 8>, std::size_t>;  // kind, ascending points, place
  std::vector<Key> keys;
  keys.reserve(kinds_.size());
  auto point = cell_points_.begin();
  for (std::size_t c = 0; c < kinds_.size(); ++c) {
    Key key{kinds_[c], {}, c};
    auto& points = std::get<1>(key);
    std::copy_n(point, node_count(kinds_[c]), points.begin());
    std::ranges::sort(points);
    point += node_count(kinds_[c]);
    keys.push_back(key);
  }
  std::ranges::sort(keys);
  const std::size_t before = left_out_count_;
  std::set<std::int64_t> groups;  // of the cells with these points
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto& [kind, points, c] = keys[k];
    const bool is_first = k == 0 || std::get<0>(keys[k - 1]) != kind || std::get<1>(keys[k - 1]) != points;
    if (is_first) groups.clear();
    if (groups.insert(tags_.value(tags, c)).second && !is_first) leave_out(c);
  }
  return left_out_count_ - before;
}

/// The points in ascending order of their numbers; empty when they are numbered one after the other already.
std::vector<std::uint32_t> MeshBuilder::number_points() {
  const auto jump = std::adjacent_find(point_numbers_.begin(), point_numbers_.end(),
                                       [](std::uint64_t a, std::uint64_t b) { return b != a + 1; });
  if (jump == point_numbers_.end()) return {};
  std::vector<std::uint32_t> order(point_numbers_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return point_numbers_[a] < point_numbers_[b]; });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (point_numbers_[order[k]] == point_numbers_[order[k - 1]])
      fail_at(point_file_, point_lines_[order[k]],
              point_lines_[order[k - 1]] == 0 ? fmt::format("point {} occurs already", point_numbers_[order[k]])
                                              : fmt::format("point {} occurs already in line {}",
                                                            point_numbers_[order[k]], point_lines_[order[k - 1]]),
              "every point number once");
  return order;
}

std::uint32_t MeshBuilder::find_point(std::uint64_t number, std::span<const std::uint32_t> by_number) const {
  if (by_number.empty()) {
    if (points_.empty() || number < point_numbers_.front() || number > point_numbers_.back()) return none;
    return static_cast<std::uint32_t>(number - point_numbers_.front());
  }
  const auto at = std::lower_bound(by_number.begin(), by_number.end(), number,
                                   [&](std::uint32_t p, std::uint64_t n) { return point_numbers_[p] < n; });
  return at != by_number.end() && point_numbers_[*at] == number ? *at : none;
}

/// The number of cells for each name of an element of higher order.
std::map<std::string_view, std::size_t> MeshBuilder::count_elements(auto&& is_counted) const {
  std::map<std::string_view, std::size_t> counts;
  for (std::size_t c = 0; c < kinds_.size(); ++c)
    if (elements_[c] != 0 && !is_left_out(c) && is_counted(kinds_[c])) ++counts[element_names_[elements_[c]]];
  return counts;
}

void MeshBuilder::notice_plane(std::uint64_t points) {
  if (points != 0) add_notice(fmt::format("put {} of two coordinates in the plane z = 0", counted(points, "point")));
}

void MeshBuilder::skip_section(std::string_view name) {
  if (known_sections_.insert(lower(name)).second) skipped_sections_.emplace_back(name);
}

void MeshBuilder::notice_sections() {
  if (skipped_sections_.empty()) return;
  add_notice(fmt::format("skipped the section{} {}: only points and cells are read",
                         skipped_sections_.size() == 1 ? "" : "s", fmt::join(skipped_sections_, ", ")));
}

std::string MeshBuilder::skipped_notice(int dimension, std::size_t kept) const {
  const auto is_skipped = [&](CellKind kind) { return dartboard::dimension(kind) < dimension; };
  std::array<std::size_t, 2> polygons{};  // triangles, quadrilaterals
  for (std::size_t c = 0; c < kinds_.size(); ++c)
    if (elements_[c] == 0 && !is_left_out(c) && is_skipped(kinds_[c]))
      ++polygons[kinds_[c] == CellKind::triangle ? 0 : 1];
  std::vector<std::string> parts;
  if (polygons[0] != 0) parts.push_back(counted(polygons[0], name(CellKind::triangle)));
  if (polygons[1] != 0) parts.push_back(counted(polygons[1], name(CellKind::quadrilateral)));
  for (const auto& [element, count] : count_elements(is_skipped)) parts.push_back(counted(count, element));
  if (skipped_[1] != 0) parts.push_back(counted(skipped_[1], "edge"));
  if (skipped_[0] != 0) parts.push_back(counted(skipped_[0], "point element"));
  if (parts.empty()) return "";
  return fmt::format("skipped {}: the body is made of its {}", fmt::join(parts, ", "),
                     counted(kept, dimension == 3 ? "volume" : "polygon"));
}

std::string MeshBuilder::straightened_notice(int dimension) const {
  std::vector<std::string> parts;
  for (const auto& [element, count] :
       count_elements([&](CellKind kind) { return dartboard::dimension(kind) == dimension; }))
    parts.push_back(counted(count, element));
  return parts.empty() ? ""
                       : fmt::format("took {} by their corners: edges of a body are straight", fmt::join(parts, ", "));
}

LoadedMesh MeshBuilder::finish(std::string format, std::string_view text) {
  int dimension = 0;
  for (std::size_t c = 0; c < kinds_.size(); ++c)
    if (!is_left_out(c)) dimension = std::max(dimension, dartboard::dimension(kinds_[c]));
  if (dimension == 0)
    fail_at(cell_file_, last_line_of(text), without_cells(skipped_[0], skipped_[1]),
            "at least one triangle, quadrilateral or volume");
  CountsByKind counts{};
  for (std::size_t c = 0; c < kinds_.size(); ++c)
    if (dartboard::dimension(kinds_[c]) == dimension && !is_left_out(c)) ++counts[static_cast<std::size_t>(kinds_[c])];
  if (const std::string beyond = beyond_a_map(counts); !beyond.empty())
    fail_at(cell_file_, last_line_of(text), fmt::format("found {}", beyond), "fewer cells");
  const auto by_number = number_points();

  notice_sections();
  LoadedMesh loaded{.mesh = {}, .format = std::move(format), .notices = std::move(notices_), .place_of_point = {}};
  Mesh& mesh = loaded.mesh;
  std::vector<bool> used(points_.size(), false);
  std::vector<std::uint32_t> cell, places;
  mesh.kinds.reserve(kinds_.size());
  mesh.first.reserve(kinds_.size() + 1);
  mesh.nodes.reserve(cell_points_.size());
  std::size_t first = 0;
  for (std::size_t c = 0; c < kinds_.size(); ++c) {
    const auto numbers = std::span(cell_points_).subspan(first, static_cast<std::size_t>(node_count(kinds_[c])));
    first += numbers.size();
    if (dartboard::dimension(kinds_[c]) != dimension || is_left_out(c)) continue;
    cell.clear();
    for (std::uint64_t number : numbers) {
      const std::uint32_t point = find_point(number, by_number);
      if (point == none)
        fail_at(cell_file_, all_cell_lines_[c], fmt::format("a {} has the point {}", name(kinds_[c]), number),
                fmt::format("one of the {} point numbers in {}", points_.size(), point_file_));
      used[point] = true;
      cell.push_back(point);
    }
    mesh.add_cell(kinds_[c], cell);
    cell_lines_.push_back(all_cell_lines_[c]);
    places.push_back(static_cast<std::uint32_t>(c));
  }
  if (auto notice = skipped_notice(dimension, mesh.cell_count()); !notice.empty())
    loaded.notices.push_back(std::move(notice));
  if (auto notice = straightened_notice(dimension); !notice.empty()) loaded.notices.push_back(std::move(notice));
  loaded.tags = tags_.finish(places, dimension, loaded.notices);

  // keep the points that cells use, in the order of the file
  std::vector<std::uint32_t> kept(points_.size(), none);
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (!used[p]) continue;
    kept[p] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(points_[p]);
  }
  for (auto& node : mesh.nodes) node = kept[node];
  if (const std::size_t dropped = points_.size() - mesh.points.size(); dropped != 0) {
    loaded.notices.push_back(
        fmt::format("dropped {} that {} to no cell", counted(dropped, "point"), dropped == 1 ? "belongs" : "belong"));
    loaded.place_of_point = std::move(kept);
  }
  return loaded;
}

}  // namespace dartboard
