// Forces and driven vertices that change in time.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "core/scene/file/scene_problem.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::loads_over_time_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

/// A box that floats at rest in nothing, under forces.
Json floating_box(const char* forces) {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene["gravity"] = {0, 0, 0};
  scene["material"]["viscosity"] = 0;
  scene["material"]["damping"] = 0;
  scene["forces"] = Json::parse(forces);
  return scene;
}
Diagnostics end_of(const Json& scene) {
  Simulation simulation(parse(scene));
  run(simulation);
  return simulation.diagnostics();
}

constexpr const char* ramped = R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "force": [3, -1, 2],
    "over_time": [{"at": 0.002, "factor": 0}, {"at": 0.0045, "factor": 2}, {"at": 0.0095, "factor": -1}]}])";
// the integral of the factors from 0 to 0.01 s: a triangle, a line from 2 to -1 and the last half step
constexpr double ramped_for = 0.0025 + 0.0025 - 0.0005;

TEST(LoadsOverTime, GiveTheirIntegralAsMomentumWithEveryOneStepMethod) {
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.name == "bdf2") continue;
    Json scene = floating_box(ramped);
    scene["integrator"] = entry.name;
    const Vector3d expected = ramped_for * Vector3d(3, -1, 2);
    EXPECT_LE((end_of(scene).momentum - expected).norm(), 1e-11 * expected.norm()) << entry.name;
  }
}

/// The momentum that loads give to a floating box whose springs carry nothing outside.
Vector3d momentum_from(const Json& force, const Json& more, double step, std::string_view integrator) {
  Json scene = floating_box("[]");
  scene["forces"] = Json::array({force});
  scene["forces"][0].update(more);
  scene["step"] = step;
  scene["duration"] = 0.1;
  scene["integrator"] = integrator;
  return end_of(scene).momentum;
}

TEST(LoadsOverTime, GiveTheirTimeAsMomentumWhereverTheyBeginAndEndInAStepWithEveryIntegrator) {
  const Json force = Json::parse(R"({"ids": [0], "force": [1, 0, 0]})");
  for (const IntegratorEntry& entry : integrators())
    for (const double step : {0.01, 0.02}) {
      const auto given = [&](double from, double until) {
        return momentum_from(force, {{"from", from}, {"until", until}}, step, entry.name).x();
      };
      // implicit methods solve to 1e-10 of what a step changes
      EXPECT_NEAR(given(0.0203, 0.0697), 0.0494, 1e-10) << entry.name << " " << step;
      EXPECT_NEAR(given(0.0421, 0.0437), 0.0016, 1e-10) << entry.name << " " << step;
      EXPECT_NEAR(given(0.0021, 0.0317), 0.0296, 1e-10) << entry.name << " " << step;
    }
}

TEST(LoadsOverTime, GiveThatMomentumWhateverTheirKind) {
  const char* kinds[] = {R"("force": [1, 0, 0])", R"("traction": [16, 0, 0])", R"("pressure": -16)",
                         R"("pressure": -16, "normals": "current")", R"("acceleration": [0.5, 0, 0])"};
  for (const char* kind : kinds) {
    const Json force =
        Json::parse(std::string(R"({"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, )") + kind + "}");
    const Json whole{{"from", 0.02}, {"until", 0.07}}, within{{"from", 0.0203}, {"until", 0.0697}};
    const double all = momentum_from(force, whole, 0.0001, "verlet").x() / 0.05;
    // all faces stay as they were but for what they have moved until then
    EXPECT_NEAR(momentum_from(force, within, 0.01, "verlet").x(), 0.0494 * all, 1e-3 * 0.05) << kind;
    EXPECT_GT(all, 0.9) << kind;
  }
}

// The table has its values at its times, whether or not the force acts.
TEST(LoadsOverTime, AreCutOffWithinAStepByTheirTimes) {
  const Json force = Json::parse(R"({"ids": [0], "force": [1, 0, 0],
                                     "over_time": [{"at": 0, "factor": 0}, {"at": 0.1, "factor": 10}]})");
  const Json times{{"from", 0.0203}, {"until", 0.0697}};
  const double integral = 50.0 * (0.0697 * 0.0697 - 0.0203 * 0.0203);
  EXPECT_NEAR(momentum_from(force, times, 0.01, "rk4").x(), integral, 1e-14);
  EXPECT_NEAR(momentum_from(force, times, 0.05, "rk4").x(), integral, 1e-14);
}

// Its formula takes the force at the end of a step alone: what it gets is half a step late.
TEST(LoadsOverTime, AreHalfAStepLateWithTheMethodOfTwoSteps) {
  const auto error = [](double step) {
    Json scene = floating_box(R"([{"ids": [0], "force": [1, 0, 0],
                                   "over_time": [{"at": 0, "factor": 0}, {"at": 1, "factor": 1000}]}])");
    scene["integrator"] = "bdf2";
    scene["step"] = step;
    return end_of(scene).momentum.x() - 0.05;
  };
  EXPECT_NEAR(error(0.0005) / error(0.001), 0.5, 0.1);
}

TEST(LoadsOverTime, AreOfSecondOrderInTheStep) {
  // x'' = 1000 t / m of the whole box: x = 1000 t^3 / (6 m)
  const auto error = [](double step) {
    Json scene = floating_box(R"([{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "acceleration": [1, 0, 0],
                                   "over_time": [{"at": 0, "factor": 0}, {"at": 1, "factor": 1000}]}])");
    scene["step"] = step;
    Simulation simulation(parse(scene));
    const double rest = simulation.body().vertices().position[0].x();
    run(simulation);
    return simulation.body().vertices().position[0].x() - rest - 1000 * 1e-6 / 6;
  };
  // constant in each step: the place lags by h^3 / 12 of the rate in each
  EXPECT_NEAR(error(0.001), 0.01 / 0.001 * 1000 * 1e-9 / 12, 1e-12);
  EXPECT_NEAR(error(0.0005) / error(0.001), 0.25, 1e-3);
}

TEST(LoadsOverTime, AsAnAccelerationAreGravityThatChanges) {
  Json heavy = floating_box("[]");
  heavy["gravity"] = {0, 0, -8};
  heavy["fixed"] = Json::parse(R"([{"ids": [0]}])");
  Json pulled = floating_box(R"([{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "acceleration": [0, 0, -8]}])");
  pulled["fixed"] = heavy["fixed"];
  Simulation a(parse(heavy)), b(parse(pulled));
  run(a);
  run(b);
  for (std::size_t k = 0; k < a.body().vertices().size(); ++k)
    EXPECT_LE((a.body().vertices().position[k] - b.body().vertices().position[k]).norm(), 1e-15) << k;
  EXPECT_NEAR(*b.diagnostics().applied, a.diagnostics().gravitational, 1e-12);
}

TEST(LoadsOverTime, OfATorqueHaveNoSumAndThatMoment) {
  Json scene = floating_box(R"([{"box": {"min": [-1, -1, -1], "max": [0.2, 1, 0.1]}, "torque": [1, -2, 0.5]}])");
  scene["integrator"] = "verlet";
  scene["duration"] = 0.001;
  Simulation simulation(parse(scene));
  const VertexColumns& v = simulation.body().vertices();
  Vector3d sum(0, 0, 0), moment(0, 0, 0);
  for (std::size_t k = 0; k < v.size(); ++k) {
    sum += v.mass[k] * v.pull[k];
    moment += v.position[k].cross(Vector3d(v.mass[k] * v.pull[k]));
  }
  EXPECT_LE(sum.norm(), 1e-14);
  EXPECT_LE((moment - Vector3d(1, -2, 0.5)).norm(), 1e-14);
}

// Two vertices have a moment about every axis but their line.
TEST(LoadsOverTime, OfATorqueMayActOnVerticesOfALineAcrossIt) {
  Json scene = floating_box(R"([{"ids": [0, 1, 2], "torque": [0, 3, 0]}])");
  const Simulation simulation(parse(scene));
  const VertexColumns& v = simulation.body().vertices();
  Vector3d moment(0, 0, 0);
  for (std::size_t k = 0; k < v.size(); ++k) moment += v.position[k].cross(Vector3d(v.mass[k] * v.pull[k]));
  EXPECT_LE((moment - Vector3d(0, 3, 0)).norm(), 1e-14);
}

// Nothing is lost: the work of the forces is in the account, whatever their size is at the moment.
TEST(LoadsOverTime, DoTheWorkThatTheEnergyGrowsBy) {
  const auto drift = [](double step) {
    Json scene = floating_box(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "force": [0, 0, 3000],
        "over_time": [{"at": 0, "factor": 0}, {"at": 0.02, "factor": 1}, {"at": 0.06, "factor": -1},
                      {"at": 0.08, "factor": 0}]}])");
    scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
    scene["step"] = step;
    scene["duration"] = 0.1;
    Simulation simulation(parse(scene));
    const double before = simulation.diagnostics().energy();
    run(simulation);
    const Diagnostics end = simulation.diagnostics();
    EXPECT_GT(end.kinetic + end.elastic, 1.0);
    return std::abs(end.energy() - before) / (end.kinetic + end.elastic);
  };
  const double coarse = drift(0.001);
  EXPECT_LE(coarse, 1e-4);
  EXPECT_LE(drift(0.0005), coarse / 12);  // rk4 loses energy at h^5 in each step
}

TEST(LoadsOverTime, TakeDrivenVerticesAlongAPath) {
  for (const char* integrator : {"rk4", "verlet", "bdf2", "backward-euler"}) {
    Json scene = floating_box("[]");
    scene["integrator"] = integrator;
    scene["driven"] = Json::parse(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]},
      "path": [{"at": 0.002, "place": [5, 5, 5]}, {"at": 0.0045, "place": [5.01, 5, 5]},
               {"at": 0.008, "place": [5.01, 5.02, 5]}]}])");
    Simulation simulation(parse(scene));
    const Vector3d start = simulation.body().vertices().position[26];
    for (int n = 0; n <= 10; ++n) {
      const double t = 0.001 * n;
      const Vector3d expected(0.01 * std::clamp((t - 0.002) / 0.0025, 0.0, 1.0),
                              0.02 * std::clamp((t - 0.0045) / 0.0035, 0.0, 1.0), 0);
      EXPECT_LE((simulation.body().vertices().position[26] - start - expected).norm(), 1e-15) << integrator << n;
      if (n < 10) {
        ASSERT_FALSE(simulation.advance());
      }
    }
    EXPECT_EQ(simulation.body().vertices().velocity[26], Vector3d(0, 0, 0));
  }
}

TEST(LoadsOverTime, TakeDrivenVerticesAlongFromAndToTimesWithinSteps) {
  Json scene = floating_box("[]");
  scene["driven"] = Json::parse(R"([{"ids": [26], "path": [{"at": 0.0025, "place": [0, 0, 0]},
                                                           {"at": 0.0075, "place": [0.05, 0, 0]}]}])");
  Simulation simulation(parse(scene));
  const double start = simulation.body().vertices().position[26].x();
  for (int n = 1; n <= 10; ++n) {
    ASSERT_FALSE(simulation.advance());
    EXPECT_NEAR(simulation.body().vertices().position[26].x() - start,
                0.05 * std::clamp((0.001 * n - 0.0025) / 0.005, 0.0, 1.0), 1e-15)
        << n;
  }
}

TEST(LoadsOverTime, TurnDrivenVerticesOnCircles) {
  Json scene = floating_box("[]");
  scene["driven"] = Json::parse(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]},
    "turn": {"axis": [2, 0, 0], "centre": [7, 0.125, 0.125],
             "angles": [{"at": 0, "degrees": 30}, {"at": 0.006, "degrees": 120}, {"at": 0.01, "degrees": 60}]}}])");
  const SceneFile file = parse(scene);
  const Mesh mesh = make_mesh(file);
  Simulation simulation(file);
  for (int n = 1; n <= 10; ++n) {
    ASSERT_FALSE(simulation.advance());
    const double degrees = n <= 6 ? 15.0 * n : 90.0 - 15.0 * (n - 6), a = degrees * std::numbers::pi / 180;
    const VertexColumns& v = simulation.body().vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vector3d rest = mesh.points[v.point[k]];
      if (rest.x() != 0.25) continue;
      const double y = rest.y() - 0.125, z = rest.z() - 0.125;
      const Vector3d expected(0.25, 0.125 + std::cos(a) * y - std::sin(a) * z,
                              0.125 + std::sin(a) * y + std::cos(a) * z);
      EXPECT_LE((v.position[k] - expected).norm(), 1e-15 * n) << n;
    }
  }
}

/// A box whose one side is fixed and whose other side is turned.
Json wrung_box(const char* integrator) {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  scene["driven"] = Json::parse(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]},
      "turn": {"axis": [1, 0, 0], "centre": [0, 0.125, 0.125],
               "angles": [{"at": 0, "degrees": 0}, {"at": 0.01, "degrees": 10}]}}])");
  scene["integrator"] = integrator;
  return scene;
}

TEST(LoadsOverTime, LeaveTheMethodOfTwoStepsItsOrderWhereTheyMoveVertices) {
  const auto places = [](double step) {
    Json scene = wrung_box("bdf2");
    scene["step"] = step;
    Simulation simulation(parse(scene));
    run(simulation);
    return simulation.body().vertices().position;
  };
  const std::vector<Vector3d> exact = places(0.01 / 1024), coarse = places(0.01 / 16), fine = places(0.01 / 32);
  double before = 0.0, after = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    before = std::max(before, (coarse[k] - exact[k]).norm());
    after = std::max(after, (fine[k] - exact[k]).norm());
  }
  EXPECT_NEAR(std::log2(before / after), 2.0, 0.3);
}

TEST(LoadsOverTime, GoOnFromACheckpointWithTheSameBits) {
  Json scene = floating_box(ramped);
  scene["driven"] = Json::parse(R"([{"ids": [0, 9], "path": [{"at": 0.001, "place": [0, 0, 0]},
                                                             {"at": 0.0072, "place": [0, 0.01, 0]}]},
    {"ids": [2], "turn": {"axis": [0, 0, 1], "centre": [0, 0, 0],
                          "angles": [{"at": 0.003, "degrees": 0}, {"at": 0.009, "degrees": 9}]}}])");
  scene["output"] = Json::parse(R"({"diagnostics_every": 0.001, "checkpoint": 0.001})");
  for (const char* integrator : {"rk4", "bdf2", "verlet"}) {
    scene["integrator"] = integrator;
    const SceneFile file = parse(scene);
    recorded::expect_same(recorded::in_two(file, 5), recorded::whole(file));
  }
}

}  // namespace
}  // namespace dartboard::loads_over_time_test
