#pragma once
// Properties that a body must keep through every operation.

#include <gtest/gtest.h>

#include <numeric>

#include "core/mechanics/adapt.h"
#include "core/topology/check.h"
#include "core/walks/cell_arrays.h"

namespace dartboard {

// Numbers and cells must be in one-to-one correspondence, and the lowest darts known.
template <int i, class Map, class Index>
void expect_numbered(const Map& map, const Index& index, const std::vector<Dart>& dart_of) {
  std::size_t cells = 0;
  for_each_cell<i>(map, [&](Cell<i> cell) {
    const std::uint32_t number = index(map, cell.dart);
    ASSERT_LT(number, dart_of.size());
    ASSERT_EQ(dart_of[number], cell.dart);  // the coverage reports the lowest; so no two cells share a number either
    for_each_dart_of(map, cell, [&](Dart d) { ASSERT_EQ(index(map, d), number); });
    ++cells;
  });
  ASSERT_EQ(cells, dart_of.size());
}

/// The map is valid; numbers are dense and known to every dart; masses and springs are sums over the cells around; the
/// arrays equal rebuilt ones. For solids of fewer than 2^12 cells.
template <class Map>
void expect_consistent(const MassSpringBody<Map, Held::by_every_dart>& body, const CellArrays& arrays) {
  const Map& map = body.map;
  ASSERT_EQ(check(map), "");
  expect_numbered<0>(map, body.vertex, body.vertices.dart);
  expect_numbered<1>(map, body.edge, body.edge_dart);
  expect_numbered<2>(map, body.face, body.face_dart);
  expect_numbered<3>(map, body.cell, body.cell_dart);

  // Both sums add positive terms, at most 24 cells per vertex, fewer than 2^12 numbers in all: gamma_(2^12) u < 2^-40.
  const double by_vertex = std::accumulate(body.vertices.mass.begin(), body.vertices.mass.end(), 0.0);
  const double by_cell = std::accumulate(body.cell_mass.begin(), body.cell_mass.end(), 0.0);
  ASSERT_NEAR(by_vertex, by_cell, by_cell * 0x1p-40);
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) {
    ASSERT_EQ(body.vertices.mass[k], body.mass_of(Vertex{body.vertices.dart[k]}));
    ASSERT_EQ(body.vertices.inverse_mass[k], 1.0 / body.vertices.mass[k]);
    ASSERT_EQ(body.vertices.viscosity[k], body.material.viscosity * body.vertices.mass[k]);
  }
  for (std::uint32_t k = 0; k < body.springs.size(); ++k) {
    const Spring& s = body.springs[k];
    const Spring again = body.spring_of(Edge{body.edge_dart[k]}, s.rest_length);
    ASSERT_EQ(s.stiffness, again.stiffness);
    ASSERT_EQ(s.damping, again.damping);
  }
  CellArrays rebuilt;
  rebuilt.rebuild(body);
  ASSERT_TRUE(arrays == rebuilt);
}

}  // namespace dartboard
