#include "core/operations/remove_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "core/mechanics/adapt.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "core/topology/summary.h"
#include "core/walks/cell_arrays.h"

namespace dartboard::remove_face_test {
namespace {

using Body = MassSpringBody<Map2, Held::by_every_dart>;
using Counts = std::vector<std::size_t>;

TEST(RemoveFace, OfTheOnlyOneLeavesNothing) {
  auto map = build_map<Map2>(quad_sheet(1, 1, 1.0)).map;
  const TopologyChange change = remove_face(map, Dart{5});
  EXPECT_EQ(map.dart_count(), 0u);
  EXPECT_EQ(change.removed_vertices.size(), 4u);
  EXPECT_EQ(change.removed_edges.size(), 4u);
  EXPECT_EQ(change.removed_faces, std::vector<Dart>{Dart{5}});
  EXPECT_TRUE(change.vertices.empty() && change.edges.empty() && change.faces.empty());
}

TEST(RemoveFace, LeavesTheNeighbourWholeAndItsEdgeOnTheBoundary) {
  auto map = build_map<Map2>(quad_sheet(2, 1, 1.0)).map;
  const TopologyChange change = remove_face(map, Dart{8});  // the second face: eight darts each
  EXPECT_EQ(change.vertices.size(), 2u);
  EXPECT_EQ(change.edges.size(), 1u);
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.cells, (Counts{4, 4, 1}));
  EXPECT_EQ(s.boundary_facets, 4u);
  EXPECT_EQ(s.violation, "");
}

TEST(RemoveFace, LetsTheNeighboursKeep) {
  auto map = build_map<Map2>(triangle_sheet(2, 2, 1.0)).map;
  const TopologyChange change = remove_face(map, Dart{6});
  ASSERT_FALSE(change.edges.empty());
  for (const auto& pairs : {change.vertices, change.edges})
    for (const DissociatedCell& pair : pairs) EXPECT_TRUE(map.is_live(pair.kept));
}

TEST(RemoveFace, InTheMiddleLeavesAHole) {
  auto map = build_map<Map2>(quad_sheet(3, 3, 1.0)).map;
  remove_face(map, Dart{4 * 8});
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.cells, (Counts{16, 24, 8}));
  EXPECT_EQ(s.boundary_facets, 12u + 4u);
  EXPECT_EQ(s.euler, 0);  // an annulus
}

// A hole in a closed surface takes 1 from its Euler characteristic, 0 here; it cannot be oriented with the hole either.
TEST(RemoveFace, OfAKleinBottleLeavesItWithoutOrientation) {
  auto map = build_map<Map2>(klein_bottle(5, 4)).map;
  remove_face(map, Dart{0});
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.euler, -1);
  EXPECT_EQ(s.boundary_facets, 4u);
  EXPECT_FALSE(s.orientable);
  EXPECT_EQ(s.violation, "");
}

TEST(RemoveFace, OfAMoebiusStripLeavesAStripWithTwoSides) {
  auto map = build_map<Map2>(moebius_strip(7)).map;
  ASSERT_FALSE(summarize(map).orientable);
  remove_face(map, Dart{16});
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.cells, (Counts{14, 19, 6}));
  EXPECT_EQ(s.euler, 1);
  EXPECT_TRUE(s.orientable);
}

TEST(RemoveFace, SewnToItselfHasNoNeighbour) {
  auto map = build_map<Map2>(quad_sheet(1, 1, 1.0)).map;
  sew<2>(map, Dart{0}, Dart{5});  // opposite edges: a tube
  ASSERT_EQ(summarize(map).cells, (Counts{2, 3, 1}));
  const TopologyChange change = remove_face(map, Dart{0});
  EXPECT_EQ(map.dart_count(), 0u);
  EXPECT_EQ(change.removed_vertices.size(), 4u);
  EXPECT_EQ(change.edges.size(), 1u);
}

TEST(RemoveFace, OfADeadDartIsRefusedAndTheMapUnchanged) {
  auto map = build_map<Map2>(quad_sheet(2, 1, 1.0)).map;
  remove_face(map, Dart{0});
  const auto before = map.hash();
  EXPECT_THROW(remove_face(map, Dart{0}), TopologyError);
  EXPECT_EQ(map.hash(), before);
}

// ---- the body follows

template <int i, class Index>
void expect_numbered(const Map2& map, const Index& index, const std::vector<Dart>& dart_of) {
  std::size_t cells = 0;
  for_each_cell<i>(map, [&](Cell<i> cell) {
    const std::uint32_t number = index(map, cell.dart);
    ASSERT_LT(number, dart_of.size());
    ASSERT_EQ(dart_of[number], cell.dart);
    for_each_dart_of(map, cell, [&](Dart d) { ASSERT_EQ(index(map, d), number); });
    ++cells;
  });
  ASSERT_EQ(cells, dart_of.size());
}

void expect_consistent(const Body& body, const CellArrays& arrays) {
  ASSERT_EQ(check(body.map), "");
  expect_numbered<0>(body.map, body.vertex, body.vertices.dart);
  expect_numbered<1>(body.map, body.edge, body.edge_dart);
  expect_numbered<2>(body.map, body.cell, body.cell_dart);
  // Positive terms, each shared by at most 8 faces and fewer than 2^10 numbers in all: gamma_(2^10) u < 2^-42.
  const double by_vertex = std::accumulate(body.vertices.mass.begin(), body.vertices.mass.end(), 0.0);
  const double by_cell = std::accumulate(body.cell_mass.begin(), body.cell_mass.end(), 0.0);
  ASSERT_NEAR(by_vertex, by_cell, by_cell * 0x1p-42);
  double stiffness = 0.0, expected = 0.0;  // stiffness 4: exact
  for (const Spring& s : body.springs) stiffness += s.stiffness;
  for (const Dart d : body.cell_dart) expected += 4.0 * static_cast<double>(orbit<0, 1>(body.map, d).size() / 2);
  ASSERT_EQ(stiffness, expected);
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
    ASSERT_EQ(body.vertices.mass[k], body.mass_of(Vertex{body.vertices.dart[k]}));
  CellArrays rebuilt;
  rebuilt.rebuild(body);
  ASSERT_TRUE(arrays == rebuilt);
}

struct Surface {
  const char* name;
  Mesh (*make)();
};
void PrintTo(const Surface& surface, std::ostream* out) { *out << surface.name; }

class RemoveFaceOfABody : public testing::TestWithParam<Surface> {};

Problem problem_of(const Mesh& mesh) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 2.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  return problem;
}

TEST_P(RemoveFaceOfABody, StaysConsistentUntilNothingIsLeft) {
  Body body = build_body<Map2, Held::by_every_dart>(problem_of(GetParam().make()));
  CellArrays arrays;
  arrays.rebuild(body);
  std::uint32_t state = 1;
  for (std::size_t faces = body.cell_mass.size(); faces > 0;) {
    state = state * 1664525u + 1013904223u;
    const Dart d{static_cast<std::uint32_t>((static_cast<std::uint64_t>(state) * body.map.capacity()) >> 32)};
    if (!body.map.is_live(d)) continue;
    arrays.apply(body, adapt(body, remove_face(body.map, d)));
    ASSERT_EQ(body.cell_mass.size(), --faces);
    expect_consistent(body, arrays);
    if (HasFatalFailure()) FAIL() << faces << " faces left";
  }
  EXPECT_EQ(body.map.dart_count(), 0u);
  EXPECT_EQ(body.vertices.size(), 0u);
  EXPECT_EQ(body.springs.size(), 0u);
}

TEST_P(RemoveFaceOfABody, TakesAwayExactlyTheRemovedMass) {
  Body body = build_body<Map2, Held::by_every_dart>(problem_of(GetParam().make()));
  const auto total = [&] { return std::accumulate(body.vertices.mass.begin(), body.vertices.mass.end(), 0.0); };
  const double before = total(), removed = body.cell_mass[body.cell(body.map, Dart{0})];
  adapt(body, remove_face(body.map, Dart{0}));
  EXPECT_NEAR(total(), before - removed, before * 0x1p-42);  // as in expect_consistent
}

INSTANTIATE_TEST_SUITE_P(Surfaces, RemoveFaceOfABody,
                         testing::Values(Surface{"triangles", [] { return triangle_sheet(4, 3, 0.5); }},
                                         Surface{"quadrilaterals", [] { return quad_sheet(4, 4, 0.5); }},
                                         Surface{"torus", [] { return torus_surface(4, 3); }},
                                         Surface{"moebius", [] { return moebius_strip(5); }},
                                         Surface{"klein", [] { return klein_bottle(4, 3); }},
                                         Surface{"sphere", [] { return octasphere(1); }}),
                         [](const auto& surface) { return std::string(surface.param.name); });

// Two faces joined at a vertex only by the removed one: both must get numbers of their own.
TEST(RemoveFaceOfASheet, SeparatesTheFacesThatItHeldTogether) {
  Body body = build_body<Map2, Held::by_every_dart>(problem_of(quad_sheet(3, 1, 1.0)));
  adapt(body, remove_face(body.map, Dart{8}));
  EXPECT_EQ(body.vertices.size(), 8u);
  EXPECT_EQ(body.springs.size(), 8u);
  for (const double m : body.vertices.mass) EXPECT_EQ(m, 0.5);  // a quarter of 2 kg
  EXPECT_EQ(components(body.map).count, 2u);
}

}  // namespace
}  // namespace dartboard::remove_face_test
