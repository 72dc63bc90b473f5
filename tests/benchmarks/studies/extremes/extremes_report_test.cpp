// The claims of the report of the extremes: each claim with a measurement that it must not pass.

#include "benchmarks/studies/extremes/extremes_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dartboard::extremes_report_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Verdict verdict_on(const ExtremesResults& results, const std::string& id) {
  const auto claims = claims_of(results);
  const auto found = std::ranges::find(claims, id, &Claim::id);
  EXPECT_NE(found, claims.end()) << id;
  return found == claims.end() ? Verdict::not_tested : found->verdict;
}

ExtremeCell cell(ExtremeOutcome outcome) { return {"h omega", "box", "rk4", "1", outcome, {}, 0, {}, ""}; }

ExtremesResults matrix(std::vector<ExtremeCell> cells) {
  ExtremesResults results;
  for (const ExtremeCell& c : cells) results.cells.push_back(to_json(c));
  return results;
}

// ---- the matrix

TEST(ExtremesMatrix, HoldsWhereEveryRunIsRightOrSaysSo) {
  ExtremeCell diagnosed = cell(ExtremeOutcome::diagnosed);
  diagnosed.diagnosis = {StepCode::unstable_step, Witness::vertex, 3, "speed", 1e30};
  diagnosed.judged_by = JudgedBy::diagnosis;
  ExtremeCell right = cell(ExtremeOutcome::ok), warned = cell(ExtremeOutcome::degraded);
  right.judged_by = JudgedBy::motion;
  warned.judged_by = JudgedBy::scheme;
  const auto results = matrix({right, warned, diagnosed});
  EXPECT_EQ(verdict_on(results, "no-silent-run"), Verdict::holds);
  EXPECT_EQ(verdict_on(results, "runs-are-judged"), Verdict::holds);
  EXPECT_EQ(verdict_on(results, "diagnoses-name-a-quantity"), Verdict::holds);
  EXPECT_TRUE(forbidden_cells(results).empty());
}

TEST(ExtremesMatrix, DoesNotJudgeTheJudgesOfNoRun) {
  ExtremeCell diagnosed = cell(ExtremeOutcome::diagnosed);
  diagnosed.judged_by = JudgedBy::diagnosis;
  const auto claims = claims_of(matrix({diagnosed}));
  const auto judged = std::ranges::find(claims, "runs-are-judged", &Claim::id);
  EXPECT_EQ(judged->verdict, Verdict::not_tested);
  EXPECT_EQ(judged->reason, "no run ended without a diagnosis");
}

TEST(ExtremesMatrix, CountsSilentRunsAndCrashes) {
  for (const ExtremeOutcome outcome : {ExtremeOutcome::silent, ExtremeOutcome::crash}) {
    const auto results = matrix({cell(ExtremeOutcome::ok), cell(outcome), cell(ExtremeOutcome::ok)});
    EXPECT_EQ(forbidden_cells(results).size(), 1u);
    EXPECT_EQ(verdict_on(results, "no-silent-run"), Verdict::falls_short);
    EXPECT_EQ(exit_code(claims_of(results)), 1);
  }
}

TEST(ExtremesMatrix, FallsShortWhereRunsAreJudgedByTheirSurvivalAlone) {
  std::vector<ExtremeCell> cells(100, cell(ExtremeOutcome::scheme));
  for (ExtremeCell& c : cells) c.judged_by = JudgedBy::scheme;
  cells[0].judged_by = cells[1].judged_by = JudgedBy::survival;
  EXPECT_EQ(verdict_on(matrix(cells), "runs-are-judged"), Verdict::holds);
  cells[2].judged_by = JudgedBy::survival;
  EXPECT_EQ(verdict_on(matrix(cells), "runs-are-judged"), Verdict::falls_short);
}

TEST(ExtremesMatrix, FallsShortWhereADiagnosisNamesNothing) {
  ExtremeCell nameless = cell(ExtremeOutcome::diagnosed);
  nameless.diagnosis = {StepCode::unstable_step, Witness::none, 0, "energy", std::nan("")};
  EXPECT_EQ(verdict_on(matrix({nameless}), "diagnoses-name-a-quantity"), Verdict::falls_short);
}

TEST(ExtremesOffsets, HoldUpToThirtyRoundingsAndNotBeyondNorWithoutANumber) {
  const auto offset = [](const char* integrator, double error) {
    ExtremeCell c = cell(ExtremeOutcome::ok);
    c.integrator = integrator;
    c.offset_error = error;
    return c;
  };
  EXPECT_EQ(verdict_on(matrix({offset("rk4", 5.0), offset("rk4", 29.0)}), "offset-explicit"), Verdict::holds);
  for (const double bad : {31.0, nan, infinity}) {
    EXPECT_EQ(verdict_on(matrix({offset("rk4", 5.0), offset("rk4", bad), offset("rk4", 6.0)}), "offset-explicit"),
              Verdict::falls_short)
        << bad;
    EXPECT_EQ(verdict_on(matrix({offset("bdf2", bad), offset("rk4", 1.0)}), "offset-implicit"), Verdict::falls_short)
        << bad;
    // explicit Euler amplifies rounding as everything else
    EXPECT_EQ(verdict_on(matrix({offset("explicit-euler", bad), offset("rk4", 1.0)}), "offset-explicit"),
              Verdict::holds)
        << bad;
  }
}

// ---- the studies: a sound measurement among others, then one that is not

StabilityLimit limit(double measured, double tolerance) {
  return {.body = "chain", .integrator = "rk4", .theory = 2.828, .measured = measured, .tolerance = tolerance};
}

TEST(ExtremesLimits, HoldWithinTheirToleranceAndNotWithoutANumber) {
  for (const auto& [id, tolerance] : {std::pair("limits-closed-forms", 1e-3), std::pair("limits-meshes", 5e-3)}) {
    ExtremesResults results;
    results.limits = {limit(2.828, 1e-3), limit(2.828, 5e-3)};
    EXPECT_EQ(verdict_on(results, id), Verdict::holds);
    for (const double bad : {2.828 * (1 + 1.1 * tolerance), 2.828 * (1 - 1.1 * tolerance), 0.0, nan, infinity}) {
      results.limits = {limit(2.828, 1e-3), limit(bad, tolerance), limit(2.828, 5e-3)};
      EXPECT_EQ(verdict_on(results, id), Verdict::falls_short) << bad;
    }
  }
}

MeshBody mesh(double omega, double upper, bool proven = true) {
  MeshBody m;
  m.name = "box";
  m.omega = omega;
  m.upper = upper;
  m.proven = proven;
  return m;
}

TEST(ExtremesEstimate, HoldsFromTheTruthToTenPercentAbove) {
  ExtremesResults results;
  results.limits = {limit(2.828, 1e-3)};
  const auto verdict = [&](std::vector<MeshBody> meshes) {
    results.meshes = std::move(meshes);
    return verdict_on(results, "estimate-meshes");
  };
  EXPECT_EQ(verdict({mesh(10, 10), mesh(10, 10.9)}), Verdict::holds);
  for (const MeshBody& bad : {mesh(10, 9.99), mesh(10, 11.1), mesh(10, nan), mesh(nan, 10), mesh(nan, nan),
                              mesh(10, infinity), mesh(10, 10.5, false)})
    EXPECT_EQ(verdict({mesh(10, 10.5), bad, mesh(10, 10.5)}), Verdict::falls_short) << bad.omega << " " << bad.upper;
}

StabilityMap map_with(std::vector<double> measured) {
  StabilityMap map;
  map.integrator = "verlet";
  for (const double m : measured) map.boundary.push_back({0.1, 2.0, m});
  return map;
}

TEST(ExtremesMaps, HoldWithinATenthOfAPercentAndNotWhereNothingWasMeasured) {
  ExtremesResults results;
  results.maps = {map_with({2.0, 2.0015})};
  EXPECT_EQ(verdict_on(results, "map-boundaries"), Verdict::holds);
  EXPECT_NEAR(results.maps[0].worst(), 0.00075, 1e-12);
  for (const double bad : {2.01, 0.0, nan, infinity}) {
    results.maps = {map_with({2.0}), map_with({2.0, bad, 2.0}), map_with({2.0})};
    EXPECT_EQ(verdict_on(results, "map-boundaries"), Verdict::falls_short) << bad;
  }
  EXPECT_EQ(map_with({2.0, 0.0}).worst(), 1.0);
  EXPECT_TRUE(std::isnan(map_with({2.0, nan, 2.0}).worst()));
}

TEST(ExtremesAmplification, HoldsWithinRoundingAndNotWithoutANumber) {
  const auto point = [](double measured) {
    AmplificationPoint p;
    p.integrator = "verlet";
    p.theta = 0.1;
    p.theory = 1.0;
    p.measured = measured;
    p.tolerance = 1e-11;
    return p;
  };
  ExtremesResults results;
  results.amplification = {point(1.0), point(1.0 + 5e-12)};
  EXPECT_EQ(verdict_on(results, "amplification"), Verdict::holds);
  for (const double bad : {1.0 + 2e-11, 1.0 - 1e-9, nan, infinity}) {
    results.amplification = {point(1.0), point(bad), point(1.0)};
    EXPECT_EQ(verdict_on(results, "amplification"), Verdict::falls_short) << bad;
  }
}

TEST(ExtremesDetections, HoldWhereAllArePredictedAndFoundInTime) {
  const auto detection = [](bool predicted, std::uint64_t above) {
    Detection d;
    d.predicted = predicted;
    d.above = above;
    return d;
  };
  ExtremesResults results;
  results.detections = {detection(true, 0), detection(true, 64)};
  EXPECT_EQ(verdict_on(results, "unstable-steps"), Verdict::holds);
  for (const Detection& bad : {detection(false, 0), detection(true, 65)}) {
    results.detections = {detection(true, 0), bad};
    EXPECT_EQ(verdict_on(results, "unstable-steps"), Verdict::falls_short);
  }
}

TEST(ExtremesRounding, HoldsOfARandomWalk) {
  const auto growth = [](double exponent) {
    RoundingGrowth g;
    g.integrator = "verlet";
    g.points = {{10, 1e-15}};
    g.exponent = exponent;
    return g;
  };
  for (const auto& [exponent, verdict] : {std::pair(0.5, Verdict::holds),
                                          {0.41, Verdict::holds},
                                          {0.61, Verdict::falls_short},
                                          {1.0, Verdict::falls_short},
                                          {nan, Verdict::falls_short},
                                          {infinity, Verdict::falls_short}}) {
    ExtremesResults results;
    results.rounding = {growth(exponent)};
    EXPECT_EQ(verdict_on(results, "rounding-verlet"), verdict) << exponent;
  }
}

// Two standard errors on either side have to be within 0.4 .. 0.6, or without.
TEST(ExtremesRounding, IsNotJudgedByAnExponentThatTheStartsDoNotSettle) {
  for (const auto& [exponent, error, verdict] : {std::tuple(0.45, 0.02, Verdict::holds),
                                                 {0.45, 0.03, Verdict::undecided},
                                                 {0.55, 0.03, Verdict::undecided},
                                                 {0.35, 0.03, Verdict::undecided},
                                                 {0.65, 0.03, Verdict::undecided},
                                                 {0.35, 0.02, Verdict::falls_short},
                                                 {0.65, 0.02, Verdict::falls_short},
                                                 {0.5, nan, Verdict::falls_short}}) {
    ExtremesResults results;
    results.rounding.resize(1);
    results.rounding[0].integrator = "verlet";
    results.rounding[0].points = {{10, 1e-15}};
    results.rounding[0].exponent = exponent;
    results.rounding[0].standard_error = error;
    EXPECT_EQ(verdict_on(results, "rounding-verlet"), verdict) << exponent << " " << error;
  }
}

TEST(ExtremesTinySteps, HoldWhereACompensatedStateLosesNothingThatCanBeRead) {
  const auto tiny = [](const char* integrator, double lost) {
    TinySteps t;
    t.integrator = integrator;
    t.lost = lost;
    t.readable = 1e-9;
    return t;
  };
  ExtremesResults results;
  results.tiny = {tiny("verlet", 1.0), tiny("verlet-compensated", 1e-8)};
  EXPECT_EQ(verdict_on(results, "tiny-steps"), Verdict::holds);
  for (const double bad : {1e-3, 1.0, nan, infinity}) {
    results.tiny = {tiny("verlet-compensated", 1e-8), tiny("verlet-compensated", bad)};
    EXPECT_EQ(verdict_on(results, "tiny-steps"), Verdict::falls_short) << bad;
  }
}

TEST(ExtremesTables, BelongToTheStudiesThatWereMade) {
  ExtremesResults results = matrix({cell(ExtremeOutcome::ok)});
  results.maps = {map_with({2.0})};
  std::vector<std::string> of;
  for (const NamedTable& t : tables_of(results)) of.push_back(t.study + ": " + t.name);
  EXPECT_EQ(of, (std::vector<std::string>{"matrix: extremes", "matrix: integrators", "maps: maps"}));
}

}  // namespace
}  // namespace dartboard::extremes_report_test
