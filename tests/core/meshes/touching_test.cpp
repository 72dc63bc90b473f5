// Cells that touch without sharing a face: the places found, and that the map of the split mesh has a vertex for each
// point.

#include "core/meshes/touching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include "core/meshes/generators/mesh_generators.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "tests/support/meshes/random_cells.h"

namespace dartboard::touching_test {
namespace {

using Numbers = std::vector<std::uint32_t>;
using Edges = std::vector<std::array<std::uint32_t, 2>>;

Mesh tetrahedra(std::size_t points, std::initializer_list<std::array<std::uint32_t, 4>> cells) {
  Mesh mesh;
  // on the moment curve, where any four points are the corners of a tetrahedron
  for (std::size_t p = 0; p < points; ++p) {
    const auto t = static_cast<double>(p);
    mesh.points.emplace_back(t, t * t, t * t * t);
  }
  for (const auto& cell : cells) mesh.add_cell(CellKind::tetrahedron, cell);
  return mesh;
}

template <class Map>
std::size_t vertices_of(const Mesh& mesh) {
  std::size_t count = 0;
  const auto built = build_map<Map>(mesh);
  for_each_cell<0>(built.map, [&count](Vertex) { ++count; });
  return count;
}

TEST(TouchingCells, AreNoneWhereAllCellsAreJoinedByFaces) {
  for (const Mesh& sound : {kuhn_box(2, 2, 2, 1.0), mixed_box(2, 1, 1, 1.0), triangle_sheet(3, 2, 1.0)}) {
    Mesh mesh = sound;
    EXPECT_FALSE(split_touching_points(mesh).any());
    EXPECT_EQ(mesh.nodes, sound.nodes);
    EXPECT_EQ(mesh.points, sound.points);
  }
}

TEST(TouchingCells, AtAPointGetOneEach) {
  Mesh mesh = tetrahedra(7, {{0, 1, 2, 3}, {3, 4, 5, 6}});
  const TouchingCells touching = split_touching_points(mesh);
  EXPECT_EQ(touching.points, (Numbers{3}));
  EXPECT_TRUE(touching.edges.empty());
  EXPECT_EQ(touching.copied, (Numbers{3}));
  EXPECT_EQ(mesh.nodes, (Numbers{0, 1, 2, 3, 7, 4, 5, 6}));
  EXPECT_EQ(mesh.points.at(7), mesh.points.at(3));
}

TEST(TouchingCells, AtAnEdgeGetTwoPointsEach) {
  Mesh mesh = tetrahedra(6, {{0, 1, 2, 3}, {2, 3, 4, 5}});
  const TouchingCells touching = split_touching_points(mesh);
  EXPECT_EQ(touching.points, (Numbers{2, 3}));
  EXPECT_EQ(touching.edges, (Edges{{2, 3}}));
  EXPECT_EQ(touching.copied, (Numbers{2, 3}));
  EXPECT_EQ(mesh.nodes, (Numbers{0, 1, 2, 3, 6, 7, 4, 5}));
}

TEST(TouchingCells, ThreeAtAPointGetThree) {
  Mesh mesh = tetrahedra(10, {{0, 1, 2, 3}, {0, 4, 5, 6}, {0, 7, 8, 9}});
  EXPECT_EQ(split_touching_points(mesh).copied, (Numbers{0, 0}));
  EXPECT_EQ(vertices_of<TetMap>(mesh), mesh.points.size());
}

// Cells are joined around points 0 and 1 by ways of their own, but not around the edge between them: A and B have it,
// the chain of cells at each end goes round it.
TEST(TouchingCells, AtAnEdgeWhoseEndsAreOneVertexEachStayTwoEdges) {
  Mesh mesh = tetrahedra(6, {{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 2, 3, 4}, {0, 3, 4, 5}, {1, 2, 3, 5}, {1, 2, 4, 5}});
  const Mesh before = mesh;
  const TouchingCells touching = split_touching_points(mesh);
  EXPECT_TRUE(touching.points.empty());
  // and where the two chains touch each other
  EXPECT_EQ(touching.edges, (Edges{{0, 1}, {2, 4}, {3, 5}}));
  EXPECT_EQ(mesh.nodes, before.nodes);
  const auto built = build_map<TetMap>(mesh);
  std::size_t edges_between = 0;
  for_each_cell<1>(built.map, [&](Edge e) {
    const auto point = [&](Dart d) { return built.point[TetMap::slot<0>(d)]; };
    edges_between += point(e.dart) + point(built.map.alpha<0>(e.dart)) == 1;
  });
  EXPECT_EQ(edges_between, 2u);
}

TEST(TouchingCells, OfASurfaceAreJoinedByEdges) {
  Mesh mesh;
  for (int p = 0; p < 5; ++p) mesh.points.emplace_back(p, p * p, 0);
  for (const auto& triangle : {std::array<std::uint32_t, 3>{0, 1, 2}, std::array<std::uint32_t, 3>{2, 3, 4}})
    mesh.add_cell(CellKind::triangle, triangle);
  EXPECT_EQ(split_touching_points(mesh).points, (Numbers{2}));
  EXPECT_EQ(vertices_of<Map2>(mesh), 6u);
}

TEST(TouchingCells, OfRandomPiecesOfABoxBecomeAVertexForEachPoint) {
  const Mesh box = kuhn_box(3, 3, 3, 1.0);
  for (std::uint32_t part = 2; part < 8; ++part) {
    Mesh mesh;
    mesh.points = box.points;
    // every part-th cell, scattered by a step that shares no factor with their number
    for (std::size_t k = 0; k < box.cell_count() / part; ++k)
      mesh.add_cell(CellKind::tetrahedron, box.cell(k * 61 % box.cell_count()));
    std::vector<bool> used(mesh.points.size(), false);
    for (const std::uint32_t p : mesh.nodes) used[p] = true;
    const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    split_touching_points(mesh);
    EXPECT_EQ(vertices_of<TetMap>(mesh), mesh.points.size() - unused) << part;
  }
}

TEST(TouchingCells, AreToldByTheNumbersOfTheFile) {
  Mesh mesh = tetrahedra(6, {{0, 1, 2, 3}, {2, 3, 4, 5}});
  const TouchingCells touching = split_touching_points(mesh);
  const Numbers place{0, 0xFFFFFFFF, 1, 2, 3, 4, 5};  // point 1 of the file has no cell
  EXPECT_EQ(to_string(touching, place)
                .find("cells touch at 2 points and 1 edge without sharing a face (points 3, 4; edge "
                      "3-4); "),
            0u)
      << to_string(touching, place);
  EXPECT_EQ(to_string(TouchingCells{}, place), "");
  // no point of the file was dropped
  EXPECT_NE(to_string(touching, {}).find("(points 2, 3; edge 2-3)"), std::string::npos) << to_string(touching, {});
}

// Three are named, of more the first three; points and edges only where there are some.
TEST(TouchingCells, AreNamedInWordsUpToThree) {
  TouchingCells touching;
  touching.edges = {{0, 1}, {1, 2}, {2, 3}};
  EXPECT_EQ(to_string(touching, {}).find("cells touch at 3 edges without sharing a face (edges 0-1, 1-2, 2-3); each"),
            0u)
      << to_string(touching, {});
  touching.edges.push_back({3, 4});
  EXPECT_EQ(
      to_string(touching, {}).find("cells touch at 4 edges without sharing a face (edges 0-1, 1-2, 2-3, ...); each"),
      0u)
      << to_string(touching, {});
  TouchingCells at_point;
  at_point.points = {7};
  EXPECT_EQ(to_string(at_point, {}).find("cells touch at 1 point without sharing a face (point 7); each"), 0u)
      << to_string(at_point, {});
}

/// The points and edges that are several vertices or edges of the map of a mesh.
template <class Map>
void expect_touching_as_in_the_map(const Mesh& mesh) {
  const auto built = build_map<Map>(mesh);
  const auto point = [&built](Dart d) { return built.point[Map::template slot<0>(d)]; };
  std::map<std::uint32_t, int> vertices;
  std::map<std::array<std::uint32_t, 2>, int> edges;
  for_each_cell<0>(built.map, [&](Vertex v) { ++vertices[point(v.dart)]; });
  for_each_cell<1>(built.map, [&](Edge e) {
    const std::uint32_t a = point(e.dart), b = point(built.map.template alpha<0>(e.dart));
    ++edges[{std::min(a, b), std::max(a, b)}];
  });
  TouchingCells expected;
  for (const auto& [p, count] : vertices)
    if (count > 1) expected.points.push_back(p);
  for (const auto& [e, count] : edges)
    if (count > 1) expected.edges.push_back(e);
  std::size_t copies = 0;
  for (const auto& [p, count] : vertices) copies += static_cast<std::size_t>(count - 1);
  Mesh split = mesh;
  const TouchingCells found = split_touching_points(split);
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.edges, expected.edges);
  EXPECT_EQ(found.copied.size(), copies);
  EXPECT_EQ(split.points.size(), mesh.points.size() + copies);
  // the lowest cell at a point keeps it
  std::vector<bool> met(mesh.points.size(), false);
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    EXPECT_TRUE(met[mesh.nodes[k]] || split.nodes[k] == mesh.nodes[k]);
    met[mesh.nodes[k]] = true;
  }
}

TEST(TouchingCells, AreThoseOfTheMap) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const double share = 0.15 + 0.08 * seed;
    expect_touching_as_in_the_map<TetMap>(random_cells_of(kuhn_box(3, 3, 2, 1.0), share, seed));
    expect_touching_as_in_the_map<Map3>(random_cells_of(hexahedron_box(3, 3, 3, 1.0), share, seed));
    expect_touching_as_in_the_map<Map3>(random_cells_of(mixed_box(3, 2, 2, 1.0), share, seed));
    expect_touching_as_in_the_map<Map2>(random_cells_of(triangle_sheet(4, 4, 1.0), share, seed));
  }
}

// Two corners of the second cube are swapped: the face between them has the same points, but other edges.
TEST(TouchingCells, MayBeCrossed) {
  Mesh mesh = hexahedron_box(2, 1, 1, 1.0);
  const auto face = [&mesh](std::size_t c) {
    return std::set<std::uint32_t>(mesh.cell(c).begin(), mesh.cell(c).end());
  };
  std::vector<std::uint32_t> shared;
  std::ranges::set_intersection(face(0), face(1), std::back_inserter(shared));
  ASSERT_EQ(shared.size(), 4u);
  const auto second = mesh.nodes.begin() + mesh.first[1];
  std::swap(*std::find(second, mesh.nodes.end(), shared[0]), *std::find(second, mesh.nodes.end(), shared[1]));
  const std::vector<std::uint32_t> nodes = mesh.nodes;
  const TouchingCells found = split_touching_points(mesh);
  EXPECT_TRUE(found.points.empty());
  EXPECT_EQ(mesh.nodes, nodes);
}

}  // namespace
}  // namespace dartboard::touching_test
