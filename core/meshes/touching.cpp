#include "core/meshes/touching.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/counted.h"
#include "core/base/disjoint_sets.h"
#include "core/base/point_sets.h"

namespace dartboard {
namespace {

using Pair = std::array<std::uint32_t, 2>;

Pair ascending(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of a kind of cell, in the order of its faces.
struct EdgesOfKind {
  std::vector<std::array<std::uint8_t, 2>> ends;  // local nodes
  std::array<std::array<std::uint8_t, 8>, 8> number{};
  static constexpr std::uint8_t no_edge = 255;
};

const EdgesOfKind& edges_of(CellKind kind) {
  static const auto all = [] {
    std::array<EdgesOfKind, 6> kinds;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      EdgesOfKind& edges = kinds[k];
      for (auto& row : edges.number) row.fill(EdgesOfKind::no_edge);
      for (const std::vector<int>& cycle : faces_of(static_cast<CellKind>(k)))
        for (std::size_t j = 0; j < cycle.size(); ++j) {
          const auto a = static_cast<std::uint8_t>(cycle[j]),
                     b = static_cast<std::uint8_t>(cycle[(j + 1) % cycle.size()]);
          if (edges.number[a][b] != EdgesOfKind::no_edge) continue;
          edges.number[a][b] = edges.number[b][a] = static_cast<std::uint8_t>(edges.ends.size());
          edges.ends.push_back({a, b});
        }
    }
    return kinds;
  }();
  return all[static_cast<std::size_t>(kind)];
}

/// The corners and edges of all cells, one cell after the other, in sets that facets join.
struct JoinedCells {
  const Mesh& mesh;
  std::vector<std::uint32_t> first_edge{0};  // by cell
  DisjointSets corners, edges;

  explicit JoinedCells(const Mesh& joined) : mesh(joined), corners(joined.nodes.size()), edges(number_edges()) {
    PointSets<4> facets(mesh.points.size(), mesh.nodes.size());  // each with its last cell
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
      for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
        const std::size_t n = cycle.size();
        if (dimension(mesh.kinds[c]) == 3)
          meet(facets, c, cycle);
        else
          for (std::size_t k = 0; k < n; ++k) meet(facets, c, std::array{cycle[k], cycle[(k + 1) % n]});
      }
  }

  /// The points at the ends of an edge of a cell, ascending.
  Pair ends(std::size_t c, std::size_t edge) const {
    const auto [a, b] = edges_of(mesh.kinds[c]).ends[edge];
    return ascending(mesh.cell(c)[a], mesh.cell(c)[b]);
  }

 private:
  /// Returns the number of edges of all cells.
  std::uint32_t number_edges() {
    first_edge.reserve(mesh.cell_count() + 1);
    for (const CellKind kind : mesh.kinds)
      first_edge.push_back(first_edge.back() + static_cast<std::uint32_t>(edges_of(kind).ends.size()));
    return first_edge.back();
  }

  void meet(PointSets<4>& facets, std::uint32_t c, std::span<const int> cycle) {
    const auto node = mesh.cell(c);
    std::array<std::uint32_t, 4> points{};
    for (std::size_t k = 0; k < cycle.size(); ++k) points[k] = node[static_cast<std::size_t>(cycle[k])];
    std::uint32_t& last = facets.number_of(PointSets<4>::set_of({points.data(), cycle.size()}));
    if (last != PointSets<4>::none) join(c, cycle, last);
    last = c;
  }

  void join(std::uint32_t c, std::span<const int> cycle, std::uint32_t other) {
    const auto node = mesh.cell(c), there = mesh.cell(other);
    const EdgesOfKind &edges_here = edges_of(mesh.kinds[c]), &edges_there = edges_of(mesh.kinds[other]);
    std::array<std::size_t, 4> place{};  // in the other cell
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      place[k] = static_cast<std::size_t>(
          std::find(there.begin(), there.end(), node[static_cast<std::size_t>(cycle[k])]) - there.begin());
      corners.join(mesh.first[c] + static_cast<std::uint32_t>(cycle[k]),
                   mesh.first[other] + static_cast<std::uint32_t>(place[k]));
    }
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      const std::size_t next = (k + 1) % cycle.size();
      const std::uint8_t here = edges_here
                                    .number[static_cast<std::size_t>(cycle[k])][static_cast<std::size_t>(cycle[next])],
                         opposite = edges_there.number[place[k]][place[next]];
      // the faces of crossed cells may have the same points and other edges
      if (opposite != EdgesOfKind::no_edge) edges.join(first_edge[c] + here, first_edge[other] + opposite);
    }
  }
};

/// The points, ascending, whose corners are several sets.
std::vector<std::uint32_t> points_of_several_sets(JoinedCells& cells) {
  std::vector<std::uint8_t> sets(cells.mesh.points.size(), 0);
  for (std::uint32_t k = 0; k < cells.mesh.nodes.size(); ++k)
    if (std::uint8_t& count = sets[cells.mesh.nodes[k]]; count < 2 && cells.corners.set_of(k) == k) ++count;
  std::vector<std::uint32_t> several;
  for (std::uint32_t p = 0; p < sets.size(); ++p)
    if (sets[p] > 1) several.push_back(p);
  return several;
}

/// The edges that several sets of joined cells share.
std::vector<Pair> edges_of_several_sets(JoinedCells& cells) {
  PointSets<2> met(cells.mesh.points.size(), cells.edges.count());
  std::vector<Pair> several;
  for (std::uint32_t c = 0; c < cells.mesh.cell_count(); ++c)
    for (std::uint32_t k = cells.first_edge[c]; k < cells.first_edge[c + 1]; ++k) {
      if (cells.edges.set_of(k) != k) continue;
      const Pair edge = cells.ends(c, k - cells.first_edge[c]);
      std::uint32_t& sets = met.number_of(edge);
      sets = sets == PointSets<2>::none ? 1 : sets + 1;
      if (sets == 2) several.push_back(edge);
    }
  std::sort(several.begin(), several.end());
  return several;
}

/// "(A; B)" of the first three of each.
template <class Items, class Show>
std::string first_three(std::string_view what, const Items& items, Show&& show) {
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, items.size()); ++k)
    text += (k == 0 ? fmt::format("{}{} ", what, items.size() == 1 ? "" : "s") : ", ") + show(items[k]);
  return items.size() > 3 ? text + ", ..." : text;
}

}  // namespace

TouchingCells split_touching_points(Mesh& mesh) {
  TouchingCells touching;
  JoinedCells cells(mesh);
  touching.points = points_of_several_sets(cells);
  touching.edges = edges_of_several_sets(cells);
  if (touching.points.empty()) return touching;

  std::vector<bool> several(mesh.points.size(), false), taken(mesh.points.size(), false);
  for (const std::uint32_t p : touching.points) several[p] = true;
  std::map<std::uint32_t, std::uint32_t> point_of_set;
  std::vector<std::uint32_t> nodes = mesh.nodes;
  for (std::uint32_t k = 0; k < nodes.size(); ++k) {
    const std::uint32_t p = mesh.nodes[k], set = cells.corners.set_of(k);
    if (!several[p]) continue;
    if (set == k) {
      if (taken[p]) {
        point_of_set[set] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(Eigen::Vector3d(mesh.points[p]));
        touching.copied.push_back(p);
      } else {
        point_of_set[set] = p;
        taken[p] = true;
      }
    }
    nodes[k] = point_of_set[set];
  }
  mesh.nodes = std::move(nodes);
  return touching;
}

std::string to_string(const TouchingCells& t, std::span<const std::uint32_t> place_of_point) {
  if (!t.any()) return "";
  const auto of_file = [&](std::uint32_t place) -> std::ptrdiff_t {
    if (place_of_point.empty()) return place;
    return std::find(place_of_point.begin(), place_of_point.end(), place) - place_of_point.begin();
  };
  const std::string points =
      first_three("point", t.points, [&](std::uint32_t p) { return fmt::format("{}", of_file(p)); });
  const std::string edges =
      first_three("edge", t.edges, [&](const Pair& e) { return fmt::format("{}-{}", of_file(e[0]), of_file(e[1])); });
  const bool both = !t.points.empty() && !t.edges.empty();
  return fmt::format(
      "cells touch at {}{}{} without sharing a face ({}{}{}); each is taken as the several vertices or edges that it is "
      "in the map: nothing holds the cells together there",
      t.points.empty() ? "" : counted(t.points.size(), "point"), both ? " and " : "",
      t.edges.empty() ? "" : counted(t.edges.size(), "edge"), points, both ? "; " : "", edges);
}

}  // namespace dartboard
