// Springs of a Young's modulus: the stiffness of each edge, equal pull of different meshes of a body, effects of a cut.

#include "core/base/young.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/mechanics/adapt.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/spring_forces.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::young_test {
namespace {

using Eigen::Vector3d;

constexpr double u = 0x1p-53;  // unit roundoff
constexpr double young = 3000.0;

template <class Map>
MassSpringBody<Map, Held::by_every_dart> body_on(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 8.0, .damping = 0.25, .viscosity = 0.0, .young = young};
  problem.material.stiffness = mean_stiffness(problem.mesh, young);
  return build_body<Map, Held::by_every_dart>(problem);
}

/// The sum over the springs of T l u u^T over the volume at rest: the mean stress in the body [Pa].
template <class Body>
Eigen::Matrix3d mean_stress(const Body& body) {
  CellArrays arrays;
  arrays.rebuild(body);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const EdgeEntry& e : arrays.edges)
    sum += 2.0 * spring_virial(body.springs[e.embedding],
                               body.vertices.position[e.ends[1]] - body.vertices.position[e.ends[0]]);
  double mass = 0.0;
  for (const double m : body.cell_mass) mass += m;
  return sum / (mass / body.material.density);
}

// Six tetrahedra to a cube, each with one edge along each axis, two diagonals of faces and that of the cube. Edges get
// young V / l^2, so the energy per volume is young / 2 times the sum of their strains squared, each weighed with the
// tetrahedra that have it: 1 along an axis, 2/3 along each of three diagonals of faces, 1 along that of the cube. With
// lengths longer by s along x alone, an edge whose direction has the part x in it is longer by
// r = sqrt(1 + (s^2 - 1) x^2), and adds young (r - 1) r (s x / r)^2 to the stress along x.
double stress_of_cubes(double s) {
  const auto of = [s](double weight, double square) {
    const double r = std::sqrt(1.0 + (s * s - 1.0) * square);
    return weight * young * (r - 1.0) * r * s * s * square / (r * r);
  };
  return of(1.0, 1.0) + of(4.0 / 3.0, 0.5) + of(1.0, 1.0 / 3.0);
}

TEST(YoungsModulus, GivesAnEdgeTheVolumeOverTheSquareOfItsLength) {
  for (const Mesh& mesh : {regular_tetrahedron(), kuhn_grid(1, 1, 1, 0.5, 0.2, 3)}) {
    const auto body = body_on<TetMap>(mesh);
    std::vector<double> expected(body.springs.size(), 0.0);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      std::vector<bool> met(body.springs.size(), false);
      for (std::uint32_t d = 24 * static_cast<std::uint32_t>(c); d < 24 * (c + 1); ++d) {
        const std::uint32_t e = body.edge(body.map, Dart{d});
        if (met[e]) continue;
        met[e] = true;
        expected[e] += young * std::abs(signed_measure(mesh, c)) / std::pow(body.springs[e].rest_length, 2);
      }
    }
    // six cells at most, each some ten roundings of its own
    for (std::size_t e = 0; e < expected.size(); ++e)
      EXPECT_NEAR(body.springs[e].stiffness, expected[e], 64 * u * expected[e]) << e;
  }
}

TEST(YoungsModulus, SharesDampingOutAsStiffnessWithTheMeanThatIsAskedFor) {
  const Mesh mesh = kuhn_grid(2, 1, 1, 0.5, 0.2, 3);
  const auto body = body_on<TetMap>(mesh);
  double damping = 0.0;
  for (const Spring& s : body.springs) {
    EXPECT_NEAR(s.damping / s.stiffness, 0.25 / body.material.stiffness, 8 * u * 0.25 / body.material.stiffness);
    damping += s.damping;
  }
  const double edges = 6.0 * static_cast<double>(mesh.cell_count());
  EXPECT_NEAR(damping / edges, 0.25, 256 * u * 0.25);  // a sum of 72 shares, each some ten roundings of its own
}

// The stress is the same whatever the size of the cubes, and that of the closed form: a sum over n springs of terms
// that have one sign here, each with some 24 roundings of its own.
TEST(YoungsModulus, GivesTheStressOfItsClosedFormToMeshesOfAnySize) {
  for (const double s : {1.25, 1.0 + 0x1p-10, 0.75})
    for (const int n : {1, 2, 4}) {
      auto body = body_on<TetMap>(kuhn_box(4 * n, n, n, 0.5 / n));
      for (Vector3d& x : body.vertices.position) x.x() *= s;
      const double expected = stress_of_cubes(s), rounding = (static_cast<double>(body.springs.size()) + 24) * u;
      // at small strains, a length is off by u of itself and the elongation by u / (s - 1)
      EXPECT_NEAR(mean_stress(body)(0, 0), expected, rounding * std::abs(expected) / std::abs(s - 1.0));
    }
  // at small strains it is 13/9 of the modulus: 1 + 4/3 * 1/4 + 1/9, where an isotropic body has 6/5
  const double strain = 0x1p-20;
  EXPECT_NEAR(stress_of_cubes(1.0 + strain) / strain, 13.0 / 9.0 * young, 8.0 * strain * young);
}

// The force through a cross-section: the springs between two layers are the same everywhere along the bar, and the
// virial of a bar of length L that is pulled by F at both ends is F L.
TEST(YoungsModulus, PullsAtTheEndOfABarOfAnyMeshAlike) {
  const double s = 1.25;
  for (const int n : {1, 2, 3}) {
    auto body = body_on<TetMap>(kuhn_box(4 * n, n, n, 0.5 / n));
    for (Vector3d& x : body.vertices.position) x.x() *= s;
    for (Vector3d& f : body.vertices.force) f.setZero();
    CellArrays arrays;
    arrays.rebuild(body);
    add_spring_forces(arrays, body);
    double pull = 0.0, terms = 0.0;
    for (std::size_t k = 0; k < body.vertices.size(); ++k) {
      if (body.vertices.position[k].x() > 1e-9) continue;
      pull += body.vertices.force[k].x();
      terms += std::abs(body.vertices.force[k].x());
    }
    EXPECT_NEAR(pull, 0.5 * 0.5 * stress_of_cubes(s) / s, 512 * u * terms) << n;
  }
}

// A sheet of equilateral triangles is isotropic: a modulus young and Poisson's ratio 1/3, so 9/8 young if it is
// stretched along one axis alone, and 1/3 of that across. The next terms are of the order of the strain, and cancel in
// the mean of a stretch and a compression by the same strain, except for its square.
TEST(YoungsModulus, OfEquilateralTrianglesIsThatOfAnIsotropicSheet) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}};
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  const double strain = 0x1p-14;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
  for (const double sign : {1.0, -1.0}) {
    auto body = body_on<Map2>(mesh);
    for (Vector3d& x : body.vertices.position) x.x() *= 1.0 + sign * strain;
    slope += sign * mean_stress(body) / (2.0 * strain);
  }
  const double off = 8.0 * strain * strain * young + 64 * u / strain * young;
  EXPECT_NEAR(slope(0, 0), 9.0 / 8.0 * young, off);
  EXPECT_NEAR(slope(1, 1), 3.0 / 8.0 * young, off);
  EXPECT_NEAR(slope(0, 1), 0.0, off);
}

// k = k1 + k2, and each part has the share of its own cells: of two tetrahedra that share a face, each alone in the
// end.
TEST(YoungsModulus, IsSharedByThePartsOfACutAsTheirCellsHaveIt) {
  const Mesh mesh = two_tetrahedra();
  auto body = body_on<TetMap>(mesh);
  double before = 0.0, after = 0.0;
  for (const Spring& s : body.springs) before += s.stiffness;
  for (const Dart d : body.face_dart)
    if (!body.map.is_free<3>(d)) {
      adapt(body, dissociate_face(body.map, d));
      break;
    }
  ASSERT_EQ(body.springs.size(), 12u);
  for (const Spring& s : body.springs) after += s.stiffness;
  EXPECT_NEAR(after, before, 64 * u * before);
  for (std::uint32_t d = 0; d < 48; ++d) {
    const Spring s = body.springs[body.edge(body.map, Dart{d})];
    const double expected = young * std::abs(signed_measure(mesh, d / 24)) / (s.rest_length * s.rest_length);
    EXPECT_NEAR(s.stiffness, expected, 16 * u * expected);
  }
}

TEST(YoungsModulus, OfCellsThatAreNoSimplicesIsRefused) {
  EXPECT_THROW(mean_stiffness(hexahedron_box(1, 1, 1, 0.5), young), InputError);
  EXPECT_THROW(mean_stiffness(quad_sheet(1, 1, 0.5), young), InputError);
  EXPECT_THROW(mean_stiffness(mixed_box(2, 2, 2, 0.5), young), InputError);
}

// springs in series: n links of young / l each stretch as one of young over the whole length
TEST(YoungsModulus, OfAChainIsThatOfItsLinksInSeries) {
  for (const int links : {1, 4, 64}) {
    Mesh mesh;
    for (int k = 0; k <= links; ++k) mesh.points.emplace_back(2.0 * k / links, 0, 0);
    for (std::uint32_t k = 0; k + 1 < mesh.points.size(); ++k) mesh.links.push_back({k, k + 1});
    EXPECT_EQ(mean_stiffness(mesh, young) / links, young / 2.0);
  }
}

}  // namespace
}  // namespace dartboard::young_test
