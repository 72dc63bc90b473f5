#include "core/mechanics/fracture/stress.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_all.h"
#include "core/plain/error.h"
#include "core/walks/cell_arrays.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/rotation_for_tests.h"

namespace dartboard::stress_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

bool same_bits(const Matrix3d& a, const Matrix3d& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 9) == 0;
}

class Numbers {
 public:
  double operator()() { return static_cast<double>(bits_()) / 2147483648.0 - 1.0; }  // in [-1, 1)
  Vector3d vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937 bits_{5};
};

template <class Map>
std::vector<Matrix3d> stresses(const Body<Map>& body) {
  CellArrays arrays;
  arrays.rebuild(body);
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const EdgeEntry& edge : arrays.edges) ends.push_back(edge.ends);
  std::vector<Matrix3d> stress;
  VolumeRoom room;
  vertex_stresses(ends, body.springs, vertex_volumes(body, {}, room), body.vertices.position, stress);
  return stress;
}

template <class Map>
Body<Map> body_of(const Mesh& mesh) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 8.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  return build_body<Map, Held::by_every_dart>(problem);
}

template <class Map>
void move(Body<Map>& body, const Matrix3d& matrix, const Vector3d& shift = {0, 0, 0}) {
  for (Vector3d& x : body.vertices.position) x = matrix * x + shift;
}

// The present volume (area) at a vertex.
template <class Map>
double volume_now(const Body<Map>& body, std::uint32_t k) {
  VolumeRoom room;
  return vertex_volumes(body, {}, room).now[k];
}

// 1/V times the sum over the springs around a vertex of k (l + L) l: the scale of all roundings in its stress, V the
// present volume.
template <class Map>
double scale_of(const Body<Map>& body, std::uint32_t k) {
  double sum = 0.0;
  for (const Edge e : incident_cells<1>(body.map, Vertex{body.vertices.dart[k]})) {
    const Spring& spring = body.springs[body.edge(body.map, e.dart)];
    const auto other = body.vertex(body.map, body.map.template alpha<0>(e.dart));
    const double length = (body.vertices.position[other] - body.vertices.position[k]).norm();
    sum += spring.stiffness * (length + spring.rest_length) * length;
  }
  return sum / volume_now(body, k);
}

// ---- one spring

// l = 5 and T = 12 are exact; scale 6/5, its product with a side and that with the other round, and so does 1.2 here
TEST(SpringVirial, IsHalfOfTensionTimesLengthAlongTheSpring) {
  const Matrix3d virial = spring_virial({2.0, 4.0, 0.0}, {3, 0, 4});
  Matrix3d expected;
  expected << 9, 0, 12, 0, 0, 0, 12, 0, 16;
  expected *= 1.2;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(virial(i, j), expected(i, j), 5 * u * expected(i, j));
  EXPECT_DOUBLE_EQ(virial.trace(), 0.5 * 12 * 5);
}

TEST(SpringVirial, IsNegativeUnderCompressionAndZeroAtRest) {
  EXPECT_EQ(spring_virial({4.0, 1.0, 0.0}, {0, 2, 0})(1, 1), -2.0);
  EXPECT_EQ(spring_virial({2.0, 1.0, 0.0}, {0, 2, 0}), Matrix3d::Zero());
}

TEST(SpringVirial, IsZeroForZeroLength) { EXPECT_EQ(spring_virial({1.0, 10.0, 1.0}, {0, 0, 0}), Matrix3d::Zero()); }

TEST(SpringVirial, HasTheSameBitsFromEitherEnd) {
  Numbers number;
  for (int k = 0; k < 300; ++k) {
    const Vector3d dx = number.vector();
    const Spring spring{number() + 1.0, 100 * (number() + 1.0), 0.0};
    EXPECT_TRUE(same_bits(spring_virial(spring, dx), spring_virial(spring, -dx)));
  }
}

TEST(VertexStresses, OfASingleSpringAreEqualAtItsEnds) {
  const std::vector<std::array<std::uint32_t, 2>> ends{{1, 0}};
  const std::vector<Spring> springs{{2.0, 4.0, 9.0}};
  const std::vector<double> mass{2.0, 2.0, 2.0};
  const std::vector<Vector3d> position{{1, 1, 1}, {1, 1, 5}, {0, 0, 0}};
  std::vector<Matrix3d> stress{7, Matrix3d::Ones()};  // earlier values do not matter
  vertex_stresses(ends, springs, {mass, 8.0}, position, stress);
  ASSERT_EQ(stress.size(), 3u);
  Matrix3d expected = Matrix3d::Zero();
  expected(2, 2) = 0.5 * 8.0 * 4.0 / 0.25;  // T = 4 (4 - 2), l = 4, V = 2 / 8
  EXPECT_EQ(stress[0], expected);
  EXPECT_EQ(stress[1], expected);
  EXPECT_EQ(stress[2], Matrix3d::Zero());
}

// ---- bodies

template <class Map>
struct Stress : testing::Test {
  static Mesh mesh() {
    if constexpr (Map::dimension == 2)
      return sheet(5, 4, true, true, true);
    else
      return kuhn_grid(3, 2, 2, 0.5, 0.1, 4);
  }
};
using Maps = testing::Types<Map2, Map3, TetMap>;
TYPED_TEST_SUITE(Stress, Maps);

TYPED_TEST(Stress, IsTheSameToTheBitByWalkingAndByArraysAfterCutsToo) {
  auto body = body_of<TypeParam>(this->mesh());
  Numbers number;
  for (Vector3d& x : body.vertices.position) x += 0.05 * number.vector();
  for (int round = 0; round < 3; ++round) {
    const auto all = stresses(body);
    ASSERT_EQ(all.size(), body.vertices.size());
    for (std::uint32_t k = 0; k < all.size(); ++k) ASSERT_TRUE(same_bits(all[k], vertex_stress(body, k))) << k;
    std::vector<Dart> some;
    for (std::uint32_t d = 0; d < body.map.capacity(); d += 17) some.push_back({d});
    adapt(body, dissociate_all(body.map, std::span(some).subspan(0, some.size() / 3)));
  }
}

TYPED_TEST(Stress, IsSymmetric) {
  auto body = body_of<TypeParam>(this->mesh());
  Numbers number;
  for (Vector3d& x : body.vertices.position) x += 0.05 * number.vector();
  for (const Matrix3d& stress : stresses(body)) EXPECT_EQ(stress, stress.transpose());
}

TYPED_TEST(Stress, DoesNotDependOnVelocities) {
  auto body = body_of<TypeParam>(this->mesh());
  move(body, 1.25 * Matrix3d::Identity());
  const auto at_rest = stresses(body);
  Numbers number;
  for (Vector3d& v : body.vertices.velocity) v = number.vector();
  const auto moving = stresses(body);
  for (std::size_t k = 0; k < moving.size(); ++k) EXPECT_TRUE(same_bits(at_rest[k], moving[k]));
}

// What rounds, for a spring: a coordinate difference, by u; its length from these, by 3 u (three squares, two sums, a
// root), the rest length likewise; so the stretch by 3 u (l + L) + u |l - L| <= 4 u (l + L). The scale takes three more
// operations and an entry two, and two differences: an entry of at most 1/2 k |l - L| l is off by
// 1/2 k l (4 u (l + L) + 7 u |l - L|) <= 6 u k (l + L) l. The sum of n springs adds n u, mass and quotients 3 u; what
// is compared with is long double and no concern. Hence (n + 9) u times scale_of, and 1.01 for second-order terms. The
// volume of a cell takes three differences of coordinates, a cross and an inner product, 9 u of the product of three
// sides, which in these bodies is at most 12 times the volume; 24 cells sum to a vertex's: 132 u.
template <class Map>
double rounding_of(const Body<Map>& body, std::uint32_t k) {
  const auto springs = static_cast<double>(incident_cells<1>(body.map, Vertex{body.vertices.dart[k]}).size());
  return 1.01 * (springs + 9 + 132) * u * scale_of(body, k);
}

TYPED_TEST(Stress, OfAnAffineStretchIsThatOfTheSpringsOfTheMesh) {
  using Long = long double;
  using Vector = Eigen::Matrix<Long, 3, 1>;
  using Matrix = Eigen::Matrix<Long, 3, 3>;
  const Mesh mesh = this->mesh();
  auto body = body_of<TypeParam>(mesh);
  Matrix3d stretch;
  stretch << 1.25, 0.125, 0, -0.25, 0.75, 0.5, 0, 0.125, 1.5;
  move(body, stretch, {1, -2, 0.5});
  std::vector<Vector> x(mesh.points.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    x[body.vertices.point[k]] = body.vertices.position[k].template cast<Long>();

  // once for each cell: stiffnesses of parallel springs add up
  std::vector<Matrix> virial(x.size(), Matrix::Zero());
  std::vector<Long> volume(x.size(), 0);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto corner = mesh.cell(c);
    const auto side = [&](std::size_t k) -> Vector { return x[corner[k]] - x[corner[0]]; };
    Vector normal = side(1).cross(side(2));
    if (mesh.kinds[c] == CellKind::quadrilateral) normal += side(2).cross(side(3));
    const Long size = mesh.kinds[c] == CellKind::tetrahedron ? std::abs(normal.dot(side(3))) / 6 : normal.norm() / 2;
    for (const std::uint32_t k : corner) volume[k] += size / Long(corner.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& face : faces_of(mesh.kinds[c]))
      for (std::size_t e = 0; e < face.size(); ++e)
        edges[std::minmax(mesh.cell(c)[static_cast<std::size_t>(face[e])],
                          mesh.cell(c)[static_cast<std::size_t>(face[(e + 1) % face.size()])])] = 1;
    for (const auto& [ends, once] : edges) {
      const auto [a, b] = ends;
      const Vector dx = x[b] - x[a];
      const Long rest = (mesh.points[b].template cast<Long>() - mesh.points[a].template cast<Long>()).norm();
      const Matrix term = Long(0.5) * 4 * (dx.norm() - rest) / dx.norm() * dx * dx.transpose();
      virial[a] += term;
      virial[b] += term;
    }
  }
  const auto stress = stresses(body);
  for (std::uint32_t k = 0; k < stress.size(); ++k) {
    const Matrix expected = virial[body.vertices.point[k]] / volume[body.vertices.point[k]];
    EXPECT_LE((stress[k] - expected.template cast<double>()).template lpNorm<Eigen::Infinity>(), rounding_of(body, k));
  }
}

// Turning and shifting a point at distance X of the origin by s rounds by at most 8 u (X + s) in each coordinate: the
// matrix entries by u, three products, three sums, with |r_i1| + |r_i2| + |r_i3| <= sqrt(3). A spring's vector is off
// by d = 2 sqrt(3) 8 u (X + s) at most. The derivative of 1/2 k (1 - L/l) dx dx^T is at most 1/2 k (L + 2 |l - L|) <= k
// (l + L); so an entry is off by d k (l + L), over l of its share in scale_of.
template <class Map>
double turning_of(const Body<Map>& body, std::uint32_t k, double reach) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Spring& spring : body.springs) shortest = std::min(shortest, 0.5 * spring.rest_length);
  return 28 * u * reach / shortest * scale_of(body, k);
}

// No length is below half of the rest length in these motions. The largest |coordinate| is below 8.
TYPED_TEST(Stress, OfARigidMotionIsZero) {
  for (const Matrix3d& turn : some_rotations()) {
    auto body = body_of<TypeParam>(this->mesh());
    move(body, turn, {1, 2, -3});
    const auto stress = stresses(body);
    for (std::uint32_t k = 0; k < stress.size(); ++k)
      EXPECT_LE(stress[k].template lpNorm<Eigen::Infinity>(), rounding_of(body, k) + turning_of(body, k, 16));
  }
}

TYPED_TEST(Stress, TurnsWithTheBody) {
  for (const Matrix3d& turn : some_rotations()) {
    auto body = body_of<TypeParam>(this->mesh());
    move(body, Vector3d(0.875, 1.25, 1.5).asDiagonal());
    const auto before = stresses(body);
    move(body, turn);
    const auto after = stresses(body);
    for (std::uint32_t k = 0; k < after.size(); ++k) {
      // R S R^T: 2 * 3 products and sums, entries of R by u each, on entries of at most 3 |S| and |S| <= scale_of
      const double product = 30 * u * scale_of(body, k);
      EXPECT_LE((after[k] - turn * before[k] * turn.transpose()).template lpNorm<Eigen::Infinity>(),
                2 * rounding_of(body, k) + turning_of(body, k, 16) + product);
    }
  }
}

// "the sum of V sigma over all vertices is the virial of all springs": half at each end
TYPED_TEST(Stress, TimesVolumeSumsToTheVirialOfAllSprings) {
  auto body = body_of<TypeParam>(this->mesh());
  move(body, Vector3d(0.875, 1.25, 1.5).asDiagonal());
  const auto stress = stresses(body);
  Matrix3d sum = Matrix3d::Zero(), virial = Matrix3d::Zero();
  double bound = 0.0;
  for (std::uint32_t k = 0; k < stress.size(); ++k) {
    const double volume = volume_now(body, k);
    sum += volume * stress[k];
    bound += volume * (rounding_of(body, k) + static_cast<double>(stress.size()) * u * scale_of(body, k));
  }
  CellArrays arrays;
  arrays.rebuild(body);
  for (const EdgeEntry& e : arrays.edges)
    virial += 2.0 * spring_virial(body.springs[e.embedding],
                                  body.vertices.position[e.ends[1]] - body.vertices.position[e.ends[0]]);
  bound *= 1 + static_cast<double>(arrays.edges.size());  // the sum of the virials rounds as often as it has terms
  EXPECT_LE((sum - virial).template lpNorm<Eigen::Infinity>(), bound);
}

// Around an inner vertex, six springs of 4 cells each, of tension T = 4 k a (s - 1) along an axis that is stretched by
// s: the force on the present area of a spring. On the surface springs and volume are reduced alike, so that the stress
// is the same there.
TEST(StressOfHexahedra, IsTheForceOnTheAreaThereIsNowToTheSurface) {
  for (const Vector3d& stretch : {Vector3d(1, 1, 1.5), Vector3d(1.25, 0.75, 1.5), Vector3d(1.25, -0.75, 1.5)}) {
    auto body = body_of<Map3>(hexahedron_box(3, 2, 2, 0.5));
    move(body, stretch.asDiagonal());
    const double size = stretch.cwiseAbs().prod();
    for (const Matrix3d& stress : stresses(body))
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double s = std::abs(stretch[i]), force = 4 * 4.0 * 0.5 * (s - 1), area = 0.5 * 0.5 * size / s;
          // lengths are exact; the volume of a cell sums 6 faces and that of a vertex 8 cells, the stress 6 springs
          EXPECT_NEAR(stress(i, j), i == j ? force / area : 0.0, 64 * u * 16.0);
        }
  }
}

// "of what it was at rest, the volume at a vertex counts as this at least"
TEST(StressOfHexahedra, IsPerHundredthOfTheVolumeAtRestWhereCellsAreFlatter) {
  for (const double s : {0.005, 0.0}) {
    auto body = body_of<Map3>(hexahedron_box(3, 2, 2, 0.5));
    move(body, Vector3d(1.5, 1, s).asDiagonal());
    // per volume at rest the stretched axis has 4 k s (s - 1) / a
    const double expected = 4 * 4.0 * 1.5 * 0.5 / 0.5 / least_volume;
    for (const Matrix3d& stress : stresses(body)) EXPECT_NEAR(stress(0, 0), expected, 64 * u * expected);
  }
}

// ---- several materials

// A cell of springs among elements has the volume that it has among springs, inside out too.
TEST(StressOfSpringsAmongElements, IsPerVolumeNow) {
  Problem problem;
  problem.mesh = hexahedron_box(3, 1, 1, 0.5);
  problem.materials = {{.density = 8.0, .stiffness = 4.0, .damping = 0.0, .viscosity = 0.0},
                       {.density = 8.0,
                        .stiffness = 0.0,
                        .damping = 0.0,
                        .viscosity = 0.0,
                        .young = 100.0,
                        .poisson = 0.25,
                        .model = Model::neo_hookean}};
  problem.cell_material = {0, 0, 1};
  auto mixed = build_body<Map3, Held::by_every_dart>(problem);
  for (const double s : {1.5, -1.5}) {
    int at_springs = 0;
    for (std::uint32_t k = 0; k < mixed.vertices.size(); ++k) {
      const Vector3d& rest = problem.mesh.points[mixed.vertices.point[k]];
      mixed.vertices.position[k] = rest.cwiseProduct(Vector3d(1, 1, s));
    }
    for (std::uint32_t k = 0; k < mixed.vertices.size(); ++k) {
      if (mixed.vertices.position[k].x() != 0.0) continue;
      ++at_springs;
      // at the end a spring of one cell represents a fourth of the section
      EXPECT_NEAR(vertex_stress(mixed, k)(2, 2), 4.0 * 0.5 * 0.5 / (0.25 * 0.5 * 0.5), 64 * u * 16.0);
    }
    EXPECT_EQ(at_springs, 4);
  }
}

// ---- measures

constexpr double infinite = std::numeric_limits<double>::infinity();

// The values as in expect_principal below; the von Mises stress takes a root of three squares of their differences.
void expect_measures(const Matrix3d& stress, const StressMeasures& expected) {
  const StressMeasures measures = measures_of(stress);
  const double bound = 128 * u * stress.norm();
  EXPECT_EQ(measures.largest_principal, principal_stress(stress).value);
  EXPECT_NEAR(measures.largest_principal, expected.largest_principal, bound);
  EXPECT_NEAR(measures.largest_magnitude, expected.largest_magnitude, bound);
  EXPECT_NEAR(measures.von_mises, expected.von_mises, bound);
}

TEST(StressMeasures, OfAUniaxialStressAreItsSize) {
  expect_measures(Vector3d(0, 3, 0).asDiagonal(), {3, 3, 3});
  expect_measures(Vector3d(0, 0, -3).asDiagonal(), {0, 3, 3});
}

TEST(StressMeasures, OfPressureHaveNoVonMisesStress) {
  expect_measures(-5 * Matrix3d::Identity(), {-5, 5, 0});
  expect_measures(Matrix3d::Zero(), {0, 0, 0});
}

// von Mises (1913): the stress under which a material yields in shear is the root of three times the shear
TEST(StressMeasures, OfPureShearIsTheRootOfThreeTimesIt) {
  Matrix3d shear = Matrix3d::Zero();
  shear(0, 1) = shear(1, 0) = 2;
  expect_measures(shear, {2, 2, 2 * std::sqrt(3.0)});
}

// sqrt(3/2) times the norm of the deviator, computed with other numbers: its entries
TEST(StressMeasures, AreTheSameInAnyPositionAndAtAnyScale) {
  for (const Matrix3d& turn : some_rotations())
    for (const double scale : {1.0, 1e-300, 1e300})
      for (const Vector3d& values : {Vector3d(1, 2, 5), Vector3d(5, 5, 1), Vector3d(-7, -2, 5), Vector3d(-1, -2, -3)}) {
        const Matrix3d turned = turn * values.asDiagonal() * turn.transpose();
        const double mises = std::sqrt(1.5) * (values - Vector3d::Constant(values.mean())).norm();
        const StressMeasures measures = measures_of(scale * 0.5 * (turned + turned.transpose()));
        EXPECT_NEAR(measures.largest_principal / scale, values.maxCoeff(), 128 * u * values.norm());
        EXPECT_NEAR(measures.largest_magnitude / scale, values.cwiseAbs().maxCoeff(), 128 * u * values.norm());
        EXPECT_NEAR(measures.von_mises / scale, mises, 128 * u * values.norm());
      }
}

TEST(StressMeasures, OfWhatIsNotFiniteAreInfinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinite, -infinite}) {
    Matrix3d stress = Matrix3d::Identity();
    stress(2, 0) = stress(0, 2) = bad;
    const StressMeasures measures = measures_of(stress);
    EXPECT_EQ(measures.largest_principal, infinite);
    EXPECT_EQ(measures.largest_magnitude, infinite);
    EXPECT_EQ(measures.von_mises, infinite);
  }
}

// ---- principal stress

// Householder's step and each sweep of the iteration turn a 3 x 3 matrix by an orthogonal one, a few u of its norm
// each; it converges in two or three sweeps, so 64 u of the norm is ample. The residual bounds the error of the value.
void expect_principal(const Matrix3d& stress, double value) {
  const PrincipalStress principal = principal_stress(stress);
  const double bound = 64 * u * stress.norm();
  EXPECT_NEAR(principal.value, value, bound);
  EXPECT_NEAR(principal.direction.norm(), 1.0, 4 * u);
  EXPECT_LE((stress * principal.direction - value * principal.direction).norm(), 2 * bound);
  Eigen::Index largest = 0;
  principal.direction.cwiseAbs().maxCoeff(&largest);
  EXPECT_GT(principal.direction[largest], 0.0);
}

TEST(PrincipalStress, IsTheLargestEigenvalueAndNotTheLargestInMagnitude) {
  expect_principal(Vector3d(1, -7, 2).asDiagonal(), 2);
  EXPECT_EQ(principal_stress(Vector3d(1, -7, 2).asDiagonal()).direction, Vector3d(0, 0, 1));
  EXPECT_EQ(principal_stress(Vector3d(3, -7, 2).asDiagonal()).direction, Vector3d(1, 0, 0));
  expect_principal(Vector3d(-3, -7, -2).asDiagonal(), -2);
}

TEST(PrincipalStress, IsFoundInAnyPositionAndAtAnyScale) {
  for (const Matrix3d& turn : some_rotations())
    for (const double scale : {1.0, 1e-150, 1e150})
      for (const Vector3d& values : {Vector3d(1, 2, 5), Vector3d(5, 5, 1), Vector3d(-1, -2, -5), Vector3d(5, 5, 5),
                                     Vector3d(1, 5, 5 - 1e-9), Vector3d(1e-9, 0, 1)}) {
        const Matrix3d turned = turn * values.asDiagonal() * turn.transpose();
        expect_principal(scale * 0.5 * (turned + turned.transpose()), scale * values.maxCoeff());
      }
}

TEST(PrincipalStress, OfNoStressIsZeroInSomeDirection) {
  expect_principal(Matrix3d::Zero(), 0);
  expect_principal(Matrix3d::Identity(), 1);
}

TEST(PrincipalStress, OfWhatIsNotFiniteIsRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Matrix3d stress = Matrix3d::Identity();
    stress(1, 0) = stress(0, 1) = bad;
    EXPECT_THROW(principal_stress(stress), SolverError);
  }
}

TEST(PrincipalStressOfABody, IsTheLargestOfItsVertices) {
  EXPECT_EQ(largest_principal_stress({}), 0.0);
  std::vector<Matrix3d> stresses{Vector3d(-3, -7, -2).asDiagonal(), Vector3d(-5, -1, -9).asDiagonal()};
  EXPECT_EQ(largest_principal_stress(stresses), -1.0);
  stresses.push_back(Vector3d(1, 4, -20).asDiagonal());
  EXPECT_EQ(largest_principal_stress(stresses), 4.0);
  stresses[0](1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(largest_principal_stress(stresses), std::numeric_limits<double>::infinity());
}

// Eigenvalues are found of some vertices only: of shear, a bound by the diagonal alone would leave it out, and of ones,
// whose largest eigenvalue is the sum of a row, rounding can put it above a bound without it.
TEST(PrincipalStressOfABody, IsThatOfAVertexWhoseDiagonalIsSmaller) {
  Matrix3d shear = Matrix3d::Zero();
  shear(0, 2) = shear(2, 0) = 5;
  EXPECT_NEAR(largest_principal_stress(std::vector<Matrix3d>{Vector3d(4, 0, 0).asDiagonal(), shear}), 5, 128 * 5 * u);
  int above = 0;
  for (int k = 1; k < 200; ++k) {
    const double sum = 3.0 * k;
    const Matrix3d ones = Matrix3d::Constant(k);
    const double value = measures_of(ones).largest_principal;
    above += value > sum;
    EXPECT_EQ(largest_principal_stress(std::vector<Matrix3d>{Vector3d(sum, 0, 0).asDiagonal(), ones}),
              std::max(sum, value));
  }
  EXPECT_GT(above, 0);
}

TEST(PrincipalStressOfABody, IsNegativeUnderPressureFromAllSides) {
  auto body = body_of<Map3>(hexahedron_box(2, 2, 2, 0.5));
  move(body, 0.5 * Matrix3d::Identity());
  for (const Matrix3d& stress : stresses(body)) EXPECT_LT(principal_stress(stress).value, 0.0);
}

}  // namespace
}  // namespace dartboard::stress_test
