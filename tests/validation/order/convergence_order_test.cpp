// Observed orders: the judgement on invented errors, integrators that have the order they claim and some that do not.

#include "validation/order/convergence_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/stand_in_integrators_for_tests.h"
#include "validation/order/cut_jump.h"
#include "validation/order/discrete_exact.h"
#include "validation/order/force_gradient.h"

namespace dartboard::convergence_order_test {
namespace {

OrderStudy study_of(int theory, const std::vector<double>& x, const std::vector<double>& v) {
  OrderStudy study;
  study.theory = theory;
  for (std::size_t k = 0; k < x.size(); ++k) {
    OrderPoint point;
    point.steps = 16u << k;
    point.errors.x = x[k];
    point.errors.v = v[k];
    study.points.push_back(point);
  }
  return study;
}

OrderStudy judged(OrderStudy study, double floor = 1e-14) {
  judge(study, floor, {});
  return study;
}

std::vector<double> powers(double first, double ratio, int count) {
  std::vector<double> errors{first};
  while (static_cast<int>(errors.size()) < count) errors.push_back(errors.back() / ratio);
  return errors;
}

TEST(OrderJudgement, HoldsAfterThreeSuccessiveHalvings) {
  const auto errors = powers(1e-3, 4.0, 4);
  EXPECT_TRUE(judged(study_of(2, errors, errors)).holds);
  const auto fewer = powers(1e-3, 4.0, 3);
  EXPECT_FALSE(judged(study_of(2, fewer, fewer)).holds);
  EXPECT_FALSE(judged(study_of(1, errors, errors)).holds);
}

TEST(OrderJudgement, ReportsTheOrdersFarthestFromTheory) {
  const std::vector<double> x{1e-3, 1e-3 / std::exp2(2.05), 1e-3 / std::exp2(4.05), 1e-3 / std::exp2(6.03)};
  const OrderStudy study = judged(study_of(2, x, powers(1e-3, 4.0, 4)));
  EXPECT_TRUE(study.holds);
  EXPECT_NEAR(study.p_x, 2.05, 1e-12);
  EXPECT_NEAR(study.p_v, 2.0, 1e-12);
}

TEST(OrderJudgement, AcceptsHalfATenthAndRefusesTwo) {
  const auto holds = [](double order) {
    const auto errors = powers(1e-3, std::exp2(order), 5);
    return judged(study_of(2, errors, errors)).holds;
  };
  EXPECT_TRUE(holds(2.05));
  EXPECT_TRUE(holds(1.95));
  EXPECT_FALSE(holds(2.2));
  EXPECT_FALSE(holds(1.8));
}

// Trap: a start from rest flatters one of the two.
TEST(OrderJudgement, NeedsBothPositionsAndVelocities) {
  EXPECT_FALSE(judged(study_of(2, powers(1e-3, 4.0, 5), powers(1e-3, 2.0, 5))).holds);
  EXPECT_FALSE(judged(study_of(2, powers(1e-3, 2.0, 5), powers(1e-3, 4.0, 5))).holds);
}

TEST(OrderJudgement, MarksTheRegimes) {
  // from 4^-2 on the order is 2, the last error is rounding
  const std::vector<double> errors{1e-1, 9e-3, 6e-3, 1.5e-3, 1.5e-3 / 4, 1.5e-3 / 16, 9e-14};
  OrderStudy study = judged(study_of(2, errors, errors));
  const Regime expected[] = {Regime::large,      Regime::pre_asymptotic, Regime::pre_asymptotic, Regime::asymptotic,
                             Regime::asymptotic, Regime::asymptotic,     Regime::floor};
  for (std::size_t k = 0; k < errors.size(); ++k) EXPECT_EQ(study.points[k].regime, expected[k]) << k;
  EXPECT_TRUE(study.holds);
}

TEST(OrderJudgement, TakesNoOrderBelowTheFloor) {
  const auto errors = powers(1e-13, 4.0, 6);
  const OrderStudy study = judged(study_of(2, errors, errors));
  EXPECT_FALSE(study.holds);
  EXPECT_EQ(study.reason, "the errors reach the floor first");
}

TEST(OrderJudgement, DoesNotTakeNanForConvergence) {
  auto errors = powers(1e-3, 4.0, 5);
  errors[2] = std::numeric_limits<double>::quiet_NaN();
  const OrderStudy study = judged(study_of(2, errors, errors));
  EXPECT_FALSE(study.holds);
  EXPECT_EQ(study.points[2].regime, Regime::large);
}

TEST(OrderJudgement, TakesOrdersOverTwoHalvingsAcrossAnUnalignedCut) {
  OrderStudy study = study_of(1, {8e-3, 8e-3, 2e-3, 2e-3, 5e-4}, {8e-3, 8e-3, 2e-3, 2e-3, 5e-4});
  EXPECT_FALSE(judged(study).holds);
  study.which = OrderCase::unaligned_cut;
  EXPECT_TRUE(judged(study).holds);
}

// ---- integrators

const OrderStage& stage(OrderCase which) {
  static std::vector<std::unique_ptr<OrderStage>> known(std::size(order_cases));
  auto& at = known[static_cast<std::size_t>(which)];
  if (!at) at = std::make_unique<OrderStage>(order_stage(which));
  return *at;
}

const IntegratorEntry& entry(std::string_view name) {
  for (const IntegratorEntry& e : integrators())
    if (e.name == name) return e;
  throw InputError("there is no such integrator");
}

TEST(ConvergenceOrder, HasReferencesOnWhichCodesAgree) {
  for (const OrderCase which : order_cases) {
    const reference::CertifiedMotion& certified = stage(which).certified;
    EXPECT_TRUE(certified.accepted) << name(which);
    // low enough for three halvings of a method of order 5
    EXPECT_LE(certified.floor, 1e-14) << name(which);
    EXPECT_LE(certified.largest_gain(), 10.0) << name(which);
  }
}

// One method of each order here; `dartboard validate order` takes them all.
TEST(ConvergenceOrder, IsThatOfTheScheme) {
  for (const OrderCase which : {OrderCase::undamped, OrderCase::damped, OrderCase::aligned_cut})
    for (const char* integrator : {"symplectic-euler", "verlet", "blanes-moan-4", "dormand-prince-54"}) {
      const OrderStudy study = study_order(stage(which), entry(integrator));
      EXPECT_TRUE(study.holds) << integrator << ", " << name(which) << ": " << study.reason << ", " << study.p_x << ", "
                               << study.p_v;
      EXPECT_EQ(study.theory, scheme_of(integrator).order);
    }
}

TEST(ConvergenceOrder, IsOneAcrossACutWithinAStep) {
  for (const char* integrator : {"verlet", "rk4"}) {
    const OrderStudy study = study_order(stage(OrderCase::unaligned_cut), entry(integrator));
    EXPECT_TRUE(study.holds) << integrator << ": " << study.reason;
    EXPECT_EQ(study.theory, 1);
  }
}

TEST(ConvergenceOrder, TellsDampingThatLagsFromDampingThatDoesNot) {
  const IntegratorEntry lagged = stand_in<LaggedVerlet>("lagged-verlet");
  EXPECT_TRUE(study_order(stage(OrderCase::undamped), lagged).holds);
  const OrderStudy study = study_order(stage(OrderCase::damped), lagged, {.most_steps = 24 << 8});
  EXPECT_FALSE(study.holds);
  EXPECT_NEAR(study.p_v, 1.0, 0.1);
}

class Failing : public LaggedVerlet {
 public:
  StepResult step(const SpringSystem&, Motion, double) override {
    return {StepCode::newton_stalled, Witness::none, 0, "residual", 1.0};
  }
};

TEST(ConvergenceOrder, KeepsTheDiagnosisOfARunThatFails) {
  const OrderStudy study = study_order(stage(OrderCase::undamped), stand_in<Failing>("failing"), {.most_steps = 48});
  EXPECT_FALSE(study.holds);
  ASSERT_EQ(study.points.size(), 2u);
  EXPECT_EQ(study.points[0].regime, Regime::failed);
  EXPECT_EQ(study.reason, "NEWTON_STALLED: residual = 1");
}

// ---- exact maps, forces, jumps

TEST(DiscreteExact, HoldsForMethodsOfEveryKind) {
  // the gate of `validate order`, which takes 10^5 steps; fewer here
  for (const char* integrator : {"explicit-euler", "verlet", "rk4"})
    for (const double zeta : {0.0, 1e-4}) {
      const DiscreteExact result = compare_with_discrete_map(entry(integrator), zeta, 10000);
      EXPECT_TRUE(result.diagnosis.empty()) << result.diagnosis;
      EXPECT_LE(result.deviation, 1e-10) << integrator << ", zeta = " << zeta;
    }
}

class SlightlyFast : public LaggedVerlet {
 public:
  StepResult step(const SpringSystem& system, Motion motion, double h) override {
    return LaggedVerlet::step(system, motion, h * (1.0 + 1e-12));
  }
};

TEST(DiscreteExact, NoticesACoefficientThatIsWrongInItsTwelfthDigit) {
  EXPECT_LE(compare_with_discrete_map(stand_in<LaggedVerlet>("verlet"), 0.0, 10000).deviation, 1e-10);
  // the phase of 2500 radians is off by 2.5e-9, of an amplitude of 0.35
  EXPECT_GT(compare_with_discrete_map(stand_in<SlightlyFast>("fast"), 0.0, 10000).deviation, 1e-10);
}

TEST(ForceGradient, IsMinusTheForce) {
  TradeoffScene scene = stage(OrderCase::undamped).scene;
  const ForceGradient found = compare_forces_with_energy(scene);
  EXPECT_LE(found.ratio, 1.0);
  EXPECT_GT(found.deviation, 0.0);
  EXPECT_NEAR(found.ratio, found.deviation / found.bound, 1e-12 * found.ratio);
  EXPECT_LT(found.bound, 1e-9 * found.largest_force);
  EXPECT_LT(found.vertex, scene.motion.network.point_count());
  scene.motion.network.springs[0].stiffness *= 1.0 + 1e-9;
  EXPECT_GT(compare_forces_with_energy(scene).ratio, 1.0);
}

// For the springs around the vertex, with d = 2^-21 edges: the truncation of the difference, the rounding of two
// energies over 2 d, and that of the forces; in addition the weight.
TEST(ForceGradient, IsBoundByTruncationAndRounding) {
  const TradeoffScene& scene = stage(OrderCase::undamped).scene;
  const ForceGradient found = compare_forces_with_energy(scene);
  const reference::SpringNetwork& network = scene.motion.network;
  const auto& x = scene.motion.start.x;
  const double u = 0x1p-53, w = 0x1p-64, d = 0x1p-21 * reference::mean_rest_length(network);
  const double weight = network.mass[found.vertex] * network.gravity.norm();
  double springs = 0.0, truncation = 0.0, energy = 0.0, rounded_lengths = 0.0, pull = 0.0, size = 0.0;
  for (const reference::Spring& s : network.springs) {
    if (s.a != found.vertex && s.b != found.vertex) continue;
    const double l = (x[s.a] - x[s.b]).norm(), e = std::abs(l - s.rest_length);
    springs += 1.0;
    truncation += d * d / 6.0 * (2.0 / std::sqrt(3.0)) * s.stiffness * s.rest_length / (l * l);
    energy += s.stiffness * e * e / 2.0;
    rounded_lengths += 4.0 * w * l * s.stiffness * e;
    pull += s.stiffness * e;
    size += s.stiffness * l;
  }
  const double expected = truncation + (rounded_lengths + (springs + 3.0) * w * energy) / d + 3.0 * u * size +
                          (springs + 14.0) * u * pull + 3.0 * w * weight * x[found.vertex].norm() / d +
                          4.0 * u * weight;
  EXPECT_NEAR(found.bound / expected, 1.0, 1e-3);
}

TEST(CutJump, IsRounding) {
  const TradeoffScene& scene = stage(OrderCase::aligned_cut).scene;
  const auto jumps = cut_jumps(scene, *make_integrator("verlet"), 0.5 / scene.fastest_rate);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_GT(jumps[0].vertices_after, jumps[0].vertices_before);
  EXPECT_LE(jumps[0].energy, 1e-14);
  EXPECT_LE(jumps[0].momentum, 1e-14);
  EXPECT_LE(jumps[0].angular, 1e-14);
}

TEST(CutJump, IsSeenWhenMassIsLost) {
  TableScene removal = order_scene(OrderCase::undamped);
  removal.events.push_back({Remove{IdSelection{{80}}}, 0.25, 0.25, {}, "/events/0"});
  const TradeoffScene scene = tradeoff_scene({}, removal);
  const auto jumps = cut_jumps(scene, *make_integrator("verlet"), 0.5 / scene.fastest_rate);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_GT(jumps[0].energy, 1e-4);
  EXPECT_GT(jumps[0].momentum, 1e-4);
  EXPECT_GT(jumps[0].angular, 1e-4);
}

}  // namespace
}  // namespace dartboard::convergence_order_test
