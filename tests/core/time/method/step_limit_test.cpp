// The longest step as a single number: compared with the integrators themselves, linearised about rest, and with all
// frequencies of a body.

#include "core/time/method/step_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/eigenvalues.h"
#include "core/time/integrators.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::step_limit_test {
namespace {

constexpr double damping_ratios[]{0.0, 0.05, 0.3, 0.97, 1.0, 1.2, 3.0, 10.0};
const Horizon horizon{.steps = 2000, .gain = 2.0};
// a growth by 2 in 2000 steps
const double allowed = std::exp(std::log(2.0) / 2000);

template <class F>
void for_each_explicit(F&& f) {
  for (const IntegratorEntry& entry : integrators()) {
    const auto integrator = entry.make();
    if (!integrator->scheme().implicit) f(*integrator);
  }
}

/// Swept in one direction, damping has a limit that is only bounded from below.
bool is_bracketed(const Scheme& scheme, double zeta) { return zeta == 0.0 || !scheme.sweeps || scheme.symmetric; }

/// Six tetrahedra at rest with three points held, damped so that omega_max has this ratio.
SpringArrays damped_cube(double zeta, unsigned seed = 0) {
  SpringArrays body = spring_grid(1, 1, 1, 50.0, 0.0, 0.03);
  for (const std::size_t i : {0, 1, 3}) body.fixed[i] = 1;
  const double omega = StableStepEstimate().refresh(body.system(), body.x).upper;
  SplitMix64 random(seed);
  // with a seed a third of the dampers are twenty times as strong as the others
  for (Spring& s : body.springs)
    s.damping = 2 * zeta / omega * s.stiffness * (seed == 0 || random.below(3) == 0 ? 1.0 : 0.05);
  return body;
}

StepLimit limit_of(const SpringArrays& body, const Scheme& scheme, const Horizon& of = horizon) {
  return StableStepEstimate().refresh(body.system(), body.x).limit(scheme, of);
}

/// The factor by which one step of the integrator amplifies the most amplified motion: its derivative at rest, by
/// central differences. Those are off by the rounding of the positions over 1e-7 m, 1e-9.
double amplification(const SpringArrays& rest, Integrator& integrator, double h) {
  constexpr double small = 1e-7;
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < rest.x.size(); ++i)
    if (!rest.fixed[i]) free.push_back(i);
  const auto n = static_cast<Eigen::Index>(6 * free.size());
  const auto end_of = [&](Eigen::Index c, double move) {
    SpringArrays body = rest;
    const std::size_t i = free[static_cast<std::size_t>(c / 6)];
    (c % 6 < 3 ? body.x[i][c % 6] : body.v[i][c % 6 - 3]) += c % 6 < 3 ? move : move / h;
    integrator.restart();
    EXPECT_TRUE(integrator.step(body.system(), body.motion(), h).ok());
    Eigen::VectorXd end(n);
    for (std::size_t k = 0; k < free.size(); ++k) {
      end.segment<3>(static_cast<Eigen::Index>(6 * k)) = body.x[free[k]];
      end.segment<3>(static_cast<Eigen::Index>(6 * k + 3)) = h * body.v[free[k]];
    }
    return end;
  };
  Eigen::MatrixXd derivative(n, n);
  for (Eigen::Index c = 0; c < n; ++c) derivative.col(c) = (end_of(c, small) - end_of(c, -small)) / (2 * small);
  return derivative.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(StepLimit, LiesBetweenStepsThatDoNotAmplifyAndOnesThatDo) {
  for (const double zeta : damping_ratios)
    for_each_explicit([&](Integrator& integrator) {
      const SpringArrays body = damped_cube(zeta);
      const StepLimit limit = limit_of(body, integrator.scheme());
      const auto what = [&] { return testing::Message() << integrator.scheme().name << ", zeta " << zeta; };
      for (const double part : {0.3, 0.7, 0.998})
        EXPECT_LE(amplification(body, integrator, part * limit.stable), allowed + 1e-6) << what() << " " << part;
      if (is_bracketed(integrator.scheme(), zeta)) {
        EXPECT_GE(amplification(body, integrator, 1.002 * limit.unstable), allowed - 1e-6) << what();
      }
    });
}

TEST(StepLimit, IsNotAboveTheTrueOneWhereDampersAreStrangersToTheSprings) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    for (const double zeta : damping_ratios)
      for_each_explicit([&](Integrator& integrator) {
        const SpringArrays body = damped_cube(zeta, seed);
        const StepLimit limit = limit_of(body, integrator.scheme());
        EXPECT_LE(amplification(body, integrator, 0.998 * limit.stable), allowed + 1e-6)
            << integrator.scheme().name << ", zeta " << zeta << ", seed " << seed;
        if (std::isfinite(limit.unstable)) {
          EXPECT_GE(amplification(body, integrator, 1.002 * limit.unstable), allowed - 1e-6)
              << integrator.scheme().name << ", zeta " << zeta << ", seed " << seed;
        }
      });
}

// 48 points: the bracket of omega_max is found by Lanczos steps, and the truth by all eigenvalues. Damping is
// proportional to stiffness, so each oscillation is the test oscillator of its own ratio.
TEST(StepLimit, OfOneMaterialIsFoundToTenPercentHoweverStrongItsDamping) {
  SpringArrays body = spring_grid(3, 3, 2, 50.0, 0.0, 0.03);
  const auto n = static_cast<Eigen::Index>(3 * body.x.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const auto i = static_cast<Eigen::Index>(3 * body.ends[s][0]), j = static_cast<Eigen::Index>(3 * body.ends[s][1]);
    const Eigen::Vector3d along = (body.x[body.ends[s][1]] - body.x[body.ends[s][0]]).normalized();
    const Eigen::Matrix3d block = body.springs[s].stiffness / 0.02 * along * along.transpose();  // equal masses
    k.block<3, 3>(i, i) += block;
    k.block<3, 3>(j, j) += block;
    k.block<3, 3>(i, j) -= block;
    k.block<3, 3>(j, i) -= block;
  }
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
  const double highest = std::sqrt(squares.maxCoeff());
  for (const double zeta : damping_ratios) {
    for (Spring& s : body.springs) s.damping = 2 * zeta / highest * s.stiffness;
    for_each_explicit([&](Integrator& integrator) {
      const Scheme& scheme = integrator.scheme();
      if (!is_bracketed(scheme, zeta)) return;
      double truth = Scheme::unlimited;
      // every eighth: limits vary slowly from one to the next; the highest is the last
      for (Eigen::Index e = n - 1; e >= 6; e -= e > n - 10 ? 1 : 8) {
        const double omega = std::sqrt(squares[e]), own = zeta * omega / highest;
        truth = std::min(truth, stable_limit(scheme, scheme.sweeps ? 0.0 : own, horizon.steps, horizon.gain) / omega);
      }
      const StepLimit limit = limit_of(body, scheme);
      EXPECT_LE(limit.stable, truth * (1 + 1e-8)) << scheme.name << ", zeta " << zeta;
      EXPECT_GE(limit.stable, truth * 0.9) << scheme.name << ", zeta " << zeta;
      EXPECT_GE(limit.unstable, truth * (1 - 1e-8)) << scheme.name << ", zeta " << zeta;
      EXPECT_LE(limit.unstable, truth / 0.9) << scheme.name << ", zeta " << zeta;
    });
  }
}

// Where a step is called stable without a look at the limit, no shorter one may amplify either.
TEST(StepLimit, IsFarFromTheCornerWhereNobodyAsksForIt) {
  for_each_explicit([](Integrator& integrator) {
    const Scheme& scheme = integrator.scheme();
    for (int i = 1; i <= 90; ++i)
      for (int j = 0; j <= 20; ++j) {
        const double theta = 0.01 * i * scheme.imaginary_limit, rate = 0.5 * j / 20;
        if (theta == 0.0) continue;
        // a billion steps must not double what they start from
        EXPECT_LT(std::log(spectral_radius(scheme, theta, rate / (2 * theta))), std::log(2.0) / 1e9)
            << scheme.name << " " << theta << " " << rate;
      }
  });
}

TEST(StepLimit, IsWhatAStepIsCalledStableBy) {
  for (const double zeta : damping_ratios)
    for_each_explicit([&](Integrator& integrator) {
      const SpringArrays body = damped_cube(zeta, zeta == 0.3 ? 1 : 0);
      const StableStep limits = StableStepEstimate().refresh(body.system(), body.x);
      const double stable = limits.limit(integrator.scheme(), horizon).stable;
      EXPECT_EQ(limits.safe_step(integrator.scheme(), horizon), stable);
      for (const double part : {0.01, 0.1, 0.5, 0.9, 0.97, 1.0})
        EXPECT_TRUE(limits.is_stable(integrator.scheme(), part * stable, horizon))
            << integrator.scheme().name << ", zeta " << zeta << ": " << part;
      for (const double part : {1.0 + 1e-15, 1.01, 1.05, 1.5, 4.0, 1e9})
        EXPECT_FALSE(limits.is_stable(integrator.scheme(), part * stable, horizon))
            << integrator.scheme().name << ", zeta " << zeta << ": " << part;
    });
}

TEST(StepLimit, ThatIsQuicklyFoundIsNotAboveTheOther) {
  for (const double zeta : damping_ratios)
    for_each_explicit([&](Integrator& integrator) {
      for (const unsigned seed : {0u, 1u}) {
        const SpringArrays body = damped_cube(zeta, seed);
        EXPECT_LE(quick_stable_step(body.system()).safe_step(integrator.scheme(), horizon),
                  limit_of(body, integrator.scheme()).stable)
            << integrator.scheme().name << ", zeta " << zeta;
      }
    });
}

// A spring that is stretched resists across its direction too, and that motion is undamped.
TEST(StepLimit, OfAStretchedBodyIsNotAboveTheTrueOne) {
  for_each_explicit([](Integrator& integrator) {
    SpringArrays body;
    for (int i = 0; i < 3; ++i) body.add_vertex(1.0, {1.5 * i, 0, 0}, {0, 0, 0}, i != 1);
    body.add_spring(0, 1, 1.0, 1.0, 0.6);
    body.add_spring(1, 2, 1.0, 1.0, 0.6);
    const StepLimit limit = limit_of(body, integrator.scheme());
    EXPECT_LE(amplification(body, integrator, 0.998 * limit.stable), allowed + 1e-6) << integrator.scheme().name;
  });
}

// The number of steps of a run depends on their size: at the limit both results agree.
TEST(StepLimit, OfADurationIsThatOfTheStepsThatItTakes) {
  const SpringArrays body = damped_cube(0.0);
  for_each_explicit([&](Integrator& integrator) {
    const Scheme& scheme = integrator.scheme();
    const double duration = 20.0;
    const double stable = limit_of(body, scheme, horizon_of(duration)).stable;
    EXPECT_NEAR(limit_of(body, scheme, {.steps = duration / stable, .gain = 2.0}).stable / stable, 1.0, 1e-9)
        << scheme.name;
  });
}

TEST(StepLimit, OfNoDurationIsThatOfOneStep) {
  const SpringArrays body = damped_cube(0.0);
  for_each_explicit([&](Integrator& integrator) {
    EXPECT_EQ(limit_of(body, integrator.scheme(), horizon_of(0.0)).stable,
              limit_of(body, integrator.scheme(), {.steps = 1.0, .gain = 2.0}).stable);
  });
}

TEST(StepLimit, IsNoneOfImplicitMethods) {
  const StepLimit limit = limit_of(damped_cube(1.0), scheme_of("backward-euler"));
  EXPECT_EQ(limit.stable, Scheme::unlimited);
  EXPECT_EQ(limit.unstable, Scheme::unlimited);
}

// A sphere in syrup: x'' = - r x', of which explicit Euler holds h r = 2.
TEST(StepLimit, OfWhatOnlyDecaysIsBracketedByItsRates) {
  SpringArrays body;
  body.add_vertex(2.0, {0, 0, 0});
  body.viscosity[0] = 6.0;
  const StepLimit limit = limit_of(body, scheme_of("explicit-euler"), {.steps = 1e9, .gain = 2.0});
  EXPECT_NEAR(limit.stable, 2.0 / 3.0, 1e-6);
  EXPECT_NEAR(limit.unstable, 2.0 / 3.0, 1e-6);
}

}  // namespace
}  // namespace dartboard::step_limit_test
