#include "core/mechanics/fracture/seam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_all.h"
#include "core/plain/error.h"
#include "core/topology/check.h"
#include "core/topology/summary.h"
#include "core/walks/cell_arrays.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::seam_test {
namespace {

using Eigen::Vector3d;
using Triples = std::vector<std::array<std::uint32_t, 3>>;
using Pairs = std::vector<std::array<std::uint32_t, 2>>;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

template <class Map>
Body<Map> body_of(const Mesh& mesh) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 8.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  for (const auto& p : mesh.points) problem.initial_velocity.push_back(p.cwiseProduct(p) - Vector3d(0, 1, p.x()));
  return build_body<Map, Held::by_every_dart>(problem);
}

struct Plane {
  Vector3d point, normal;
};

// A plane in general position through the middle of the grids below.
const Plane slanted{{0.7, 0.55, 0.52}, {0.75, 0.5, -0.25}};

// ---- invariants when a body comes apart

struct Sums {
  double mass = 0, stiffness = 0, kinetic = 0, elastic = 0;
  Vector3d momentum{0, 0, 0}, angular{0, 0, 0};
  double momentum_scale = 0, angular_scale = 0;  // sums of the absolute values
};

template <class Map>
Sums sums_of(const Body<Map>& body) {
  Sums s;
  const VertexColumns& v = body.vertices;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vector3d &x = v.position[k], &w = v.velocity[k];
    s.mass += v.mass[k];
    s.momentum += v.mass[k] * w;
    s.angular += v.mass[k] *
                 Vector3d(x.y() * w.z() - x.z() * w.y(), x.z() * w.x() - x.x() * w.z(), x.x() * w.y() - x.y() * w.x());
    s.momentum_scale += v.mass[k] * w.norm();
    s.angular_scale += v.mass[k] * x.norm() * w.norm();
    s.kinetic += 0.5 * v.mass[k] * w.squaredNorm();
  }
  CellArrays arrays;
  arrays.rebuild(body);
  for (const EdgeEntry& e : arrays.edges) {
    const Spring& spring = body.springs[e.embedding];
    const double stretch = (v.position[e.ends[1]] - v.position[e.ends[0]]).norm() - spring.rest_length;
    s.stiffness += spring.stiffness;
    s.elastic += 0.5 * spring.stiffness * stretch * stretch;
  }
  return s;
}

// The parts of a vertex share its cells, position and velocity, so that every sum consists of the same terms, grouped
// otherwise. Each is a sum of at most N terms (masses: 24 cells at most, then the vertices), with 8 operations in a
// term: off by (N + 8 + 24) u of the sum of the absolute values, twice. Stiffnesses are whole numbers: exact.
void expect_conserved(const Sums& before, const Sums& after, std::size_t terms) {
  const double bound = 2 * (static_cast<double>(terms) + 32) * u;
  EXPECT_NEAR(after.mass, before.mass, bound * before.mass);
  EXPECT_EQ(after.stiffness, before.stiffness);
  EXPECT_NEAR(after.kinetic, before.kinetic, bound * before.kinetic);
  EXPECT_NEAR(after.elastic, before.elastic, bound * before.elastic);
  EXPECT_LE((after.momentum - before.momentum).norm(), 2 * bound * before.momentum_scale);
  EXPECT_LE((after.angular - before.angular).norm(), 4 * bound * before.angular_scale);
}

template <class Map>
struct Seam : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Seam, Solids);

template <class Map>
void expect_interior_lowest_and_ascending(const Map& map, const std::vector<Dart>& seam) {
  EXPECT_TRUE(std::is_sorted(seam.begin(), seam.end()));
  std::set<Dart> all;
  for (const Dart d : seam) {
    EXPECT_FALSE(map.template is_free<Map::dimension>(d));
    for_each_dart_of(map, Cell<Map::dimension - 1>{d}, [&](Dart e) {
      EXPECT_LE(d, e);
      EXPECT_TRUE(all.insert(e).second) << "a face is there twice";
    });
  }
}

TYPED_TEST(Seam, OnAPlaneCutsABodyInTwoAndConservesWhatItCarries) {
  auto body = body_of<TypeParam>(kuhn_grid(4, 3, 3, 0.375, 0.1, 2));
  for (Vector3d& x : body.vertices.position) x = x.cwiseProduct(Vector3d(1.0625, 0.9375, 1.0));
  const Sums before = sums_of(body);
  const auto seam = faces_on_plane(body, slanted.point, slanted.normal);
  expect_interior_lowest_and_ascending(body.map, seam);
  ASSERT_EQ(components(body.map).count, 1u);
  const TopologyChange change = dissociate_all(body.map, seam);
  EXPECT_EQ(change.faces.size(), seam.size());
  adapt(body, change);
  EXPECT_EQ(components(body.map).count, 2u);
  EXPECT_EQ(check(body.map), "");
  expect_conserved(before, sums_of(body), body.springs.size());
}

TYPED_TEST(Seam, OfFacetsBetweenChosenCellsCutsTheseOut) {
  auto body = body_of<TypeParam>(kuhn_grid(4, 3, 3, 0.375, 0.1, 2));
  const auto is_out = [](std::uint32_t cell) { return cell % 7 == 3; };
  const auto seam = facets_between(body, [&](std::uint32_t a, std::uint32_t b) { return is_out(a) != is_out(b); });
  expect_interior_lowest_and_ascending(body.map, seam);
  adapt(body, dissociate_all(body.map, seam));
  for (const Dart d : inner_facets(body.map))
    EXPECT_EQ(is_out(body.cell(body.map, d)), is_out(body.cell(body.map, body.map.template alpha<3>(d))));
  EXPECT_GT(components(body.map).count, 1u);
}

TYPED_TEST(Seam, OnAPlaneHasTheCellsOfEachComponentOnOneSide) {
  auto body = body_of<TypeParam>(kuhn_grid(4, 3, 3, 0.375, 0.1, 2));
  adapt(body, dissociate_all(body.map, faces_on_plane(body, slanted.point, slanted.normal)));
  const Components parts = components(body.map);
  std::vector<std::set<bool>> sides(parts.count);
  for (const Dart d : body.cell_dart) {
    Vector3d middle(0, 0, 0);
    const auto nodes = incident_cells<0>(body.map, Volume{d});
    for (const Vertex v : nodes) middle += body.vertices.position[body.vertex(body.map, v.dart)] / 4.0;
    ASSERT_EQ(nodes.size(), 4u);
    sides[parts.of_dart[d.index]].insert((middle - slanted.point).dot(slanted.normal) >= 0);
  }
  EXPECT_EQ(sides[0].size(), 1u);
  EXPECT_EQ(sides[1].size(), 1u);
  EXPECT_NE(sides[0], sides[1]);
}

TYPED_TEST(Seam, OnAPlaneIsTheSameFromEitherSideAndForAnyLengthOfTheNormal) {
  const auto body = body_of<TypeParam>(kuhn_grid(3, 3, 2, 0.5, 0.1, 2));
  const auto seam = faces_on_plane(body, slanted.point, slanted.normal);
  EXPECT_FALSE(seam.empty());
  EXPECT_EQ(faces_on_plane(body, slanted.point, -slanted.normal), seam);
  EXPECT_EQ(faces_on_plane(body, slanted.point, 1024 * slanted.normal), seam);
}

TYPED_TEST(Seam, OnAPlaneThatMissesTheBodyIsEmpty) {
  const auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 0.5));
  EXPECT_TRUE(faces_on_plane(body, {0, 0, 1.25}, {0, 0, 1}).empty());
}

TYPED_TEST(Seam, OnAPlaneFollowsTheBody) {
  auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 0.5));
  const auto seam = faces_on_plane(body, {0, 0, 0.5}, {0, 0, 1});
  for (Vector3d& x : body.vertices.position) x.z() += 8.0;
  EXPECT_TRUE(faces_on_plane(body, {0, 0, 0.5}, {0, 0, 1}).empty());
  EXPECT_EQ(faces_on_plane(body, {0, 0, 8.5}, {0, 0, 1}), seam);
}

TYPED_TEST(Seam, OnAPlaneThatIsNoneIsRefused) {
  const auto body = body_of<TypeParam>(unequal_tetrahedra());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(faces_on_plane(body, {0, 0, 0}, {0, 0, 0}), InputError);
  EXPECT_THROW(faces_on_plane(body, {0, nan, 0}, {0, 0, 1}), InputError);
  EXPECT_THROW(faces_on_plane(body, {0, 0, 0}, {0, nan, 1}), InputError);
}

TYPED_TEST(Seam, OfPointsIsTheFaceBetweenThem) {
  auto body = body_of<TypeParam>(unequal_tetrahedra());
  const auto seam = faces_of_points(body, Triples{{2, 0, 1}, {0, 1, 2}});
  ASSERT_EQ(seam.size(), 1u);
  expect_interior_lowest_and_ascending(body.map, seam);
  adapt(body, dissociate_all(body.map, seam));
  EXPECT_EQ(components(body.map).count, 2u);
}

template <class Map>
std::string refusal(const Body<Map>& body, const Triples& triples) {
  try {
    faces_of_points(body, triples);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TYPED_TEST(Seam, OfPointsOfNoInteriorFaceIsRefusedByName) {
  auto body = body_of<TypeParam>(unequal_tetrahedra());
  EXPECT_NE(refusal(body, {{0, 1, 2}, {3, 1, 0}}).find("0, 1, 3,"), std::string::npos);  // on the surface
  EXPECT_NE(refusal(body, {{0, 3, 4}}).find("0, 3, 4,"), std::string::npos);             // no face
  EXPECT_NE(refusal(body, {{0, 99, 1}}).find("0, 1, 99,"), std::string::npos);           // no point
  EXPECT_NE(refusal(body, {{1, 1, 2}}).find("1, 1, 2,"), std::string::npos);             // two points
  adapt(body, dissociate_all(body.map, faces_of_points(body, Triples{{0, 1, 2}})));
  EXPECT_NE(refusal(body, {{0, 1, 2}}).find("0, 1, 2,"), std::string::npos);  // it has come apart
}

TYPED_TEST(Seam, OfThePointsOfAPlaneIsThatPlane) {
  const auto body = body_of<TypeParam>(kuhn_grid(3, 3, 2, 0.5, 0.1, 2));
  const auto seam = faces_on_plane(body, slanted.point, slanted.normal);
  Triples triples;
  for (const Dart d : seam) {
    const auto point = [&](Dart e) { return body.vertices.point[body.vertex(body.map, e)]; };
    const Dart next = body.map.template alpha<0, 1>(d);
    triples.push_back({point(body.map.template alpha<0, 1>(next)), point(d), point(next)});
  }
  std::reverse(triples.begin(), triples.end());
  EXPECT_EQ(faces_of_points(body, triples), seam);
  EXPECT_TRUE(faces_of_points(body, Triples{}).empty());
}

TYPED_TEST(Seam, AsASetContainsBothSidesOfItsFacesAndNoOther) {
  const auto body = body_of<TypeParam>(kuhn_grid(3, 3, 2, 0.5));
  const auto seam = faces_on_plane(body, slanted.point, slanted.normal);
  const FaceSet set(body.map, seam);
  std::size_t contained = 0;
  body.map.for_each_dart([&](Dart d) { contained += set.contains(body.map, d) ? 1u : 0u; });
  EXPECT_EQ(contained, 12 * seam.size());
  for (const Dart d : seam)
    for_each_dart_of(body.map, Face{d}, [&](Dart e) { EXPECT_TRUE(set.contains(body.map, e)); });
  EXPECT_FALSE(set.contains(body.map, {static_cast<std::uint32_t>(body.map.capacity()) + 24}));
}

// ---- other cells

TEST(SeamOfHexahedra, OnAPlaneIsALayerOfFaces) {
  auto body = body_of<Map3>(hexahedron_box(3, 2, 3, 1.0));
  EXPECT_EQ(faces_on_plane(body, {0, 0, 1.25}, {0, 0, 1}).size(), 6u);
  // through the middles of the second layer: they count as in front, so it is the face towards the back that parts
  const auto behind = faces_on_plane(body, {0, 0, 1.5}, {0, 0, 1});
  EXPECT_EQ(behind, faces_on_plane(body, {0, 0, 1.0}, {0, 0, 1}));
  EXPECT_EQ(faces_on_plane(body, {0, 0, 1.5}, {0, 0, -1}), faces_on_plane(body, {0, 0, 2.0}, {0, 0, 1}));
  adapt(body, dissociate_all(body.map, behind));
  EXPECT_EQ(components(body.map).count, 2u);
}

TEST(SeamOfHexahedra, OfAnyThreeCornersOfAQuadrilateralIsTheQuadrilateral) {
  const auto body = body_of<Map3>(hexahedron_box(1, 1, 2, 1.0));  // points 4 5 6 7 in between
  const auto seam = faces_of_points(body, Triples{{4, 5, 6}});
  EXPECT_EQ(seam.size(), 1u);
  EXPECT_EQ(faces_of_points(body, Triples{{7, 4, 6}}), seam);
  EXPECT_EQ(faces_of_points(body, Triples{{7, 5, 6}, {4, 5, 7}}), seam);
}

TEST(SeamOfMixedCells, OnAPlanePartsEachPairOfNeighbours) {
  auto body = body_of<Map3>(mixed_cells());
  EXPECT_EQ(faces_on_plane(body, {0, 0, 1}, {0, 0, 1}).size(), 1u);    // hexahedron and pyramid
  EXPECT_EQ(faces_on_plane(body, {1, 0, 0}, {1, 0, 0}).size(), 1u);    // hexahedron and prism
  EXPECT_EQ(faces_on_plane(body, {0, 0.1, 0}, {0, 1, 0}).size(), 1u);  // prism and tetrahedron
}

// ---- surfaces

TEST(SeamOfASurface, OnAPlaneCutsASheetInTwoAndConservesWhatItCarries) {
  auto body = body_of<Map2>(quadrilateral_grid(5, 4));
  for (Vector3d& x : body.vertices.position) x = 1.125 * x;
  const Sums before = sums_of(body);
  const auto seam = edges_on_plane(body, {2, 2, 0}, {1, 0.25, 0});
  expect_interior_lowest_and_ascending(body.map, seam);
  adapt(body, dissociate_all(body.map, seam));
  EXPECT_EQ(components(body.map).count, 2u);
  EXPECT_EQ(check(body.map), "");
  expect_conserved(before, sums_of(body), body.springs.size());
}

TEST(SeamOfASurface, AcrossAMoebiusStripLeavesItInOnePieceWithTwoSides) {
  Mesh mesh = moebius_lattice();
  const Vector3d middle[] = {{3, 0, 0}, {1, 3, 0}, {-3, 2, 0}, {-2, -3, 0}, {2, -2, 0}};
  const double outwards[] = {0, 0.6, 0.95, 0.95, 0.6}, upwards[] = {1, 0.8, 0.3, -0.3, -0.8};  // half a turn
  for (std::size_t k = 0; k < 10; ++k)
    mesh.points[k] = middle[k / 2] + (k % 2 == 0 ? -0.5 : 0.5) * (outwards[k / 2] * middle[k / 2].normalized() +
                                                                  upwards[k / 2] * Vector3d::UnitZ());
  auto body = body_of<Map2>(mesh);
  ASSERT_FALSE(summarize(body.map).orientable);
  Pairs pairs{{2, 3}};  // sheet() numbers across the strip first
  const auto seam = edges_of_points(body, pairs);
  ASSERT_EQ(seam.size(), 1u);
  adapt(body, dissociate_all(body.map, seam));
  EXPECT_EQ(components(body.map).count, 1u);
  EXPECT_TRUE(summarize(body.map).orientable);
}

TEST(SeamOfASurface, OfPointsWithoutAnInteriorEdgeIsRefused) {
  const auto body = body_of<Map2>(quadrilateral_grid(2, 1));
  EXPECT_EQ(edges_of_points(body, Pairs{{3, 2}}).size(), 1u);
  EXPECT_THROW(edges_of_points(body, Pairs{{0, 1}}), InputError);
  EXPECT_THROW(edges_of_points(body, Pairs{{0, 3}}), InputError);
}

}  // namespace
}  // namespace dartboard::seam_test
