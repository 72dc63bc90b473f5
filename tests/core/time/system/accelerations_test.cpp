#include "core/time/system/accelerations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/system/energy.h"
#include "core/walks/spring_forces.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::accelerations_test {
namespace {

using Eigen::Vector3d;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

auto a_body(double damping, double viscosity, std::vector<std::uint32_t> fixed) {
  Problem problem;
  problem.mesh = kuhn_grid(2, 2, 2, 0.5, 0.1, 2);
  problem.material.damping = damping;
  problem.material.viscosity = viscosity;
  problem.fixed = std::move(fixed);
  return build_body<TetMap, Held::by_one_dart>(problem);
}

std::vector<Vector3d> accelerations_of(const SpringArrays& arrays, const Terms& terms) {
  std::vector<Vector3d> a(arrays.x.size(), Vector3d(7, 7, 7));  // earlier values do not matter
  accelerations(arrays.system(), terms, arrays.x, arrays.v, a);
  return a;
}

TEST(Accelerations, HaveTheBitsOfTheWalk) {
  for (const bool damped : {false, true})
    for (const bool viscous : {false, true})
      for (const bool held : {false, true}) {
        auto body = a_body(damped ? 0.5 : 0.0, viscous ? 0.25 : 0.0,
                           held ? std::vector<std::uint32_t>{0, 13} : std::vector<std::uint32_t>{});
        SpringArrays arrays = arrays_of(body);
        disturb(arrays);
        body.vertices.position = arrays.x;
        body.vertices.velocity = arrays.v;
        CellArrays cells;
        cells.rebuild(body);
        add_spring_forces(cells, body);
        const Terms terms = terms_of(arrays.system());
        EXPECT_EQ(terms, (Terms{damped, viscous, held}));
        const auto a = accelerations_of(arrays, terms);
        for (std::uint32_t i = 0; i < a.size(); ++i)
          EXPECT_EQ(a[i], acceleration(body.vertices, body.surroundings.gravity, i)) << i;
      }
}

TEST(Terms, AreThoseOfTheLastSpringAndVertexToo) {
  SpringArrays arrays;
  for (int i = 0; i < 3; ++i) arrays.add_vertex(1.0, {1.0 * i, 0, 0});
  arrays.add_spring(0, 1, 1.0, 1.0);
  arrays.add_spring(1, 2, 1.0, 1.0);
  EXPECT_EQ(terms_of(arrays.system()), Terms{});
  arrays.springs[1].damping = 1.0;
  EXPECT_EQ(terms_of(arrays.system()), (Terms{.damping = true}));
  arrays.viscosity[2] = 1.0;
  EXPECT_EQ(terms_of(arrays.system()), (Terms{.damping = true, .viscosity = true}));
  arrays.fixed[2] = 1;
  EXPECT_EQ(terms_of(arrays.system()), (Terms{true, true, true}));
}

TEST(Accelerations, AreTheSameBitsWhenAnAbsentTermIsAskedFor) {
  SpringArrays arrays = arrays_of(a_body(0.0, 0.0, {}));
  disturb(arrays);
  EXPECT_EQ(accelerations_of(arrays, {}), accelerations_of(arrays, {true, true, true}));
}

TEST(Accelerations, LeaveOutWhatTheTermsDoNotName) {
  SpringArrays lossy = arrays_of(a_body(0.5, 0.25, {})), lossless = arrays_of(a_body(0.0, 0.0, {}));
  disturb(lossy);
  disturb(lossless);
  EXPECT_EQ(accelerations_of(lossy, {}), accelerations_of(lossless, {}));
  EXPECT_NE(accelerations_of(lossy, terms_of(lossy.system())), accelerations_of(lossless, {}));
}

TEST(Accelerations, OfASpringWithoutLengthAreNone) {
  SpringArrays arrays;
  arrays.add_vertex(1.0, {1, 2, 3});
  arrays.add_vertex(1.0, {1, 2, 3}, {1, 0, 0});
  arrays.add_spring(0, 1, 10.0, 0.5, 2.0);
  for (const bool damping : {false, true})
    for (const Vector3d& a : accelerations_of(arrays, {.damping = damping})) EXPECT_EQ(a, Vector3d(0, 0, 0));
}

// Central differences with d = 2^-17 are off by d^2/6 times the third derivative of the energy, which for a spring of
// length l is at most 6 k L / l^2, and by the rounding of the energy over d. Here some 14 springs of k <= 300 and l >=
// 0.3 end in a vertex, and the energy, below 100, is the sum of some 100 compensated terms: 4 u 100.
TEST(Accelerations, AreTheDownhillSlopeOfTheEnergy) {
  SpringArrays arrays = arrays_of(a_body(0.0, 0.0, {}));
  disturb(arrays);
  const auto a = accelerations_of(arrays, {});
  const auto energy = [&] {
    return elastic_energy(arrays.system(), arrays.x) + gravity_energy(arrays.system(), arrays.x);
  };
  const double d = 0x1p-17;
  const double tolerance = 14 * d * d * 300 * 0.9 / (0.3 * 0.3) + 4 * u * 1e4 / d;  // gravity's energy is below 1e4
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double here = arrays.x[i][axis];
      arrays.x[i][axis] = here + d;
      const double above = energy();
      arrays.x[i][axis] = here - d;
      const double below = energy();
      arrays.x[i][axis] = here;
      EXPECT_NEAR(a[i][axis] * arrays.mass[i], (below - above) / (2 * d), tolerance);
    }
}

TEST(FrequencyBound, IsExactForTheHighestModeOfAnEndlessChainAndAboveThatOfAFiniteOne) {
  SpringArrays arrays;
  for (int i = 0; i < 9; ++i) arrays.add_vertex(0.25, {1.0 * i, 0, 0});
  for (std::uint32_t i = 0; i < 8; ++i) arrays.add_spring(i, i + 1, 16.0, 1.0);
  EXPECT_EQ(frequency_bound(arrays.system()), 16.0);  // 2 sqrt(k / m)
  EXPECT_EQ(frequency_bound(SpringArrays{}.system()), 0.0);
}

TEST(FrequencyBound, DoesNotLoseWhatIsNotANumber) {
  SpringArrays arrays;
  for (int i = 0; i < 3; ++i) arrays.add_vertex(1.0, {1.0 * i, 0, 0});
  arrays.add_spring(0, 1, NAN, 1.0);
  arrays.add_spring(1, 2, 4.0, 1.0);
  EXPECT_TRUE(std::isnan(frequency_bound(arrays.system())));
}

TEST(FrequencyBound, LooksAtVerticesThatMove) {
  SpringArrays arrays;
  arrays.add_vertex(1.0, {0, 0, 0});
  arrays.add_vertex(1e-9, {1, 0, 0}, {0, 0, 0}, true);
  arrays.add_spring(0, 1, 8.0, 1.0);
  EXPECT_EQ(frequency_bound(arrays.system()), 4.0);
}

}  // namespace
}  // namespace dartboard::accelerations_test
