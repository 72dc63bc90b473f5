#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <memory>

#include "core/time/explicit/classical_runge_kutta.h"
#include "core/time/implicit/baraff_witkin.h"
#include "core/time/implicit/bdf2.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/implicit/ros2.h"
#include "core/time/implicit/sdirk2.h"
#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::implicit_integrators_test {
namespace {

using Eigen::Vector3d;

ImplicitOptions tight(LinearSolver solver = LinearSolver::kept_factor) {
  ImplicitOptions options;
  options.solver = solver;
  options.tolerance = 1e-13;
  return options;
}

std::vector<std::unique_ptr<ImplicitIntegrator>> all_implicit() {
  std::vector<std::unique_ptr<ImplicitIntegrator>> all;
  all.push_back(std::make_unique<BackwardEuler>(tight()));
  all.push_back(std::make_unique<BaraffWitkin>(tight()));
  all.push_back(std::make_unique<LocalGlobal>(40));
  all.push_back(std::make_unique<ImplicitMidpoint>(tight()));
  all.push_back(std::make_unique<EnergyMomentum>());
  all.push_back(std::make_unique<Ros2>(tight()));
  all.push_back(std::make_unique<Sdirk2>(tight()));
  all.push_back(std::make_unique<Bdf2>(tight()));
  return all;
}

void run(Integrator& integrator, SpringArrays& body, double duration, int steps) {
  for (int k = 0; k < steps; ++k) {
    const StepResult result = integrator.step(body.system(), body.motion(), duration / steps);
    ASSERT_TRUE(result.ok()) << integrator.scheme().name << " step " << k << ": " << to_string(result);
  }
}

double distance(const SpringArrays& a, const SpringArrays& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.x.size(); ++i)
    sum += (a.x[i] - b.x[i]).squaredNorm() / 0.01 + (a.v[i] - b.v[i]).squaredNorm();
  return std::sqrt(sum);
}

// Eight vertices under gravity, two of them held and one driven, off equilibrium in x and v.
SpringArrays swinging_cube(double damping) {
  SpringArrays body = spring_grid(1, 1, 1, 5.0, damping);
  body.gravity = {0, 0, -9.81};
  body.fixed[0] = body.fixed[1] = body.fixed[2] = 1;
  disturb(body, 0.004, 0.2);
  body.v[2] = {0.1, 0, 0.2};
  if (damping > 0)
    for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = 0.5 * body.mass[i];
  return body;
}

// The reference is RK4 with h omega below 1e-3: its error, of order 4, is below 1e-10.
TEST(ImplicitIntegrators, HaveTheirOrderUndampedAndDamped) {
  for (const double damping : {0.0, 0.02}) {
    SpringArrays reference = swinging_cube(damping);
    ClassicalRungeKutta precise;
    run(precise, reference, 0.1, 8192);
    for (std::size_t which = 0; which < all_implicit().size(); ++which) {
      double last = 0;
      for (const int steps : {128, 256, 512, 1024}) {
        const auto integrator = std::move(all_implicit()[which]);
        SpringArrays body = swinging_cube(damping);
        run(*integrator, body, 0.1, steps);
        const double error = distance(body, reference);
        if (last > 0) {
          EXPECT_NEAR(std::log2(last / error), integrator->scheme().order, 0.1)
              << integrator->scheme().name << " damping " << damping << " steps " << steps;
        }
        last = error;
      }
    }
  }
}

// Two masses on a line are the test oscillator exactly, so n steps multiply (omega q, v) by the amplification's power.
// A step rounds a few times at the size of the coordinates, 2, amplified by theta^2 at most in v; the solutions with a
// kept factor are good to 1e-12.
TEST(ImplicitIntegrators, FollowTheirAmplificationOnALinearOscillator) {
  const double m1 = 1.0, m2 = 2.0, k = 3.0, mu = m1 * m2 / (m1 + m2), omega = std::sqrt(k / mu);
  for (const double theta : {0.1, 1.0, 10.0})
    for (const double zeta : {0.0, 0.1, 1.0})
      for (auto& integrator : all_implicit()) {
        SpringArrays body = two_masses(m1, m2, k, 0.5, 2.0 * zeta * mu * omega);
        const auto state = [&body, omega] {
          return Eigen::Vector2d(omega * (body.x[1].x() - body.x[0].x() - 2.0), body.v[1].x() - body.v[0].x());
        };
        const Eigen::MatrixXd map = integrator->scheme().amplification(theta, zeta);
        Eigen::VectorXd expected = state();
        int steps = 20;
        if (!integrator->scheme().one_step) {
          run(*integrator, body, theta / omega, 1);
          Eigen::Vector4d both;
          both << state(), expected;
          expected = both;
        }
        for (int n = 0; n < steps; ++n) expected = map * expected;
        run(*integrator, body, steps * theta / omega, steps);
        EXPECT_LT((state() - expected.head<2>()).norm(), 1e-10)
            << integrator->scheme().name << " theta " << theta << " zeta " << zeta;
      }
}

// Backward Euler: amplitude (1 + theta^2)^(-1/2), phase atan(theta). Midpoint: |R| = 1, phase 2 atan(theta/2).
TEST(ImplicitIntegrators, KeepPhaseAndAmplitudeOfTheirClosedFormsOverManySteps) {
  const int n = 20000;
  const double omega = std::sqrt(3.0 / (2.0 / 3.0));
  const auto expect = [=](Integrator& integrator, double theta, double amplitude, double phase) {
    SpringArrays body = two_masses(1, 2, 3, 0.5);
    for (int step = 0; step < n; ++step) ASSERT_TRUE(integrator.step(body.system(), body.motion(), theta / omega).ok());
    const double a = 0.5 * std::pow(amplitude, n);
    EXPECT_NEAR(body.x[1].x() - body.x[0].x() - 2.0, a * std::cos(n * phase), 1e-10) << integrator.scheme().name;
    EXPECT_NEAR((body.v[1].x() - body.v[0].x()) / omega, -a * std::sin(n * phase), 1e-10) << integrator.scheme().name;
  };
  const double small = 0.003, large = 0.7;
  BackwardEuler backward(tight());
  expect(backward, small, 1 / std::sqrt(1 + small * small), std::atan(small));
  BaraffWitkin linearised(tight());
  expect(linearised, small, 1 / std::sqrt(1 + small * small), std::atan(small));
  for (const double theta : {small, large}) {
    ImplicitMidpoint midpoint(tight());
    expect(midpoint, theta, 1.0, 2 * std::atan(theta / 2));
    EnergyMomentum conserving;
    expect(conserving, theta, 1.0, 2 * std::atan(theta / 2));
  }
}

// Stretched and turning, h omega = 20 for omega = 115 1/s by power iteration.
SpringArrays turning_grid() {
  SpringArrays body = spring_grid(3, 3, 3, 5.0);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const Vector3d r = body.x[i] - Vector3d(0.15, 0.15, 0.15);
    body.x[i] += 0.02 * r;
    body.v[i] = {0.5 * r.x() - r.y(), r.x() - 0.3 * r.z(), 2.0 * r.x() * r.z()};
  }
  return body;
}

// The equations are solved to rounding, a few 1e-16 of the forces, so the energy walks by about that in each step.
TEST(EnergyMomentum, ConservesEnergyAndMomentaAtLargeSteps) {
  SpringArrays body = turning_grid();
  const double energy = total_energy(body.system(), body.x, body.v);
  const Vector3d momentum = linear_momentum(body.system(), body.v);
  const Vector3d spin = angular_momentum(body.system(), body.x, body.v);
  EnergyMomentum integrator;
  run(integrator, body, 200 * 20.0 / 115.0, 200);
  EXPECT_NEAR(total_energy(body.system(), body.x, body.v) / energy, 1.0, 1e-12);
  EXPECT_LT((linear_momentum(body.system(), body.v) - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((angular_momentum(body.system(), body.x, body.v) - spin).norm(), 1e-12 * spin.norm());
}

TEST(ImplicitMidpoint, DoesNotConserveTheEnergyThatTheDiscreteGradientDoes) {
  SpringArrays body = turning_grid();
  const double energy = total_energy(body.system(), body.x, body.v);
  ImplicitMidpoint integrator(tight());
  run(integrator, body, 50 * 2.0 / 115.0, 50);
  EXPECT_GT(std::abs(total_energy(body.system(), body.x, body.v) / energy - 1.0), 1e-9);
}

// Stiff inclusions: every tenth spring 1e4 times as stiff.
SpringArrays stiff_grid() {
  SpringArrays body = spring_grid(3, 3, 3, 5.0, 0.01);
  for (std::size_t e = 0; e < body.springs.size(); e += 10) body.springs[e].stiffness *= 1e4;
  body.gravity = {0, 0, -9.81};
  for (std::size_t i = 0; i < 16; ++i) body.fixed[body.x.size() - 1 - i] = 1;
  return body;
}

// Each step is solved to 1e-10 either way; the motion is stable, so that the differences add up at most.
TEST(BackwardEuler, KeptFactorSavesFactorisationsAtTheSameError) {
  const int steps = 50;
  ImplicitOptions options;
  options.solver = LinearSolver::fresh_factor;
  BackwardEuler fresh(options), kept;
  SpringArrays a = stiff_grid(), b = stiff_grid();
  run(fresh, a, 0.05, steps);
  run(kept, b, 0.05, steps);
  EXPECT_LT(distance(a, b), 1e-6);
  EXPECT_GE(fresh.work().factorisations, 10 * kept.work().factorisations);
}

TEST(BackwardEuler, FactorThatServesBadlyIsRenewed) {
  std::uint64_t factorisations[2];
  for (const int patience : {1, 1000}) {
    ImplicitOptions options = tight();
    options.patience = patience;
    BackwardEuler integrator(options);
    SpringArrays body = stiff_grid();
    run(integrator, body, 0.05, 50);
    factorisations[patience > 1] = integrator.work().factorisations;
  }
  EXPECT_GT(factorisations[0], factorisations[1]);
}

TEST(ImplicitIntegrators, FactorOfAStepDoesNotServeAnotherStep) {
  LocalGlobal constant(40);
  BackwardEuler kept;
  for (ImplicitIntegrator* integrator : std::initializer_list<ImplicitIntegrator*>{&constant, &kept}) {
    SpringArrays body = swinging_cube(0.02);
    run(*integrator, body, 0.004, 4);
    EXPECT_EQ(integrator->work().factorisations, 1u) << integrator->scheme().name;
    run(*integrator, body, 0.012, 4);
    EXPECT_EQ(integrator->work().factorisations, 2u) << integrator->scheme().name;
  }
}

// Trap: stages whose tau differ in the last bit would factor twice in every step.
TEST(Sdirk2, BothStagesShareOneFactor) {
  Sdirk2 integrator(tight());
  SpringArrays body = swinging_cube(0.0);
  run(integrator, body, 0.02, 20);
  EXPECT_EQ(integrator.work().factorisations, 1u);
}

// Equations solved to 1e-13 of the motion, 20 times forwards and back.
TEST(ImplicitIntegrators, SymmetricOnesComeBackWhenTheStepIsReversed) {
  for (auto& integrator : all_implicit()) {
    if (!integrator->scheme().symmetric) continue;
    SpringArrays body = swinging_cube(0.0);
    const SpringArrays start = body;
    run(*integrator, body, 0.1, 20);
    EXPECT_GT(distance(body, start), 1e-2);
    run(*integrator, body, -0.1, 20);
    EXPECT_LT(distance(body, start), 1e-11) << integrator->scheme().name;
  }
}

TEST(ImplicitIntegrators, FollowATopologicalChangeWithUpdatedFactorAsWithAFreshOne) {
  ImplicitOptions updating = tight(), fresh = tight(LinearSolver::fresh_factor);
  updating.cholesky = {.kind = FactorKind::simplicial, .spare_nodes = 2};
  BackwardEuler a(updating), b(fresh);
  SpringArrays with_a = spring_grid(4, 4, 4, 5.0), with_b = with_a;
  for (int cut = 0; cut < 3; ++cut) {
    for (auto [integrator, body] : {std::pair<Integrator*, SpringArrays*>{&a, &with_a}, {&b, &with_b}}) {
      if (cut > 0) {
        dissociate(*body, 60 + static_cast<std::uint32_t>(cut));
        integrator->restart();
      } else {
        disturb(*body, 0.005, 0.1);
      }
      run(*integrator, *body, 0.02, 10);
    }
  }
  EXPECT_LT(distance(with_a, with_b), 1e-9);
  EXPECT_EQ(a.work().factorisations, 1u);
  EXPECT_GT(a.work().rank_one_updates, 0u);
}

TEST(ImplicitIntegrators, LocalGlobalTakesTheIterationsThatItIsGiven) {
  for (const int iterations : {1, 7}) {
    LocalGlobal integrator(iterations);
    SpringArrays body = stiff_grid();
    run(integrator, body, 0.05, 4);
    EXPECT_EQ(integrator.work().newton_iterations, 4u * static_cast<unsigned>(iterations));
  }
}

TEST(ImplicitIntegrators, LocalGlobalFactorsOnceAndFollowsAChange) {
  LocalGlobal integrator(60);
  BackwardEuler exact(tight());
  SpringArrays a = swinging_cube(0.02), b = a;
  run(integrator, a, 0.01, 10);
  run(exact, b, 0.01, 10);
  EXPECT_EQ(integrator.work().factorisations, 1u);
  for (auto* body : {&a, &b}) dissociate(*body, 5);
  integrator.restart();
  exact.restart();
  run(integrator, a, 0.01, 10);
  run(exact, b, 0.01, 10);
  EXPECT_LT(distance(a, b), 1e-9);
}

// A motion that has changed is followed as after a restart, of which the system needs none.
TEST(ImplicitIntegrators, ForgetTheMotionWhereItHasChanged) {
  for (std::size_t which = 0; which < all_implicit().size(); ++which) {
    const auto integrator = std::move(all_implicit()[which]), other = std::move(all_implicit()[which]);
    SpringArrays body = swinging_cube(0.02), same = body;
    run(*integrator, body, 0.05, 5);
    run(*other, same, 0.05, 5);
    for (SpringArrays* b : {&body, &same})
      for (Vector3d& v : b->v) v *= -0.5;
    integrator->motion_changed();
    other->restart();
    run(*integrator, body, 0.05, 5);
    run(*other, same, 0.05, 5);
    EXPECT_LT(distance(body, same), 1e-12) << integrator->scheme().name;
  }
}

TEST(ImplicitIntegrators, AskForNoMassOfAVertexThatIsHeld) {
  for (std::size_t which = 0; which < all_implicit().size(); ++which) {
    const auto integrator = std::move(all_implicit()[which]), same = std::move(all_implicit()[which]);
    SpringArrays with_mass = swinging_cube(0.02), body = with_mass;
    body.mass[0] = body.inverse_mass[0] = body.viscosity[0] = 0.0;
    run(*integrator, body, 0.1, 20);
    run(*same, with_mass, 0.1, 20);
    EXPECT_EQ(body.x, with_mass.x) << integrator->scheme().name;
  }
}

TEST(ImplicitIntegrators, StepThatFailsLeavesTheMotionAlone) {
  for (auto& integrator : all_implicit()) {
    SpringArrays body = swinging_cube(0.0);
    body.v[4].x() = NAN;
    const auto x = body.x;
    const StepResult result = integrator->step(body.system(), body.motion(), 1e-3);
    EXPECT_EQ(result.code, StepCode::nonfinite) << integrator->scheme().name << " " << to_string(result);
    EXPECT_EQ(body.x, x);
    EXPECT_EQ(integrator->work().steps, 0u);
    EXPECT_EQ(integrator->work().failed_steps, 1u);
  }
}

TEST(ImplicitIntegrators, FreeFallIsExactButForTheErrorOfEuler) {
  const double g = 9.81, h = 0.01;
  const int n = 50;
  for (auto& integrator : all_implicit()) {
    SpringArrays body = spring_grid(1, 1, 1);
    body.gravity = {0, 0, -g};
    const double z = body.x[3].z(), t = n * h;
    run(*integrator, body, t, n);
    const bool first_order = integrator->scheme().order == 1;
    // Euler methods fall g h t / 2 further. So does the first step of BDF2, whose velocity alone is exact.
    const double expected = z - g * t * t / 2 - (first_order ? g * h * t / 2 : 0.0);
    if (integrator->scheme().one_step) {
      EXPECT_NEAR(body.x[3].z(), expected, 1e-11) << integrator->scheme().name;
    }
    EXPECT_NEAR(body.v[3].z(), -g * t, 1e-11) << integrator->scheme().name;
  }
}

TEST(ImplicitIntegrators, NoAmplificationExceedsOne) {
  for (auto& integrator : all_implicit())
    for (const double zeta : {0.0, 0.01, 1.0, 100.0})
      for (const double theta : {0.01, 1.0, 30.0, 1e4})
        EXPECT_LE(spectral_radius(integrator->scheme(), theta, zeta), 1.0 + 1e-9) << integrator->scheme().name;
}

// A body moved by D = 2^30 m, with its coordinates rounded accordingly, and the same coordinates at the origin: the
// equations of a stage are the same except for x + tau w, which is rounded to eps D / 2 in each of 40 steps. As
// independent errors these make some 3 eps D, which the springs transmit with factors near one. An iteration that stops
// at eps D of the stiffness, not of the lengths, is off by 32 (backward Euler) and 112 (local/global).
TEST(ImplicitIntegrators, RoundPositionsFarFromTheOriginAndNothingMore) {
  const double offset = 0x1p30, ulp = 0x1p-22;  // of numbers from 2^30 on
  SpringArrays start = spring_grid(3, 2, 2);
  disturb(start, 0.01, 0.2);
  for (Vector3d& p : start.x)
    for (double& c : p) c = ulp * std::round(c / ulp);
  for (const IntegratorEntry& entry : integrators()) {
    if (!entry.make()->scheme().implicit) continue;
    SpringArrays near = start, far = start;
    for (Vector3d& p : far.x) p.x() += offset;
    const double h = 1.0 / frequency_bound(start.system());
    const auto at_origin = entry.make(), away = entry.make();
    for (int k = 0; k < 40; ++k) {
      ASSERT_TRUE(at_origin->step(near.system(), near.motion(), h).ok()) << entry.name;
      ASSERT_TRUE(away->step(far.system(), far.motion(), h).ok()) << entry.name;
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < near.x.size(); ++i)
      largest = std::max(largest, (far.x[i] - Vector3d(offset, 0, 0) - near.x[i]).norm());
    EXPECT_LE(largest, 30 * 0x1p-52 * offset) << entry.name << ": " << largest / (0x1p-52 * offset) << " eps D";
    EXPECT_GT(largest, 0.0) << entry.name;  // the effect is visible
  }
}

}  // namespace
}  // namespace dartboard::implicit_integrators_test
