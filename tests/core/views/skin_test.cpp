// Samples at which a body feels contact: weights that integrate, and that follow changes of the map.

#include "core/views/skin.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "core/base/archive.h"
#include "core/contact/contacts.h"
#include "core/contact/obstacle_contact.h"
#include "core/mechanics/refine.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/views/boundary_surface.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::skin_test {
namespace {

using Eigen::Vector3d;

template <class Body>
Skin skin_of(const Body& body) {
  Skin skin;
  skin.rebuild(body);
  return skin;
}

double area_of(const Skin& skin) {
  double area = 0.0;
  for (const SkinSample& s : skin.samples()) area += s.area;
  return area;
}

Vector3d place(const SkinSample& s, const std::vector<Vector3d>& x) { return ObstacleContact::place_of(s, {x}); }

/// f(x) over the samples.
template <class F>
double integral(const Skin& skin, const std::vector<Vector3d>& x, F&& f) {
  double sum = 0.0;
  for (const SkinSample& s : skin.samples()) sum += s.area * f(place(s, x));
  return sum;
}

/// The same of the faces themselves: the samples by vertex and by their middles, from the areas of triangles at rest
/// alone. Areas to a few roundings, since these are summed in another order.
template <class Body>
void expect_samples_of_the_boundary(const Skin& skin, const Body& body, const BoundarySurface& boundary) {
  std::map<std::uint32_t, double> vertex;
  std::size_t middles = 0;
  for (const BoundaryFacet& facet : boundary.facets()) {
    const auto n = boundary.corners(body, facet);
    ASSERT_EQ(n.size(), 3u);
    const auto& x = body.vertices.rest;
    const double area = 0.5 * (x[n[1]] - x[n[0]]).cross(x[n[2]] - x[n[0]]).norm();
    for (const std::uint32_t i : n) vertex[i] += area / 12;
    const std::uint32_t at = skin.place_of_face(facet.number);
    ASSERT_NE(at, Skin::no_place);
    const SkinSample& middle = skin.samples()[at];
    ASSERT_EQ(middle.count, 3u);
    ASSERT_EQ(std::set<std::uint32_t>(n.begin(), n.end()),
              std::set<std::uint32_t>(middle.nodes.begin(), middle.nodes.begin() + 3));
    ASSERT_NEAR(middle.area, 0.75 * area, 1e-15);
    ++middles;
  }
  ASSERT_EQ(skin.samples().size(), middles + vertex.size());
  for (const auto& [i, area] : vertex) {
    ASSERT_NE(skin.place_of_vertex(i), Skin::no_place);
    const SkinSample& s = skin.samples()[skin.place_of_vertex(i)];
    ASSERT_EQ(s.count, 1u);
    ASSERT_EQ(s.nodes[0], i);
    ASSERT_NEAR(s.area, area, 1e-14);
  }
}

template <class Map>
struct SkinOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SkinOf, Solids);

// A thousand operations and more, on cuts, fans, removals and series of them, each until nothing is left.
TYPED_TEST(SkinOf, ABodyFollowsAThousandOperationsUntilNothingIsLeft) {
  int operations = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto body = at_rest<TypeParam>(with_left_handed_cells(kuhn_grid(3, 3, 2, 0.25, 0.1, 3)));
    Skin skin = skin_of(body);
    BoundarySurface boundary;
    boundary.rebuild(body);
    operate_at_random(body, seed, 200, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      skin.apply(now, changed);
      boundary.apply(now, changed);
      ASSERT_EQ(skin, skin_of(now)) << operations;
      expect_samples_of_the_boundary(skin, now, boundary);
      ++operations;
    });
    EXPECT_TRUE(skin.samples().empty());
  }
  EXPECT_GT(operations, 1000);
}

// Together with refinement, which moves no boundary but adds vertices to it. Some edges, faces and volumes are cut too.
TYPED_TEST(SkinOf, ABodyFollowsRefinement) {
  auto body = at_rest<TypeParam>(with_left_handed_cells(kuhn_grid(2, 2, 1, 0.25, 0.1, 3)));
  Skin skin = skin_of(body);
  const double area = area_of(skin);
  SplitMix64 random(6);
  for (int k = 0; k < 60; ++k) {
    const Dart d = some_live_dart(body.map, random);
    const ChangedEmbeddings changed = k % 3 == 0   ? refine(body, Volume{d}, 0.5)
                                      : k % 3 == 1 ? refine(body, Face{d}, 0.5)
                                                   : refine(body, Edge{d}, 0.5);
    skin.apply(body, changed);
    BoundarySurface boundary;
    boundary.rebuild(body);
    ASSERT_EQ(skin, skin_of(body)) << k;
    expect_samples_of_the_boundary(skin, body, boundary);
    // new places are means of others: flat faces stay so to a few roundings
    ASSERT_NEAR(area_of(skin), area, 1e-13 * area) << k;
  }
  for (int k = 0; k < 40; ++k) {
    skin.apply(body, adapt(body, do_something(body.map, random)));
    ASSERT_EQ(skin, skin_of(body)) << k;
    if (body.map.dart_count() == 0) break;
  }
}

TEST(SkinOfHexahedra, FollowsEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : {hexahedron_box(3, 2, 2, 1.0), mixed_cells()}) {
    auto body = at_rest<Map3>(mesh);
    Skin skin = skin_of(body);
    operate_at_random(body, 1, 20, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      skin.apply(now, changed);
      ASSERT_EQ(skin, skin_of(now));
    });
    EXPECT_TRUE(skin.samples().empty());
  }
}

TEST(SkinOfASurface, FollowsEveryOperationUntilNothingIsLeft) {
  std::vector<Mesh> meshes = surfaces();
  meshes.push_back(triangle_sheet(6, 5, 0.1));
  int operations = 0;
  for (const Mesh& mesh : meshes) {
    auto body = at_rest<Map2>(mesh);
    Skin skin = skin_of(body);
    operate_at_random(body, 2, 40, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      skin.apply(now, changed);
      ASSERT_EQ(skin, skin_of(now)) << operations;
      ++operations;
    });
    EXPECT_TRUE(skin.samples().empty());
  }
  EXPECT_GT(operations, 250);
}

// The two storages number their darts alike, and so have the same areas to the last bit.
TEST(SkinOfEitherStorage, IsTheSame) {
  const Mesh mesh = kuhn_grid(3, 2, 2, 0.25, 0.1, 3);
  EXPECT_EQ(skin_of(at_rest<Map3>(mesh)), skin_of(at_rest<TetMap>(mesh)));
}

// Coordinates are powers of two and thirds come in pairs of roundings.
TEST(SkinOfABox, HasItsArea) {
  for (const Mesh& mesh : {kuhn_grid(4, 2, 1, 0.5), hexahedron_box(4, 2, 1, 0.5)}) {
    const auto body = at_rest<Map3>(mesh);
    EXPECT_NEAR(area_of(skin_of(body)), 7.0, 7.0 * 0x1p-46);
  }
  const auto sheet = at_rest<Map2>(triangle_sheet(6, 5, 0.125));
  EXPECT_NEAR(area_of(skin_of(sheet)), 30.0 / 64, 0x1p-50);
  // inner vertices are no samples
  const Skin skin = skin_of(at_rest<Map3>(hexahedron_box(4, 4, 4, 0.5)));
  EXPECT_EQ(skin.samples().size(), 6u * 16u + 125u - 27u);
}

// At the places at rest, not at the present ones; without places at rest, nothing.
TEST(SkinOfABody, IsThatOfItsRest) {
  auto body = at_rest<Map3>(kuhn_grid(2, 2, 1, 0.5));
  const Skin skin = skin_of(body);
  for (Vector3d& x : body.vertices.position) x *= 3.0;
  EXPECT_EQ(skin_of(body), skin);
  body.vertices.rest.clear();
  EXPECT_TRUE(skin_of(body).samples().empty());
  Skin empty;
  empty.rebuild(body);
  SplitMix64 random(2);
  empty.apply(body, adapt(body, dissociate_something(body.map, random)));
  EXPECT_EQ(empty, skin_of(body));
}

/// A flat sheet of triangles that are all different, or of parallelograms, turned in space.
Mesh flat_sheet(bool triangles) {
  Mesh mesh = triangles ? triangle_sheet(5, 4, 0.1) : quad_sheet(5, 4, 0.1);
  SplitMix64 random(9);
  if (triangles)
    for (Vector3d& p : mesh.points)
      for (int k = 0; k < 2; ++k) p[k] += 0.02 * random.next_signed();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (Vector3d& p : mesh.points) p = turn * Vector3d(p[0] + 0.3 * p[1], p[1], 0.0);
  return mesh;
}

// The rule of the three corners on a triangle and on its four quarters, extrapolated once to (4 fine - coarse) / 3,
// which is exact for quadratics.
template <class F>
double over_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, F&& f) {
  const double area = 0.5 * (b - a).cross(c - a).norm();
  const auto corners = [&](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    return (f(p) + f(q) + f(r)) / 3;
  };
  const Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  const double coarse = corners(a, b, c),
               fine = (corners(a, ab, ca) + corners(b, bc, ab) + corners(c, ca, bc) + corners(ab, bc, ca)) / 4;
  return area * (4 * fine - coarse) / 3;
}

TEST(SkinOfASurface, IntegratesAQuadraticPressureExactly) {
  const auto pressure = [](const Vector3d& x) { return 1 + x[0] - 2 * x[1] + 3 * x[0] * x[2] + 4 * x[1] * x[1]; };
  for (const bool triangles : {true, false}) {
    const Mesh mesh = flat_sheet(triangles);
    const auto body = at_rest<Map2>(mesh);
    double exact = 0.0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto n = mesh.cell(c);
      for (std::size_t k = 1; k + 1 < n.size(); ++k)
        exact += over_triangle(mesh.points[n[0]], mesh.points[n[k]], mesh.points[n[k + 1]], pressure);
    }
    EXPECT_NEAR(integral(skin_of(body), body.vertices.rest, pressure), exact, 1e-14 * std::abs(exact)) << triangles;
  }
}

// Any flat convex quadrilateral, as exact as its middle allows: for linear functions.
TEST(SkinOfASurface, IntegratesALinearPressureOverAnyQuadrilateral) {
  SplitMix64 random(3);
  const auto pressure = [](const Vector3d& x) { return 1 + 3 * x[0] - 2 * x[1] + x[2]; };
  for (int k = 0; k < 20; ++k) {
    Mesh mesh = quad_sheet(1, 1, 1.0);
    for (Vector3d& p : mesh.points) {
      for (int c = 0; c < 2; ++c) p[c] += 0.24 * random.next_signed();
      p[2] = 0.5 * p[0] - 0.25 * p[1];
    }
    const auto n = mesh.cell(0);
    const auto& x = mesh.points;
    const auto body = at_rest<Map2>(mesh);
    const Skin skin = skin_of(body);
    const double exact =
        over_triangle(x[n[0]], x[n[1]], x[n[2]], pressure) + over_triangle(x[n[0]], x[n[2]], x[n[3]], pressure);
    EXPECT_NEAR(integral(skin, body.vertices.rest, pressure), exact, 1e-14 * 8);
    for (const SkinSample& s : skin.samples()) EXPECT_GT(s.area, 0.0);
  }
  Mesh dart = quad_sheet(1, 1, 1.0);  // not convex: the area alone
  dart.points[3] = {0.3, 0.3, 0.0};
  const Skin skin = skin_of(at_rest<Map2>(dart));
  EXPECT_EQ(skin.samples().size(), 5u);
  EXPECT_NEAR(area_of(skin), 0.3, 1e-15);
  for (const SkinSample& s : skin.samples())
    if (s.count == 1) {
      EXPECT_NEAR(s.area, 0.025, 1e-16);
    }
}

// A plate whose face is tilted against a plane: with p = 3 the pressure is quadratic, and its sum exact.
TEST(SkinOfASurface, FeelsTheWholeForceOfATiltedPlane) {
  const double slope = 0.25, side = 0.5, top = 0.2;
  const auto body = at_rest<Map2>(triangle_sheet(3, 5, 0.1));
  const Skin skin = skin_of(body);
  ContactLaw law;
  law.pressure = 1000.0;
  law.depth = 0.1;
  // deep by top - slope * y everywhere, across the plane
  const double across = std::sqrt(1 + slope * slope);
  const Vector3d normal = Vector3d(0, slope, 1) / across;
  ObstacleContact term({law}, {{HalfSpace{{0, 0, top}, normal}}}, skin.samples());
  Vector3d sum(0, 0, 0);
  std::vector<Vector3d> force(body.vertices.size(), Vector3d(0, 0, 0));
  term.add_forces({body.vertices.position}, force);
  for (const Vector3d& f : force) sum += f;
  // the integral of ((top - slope y) / across / delta)^2 from 0 to side, times the width
  const double low = (top - slope * side) / across / 0.1, high = top / across / 0.1;
  const double exact = 1000.0 * 0.3 * (high * high * high - low * low * low) / 3 * 0.1 * across / slope;
  EXPECT_LE((sum - exact * normal).norm(), 1e-13 * exact);
}

// At rest in front of an obstacle, just touching it: cuts add samples, and no force and no energy.
TYPED_TEST(SkinOf, AFreshCutHasNoForceAndNoJump) {
  auto body = at_rest<TypeParam>(kuhn_grid(3, 3, 2, 0.25));
  Skin skin = skin_of(body);
  ContactLaw law;
  law.pressure = 1000.0;
  law.depth = 0.01;
  ObstacleContact term({law, law}, {{HalfSpace{}}, {Ball{{1.75, 0.4, 0.3}, 1.0}}}, skin.samples());
  SplitMix64 random(5);
  const std::size_t before = skin.samples().size();
  for (int k = 0; k < 60; ++k) {
    skin.apply(body, adapt(body, dissociate_something(body.map, random)));
    ASSERT_EQ(term.energy(body.vertices.position), 0.0);
    ASSERT_EQ(Contacts(&term).state_at(body.vertices.position).contacts, 0u);
  }
  EXPECT_GT(skin.samples().size(), before + 60);
}

// Samples in the obstacle, of a body that is cut elsewhere, keep their forces to the last bit.
TYPED_TEST(SkinOf, ACutAwayFromTheContactLeavesItsForces) {
  auto body = at_rest<TypeParam>(kuhn_grid(3, 3, 4, 0.25));
  Skin skin = skin_of(body);
  ContactLaw law;
  law.pressure = 1000.0;
  law.depth = 0.01;
  ObstacleContact term({law}, {{HalfSpace{{0, 0, 0.01}, {0, 0, 1}}}}, skin.samples());
  const double energy = term.energy(body.vertices.position),
               area = Contacts(&term).state_at(body.vertices.position).area;
  ASSERT_GT(energy, 0.0);
  SplitMix64 random(8);
  int cuts = 0;
  while (cuts < 20) {
    const Dart d = some_live_dart(body.map, random);
    bool near = body.map.template is_free<3>(d);
    for_each_dart_of(body.map, Face{d},
                     [&](Dart e) { near = near || body.vertices.rest[body.vertex(body.map, e)][2] < 0.3; });
    if (near) continue;
    skin.apply(body, adapt(body, dissociate_face(body.map, d)));
    ++cuts;
    ASSERT_NEAR(term.energy(body.vertices.position), energy, 1e-15 * energy);
    ASSERT_NEAR(Contacts(&term).state_at(body.vertices.position).area, area, 1e-14 * area);
  }
}

// The limit of that: where the cut goes through the contact, its sides stand on the plane with the corners of their
// lowest quadrilaterals, an edge each, 2 h^2 / 12 of those of side h: as the sides of the box do.
TEST(SkinOfHexahedra, CarriesOnTheEdgesOfItsSidesToo) {
  const double h = 0.25;
  auto body = at_rest<Map3>(hexahedron_box(4, 4, 4, h));
  Skin skin = skin_of(body);
  ContactLaw law;
  law.pressure = 1000.0;
  law.depth = 0.01;
  ObstacleContact term({law}, {{HalfSpace{{0, 0, 0.01}, {0, 0, 1}}}}, skin.samples());
  const double side = 4 * h * h / 6;
  EXPECT_NEAR(Contacts(&term).state_at(body.vertices.position).area, 1.0 + 4 * side, 1e-14);
  for (bool found = true; found;) {
    found = false;
    for (std::uint32_t k = 0; k < body.face_dart.size() && !found; ++k) {
      const Dart d = body.face_dart[k];
      bool in_plane = !body.map.is_free<3>(d);
      for_each_dart_of(body.map, Face{d},
                       [&](Dart e) { in_plane = in_plane && body.vertices.rest[body.vertex(body.map, e)][0] == 0.5; });
      if (!in_plane) continue;
      skin.apply(body, adapt(body, dissociate_face(body.map, d)));
      found = true;
    }
  }
  EXPECT_NEAR(Contacts(&term).state_at(body.vertices.position).area, 1.0 + 6 * side, 1e-14);
}

TEST(SkinOfABody, IsStoredInItsOrder) {
  auto body = at_rest<TetMap>(kuhn_grid(3, 2, 2, 0.25, 0.1, 3));
  Skin skin = skin_of(body);
  SplitMix64 random(2);
  for (int k = 0; k < 30; ++k) skin.apply(body, adapt(body, do_something(body.map, random)));
  Archive written;
  skin.state(written);
  Archive read(written.written(), "file");
  Skin again;
  again.state(read);
  read.require_end();
  EXPECT_EQ(again, skin);
  EXPECT_EQ(again.samples(), skin.samples());
  for (int k = 0; k < 5; ++k) {
    const ChangedEmbeddings changed = adapt(body, do_something(body.map, random));
    skin.apply(body, changed);
    again.apply(body, changed);
    ASSERT_EQ(again.samples(), skin.samples());
  }
  EXPECT_GT(skin.bytes(), skin.samples().size() * sizeof(SkinSample));
}

TEST(SkinOfABody, IsNotThatOfAnother) {
  auto body = at_rest<TetMap>(unequal_tetrahedra());
  const Skin skin = skin_of(body);
  auto wider = body;
  wider.vertices.rest[0] *= 1.5;
  wider.vertices.rest[1] *= 1.5;
  EXPECT_FALSE(skin == skin_of(wider));
  EXPECT_FALSE(skin == Skin());
}

}  // namespace
}  // namespace dartboard::skin_test
