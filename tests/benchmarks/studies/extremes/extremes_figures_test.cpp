// The pictures of `extremes`: measurements and theory, each in its own place within the axes.

#include "benchmarks/studies/extremes/extremes_figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dartboard::extremes_figures_test {
namespace {

void expect_point(const PlotSeries::Point& p, double x, double y) {
  EXPECT_DOUBLE_EQ(p.x, x);
  EXPECT_DOUBLE_EQ(p.y, y);
}

// ---- maps

/// Ratios 0, and then four decades.
StabilityMap stability_map() {
  StabilityMap map;
  map.integrator = "rk4";
  map.theta = {1.0, 2.0, 3.0};
  map.zeta = {0.0, 0.01, 0.1, 1.0, 10.0};
  for (int k = 0; k < 15; ++k) map.growth.push_back(0.125 * k);
  map.boundary = {{0.0, 2.0, 2.25}, {0.1, 4.0, 3.5}, {1.0, 5.0, 0.0}};
  map.theory = {{2.5, 0.0}, {2.75, 0.1}};
  return map;
}

TEST(MapsFigure, HasAPanelForEachIntegratorWithTheRatioZeroBelowTheLogarithms) {
  StabilityMap other = stability_map();
  other.integrator = "verlet";
  const Panels figure = maps_figure({stability_map(), other});
  EXPECT_TRUE(figure.title.starts_with("Growth of an oscillation per step"));
  EXPECT_FALSE(figure.field_label.empty());
  EXPECT_EQ(figure.field_low, -figure.field_high);  // white is neither growth nor decay
  EXPECT_GT(figure.field_high, 0.0);
  EXPECT_EQ(figure.columns, 4);
  EXPECT_EQ(figure.width, 2 * figure.height);  // four panels next to each other, two rows of them
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[1].title, "verlet");
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(panel.title, "rk4");
  EXPECT_EQ(panel.x_axis, "h omega");
  EXPECT_EQ(panel.y_axis, "damping ratio");
  EXPECT_EQ(panel.field.x, stability_map().theta);
  EXPECT_EQ(panel.field.values, stability_map().growth);
  ASSERT_EQ(panel.field.y.size(), 5u);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(panel.field.y[static_cast<std::size_t>(k)], k - 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(panel.x_low, 0.5);
  EXPECT_DOUBLE_EQ(panel.x_high, 3.0);
  EXPECT_NEAR(panel.y_low, -3.5, 1e-12);  // half a row below that of the ratio 0
  EXPECT_NEAR(panel.y_high, 1.0, 1e-12);
  const std::vector<std::pair<double, std::string>> ticks{{-3.0, "0"}, {-1.0, "0.1"}, {0.0, "1"}, {1.0, "10"}};
  ASSERT_EQ(panel.y_ticks.size(), ticks.size());
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    EXPECT_NEAR(panel.y_ticks[k].at, ticks[k].first, 1e-12);
    EXPECT_EQ(panel.y_ticks[k].label, ticks[k].second);
  }
}

TEST(MapsFigure, HasTheoryAsALineOfDotsAndRunsAsCircles) {
  const Panels figure = maps_figure({stability_map()});
  ASSERT_EQ(figure.panels.at(0).series.size(), 2u);
  const PlotSeries &theory = figure.panels[0].series[0], &runs = figure.panels[0].series[1];
  ASSERT_EQ(theory.points.size(), 2u);
  expect_point(theory.points[0], 2.5, -3.0);
  expect_point(theory.points[1], 2.75, -1.0);
  ASSERT_EQ(runs.points.size(), 2u);  // a crossing not found by runs has no place
  expect_point(runs.points[0], 2.25, -3.0);
  expect_point(runs.points[1], 3.5, -1.0);
  EXPECT_EQ(theory.symbol, 7);  // filled
  EXPECT_EQ(runs.symbol, 6);    // hollow
  EXPECT_LT(theory.size, 0.5);
  EXPECT_GT(runs.size, 2 * theory.size);
  EXPECT_LT(runs.size, 2.0);
}

// ---- amplification

AmplificationPoint point(const std::string& integrator, bool implicit, double theta, double measured, double theory) {
  AmplificationPoint p;
  p.integrator = integrator;
  p.implicit = implicit;
  p.theta = theta;
  p.measured = std::polar(measured, 1.25 * theta);
  p.theory = std::polar(theory, 0.5 * theta);
  return p;
}

TEST(AmplificationFigure, HasImplicitMethodsAboveAndExplicitOnesBelow) {
  const Panels figure = amplification_figure({});
  EXPECT_TRUE(figure.title.starts_with("One step of an undamped oscillation"));
  EXPECT_EQ(figure.columns, 3);
  // panels that are wider than high, by a quarter at most
  const double wide = figure.width / 3.0, high = figure.height / 2.0;
  EXPECT_GT(wide, high);
  EXPECT_LT(wide, 1.25 * high);
  ASSERT_EQ(figure.panels.size(), 6u);
  const char* titles[]{"implicit: amplitude", "implicit: phase error", "implicit: numerical damping",
                       "explicit: amplitude", "explicit: phase error", "explicit: numerical damping"};
  const char* y_axes[]{"amplitude after a step", "|phase / (h omega) - 1|", "equivalent damping ratio"};
  for (std::size_t k = 0; k < 6; ++k) {
    const Panel& panel = figure.panels[k];
    EXPECT_EQ(panel.title, titles[k]);
    EXPECT_EQ(panel.x_axis, "h omega");
    EXPECT_EQ(panel.y_axis, y_axes[k % 3]);
    EXPECT_TRUE(panel.x_log);
    EXPECT_EQ(panel.x_low, 1e-2);
    EXPECT_EQ(panel.x_high, k < 3 ? 1e3 : 4.0);  // explicit methods are stable no further
    EXPECT_EQ(panel.y_log, k % 3 != 0);
    EXPECT_EQ(panel.key, k % 3 == 1 ? "bottom right" : "");
    EXPECT_LT(panel.y_low, panel.y_high);
    EXPECT_TRUE(k % 3 == 0 || panel.y_low > 0.0);
    if (k % 3 == 0) {
      EXPECT_GT(panel.y_high, 1.0);  // 1, neither growth nor decay, is within
      EXPECT_LT(panel.y_high, 1.1);
    }
  }
}

TEST(AmplificationFigure, HasTheoryAsALineAndEverySecondMeasurementAsADot) {
  const std::vector<AmplificationPoint> points{point("bdf2", true, 0.1, 0.5, 0.75), point("bdf2", true, 0.2, 0.6, 0.8),
                                               point("bdf2", true, 0.4, 0.7, 0.9), point("rk4", false, 0.5, 0.9, 0.95),
                                               point("verlet-compensated", false, 0.5, 0.9, 0.95)};
  const Panels figure = amplification_figure(points);
  for (std::size_t k = 0; k < 6; ++k) {
    const std::vector<PlotSeries>& series = figure.panels[k].series;
    ASSERT_EQ(series.size(), 2u) << k;  // methods that share a curve are drawn once
    const PlotSeries &line = series[0], &dots = series[1];
    EXPECT_EQ(line.points.size(), k < 3 ? 3u : 1u);
    EXPECT_EQ(dots.points.size(), k < 3 ? 2u : 1u);
    EXPECT_EQ(line.symbol, 0);
    EXPECT_GT(line.width, 0.0);
    EXPECT_GT(dots.symbol, 0);
    EXPECT_EQ(dots.width, 0.0);
    EXPECT_EQ(line.colour, dots.colour);
    EXPECT_EQ(line.title, "");
    EXPECT_EQ(dots.title, k == 1 ? "bdf2" : k == 4 ? "rk4" : "");
  }
  const auto first = [&](std::size_t panel, std::size_t series) {
    return figure.panels[panel].series[series].points[0];
  };
  expect_point(first(0, 0), 0.1, 0.75);
  expect_point(first(0, 1), 0.1, 0.5);
  const auto near = [](const PlotSeries::Point& p, double y) {
    EXPECT_EQ(p.x, 0.1);
    EXPECT_NEAR(p.y, y, 1e-12);
  };
  near(first(1, 0), 0.5);
  near(first(1, 1), 0.25);
  near(first(2, 0), -std::log(0.75) / 0.05);
  near(first(2, 1), -std::log(0.5) / 0.125);
  EXPECT_EQ(figure.panels[0].series[1].points[1].x, 0.4);
}

TEST(AmplificationFigure, LeavesOutWhatALogarithmicAxisCannotShow) {
  AmplificationPoint kept = point("rk4", false, 0.5, 1.0, 1.0);  // no damping at all
  const Panels figure = amplification_figure({kept});
  EXPECT_EQ(figure.panels[3].series.size(), 2u);
  EXPECT_TRUE(figure.panels[5].series.empty());
}

// ---- rounding

TEST(RoundingFigure, PlacesTheErrorsOfEachMethodWithinItAndALineOfSlopeOneHalf) {
  const std::vector<RoundingGrowth> all{{"verlet", 0.05, 32, {{100, 2e-15}, {10000, 3e-14}}, 0.5},
                                        {"blanes-moan-4", 0.05, 32, {{1000, 1e-16}, {1000000, 5e-13}}, 0.625}};
  const Plot plot = rounding_figure(all);
  EXPECT_EQ(plot.title, "Energy error by rounding alone");
  EXPECT_EQ(plot.subtitle, "oscillator, h omega = 0.05");
  EXPECT_EQ(plot.x_axis, "steps");
  EXPECT_EQ(plot.y_axis, "relative energy error, root mean square over starts");
  EXPECT_GT(plot.width, plot.height);
  EXPECT_LT(plot.width, 2 * plot.height);
  ASSERT_EQ(plot.series.size(), 3u);
  EXPECT_EQ(plot.series[0].title, "verlet: exponent 0.50");
  EXPECT_EQ(plot.series[1].title, "blanes-moan-4: exponent 0.62");
  ASSERT_EQ(plot.series[1].points.size(), 2u);
  expect_point(plot.series[0].points[1], 10000, 3e-14);
  expect_point(plot.series[1].points[0], 1000, 1e-16);
  EXPECT_NE(plot.series[0].colour, plot.series[1].colour);
  EXPECT_NE(plot.series[0].symbol, plot.series[1].symbol);
  EXPECT_GT(plot.series[0].width, 0.0);
  // all of them within the axes, with some room
  EXPECT_LT(plot.x_low, 100.0);
  EXPECT_GE(plot.x_low, 50.0);
  EXPECT_GT(plot.x_high, 1e6);
  EXPECT_LE(plot.x_high, 2e6);
  EXPECT_LT(plot.y_low, 1e-16);
  EXPECT_GE(plot.y_low, 1e-17);
  EXPECT_GT(plot.y_high, 5e-13);
  EXPECT_LE(plot.y_high, 5e-12);
  const PlotSeries& guide = plot.series[2];
  EXPECT_EQ(guide.title, "square root of the steps");
  EXPECT_EQ(guide.symbol, 0);
  EXPECT_FALSE(guide.dash.empty());
  ASSERT_EQ(guide.points.size(), 2u);
  EXPECT_EQ(guide.points[0].x, plot.x_low);
  EXPECT_EQ(guide.points[1].x, plot.x_high);
  for (const auto& p : guide.points) EXPECT_NEAR(p.y, 2 * 2e-15 * std::sqrt(p.x / 100), 1e-12 * p.y);
}

TEST(RoundingFigure, IsEmptyWhereNothingWasMeasured) {
  EXPECT_TRUE(rounding_figure({}).series.empty());
  EXPECT_TRUE(rounding_figure({{"verlet", 0.05, 32, {}, 0.5}}).series.empty());
}

}  // namespace
}  // namespace dartboard::extremes_figures_test
