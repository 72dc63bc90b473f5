// Stellar subdivision of the map, by counts and by refusals.

#include "core/operations/subdivide.h"

#include <gtest/gtest.h>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::subdivide_test {
namespace {

template <class Map>
std::array<std::size_t, 4> counts(const Map& map) {
  return {count_cells<0>(map), count_cells<1>(map), count_cells<2>(map), count_cells<3>(map)};
}

template <class Map>
struct Subdivide : testing::Test {
  Map box = build_map<Map>(kuhn_grid(2, 2, 2, 1.0)).map;
};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Subdivide, Solids);

// With p tetrahedra around the edge and q faces: one vertex, 1 + q edges, p + q faces and p tetrahedra more.
TYPED_TEST(Subdivide, AddsWhatAnEdgeMustAdd) {
  std::vector<Dart> edges;
  for_each_cell<1>(this->box, [&edges](Edge e) { edges.push_back(e.dart); });
  for (const Dart d : edges) {
    auto map = this->box;
    const std::size_t p = incident_cells<3>(map, Edge{d}).size(), q = incident_cells<2>(map, Edge{d}).size();
    const auto before = counts(map),
               expected = decltype(before){before[0] + 1, before[1] + 1 + q, before[2] + p + q, before[3] + p};
    subdivide(map, Edge{d});
    ASSERT_EQ(check(map), "");
    ASSERT_EQ(counts(map), expected);
  }
}

TYPED_TEST(Subdivide, AddsWhatAFaceMustAdd) {
  std::vector<Dart> faces;
  for_each_cell<2>(this->box, [&faces](Face f) { faces.push_back(f.dart); });
  for (const Dart d : faces) {
    auto map = this->box;
    const std::size_t p = map.template is_free<3>(d) ? 1 : 2;
    const auto before = counts(map),
               expected = decltype(before){before[0] + 1, before[1] + 3 + p, before[2] + 2 + 3 * p, before[3] + 2 * p};
    subdivide(map, Face{d});
    ASSERT_EQ(check(map), "");
    ASSERT_EQ(counts(map), expected);
  }
}

TYPED_TEST(Subdivide, AddsWhatATetrahedronMustAdd) {
  const auto before = counts(this->box),
             expected = decltype(before){before[0] + 1, before[1] + 4, before[2] + 6, before[3] + 3};
  const auto subdivision = subdivide(this->box, Volume{Dart{24}});
  EXPECT_EQ(check(this->box), "");
  EXPECT_EQ(counts(this->box), expected);
  EXPECT_EQ(incident_cells<3>(this->box, Vertex{subdivision.vertex()}).size(), 4u);
}

TYPED_TEST(Subdivide, IsUndoneByTheJournal) {
  Journal journal;
  const auto before = this->box.hash();
  this->box.attach(&journal);
  subdivide(this->box, Edge{Dart{30}});
  subdivide(this->box, Volume{Dart{24 * 47}});
  journal.undo(this->box, 0);
  EXPECT_EQ(this->box.hash(), before);
}

TYPED_TEST(Subdivide, RefusesADeadDart) {
  const Dart first{0};
  for (std::uint32_t face = 0; face < 4; ++face) unsew<3>(this->box, Dart{6 * face});
  remove_cell(this->box, first);
  const auto before = this->box.hash();
  EXPECT_THROW(subdivide(this->box, Edge{first}), TopologyError);
  EXPECT_EQ(this->box.hash(), before);
}

TYPED_TEST(Subdivide, RefusesATetrahedronThatMeetsTheEdgeTwice) {
  TypeParam folded;
  const Dart d = add_cell(folded, CellKind::tetrahedron);
  sew<3>(folded, d, folded.template alpha<2>(d));  // two of its faces, folded about the edge between them
  const auto before = folded.hash();
  bool refused = false;
  for (std::uint32_t p = 0; p < 24; ++p) {
    try {
      auto copy = folded;
      subdivide(copy, Edge{Dart{p}});
    } catch (const TopologyError&) {
      refused = true;
    }
  }
  EXPECT_TRUE(refused);
  EXPECT_EQ(folded.hash(), before);
}

TEST(SubdivideHexahedra, IsRefused) {
  Map3 map;
  const Dart d = add_cell(map, CellKind::hexahedron);
  EXPECT_THROW(subdivide(map, Volume{d}), TopologyError);
  EXPECT_THROW(subdivide(map, Edge{d}), TopologyError);
}

}  // namespace
}  // namespace dartboard::subdivide_test
