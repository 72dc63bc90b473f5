// Events at their exact times, between two steps.

#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/run/simulation.h"
#include "tests/support/moving_box.h"

namespace dartboard::exact_events_test {
namespace {

using namespace moving;

Json exact(Json scene, double step, double duration, const char* events) {
  scene["step"] = step;
  scene["duration"] = duration;
  scene["event_times"] = "exact";
  return with_events(scene, events);
}

/// All held, without springs: free fall from the place of release.
Json held_box(double step, double duration, const char* events) {
  Json scene = exact(moving_box(), step, duration, events);
  scene["material"] = {{"density", 768}, {"stiffness", 0}, {"damping", 0}, {"viscosity", 0}};
  scene["initial_velocity"] = {0, 0, 0};
  scene["fixed"] = Json::parse(R"([{"sphere": {"centre": [0, 0, 0], "radius": 9}}])");
  return scene;
}

double fallen(const Json& scene) {
  Simulation simulation(parse(scene));
  const Eigen::Vector3d start = simulation.body().vertices().position[0];
  run(simulation);
  return (start - simulation.body().vertices().position[0]).z();
}

// Verlet's and Runge-Kutta's parabolas are exact, to the rounding of some twenty additions to lengths below 1.
TEST(ExactEvents, HappenAtTheirTimeAndNotAtTheEndOfTheStep) {
  for (const char* integrator : {"rk4", "verlet"}) {
    Json scene = held_box(0.01, 0.1, R"([{"at": 0.0137, "release": {"sphere": {"centre": [0, 0, 0], "radius": 9}}}])");
    scene["integrator"] = integrator;
    EXPECT_NEAR(fallen(scene), 9.81 / 2 * std::pow(0.1 - 0.0137, 2), 1e-14) << integrator;
    scene["event_times"] = "steps";
    EXPECT_NEAR(fallen(scene), 9.81 / 2 * std::pow(0.1 - 0.02, 2), 1e-14) << integrator;
  }
}

// Two halves released in one step, the one above first.
TEST(ExactEvents, OfOneStepHappenInTheOrderOfTheirTimes) {
  const Json scene = held_box(0.05, 0.1, R"([
      {"at": 0.031, "release": {"plane": {"point": [0, 0, 0.05], "normal": [0, 0, -1]}}},
      {"at": 0.013, "release": {"plane": {"point": [0, 0, 0.05], "normal": [0, 0, 1]}}}])");
  Simulation simulation(parse(scene));
  const std::vector<Eigen::Vector3d> start = simulation.body().vertices().position;
  run(simulation);
  for (std::size_t k = 0; k < start.size(); ++k) {
    const double after = start[k].z() > 0.05 ? 0.1 - 0.013 : 0.1 - 0.031;
    EXPECT_NEAR((start[k] - simulation.body().vertices().position[k]).z(), 9.81 / 2 * after * after, 1e-14) << k;
  }
}

TEST(ExactEvents, AtStepBoundariesChangeNoBit) {
  const char* cut = R"([{"at": 0.004, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0.01]}}}])";
  Json scene = exact(moving_box(), 0.001, 0.01, cut);
  Simulation there(parse(scene));
  scene["event_times"] = "steps";
  Simulation after(parse(scene));
  run(there);
  run(after);
  EXPECT_GT(there.operations(), 0u);
  EXPECT_EQ(there.body().state_hash(), after.body().state_hash());
}

TEST(ExactEvents, HappenOnce) {
  Simulation simulation(
      parse(exact(moving_box(), 0.001, 0.01, R"([{"at": 0.0035, "remove": {"random": {"count": 3}}}])")));
  run(simulation);
  EXPECT_EQ(cells(simulation), 45u);
}

// At 0.0005, 0.0019, 0.0033, ... 0.0089: seven times in ten steps.
TEST(ExactEvents, ThatRepeatHappenAtEachOfTheirTimes) {
  const char* events = R"([{"from": 0.0005, "every": 0.0014, "until": 0.009, "remove": {"random": {"count": 1}}}])";
  Simulation simulation(parse(exact(moving_box(), 0.001, 0.01, events)));
  const std::size_t left[] = {47, 46, 46, 45, 44, 44, 43, 42, 41, 41};
  for (const std::size_t expected : left) {
    ASSERT_FALSE(simulation.advance());
    EXPECT_EQ(cells(simulation), expected) << simulation.steps_done();
  }
}

TEST(ExactEvents, OfEveryStepFromATimeBetweenTwoHappenThereAndThenAtEachBoundary) {
  const char* events = R"([{"from": 0.0025, "every": 0.001, "until": 0.0055, "remove": {"random": {"count": 1}}}])";
  Simulation simulation(parse(exact(moving_box(), 0.001, 0.01, events)));
  const std::size_t left[] = {48, 48, 46, 45, 44, 44};  // in the third step one within it and one at its end
  for (const std::size_t expected : left) {
    ASSERT_FALSE(simulation.advance());
    EXPECT_EQ(cells(simulation), expected) << simulation.steps_done();
  }
}

/// Order by the fall of the error when the step is halved twice; the error is the distance from a run of shorter steps.
double order_through_a_removal(const char* integrator, const char* event_times, double step) {
  const auto end = [&](double h, const char* times) {
    Json scene =
        exact(moving_box(), h, 0.64, R"([{"at": 0.2331, "remove": {"ids": [0, 1, 2, 3, 4, 5, 20, 21, 22, 23]}}])");
    scene["integrator"] = integrator;
    scene["event_times"] = times;
    scene["gravity"] = {0, 0, 0};
    Simulation simulation(parse(scene));
    run(simulation);
    return simulation.body().vertices().position;
  };
  const auto finest = end(step / 16, "exact");
  const auto error = [&](double h) {
    const auto x = end(h, event_times);
    double sum = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - finest[k]).squaredNorm();
    return std::sqrt(sum);
  };
  return std::log2(error(step) / error(step / 4)) / 2.0;
}

TEST(ExactEvents, LeaveAnIntegratorItsOrder) {
  EXPECT_NEAR(order_through_a_removal("rk4", "exact", 0.01), 4.0, 0.25);
  EXPECT_NEAR(order_through_a_removal("verlet", "exact", 0.01), 2.0, 0.25);
  EXPECT_NEAR(order_through_a_removal("bdf2", "exact", 0.0025), 2.0, 0.35);
  EXPECT_LT(order_through_a_removal("rk4", "steps", 0.01), 1.5);
}

// ---- loads

/// A weightless box, on all of which a force of 1 N per kg acts for a time.
Json pushed_box(const char* integrator, const char* event_times) {
  Json scene = exact(moving_box(), 0.01, 0.1, "[]");
  scene["integrator"] = integrator;
  scene["event_times"] = event_times;
  scene["gravity"] = {0, 0, 0};
  scene["material"]["viscosity"] = 0;
  scene["initial_velocity"] = {0, 0, 0};
  scene["forces"] = Json::parse(R"([{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "acceleration": [0, 0, 1],
                                     "from": 0.0203, "until": 0.0667}])");
  return scene;
}

// A parabola for 0.0464 s, and a straight line for 0.0333 s. As means over whole steps, a force that acts in the share
// s of a step moves by s (1 - s) h^2 / 2 more where it begins, and by as much less where it ends.
TEST(ExactEvents, AreLoadsThatBeginAndEndWithinSteps) {
  const double exact_place = 0.5 * 0.0464 * 0.0464 + 0.0464 * 0.0333;
  for (const char* integrator : {"rk4", "verlet"}) {
    const auto place = [integrator](const char* event_times) {
      Simulation simulation(parse(pushed_box(integrator, event_times)));
      const double start = simulation.body().vertices().position[0].z();
      run(simulation);
      return simulation.body().vertices().position[0].z() - start;
    };
    EXPECT_NEAR(place("exact"), exact_place, 1e-15) << integrator;
    EXPECT_NEAR(place("steps"), exact_place + 0.5 * 1e-4 * (0.97 * 0.03 - 0.67 * 0.33), 1e-15) << integrator;
  }
}

/// A driven vertex and the others on springs, through a start, turns and a stop.
double order_through_drives(const char* integrator, double step) {
  const auto end = [&](double h) {
    Json scene = exact(moving_box(), h, 0.64, "[]");
    scene["integrator"] = integrator;
    scene["gravity"] = {0, 0, 0};
    scene["driven"] = Json::parse(R"([{"ids": [0], "velocity": [1, 2, 0], "from": 0.0917, "reverse_every": 0.1331,
                                       "until": 0.5003}])");
    scene["forces"] = Json::parse(R"([{"ids": [26, 25], "force": [0, 0, 20], "from": 0.1213, "until": 0.4104}])");
    Simulation simulation(parse(scene));
    run(simulation);
    return simulation.body().vertices().position;
  };
  const auto finest = end(step / 16);
  const auto error = [&](double h) {
    const auto x = end(h);
    double sum = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - finest[k]).squaredNorm();
    return std::sqrt(sum);
  };
  return std::log2(error(step) / error(step / 4)) / 2.0;
}

// Between the times of its table a force is linear: with its mean over each part, every velocity is exact.
TEST(ExactEvents, AreTheTimesOfTablesToo) {
  Json scene = pushed_box("rk4", "exact");
  scene["forces"][0].erase("from");
  scene["forces"][0].erase("until");
  scene["forces"][0]["over_time"] = Json::parse(R"([{"at": 0.013, "factor": 0}, {"at": 0.027, "factor": 1}])");
  Simulation simulation(parse(scene));
  const double start = simulation.body().vertices().position[0].z();
  for (int n = 0; n < 3; ++n) ASSERT_FALSE(simulation.advance());
  // at 0.03 s: half of 14 ms, and 3 ms; parts from 0.013 to 0.02, to 0.027, to 0.03 with means of 1/4, 3/4 and 1
  EXPECT_NEAR(simulation.body().vertices().velocity[0].z(), 0.01, 1e-15);
  const double first = 0.25 * 0.007, second = first + 0.75 * 0.007;
  EXPECT_NEAR(simulation.body().vertices().position[0].z() - start,
              0.5 * first * 0.007 + 0.5 * (first + second) * 0.007 + 0.5 * (second + 0.01) * 0.003, 1e-15);
}

TEST(ExactEvents, LeaveAnIntegratorItsOrderThroughLoadsToo) {
  EXPECT_NEAR(order_through_drives("rk4", 0.01), 4.0, 0.25);
  EXPECT_NEAR(order_through_drives("verlet", 0.01), 2.0, 0.25);
  EXPECT_NEAR(order_through_drives("bdf2", 0.0025), 2.0, 0.35);
}

}  // namespace
}  // namespace dartboard::exact_events_test
