#include "core/walks/spring_forces.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "core/walks/cell_arrays.h"
#include "core/walks/dart_coverage.h"
#include "core/walks/embedding_lists.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::spring_forces_test {
namespace {

using Eigen::Vector3d;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

bool same_bits(const Vector3d& a, const Vector3d& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}

// Multiples of 2^-16 in [-1, 1): exact under addition of one another.
class Numbers {
 public:
  double operator()() { return static_cast<double>(bits_() % 131072) / 65536.0 - 1.0; }
  Vector3d vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937 bits_{11};
};

TEST(SpringForce, IsHookesLawAlongTheSpring) {
  // length 5, stretched by 1: 2 N towards the other end; 1/5 and two products round, so 3 u, and u for the expectation
  const Vector3d f = spring_force({4.0, 2.0, 0.0}, {3, 0, 4}, {0, 0, 0});
  EXPECT_NEAR(f.x(), 1.2, 4 * u * 1.2);
  EXPECT_EQ(f.y(), 0.0);
  EXPECT_NEAR(f.z(), 1.6, 4 * u * 1.6);
}

TEST(SpringForce, PushesWhenCompressed) {
  EXPECT_EQ(spring_force({2.0, 8.0, 0.0}, {0, 1, 0}, {0, 0, 0}), Vector3d(0, -8, 0));
}

TEST(SpringForce, DampsTheVelocityAlongTheSpringOnly) {
  EXPECT_EQ(spring_force({2.0, 8.0, 0.5}, {0, 2, 0}, {7, 3, -7}), Vector3d(0, 1.5, 0));
}

TEST(SpringForce, IsZeroForZeroLength) {
  EXPECT_EQ(spring_force({1.0, 10.0, 1.0}, {0, 0, 0}, {1, 1, 1}), Vector3d(0, 0, 0));
}

TEST(SpringForce, IsOppositeToTheBitWhenTheEndsAreExchanged) {
  Numbers number;
  for (int k = 0; k < 1000; ++k) {
    const Spring spring{number() + 1.0, 100 * (number() + 1.0), number() + 1.0};
    const Vector3d a = number.vector() / 3.0, b = number.vector() / 7.0;
    const Vector3d va = number.vector() / 3.0, vb = number.vector();
    const Vector3d f = spring_force(spring, b - a, vb - va), g = spring_force(spring, a - b, va - vb);
    ASSERT_TRUE(same_bits(f, -g)) << f.transpose() << " and " << g.transpose();
  }
}

// Central differences of E = k/2 (l - L)^2 with step s, exact points: the truncation is s^2/6 |E'''| with
// E''' = -k L l''' and |l'''| <= 3 max(cos sin^2) / l^2 = (2 / sqrt 3) / l^2, taken at length l - s. The rounding of
// each E is at most 10 u k (l + L + s)^2 (three squares, a root of relative error 2.5 u, a difference, a square, two
// products), and the difference quotient divides two of them by 2 s. The force itself carries 10 u k (l + L).
TEST(SpringForce, IsMinusTheGradientOfTheEnergy) {
  Numbers number;
  const double s = 1.0 / 1024;
  for (int k = 0; k < 300; ++k) {
    const Spring spring{0.5 + 0.25 * number(), 40.0, 0.0};
    const Vector3d dx = number.vector();
    const double l = dx.norm(), L = spring.rest_length;
    if (l < 0.125) continue;
    const auto energy = [&](const Vector3d& first_end) {
      const double stretch = (dx - first_end).norm() - L;
      return 0.5 * spring.stiffness * (stretch * stretch);
    };
    const Vector3d force = spring_force(spring, dx, {0, 0, 0});
    const double truncation = s * s / 6 * spring.stiffness * L * 1.1548 / ((l - s) * (l - s));
    const double rounding = 10 * u * spring.stiffness * (l + L + s) * ((l + L + s) / s + 1);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = s * Vector3d::Unit(axis);
      EXPECT_NEAR(force[axis], -(energy(step) - energy(-step)) / (2 * s), truncation + rounding);
    }
  }
}

TEST(SpringForce, OfDampingNeverAddsEnergy) {
  Numbers number;
  for (int k = 0; k < 1000; ++k) {
    const Vector3d dx = number.vector(), dv = number.vector();
    const Vector3d force_on_first = spring_force({dx.norm(), 0.0, 3.0}, dx, dv);
    // power on both ends, f.va - f.vb; its sign survives rounding because it is a square to within 5 u of its terms
    EXPECT_LE(-force_on_first.dot(dv), 10 * u * 3.0 * dv.squaredNorm());
  }
}

template <class Body>
void disturb(Body& body) {
  PointState state = body.state();
  Numbers number;
  for (auto& x : state.x) x += 0.05 * number.vector();
  for (auto& v : state.v) v = number.vector();
  body.set_state(state);
}

Problem a_problem() {
  Problem problem;
  problem.mesh = kuhn_grid(3, 2, 2, 0.5, 0.1, 4);
  return problem;
}

template <class Map, Held held, class Walk>
std::vector<Vector3d> forces_by_point() {
  auto body = build_body<Map, held>(a_problem());
  disturb(body);
  Walk walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  add_spring_forces(walk, body);
  std::vector<Vector3d> forces(body.vertices.size());
  for (std::size_t k = 0; k < forces.size(); ++k) forces[body.vertices.point[k]] = body.vertices.force[k];
  return forces;
}

TEST(SpringForces, HaveTheSameBitsOnEveryWalkStorageAndHolding) {
  constexpr auto one = Held::by_one_dart, every = Held::by_every_dart;
  const auto expected = forces_by_point<Map3, one, DartCoverage>();
  for (const auto& found :
       {forces_by_point<Map3, every, DartCoverage>(), forces_by_point<Map3, one, EmbeddingLists>(),
        forces_by_point<Map3, every, CellArrays>(), forces_by_point<TetMap, one, DartCoverage>(),
        forces_by_point<TetMap, every, EmbeddingLists>(), forces_by_point<TetMap, one, CellArrays>()}) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t p = 0; p < found.size(); ++p) EXPECT_TRUE(same_bits(found[p], expected[p])) << "point " << p;
  }
}

// The sum is exactly zero spring by spring; what is left is the rounding of the sums: each of the 2E additions into a
// vertex and V in the total rounds a partial sum that is at most the sum F of all |f|, so (2E + V) u F bounds it.
TEST(SpringForces, SumToZeroWithinTheRoundingOfTheSum) {
  auto body = build_body<TetMap, Held::by_every_dart>(a_problem());
  disturb(body);
  double all = 0;
  DartCoverage::for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
    const auto& v = body.vertices;
    all += 2 * spring_force(body.springs[e], v.position[b] - v.position[a], v.velocity[b] - v.velocity[a]).norm();
  });
  add_spring_forces(DartCoverage{}, body);
  Vector3d sum(0, 0, 0);
  for (const auto& f : body.vertices.force) sum += f;
  const auto terms = static_cast<double>(2 * body.springs.size() + body.vertices.size());
  EXPECT_LE(sum.lpNorm<Eigen::Infinity>(), terms * u * all);
}

TEST(SpringForces, AreAddedToWhatIsThere) {
  auto body = build_body<TetMap, Held::by_one_dart>(a_problem());
  body.vertices.force[3] = {1, 2, 3};
  for (std::size_t e = 0; e < body.springs.size(); ++e)
    body.springs.change(e, [](Spring& spring) { spring.stiffness = spring.damping = 0; });
  add_spring_forces(DartCoverage{}, body);
  EXPECT_EQ(body.vertices.force[3], Vector3d(1, 2, 3));
}

// Drag 0.5 m times 4, force 6 m, gravity -8. At most four operations round, on terms of at most 8.
TEST(Acceleration, IsForceLessDragOverMassPlusGravity) {
  auto body = build_body<TetMap, Held::by_one_dart>(a_problem());
  auto& v = body.vertices;
  v.viscosity[0] = 0.5 * v.mass[0];
  v.velocity[0] = {4, 0, 0};
  v.force[0] = v.mass[0] * Vector3d(6, 0, 3);
  const Vector3d a = acceleration(v, {0, 0, -8}, 0);
  EXPECT_NEAR(a.x(), 4, 4 * u * 8);
  EXPECT_EQ(a.y(), 0);
  EXPECT_NEAR(a.z(), -5, 4 * u * 8);
}

TEST(Acceleration, OfAFixedVertexIsZero) {
  auto body = build_body<TetMap, Held::by_one_dart>(a_problem());
  body.vertices.fixed[0] = 1;
  body.vertices.force[0] = {1, 2, 3};
  EXPECT_EQ(acceleration(body.vertices, {0, 0, -8}, 0), Vector3d(0, 0, 0));
}

}  // namespace
}  // namespace dartboard::spring_forces_test
