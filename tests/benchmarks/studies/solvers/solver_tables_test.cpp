// Tables and files of `validate solvers`: every figure of results whose figures all differ, in its own place.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/studies/solvers/solver_report.h"
#include "core/plain/error.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/solver_times_for_tests.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::solver_tables_test {
namespace {

using Json = nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int rounds = solver_rounds;

SolverTimes timed(const std::string& body, const std::vector<std::pair<std::string, double>>& ms) {
  SolverTimes t = solver_times(body, ms);
  t.vertices = 512;
  t.terms = 19;
  return t;
}
SolverTimes update() {
  return timed("a box", {{"again, AMD", 10.0}, {"follows, AMD", 4.0}, {"again, METIS", 12.0}, {"follows, METIS", 3.0}});
}

/// A ratio that was the same in all rounds.
std::string steady(double ratio) {
  return to_string(Figure{ratio, median_interval(std::vector<double>(rounds, ratio))});
}

const NamedTable& one(const std::vector<NamedTable>& tables, const std::string& name) {
  for (const NamedTable& t : tables)
    if (t.name == name) return t;
  throw std::out_of_range("no table " + name);
}
Table table_of(const SolverResults& results, const std::string& name) { return one(tables_of(results), name).table; }

SolveCell cell(SolvePath path) {
  SolveCell c{"equal", "1 .. 10", "rest", 20.0, path, SolveStatus::ok, 1e-14, 2e-16, 3e-15, false, 31};
  return c;
}

EditRun edit_run() {
  EditRun r;
  r.policy = "as by default";
  r.stretch = 0.25;
  r.edits = 41;
  r.counters.rank_one_updates = 42;
  r.counters.rows_replaced = 43;
  r.counters.factorisations = 44;
  r.largest = 5e-15;
  r.last = 6e-15;
  r.componentwise = 7e-15;
  r.follow_s = 0.125;
  r.solve_s = 0.25;
  return r;
}

Crossover crossover() {
  Crossover c;
  c.vertices = 512;
  c.springs = 2863;
  c.prices.solve = 3e-4;
  c.explicit_step_s = 2e-5;
  c.explicit_method = "verlet";
  c.implicit_method = "ros2";
  c.work.solves = 2.5;
  c.predicted_steps = 61.5;
  c.overhead = 1.25;
  c.predicted_phase = 1100.0;
  c.measured_phase = 1000.0;
  c.measured_factor = 4200.0;
  c.costs = {{.factor = 71.0,
              .phase = 72.0,
              .explicit_s = 73.0,
              .implicit_s = 74.0,
              .explicit_error = 75.0,
              .implicit_steps = 76.0,
              .implicit_method = "ros2"}};
  return c;
}

SolverResults results() {
  SolverResults r;
  for (const SolvePath path : solve_paths) r.cells.push_back(cell(path));
  r.indefinite = {{"simplicial", 10.0, -0.5, SolveStatus::not_positive_definite},
                  {"rows", 20.0, -0.25, SolveStatus::ok},
                  {"simplicial", 30.0, -0.125, SolveStatus::not_finite}};
  r.edits = {edit_run()};
  r.updates = {update()};
  r.crossovers = {crossover()};
  r.crossover_error = 3e-3;
  r.steps = {timed("liver", {{"conjugate gradients", 0.5}, {"fresh factor", 9.0}, {"kept factor", 2.0}})};
  return r;
}

// ---- tables

TEST(SolverTables, BelongToTheStudiesThatWereMade) {
  Row names;
  for (const NamedTable& t : tables_of(results())) {
    names.push_back(t.name);
    EXPECT_FALSE(t.heading.empty()) << t.name;
    EXPECT_FALSE(t.note.empty()) << t.name;
  }
  EXPECT_EQ(names, (Row{"accuracy", "indefinite", "edits", "updates", "crossover", "steps"}));
  EXPECT_TRUE(tables_of({}).empty());
  EXPECT_EQ(one(tables_of(results()), "crossover").heading, "Explicit or implicit, at an error of 0.003 edges");
  EXPECT_NE(one(tables_of(results()), "updates").note.find("Terms: 19 for a box."), std::string::npos);
}

TEST(SolverTables, HaveTheLargestErrorsOfEachPath) {
  SolverResults r = results();
  r.cells.push_back(cell(SolvePath::updated));
  r.cells.back().was_updated = true;
  r.cells.back().before = 4e-14;
  r.cells.back().after = 5e-16;
  r.cells.back().normwise = 6e-15;
  for (const SolveStatus status : {SolveStatus::not_finite, SolveStatus::not_converged, SolveStatus::not_finite}) {
    r.cells.push_back(cell(SolvePath::updated));
    r.cells.back().status = status;
    r.cells.back().before = r.cells.back().after = r.cells.back().normwise = 1.0;  // not requested
  }
  const Table table = table_of(r, "accuracy");
  EXPECT_EQ(alignment(table), "lrrrrrl");
  ASSERT_EQ(table.rows().size(), 4u);
  EXPECT_EQ(table.rows()[0], (Row{"simplicial", "1", "", "1.0e-14", "2.0e-16", "3.0e-15", ""}));
  EXPECT_EQ(table.rows()[1][0], "supernodal");
  EXPECT_EQ(labelled(table, 2), (Row{"path: updated", "solved: 2", "updated: 1", "componentwise, before: 4.0e-14",
                                     "after one refinement: 5.0e-16", "normwise, before: 6.0e-15",
                                     "ended with a diagnosis: 1 not converged, 2 not finite"}));
  EXPECT_EQ(table.rows()[3][0], "conjugate gradients");
}

TEST(SolverTables, CountTheIndefiniteMatricesOfEachPath) {
  const Table table = table_of(results(), "indefinite");
  EXPECT_EQ(alignment(table), "lrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"path: simplicial", "matrices: 2", "diagnosed: 2", "least eigenvalue: -1.2e-01"}));
  EXPECT_EQ(labelled(table, 1), (Row{"path: rows", "matrices: 1", "diagnosed: 0", "least eigenvalue: -2.5e-01"}));
}

TEST(SolverTables, HaveARowForEachPolicyOfEdits) {
  SolverResults r = results();
  r.edits.push_back(edit_run());
  r.edits[1].stretch = 0.0;
  r.edits[1].failure = "not finite";
  const Table table = table_of(r, "edits");
  EXPECT_EQ(alignment(table), "llrrrrrrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"policy: as by default", "body: stretched", "edits: 41", "terms: 42", "rows: 43",
                                     "factorisations: 44", "normwise, largest: 5.0e-15", "componentwise: 7.0e-15",
                                     "ms an edit: 125.000", "ms a solution: 250.000"}));
  EXPECT_EQ(table.rows()[1][1], "at rest");
  EXPECT_EQ(table.rows()[1][6], "not finite");
}

TEST(SolverTables, CompareEachTaskWithFactoringAgainByTheSameOrdering) {
  const Table table = table_of(results(), "updates");
  EXPECT_EQ(alignment(table), "lrlrl");
  ASSERT_EQ(table.rows().size(), 4u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"body: a box", "terms: 19", "task: again, AMD", "ms: 10.00", "again / task, same ordering: "}));
  EXPECT_EQ(table.rows()[1], (Row{"a box", "19", "follows, AMD", "4.00", steady(2.5)}));
  EXPECT_EQ(table.rows()[2], (Row{"a box", "19", "again, METIS", "12.00", ""}));
  EXPECT_EQ(table.rows()[3], (Row{"a box", "19", "follows, METIS", "3.00", steady(4.0)}));
}

TEST(SolverTables, HaveTheLawAndWhatWasMeasuredOfEachBody) {
  SolverResults r = results();
  r.crossovers.push_back(crossover());
  r.crossovers[1].failure = "none was found";
  const Table table = table_of(r, "crossover");
  EXPECT_EQ(alignment(table), "rrlrlrrrrrrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"vertices: 512", "springs: 2863", "explicit: verlet", "us a step: 20.0",
                                     "implicit: ros2", "steps: 61.5", "solutions a step: 2.5", "us a solution: 300",
                                     "overhead: 1.25", "T omega_max, predicted: 1.1e+03", "measured: 1e+03",
                                     "deviation: +10 %", "stiffness factor: 4.2e+03"}));
  EXPECT_EQ(Row(table.rows()[1].begin() + 9, table.rows()[1].end()), (Row{"1.1e+03", "none was found", "", ""}));
}

TEST(SolverTables, CompareEachSolverOfAStepWithConjugateGradients) {
  const Table table = table_of(results(), "steps");
  EXPECT_EQ(alignment(table), "llrl");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 1),
            (Row{"body: liver", "solver: fresh factor", "ms: 9.000", "over conjugate gradients: " + steady(18.0)}));
  EXPECT_EQ(table.rows()[2], (Row{"liver", "kept factor", "2.000", steady(4.0)}));
}

// ---- times

TEST(SolverTimes, AreNotTakenOfASolutionThatIsWrong) {
  BlockMatrix twice;
  twice.pattern.column_start = {0, 0};
  twice.diagonal = {2.0 * Eigen::Matrix3d::Identity()};
  const std::vector<Eigen::Vector3d> x{{1, 1, 1}}, right{{2, 2, 2}}, wrong{{2, 2, 3}};
  EXPECT_NO_THROW(require_agreement("a task", twice, right, x, 1e-3));
  try {
    // the residual 1 over |A| |x| + |b| = 2 + 3, in the largest norm
    require_agreement("a task", twice, wrong, x, 1e-3);
    ADD_FAILURE();
  } catch (const SolverError& error) {
    EXPECT_STREQ(error.what(),
                 "'a task' is not timed: the backward error of its solution is 2.0e-01, the bound is 1.0e-03");
  }
  EXPECT_NO_THROW(require_agreement("a task", twice, wrong, x, 0.25));
  const std::vector<Eigen::Vector3d> none{{nan, 1, 1}};
  EXPECT_THROW(require_agreement("a task", twice, right, none, 1.0), SolverError);
}

// ---- claims

TEST(SolverClaimsInWords, SayWhatIsAskedWhatWasMeasuredAndWhatItRestsOn) {
  SolverResults r = results();
  r.cells[3].status = SolveStatus::not_converged;
  r.cells.push_back(cell(SolvePath::conjugate_gradients));
  r.cells.back().before = 8e-14;
  r.cells.back().after = 9e-16;
  const auto claims = claims_of(r);
  const auto expect = [&](const std::string& id, const std::string& asked, const std::string& measured,
                          const std::string& rests_on, const std::string& text) {
    const Claim& c = find_claim(claims, id);
    EXPECT_EQ(c.paper_value, asked) << id;
    EXPECT_EQ(c.measured, measured) << id;
    EXPECT_EQ(c.bound_or_interval, rests_on) << id;
    EXPECT_NE(c.text.find(text), std::string::npos) << c.text;
  };
  expect("solve-componentwise", "<= 1e-15", "2.0e-16, 1.0e-14 before", "3 systems solved, 0 ended with a diagnosis",
         "componentwise backward error");
  expect("solve-iterative", "<= 1e-15, or a diagnosis", "9.0e-16, 8.0e-14 before",
         "1 systems solved, 1 said not converged", "conjugate gradients");
  expect("indefinite-diagnosed", "0", "1 of 3", "", "indefinite matrices");
  EXPECT_EQ(find_claim(claims, "indefinite-diagnosed").reason, "rows at h omega 20");
  expect("edits-backward-error", "<= 2e-15", "5.0e-15", "", "during 41 edits");
  expect("update-512", ">= 2", "2.50 with AMD, 4.00 with METIS, 3.33 the best of each",
         "AMD " + to_string(median_interval(std::vector<double>(rounds, 2.5))) + ", over the rounds of one process",
         "one interior vertex dissociated, a box");
  expect("break-even-law", "within 25 %", "512: +10 %", "512: no run on one of the sides",
         "at an error of 0.003 edges");
  expect("implicit-step", "<= 0.9 ms", "0.50 ms",
         "[0.5, 0.5] at 98.4 %, over the rounds of one process; fresh factor 9.00 ms, kept 2.00 ms",
         "implicit step of liver");
}

TEST(SolverClaimsInWords, AskMoreOfLargeBodiesAndNameStretchedOnes) {
  SolverResults r;
  for (const std::size_t vertices : {999u, 1000u, 3001u}) {
    r.updates.push_back(update());
    r.updates.back().vertices = vertices;
  }
  r.updates[0].stretched = true;
  const auto claims = claims_of(r);
  EXPECT_EQ(find_claim(claims, "update-999-stretched").paper_value, ">= 2");
  EXPECT_EQ(find_claim(claims, "update-1000").paper_value, "between the others");
  EXPECT_EQ(find_claim(claims, "update-3001").paper_value, ">= 4");
}

// ---- samples

std::vector<Json> samples_of(const SolverResults& r, const std::string& study) {
  std::vector<Json> samples;
  for_each_sample(r, [&](const Json& json) {
    if (json.at("study") == study) samples.push_back(json);
  });
  return samples;
}

TEST(SolverSamples, HoldEveryFigure) {
  SolverResults r = results();
  r.cells = {cell(SolvePath::updated)};
  r.cells[0].was_updated = true;
  r.edits[0].failure = "not finite";
  r.edits[0].last = nan;
  EXPECT_EQ(samples_of(r, "accuracy"), std::vector{Json::parse(R"({"study": "accuracy", "masses": "equal",
    "stiffnesses": "1 .. 10", "state": "rest", "h_omega": 20.0, "path": "updated", "status": "ok", "before": 1e-14,
    "after": 2e-16, "normwise": 3e-15, "updated": true, "iterations": 31})")});
  EXPECT_EQ(samples_of(r, "indefinite").at(1), Json::parse(R"({"study": "indefinite", "path": "rows", "h_omega": 20.0,
    "least": -0.25, "status": "ok"})"));
  EXPECT_EQ(samples_of(r, "edits"), std::vector{Json::parse(R"({"study": "edits", "policy": "as by default",
    "stretch": 0.25, "edits": 41, "rank_one_updates": 42, "rows_replaced": 43, "factorisations": 44, "largest": 5e-15,
    "last": null, "componentwise": 7e-15, "follow_s": 0.125, "solve_s": 0.25, "failure": "not finite"})")});
  EXPECT_EQ(samples_of(r, "crossover"), std::vector{Json::parse(R"({"study": "crossover", "vertices": 512,
    "factor": 71.0, "phase": 72.0, "explicit_s": 73.0, "explicit_error": 75.0, "implicit": "ros2", "implicit_s": 74.0,
    "implicit_steps": 76.0, "predicted_phase": 1100.0})")});
  EXPECT_EQ(samples_of(r, "updates").size(), 4u * rounds);
  EXPECT_EQ(samples_of(r, "updates").at(0).at("body"), "a box");
  EXPECT_EQ(samples_of(r, "steps").size(), 3u * rounds);
  EXPECT_EQ(samples_of(r, "steps").at(1).at("task"), "fresh factor");
}

// ---- the picture

TEST(CrossoverPlot, PlacesTheLawAndTheMeasurementOfEachBodyWithinIt) {
  std::vector<Crossover> all(3, crossover());
  all[1].vertices = 4096;
  all[1].predicted_phase = 80.0;
  all[1].measured_phase = 160.0;
  all[2].vertices = 9;
  all[2].predicted_phase = 1e9;
  all[2].failure = "none was found";  // is not drawn
  const Plot plot = crossover_plot(all);
  EXPECT_EQ(plot.title, "Where implicit becomes cheaper than explicit");
  EXPECT_EQ(plot.x_axis, "vertices");
  EXPECT_EQ(plot.y_axis, "T omega_max at the crossover");
  ASSERT_EQ(plot.series.size(), 2u);
  const PlotSeries &predicted = plot.series[0], &measured = plot.series[1];
  EXPECT_EQ(predicted.title, "predicted by the law");
  EXPECT_EQ(measured.title, "measured");
  ASSERT_EQ(predicted.points.size(), 2u);
  ASSERT_EQ(measured.points.size(), 2u);
  EXPECT_EQ(predicted.points[0].x, 512.0);
  EXPECT_EQ(predicted.points[0].y, 1100.0);
  EXPECT_EQ(predicted.points[0].label, "");
  EXPECT_EQ(measured.points[0].x, 512.0);
  EXPECT_EQ(measured.points[0].y, 1000.0);
  EXPECT_EQ(measured.points[0].label, "+10 %");
  EXPECT_EQ(predicted.points[1].y, 80.0);
  EXPECT_EQ(measured.points[1].x, 4096.0);
  EXPECT_EQ(measured.points[1].y, 160.0);
  EXPECT_EQ(measured.points[1].label, "-50 %");
  // distinguished by colour, symbol and line; of one size
  EXPECT_NE(predicted.colour, measured.colour);
  EXPECT_NE(predicted.symbol, measured.symbol);
  EXPECT_NE(predicted.dash, measured.dash);
  EXPECT_EQ(predicted.size, measured.size);
  EXPECT_GT(predicted.size, 1.0);
  EXPECT_EQ(predicted.width, measured.width);
  EXPECT_GT(predicted.width, 0.0);
  // room for the symbols all around and for the labels to the right, but not more than a factor of two
  EXPECT_LT(plot.x_low, 512.0);
  EXPECT_GE(plot.x_low, 512.0 / 2);
  EXPECT_GT(plot.x_high, 4096.0);
  EXPECT_LE(plot.x_high, 4096.0 * 2);
  EXPECT_LT(plot.y_low, 80.0);
  EXPECT_GE(plot.y_low, 80.0 / 2);
  EXPECT_GT(plot.y_high, 1100.0);
  EXPECT_LE(plot.y_high, 1100.0 * 2);
}

TEST(CrossoverPlot, HasRoomForThePredictionWhichMayBeTheLowestOrTheHighest) {
  std::vector<Crossover> all(2, crossover());
  all[0].predicted_phase = 2000.0;
  all[1].predicted_phase = 500.0;
  const Plot plot = crossover_plot(all);
  EXPECT_GT(plot.y_high, 2000.0);
  EXPECT_LT(plot.y_low, 500.0);
}

}  // namespace
}  // namespace dartboard::solver_tables_test
