#include "core/meshes/touching.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/counted.h"
#include "core/base/disjoint_sets.h"

namespace dartboard {
namespace {

using Pair = std::array<std::uint32_t, 2>;

Pair ascending(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of all cells, one after the other.
struct CellEdges {
  std::vector<Pair> ends;               // ascending points
  std::vector<std::uint32_t> first{0};  // by cell

  explicit CellEdges(const Mesh& mesh) {
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto node = mesh.cell(c);
      const auto begin = static_cast<std::ptrdiff_t>(ends.size());
      for (const std::vector<int>& cycle : faces_of(mesh.kinds[c]))
        for (std::size_t k = 0; k < cycle.size(); ++k) {
          const Pair edge = ascending(node[static_cast<std::size_t>(cycle[k])],
                                      node[static_cast<std::size_t>(cycle[(k + 1) % cycle.size()])]);
          if (std::find(ends.begin() + begin, ends.end(), edge) == ends.end()) ends.push_back(edge);
        }
      first.push_back(static_cast<std::uint32_t>(ends.size()));
    }
  }
  std::uint32_t number(std::uint32_t cell, const Pair& edge) const {
    std::uint32_t k = first[cell];
    while (ends[k] != edge) ++k;
    return k;
  }
};

/// A facet that joins cells: a face of volumes or an edge of polygons, as the cycle of its points.
struct Facet {
  std::array<std::uint32_t, 4> key;  // its points, ascending
  std::array<std::uint32_t, 4> cycle;
  std::uint32_t corners, cell;
};

std::vector<Facet> facets_by_points(const Mesh& mesh) {
  std::vector<Facet> facets;
  const auto add = [&facets](std::uint32_t cell, std::initializer_list<std::uint32_t> points) {
    Facet f{{~0u, ~0u, ~0u, ~0u}, {}, static_cast<std::uint32_t>(points.size()), cell};
    std::copy(points.begin(), points.end(), f.key.begin());
    f.cycle = f.key;
    std::sort(f.key.begin(), f.key.end());
    facets.push_back(f);
  };
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const auto node = mesh.cell(c);
    const bool solid = dimension(mesh.kinds[c]) == 3;
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      const auto at = [&](std::size_t k) { return node[static_cast<std::size_t>(cycle[k % cycle.size()])]; };
      if (!solid)
        for (std::size_t k = 0; k < cycle.size(); ++k) add(c, {at(k), at(k + 1)});
      else if (cycle.size() == 3)
        add(c, {at(0), at(1), at(2)});
      else
        add(c, {at(0), at(1), at(2), at(3)});
    }
  }
  std::sort(facets.begin(), facets.end(),
            [](const Facet& a, const Facet& b) { return a.key != b.key ? a.key < b.key : a.cell < b.cell; });
  return facets;
}

std::uint32_t corner_of(const Mesh& mesh, std::uint32_t cell, std::uint32_t point) {
  std::uint32_t k = mesh.first[cell];
  while (mesh.nodes[k] != point) ++k;
  return k;
}

/// The values, ascending, that belong to more than one set.
template <class Value>
std::vector<Value> of_several_sets(const std::vector<Value>& values, DisjointSets& sets) {
  std::vector<std::pair<Value, std::uint32_t>> pairs;
  for (std::uint32_t k = 0; k < values.size(); ++k)
    if (sets.set_of(k) == k) pairs.push_back({values[k], k});
  std::sort(pairs.begin(), pairs.end());
  std::vector<Value> several;
  for (std::size_t k = 1; k < pairs.size(); ++k)
    if (pairs[k].first == pairs[k - 1].first && (several.empty() || several.back() != pairs[k].first))
      several.push_back(pairs[k].first);
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
  const CellEdges edges(mesh);
  DisjointSets corners(mesh.nodes.size()), sides(edges.ends.size());
  const std::vector<Facet> facets = facets_by_points(mesh);
  for (std::size_t k = 1; k < facets.size(); ++k) {
    const Facet &a = facets[k - 1], &b = facets[k];
    if (a.key != b.key) continue;
    for (std::uint32_t j = 0; j < a.corners; ++j) {
      const std::uint32_t p = a.cycle[j], q = a.cycle[(j + 1) % a.corners];
      corners.join(corner_of(mesh, a.cell, p), corner_of(mesh, b.cell, p));
      const Pair edge = ascending(p, q);
      sides.join(edges.number(a.cell, edge), edges.number(b.cell, edge));
    }
  }
  touching.points = of_several_sets(mesh.nodes, corners);
  touching.edges = of_several_sets(edges.ends, sides);
  if (touching.points.empty()) return touching;

  std::vector<bool> several(mesh.points.size(), false), taken(mesh.points.size(), false);
  for (const std::uint32_t p : touching.points) several[p] = true;
  std::map<std::uint32_t, std::uint32_t> point_of_set;
  std::vector<std::uint32_t> nodes = mesh.nodes;
  for (std::uint32_t k = 0; k < nodes.size(); ++k) {
    const std::uint32_t p = mesh.nodes[k], set = corners.set_of(k);
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
