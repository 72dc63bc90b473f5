#include "reference/schemes/step_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/plain/error.h"

namespace dartboard::reference::step_judge_test {
namespace {

/// A mass of 1 kg on a spring of 4 N/m and rest length 1 at a wall, along x: all methods have a closed form there.
SpringNetwork oscillator() {
  SpringNetwork network;
  network.mass = {1.0, 1.0};
  network.fixed = {1, 0};
  network.springs = {{0, 1, 4.0, 0.0, 1.0}};
  return network;
}
constexpr long double square = 4.0L;  // of omega

struct Point {
  long double q, v;  // displacement and velocity
};
PointState state(Point p) {
  return {{{0, 0, 0}, {static_cast<double>(1 + p.q), 0, 0}}, {{0, 0, 0}, {static_cast<double>(p.v), 0, 0}}};
}
/// As the judge reads it back: displacements are exact to a rounding of the position.
Point rounded(Point p) {
  return {static_cast<long double>(static_cast<double>(1 + p.q)) - 1, static_cast<double>(p.v)};
}

// w = vh - tau omega^2 (qh + tau w)
long double stage(long double qh, long double vh, long double tau) {
  return (vh - tau * square * qh) / (1 + tau * tau * square);
}

/// One step by hand; bdf2 has `last` behind it.
Point step_by_hand(const std::string& name, Point p, Point last, long double h) {
  if (name == "backward-euler" || name == "baraff-witkin" || name == "local-global") {
    const long double w = stage(p.q, p.v, h);
    return {p.q + h * w, w};
  }
  if (name == "implicit-midpoint" || name == "energy-momentum") {
    const long double w = stage(p.q, p.v, h / 2);
    return {p.q + h * w, 2 * w - p.v};
  }
  if (name == "bdf2") {
    const long double tau = 2 * h / 3, qh = (4 * p.q - last.q) / 3, w = stage(qh, (4 * p.v - last.v) / 3, tau);
    return {qh + tau * w, w};
  }
  const long double tau = (1 - 1 / std::sqrt(2.0L)) * h;
  if (name == "sdirk2") {
    const long double w1 = stage(p.q, p.v, tau), slope = (w1 - p.v) / tau;
    const long double qh = p.q + (h - tau) * w1, w = stage(qh, p.v + (h - tau) * slope, tau);
    return {qh + tau * w, w};
  }
  // ros2: (1 - tau J) k = r with J = (0 1; -omega^2 0)
  const auto solve = [&](Point r) {
    const long double kv = (r.v - tau * square * r.q) / (1 + tau * tau * square);
    return Point{r.q + tau * kv, kv};
  };
  const Point k1 = solve({p.v, -square * p.q});
  const Point k2 = solve({p.v + h * k1.v - 2 * k1.q, -square * (p.q + h * k1.q) - 2 * k1.v});
  return {p.q + h / 2 * (3 * k1.q + k2.q), p.v + h / 2 * (3 * k1.v + k2.v)};
}

const char* const implicit_methods[]{"backward-euler",  "baraff-witkin", "local-global", "implicit-midpoint",
                                     "energy-momentum", "bdf2",          "sdirk2",       "ros2"};
const char* const all_methods[]{"explicit-euler",
                                "symplectic-euler",
                                "verlet",
                                "verlet-compensated",
                                "blanes-moan-4",
                                "blanes-moan-4-compensated",
                                "rk4",
                                "dormand-prince-54",
                                "backward-euler",
                                "baraff-witkin",
                                "local-global",
                                "implicit-midpoint",
                                "energy-momentum",
                                "bdf2",
                                "sdirk2",
                                "ros2"};

TEST(StepJudge, CallsTheClosedFormOfEveryImplicitMethodRight) {
  const SpringNetwork network = oscillator();
  for (const char* name : implicit_methods)
    for (const double h : {1e-4, 0.05, 1.0, 300.0}) {
      const Point p = rounded({0.01, 0.02}), last = rounded({0.0095, 0.019});
      const Point end = step_by_hand(name, p, last, h);
      const StepJudgement judgement = StepJudge(name, network).judge({h, state(p), state(end), state(last)});
      EXPECT_LE(judgement.excess, 1.0) << name << " " << h;
      EXPECT_TRUE(judgement.sees()) << name << " " << h;
    }
}

// The bound is rounding, or a tolerance of 1e-10 or 1e-12 of the motion: a ten-thousandth of the motion is far beyond.
TEST(StepJudge, SeesATenThousandthOfTheMotionInEveryImplicitMethod) {
  const SpringNetwork network = oscillator();
  for (const char* name : implicit_methods)
    for (const double h : {0.05, 1.0}) {
      const Point p = rounded({0.01, 0.02}), last = rounded({0.0095, 0.019});
      const Point end = step_by_hand(name, p, last, h);
      const StepJudge judge(name, network);
      // the last of these moves with its velocity, so that only the forces show it
      for (const Point by : {Point{1e-6, 0}, Point{0, 1e-6}, Point{h * 1e-6, 1e-6}})
        EXPECT_GT(judge.judge({h, state(p), state({end.q + by.q, end.v + by.v}), state(last)}).excess, 1.0)
            << name << " " << h;
    }
}

// Another method's step is no step of this one: of 16 x 15 pairs those that agree here are known.
TEST(StepJudge, TellsMethodsApart) {
  const SpringNetwork network = oscillator();
  const Point p = rounded({0.01, 0.02}), last = rounded({0.0095, 0.019});
  for (const char* judged_as : implicit_methods)
    for (const char* taken_by : implicit_methods) {
      const Point end = step_by_hand(taken_by, p, last, 0.5);
      const auto family = [](const std::string& name) {  // methods that are the same on a linear spring
        if (name == "baraff-witkin" || name == "local-global") return std::string("backward-euler");
        if (name == "energy-momentum") return std::string("implicit-midpoint");
        return name;
      };
      const StepJudgement judgement = StepJudge(judged_as, network).judge({0.5, state(p), state(end), state(last)});
      // both two-stage methods have the same stability function: on a linear system they are the same
      const bool two_stages = (family(judged_as) == "sdirk2" || family(judged_as) == "ros2") &&
                              (family(taken_by) == "sdirk2" || family(taken_by) == "ros2");
      EXPECT_EQ(judgement.right(), two_stages || family(judged_as) == family(taken_by)) << judged_as << " " << taken_by;
    }
}

TEST(StepJudge, CallsAStepThatDoesNothingWrong) {
  const SpringNetwork network = oscillator();
  const PointState still = state({0.01, 0.02});
  for (const char* name : all_methods) {
    const StepJudgement judgement = StepJudge(name, network).judge({0.1, still, still});
    EXPECT_GT(judgement.excess, 1e6) << name;
    EXPECT_DOUBLE_EQ(judgement.excess, judgement.idle) << name;
  }
}

TEST(StepJudge, CallsWhatIsNotANumberWrong) {
  const SpringNetwork network = oscillator();
  for (const char* name : all_methods) {
    PointState end = state({0.01, 0.02});
    end.v[1].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(StepJudge(name, network).judge({0.1, state({0.01, 0.02}), end}).right()) << name;
  }
}

// A held point without a spring, so that only the judge of held points can see it.
TEST(StepJudge, HoldsWhatIsHeldToItsVelocity) {
  SpringNetwork network = oscillator();
  network.mass.push_back(1.0);
  network.fixed.push_back(1);
  for (const char* name : all_methods) {
    // driven, the mass with its wall: nothing acts
    const std::vector<Eigen::Vector3d> driven(3, {0.5, 0, 0});
    const PointState earlier{{{-0.05, 0, 0}, {0.95, 0, 0}, {4.95, 0, 0}}, driven};
    const PointState start{{{0, 0, 0}, {1, 0, 0}, {5, 0, 0}}, driven};
    PointState end{{{0.05, 0, 0}, {1.05, 0, 0}, {5.05, 0, 0}}, driven};
    const StepJudge judge(name, network);
    EXPECT_TRUE(judge.judge({0.1, start, end, earlier}).right()) << name;
    end.v[2].x() = 0.4;
    end.x[2].x() = 5 + 0.1 * 0.4;
    EXPECT_FALSE(judge.judge({0.1, start, end, earlier}).right()) << name;
  }
}

// A step of 1e-18 s moves nothing that double can hold: it shows nothing of its method, but a nudge would be seen.
TEST(StepJudge, SaysWhenAStepShowsNothingOfItsMethod) {
  const SpringNetwork network = oscillator();
  const PointState still = state({0.01, 0.02});
  for (const char* name : {"rk4", "verlet", "backward-euler"}) {
    const StepJudgement judgement = StepJudge(name, network).judge({1e-18, still, still});
    EXPECT_TRUE(judgement.right()) << name;
    EXPECT_LE(judgement.idle, 1.0) << name;
    EXPECT_GT(judgement.nudged, 1.0) << name;
  }
}

TEST(StepJudge, RefusesNamesThatItDoesNotKnow) { EXPECT_THROW(StepJudge("rk5", oscillator()), InputError); }

}  // namespace
}  // namespace dartboard::reference::step_judge_test
