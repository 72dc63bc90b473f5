#include "core/meshes/generators/mesh_generators.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/storage/hash.h"
#include "core/topology/summary.h"

namespace dartboard::mesh_generators_test {
namespace {

using Counts = std::vector<std::size_t>;

struct Expected {
  Counts cells;  // V, E, F and, for a solid, T
  long euler;
  std::size_t components, boundary;
  bool orientable = true;
};

template <class Map>
void expect(const Mesh& mesh, const Expected& e) {
  const MapSummary s = summarize(build_map<Map>(mesh).map);
  EXPECT_EQ(s.violation, "");
  EXPECT_EQ(s.cells, e.cells);
  EXPECT_EQ(s.euler, e.euler);
  EXPECT_EQ(s.components, e.components);
  EXPECT_EQ(s.boundary_facets, e.boundary);
  EXPECT_EQ(s.orientable, e.orientable);
}
// Tetrahedra, in both storages.
void expect_tetrahedra(const Mesh& mesh, const Expected& e) {
  expect<Map3>(mesh, e);
  expect<TetMap>(mesh, e);
}

std::uint64_t hash_of(const Mesh& mesh) {
  Hash hash;
  hash.add(mesh.nodes);
  for (const auto& p : mesh.points) hash.add_bytes(p.data(), sizeof(double) * 3);
  return hash.value();
}

// Euler characteristic of the link of d's vertex: the edges, faces and volumes around it are the link's vertices,
// edges and faces. A sphere has 2, a disc 1, a ring 0.
template <class Map>
long link_euler(const Map& map, Dart d) {
  const Vertex v{d};
  // an edge with both ends at v would count twice; there are none, as a mesh cell does not repeat a node
  return static_cast<long>(incident_cells<1>(map, v).size()) - static_cast<long>(incident_cells<2>(map, v).size()) +
         static_cast<long>(incident_cells<3>(map, v).size());
}

TEST(TestMeshes, HaveCellsOfPositiveMeasureAndFinitePointsAllInUse) {
  for (const NamedMesh& named : test_meshes()) {
    const Mesh mesh = named.make();
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) EXPECT_GT(signed_measure(mesh, c), 0.0) << named.name << c;
    for (const auto& p : mesh.points) EXPECT_TRUE(p.allFinite()) << named.name;
    EXPECT_EQ(std::set(mesh.nodes.begin(), mesh.nodes.end()).size(), mesh.points.size()) << named.name;
    EXPECT_LE(mesh.cell_count(), 2000u) << named.name;
  }
}

TEST(TestMeshes, HaveNamesOfTheirOwnAndNoTwoPointsInOnePlace) {
  std::set<std::string> names;
  for (const NamedMesh& named : test_meshes()) {
    EXPECT_TRUE(names.insert(named.name).second) << named.name;
    std::set<std::array<double, 3>> places;
    for (const auto& p : named.make().points)
      EXPECT_TRUE(places.insert({p.x(), p.y(), p.z()}).second) << named.name << ' ' << p.transpose();
  }
}

TEST(TestMeshes, AreTheSameOnEveryPlatform) {
  Hash all;
  for (const NamedMesh& named : test_meshes()) all.add(std::vector{hash_of(named.make())});
  EXPECT_EQ(all.value(), 2261210872291765171u);
}

TEST(SplitMix64, GivesThePublishedSequence) {
  SplitMix64 random(1234567);
  const std::uint64_t published[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                     4593380528125082431u, 16408922859458223821u};
  for (const std::uint64_t value : published) EXPECT_EQ(random.next(), value);
}

// ---- balls

double volume_of(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) sum += signed_measure(mesh, c);
  return sum;
}

TEST(TetrahedronBall, HasTheCountsOfItsLayersAndItsSurfaceOnASphere) {
  for (const int n : {1, 2, 5}) {
    const Mesh mesh = tetrahedron_ball(n, 0.5);
    const auto layers = static_cast<std::size_t>(n);
    EXPECT_EQ(mesh.cell_count(), 8 * layers * layers * layers);
    EXPECT_EQ(mesh.points.size(), (2 * layers + 1) * (2 * layers * layers + 2 * layers + 3) / 3);  // octahedral numbers
    std::size_t outside = 0;
    for (const Eigen::Vector3d& p : mesh.points) {
      EXPECT_LE(p.norm(), 0.5 * (1 + 4 * 0x1p-53));
      outside += p.norm() >= 0.5 * (1 - 4 * 0x1p-53);
    }
    EXPECT_EQ(outside, 4 * layers * layers + 2);
    const MapSummary summary = summarize(build_map<TetMap>(mesh).map);
    EXPECT_EQ(summary.violation, "");
    EXPECT_EQ(summary.euler, 1);
    EXPECT_EQ(summary.components, 1u);
    EXPECT_EQ(summary.boundary_facets, 8 * layers * layers);
  }
}

TEST(TetrahedronBall, HasNoInvertedCellAndNoSliver) {
  for (const int n : {1, 2, 3, 7, 12}) {
    const Mesh mesh = tetrahedron_ball(n, 2.0);
    const double mean = volume_of(mesh) / static_cast<double>(mesh.cell_count());
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const double volume = signed_measure(mesh, c);
      ASSERT_GT(volume, 0.32 * mean);
      double squares = 0.0;
      const auto cell = mesh.cell(c);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) squares += (mesh.points[cell[i]] - mesh.points[cell[j]]).squaredNorm();
      ASSERT_GT(12 * std::cbrt(9 * volume * volume) / squares, 0.69);
    }
  }
}

TEST(TetrahedronBall, FillsTheBallWithAnErrorThatFallsLikeTheSquareOfTheLayers) {
  const double ball = 4.0 / 3.0 * std::numbers::pi;
  double before = ball - volume_of(tetrahedron_ball(4, 1.0));
  for (const int n : {8, 16}) {
    const double missing = ball - volume_of(tetrahedron_ball(n, 1.0));
    EXPECT_NEAR(before / missing, 4.0, 0.3);  // 4 (1 + O(1/n^2))
    before = missing;
  }
}

TEST(TetrahedronBall, RefusesNoLayersAndRadiiThatAreNone) {
  EXPECT_THROW(tetrahedron_ball(0, 1.0), InputError);
  EXPECT_THROW(tetrahedron_ball(2, 0.0), InputError);
  EXPECT_THROW(tetrahedron_ball(2, std::numeric_limits<double>::quiet_NaN()), InputError);
}

// A = nx (ny+1)(nz+1) + ... edges along axes, Q = nx ny (nz+1) + ... squares, C = nx ny nz cubes. Each square gives a
// diagonal and two triangles; each cube a diagonal, six tetrahedra, and the six faces around the diagonal.
TEST(KuhnBox, HasTheCountsOfItsCubes) {
  const std::size_t a = 3 * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5, q = 3 * 4 * 6 + 3 * 5 * 5 + 4 * 4 * 5, c = 3 * 4 * 5;
  const Expected e{{4 * 5 * 6, a + q + c, 2 * q + 6 * c, 6 * c}, 1, 1, 4 * (3 * 4 + 4 * 5 + 3 * 5)};
  expect_tetrahedra(kuhn_box(3, 4, 5, 0.5), e);
  expect_tetrahedra(kuhn_box(3, 4, 5, 0.5, 0.3, 7), e);
  EXPECT_EQ(kuhn_box(20, 20, 20, 0.1).cell_count(), 48000u);
  // every determinant is a small whole number
  const Mesh unit = kuhn_box(2, 2, 2, 1.0);
  for (std::size_t k = 0; k < unit.cell_count(); ++k) EXPECT_EQ(signed_measure(unit, k), 1.0 / 6.0);
}

TEST(KuhnBox, MovesInnerPointsByAtMostTheJitterAndInvertsNothing) {
  const double spacing = 0.5, rest = spacing * spacing * spacing / 6.0;
  const Mesh still = kuhn_box(8, 8, 8, spacing);
  for (const double jitter : {0.05, 0.3, 3.0}) {
    const Mesh mesh = kuhn_box(8, 8, 8, spacing, jitter, 3);
    std::size_t moved = 0;
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
      const double distance = (mesh.points[p] - still.points[p]).norm();
      moved += distance > 0.0 ? 1 : 0;
      // rounding: half an ulp of a coordinate below 4 for each sum; some ulps of a length below 2 for the norm
      EXPECT_LE(distance, jitter * spacing + 8 * std::numeric_limits<double>::epsilon());
      const bool inside = (still.points[p].array() > 0.0).all() && (still.points[p].array() < 8 * spacing).all();
      EXPECT_TRUE(inside || distance == 0.0);
    }
    EXPECT_EQ(moved, 7u * 7 * 7);
    // a tenth of the rest volume, which is one rounded number for all cells: all powers of two but the 1/6
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) EXPECT_GE(signed_measure(mesh, c), 0.1 * rest) << c;
  }
}

TEST(KuhnBox, RepeatsForASeedAndDiffersForAnother) {
  EXPECT_EQ(hash_of(kuhn_box(4, 4, 4, 0.1, 0.2, 1)), hash_of(kuhn_box(4, 4, 4, 0.1, 0.2, 1)));
  EXPECT_NE(hash_of(kuhn_box(4, 4, 4, 0.1, 0.2, 1)), hash_of(kuhn_box(4, 4, 4, 0.1, 0.2, 2)));
}

TEST(MirroredBox, HasTheCountsOfItsCubesAndFillsThem) {
  const std::size_t a = 3 * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5, q = 3 * 4 * 6 + 3 * 5 * 5 + 4 * 4 * 5, c = 3 * 4 * 5;
  const Expected e{{4 * 5 * 6, a + q + c, 2 * q + 6 * c, 6 * c}, 1, 1, 4 * (3 * 4 + 4 * 5 + 3 * 5)};
  expect_tetrahedra(mirrored_box(3, 4, 5, 0.5), e);  // face to face for odd counts too
  expect_tetrahedra(mirrored_box(3, 4, 5, 0.5, 0.3, 7), e);
  const Mesh unit = mirrored_box(3, 2, 2, 1.0);
  for (std::size_t k = 0; k < unit.cell_count(); ++k) EXPECT_EQ(signed_measure(unit, k), 1.0 / 6.0);
}

TEST(MirroredBox, IsItsOwnMirrorImageAcrossEveryPlaneBetweenCubes) {
  const Mesh mesh = mirrored_box(2, 2, 2, 1.0);
  const auto cells = [&mesh](int axis) {
    std::set<std::set<std::array<double, 3>>> all;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      std::set<std::array<double, 3>> corners;
      for (const std::uint32_t p : mesh.cell(c)) {
        std::array<double, 3> x{mesh.points[p].x(), mesh.points[p].y(), mesh.points[p].z()};
        if (axis >= 0) x[static_cast<std::size_t>(axis)] = 2.0 - x[static_cast<std::size_t>(axis)];
        corners.insert(x);
      }
      all.insert(corners);
    }
    return all;
  };
  for (const int axis : {0, 1, 2}) EXPECT_EQ(cells(axis), cells(-1)) << axis;
}

TEST(HexahedronBox, HasTheCountsOfItsCubes) {
  const std::size_t a = 3 * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5, q = 3 * 4 * 6 + 3 * 5 * 5 + 4 * 4 * 5, c = 3 * 4 * 5;
  expect<Map3>(hexahedron_box(3, 4, 5, 0.5), {{4 * 5 * 6, a, q, c}, 1, 1, 2 * (3 * 4 + 4 * 5 + 3 * 5)});
}

// P plain and D cut columns, H layers with hexahedra or prisms, S with stars around a centre. A cut column has a
// diagonal in each of its nz+1 horizontal faces. A star has 8 spokes, and a triangle per edge of its shell, 12 or,
// cut, 14.
TEST(MixedBox, IsFaceToFaceAndHoldsAllFourKinds) {
  const std::size_t nx = 3, ny = 3, nz = 5, P = 5, D = 4, H = 3, S = 2;
  const std::size_t a = 3 * 4 * 6 + 4 * 3 * 6 + 4 * 4 * 5, q = nx * ny * (nz + 1) + 2 * (3 * 4 * 5);
  const Mesh mesh = mixed_box(3, 3, 5, 0.5);
  expect<Map3>(mesh, {{4 * 4 * 6 + nx * ny * S, a + D * (nz + 1) + 8 * nx * ny * S,
                       q + D * (nz + 1) + D * H + (12 * P + 14 * D) * S, P * H + 2 * D * H + (6 * P + 8 * D) * S},
                      1,
                      1,
                      2 * (nx * ny + ny * nz + nx * nz) + 2 * D});
  std::array<std::size_t, 6> of_kind{};
  for (const CellKind kind : mesh.kinds) ++of_kind[static_cast<std::size_t>(kind)];
  EXPECT_EQ(of_kind, (std::array<std::size_t, 6>{0, 0, 4 * D * S, (6 * P + 4 * D) * S, 2 * D * H, P * H}));
}

// One grid of nx x ny squares, closed or not: V - E + F = 1, or 0 for all that close up to a torus, a bottle or a
// strip.
TEST(Surfaces, HaveTheCountsOfTheirSquares) {
  const std::size_t sides = 8 * 6 + 5 * 9, squares = 8 * 5;
  expect<Map2>(quad_sheet(8, 5, 0.1), {{9 * 6, sides, squares}, 1, 1, 2 * (8 + 5)});
  expect<Map2>(triangle_sheet(8, 5, 0.1), {{9 * 6, sides + squares, 2 * squares}, 1, 1, 2 * (8 + 5)});
  for (const int nu : {3, 4, 7})
    for (const int nv : {3, 4, 7}) {
      const auto n = static_cast<std::size_t>(nu * nv);
      expect<Map2>(torus_surface(nu, nv), {{n, 2 * n, n}, 0, 1, 0});
      expect<Map2>(klein_bottle(nu, nv), {{n, 2 * n, n}, 0, 1, 0, false});
    }
  for (const std::size_t n : {3, 4, 11})  // n rungs, 2n rails
    expect<Map2>(moebius_strip(static_cast<int>(n)), {{2 * n, 3 * n, n}, 0, 1, 2 * n, false});
}

// Neighbours run along a shared edge in opposite directions; the cones from the origin add up to the enclosed volume.
TEST(Surfaces, TurnTheSameWayAndClosedOnesOutwards) {
  for (const Mesh& mesh : {triangle_sheet(3, 2, 1.0), torus_surface(5, 4), octasphere(0), octasphere(2)}) {
    std::set<std::array<std::uint32_t, 2>> sides;
    double inside = 0.0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto cell = mesh.cell(c);
      for (std::size_t k = 0; k < cell.size(); ++k)
        EXPECT_TRUE(sides.insert({cell[k], cell[(k + 1) % cell.size()]}).second);
      const auto p = [&](std::size_t k) { return mesh.points[cell[k]]; };
      for (std::size_t k = 2; k < cell.size(); ++k) inside += p(0).dot(p(k - 1).cross(p(k))) / 6.0;
    }
    EXPECT_TRUE(mesh.points[0].isZero(0.0) || inside > 1.0);  // the sheet has point 0 at the origin
  }
}

// Every subdivision makes four triangles of one, so F = 8 * 4^s and, closed, E = 3 F / 2; V = 2 + E - F.
TEST(Octasphere, IsAClosedSphereOfUnitRadius) {
  for (const int s : {0, 1, 3}) {
    const std::size_t f = std::size_t{8} << 2 * s;
    const Mesh mesh = octasphere(s);
    expect<Map2>(mesh, {{2 + f / 2, 3 * f / 2, f}, 2, 1, 0});
    // p / |p| is off by three roundings in the squares and sums (halved by the root), one in the root, one in the
    // division
    for (const auto& p : mesh.points) EXPECT_NEAR(p.norm(), 1.0, 8 * std::numeric_limits<double>::epsilon());
  }
}

TEST(FewTetrahedra, ShareWhatTheirNamesSay) {
  expect<Map3>(empty_mesh(), {{0, 0, 0, 0}, 0, 0, 0});
  expect_tetrahedra(one_tetrahedron(), {{4, 6, 4, 1}, 1, 1, 4});
  expect_tetrahedra(two_tetrahedra(), {{5, 9, 7, 2}, 1, 1, 6});
  // in the map two volumes share nothing unless they share a face: two of everything
  const Expected apart{{8, 12, 8, 2}, 2, 2, 8};
  expect_tetrahedra(touching_at_edge(), apart);
  expect_tetrahedra(touching_at_vertex(), apart);
  EXPECT_EQ(touching_at_edge().points.size(), 6u);
  EXPECT_EQ(touching_at_vertex().points.size(), 7u);
}

// Per block: 4 points; 8 axis edges, 5 squares with a diagonal, 1 cube diagonal; 2 * 5 + 6 triangles; 6 tetrahedra.
TEST(SolidTorus, HasAHole) {
  for (const std::size_t n : {3, 12}) {
    const Mesh mesh = solid_torus(static_cast<int>(n));
    expect_tetrahedra(mesh, {{4 * n, 14 * n, 16 * n, 6 * n}, 0, 1, 8 * n});
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) EXPECT_GT(signed_measure(mesh, c), 0.0);
  }
}

// A ring of 2n triangles has 2n points and 4n edges; the cone over it adds a point, and one dimension to each.
TEST(PinchedBody, HasOneVertexWhoseLinkIsARing) {
  for (const std::size_t n : {3, 5, 8}) {
    const Mesh mesh = pinched_body(static_cast<int>(n));
    expect_tetrahedra(mesh, {{2 * n + 1, 6 * n, 6 * n, 2 * n}, 1, 1, 4 * n});
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) EXPECT_GT(signed_measure(mesh, c), 0.0);
    const auto built = build_map<TetMap>(mesh);
    std::size_t at_centre = 0;
    for_each_cell<0>(built.map, [&](Vertex v) {
      const bool centre = built.point[TetMap::slot<0>(v.dart)] == 0;
      at_centre += centre ? 1 : 0;
      EXPECT_EQ(link_euler(built.map, v.dart), centre ? 0 : 1);
    });
    EXPECT_EQ(at_centre, 1u);
  }
}

// A box of 1 x 1 x m cubes has 4(m+1) points, 14m+5 edges, 16m+2 triangles, 8m+4 of them outside; C is the sum of m.
TEST(SeveralComponents, AreThatMany) {
  for (const std::size_t k : {0, 1, 5}) {
    const std::size_t C = k * (k + 1) / 2;
    expect_tetrahedra(several_components(static_cast<int>(k)),
                      {{4 * C + 4 * k, 14 * C + 5 * k, 16 * C + 2 * k, 6 * C}, static_cast<long>(k), k, 8 * C + 4 * k});
  }
}

TEST(Generators, RefuseMoreCellsThanAMapCanNumberBeforeTheyMakeOne) {
  try {
    kuhn_box(282, 282, 282, 1.0);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "kuhn_box: 134554608 tetrahedra, where a map numbers at most 134217728");
  }
  EXPECT_THROW(hexahedron_box(282, 282, 282, 1.0), InputError);
  EXPECT_THROW(mixed_box(200, 200, 200, 1.0), InputError);
  EXPECT_THROW(tetrahedron_ball(257, 1.0), InputError);
  EXPECT_THROW(triangle_sheet(12000, 12000, 1.0), InputError);
  EXPECT_THROW(torus_surface(14000, 14000), InputError);
  EXPECT_THROW(solid_torus(30000000), InputError);
}

TEST(Generators, RefuseNumbersOutOfRange) {
  EXPECT_THROW(kuhn_box(0, 1, 1, 1.0), InputError);
  EXPECT_THROW(kuhn_box(1, 1, 1, 0.0), InputError);
  EXPECT_THROW(kuhn_box(1, 1, 1, 1.0, -0.1), InputError);
  EXPECT_THROW(kuhn_box(1, 1, 1, 1.0, std::nan("")), InputError);
  EXPECT_THROW(hexahedron_box(2000, 2000, 2000, 1.0), InputError);
  EXPECT_THROW(mixed_box(1, 1, -1, 1.0), InputError);
  EXPECT_THROW(quad_sheet(1, 0, 1.0), InputError);
  EXPECT_THROW(torus_surface(2, 3), InputError);
  EXPECT_THROW(klein_bottle(3, 2), InputError);
  EXPECT_THROW(moebius_strip(2), InputError);
  EXPECT_THROW(octasphere(-1), InputError);
  EXPECT_THROW(solid_torus(2), InputError);
  EXPECT_THROW(pinched_body(2), InputError);
  EXPECT_THROW(several_components(-1), InputError);
}

}  // namespace
}  // namespace dartboard::mesh_generators_test
