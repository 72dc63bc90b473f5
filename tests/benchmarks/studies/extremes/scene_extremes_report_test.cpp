#include "benchmarks/studies/extremes/scene_extremes_report.h"

#include <gtest/gtest.h>

#include "benchmarks/studies/extremes/extremes_report.h"

namespace dartboard::scene_extremes_report_test {
namespace {

SceneCells two_by_two() {
  const auto cell = [](const char* integrator, const char* value, ExtremeOutcome outcome, JudgedBy by) {
    ExtremeCell made{"scene", "bar", integrator, value, outcome, {}, 100, {}, ""};
    made.judged_by = by;
    return made;
  };
  ExtremeCell stopped = cell("verlet", "h omega 30", ExtremeOutcome::diagnosed, JudgedBy::diagnosis);
  stopped.diagnosis = {StepCode::unstable_step, Witness::vertex, 7, "speed", 1e9};
  stopped.step = 12;
  ExtremeCell refused = cell("rk4", "h omega 30", ExtremeOutcome::diagnosed, JudgedBy::diagnosis);
  refused.refused = true;
  return {.name = "bar",
          .beyond_references = {},
          .cells = {to_json(cell("verlet", "h omega 0.5", ExtremeOutcome::ok, JudgedBy::motion)),
                    to_json(cell("rk4", "h omega 0.5", ExtremeOutcome::scheme, JudgedBy::scheme)), to_json(stopped),
                    to_json(refused)}};
}

TEST(SceneExtremesReport, HasARowForEachIntegratorAndAColumnForEachStep) {
  const std::vector<NamedTable> tables = tables_of({two_by_two()});
  ASSERT_EQ(tables.size(), 1u);
  using Rows = std::vector<std::vector<std::string>>;
  EXPECT_EQ(tables[0].table.rows(), (Rows{{"verlet", "OK", "UNSTABLE_DT at 12"}, {"rk4", "SCHEME", "refused"}}));
}

TEST(SceneExtremesReport, SaysOfRunsWithAWarningHowTheyAreJudged) {
  for (const auto& [by, words] :
       {std::pair{"motion", "OK, warned"}, {"scheme", "SCHEME, warned"}, {"survival", "SURVIVED, warned"}}) {
    SceneCells scene = two_by_two();
    scene.cells[0]["outcome"] = "DEGRADED";
    scene.cells[0]["judged_by"] = by;
    EXPECT_EQ(tables_of({scene}).at(0).table.rows().at(0).at(1), words);
  }
}

TEST(SceneExtremesReport, HoldsWhereEveryRunIsJudged) {
  const Claim claim = claims_of({two_by_two()}).at(0);
  EXPECT_EQ(claim.verdict, Verdict::holds);
  EXPECT_EQ(claim.measured, "0");
  EXPECT_EQ(claim.bound_or_interval, "4 runs: 1 judged by the motion, 1 by the steps of the scheme, 2 diagnosed");
}

TEST(SceneExtremesReport, FallsShortWithASilentRunOrACrash) {
  for (const char* outcome : {"SILENT", "CRASH"}) {
    SceneCells scene = two_by_two();
    scene.cells[1]["outcome"] = outcome;
    EXPECT_EQ(claims_of({scene}).at(0).verdict, Verdict::falls_short) << outcome;
  }
}

TEST(SceneExtremesReport, IsUndecidedWhereRunsOnlySurvived) {
  SceneCells scene = two_by_two();
  scene.cells[1]["judged_by"] = "survival";
  EXPECT_EQ(claims_of({scene}).at(0).verdict, Verdict::undecided);
  scene.beyond_references = "membranes";
  EXPECT_EQ(claims_of({scene}).at(0).reason,
            "1 runs are judged by their survival alone: no witness supports membranes");
}

TEST(SceneExtremesReport, HoldsNothingWithoutARun) {
  EXPECT_EQ(claims_of(std::vector{SceneCells{.name = "bar", .beyond_references = {}}}).at(0).verdict,
            Verdict::not_tested);
}

TEST(SceneExtremesReport, SaysWhyASceneWasNotRun) {
  const Claim claim = claims_of({{.name = "bar", .beyond_references = {}, .failure = "no motion"}}).at(0);
  EXPECT_EQ(claim.verdict, Verdict::not_tested);
  EXPECT_EQ(claim.reason, "no motion");
  EXPECT_TRUE(tables_of({{.name = "bar", .beyond_references = {}, .failure = "no motion"}}).empty());
}

}  // namespace
}  // namespace dartboard::scene_extremes_report_test
