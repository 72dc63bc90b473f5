#include "core/views/boundary_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::boundary_surface_test {
namespace {

template <class Body>
BoundarySurface boundary_of(const Body& body) {
  BoundarySurface surface;
  surface.rebuild(body);
  return surface;
}

template <class Body>
Eigen::Vector3d sum_of_area_vectors(const BoundarySurface& surface, const Body& body) {
  Eigen::Vector3d sum(0, 0, 0);
  for (const BoundaryFacet& facet : surface.facets()) sum += surface.area_vector(body, facet);
  return sum;
}

// The divergence theorem for the field x/3; faces must be plane.
template <class Body>
double enclosed_volume(const BoundarySurface& surface, const Body& body) {
  double volume = 0.0;
  for (const BoundaryFacet& facet : surface.facets())
    volume += body.vertices.position[surface.corners(body, facet)[0]].dot(surface.area_vector(body, facet)) / 3.0;
  return volume;
}

template <class Body>
double volume_of_cells(const Body& body) {
  return std::accumulate(body.cell_mass.begin(), body.cell_mass.end(), 0.0) / body.material.density;
}

// From the map alone: the facets are those that are free, and their darts the lowest of the orientation given.
template <class Body>
void expect_rebuilt(const BoundarySurface& view, const Body& body) {
  ASSERT_EQ(view, boundary_of(body));
  constexpr int n = Body::dimension;
  std::size_t on_boundary = 0;
  for_each_cell<n - 1>(body.map, [&](Cell<n - 1> facet) {
    std::uint32_t number = 0;
    if constexpr (n == 3)
      number = body.face(body.map, facet.dart);
    else
      number = body.edge(body.map, facet.dart);
    const std::uint32_t place = view.place(number);
    const bool free = body.map.template is_free<n>(facet.dart);
    ASSERT_EQ(place != BoundarySurface::no_place, free);
    if (!free) return;
    ++on_boundary;
    const BoundaryFacet entry = view.facets()[place];
    ASSERT_EQ(entry.number, number);
    ASSERT_TRUE(entry.dart == facet.dart || entry.dart == body.map.template alpha<0>(facet.dart));
  });
  ASSERT_EQ(view.facets().size(), on_boundary);
}

template <class Map>
struct BoundaryOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(BoundaryOf, Solids);

// A regular tetrahedron of edge 2 sqrt(2) around the origin: each face has the area 2 sqrt(3) and looks away from it.
TYPED_TEST(BoundaryOf, OneTetrahedronLooksOutwards) {
  for (const bool left_handed : {false, true}) {
    const auto body =
        body_of<TypeParam>(left_handed ? with_left_handed_cells(regular_tetrahedron()) : regular_tetrahedron());
    EXPECT_EQ(body.cell_inside_out[0], left_handed ? 1 : 0);
    const BoundarySurface surface = boundary_of(body);
    ASSERT_EQ(surface.facets().size(), 4u);
    for (const BoundaryFacet& facet : surface.facets()) {
      const auto corner = surface.corners(body, facet);
      ASSERT_EQ(corner.size(), 3u);
      const auto& x = body.vertices.position;
      // The corners are +-1: cross products and halves of them are exact.
      EXPECT_EQ(surface.area_vector(body, facet), 2.0 * (x[corner[0]] + x[corner[1]] + x[corner[2]]));
      // one square root, one quotient: a unit vector to 2^-51
      EXPECT_NEAR(surface.unit_normal(body, facet).norm(), 1.0, 0x1p-51);
      EXPECT_GT(surface.unit_normal(body, facet).dot(x[corner[0]]), 0.0);
    }
  }
}

// Powers of two: all areas, volumes and sums but the division by 3 are exact; at most 2^8 terms of at most 2^2 each
// make an error below 2^8 * 2^2 * 2^-52 * 2^8.
TYPED_TEST(BoundaryOf, ABoxIsClosedAndOfItsAreaAndVolume) {
  for (const bool left_handed : {false, true}) {
    const Mesh mesh = kuhn_grid(4, 2, 1, 0.5);
    const auto body = body_of<TypeParam>(left_handed ? with_left_handed_cells(mesh) : mesh);
    const BoundarySurface surface = boundary_of(body);
    EXPECT_EQ(surface.facets().size(), 2u * 2u * (4u * 2u + 2u * 1u + 4u * 1u));
    EXPECT_EQ(surface.total_measure(body), 2.0 * (2.0 * 1.0 + 1.0 * 0.5 + 2.0 * 0.5));
    EXPECT_EQ(sum_of_area_vectors(surface, body), Eigen::Vector3d(0, 0, 0));
    EXPECT_NEAR(enclosed_volume(surface, body), 2.0 * 1.0 * 0.5, 0x1p-34);
  }
}

TEST(BoundaryOfHexahedra, IsClosedAndOfItsAreaAndVolume) {
  const auto body = body_of<Map3>(hexahedron_box(4, 2, 1, 0.5));
  const BoundarySurface surface = boundary_of(body);
  EXPECT_EQ(surface.facets().size(), 2u * (4u * 2u + 2u * 1u + 4u * 1u));
  for (const BoundaryFacet& facet : surface.facets()) EXPECT_EQ(surface.corners(body, facet).size(), 4u);
  EXPECT_EQ(surface.total_measure(body), 7.0);
  EXPECT_EQ(sum_of_area_vectors(surface, body), Eigen::Vector3d(0, 0, 0));
  EXPECT_NEAR(enclosed_volume(surface, body), 1.0, 0x1p-34);
}

// A unit cube, a pyramid of height 1 on it, half a unit cube at its side and a tetrahedron.
TEST(BoundaryOfMixedCells, EnclosesTheSumOfTheirVolumes) {
  const auto body = body_of<Map3>(mixed_cells());
  const BoundarySurface surface = boundary_of(body);
  // fewer than 2^5 faces of coordinates and areas of at most 2^2
  EXPECT_NEAR(enclosed_volume(surface, body), volume_of_cells(body), 0x1p-40);
  EXPECT_LE(sum_of_area_vectors(surface, body).norm(), 0x1p-42);
}

// The boundary stays closed through all cuts, and encloses the remaining cells. With jitter, each of the fewer than 2^9
// faces of the 2^7 cells has an area below 2^-4 with an error below 2^3 u of it, and sums of 2^9 of these have one
// below 2^9 u of their 2^5: below 2^-38 in all. Positions are below 1.
TYPED_TEST(BoundaryOf, ACutBodyEnclosesWhatIsLeftOfIt) {
  auto body = body_of<TypeParam>(with_left_handed_cells(kuhn_grid(3, 2, 2, 0.25, 0.1, 3)));
  BoundarySurface surface = boundary_of(body);
  const double area = surface.total_measure(body);
  operate_at_random(body, 5, 60, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
    surface.apply(now, changed);
    ASSERT_LE(sum_of_area_vectors(surface, now).norm(), 0x1p-38);
    ASSERT_NEAR(enclosed_volume(surface, now), volume_of_cells(now), 0x1p-38);
    if (now.cell_mass.size() == 72) {
      ASSERT_GE(surface.total_measure(now), area * (1.0 - 0x1p-38));
    }
  });
}

TYPED_TEST(BoundaryOf, ABodyFollowsEveryOperationUntilNothingIsLeft) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    auto body = body_of<TypeParam>(with_left_handed_cells(kuhn_grid(3, 2, 2, 0.125)));
    BoundarySurface surface = boundary_of(body);
    operate_at_random(body, seed, seed == 1 ? 150 : 20,
                      [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
                        surface.apply(now, changed);
                        expect_rebuilt(surface, now);
                      });
    EXPECT_TRUE(surface.facets().empty());
  }
}

TEST(BoundaryOfHexahedra, FollowsEveryOperationUntilNothingIsLeft) {
  auto body = body_of<Map3>(hexahedron_box(3, 2, 2, 1.0));
  BoundarySurface surface = boundary_of(body);
  operate_at_random(body, 1, 30, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
    surface.apply(now, changed);
    expect_rebuilt(surface, now);
  });
  EXPECT_TRUE(surface.facets().empty());
}

// The same number of faces, one of which has come to the boundary; and all of them turned round.
TYPED_TEST(BoundaryOf, ABodyIsNotThatOfAnotherOne) {
  auto body = body_of<TypeParam>(unequal_tetrahedra());
  const BoundarySurface surface = boundary_of(body);
  EXPECT_EQ(surface, boundary_of(body));
  auto turned = body;
  for (auto& inside_out : turned.cell_inside_out) inside_out = 1 - inside_out;
  EXPECT_FALSE(surface == boundary_of(turned));
  Dart shared = no_dart;
  body.map.for_each_dart([&](Dart d) {
    if (!body.map.template is_free<3>(d)) shared = d;
  });
  unsew<3>(body.map, shared);  // and no new number for the other side
  const BoundarySurface more = boundary_of(body);
  EXPECT_EQ(more.facets().size(), surface.facets().size() + 1);
  EXPECT_FALSE(surface == more);
  EXPECT_FALSE(more == surface);
}

TYPED_TEST(BoundaryOf, TwoTetrahedraGrowsByTheTwoSidesOfTheirFace) {
  auto body = body_of<TypeParam>(unequal_tetrahedra());
  BoundarySurface surface = boundary_of(body);
  EXPECT_EQ(surface.facets().size(), 6u);
  Dart shared = no_dart;
  body.map.for_each_dart([&](Dart d) {
    if (!body.map.template is_free<3>(d)) shared = d;
  });
  const double before = surface.total_measure(body);
  surface.apply(body, adapt(body, dissociate_face(body.map, shared)));
  EXPECT_EQ(surface.facets().size(), 8u);
  // twice the triangle 0 1 2 of area 1/2; eight areas below 2
  EXPECT_NEAR(surface.total_measure(body), before + 1.0, 0x1p-48);
}

TEST(BoundaryOfASheet, RunsAroundItTheWayOfItsFaces) {
  const auto body = body_of<Map2>(quadrilateral_grid(4, 3));
  const BoundarySurface surface = boundary_of(body);
  ASSERT_EQ(surface.facets().size(), 14u);
  Eigen::Vector3d around(0, 0, 0), twice_area(0, 0, 0), along(0, 0, 0);
  for (const BoundaryFacet& facet : surface.facets()) {
    const auto corner = surface.corners(body, facet);
    ASSERT_EQ(corner.size(), 2u);
    around += surface.edge_vector(body, facet);
    along += body.vertices.position[corner[0]].cross(surface.edge_vector(body, facet));
    twice_area += body.vertices.position[corner[0]].cross(body.vertices.position[corner[1]]);
  }
  // coordinates are multiples of 1/8: exact
  EXPECT_EQ(around, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(twice_area[2], 2.0 * 4.0 * 3.0);  // counter-clockwise seen from above, as its faces are
  EXPECT_EQ(along, twice_area);
}

TEST(BoundaryOfASheet, IsMeasuredInMetres) {
  Mesh square;
  square.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  square.add_cell(CellKind::quadrilateral, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  const auto body = body_of<Map2>(square);
  EXPECT_EQ(boundary_of(body).total_measure(body), 6.0);
}

TEST(BoundaryOfASurface, FollowsEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : surfaces()) {
    auto body = body_of<Map2>(mesh);
    BoundarySurface surface = boundary_of(body);
    operate_at_random(body, 2, 20, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      surface.apply(now, changed);
      expect_rebuilt(surface, now);
    });
  }
}

TEST(BoundaryOfAClosedSurface, IsEmpty) {
  const auto body = body_of<Map2>(torus_lattice());
  EXPECT_TRUE(boundary_of(body).facets().empty());
}

}  // namespace
}  // namespace dartboard::boundary_surface_test
