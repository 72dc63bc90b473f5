#include "benchmarks/studies/tradeoff/work_precision_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dartboard {
namespace {

struct Look {
  std::string colour;
  int symbol = 7;   // filled; the hollow one is the number before it
  int variant = 0;  // symbol of the same integrator with another solver; 0: it is no variant
  std::string dash{};
};

// Reds and browns for the baselines, blues and greens for explicit methods, the rest for implicit ones.
Look look_of(const std::string& contender, std::size_t number) {
  static const std::map<std::string, Look> known{
      {"explicit-euler", {"#b8860b", 9}},
      {"symplectic-euler", {"#8c564b", 11}},
      {"verlet", {"#1f77b4", 7}},
      {"blanes-moan-4", {"#d62728", 5}},
      {"rk4", {"#2ca02c", 9}},
      {"dormand-prince-54", {"#17becf", 13}},
      {"backward-euler", {"#7f7f7f", 5}},
      {"baraff-witkin", {"#c49c94", 7}},
      {"local-global", {"#bcbd22", 11}},
      {"ros2", {"#9467bd", 9}},
      {"sdirk2", {"#e377c2", 13}},
      {"implicit-midpoint", {"#ff7f0e", 7}},
      {"energy-momentum", {"#ffb347", 5}},
      {"bdf2", {"#5a5aa8", 11}},
      {"cvode-adams", {"#000000", 13}},
  };
  static const std::array<std::string, 4> others{"#3b6e22", "#a03070", "#306090", "#906030"};
  std::string base = contender;
  for (const char* variant : {"-fresh-factor", "-conjugate-gradients", "-adaptive"})
    if (base.ends_with(variant)) base.resize(base.rfind(variant));
  const auto found = known.find(base);
  Look look = found != known.end() ? found->second : Look{others[number % others.size()], 7};
  // the linear solver shows in symbol and line: a cross and dashes, a star and dots
  if (contender.ends_with("-fresh-factor")) {
    look.variant = 1;
    look.dash = "-";
  } else if (contender.ends_with("-conjugate-gradients")) {
    look.variant = 3;
    look.dash = ".";
  } else if (base != contender) {
    look.variant = look.symbol - 1;
    look.dash = "-";
  }
  return look;
}

double decade_below(double x) { return std::pow(10.0, std::floor(std::log10(x))); }

// The cost at which a failed run is drawn.
double cost_of_failed(const std::vector<const WorkPoint*>& points, std::size_t k) {
  for (std::size_t next = k + 1; next < points.size(); ++next)
    if (!points[next]->failed() && points[k]->setting.steps > 0)
      return points[next]->cost * static_cast<double>(points[k]->setting.steps) /
             static_cast<double>(points[next]->setting.steps);
  return points[k]->cost;
}

}  // namespace

Plot work_precision_plot(const WorkPrecision& study) {
  Plot plot;
  plot.title = fmt::format("Work and precision: {}", study.scene);
  plot.subtitle = study.what;
  plot.x_axis = fmt::format("cost: CPU time in units of one force evaluation ({})",
                            sizes_in_words(study.vertices, study.springs, study.pieces));
  plot.y_axis = "error of positions [mean edge lengths]: largest over time, root mean square over mass";

  std::vector<std::string> names;
  std::map<std::string, std::vector<const WorkPoint*>> by_name;
  double cheapest = 1e300, dearest = 1.0, least = 1.0;
  for (const WorkPoint& p : study.points) {
    if (!by_name.contains(p.contender)) names.push_back(p.contender);
    by_name[p.contender].push_back(&p);
    if (p.failed() || p.standing == Standing::useless) continue;
    cheapest = std::min(cheapest, p.cost);
    dearest = std::max(dearest, p.cost);
    if (p.errors.x > 0.0) least = std::min(least, p.errors.x);
  }
  if (cheapest > dearest) cheapest = 1.0, dearest = 10.0;
  plot.x_low = std::max(1.0, cheapest / 4.0);
  plot.x_high = dearest * 2.0;
  plot.y_low = decade_below(std::max(least, study.reference.floor / 1e3)) / 1.01;
  // failed runs are drawn above the last error that is useful, a row for each method
  constexpr double top = 1.0, border = 2.5;
  std::size_t rows = 0;
  for (const std::string& contender : names)
    rows += std::ranges::any_of(by_name[contender],
                                [](const WorkPoint* p) { return p->failed() || p->standing == Standing::useless; });
  const double row_height = std::log10(top / plot.y_low) * 0.032;  // decades
  plot.y_high = border * std::pow(10.0, row_height * static_cast<double>(std::max<std::size_t>(rows, 1)));
  plot.y_last_tick = top;
  plot.shaded_below = study.reference.floor;
  plot.shaded_label = fmt::format("below {:.0e} edges: not resolved by the reference ({})", study.reference.floor,
                                  name(study.reference.kind));

  // faded: everything, line by line; a method without a point on the front is no darker
  std::size_t number = 0;
  std::map<std::string, std::size_t> legend;
  for (const std::string& contender : names) {
    const Look look = look_of(contender, number++);
    PlotSeries line{.title = contender, .points = {}, .colour = look.colour, .symbol = look.symbol};
    line.size = 0.8;
    line.width = 1.4;
    line.opacity = 0.55;
    line.dash = look.dash;
    for (const WorkPoint* p : by_name[contender]) {
      if (p->failed() || p->standing == Standing::useless) continue;
      const double y = std::clamp(p->errors.x, plot.y_low * 1.2, top);
      line.points.push_back({p->cost, y});
    }
    if (look.variant != 0) {
      line.symbol = look.variant;
      line.size = 0.7;
    }
    plot.series.push_back(line);
  }
  // bold: the front
  PlotSeries front{.title = "Pareto front", .points = {}, .colour = "#202020", .symbol = 0};
  front.width = 4.0;
  front.opacity = 0.35;
  front.staircase = true;  // between two runs the error is that of the cheaper one
  for (const WorkPoint& p : study.points)
    if (p.standing == Standing::front && !p.under_floor) front.points.push_back({p.cost, p.errors.x});
  std::sort(front.points.begin(), front.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  plot.series.push_back(front);
  number = 0;
  for (const std::string& contender : names) {
    const Look look = look_of(contender, number++);
    PlotSeries bold{.title = "", .points = {}, .colour = look.colour, .symbol = look.symbol};
    bold.size = 1.7;
    PlotSeries floor = bold;
    floor.symbol = look.symbol - 1;
    if (look.variant != 0) bold.symbol = look.variant;
    for (const WorkPoint* p : by_name[contender])
      if (p->standing == Standing::front)
        (p->under_floor ? floor : bold).points.push_back({p->cost, std::max(p->errors.x, plot.y_low * 1.2)});
    plot.series.push_back(bold);
    plot.series.push_back(floor);
  }
  // at the border: the failed runs, one row per method, so that diagnoses do not cover each other
  number = 0;
  std::size_t row = 0;
  for (const std::string& contender : names) {
    const Look look = look_of(contender, number++);
    PlotSeries failed{.title = "", .points = {}, .colour = look.colour, .symbol = 2};
    failed.size = 0.9;
    const auto& points = by_name[contender];
    const double y = border * std::pow(10.0, row_height * static_cast<double>(row));
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool useless = points[k]->standing == Standing::useless;
      if (!points[k]->failed() && !useless) continue;
      const double x = points[k]->failed() ? cost_of_failed(points, k) : points[k]->cost;
      failed.points.push_back({std::clamp(x, plot.x_low * 1.02, plot.x_high / 1.02), y,
                               points[k]->failed() ? points[k]->code : "no better than rest"});
    }
    if (failed.points.empty()) continue;
    // one label where the same diagnosis repeats: at the dearest run that has it
    for (std::size_t k = 0; k + 1 < failed.points.size(); ++k) failed.points[k].label.clear();
    plot.series.push_back(failed);
    ++row;
  }
  plot.series.push_back({.title = "failed, or no better than a body at rest",
                         .points = {{1e-300, 1e-300}},
                         .colour = "#404040",
                         .symbol = 2});
  return plot;
}

}  // namespace dartboard
