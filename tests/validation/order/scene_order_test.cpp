// Orders on scenes of users: the answer to invented errors, and the orders shown on small scenes of every kind.

#include "validation/order/scene_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/moving_box.h"
#include "tests/support/stand_in_integrators_for_tests.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::scene_order_test {
namespace {

using namespace moving;

// ---- answers

/// Runs whose steps halve from h omega = 1/2 on.
SceneOrder answer(double theory, const std::vector<double>& x, const std::vector<double>& v, double floor = 1e-14,
                  double longest = 0.5) {
  OrderStudy study;
  study.theory = theory;
  for (std::size_t k = 0; k < x.size(); ++k) {
    OrderPoint point;
    point.steps = 16u << k;
    point.h_omega = longest * std::exp2(-static_cast<double>(k));
    point.errors.x = x[k];
    point.errors.v = v[k];
    study.points.push_back(point);
  }
  judge(study, floor, {});
  return answer_of(study, {});
}
std::vector<double> falling(double order, std::size_t count = 6, double first = 1e-3) {
  std::vector<double> errors{first};
  while (errors.size() < count) errors.push_back(errors.back() / std::exp2(order));
  return errors;
}

TEST(OrderAnswer, IsShownByThreeSuccessiveHalvings) {
  const SceneOrder shown = answer(2, falling(2.05), falling(1.95));
  EXPECT_EQ(shown.answer, OrderAnswer::shown);
  EXPECT_EQ(shown.study.reason, "");
}

TEST(OrderAnswer, IsShownWhereVelocitiesAreBetterThanPromised) {
  const SceneOrder shown = answer(1, falling(1.0), falling(2.0));
  EXPECT_EQ(shown.answer, OrderAnswer::shown);
  EXPECT_NEAR(shown.study.p_x, 1.0, 1e-9);
  EXPECT_EQ(shown.study.reason, "");
}

TEST(OrderAnswer, IsMissedWhereShortStepsAgreeOnALowerOrder) {
  const SceneOrder missed = answer(2, falling(1.0), falling(1.02));
  EXPECT_EQ(missed.answer, OrderAnswer::missed);
  EXPECT_EQ(missed.study.reason, "order 1.00 in x and 1.02 in v");
  EXPECT_EQ(answer(2, falling(2.0), falling(1.0)).answer, OrderAnswer::missed);
  EXPECT_EQ(answer(2, falling(1.4), falling(1.4)).answer, OrderAnswer::missed);
  EXPECT_EQ(answer(2, falling(1.6), falling(1.6)).answer, OrderAnswer::open);  // on the way, maybe
}

// Stiff motions look so with long steps.
TEST(OrderAnswer, IsOpenWhereOnlyLongStepsAgreeOnALowerOrder) {
  EXPECT_EQ(answer(2, falling(1.0, 4), falling(1.0, 4), 1e-14, 0.5).answer, OrderAnswer::missed);
  EXPECT_EQ(answer(2, falling(1.0, 4), falling(1.0, 4), 1e-14, 0.51).answer, OrderAnswer::open);
}

TEST(OrderAnswer, IsOpenWhereOrdersScatter) {
  const std::vector<double> errors{1e-3, 4e-4, 3.9e-4, 1e-4, 9e-5, 8e-5};
  EXPECT_EQ(answer(2, errors, errors).answer, OrderAnswer::open);
}

TEST(OrderAnswer, IsOpenWhereMoreIsShownThanPromised) {
  const SceneOrder open = answer(1, falling(2.0), falling(2.0));
  EXPECT_EQ(open.answer, OrderAnswer::open);
  EXPECT_EQ(open.study.reason, "order 2.00 in x and 2.00 in v, which is more than it promises");
}

TEST(OrderAnswer, IsOpenWithTheReasonWhereTheWindowIsNotReachedOrLeftTooSoon) {
  EXPECT_EQ(answer(2, falling(2.0), falling(2.0), 1e-4).study.reason, "the errors reach the floor first");
  const SceneOrder large = answer(2, falling(0.0, 5, 0.5), falling(0.0, 5, 0.25));
  EXPECT_EQ(large.answer, OrderAnswer::open);
  EXPECT_EQ(large.study.reason, "errors of 5.0e-01 edges and 2.5e-01 of the speed with 256 steps are too large");
}

// Velocities that are known less well than positions do not count against a method.
TEST(OrderAnswer, IsOpenWhereVelocitiesReachTheirOwnFloor) {
  OrderStudy study;
  study.theory = 2;
  for (std::size_t k = 0; k < 6; ++k) {
    OrderPoint point;
    point.h_omega = 0.25 * std::exp2(-static_cast<double>(k));
    point.errors.x = falling(2.0)[k];
    point.errors.v = 1e-6;
    study.points.push_back(point);
  }
  for (const double ratio : {1.0, 1e8}) {
    OrderOptions options;
    options.velocity_floor = ratio;
    judge(study, 1e-14, options);
    EXPECT_EQ(answer_of(study, options).answer, ratio == 1.0 ? OrderAnswer::missed : OrderAnswer::open);
  }
}

// Newton's method ends at a tolerance, and the equations of short steps are within it from the start.
TEST(OrderAnswer, IsOpenWhereTheErrorsAreThoseOfTheEquationsSolved) {
  OrderOptions options;
  options.solved_to = 1e-10;
  SceneOrder found = answer(2, falling(1.0), falling(1.0));
  EXPECT_EQ(answer_of(found.study, options).answer, OrderAnswer::missed);
  // 512 steps
  found = answer(2, falling(1.0, 6, 1e-5), falling(1.0, 6, 1e-5));
  EXPECT_EQ(answer_of(found.study, options).answer, OrderAnswer::open);
}

// ---- scenes

TradeoffScene scene_with(const char* patch) {
  Json json = moving_box();
  json["duration"] = 0x1p-4;
  json["gravity"] = {0, 0.5, -2};
  json["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  json.merge_patch(Json::parse(patch));
  return scene_of_file(parse(json));
}

const IntegratorEntry& entry(std::string_view name) {
  for (const IntegratorEntry& e : integrators())
    if (e.name == name) return e;
  throw InputError("there is no such integrator");
}

struct Kind {
  const char* name;
  const char* patch;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class OrderOnScene : public ::testing::TestWithParam<Kind> {};

TEST_P(OrderOnScene, IsThatOfTheScheme) {
  const TradeoffScene scene = scene_with(GetParam().patch);
  const SceneReference reference = reference_of(scene, no_clock);
  EXPECT_EQ(reference.kind, scene.beyond_references.empty() ? ReferenceKind::certified : ReferenceKind::self_converged);
  for (const char* integrator : {"verlet", "rk4", "implicit-midpoint"}) {
    const SceneOrder found = observe_order(scene, reference, entry(integrator), no_clock);
    EXPECT_EQ(found.answer, OrderAnswer::shown) << integrator << ": " << found.study.reason;
    EXPECT_EQ(found.study.theory, scheme_of(integrator).order);
  }
}

const Kind kinds[] = {
    {"springs", "{}"},
    {"cut", R"({"events": [{"at": 0.023, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"removal",
     R"({"events": [{"from": 0.01, "every": 0.01, "until": 0.04, "remove": {"random": {"count": 2, "seed": 3}}}]})"},
    {"refinement", R"({"events": [{"at": 0.02, "refine": {"cells": {"ids": [3]}}}]})"},
    {"release", R"({"events": [{"at": 0.02, "release": {"plane": {"point": [0, 0, 0.06], "normal": [0, 0, -1]}}}]})"},
    {"drives", R"({"driven": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]}, "velocity": [0.5, 0, 0.25],
                               "from": 0.007, "until": 0.043, "reverse_every": 0.011}]})"},
    {"elements", R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3,
                                  "damping": {"ratio": 0.05, "frequency": 30}}})"},
    {"surface",
     R"({"body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125, "kind": "quadrilaterals"}, "box": null}},
         "material": {"density": 2}})"},
    {"chain",
     R"({"body": {"generate": {"chain": {"links": 4, "spacing": 0.125}, "box": null}}, "fixed": [{"ids": [0]}],
         "material": {"density": 0.25}})"},
};
INSTANTIATE_TEST_SUITE_P(Kinds, OrderOnScene, ::testing::ValuesIn(kinds),
                         [](const auto& kind) { return std::to_string(kind.index); });

TEST(SceneOrder, IsMissedByAnIntegratorThatIsOfALowerOrderThanItPromises) {
  const TradeoffScene scene = scene_with("{}");
  const SceneReference reference = reference_of(scene, no_clock);
  const IntegratorEntry lagging = stand_in<LaggedVerlet>("lagging");
  const SceneOrder found = observe_order(scene, reference, lagging, no_clock);
  EXPECT_EQ(found.answer, OrderAnswer::missed);
  EXPECT_TRUE(found.study.reason.starts_with("order 1.0")) << found.study.reason;
}

TEST(SceneOrder, StaysOpenWhereMoreStepsWouldTakeTooLong) {
  const TradeoffScene scene = scene_with("{}");
  const SceneReference reference = reference_of(scene, no_clock);
  const auto slow = [t = std::int64_t{0}]() mutable { return t += 1'000'000; };  // a millisecond at each look
  const SceneOrder found = observe_order(scene, reference, entry("backward-euler"), slow, {.most_s = 0.02});
  EXPECT_EQ(found.answer, OrderAnswer::open);
  EXPECT_TRUE(found.study.reason.ends_with("; more steps would take too long")) << found.study.reason;
}

// ---- contact

/// The answer where contact leaves `most` of an order, with an error that alternates by `scatter`.
SceneOrder answer_of_contact(double most, double order, double scatter, std::size_t count = 8, double longest = 0.5) {
  OrderStudy study;
  study.theory = most;
  for (std::size_t k = 0; k < count; ++k) {
    OrderPoint point;
    point.steps = 16u << k;
    point.h_omega = longest * std::exp2(-static_cast<double>(k));
    point.errors.x = point.errors.v =
        1e-3 * std::exp2(-order * static_cast<double>(k)) * std::exp2(k % 2 == 0 ? scatter : -scatter);
    study.points.push_back(point);
  }
  judge(study, 1e-14, {});
  return answer_by_fit(study, {most, "an energy"}, {});
}

TEST(OrderThroughContact, IsShownByALineThroughErrorsThatScatter) {
  const SceneOrder shown = answer_of_contact(2, 2.0, 0.5);
  EXPECT_EQ(shown.answer, OrderAnswer::shown);
  EXPECT_NEAR(shown.study.p_x, 2.0, 0.1);
  EXPECT_EQ(shown.study.reason, "");
  EXPECT_EQ(answer_of_contact(2, 3.0, 0.5).answer, OrderAnswer::shown);  // smooth errors are larger as yet
  EXPECT_EQ(answer_of_contact(2, 1.75, 0.0).answer, OrderAnswer::shown);
}

TEST(OrderThroughContact, IsMissedWhereTheLineIsLowerByMoreThanItsOwnError) {
  const SceneOrder missed = answer_of_contact(2, 1.25, 0.0);
  EXPECT_EQ(missed.answer, OrderAnswer::missed);
  EXPECT_EQ(missed.study.reason, "order 1.25 in x and 1.25 in v, fitted to 8 errors");
  EXPECT_EQ(answer_of_contact(2, 1.25, 2.5).answer, OrderAnswer::open);
  EXPECT_EQ(answer_of_contact(2, 1.25, 0.0, 5, 4.0).answer, OrderAnswer::open);  // long steps
}

TEST(OrderThroughContact, IsOpenWhereNoneIsPromisedOrTooFewErrorsAreSeen) {
  const SceneOrder none = answer_of_contact(0, 1.0, 0.0);
  EXPECT_EQ(none.answer, OrderAnswer::open);
  EXPECT_EQ(none.study.reason, "order 1.00 in x and 1.00 in v, fitted to 8 errors; none is promised");
  EXPECT_EQ(answer_of_contact(2, 2.0, 0.0, 4).answer, OrderAnswer::open);
}

/// A soft box that falls on a plane and leaves it again.
TradeoffScene bouncing_box(const char* contact) {
  Json json = moving_box();
  json["body"]["translate"] = {0, 0, 0.001};
  json["material"] = Json::parse(R"({"density": 1000, "young": 30000, "poisson": 0.3})");
  json["initial_velocity"] = {0.1, 0, -0.3};
  json["duration"] = 0x1p-4;
  json["contact"] = Json::parse(R"({"pressure": 4000, "depth": 0.02,
                                    "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  json["contact"].merge_patch(Json::parse(contact));
  return scene_of_file(parse(json));
}

SceneReference converged(const TradeoffScene& scene, std::uint64_t steps, double floor) {
  SceneReference reference;
  reference.floor = floor;
  reference.states = run_timed(scene, *make_integrator("blanes-moan-4"), {.steps = steps}, no_clock).states;
  return reference;
}

// Half of the losses before a step and half after it are symmetric in time: of order 2, where those of each sample
// after the same others both times, and first rates before the last half of a step's losses, leave order 1. The moments
// at which samples meet the floor scatter.
TEST(SceneOrder, IsThatOfTheSchemeThroughContactThatLosesSpeed) {
  const TradeoffScene scene = bouncing_box(R"({"exponent": 4, "restitution": 0.5})");
  const SceneOrder found = observe_order(scene, converged(scene, 8192, 1e-8), entry("verlet"), no_clock);
  EXPECT_EQ(found.answer, OrderAnswer::shown) << found.study.reason;
  EXPECT_EQ(found.study.theory, 2.0);
  EXPECT_NEAR(found.study.p_x, 2.0, 0.2);
}

TEST(SceneOrder, IsThatOfTheExponentForMethodsOfHigherOrder) {
  const TradeoffScene scene = bouncing_box(R"({"exponent": 3})");
  const SceneOrder found = observe_order(scene, converged(scene, 4096, 1e-12), entry("rk4"), no_clock);
  EXPECT_EQ(found.answer, OrderAnswer::shown) << found.study.reason;
  EXPECT_EQ(found.study.theory, 3.0);
}

TEST(SceneOrder, IsNotLookedForBelowWhatTheReferenceResolves) {
  const TradeoffScene scene = scene_with("{}");
  SceneReference reference = reference_of(scene, no_clock);
  reference.floor = 2e-3;
  const SceneOrder found = observe_order(scene, reference, entry("verlet"), no_clock);
  EXPECT_EQ(found.answer, OrderAnswer::open);
  EXPECT_EQ(found.study.reason, "the reference resolves no errors below 2.0e-03 edges");
  EXPECT_TRUE(found.study.points.empty());
}

}  // namespace
}  // namespace dartboard::scene_order_test
