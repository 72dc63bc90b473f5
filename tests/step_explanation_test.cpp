// What limits the step of bodies whose fastest oscillation is known.

#include "benchmarks/step_explanation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/scene/simulation.h"
#include "tests/moving_box.h"

namespace dartboard {
namespace {

using namespace moving;

/// Four equal links between two walls. Along the line its matrix over the three free masses is 2 on the diagonal and -1
/// beside it, in units of k / m: the fastest mode is (1, -sqrt 2, 1), of 2 + sqrt 2.
SceneFile chain(const char* integrator = "verlet", double step = 1e-3) {
  Json scene = Json::parse(R"({"name": "chain", "duration": 10.0,
    "body": {"generate": {"chain": {"links": 4, "spacing": 0.5}}},
    "fixed": [{"ids": [0, 4]}], "material": {"density": 2.0, "stiffness": 100.0}})");
  scene["integrator"] = integrator;
  scene["step"] = step;
  return parse(scene);
}

double remedy(const StepExplanation& e, const std::string& what) {
  for (const StepRemedy& r : e.remedies)
    if (r.what == what) return r.step;
  ADD_FAILURE() << what;
  return std::nan("");
}

TEST(StepExplanation, NamesTheSpringsAndVerticesThatTakeMostOfTheEnergyFirst) {
  const StepExplanation e = explain_step(chain());
  // the links are stretched by 1, 1 + sqrt 2, 1 + sqrt 2 and 1: shares of 0.427 and 0.073
  ASSERT_EQ(e.springs.size(), 4u);
  EXPECT_EQ(e.springs[0].number + e.springs[1].number, 1u + 2u);
  EXPECT_EQ(e.springs[2].number + e.springs[3].number, 0u + 3u);
  const double inner = std::pow(1 + std::sqrt(2.0), 2), all = 2 * inner + 2;
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(e.springs[k].share, (k < 2 ? inner : 1.0) / all, 1e-9) << k;
  ASSERT_GE(e.vertices.size(), 3u);
  EXPECT_EQ(e.vertices[0].number, 2u);
  EXPECT_EQ(e.vertices[1].number + e.vertices[2].number, 1u + 3u);
  EXPECT_NEAR(e.vertices[0].share, 0.5, 1e-9);
  EXPECT_NEAR(e.vertices[1].share, 0.25, 1e-9);
}

// What is left of the matrix has another largest eigenvalue, and steps are as its inverse root. The limit of a run of N
// steps is above the 2 of Verlet's method by (ln 2 / 2 N)^2, as growth goes with the root of what is above: 92 steps of
// ten seconds are 1.4e-5, or 7e-6 of it.
TEST(StepExplanation, GivesTheStepThatEachRemedyMakesStable) {
  const StepExplanation e = explain_step(chain());
  const double before = 2.0 + std::sqrt(2.0);
  const auto expect_eigenvalue = [&](const std::string& what, double after) {
    EXPECT_NEAR(remedy(e, what) / e.limit.stable, std::sqrt(before / after), 1e-5) << what;
  };
  EXPECT_NEAR(e.limit.stable, 2.0 / std::sqrt(before * 100.0 / 1.0), 1e-5 * e.limit.stable);
  expect_eigenvalue("halve all stiffnesses", before / 2);
  expect_eigenvalue("halve the stiffness of the 4 springs", before / 2);
  expect_eigenvalue("double the mass of the 3 vertices", before / 2);
  // the other two masses, each between a wall and a wall
  expect_eigenvalue("hold the first vertex", 2.0);
  // two masses on one wall: x^2 - 3 x + 1
  expect_eigenvalue("remove the first spring", (3.0 + std::sqrt(5.0)) / 2.0);
  // of the antisymmetric mode 2; of the symmetric ones (2 - x) (1 - x) = 1
  expect_eigenvalue("double the mass of the first vertex", (3.0 + std::sqrt(5.0)) / 2.0);
  EXPECT_TRUE(std::isinf(remedy(e, "remove the 4 springs")));
}

TEST(StepExplanation, GoesByTheLimitOfTheSimulation) {
  const SceneFile scene = chain("rk4", 1.0);
  const Simulation simulation(scene);
  const StepExplanation e = explain_step(scene);
  EXPECT_EQ(e.limit.stable, simulation.step_limit().stable);
  EXPECT_EQ(e.limit.unstable, simulation.step_limit().unstable);
  ASSERT_TRUE(simulation.step_warning());
  EXPECT_EQ(e.limit.stable, simulation.step_warning()->stable);
  EXPECT_EQ(to_json(e, scene).at("stable_step"), e.limit.stable);
  EXPECT_EQ(to_json(e, scene).at("stable"), false);
  EXPECT_NE(to_text(e, scene).find("TOO LONG"), std::string::npos);
}

TEST(StepExplanation, IsNoneWhereThereIsNoLimit) {
  const SceneFile scene = chain("backward-euler");
  const StepExplanation e = explain_step(scene);
  EXPECT_TRUE(std::isinf(e.limit.stable));
  EXPECT_TRUE(to_json(e, scene).at("stable_step").is_null());
  EXPECT_NE(to_text(e, scene).find("stable in any"), std::string::npos);
}

TEST(StepExplanation, IsOfAStepThatTheSceneRefuses) {
  SceneFile scene = chain("rk4", 1.0);
  scene.unstable_step = UnstableStep::refuse;
  EXPECT_LT(explain_step(scene).limit.stable, 1.0);
}

}  // namespace
}  // namespace dartboard
