// Frozen scenes: their runs have the bits of simulations, and operate on the same cells by every method.

#include "validation/frozen/frozen_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "validation/scenes/scene_of_file.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard::frozen_scene_test {
namespace {

using namespace moving;

// 64 steps of 2^-10 s: times are exact
Json exact_box() {
  Json scene = moving_box();
  scene["step"] = 0x1p-10;
  scene["duration"] = 0x1p-4;
  scene["gravity"] = {0, 0.5, -2};
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  return scene;
}

/// The box with other keys, or without those that are null.
Json changed(const char* patch) {
  Json scene = exact_box();
  scene.merge_patch(Json::parse(patch));
  return scene;
}

/// The last state, by vertex number.
PointState run_as_simulation(const Json& json) {
  Simulation simulation(parse(json));
  run(simulation);
  const VertexColumns& v = simulation.body().vertices();
  return {v.position, v.velocity};
}

PointState run_as_study(const TradeoffScene& scene, const std::string& integrator, std::uint64_t steps = 64) {
  const TimedRun run = run_timed(scene, *make_integrator(integrator), {.steps = steps}, [] { return 0; });
  EXPECT_TRUE(run.result.ok()) << integrator << ": " << to_string(run.result);
  return run.states.back();
}

struct Kind {
  const char* name;
  const char* patch;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class FrozenSceneBits : public ::testing::TestWithParam<Kind> {};

TEST_P(FrozenSceneBits, AreThoseOfTheSimulationWithTheSameIntegratorAndStep) {
  for (const char* integrator : {"rk4", "verlet", "blanes-moan-4", "baraff-witkin"}) {
    Json json = changed(GetParam().patch);
    json["integrator"] = integrator;
    const PointState simulated = run_as_simulation(json),
                     studied = run_as_study(scene_of_file(parse(json)), integrator);
    EXPECT_EQ(simulated.x, studied.x) << integrator;
    EXPECT_EQ(simulated.v, studied.v) << integrator;
  }
}

const Kind kinds[] = {
    {"springs", "{}"},
    {"faces", R"({"events": [{"at": 0.015625, "dissociate": {"points": [[0, 1, 13], [0, 4, 13]]}}]})"},
    {"tear", R"({"events": [{"at": 0.03125, "tear": {"vertex": 13, "direction": [1, 0, 0]}},
                            {"at": 0.0, "dissociate": {"points": [[0, 1, 13]]}}]})"},
    {"plane",
     R"({"events": [{"at": 0.03125, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"removal", R"({"events": [{"from": 0.0078125, "every": 0.0078125, "until": 0.05,
                                "remove": {"random": {"count": 2, "seed": 3}}}]})"},
    {"refinement", R"({"events": [{"at": 0.0078125, "refine": {"cells": {"ids": [3, 40]}}},
                                  {"at": 0.015625, "refine": {"cells": {"ids": [3]}, "at": "centre"}},
                                  {"at": 0.03125, "remove": {"ids": [3]}}]})"},
    {"release",
     R"({"events": [{"at": 0.015625, "release": {"plane": {"point": [0, 0, 0.06], "normal": [0, 0, -1]}}}]})"},
    {"drives", R"({"driven": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]}, "velocity": [0.5, 0, 0.25],
                               "from": 0.0078125, "until": 0.046875, "reverse_every": 0.015625}]})"},
    {"forces", R"({"forces": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]}, "force": [0.5, 0, 0.25],
                               "from": 0.0078125, "until": 0.046875}],
                   "events": [{"at": 0.03125, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"loads over time",
     R"({"driven": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]},
                     "path": [{"at": 0, "place": [0, 0, 0]}, {"at": 0.03125, "place": [0.01, 0, 0]},
                              {"at": 0.125, "place": [0.01, 0.02, 0]}]}],
         "forces": [{"ids": [13], "force": [0.5, 0, 0.25], "from": 0.0078125,
                     "over_time": [{"at": 0, "factor": 0}, {"at": 0.02001953125, "factor": 3},
                                   {"at": 0.050048828125, "factor": -1}]}],
         "event_times": "exact",
         "events": [{"at": 0.03125, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"elements", R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null},
                     "events": [{"at": 0.03125, "dissociate": {"points": [[0, 1, 13], [0, 4, 13]]}}]})"},
    {"hexahedra", R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null},
                      "body": {"generate": {"box": {"kind": "hexahedra", "pattern": null}}},
                      "events": [{"at": 0.03125, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"two materials", R"({"regions": [{"cells": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.126]}},
                                       "material": {"density": 500, "stiffness": 16, "damping": 0.5}}],
                          "events": [{"at": 0.03125, "remove": {"ids": [5]}}]})"},
    {"surface",
     R"({"body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125, "kind": "quadrilaterals"}, "box": null}},
                    "events": [{"at": 0.03125, "remove": {"ids": [3]}}]})"},
    {"membrane", R"({"body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125}, "box": null}},
                     "material": {"density": 2, "stiffness": null, "young": 300, "poisson": 0.3, "damping": null}})"},
    {"chain",
     R"({"body": {"generate": {"chain": {"links": 4, "spacing": 0.125}, "box": null}}, "fixed": [{"ids": [0]}]})"},
};
INSTANTIATE_TEST_SUITE_P(Kinds, FrozenSceneBits, ::testing::ValuesIn(kinds),
                         [](const auto& kind) { return std::to_string(kind.index); });

TEST(FrozenScene, TearsWhatAnAccurateRunTearsByEveryMethodAndStep) {
  const TradeoffScene scene = scene_of_file(parse(changed(
      R"({"material": {"damping": 0}, "initial_velocity": {"linear": [[8, 0, 0], [0, 0, 0], [0, 0, 0]]},
          "events": [{"tear_where_stressed": {"threshold": 60}}]})")));
  ASSERT_FALSE(scene.motion.events.empty());
  const std::size_t vertices = scene.motion.events.back().network.point_count();
  EXPECT_GT(vertices, scene.motion.network.point_count());
  for (const char* integrator : {"rk4", "backward-euler"})
    EXPECT_EQ(run_as_study(scene, integrator, 16).x.size(), vertices) << integrator;
  ASSERT_EQ(scene.omissions.size(), 1u);
  EXPECT_EQ(scene.omissions[0],
            "/events/0 tears the same faces at the same times in every run, those of one accurate run.");
}

TEST(FrozenScene, CutsWhatLiesOnThePlaneOnceContactHasMovedTheBody) {
  // a wall pushes the box, and with it the faces in its middle, to the plane
  const TradeoffScene scene = scene_of_file(parse(changed(
      R"({"fixed": [], "initial_velocity": [0, 0, 0], "gravity": [0, 0, 0], "duration": 0.5, "step": 0.0078125,
          "contact": {"pressure": 500, "depth": 0.02,
                      "obstacles": [{"plane": {"point": [-0.01, 0, 0], "normal": [1, 0, 0]}, "velocity": [0.5, 0, 0]}]},
          "events": [{"at": 0.45, "dissociate": {"plane": {"point": [0.3, 0, 0], "normal": [1, 0, 0]}}}]})")));
  EXPECT_EQ(scene.motion.events.size(), 1u);
  EXPECT_EQ(scene.beyond_references, "contact");
}

TEST(FrozenScene, IsNotRunThroughContactInStepsThatTheIntegratorChooses) {
  const TradeoffScene scene = scene_of_file(parse(changed(
      R"({"contact": {"pressure": 500, "depth": 0.02,
                      "obstacles": [{"plane": {"point": [0, 0, -1], "normal": [0, 0, 1]}}]}})")));
  EXPECT_THROW(run_timed(scene, *make_integrator("dormand-prince-54"), {.tolerance = 1e-3}, [] { return 0; }),
               InputError);
}

TEST(FrozenScene, LooksAtTheBodyInEveryStepOnlyWhereThereIsOne) {
  Json json = changed(R"({"step": null, "accuracy": 1e-2, "events": [{"tear_where_stressed": {"threshold": 1}}]})");
  const TradeoffScene scene = scene_of_file(parse(json));
  EXPECT_TRUE(scene.motion.events.empty());
  ASSERT_EQ(scene.omissions.size(), 1u);
  EXPECT_EQ(scene.omissions[0],
            "/events/0 is left out: it looks at the body in every step, and no step has been chosen.");
}

TEST(FrozenScene, NamesTheEventThatItsBodyDoesNotHave) {
  try {
    scene_of_file(parse(changed(R"({"events": [{"at": 0.03125, "remove": {"ids": [480]}}]})")));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "file: /events/0/remove/ids/0: is 480; expected a cell of the mesh, less than 48");
  }
}

const char* const turned_and_pulled =
    R"({"driven": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]},
                    "turn": {"axis": [1, 0, 0], "centre": [0, 0.125, 0.125],
                             "angles": [{"at": 0, "degrees": 0}, {"at": 0.0625, "degrees": 30}]}}],
        "forces": [{"ids": [13], "force": [0, 0.5, 0], "over_time": [{"at": 0, "factor": 0}, {"at": 0.0625, "factor": 2}]}]})";

TEST(FrozenScene, IsOfSecondOrderUnderLoadsThatChangeInTime) {
  const TradeoffScene scene = scene_of_file(parse(changed(turned_and_pulled)));
  const PointState exact = run_as_study(scene, "rk4", 4096);
  for (const char* integrator : {"rk4", "verlet", "implicit-midpoint"}) {
    std::array<double, 2> x{}, v{};
    for (std::size_t k = 0; k < 2; ++k) {
      const PointState found = run_as_study(scene, integrator, 128u << k);
      for (std::size_t i = 0; i < exact.x.size(); ++i) {
        x[k] = std::max(x[k], (found.x[i] - exact.x[i]).norm());
        v[k] = std::max(v[k], (found.v[i] - exact.v[i]).norm());
      }
    }
    EXPECT_NEAR(std::log2(x[0] / x[1]), 2.0, 0.2) << integrator;
    EXPECT_NEAR(std::log2(v[0] / v[1]), 2.0, 0.3) << integrator;
  }
}

TEST(FrozenScene, ShowsTheVelocityOfATurnAtTheTimeWhateverTheStep) {
  const TradeoffScene scene = scene_of_file(parse(changed(turned_and_pulled)));
  const PointState coarse = run_as_study(scene, "rk4", 16), fine = run_as_study(scene, "rk4", 64);
  const Eigen::Vector3d turning(30.0 * std::numbers::pi / 180.0 / 0.0625, 0, 0);
  std::size_t turned = 0;
  for (std::size_t i = 0; i < coarse.x.size(); ++i) {
    const Eigen::Vector3d arm = coarse.x[i] - Eigen::Vector3d(0.25, 0.125, 0.125);
    if (std::abs(arm[0]) > 1e-12) continue;  // not on the face that is turned
    ++turned;
    EXPECT_LT((coarse.v[i] - turning.cross(arm)).norm(), 1e-6 * turning.norm() * 0.1);
    EXPECT_EQ(coarse.v[i], fine.v[i]);
  }
  EXPECT_EQ(turned, 9u);
}

TEST(FrozenScene, IsNotRunUnderSuchLoadsInStepsThatTheIntegratorChooses) {
  const TradeoffScene scene = scene_of_file(parse(changed(turned_and_pulled)));
  EXPECT_EQ(scene.beyond_references, "loads that change in time");
  EXPECT_THROW(run_timed(scene, *make_integrator("dormand-prince-54"), {.tolerance = 1e-3}, [] { return 0; }),
               InputError);
}

}  // namespace
}  // namespace dartboard::frozen_scene_test
