// The lists that frozen scenes hand to the codes of the references describe the motion that core simulates.

#include "validation/frozen/frozen_motion.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/time/integrators.h"
#include "reference/error_norms.h"
#include "reference/ode_oracle.h"
#include "tests/support/moving_box.h"
#include "validation/recommend/pilots.h"
#include "validation/scenes/scene_of_file.h"
#include "validation/scenes/scene_reference.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard::frozen_motion_test {
namespace {

using namespace moving;

Json changed(const char* patch) {
  Json scene = moving_box();
  scene["duration"] = 0.05;
  scene["gravity"] = {0, 0.5, -2};
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  scene.merge_patch(Json::parse(patch));
  return scene;
}

struct Kind {
  const char* name;
  const char* patch;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class FrozenMotion : public ::testing::TestWithParam<Kind> {};

// Steps of 1/512 of the duration, with h omega of about 0.03, leave 1e-9 to a method of order 4 or 5; what is wrong in
// a mass, a spring, a law or an event is larger by far.
TEST_P(FrozenMotion, IsFollowedByACodeOfTheReferences) {
  const TradeoffScene scene = scene_of_file(parse(changed(GetParam().patch)));
  EXPECT_EQ(scene.beyond_references, "");
  const auto steps =
      std::max<std::uint64_t>(512, 8 * static_cast<std::uint64_t>(4 * scene.fastest_rate * scene.duration));
  const TimedRun run = run_timed(scene, *make_integrator("rk4"), {.steps = steps}, [] { return 0; });
  ASSERT_TRUE(run.result.ok()) << to_string(run.result);
  const reference::CodeRun odeint = reference::run_odeint_fehlberg(scene.motion, 0.5);
  std::vector<PointState> states;
  for (const auto& y : odeint.states) states.push_back(reference::to_points(y));
  const reference::MotionErrors errors = reference::motion_errors(scene.motion, run.states, states);
  EXPECT_LT(errors.x, 1e-7);
  EXPECT_LT(errors.v, 1e-6);
  EXPECT_LT(errors.energy, 1e-6);
  // the scene moves at all
  EXPECT_GT((states.back().x.back() - scene.motion.start.x.back()).norm(), 1e-3);
}

const Kind kinds[] = {
    {"springs", "{}"},
    {"cut and torn",
     R"({"events": [{"at": 0.01, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
                                    {"at": 0.023, "tear": {"vertex": 13, "direction": [0, 1, 0]}}]})"},
    {"removal",
     R"({"events": [{"from": 0.01, "every": 0.01, "until": 0.04, "remove": {"random": {"count": 2, "seed": 3}}}]})"},
    {"release", R"({"events": [{"at": 0.02, "release": {"plane": {"point": [0, 0, 0.06], "normal": [0, 0, -1]}}}]})"},
    {"drives", R"({"driven": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]}, "velocity": [0.5, 0, 0.25],
                               "from": 0.007, "until": 0.043, "reverse_every": 0.011}]})"},
    {"forces", R"({"forces": [{"box": {"min": [0.24, -1, -1], "max": [1, 1, 1]}, "force": [3, 0, 2.5],
                               "from": 0.007, "until": 0.04}],
                   "events": [{"at": 0.03, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"rollers", R"({"fixed": [{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}, "axes": ["x"]},
                              {"plane": {"point": [0, 0, 0], "normal": [0, -1, 0]}, "axes": ["y"]}]})"},
    {"elements", R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3,
                                  "damping": {"ratio": 0.05, "frequency": 30}},
                     "events": [{"at": 0.02, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}]})"},
    {"corotational", R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null,
                                      "model": "corotational"}})"},
    {"hexahedra", R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null},
                      "body": {"generate": {"box": {"kind": "hexahedra", "pattern": null}}},
                      "events": [{"at": 0.02, "remove": {"ids": [5]}}]})"},
    {"two materials", R"({"regions": [{"cells": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.126]}},
                                       "material": {"density": 500, "stiffness": 16, "damping": 0.5}}],
                          "events": [{"at": 0.03, "remove": {"ids": [5]}}]})"},
    {"springs by a modulus", R"({"material": {"stiffness": null, "young": 3000}})"},
    {"surface",
     R"({"body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125, "kind": "quadrilaterals"}, "box": null}},
                    "events": [{"at": 0.03, "remove": {"ids": [3]}}]})"},
    {"chain",
     R"({"body": {"generate": {"chain": {"links": 4, "spacing": 0.125}, "box": null}}, "fixed": [{"ids": [0]}]})"},
};
INSTANTIATE_TEST_SUITE_P(Kinds, FrozenMotion, ::testing::ValuesIn(kinds),
                         [](const auto& kind) { return std::to_string(kind.index); });

TEST(BeyondReferences, NamesWhatTheyDoNotKnow) {
  const auto beyond = [](const char* patch) { return scene_of_file(parse(changed(patch))).beyond_references; };
  EXPECT_EQ(beyond("{}"), "");
  EXPECT_EQ(beyond(R"({"body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125}, "box": null}},
                       "material": {"density": 2, "stiffness": null, "young": 300, "poisson": 0.3, "damping": null}})"),
            "membranes");
  EXPECT_EQ(beyond(R"({"body": {"generate": {"box": {"kind": "hexahedra", "pattern": null}}}, "diagonals": "all"})"),
            "springs that are no edges");
  EXPECT_EQ(beyond(R"({"attachments": [{"ids": [3], "stiffness": 10}]})"), "attachments");
  EXPECT_EQ(beyond(R"({"events": [{"at": 0.02, "refine": {"cells": {"ids": [3]}}}]})"), "refinement");
}

TEST(BeyondReferences, LeavesARunOfItsOwnToBeComparedWith) {
  const TradeoffScene scene = scene_of_file(
      parse(changed(R"({"duration": 0.02, "events": [{"at": 0.007, "refine": {"cells": {"ids": [3]}}}]})")));
  const SceneReference reference = reference_of(scene, [] { return 0; });
  EXPECT_EQ(reference.kind, ReferenceKind::self_converged);
  EXPECT_LT(reference.floor, 1e-9);
  EXPECT_EQ(reference.states.back().x.size(), 28u);  // one more than the points of the box
}

TEST(FrozenMotion, SaysWhichVertexEachPartComesFrom) {
  const TradeoffScene scene = scene_of_file(
      parse(changed(R"({"events": [{"at": 0.01, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
                             {"at": 0.02, "dissociate": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}},
                             {"at": 0.03, "remove": {"ids": [5]}}]})")));
  // a part keeps the point of the mesh, and all parts of one are where it is at rest
  ASSERT_EQ(scene.motion.events.size(), 3u);
  FrozenBody body(*scene.frozen);
  std::vector<std::uint32_t> before(body.body().vertices().point.begin(), body.body().vertices().point.end());
  for (const reference::NetworkEvent& event : scene.motion.events) {
    body.pass();
    const std::vector<std::uint32_t>& after = body.body().vertices().point;
    ASSERT_EQ(event.from.size(), after.size());
    for (std::size_t k = 0; k < after.size(); ++k) EXPECT_EQ(before[event.from[k]], after[k]) << k;
    before.assign(after.begin(), after.end());
  }
}

// The box is gone before the last checkpoints.
TEST(FrozenMotion, EndsWithNothingWhereAllCellsAreRemoved) {
  const TradeoffScene scene = scene_of_file(parse(changed(
      R"({"duration": 0.02, "events": [{"at": 0.011, "remove": {"box": {"min": [-9, -9, -9], "max": [9, 9, 9]}}}]})")));
  ASSERT_EQ(scene.motion.events.size(), 1u);
  EXPECT_EQ(scene.motion.events[0].network.point_count(), 0u);
  const SceneReference reference = reference_of(scene, [] { return 0; });
  EXPECT_EQ(reference.kind, ReferenceKind::certified);
  EXPECT_LT(reference.floor, 1e-10);
  EXPECT_TRUE(reference.states.back().x.empty());
  for (const TradeoffContender& contender : tradeoff_contenders()) {
    const RunSetting setting = contender.adaptive ? RunSetting{.tolerance = 1e-6} : RunSetting{.steps = 160};
    const TimedRun run = run_timed(scene, *contender.make(), setting, [] { return 0; });
    ASSERT_TRUE(run.result.ok()) << contender.name << ": " << to_string(run.result);
    EXPECT_LT(reference::motion_errors(scene.motion, run.states, reference.states).x, 0.1) << contender.name;
    EXPECT_EQ(differences(scene, run, run), std::vector<double>(8, 0.0)) << contender.name;
  }
}

}  // namespace
}  // namespace dartboard::frozen_motion_test
