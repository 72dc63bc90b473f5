// A sample of the matrix of extremes: no run is silent; and hostile runs are told from good ones.

#include "validation/extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/error.h"
#include "core/time/frozen_damping.h"
#include "validation/stability_limits.h"

namespace dartboard {
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

TEST(Extremes, HasNoSilentRunInASampleOfEveryAxis) {
  for (const ExtremeAxis& axis : extreme_axes())
    EXPECT_TRUE(axis.name == "long" || !run_some(axis.name, 5).empty()) << axis.name;
}

TEST(Extremes, HasAllOutcomesThatAreAllowed) {
  const std::vector<ExtremeCell> cells = run_some("step", 1);
  for (const ExtremeOutcome outcome : {ExtremeOutcome::ok, ExtremeOutcome::degraded, ExtremeOutcome::diagnosed})
    EXPECT_GT(count(cells, outcome), 0u) << to_string(outcome);
}

TEST(Extremes, DiagnosesEveryBadNumberInTheInput) {
  const std::vector<ExtremeCell> cells = run_some("input", 1);
  EXPECT_EQ(count(cells, ExtremeOutcome::diagnosed), cells.size());
}

TEST(Extremes, CoversTwoThousandRuns) {
  std::size_t runs = 0;
  for (const ExtremeAxis& axis : extreme_axes()) runs += extreme_cases(axis.name, false).size();
  EXPECT_GE(runs, 2000u);
}

TEST(Extremes, RefusesAnAxisThatThereIsNot) { EXPECT_THROW(extreme_cases("temperature", true), InputError); }

TEST(StabilityLimits, AreWithinTheirToleranceOfTheory) {
  const std::vector<StabilityLimit> limits = measure_stability_limits(true);
  EXPECT_GE(limits.size(), 80u);
  for (const StabilityLimit& l : limits)
    EXPECT_TRUE(l.holds()) << l.body << " " << l.integrator << " zeta " << l.zeta << ": " << l.measured << " for "
                           << l.theory;
}

TEST(FrozenDamping, EndsForInfinitelyMuchOfIt) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(one_minus_exp_of_minus(infinity), 1.0);
  EXPECT_EQ(one_minus_exp_of_minus(-infinity), -infinity);
  EXPECT_TRUE(std::isnan(one_minus_exp_of_minus(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace dartboard
