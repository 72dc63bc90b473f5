// The statements of the schemes compared with closed forms, and with their integrators at the limit.

#include "core/time/method/scheme.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "core/time/method/splitting.h"
#include "reference/closed_form.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::scheme_test {
namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

const Scheme& scheme(const char* name) { return scheme_of(name); }

TEST(Scheme, AmplifiesAsTheClosedFormsSay) {
  for (const double theta : {0.1, 1.0, 1.9}) {
    EXPECT_NEAR(spectral_radius(scheme("explicit-euler"), theta, 0.0), std::sqrt(1 + theta * theta), 8 * u);
    EXPECT_NEAR(spectral_radius(scheme("rk4"), theta, 0.0), std::abs(reference::rk4_amplification({0.0, theta})),
                16 * u);
    for (const char* name : {"symplectic-euler", "verlet"}) {
      EXPECT_NEAR(spectral_radius(scheme(name), theta, 0.0), 1.0, 16 * u) << name;
      EXPECT_NEAR(scheme(name).amplification(theta, 0.0).trace() / 2,
                  static_cast<double>(std::cos(reference::splitting_phase(theta))), 8 * u)
          << name;
    }
    // the change of areas by splittings is exact, here for the oscillator without a force constant: exp(-2 zeta theta)
    EXPECT_NEAR(scheme("verlet").amplification(theta, 0.3).determinant(), std::exp(-0.6 * theta), 16 * u);
  }
}

// To the rounding of each to a double, and of the three sums below 1 behind a4 and b3.
TEST(Scheme, HasTheCoefficientsThatBlanesAndMoanPublished) {
  const auto [a, b] = reference::blanes_moan_numbers();
  const Splitting& ours = blanes_moan_4_splitting();
  ASSERT_EQ(ours.drifts.size(), 6u);
  ASSERT_EQ(ours.kicks.size(), 6u);
  const long double drifts[]{a[0], a[1], a[2], a[3], a[2], a[1]}, kicks[]{b[0], b[1], b[2], b[2], b[1], b[0]};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(ours.drifts[k], static_cast<double>(drifts[k]), 8 * u) << "drift " << k;
    EXPECT_NEAR(ours.kicks[k], static_cast<double>(kicks[k]), 8 * u) << "kick " << k;
  }
  EXPECT_NEAR(ours.last_drift, static_cast<double>(a[0]), u);
}

// Thirteen products of matrices whose entries are below 3.
TEST(Scheme, OfBlanesAndMoanAmplifiesAsTheirNumbersSay) {
  for (const char* name : {"blanes-moan-4", "blanes-moan-4-compensated"})
    for (const double theta : {0.1, 1.0, 3.0})
      for (const double zeta : {0.0, 0.3}) {
        const Eigen::Matrix2d theory = reference::blanes_moan_step(theta, zeta).cast<double>();
        EXPECT_LE((scheme(name).amplification(theta, zeta) - theory).cwiseAbs().maxCoeff(), 13 * 9 * 4 * u)
            << name << " at " << theta << ", zeta " << zeta;
      }
}

// The amplification differs from exp of the oscillator's matrix by O(theta^(order + 1)): halving theta divides the
// difference by 2^(order + 1), which at theta = 1/16 is seen to within a tenth.
TEST(Scheme, HasTheOrderItClaims) {
  for (const IntegratorEntry& entry : integrators())
    for (const double zeta : {0.0, 0.3}) {
      const Scheme& s = entry.make()->scheme();
      if (!s.one_step) continue;
      const auto defect = [&](double theta) {
        Eigen::Matrix2d exact = Eigen::Matrix2d::Identity(), term = exact;
        for (int k = 1; k < 20; ++k) {
          term = term * test_oscillator(theta, zeta) / k;
          exact += term;
        }
        return (s.amplification(theta, zeta) - exact).norm();
      };
      EXPECT_NEAR(std::log2(defect(1.0 / 16) / defect(1.0 / 32)), s.order + 1, 0.1) << entry.name << ", zeta " << zeta;
    }
}

// Over 10^9 steps a growth by e is one of 1e-9 per step: weaker growth lies below the last digit.
TEST(Scheme, IsStableOnTheImaginaryAxisUpToItsLimit) {
  for (const IntegratorEntry& entry : integrators()) {
    const Scheme& s = entry.make()->scheme();
    const double limit = stable_limit(s, 0.0, 1e9, std::exp(1.0), 50.0);
    if (s.imaginary_limit == Scheme::unlimited)
      EXPECT_EQ(limit, Scheme::unlimited) << entry.name;
    else
      EXPECT_NEAR(limit, s.imaginary_limit, 1e-3 * std::max(s.imaginary_limit, 0.1)) << entry.name;
  }
}

TEST(Scheme, OfVerletIsStableUpToTwoWhateverTheDamping) {
  for (const double zeta : {0.0, 0.1, 0.5, 1.0, 5.0})
    EXPECT_NEAR(stable_limit(scheme("verlet"), zeta, 1e9, 2.0), 2.0, 1e-6) << zeta;
}

// Roots of |R(z)| = 1 along the rays of damped oscillations; not monotone in the damping.
TEST(Scheme, OfRungeKuttaHasALimitThatDependsOnTheDamping) {
  const double known[][2] = {{0.01, 2.848}, {0.1, 2.951}, {0.2, 2.940}, {0.5, 2.6225}, {1.0, 2.785}, {2.0, 0.746}};
  for (const auto& [zeta, limit] : known) EXPECT_NEAR(stable_limit(scheme("rk4"), zeta, 1e9, 2.0), limit, 6e-4) << zeta;
}

// Where 1 - z, and 1 - z + z^2/2 - z^3/6 + z^4/24, leave the unit circle. A growth by 2 within 10^5 steps is one of
// 7e-6 a step.
TEST(Scheme, IsStableUnderDampingAloneUpToItsLimitOnTheRealAxis) {
  EXPECT_NEAR(damping_limit(scheme("explicit-euler"), 1e5, 2.0), 2.0, 1e-4);
  EXPECT_NEAR(damping_limit(scheme("rk4"), 1e5, 2.0), 2.7852936, 1e-4);
  for (const char* name : {"symplectic-euler", "verlet", "backward-euler", "sdirk2"})
    EXPECT_EQ(damping_limit(scheme(name), 1e5, 2.0), Scheme::unlimited) << name;
}

TEST(Scheme, RefusesALimitWithoutGrowth) {
  EXPECT_THROW(stable_limit(scheme("rk4"), 0.0, 10, 1.0), InputError);
  EXPECT_THROW(stable_limit(scheme("rk4"), 0.0, 0, 2.0), InputError);
}

// ---- measured limits

struct Tried {
  const char* name;
  double zeta;
};
std::ostream& operator<<(std::ostream& out, const Tried& t) { return out << t.name << ", zeta = " << t.zeta; }

constexpr int steps = 3000;
constexpr double gain = 1e3;
constexpr double a = 0x1p-20;  // a thousand times that is well below the length 1, so the oscillator stays linear

// Whether 3000 steps amplify (omega q, v) a thousandfold: of a mass on a fixed spring with omega = 2, ...
bool run_grows(const Tried& tried, double theta) {
  SpringArrays arrays;
  const auto wall = arrays.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
  arrays.add_spring(wall, arrays.add_vertex(1.0, {1.0 + a, 0, 0}, {a, 0, 0}), 4.0, 1.0, 4.0 * tried.zeta);
  const auto integrator = make_integrator(tried.name);
  for (int k = 0; k < steps; ++k)
    if (!integrator->step(arrays.system(), arrays.motion(), theta / 2.0).ok() ||
        std::hypot(2.0 * (arrays.x[1].x() - 1.0), arrays.v[1].x()) > gain * std::hypot(2.0 * a, a))
      return true;
  return false;
}

// ... and of the matrix that the scheme declares, from the same start.
bool scheme_grows(const Tried& tried, double theta) {
  const Eigen::Matrix2d step = scheme(tried.name).amplification(theta, tried.zeta);
  Eigen::Vector2d y(2.0 * a, a);
  const double start = y.norm();
  for (int k = 0; k < steps; ++k) {
    y = step * y;
    if (y.norm() > gain * start) return true;
  }
  return false;
}

template <class Grows>
double first_growth(Grows&& grows, const Tried& tried, double low, double high) {
  EXPECT_FALSE(grows(tried, low)) << low;
  EXPECT_TRUE(grows(tried, high)) << high;
  while (high - low > 1e-6 * low) {
    const double middle = (low + high) / 2;
    (grows(tried, middle) ? high : low) = middle;
  }
  return low;
}

struct MeasuredLimit : testing::TestWithParam<Tried> {};

// The powers of the spectral radius alone are within 0.2 % of both: eigenvectors at an angle add a factor to the
// growth, and coinciding ones a factor that grows with the steps.
TEST_P(MeasuredLimit, IsThatOfTheSchemeForARunOfThatLength) {
  const Tried tried = GetParam();
  const double near = stable_limit(scheme(tried.name), tried.zeta, steps, gain);
  if (near == Scheme::unlimited) {
    for (const double theta : {2.0, 4.0, 8.0, 16.0}) EXPECT_FALSE(run_grows(tried, theta)) << theta;
    return;
  }
  const double predicted = first_growth(scheme_grows, tried, 0.99 * near, 1.002 * near);
  EXPECT_NEAR(predicted, near, 2e-3 * near);
  EXPECT_NEAR(first_growth(run_grows, tried, 0.99 * near, 1.002 * near), predicted, 1e-3 * predicted);
}

std::vector<Tried> all_explicit() {
  std::vector<Tried> all;
  for (const char* name : {"explicit-euler", "symplectic-euler", "verlet", "verlet-compensated", "blanes-moan-4",
                           "blanes-moan-4-compensated", "rk4", "dormand-prince-54"})
    for (const double zeta : {0.0, 0.01, 0.1, 0.5, 1.0}) all.push_back({name, zeta});
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, MeasuredLimit, testing::ValuesIn(all_explicit()), [](const auto& tested) {
  std::string name = std::string(tested.param.name) + std::to_string(static_cast<int>(100 * tested.param.zeta));
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dartboard::scheme_test
