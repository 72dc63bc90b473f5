// A sample of the matrix of extremes: no run is silent; and hostile runs are distinguished from good ones.

#include "validation/extremes/extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/plain/error.h"
#include "core/time/explicit/frozen_damping.h"
#include "validation/extremes/extreme_run.h"

namespace dartboard::extremes_test {
namespace {

std::size_t count(const std::vector<ExtremeCell>& cells, ExtremeOutcome outcome) {
  return static_cast<std::size_t>(std::ranges::count(cells, outcome, &ExtremeCell::outcome));
}

std::vector<ExtremeCell> run_some(std::string_view axis, std::size_t every) {
  const std::vector<ExtremeCase> cases = extreme_cases(axis, true);
  std::vector<ExtremeCell> cells;
  for (std::size_t k = 0; k < cases.size(); k += every) cells.push_back(cases[k].run());
  for (const ExtremeCell& cell : cells)
    EXPECT_NE(cell.outcome, ExtremeOutcome::silent)
        << cell.axis << " " << cell.scene << " " << cell.integrator << " " << cell.value << ": " << cell.note;
  return cells;
}

TEST(LongExtremes, HasNoSilentRunInASampleOfEveryAxis) {
  for (const ExtremeAxis& axis : extreme_axes())
    EXPECT_TRUE(axis.name == "long" || !run_some(axis.name, 5).empty()) << axis.name;
}

TEST(Extremes, HasAllOutcomesThatAreAllowed) {
  const std::vector<ExtremeCell> cells = run_some("step", 1);
  for (const ExtremeOutcome outcome :
       {ExtremeOutcome::ok, ExtremeOutcome::scheme, ExtremeOutcome::degraded, ExtremeOutcome::diagnosed})
    EXPECT_GT(count(cells, outcome), 0u) << to_string(outcome);
}

TEST(Extremes, DiagnosesEveryBadNumberInTheInput) {
  const std::vector<ExtremeCell> cells = run_some("input", 1);
  EXPECT_EQ(count(cells, ExtremeOutcome::diagnosed), cells.size());
}

// A rounding of the coordinates is 1e-6 of an edge from an offset of 4.5e9 edges on.
TEST(Extremes, WarnsOfAnOffsetThatMatters) {
  for (const ExtremeCase& which : extreme_cases("offset", false)) {
    if (which.integrator != "verlet" && which.integrator != "sdirk2") continue;
    const ExtremeCell cell = which.run();
    const bool warned = std::ranges::find(cell.warnings, "COORD_PRECISION") != cell.warnings.end();
    EXPECT_EQ(warned, which.value == "1e+12") << which.scene << " " << which.integrator << " " << which.value;
    EXPECT_NE(cell.note.find("eps D"), std::string::npos) << cell.note;
    EXPECT_NE(cell.outcome, ExtremeOutcome::silent) << cell.note;
  }
}

TEST(Extremes, HasTheSameOutcomeForMassesAndSpringsOfAnySize) {
  std::map<std::string, ExtremeOutcome> outcomes;  // by scene, integrator and step
  std::size_t scaled = 0;
  for (const ExtremeCase& which : extreme_cases("mass", false)) {
    const std::size_t at = which.value.find("h omega");
    if (!which.value.starts_with("all times")) continue;
    const ExtremeCell cell = which.run();
    EXPECT_NE(cell.outcome, ExtremeOutcome::silent) << which.value << " " << cell.note;
    const auto [first, added] =
        outcomes.try_emplace(which.scene + which.integrator + which.value.substr(at), cell.outcome);
    EXPECT_EQ(first->second, cell.outcome) << which.scene << " " << which.integrator << " " << which.value;
    ++scaled;
  }
  EXPECT_EQ(scaled, 2 * outcomes.size());
}

/// Half way through its 40 steps all motion is stopped; no bound of an order applies.
ExtremeCell run_to_death(std::string_view integrator, double damping = 0.0) {
  ExtremeSetup setup = with_theta(moving_body("box"), 0.2, 40);
  setup.compare = false;
  setup.halfway = [](SpringColumns& body) {
    const SpringColumns rest = extreme_body("box");
    body.x = rest.x;
    for (auto& v : body.v) v.setZero();
  };
  for (Spring& s : setup.body.springs) s.damping = damping * s.stiffness;
  return run_extreme({"test", "box", std::string(integrator), "dead", {}}, std::move(setup));
}

TEST(Extremes, CallsAMotionThatDiesSilent) {
  for (const char* integrator : {"verlet", "blanes-moan-4", "implicit-midpoint", "energy-momentum"}) {
    const ExtremeCell cell = run_to_death(integrator);
    EXPECT_EQ(cell.outcome, ExtremeOutcome::silent) << integrator;
    EXPECT_NE(cell.note.find("fallen"), std::string::npos) << cell.note;
  }
}

TEST(Extremes, LetsMotionDieWhereItIsDampedOrTheMethodDamps) {
  EXPECT_NE(run_to_death("backward-euler").outcome, ExtremeOutcome::silent);
  EXPECT_NE(run_to_death("verlet", 1e-3).outcome, ExtremeOutcome::silent);
}

TEST(Extremes, TellsRunsThatWereRefusedFromThoseThatWereStopped) {
  for (const ExtremeCell& cell : run_some("input", 3)) EXPECT_EQ(cell.refused, cell.step == 0) << cell.integrator;
  for (const ExtremeCell& cell : run_some("injected", 3)) EXPECT_FALSE(cell.refused) << cell.integrator;
}

TEST(Extremes, AsksADiagnosisForAQuantity) {
  const double no_number = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(names_a_quantity({StepCode::newton_stalled, Witness::none, 0, "residual", 1e-3}));
  EXPECT_TRUE(names_a_quantity({StepCode::overflow_risk, Witness::none, 0, "force", infinity}));
  EXPECT_TRUE(names_a_quantity({StepCode::nonfinite, Witness::vertex, 3, "velocity", no_number}));
  EXPECT_FALSE(names_a_quantity({StepCode::newton_stalled, Witness::none, 0, "residual", no_number}));
}

TEST(Extremes, CarriesTheErrorAtAnOffset) {
  for (const ExtremeCell& cell : run_some("offset", 7))
    if (cell.outcome != ExtremeOutcome::diagnosed) {
      ASSERT_TRUE(cell.offset_error.has_value()) << cell.integrator;
      EXPECT_GE(*cell.offset_error, 0.0);
    }
}

TEST(Extremes, LetsTwoEventsHappenAtOneTime) {
  int at_one_time = 0;
  for (const ExtremeCase& which : extreme_cases("events", false)) {
    if (!which.value.ends_with("at one time") || which.integrator != "verlet") continue;
    const ExtremeCell cell = which.run();
    EXPECT_NE(cell.outcome, ExtremeOutcome::silent) << which.value << ": " << cell.note;
    ++at_one_time;
  }
  EXPECT_EQ(at_one_time, 4);
}

TEST(Extremes, CoversTwoThousandRuns) {
  std::size_t runs = 0;
  for (const ExtremeAxis& axis : extreme_axes()) runs += extreme_cases(axis.name, false).size();
  EXPECT_GE(runs, 2000u);
}

TEST(Extremes, RefusesAnAxisThatThereIsNot) { EXPECT_THROW(extreme_cases("temperature", true), InputError); }

TEST(FrozenDamping, EndsForInfinitelyMuchOfIt) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(one_minus_exp_of_minus(infinity), 1.0);
  EXPECT_EQ(one_minus_exp_of_minus(-infinity), -infinity);
  EXPECT_TRUE(std::isnan(one_minus_exp_of_minus(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace dartboard::extremes_test
