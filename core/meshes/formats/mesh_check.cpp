#include "core/meshes/formats/mesh_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <future>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/point_sets.h"
#include "core/meshes/formats/weld_points.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

constexpr std::size_t worth_a_thread = 20'000;  // cells

/// A mesh under examination, and the words for its cells in messages.
struct Examined {
  LoadedMesh& loaded;
  Mesh& mesh;
  const std::string& file;
  std::span<const std::uint32_t> lines;

  std::size_t line(std::size_t c) const { return c < lines.size() ? lines[c] : 0; }
  std::string cell(std::size_t c) const { return fmt::format("cell {} ({})", c, name(mesh.kinds[c])); }
  std::size_t point(std::uint32_t p) const { return loaded.number_in_file(p); }
  [[noreturn]] void fail(std::size_t c, const std::string& found, std::string_view expected) const {
    fail_at(file, line(c), cell(c) + " " + found, expected);
  }
};

// --- indices

void check_layout(const Examined& e) {
  const Mesh& mesh = e.mesh;
  if (mesh.cell_count() == 0) fail_at(e.file, 0, "the mesh has no cells", "at least one");
  bool consistent = mesh.first.size() == mesh.cell_count() + 1 && mesh.first.front() == 0;
  for (std::size_t c = 0; consistent && c < mesh.cell_count(); ++c)
    consistent = mesh.first[c + 1] == mesh.first[c] + static_cast<std::uint32_t>(node_count(mesh.kinds[c]));
  if (!consistent || mesh.first.back() != mesh.nodes.size())
    fail_at(e.file, 0, "the cells do not lie back to back", "as many nodes for every cell as its kind has");
  for (std::size_t c = 1; c < mesh.cell_count(); ++c)
    if (dimension(mesh.kinds[c]) != dimension(mesh.kinds[0]))
      e.fail(c, "occurs next to " + e.cell(0), "either polygons or volumes, not both");
}

void check_points(const Examined& e) {
  for (std::uint32_t p = 0; p < e.mesh.points.size(); ++p)
    if (!e.mesh.points[p].allFinite())
      fail_at(e.file, 0, fmt::format("point {} has a coordinate that is not finite", e.point(p)), "finite coordinates");
}

void check_nodes(const Examined& e) {
  for (std::size_t c = 0; c < e.mesh.cell_count(); ++c) {
    const auto nodes = e.mesh.cell(c);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (nodes[k] >= e.mesh.points.size())
        e.fail(c, fmt::format("has the point {}", nodes[k]), fmt::format("less than {}", e.mesh.points.size()));
      if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(k), nodes[k]) !=
          nodes.begin() + static_cast<std::ptrdiff_t>(k))
        e.fail(c, fmt::format("has the point {} twice", e.point(nodes[k])), "different points at its nodes");
    }
  }
}

// --- shared cells, faces and edges: sets of up to N points

template <std::size_t N>
struct Repeated {
  std::array<std::uint32_t, N> points;
  std::vector<std::uint32_t> cells;  // ascending
};

/// Of the sets of points that belong to `count` cells the first in order; `for_each_set` lists all as f(points, cell),
/// the cells ascending.
template <std::size_t N>
std::optional<Repeated<N>> find_repeated(const Mesh& mesh, std::uint32_t count, auto&& for_each_set) {
  using Sets = PointSets<N>;
  std::optional<Repeated<N>> least;
  {
    Sets sets(mesh.points.size(), mesh.nodes.size());
    for_each_set([&](std::span<const std::uint32_t> points, std::uint32_t) {
      const auto set = Sets::set_of(points);
      std::uint32_t& cells = sets.number_of(set);
      cells = cells == Sets::none ? 1 : cells + 1;
      if (cells == count && (!least || set < least->points)) least = {set, {}};
    });
  }
  if (least)
    for_each_set([&](std::span<const std::uint32_t> points, std::uint32_t cell) {
      if (Sets::set_of(points) == least->points) least->cells.push_back(cell);
    });
  return least;
}

void check_repeated_cells(const Examined& e) {
  const auto for_each_cell = [&mesh = e.mesh](auto&& f) {
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) f(mesh.cell(c), c);
  };
  const auto check = [&e](const auto& found) {
    if (found)
      e.fail(found->cells[1], fmt::format("has the same points as {}", e.cell(found->cells[0])), "every cell once");
  };
  if (std::ranges::all_of(e.mesh.kinds, [](CellKind kind) { return node_count(kind) <= 4; }))
    check(find_repeated<4>(e.mesh, 2, for_each_cell));
  else
    check(find_repeated<8>(e.mesh, 2, for_each_cell));
}

template <std::size_t N>
void refuse_third(const Examined& e, const std::optional<Repeated<N>>& found, std::string_view part,
                  std::string_view whole) {
  if (!found) return;
  std::vector<std::size_t> points;
  for (const std::uint32_t p : found->points)
    if (p != PointSets<N>::none) points.push_back(e.point(p));
  e.fail(found->cells[2],
         fmt::format("shares the {} of points {} with {} and {}", part, fmt::join(points, ", "),
                     e.cell(found->cells[0]), e.cell(found->cells[1])),
         fmt::format("at most two {} at every {}", whole, part));
}

/// The first face of three volumes.
std::optional<Repeated<4>> find_third_at_face(const Mesh& mesh) {
  return find_repeated<4>(mesh, 3, [&mesh](auto&& f) {
    std::array<std::uint32_t, 4> points{};
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
      const auto nodes = mesh.cell(c);
      for (const auto& face : faces_of(mesh.kinds[c])) {
        for (std::size_t k = 0; k < face.size(); ++k) points[k] = nodes[static_cast<std::size_t>(face[k])];
        f(std::span(points).first(face.size()), c);
      }
    }
  });
}

/// The first edge of three polygons.
std::optional<Repeated<2>> find_third_at_edge(const Mesh& mesh) {
  return find_repeated<2>(mesh, 3, [&mesh](auto&& f) {
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
      const auto nodes = mesh.cell(c);
      for (std::size_t k = 0; k < nodes.size(); ++k) f(std::array{nodes[k], nodes[(k + 1) % nodes.size()]}, c);
    }
  });
}

// --- geometry

double longest_edge(const Mesh& mesh, std::size_t c) {
  double longest = 0.0;
  const auto nodes = mesh.cell(c);
  const auto p = [&](int k) -> const Eigen::Vector3d& { return mesh.points[nodes[static_cast<std::size_t>(k)]]; };
  for (const auto& face : faces_of(mesh.kinds[c]))
    for (std::size_t k = 0; k < face.size(); ++k)
      longest = std::max(longest, (p(face[(k + 1) % face.size()]) - p(face[k])).squaredNorm());
  return std::sqrt(longest);
}

/// The order of the nodes in the mirror image of a cell, which has the same faces.
std::span<const int> mirrored(CellKind kind) {
  static constexpr std::array<int, 4> tetrahedron{0, 2, 1, 3};
  static constexpr std::array<int, 5> pyramid{0, 3, 2, 1, 4};
  static constexpr std::array<int, 6> prism{0, 2, 1, 3, 5, 4};
  static constexpr std::array<int, 8> hexahedron{0, 3, 2, 1, 4, 7, 6, 5};
  switch (kind) {
    case CellKind::tetrahedron: return tetrahedron;
    case CellKind::pyramid: return pyramid;
    case CellKind::prism: return prism;
    case CellKind::hexahedron: return hexahedron;
    case CellKind::triangle:
    case CellKind::quadrilateral: break;
  }
  return {};
}

void mirror(Mesh& mesh, std::size_t c) {
  std::array<std::uint32_t, 8> before{};
  const auto nodes = std::span(mesh.nodes).subspan(mesh.first[c], mesh.cell(c).size());
  std::copy(nodes.begin(), nodes.end(), before.begin());
  const auto order = mirrored(mesh.kinds[c]);
  for (std::size_t k = 0; k < order.size(); ++k) nodes[k] = before[static_cast<std::size_t>(order[k])];
}

/// The measure of a cell, refused when it is zero.
///
/// A measure of at most 1e-14 L^d, L the longest edge, cannot be distinguished from rounding. It is a sum of up to 24
/// determinants over 6 with rows no longer than L, and for a hexahedron one of L / 2. The moduli of the terms of a
/// determinant add up to at most 1.2 L^3 (the largest permanent of such rows), each off by some 13 u from centroids,
/// differences and products, u = 1.1e-16; the outer sum adds 24 u of its parts. Together that is less than
/// 90 u L^3 = 1e-14 L^3. Slivers that can still be simulated lie far above.
double solid_measure(const Examined& e, std::size_t c) {
  const double longest = longest_edge(e.mesh, c);
  const double unit = longest * longest * (dimension(e.mesh.kinds[c]) == 3 ? longest : 1.0);
  const double measure = signed_measure(e.mesh, c);
  if (!std::isfinite(unit) || !std::isfinite(measure))
    e.fail(c, fmt::format("has edges of up to {:.3g}, too long to measure it", longest), "a body of finite size");
  // "not greater" also refuses the cell whose measure underflows
  if (!(std::abs(measure) > 1e-14 * unit) || !(unit >= std::numeric_limits<double>::min()))
    e.fail(c, fmt::format("has the measure {:.3g} with edges of up to {:.3g}", measure, longest),
           dimension(e.mesh.kinds[c]) == 3 ? "a volume that is not zero" : "an area that is not zero");
  return measure;
}

/// The cells whose nodes are in the order of the mirror image; no cell is changed.
std::vector<std::size_t> find_inverted(const Examined& e) {
  std::vector<std::size_t> inverted;
  for (std::size_t c = 0; c < e.mesh.cell_count(); ++c)
    if (!std::ranges::binary_search(e.loaded.crossed.cells, c) && !(solid_measure(e, c) > 0.0)) inverted.push_back(c);
  return inverted;
}

void reorder(Examined& e, std::span<const std::size_t> inverted) {
  for (const std::size_t c : inverted) {
    mirror(e.mesh, c);
    if (const double measure = signed_measure(e.mesh, c); !(measure > 0.0))
      e.fail(c, fmt::format("has the volume {:.3g} in either order of its nodes", measure), "a positive volume");
  }
  if (inverted.empty()) return;
  const std::size_t first = inverted.front();
  const std::string place = e.line(first) == 0 ? "" : fmt::format(" in line {}", e.line(first));
  e.loaded.notices.push_back(fmt::format("reordered the nodes of {} inverted cell{}, the first of them {}{}",
                                         inverted.size(), inverted.size() == 1 ? "" : "s", e.cell(first), place));
}

/// Volumes that cross themselves are as much right-handed as left-handed: they stay unchanged.
void check_crossed(const Examined& e, bool keep_crossed) {
  CrossedCells crossed = find_crossed_cells(e.mesh);
  if (!crossed.any()) return;
  if (!keep_crossed) fail_at(e.file, e.line(crossed.cells.front()), crossed.found(), crossed.remedy());
  e.loaded.crossed = std::move(crossed);
}

}  // namespace

void check_and_repair(LoadedMesh& loaded, const std::string& file, std::span<const std::uint32_t> cell_lines,
                      bool keep_crossed) {
  Examined e{loaded, loaded.mesh, file, cell_lines};
  check_layout(e);
  check_points(e);
  check_nodes(e);
  // Another thread looks up the faces of a large mesh, which are refused after crossed cells, as these have wrong ones;
  // then it looks for seams.
  const bool solid = loaded.mesh.dimension() == 3;
  const auto when = loaded.mesh.cell_count() < worth_a_thread ? std::launch::deferred : std::launch::async;
  auto third_at_face = std::async(when, [&] { return solid ? find_third_at_face(e.mesh) : std::nullopt; });
  check_repeated_cells(e);
  check_crossed(e, keep_crossed);
  refuse_third(e, third_at_face.get(), "face", "volumes");
  if (!solid) refuse_third(e, find_third_at_edge(e.mesh), "edge", "polygons");
  auto seams = std::async(when, [&] { return open_seams(loaded); });
  const std::vector<std::size_t> inverted = find_inverted(e);
  std::string notice = seams.get();
  reorder(e, inverted);
  if (!notice.empty()) loaded.notices.push_back(std::move(notice));
}

}  // namespace dartboard
