// The gate of motion: no contender passes it with other numbers, nor with NaN.

#include "validation/contenders/motion_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/summation_bound.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::motion_agreement_test {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

Problem falling_grid() {
  Problem problem;
  problem.mesh = reference::kuhn_grid(2, 2, 2, 0.5, 0.1, 2);
  problem.material = {.density = 1000.0, .stiffness = 50.0, .damping = 0.5, .viscosity = 0.125};
  problem.surroundings.gravity = {0, 0.25, -0.5};
  problem.fixed = {0, 1};
  return problem;
}

/// The baseline, or another contender, with one wrong number in its answers; in the state, when `compare_motion`
/// compares it.
class Spoilt : public ContenderBody {
 public:
  enum class What { nothing, force, position, velocity, points };
  Spoilt(const Problem& problem, What what, double by, std::string_view base = "graph")
      : body_(contender(base).make(problem)), what_(what), by_(by) {}
  void step(int n) override {
    body_->step(n);
    steps_ += n;
  }
  void set_state(const PointState& state) override { body_->set_state(state); }
  PointState state() const override {
    PointState state = body_->state();
    if (steps_ == start_after) return state;
    if (what_ == What::position) state.x[5][1] += by_;
    if (what_ == What::velocity) state.v[5][2] += by_;
    if (what_ == What::points) state.x.pop_back();
    return state;
  }
  std::vector<Eigen::Vector3d> forces() override {
    auto forces = body_->forces();
    if (what_ == What::force) forces[5][0] += by_;
    return forces;
  }

 private:
  static constexpr int start_after = 20;  // steps of the first contender, before all get its state
  std::unique_ptr<ContenderBody> body_;
  int steps_ = 0;
  What what_;
  double by_;
};

Contender spoilt(Spoilt::What what, double by, Carrier carrier = Carrier::adjacency_graph) {
  return {"spoilt", "",      "",
          0.0,      carrier, [=](const Problem& problem) {
            return std::make_unique<Spoilt>(problem, what, by); }};
}

/// Does the second contender agree with the arrays of the core?
bool agrees(const Contender& second) {
  const Contender both[]{contender("arrays"), second};
  const auto compared = compare_motion(falling_grid(), 5, both);
  EXPECT_TRUE(compared.at(0).agrees);
  return compared.at(1).agrees;
}

TEST(CompareMotion, LetsTheBaselinePass) { EXPECT_TRUE(agrees(spoilt(Spoilt::What::nothing, 0.0))); }

TEST(CompareMotion, StopsAContenderWithOneWrongNumber) {
  for (const auto what : {Spoilt::What::force, Spoilt::What::position, Spoilt::What::velocity})
    EXPECT_FALSE(agrees(spoilt(what, 1e-6))) << static_cast<int>(what);
}

TEST(CompareMotion, StopsAContenderWithOneNumberThatIsNone) {
  for (const auto what : {Spoilt::What::force, Spoilt::What::position, Spoilt::What::velocity})
    for (const Carrier carrier : {Carrier::adjacency_graph, Carrier::core_map})
      EXPECT_FALSE(agrees(spoilt(what, no_number, carrier))) << static_cast<int>(what);
}

TEST(CompareMotion, StopsAContenderThatTellsOfFewerPoints) { EXPECT_FALSE(agrees(spoilt(Spoilt::What::points, 0.0))); }

/// A walk of the core's with one number that is off.
Contender spoilt_walk(Spoilt::What what, double by) {
  Contender walk = contender("lists");
  walk.make = [=](const Problem& problem) { return std::make_unique<Spoilt>(problem, what, by, "lists"); };
  return walk;
}

// Coordinates are below 2 m, velocities and forces here below 1 in their units, with 1e-16 and less.
TEST(CompareMotion, StopsAWalkOfTheCoreWithOneWrongBit) {
  EXPECT_TRUE(agrees(spoilt_walk(Spoilt::What::nothing, 0.0)));
  for (const auto what : {Spoilt::What::force, Spoilt::What::position, Spoilt::What::velocity})
    EXPECT_FALSE(agrees(spoilt_walk(what, 0x1p-48))) << static_cast<int>(what);
}

// The baseline itself uses a thousandth of its bounds.
TEST(CompareMotion, AcceptsHalfABoundAndRefusesThree) {
  const Problem problem = falling_grid();
  const auto first = contender("arrays").make(problem);
  first->step(20);
  const PointState start = first->state();
  const double force = reference::force_bound(problem, start)[5];
  const reference::StateBound state = reference::state_bound(problem, start, 5);
  const std::pair<Spoilt::What, double> bounds[]{
      {Spoilt::What::force, force}, {Spoilt::What::position, state.position}, {Spoilt::What::velocity, state.velocity}};
  for (const auto& [what, bound] : bounds) {
    EXPECT_TRUE(agrees(spoilt(what, 0.5 * bound))) << static_cast<int>(what);
    EXPECT_FALSE(agrees(spoilt(what, 3.0 * bound))) << static_cast<int>(what);
  }
}

TEST(CompareMotion, TellsHowFarOffAContenderIs) {
  const Contender both[]{contender("arrays"), spoilt(Spoilt::What::position, 1e-6)};
  const MotionAgreement a = compare_motion(falling_grid(), 5, both).at(1);
  EXPECT_NEAR(a.position_difference, 1e-6, 1e-12);
  EXPECT_LT(a.velocity_difference, 1e-12);
  EXPECT_NE(a.hash, compare_motion(falling_grid(), 5, both).at(0).hash);
}

// Their states are the same bits then.
TEST(CompareMotion, StopsEverybodyWhereTheFirstHasNoNumbers) {
  const Contender none = spoilt(Spoilt::What::position, no_number, Carrier::core_map);
  const Contender all[]{none, none, contender("graph")};
  for (const MotionAgreement& a : compare_motion(falling_grid(), 5, all)) EXPECT_FALSE(a.agrees) << a.id;
}

// A step 30 times the stable one: the bound is infinite before the states are.
TEST(CompareMotion, StopsTheOthersWhereTheBoundIsInfinite) {
  Problem problem = falling_grid();
  problem.h = 30.0;
  const Contender all[]{contender("arrays"), contender("graph")};
  const auto compared = compare_motion(problem, 1, all);
  ASSERT_TRUE(std::isinf(compared.at(1).position_bound));
  EXPECT_FALSE(compared.at(1).agrees);
}

}  // namespace
}  // namespace dartboard::motion_agreement_test
