// Runs of a study in its diagram: those that failed, those of several solvers, and the front.

#include <gtest/gtest.h>

#include <algorithm>

#include "benchmarks/figures/gnuplot.h"
#include "benchmarks/studies/tradeoff/work_precision_plot.h"

namespace dartboard::work_precision_runs_test {
namespace {

WorkPoint run_of(const std::string& contender, std::uint64_t steps, double error, double cost) {
  WorkPoint p;
  p.contender = contender;
  p.setting.steps = steps;
  p.errors.x = error;
  p.costs = {cost};
  p.cost = cost;
  return p;
}

TEST(WorkPrecisionPlot, AFailedRunStandsAtTheBorderWhereItWouldHaveEndedWithItsDiagnosis) {
  WorkPrecision study;
  study.scene = "scene";
  study.reference.floor = 1e-9;
  WorkPoint failed = run_of("verlet", 10, 0.0, 3.0);
  failed.code = "NONFINITE";
  study.points = {failed, run_of("verlet", 20, 1e-3, 40.0)};
  classify(study.points, study.reference.floor);
  const Plot plot = work_precision_plot(study);
  bool found = false;
  for (const PlotSeries& s : plot.series)
    for (const auto& p : s.points)
      if (p.label == "NONFINITE") {
        found = true;
        EXPECT_DOUBLE_EQ(p.x, 20.0);  // half the steps of the run that cost 40
        EXPECT_GT(p.y, 1.0);
        EXPECT_LT(p.y, plot.y_high);
      }
  EXPECT_TRUE(found);
}

TEST(WorkPrecisionPlot, LinearSolversOfOneIntegratorAreToldApart) {
  WorkPrecision study;
  study.points = {run_of("ros2", 20, 1e-3, 10.0), run_of("ros2-fresh-factor", 20, 1e-3, 20.0),
                  run_of("ros2-conjugate-gradients", 20, 1e-3, 30.0)};
  classify(study.points, 0.0);
  std::vector<std::pair<int, std::string>> looks;
  for (const PlotSeries& s : work_precision_plot(study).series)
    if (s.title.starts_with("ros2")) looks.emplace_back(s.symbol, s.dash);
  ASSERT_EQ(looks.size(), 3u);
  std::sort(looks.begin(), looks.end());
  EXPECT_EQ(std::unique(looks.begin(), looks.end()), looks.end());
}

TEST(WorkPrecisionPlot, TheFrontIsDrawnFromTheCheapestToTheDearest) {
  WorkPrecision study;
  study.points = {run_of("rk4", 20, 1e-6, 100.0), run_of("verlet", 20, 1e-2, 10.0), run_of("verlet", 80, 1e-3, 400.0)};
  classify(study.points, 0.0);
  const Plot plot = work_precision_plot(study);
  const auto front = std::find_if(plot.series.begin(), plot.series.end(),
                                  [](const PlotSeries& s) { return s.title == "Pareto front"; });
  ASSERT_NE(front, plot.series.end());
  ASSERT_EQ(front->points.size(), 2u);
  EXPECT_EQ(front->points[0].x, 10.0);
  EXPECT_EQ(front->points[1].x, 100.0);
  // errors between two runs were not reached
  EXPECT_NE(plot_element(*front, "front").find("with steps"), std::string::npos);
}

}  // namespace
}  // namespace dartboard::work_precision_runs_test
