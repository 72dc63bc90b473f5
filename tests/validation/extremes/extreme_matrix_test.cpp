// The filling of the matrix of extremes, and runs of its axes whose outcome theory predicts.

#include "validation/extremes/extreme_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "validation/stability/frequency_oracle.h"

namespace dartboard::extreme_matrix_test {
namespace {

using Values = std::vector<std::string>;

/// The values that remain of "0" to "7".
Values values_of(bool quick, bool with_scenes) {
  ExtremeMatrix matrix("axis", quick);
  constexpr std::string_view scenes[]{"one", "other"};
  for (int k = 0; k < 8; ++k) {
    if (with_scenes)
      matrix.add(std::to_string(k), scenes, [](std::string_view) { return ExtremeSetup{}; });
    else
      matrix.add_run(std::to_string(k), "one", [](const ExtremeCase&, const MakeIntegrator&) { return ExtremeCell{}; });
  }
  Values values;
  const std::vector<ExtremeCase> cases = matrix.take();
  const std::size_t of_each = integrators().size() * (with_scenes ? 2 : 1);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (k % of_each == 0) values.push_back(cases[k].value);
    EXPECT_EQ(cases[k].axis, "axis");
    EXPECT_EQ(cases[k].value, values.back());
    EXPECT_EQ(cases[k].integrator, integrators()[k % integrators().size()].name);
    EXPECT_EQ(cases[k].scene, k % of_each < integrators().size() ? "one" : "other");
  }
  EXPECT_EQ(cases.size(), values.size() * of_each);
  return values;
}

TEST(ExtremeMatrix, TakesEveryValueWithEverySceneAndIntegrator) {
  const Values all{"0", "1", "2", "3", "4", "5", "6", "7"};
  EXPECT_EQ(values_of(false, true), all);
  EXPECT_EQ(values_of(false, false), all);
}

TEST(ExtremeMatrix, TakesEveryThirdValueFromTheFirstOnWhenQuick) {
  const Values third{"0", "3", "6"};
  EXPECT_EQ(values_of(true, true), third);
  EXPECT_EQ(values_of(true, false), third);
}

TEST(ExtremeMatrix, RunsWhatItWasGivenForItsScene) {
  ExtremeMatrix matrix("axis", false);
  matrix.add_run("value", "scene", [](const ExtremeCase& which, const MakeIntegrator&) {
    ExtremeCell cell;
    cell.note = which.axis + " " + which.scene + " " + which.integrator + " " + which.value;
    return cell;
  });
  for (const ExtremeCase& one : matrix.take()) EXPECT_EQ(one.run().note, "axis scene " + one.integrator + " value");
}

std::vector<ExtremeCell> runs_of(std::string_view axis, std::string_view value, const std::set<std::string>& methods) {
  std::vector<ExtremeCell> cells;
  for (const ExtremeCase& one : extreme_cases(axis, false))
    if (one.value == value && methods.contains(one.integrator)) cells.push_back(one.run());
  EXPECT_FALSE(cells.empty()) << value;
  return cells;
}

// The diagnosis is the result that ended the run; a run that was not ended has none, and all of its steps.
TEST(ExtremeEvents, AreDiagnosedByTheResultThatEndedThemAndByNothingElse) {
  std::size_t whole = 0;
  for (const char* value : {"a dissociation per step", "all dissociated", "a removal per step",
                            "two removals per step, until nothing is left", "one face dissociated twice at one time"})
    for (const ExtremeCell& cell : runs_of("events", value, {"verlet", "rk4", "backward-euler"})) {
      EXPECT_EQ(cell.outcome == ExtremeOutcome::diagnosed, !cell.diagnosis.ok()) << value << " " << cell.integrator;
      EXPECT_EQ(cell.outcome == ExtremeOutcome::degraded, !cell.warnings.empty() && cell.diagnosis.ok());
      if (!cell.diagnosis.ok()) continue;
      EXPECT_EQ(cell.step, 60u) << value << " " << cell.integrator;
      EXPECT_FALSE(cell.refused);
      ++whole;
    }
  EXPECT_GT(whole, 0u);
}

TEST(ExtremeEvents, AreJudgedByTheStepsOfTheirScheme) {
  for (const ExtremeCell& cell : runs_of("events", "a dissociation per step", {"verlet", "bdf2", "ros2"})) {
    EXPECT_EQ(cell.judged_by, JudgedBy::scheme) << cell.integrator;
    EXPECT_GT(cell.scheme_excess, 0.0) << cell.integrator;
    EXPECT_LE(cell.scheme_excess, 1.0) << cell.integrator;
  }
}

// The mass of a fixed vertex does not matter; the equations of a moving one divide by it.
TEST(ExtremeVertices, NeedAMassUnlessTheyAreHeld) {
  for (const ExtremeCell& cell : runs_of("vertices", "one massless", {"verlet", "rk4", "backward-euler"})) {
    EXPECT_EQ(cell.outcome, ExtremeOutcome::diagnosed) << cell.scene << " " << cell.integrator;
    EXPECT_TRUE(cell.refused) << cell.scene << " " << cell.integrator;
  }
  for (const ExtremeCell& cell : runs_of("vertices", "one held without mass", {"verlet", "rk4", "backward-euler"}))
    EXPECT_TRUE(cell.outcome == ExtremeOutcome::ok || cell.outcome == ExtremeOutcome::scheme)
        << cell.scene << " " << cell.integrator << " " << cell.note;
}

/// The setups of an axis of numbers, by value.
std::vector<ExtremeMatrix::Row> rows_of(std::string_view axis) {
  ExtremeMatrix matrix(axis, false);
  add_numbers(matrix, axis);
  EXPECT_FALSE(matrix.rows().empty());
  return matrix.rows();
}

/// The number after "h omega " in the name of a value.
double theta_of(const std::string& value) { return std::stod(value.substr(value.find("h omega ") + 8)); }

// By Lanczos; the study's own frequency is from below, within a thousandth.
double theta_of(const ExtremeSetup& setup) { return setup.h * fastest_mode(setup.body).omega; }

// Stretched along x by 1 + e, a solid holds E e^2 V / 2 to first order if it can contract sideways; Poisson's ratio 0
// keeps its width. The next term is of the order of e. At rest some roundings of E V are left.
TEST(ExtremeRun, CountsTheEnergyOfElements) {
  const double e = 1e-5;
  SpringColumns body =
      elastic_body("tetrahedra", {.density = 1.0, .young = 100.0, .poisson = 0.0, .model = Model::neo_hookean});
  double volume = 0;
  for (const double m : body.mass) volume += m;  // of density 1
  EXPECT_NEAR(static_cast<double>(energy_of(body)), 0.0, 1e-15 * 100 * volume);
  for (auto& x : body.x) x.x() *= 1 + e;
  EXPECT_NEAR(static_cast<double>(energy_of(body)) / (100 * e * e * volume / 2), 1.0, 10 * e);
}

TEST(ExtremeNumbers, TakeTheStepsThatTheirValuesName) {
  for (const ExtremeMatrix::Row& row : rows_of("step"))
    EXPECT_NEAR(theta_of(row.make("chain")) / std::stod(row.value), 1.0, 2e-3) << row.value;
  for (const char* axis : {"stiffness", "mass", "damping"})
    for (const ExtremeMatrix::Row& row : rows_of(axis))
      EXPECT_NEAR(theta_of(row.make("oscillator")) / theta_of(row.value), 1.0, 2e-3) << axis << " " << row.value;
}

// A tenth of the time scale of the fastest spring, however fast the body moves: the question is whether speed alone
// does harm. The mode is that of the body at rest, since the moving one is torn far apart.
TEST(ExtremeNumbers, MoveBodiesFastInStepsThatFitTheirSprings) {
  for (const ExtremeMatrix::Row& row : rows_of("velocity")) {
    const ExtremeSetup setup = row.make("oscillator");
    EXPECT_NEAR(setup.h * 10.0, 0.1, 1e-3) << row.value;
    double speed = 0.0;
    for (const auto& v : setup.body.v) speed = std::max(speed, v.norm());
    EXPECT_GT(speed, 0.0);
    EXPECT_LE(speed, 1.01 * std::stod(row.value) + 0.03) << row.value;  // besides 0.01 edges at a quarter of 10/s
  }
}

TEST(ExtremeNumbers, DampAsTheirValuesName) {
  for (const ExtremeMatrix::Row& row : rows_of("damping")) {
    const ExtremeSetup setup = row.make("oscillator");
    // zeta = c / (2 m omega) of one mass of 1 kg
    EXPECT_NEAR(setup.body.springs[0].damping / (2.0 * fastest_mode(setup.body).omega), std::stod(row.value),
                2e-3 * std::stod(row.value))
        << row.value;
  }
}

// Squares of forces overflow at one end and underflow at the other: as far either way.
TEST(ExtremeNumbers, MultiplyMassesAsFarUpAsDown) {
  std::multiset<double> up, down;
  for (const ExtremeMatrix::Row& row : rows_of("mass")) {
    if (!row.value.starts_with("all times")) continue;
    const double mass = row.make("oscillator").body.mass[1];
    (mass > 1.0 ? up : down).insert(mass > 1.0 ? mass : 1.0 / mass);
    EXPECT_EQ(row.value.substr(0, row.value.find(',')), "all times 2^" + std::to_string(std::ilogb(mass)));
    EXPECT_FALSE(std::isnormal(mass * mass));
  }
  EXPECT_FALSE(up.empty());
  EXPECT_EQ(up, down);
}

}  // namespace
}  // namespace dartboard::extreme_matrix_test
