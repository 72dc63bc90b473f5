#include "benchmarks/studies/extremes/extremes_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace dartboard {
namespace {

// Methods with one stability function share a curve.
struct Curve {
  const char* title;
  std::string_view drawn;
  const char* colour;
  int symbol;
};
constexpr std::array curves{
    Curve{"backward-euler, baraff-witkin, local-global", "backward-euler", "#7f7f7f", 5},
    Curve{"ros2, sdirk2", "ros2", "#9467bd", 9},
    Curve{"implicit-midpoint, energy-momentum", "implicit-midpoint", "#ff7f0e", 7},
    Curve{"bdf2", "bdf2", "#5a5aa8", 11},
    Curve{"symplectic-euler, verlet", "verlet", "#1f77b4", 7},
    Curve{"blanes-moan-4", "blanes-moan-4", "#d62728", 5},
    Curve{"rk4", "rk4", "#2ca02c", 9},
    Curve{"dormand-prince-54", "dormand-prince-54", "#17becf", 13},
};

template <class Value, class Theory>
void add_curves(const std::vector<AmplificationPoint>& points, bool implicit, bool titles, Panel& panel,
                const Value& value, const Theory& theory) {
  const auto inside = [&panel](double y) { return std::isfinite(y) && (!panel.y_log || y >= panel.y_low); };
  for (const Curve& curve : curves) {
    PlotSeries line{.title = "", .points = {}, .colour = curve.colour, .symbol = 0, .size = 1.0, .width = 1.6};
    PlotSeries dots{
        .title = titles ? curve.title : "", .points = {}, .colour = curve.colour, .symbol = curve.symbol, .size = 0.8};
    std::size_t number = 0;
    for (const AmplificationPoint& p : points) {
      if (p.integrator != curve.drawn || p.implicit != implicit) continue;
      if (inside(theory(p))) line.points.push_back({p.theta, theory(p)});
      if (number++ % 2 == 0 && inside(value(p))) dots.points.push_back({p.theta, value(p)});
    }
    if (line.points.empty() && dots.points.empty()) continue;
    panel.series.push_back(std::move(line));
    panel.series.push_back(std::move(dots));
  }
}

}  // namespace

Panels maps_figure(const std::vector<StabilityMap>& maps) {
  Panels figure;
  figure.title = "Growth of an oscillation per step, measured; line: stability limit in theory; circles: by runs";
  figure.columns = 4;
  figure.field_low = -0.4;
  figure.field_high = 0.4;
  figure.field_label = "ln of the growth per step (blue decays, red grows)";
  figure.width = 2200;
  figure.height = 1100;
  for (const StabilityMap& map : maps) {
    Panel panel;
    panel.title = fmt::format("{}", map.integrator);
    panel.x_axis = "h omega";
    panel.y_axis = "damping ratio";
    // equal distances between the logarithms, and ratio 0 where the next row below would be
    const double low = std::log10(map.zeta[1]), row = std::log10(map.zeta[2]) - low;
    const auto at = [low, row](double zeta) { return zeta == 0.0 ? low - row : std::log10(zeta); };
    panel.x_low = map.theta.front() / 2;
    panel.x_high = map.theta.back();
    panel.y_low = low - 1.5 * row;
    panel.y_high = std::log10(map.zeta.back());
    panel.y_ticks.push_back({low - row, "0"});
    for (double tick = std::ceil(low + 0.5); tick <= panel.y_high + 1e-9; tick += 1.0)
      panel.y_ticks.push_back({tick, fmt::format("{:g}", std::pow(10.0, tick))});
    panel.field.x = map.theta;
    for (const double zeta : map.zeta) panel.field.y.push_back(at(zeta));
    panel.field.values = map.growth;
    PlotSeries theory{.title = "", .points = {}, .colour = "#000000", .symbol = 7, .size = 0.18};
    for (const auto& p : map.theory) theory.points.push_back({p.theta, at(p.zeta)});
    PlotSeries runs{.title = "", .points = {}, .colour = "#000000", .symbol = 6, .size = 1.1};
    for (const auto& c : map.boundary)
      if (c.measured > 0.0) runs.points.push_back({c.measured, at(c.zeta)});
    panel.series = {std::move(theory), std::move(runs)};
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Panels amplification_figure(const std::vector<AmplificationPoint>& points) {
  Panels figure;
  figure.title = "One step of an undamped oscillation: lines are closed forms, points are measured";
  figure.columns = 3;
  figure.width = 2000;
  figure.height = 1100;
  for (const bool implicit : {true, false}) {
    Panel amplitude{.title = implicit ? "implicit: amplitude" : "explicit: amplitude", .x_axis = "h omega"};
    Panel phase{.title = implicit ? "implicit: phase error" : "explicit: phase error", .x_axis = "h omega"};
    Panel damping{.title = implicit ? "implicit: numerical damping" : "explicit: numerical damping",
                  .x_axis = "h omega"};
    amplitude.y_axis = "amplitude after a step";
    phase.y_axis = "|phase / (h omega) - 1|";
    damping.y_axis = "equivalent damping ratio";
    for (Panel* panel : {&amplitude, &phase, &damping}) {
      panel->x_log = true;
      panel->x_low = 1e-2;
      panel->x_high = implicit ? 1e3 : 4.0;
    }
    amplitude.y_low = implicit ? 0.0 : 0.8;
    amplitude.y_high = implicit ? 1.05 : 1.02;
    phase.y_log = damping.y_log = true;
    phase.y_low = implicit ? 1e-6 : 1e-12;
    phase.y_high = 2.0;
    damping.y_low = implicit ? 1e-8 : 1e-12;
    damping.y_high = 10.0;
    const auto amplitude_of = [](const AmplificationPoint& p) { return p.amplitude(); };
    const auto amplitude_in_theory = [](const AmplificationPoint& p) { return std::abs(p.theory); };
    add_curves(points, implicit, false, amplitude, amplitude_of, amplitude_in_theory);
    phase.key = "bottom right";
    add_curves(
        points, implicit, true, phase, [](const AmplificationPoint& p) { return std::abs(p.phase() / p.theta - 1); },
        [](const AmplificationPoint& p) { return std::abs(p.theoretical_phase() / p.theta - 1); });
    add_curves(
        points, implicit, false, damping, [](const AmplificationPoint& p) { return p.damping_ratio(); },
        [](const AmplificationPoint& p) { return p.theoretical_damping_ratio(); });
    figure.panels.push_back(std::move(amplitude));
    figure.panels.push_back(std::move(phase));
    figure.panels.push_back(std::move(damping));
  }
  return figure;
}

Plot rounding_figure(const std::vector<RoundingGrowth>& all) {
  constexpr std::array<std::pair<const char*, int>, 4> looks{
      {{"#1f77b4", 7}, {"#6baed6", 6}, {"#d62728", 5}, {"#fb6a4a", 4}}};
  Plot plot;
  plot.title = "Energy error by rounding alone";
  plot.subtitle = "oscillator, h omega = 0.05";
  plot.x_axis = "steps";
  plot.y_axis = "relative energy error, root mean square over starts";
  plot.width = 1300;
  plot.height = 800;
  plot.x_low = 1e300;
  plot.x_high = plot.y_high = 0.0;
  plot.y_low = 1e300;
  for (std::size_t k = 0; k < all.size(); ++k) {
    PlotSeries series{.title = fmt::format("{}: exponent {:.2f}", all[k].integrator, all[k].exponent),
                      .points = {},
                      .colour = looks[k % looks.size()].first};
    series.symbol = looks[k % looks.size()].second;
    series.width = 1.5;
    for (const auto& p : all[k].points) {
      series.points.push_back({static_cast<double>(p.steps), p.error});
      plot.x_low = std::min(plot.x_low, static_cast<double>(p.steps) / 1.5);
      plot.x_high = std::max(plot.x_high, static_cast<double>(p.steps) * 1.5);
      plot.y_low = std::min(plot.y_low, p.error / 3);
      plot.y_high = std::max(plot.y_high, p.error * 3);
    }
    plot.series.push_back(std::move(series));
  }
  if (all.empty() || all.front().points.empty()) return {};
  PlotSeries guide{.title = "square root of the steps",
                   .points = {},
                   .colour = "#707070",
                   .symbol = 0,
                   .size = 1.0,
                   .width = 1.0,
                   .dash = "-"};
  const auto& first = all.front().points.front();
  for (const double steps : {plot.x_low, plot.x_high})
    guide.points.push_back({steps, 2 * first.error * std::sqrt(steps / static_cast<double>(first.steps))});
  plot.series.push_back(std::move(guide));
  return plot;
}

}  // namespace dartboard
