// Warnings of a run before its first step, and cases without a warning.

#include "core/scene/survey/scene_warnings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/scene/survey/free_shapes.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::scene_warnings_test {
namespace {

using namespace moving;

// 3 n coordinates less 6 rigid motions less the springs of the edges, which are independent: 24 - 6 - 12, 18 - 6 - 9,
// 15 - 6 - 8, 12 - 6 - 6.
TEST(FreeShapes, AreWhatEdgesAloneDoNotHold) {
  EXPECT_EQ(free_shapes(CellKind::hexahedron), 6u);
  EXPECT_EQ(free_shapes(CellKind::prism), 3u);
  EXPECT_EQ(free_shapes(CellKind::pyramid), 1u);
  EXPECT_EQ(free_shapes(CellKind::tetrahedron), 0u);
}

TEST(SceneWarnings, NameTheCellsThatCanShearWithoutAForce) {
  Json json = moving_box();
  EXPECT_TRUE(warnings_before_run(parse(json)).empty());
  json["body"] = Json::parse(R"({"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.125, "kind": "hexahedra"}}})");
  const auto said = warnings_before_run(parse(json));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("(8 of kind hexahedron in 6 ways)"), std::string::npos) << said[0];
}

TEST(SceneWarnings, OfAStepSayWhichKeyToChangeToWhat) {
  Json json = moving_box();
  json["material"]["stiffness"] = 1e6;
  const Simulation simulation(parse(json));
  const auto said = warnings_before_run(parse(json));
  ASSERT_EQ(said.size(), 1u);
  const std::string advice = fmt::format("set /step to at most {:.3g}", simulation.step_warning()->stable);
  EXPECT_NE(said[0].find(advice), std::string::npos) << said[0];
}

// The damping of elements limits Runge-Kutta and not Verlet, which takes it apart; contact has no part in it.
TEST(SceneWarnings, OfAStepThatDampingLimitsNameAMethodThatItDoesNotLimit) {
  Json json = moving_box();
  json["material"] = Json::parse(R"({"density": 1000, "young": 20000, "poisson": 0.3,
                                     "damping": {"ratio": 5, "frequency": 5}, "viscosity": 0})");
  json["contact"] = Json::parse(R"({"pressure": 2000, "depth": 0.01,
    "obstacles": [{"plane": {"point": [0, 0, -1], "normal": [0, 0, 1]}}]})");
  json["integrator"] = "rk4";
  json["step"] = 0.002;
  const auto said = warnings_before_run(parse(json));
  ASSERT_FALSE(said.empty());
  const std::string method = "or take verlet, whose step the damping does not limit: ";
  const std::size_t at = said[0].find(method);
  ASSERT_NE(at, std::string::npos) << said[0];
  EXPECT_EQ(said[0].find("where contacts are"), std::string::npos) << said[0];
  json["integrator"] = "verlet";
  json["step"] = std::stod(said[0].substr(at + method.size()));
  EXPECT_FALSE(Simulation(parse(json)).step_warning());
  json["step"] = 1.1 * json["step"].get<double>();
  EXPECT_TRUE(Simulation(parse(json)).step_warning());
}

TEST(SceneWarnings, SayHowLongAStepIsBesideWhatIsStable) {
  Json json = moving_box();
  const double longest = Simulation(parse(json)).step_limit().stable;
  json["step"] = longest / 4;
  EXPECT_EQ(step_in_words(Simulation(parse(json)), parse(json)), "0.25 of the longest stable step");
}

// A chain of equal masses and springs has a highest frequency just below Gershgorin's bound of 2 sqrt(k / m).
TEST(SceneWarnings, SayHowLongAStepOfALargeBodyIsAtMost) {
  Json json = moving_box();
  json["body"]["generate"] = {{"chain", {{"links", 60000}, {"spacing", 0.5}}}};
  const Simulation simulation(parse(json));
  ASSERT_EQ(simulation.stable_step().lower, 0.0);  // no close estimate was needed
  const double longest = simulation.step_limit_found().stable;
  EXPECT_LE(longest, simulation.step_limit().stable);
  json["step"] = longest / 4;
  EXPECT_EQ(step_in_words(Simulation(parse(json)), parse(json)), "at most 0.25 of the longest stable step");
  json["step"] = 1.5 * longest;  // for which a close estimate is made, which is not made again
  EXPECT_EQ(step_in_words(Simulation(parse(json)), parse(json)).find("at most"), std::string::npos);
}

TEST(SceneSurvey, NamesAMethodThatIsCheaperThanOneThatDampsCellByCell) {
  Json json = moving_box();
  json["material"] = Json::parse(R"({"density": 1000, "young": 20000, "poisson": 0.3,
                                     "damping": {"ratio": 0.05, "frequency": 5}, "viscosity": 0})");
  json["integrator"] = "verlet";
  json["step"] = 1e-4;
  using Notes = std::vector<std::string>;
  EXPECT_EQ(
      survey_of(parse(json)).notes,
      Notes{"verlet goes through the damping of elements cell by cell, there and back; rk4 is stable at this step "
            "too, and takes it in less than half of the time"});
  Json other = json;
  for (const char* integrator : {"rk4", "symplectic-euler", "backward-euler"}) {
    other["integrator"] = integrator;
    EXPECT_EQ(survey_of(parse(other)).notes, Notes{}) << integrator;
  }
  other = json;
  other["material"].erase("damping");
  EXPECT_EQ(survey_of(parse(other)).notes, Notes{});
  // stiff dampers shorten the steps of rk4 and not those of verlet
  other = json;
  other["material"]["damping"]["ratio"] = 5;
  other["step"] = 0.002;
  EXPECT_EQ(survey_of(parse(other)).notes, Notes{});
}

// 23^3 vertices have three unknowns each
TEST(SceneSurvey, SaysWhatAFactorOfManyUnknownsTakes) {
  Json json = moving_box();
  json["body"] = Json::parse(R"({"generate": {"box": {"cells": [22, 22, 22], "spacing": 0.1, "pattern": "kuhn"}}})");
  json["integrator"] = "backward-euler";
  const std::vector<std::string> notes = survey_of(parse(json)).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].find("an implicit step has 36.5 thousand unknowns here: a factor of its matrix has "), 0u);
  EXPECT_TRUE(notes[0].ends_with("; \"solver\": \"conjugate-gradients\" needs none")) << notes[0];
  json["solver"] = "conjugate-gradients";
  EXPECT_TRUE(survey_of(parse(json)).notes.empty());
}

// 1 / (2 pi 0.001 s) = 159.2 Hz
TEST(SceneWarnings, SayWhatAnImplicitStepDoesNotResolve) {
  Json json = moving_box();
  json["integrator"] = "backward-euler";
  EXPECT_EQ(step_in_words(Simulation(parse(json)), parse(json)), "motions faster than 159 Hz are not resolved");
}

TEST(SceneWarnings, OfATearThatNeverHappensSayHowFarTheStressIsFromIt) {
  const SceneFile scene = parse(with_events(moving_box(), R"([{"tear_where_stressed": {"threshold": 1e9}}])"));
  EXPECT_TRUE(warnings_before_run(scene).empty());  // it may still tear
  Simulation simulation(scene);
  EXPECT_FALSE(simulation.advance());
  const auto said = warnings_of(scene, {}, simulation);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(
      said[0],
      fmt::format(
          "the event at /events/0 never did anything: the largest principal stress is {:.4g}, its threshold 1e+09",
          simulation.body().largest_stress()));
}

}  // namespace
}  // namespace dartboard::scene_warnings_test
