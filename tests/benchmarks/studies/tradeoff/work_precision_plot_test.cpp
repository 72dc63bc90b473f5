// The place of each run in a work-precision diagram, and the marks of the methods.

#include "benchmarks/studies/tradeoff/work_precision_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/time/integrators.h"

namespace dartboard::work_precision_plot_test {
namespace {

WorkPoint run_of(const std::string& contender, std::uint64_t steps, double error, double cost, Standing standing) {
  WorkPoint p;
  p.contender = contender;
  p.setting.steps = steps;
  p.errors.x = error;
  p.errors.v = 0.5;
  p.cost = cost;
  p.standing = standing;
  if (standing == Standing::failed) p.code = "UNSTABLE_DT";
  return p;
}

WorkPrecision study() {
  WorkPrecision s;
  s.scene = "chain";
  s.what = "four links";
  s.springs = 41;
  s.vertices = 51;
  s.reference.floor = 1e-7;
  s.reference.kind = ReferenceKind::certified;
  s.points = {run_of("verlet", 10, 0.0, 3.0, Standing::failed),
              run_of("verlet", 20, 2.0, 30.0, Standing::useless),
              run_of("verlet", 40, 1e-2, 40.0, Standing::front),
              run_of("verlet", 80, 1e-3, 400.0, Standing::dominated),
              run_of("rk4", 20, 1e-4, 100.0, Standing::front),
              run_of("rk4", 40, 3e-8, 200.0, Standing::front),
              run_of("ros2-fresh-factor", 5, 0.5, 90.0, Standing::undecided)};
  s.points[5].under_floor = true;
  return s;
}

const PlotSeries& titled(const Plot& plot, const std::string& title) {
  for (const PlotSeries& s : plot.series)
    if (s.title == title) return s;
  throw std::out_of_range("no series " + title);
}
/// The series without a title that have a point there.
std::vector<const PlotSeries*> at(const Plot& plot, double x, double y) {
  std::vector<const PlotSeries*> found;
  for (const PlotSeries& s : plot.series)
    for (const auto& p : s.points)
      if (s.title.empty() && std::abs(p.x / x - 1) < 1e-9 && std::abs(p.y / y - 1) < 1e-9) found.push_back(&s);
  return found;
}

TEST(WorkPrecisionDiagram, SaysWhatItIsOf) {
  const Plot plot = work_precision_plot(study());
  EXPECT_EQ(plot.title, "Work and precision: chain");
  EXPECT_EQ(plot.subtitle, "four links");
  EXPECT_EQ(plot.x_axis, "cost: CPU time in units of one force evaluation (51 vertices, 41 springs)");
  EXPECT_TRUE(plot.y_axis.starts_with("error of positions [mean edge lengths]")) << plot.y_axis;
  EXPECT_EQ(plot.shaded_below, 1e-7);
  EXPECT_EQ(plot.shaded_label, "below 1e-07 edges: not resolved by the reference (certified)");
  EXPECT_EQ(plot.y_last_tick, 1.0);
}

TEST(WorkPrecisionDiagram, HasEveryUsefulRunOfAMethodOnItsLine) {
  const Plot plot = work_precision_plot(study());
  const PlotSeries &verlet = titled(plot, "verlet"), &rk4 = titled(plot, "rk4"),
                   &fresh = titled(plot, "ros2-fresh-factor");
  ASSERT_EQ(verlet.points.size(), 2u);  // neither failed runs nor useless ones
  EXPECT_EQ(verlet.points[0].x, 40.0);
  EXPECT_EQ(verlet.points[0].y, 1e-2);
  EXPECT_EQ(verlet.points[1].x, 400.0);
  EXPECT_EQ(verlet.points[1].y, 1e-3);
  ASSERT_EQ(rk4.points.size(), 2u);
  EXPECT_EQ(fresh.points.size(), 1u);
  for (const PlotSeries* s : {&verlet, &rk4, &fresh}) {
    EXPECT_GT(s->width, 0.0);
    EXPECT_LT(s->opacity, 1.0);  // faded next to the front
    EXPECT_LT(s->size, 1.0);
  }
  EXPECT_TRUE(verlet.dash.empty());
  EXPECT_FALSE(fresh.dash.empty());
  EXPECT_NE(verlet.colour, rk4.colour);
  EXPECT_NE(verlet.symbol, rk4.symbol);
}

TEST(WorkPrecisionDiagram, HasTheFrontInBoldAndHollowWhereTheReferenceCannotTell) {
  const Plot plot = work_precision_plot(study());
  const PlotSeries& front = titled(plot, "Pareto front");
  ASSERT_EQ(front.points.size(), 2u);
  EXPECT_EQ(front.points[0].x, 40.0);
  EXPECT_EQ(front.points[1].x, 100.0);
  EXPECT_EQ(front.points[1].y, 1e-4);
  EXPECT_TRUE(front.staircase);
  EXPECT_EQ(front.symbol, 0);
  EXPECT_GT(front.width, 2.0 * titled(plot, "rk4").width);
  EXPECT_LT(front.opacity, 1.0);
  const auto bold = at(plot, 100.0, 1e-4), hollow = at(plot, 200.0, 3e-8);
  ASSERT_EQ(bold.size(), 1u);
  ASSERT_EQ(hollow.size(), 1u);
  EXPECT_EQ(bold[0]->colour, titled(plot, "rk4").colour);
  EXPECT_EQ(bold[0]->symbol, titled(plot, "rk4").symbol);
  EXPECT_EQ(hollow[0]->symbol, bold[0]->symbol - 1);  // gnuplot's hollow symbol is before the filled one
  EXPECT_GT(bold[0]->size, titled(plot, "rk4").size);
  EXPECT_LT(bold[0]->size, 3.0);
  EXPECT_TRUE(at(plot, 400.0, 1e-3).empty());
}

TEST(WorkPrecisionDiagram, HasWhatFailedAtTheBorderWithOneLabelForEachMethod) {
  const Plot plot = work_precision_plot(study());
  std::vector<PlotSeries::Point> border;
  for (const PlotSeries& s : plot.series)
    for (const auto& p : s.points)
      if (s.title.empty() && p.y > 1.0) {
        EXPECT_EQ(s.symbol, 2);
        EXPECT_EQ(s.colour, titled(plot, "verlet").colour);
        border.push_back(p);
      }
  ASSERT_EQ(border.size(), 2u);
  EXPECT_EQ(border[0].label, "");
  EXPECT_EQ(border[1].label, "no better than rest");
  EXPECT_EQ(border[0].x, 15.0);  // half the steps of the run that cost 30
  EXPECT_EQ(border[1].x, 30.0);
  EXPECT_EQ(border[0].y, border[1].y);
  EXPECT_LT(border[0].y, plot.y_high);
  const PlotSeries& legend = titled(plot, "failed, or no better than a body at rest");
  EXPECT_EQ(legend.symbol, 2);
  ASSERT_EQ(legend.points.size(), 1u);
  EXPECT_LT(legend.points[0].y, plot.y_low);  // represents the others, and is not drawn itself
}

TEST(WorkPrecisionDiagram, HasARowAtTheBorderForEachMethodThatFailed) {
  WorkPrecision s = study();
  s.points.push_back(run_of("bdf2", 10, 0.0, 50.0, Standing::failed));
  const Plot plot = work_precision_plot(s);
  std::set<double> rows;
  for (const PlotSeries& series : plot.series)
    for (const auto& p : series.points)
      if (series.title.empty() && p.y > 1.0) rows.insert(p.y);
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_LT(*rows.rbegin(), plot.y_high);
}

TEST(WorkPrecisionDiagram, HasRoomForEveryRun) {
  const Plot plot = work_precision_plot(study());
  // useful ones cost from 40 to 400 and are off by 3e-8 to 1/2
  EXPECT_LE(plot.x_low, 40.0 / 2);
  EXPECT_GE(plot.x_low, 40.0 / 20);
  EXPECT_GT(plot.x_high, 400.0);
  EXPECT_LE(plot.x_high, 4000.0);
  EXPECT_LT(plot.y_low, 3e-8);
  EXPECT_GT(plot.y_low, 3e-10);
  EXPECT_GT(plot.y_high, 1.0);
  EXPECT_LT(plot.y_high, 100.0);
  for (const PlotSeries& s : plot.series)
    for (const auto& p : s.points) {
      if (s.title.starts_with("failed")) continue;
      EXPECT_GE(p.x, plot.x_low);
      EXPECT_LE(p.x, plot.x_high);
      EXPECT_GE(p.y, plot.y_low);
      EXPECT_LE(p.y, plot.y_high);
    }
}

TEST(WorkPrecisionDiagram, GivesEveryIntegratorALookOfItsOwn) {
  WorkPrecision s = study();
  s.points.clear();
  for (const IntegratorEntry& entry : integrators())
    if (!entry.name.ends_with("compensated"))
      s.points.push_back(run_of(std::string(entry.name), 10, 1e-3, 10.0, Standing::dominated));
  s.points.push_back(run_of("cvode-adams", 10, 1e-3, 10.0, Standing::dominated));
  const Plot plot = work_precision_plot(s);
  std::set<std::pair<std::string, int>> looks;
  for (const WorkPoint& p : s.points)
    EXPECT_TRUE(looks.insert({titled(plot, p.contender).colour, titled(plot, p.contender).symbol}).second)
        << p.contender;
}

TEST(WorkPrecisionDiagram, TellsTheSolversOfOneIntegratorApartByLineAndSymbol) {
  WorkPrecision s = study();
  s.points.clear();
  for (const char* name : {"ros2", "ros2-fresh-factor", "ros2-conjugate-gradients", "ros2-adaptive"})
    s.points.push_back(run_of(name, 10, 1e-3, 10.0, Standing::dominated));
  const Plot plot = work_precision_plot(s);
  std::set<std::pair<int, std::string>> looks;
  for (const WorkPoint& p : s.points) {
    const PlotSeries& line = titled(plot, p.contender);
    EXPECT_EQ(line.colour, titled(plot, "ros2").colour);
    looks.insert({line.symbol, line.dash});
  }
  EXPECT_EQ(looks.size(), 4u);
  EXPECT_EQ(titled(plot, "ros2-fresh-factor").symbol, 1);
  EXPECT_EQ(titled(plot, "ros2-fresh-factor").dash, "-");
  EXPECT_EQ(titled(plot, "ros2-conjugate-gradients").symbol, 3);
  EXPECT_EQ(titled(plot, "ros2-conjugate-gradients").dash, ".");
  EXPECT_EQ(titled(plot, "ros2-adaptive").symbol, titled(plot, "ros2").symbol - 1);
  EXPECT_EQ(titled(plot, "ros2-adaptive").dash, "-");
}

TEST(WorkPrecisionDiagram, OfFailuresAloneHasAxesAllTheSame) {
  WorkPrecision s = study();
  s.points.resize(1);
  const Plot plot = work_precision_plot(s);
  EXPECT_GE(plot.x_low, 1.0);
  EXPECT_LT(plot.x_low, plot.x_high);
  EXPECT_GT(plot.y_low, 0.0);
  EXPECT_LT(plot.y_low, plot.y_high);
}

}  // namespace
}  // namespace dartboard::work_precision_plot_test
