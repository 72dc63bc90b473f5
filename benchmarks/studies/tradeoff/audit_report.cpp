#include "benchmarks/studies/tradeoff/audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/statistics.h"

namespace dartboard {
namespace {

constexpr double part_asked = 0.95, cost_margin = 0.15, most_regret = 1.2, long_run_s = 5.0, most_pilots = 0.2;

bool has_pick(const AuditedPair& p) { return !p.pick.empty(); }

/// A claim on the part of the pairs for which something is true.
Claim claim_on_part(std::string id, std::string text, const std::vector<AuditedPair>& pairs,
                    const std::function<bool(const AuditedPair&)>& counts,
                    const std::function<bool(const AuditedPair&)>& holds) {
  std::size_t all = 0, good = 0;
  for (const AuditedPair& p : pairs)
    if (counts(p)) {
      ++all;
      good += holds(p) ? 1 : 0;
    }
  return claim_on_share(std::move(id), std::move(text), good, all, part_asked);
}

bool within_margin(double ratio) { return std::abs(ratio - 1.0) <= cost_margin; }

}  // namespace

std::vector<Claim> audit_claims(const std::vector<AuditedPair>& pairs) {
  std::vector<Claim> claims;
  claims.push_back(claim_on_part("recommend-error", "the setting recommended meets the error asked for", pairs,
                                 &AuditedPair::told,
                                 [](const AuditedPair& p) { return has_pick(p) && p.audit.met(); }));
  claims.push_back(claim_on_part("recommend-evaluations", "predicted force evaluations within 15 % of those counted",
                                 pairs, has_pick, [](const AuditedPair& p) { return within_margin(p.count_ratio()); }));
  claims.push_back(claim_on_part("recommend-time", "predicted seconds within 15 % of those measured", pairs, has_pick,
                                 [](const AuditedPair& p) { return within_margin(p.cost_ratio()); }));

  Claim regret{.id = "recommend-regret",
               .text = "median cost over that of the cheapest setting of a sweep",
               .paper_value = "<= 1.2"};
  // a pick that missed its error is cheap for another one: it has no regret to count
  std::vector<double> regrets;
  std::size_t left_out = 0;
  for (const AuditedPair& p : pairs) {
    if (!has_pick(p) || !p.swept || !std::isfinite(p.audit.best_cost)) continue;
    if (p.told() && p.audit.met())
      regrets.push_back(p.audit.regret());
    else
      ++left_out;
  }
  const std::string without =
      left_out > 0 ? fmt::format("{} left out, whose error was missed or cannot be told", left_out) : "";
  if (regrets.empty()) {
    regret.reason = left_out > 0 ? without : "no sweep";
  } else {
    const Figure figure{median(regrets), median_interval(regrets)};
    regret.measured =
        fmt::format("{:.3f}, {} pairs{}{}", figure.median, regrets.size(), left_out > 0 ? "; " : "", without);
    regret.bound_or_interval = to_string(figure.interval);
    judge(regret, at_most(figure, most_regret));
  }
  claims.push_back(std::move(regret));

  Claim pilots{.id = "recommend-pilots",
               .text = "time of the pilots over that of the run, runs longer than 5 s",
               .paper_value = "<= 20 %"};
  std::vector<double> parts;
  for (const AuditedPair& p : pairs)
    if (has_pick(p) && p.audit.actual_s > long_run_s) parts.push_back(p.pilot_part());
  if (parts.empty()) {
    pilots.reason = "no run took longer than 5 s";
  } else {
    const double most = *std::ranges::max_element(parts);
    pilots.measured = fmt::format("at most {:.1f} %, {} runs", 100.0 * most, parts.size());
    pilots.verdict = most <= most_pilots ? Verdict::holds : Verdict::falls_short;
  }
  claims.push_back(std::move(pilots));
  return claims;
}

Table audit_table(const std::vector<AuditedPair>& pairs) {
  Table table({{"scene"},
               {"error", Align::right},
               {"pick"},
               {"actual / asked", Align::right},
               {"met"},
               {"evaluations", Align::right},
               {"predicted / counted", Align::right},
               {"seconds", Align::right},
               {"predicted / measured", Align::right},
               {"best of the sweep"},
               {"regret", Align::right},
               {"pilots / run", Align::right},
               {"confidence"},
               {"reference"}});
  for (const AuditedPair& p : pairs) {
    const Audit& a = p.audit;
    if (!has_pick(p)) {
      table.add_row({p.scene, fmt::format("{:.1e}", a.error), "none", "-", "NO", "-", "-", "-", "-", "-", "-", "-", "-",
                     p.reference});
      continue;
    }
    const bool compared = p.swept && std::isfinite(a.best_cost);
    table.add_row({p.scene, fmt::format("{:.1e}", a.error), p.pick,
                   p.told() ? fmt::format("{:.3f}", a.actual_error / a.error) : "-",
                   !std::isfinite(p.floor) ? "not judged: followed for its cost only"
                   : !p.told()             ? "not judged: the reference is no better than that"
                   : a.met()               ? "yes"
                                           : "NO",
                   fmt::format("{:.0f}", a.actual_evaluations), fmt::format("{:.3f}", p.count_ratio()),
                   fmt::format("{:.3g}", a.actual_s), fmt::format("{:.3f}", p.cost_ratio()), compared ? a.best : "-",
                   compared ? fmt::format("{:.2f}", a.regret()) : "-", fmt::format("{:.2f}", p.pilot_part()),
                   p.confidence, p.reference});
  }
  return table;
}

Table audited_scenes_table(const std::vector<AuditedPair>& pairs) {
  Table scenes({{"scene"}, {"what was drawn"}, {"vertices", Align::right}, {"T omega_max", Align::right}});
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (k == 0 || pairs[k].scene != pairs[k - 1].scene)
      scenes.add_row({pairs[k].scene, pairs[k].what, std::to_string(pairs[k].vertices),
                      fmt::format("{:.0f}", pairs[k].omega_phase)});
  return scenes;
}

nlohmann::json json_of(const AuditedPair& p) {
  const Audit& a = p.audit;
  return {{"scene", p.scene},
          {"what", p.what},
          {"vertices", p.vertices},
          {"springs", p.springs},
          {"omega_phase", number(p.omega_phase)},
          {"reference", p.reference},
          {"floor", number(p.floor)},
          {"error", a.error},
          {"pick", p.pick},
          {"confidence", p.confidence},
          {"steps", p.setting.steps},
          {"tolerance", p.setting.tolerance},
          {"told", p.told()},
          {"actual_error", number(a.actual_error)},
          {"predicted_error", number(a.predicted_error)},
          {"actual_evaluations", number(a.actual_evaluations)},
          {"predicted_evaluations", number(a.predicted_evaluations)},
          {"actual_cost", number(a.actual_cost)},
          {"predicted_cost", number(a.predicted_cost)},
          {"actual_s", number(a.actual_s)},
          {"predicted_s", number(a.predicted_s)},
          {"pilot_s", number(a.pilot_s)},
          {"swept", p.swept},
          {"best", a.best},
          {"best_cost", number(a.best_cost)}};
}

Plot audit_plot(const std::vector<AuditedPair>& pairs, const std::string& subtitle) {
  Plot plot;
  plot.title = "recommend, promised and met";
  plot.subtitle = subtitle;
  plot.x_axis = "predicted over measured time of the run (between the lines: within 15 %)";
  plot.y_axis = "actual error over the error asked for (below the line: met)";
  plot.x_low = 0.3;
  plot.x_high = 3.0;
  plot.y_low = 1e-4;
  plot.y_high = 10.0;
  const auto line = [&](double x1, double y1, double x2, double y2) {
    PlotSeries series{.title = "", .points = {{x1, y1}, {x2, y2}}, .colour = "#606060", .symbol = 0};
    series.width = 1.5;
    series.dash = "-";
    plot.series.push_back(series);
  };
  line(plot.x_low, 1.0, plot.x_high, 1.0);
  line(1.0 - cost_margin, plot.y_low, 1.0 - cost_margin, plot.y_high);
  line(1.0 + cost_margin, plot.y_low, 1.0 + cost_margin, plot.y_high);
  static const char* const colours[]{"#d62728", "#1f77b4", "#2ca02c", "#17becf", "#9467bd",
                                     "#ff7f0e", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22"};
  std::map<std::string, PlotSeries> by_pick;
  for (const AuditedPair& p : pairs) {
    if (!has_pick(p) || !p.told()) continue;
    PlotSeries& series = by_pick[p.pick];
    series.title = p.pick;
    series.size = 1.3;
    series.points.push_back({std::clamp(p.cost_ratio(), plot.x_low * 1.01, plot.x_high / 1.01),
                             std::clamp(p.audit.actual_error / p.audit.error, plot.y_low * 1.1, plot.y_high / 1.1)});
  }
  std::size_t number = 0;
  for (auto& [pick, series] : by_pick) {
    series.colour = colours[number++ % std::size(colours)];
    plot.series.push_back(series);
  }
  return plot;
}

}  // namespace dartboard
