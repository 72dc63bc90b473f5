#include "benchmarks/studies/tradeoff/audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/paired.h"

namespace dartboard {
namespace {

constexpr double part_asked = 0.95, cost_margin = 0.15, most_regret = 1.2;
// for scenes: the shortest long run, and the part of it that pilots may take
constexpr double long_run_s = 5.0, most_pilots = 0.2;
// for long motions: the conditions of a prediction, and how many are required
constexpr double times_pilots = 20.0, pilots_s = 2.0, pilots_part = 0.1;
constexpr std::size_t pairs_asked = 40;

bool has_pick(const AuditedPair& p) { return !p.pick.empty(); }

bool has_met(const AuditedPair& p) { return p.is_resolved() && p.audit.met(); }

bool within_margin(double ratio) { return std::abs(ratio - 1.0) <= cost_margin; }

/// The pairs that count in claims: those without a pick, too, as there should have been one.
std::vector<AuditedPair> those_that_count(AuditKind kind, std::vector<AuditedPair> pairs) {
  std::erase_if(pairs, [kind](const AuditedPair& p) {
    return !p.followed || (kind == AuditKind::long_motions && has_pick(p) && !p.is_long_prediction());
  });
  return pairs;
}

/// A claim on the part of the pairs that satisfy a condition.
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

Claim claim_on_predictions(const std::vector<AuditedPair>& pairs) {
  const auto long_ones = static_cast<std::size_t>(
      std::ranges::count_if(pairs, [](const AuditedPair& p) { return has_pick(p) && p.is_long_prediction(); }));
  Claim claim{.id = "long-pairs",
              .text = "runs that cost 20 times their pilots, which take at most 2 s or a tenth of them",
              .paper_value = fmt::format(">= {}", pairs_asked),
              .measured = fmt::format("{} of {} pairs", long_ones, pairs.size())};
  if (const auto left = std::ranges::count(pairs, false, &AuditedPair::followed); left > 0)
    claim.measured += fmt::format("; {} too long to follow", left);
  if (pairs.size() < pairs_asked)
    claim.reason = "fewer pairs were drawn";
  else
    judge(claim, met(long_ones >= pairs_asked));
  return claim;
}

// A pick that missed its error is cheap for another one: it has no regret to count.
Claim claim_on_regret(std::string id, const std::vector<AuditedPair>& pairs) {
  Claim claim =
      target(std::move(id), "median cost over that of the cheapest setting of a sweep of all methods", "<= 1.2");
  std::vector<double> regrets;
  std::size_t left_out = 0;
  for (const AuditedPair& p : pairs) {
    if (!has_pick(p) || !p.swept) continue;
    if (!has_met(p))
      ++left_out;
    else if (std::isfinite(p.audit.best_cost))
      regrets.push_back(p.audit.regret());
  }
  const std::string without =
      left_out > 0 ? fmt::format("{} left out, whose error was missed or cannot be resolved", left_out) : "";
  if (regrets.empty()) {
    claim.reason = left_out > 0 ? without : pairs.empty() ? "no pair to judge by" : "no sweep";
    return claim;
  }
  const Figure figure = figure_of(regrets);
  claim.measured =
      fmt::format("{:.3f}, {} pairs{}{}", figure.median, regrets.size(), left_out > 0 ? "; " : "", without);
  claim.bound_or_interval = to_string(figure.interval);
  judge(claim, at_most(figure, most_regret));
  return claim;
}

Claim claim_on_pilots(const std::vector<AuditedPair>& pairs) {
  Claim claim = target("recommend-pilots", "time of the pilots over that of the run, runs longer than 5 s", "<= 20 %");
  std::vector<double> parts;
  for (const AuditedPair& p : pairs)
    if (has_pick(p) && p.audit.actual_s > long_run_s) parts.push_back(p.pilot_part());
  if (parts.empty()) {
    claim.reason = "no run took longer than 5 s";
  } else {
    const double most = *std::ranges::max_element(parts);
    claim.measured = fmt::format("at most {:.1f} %, {} runs", 100.0 * most, parts.size());
    judge(
        claim, met(most <= most_pilots),
        "through contact, and under loads that change in time, no part of a motion predicts the rest: pilots are whole runs "
        "there");
  }
  return claim;
}

}  // namespace

bool AuditedPair::is_long_prediction() const {
  return audit.actual_s >= times_pilots * audit.pilot_s &&
         audit.pilot_s <= std::max(pilots_s, pilots_part * audit.actual_s);
}

std::vector<Claim> audit_claims(AuditKind kind, const std::vector<AuditedPair>& pairs) {
  const bool is_long = kind == AuditKind::long_motions;
  const std::vector<AuditedPair> counted = those_that_count(kind, pairs);
  std::vector<Claim> claims;
  if (is_long) claims.push_back(claim_on_predictions(pairs));
  claims.push_back(claim_on_part(
      is_long ? "long-error" : "recommend-error", "the setting recommended meets the requested error", counted,
      &AuditedPair::is_resolved, [](const AuditedPair& p) { return has_pick(p) && p.audit.met(); }));
  if (!is_long)
    claims.push_back(claim_on_part("recommend-evaluations", "predicted force evaluations within 15 % of those counted",
                                   counted, has_pick,
                                   [](const AuditedPair& p) { return within_margin(p.count_ratio()); }));
  claims.push_back(claim_on_part(
      is_long ? "long-seconds" : "recommend-time",
      fmt::format("{} within 15 % of those measured", is_long ? "seconds as printed" : "predicted seconds"), counted,
      has_pick, [kind](const AuditedPair& p) { return within_margin(p.time_ratio(kind)); }));
  claims.push_back(claim_on_regret(is_long ? "long-regret" : "recommend-regret", counted));
  if (!is_long) claims.push_back(claim_on_pilots(counted));
  return claims;
}

namespace {

std::string met_in_words(AuditKind kind, const AuditedPair& p) {
  const bool is_long = kind == AuditKind::long_motions;
  if (!has_pick(p)) return p.followed ? "NO" : "not followed";
  if (!p.is_resolved() && is_long) return "not judged: the other codes differ by more";
  if (!std::isfinite(p.floor)) return "not judged: followed for its cost only";
  if (!p.is_resolved()) return "not judged: below the resolution of the reference";
  if (!p.audit.met()) return "NO";
  return is_long && !p.is_long_prediction() ? "yes, but not counted" : "yes";
}

/// A row, each cell with its heading.
std::vector<std::pair<Column, std::string>> row_of(AuditKind kind, const AuditedPair& p) {
  const Audit& a = p.audit;
  const bool is_long = kind == AuditKind::long_motions, compared = p.swept && std::isfinite(a.best_cost);
  std::vector<std::pair<Column, std::string>> row{
      {{"scene"}, p.scene}, {{"error", Align::right}, fmt::format("{:.1e}", a.error)}, {{"pick"}, p.pick}};
  const auto add = [&row](Column column, std::string cell) { row.emplace_back(std::move(column), std::move(cell)); };
  const auto add_figure = [&](const char* title, const char* format, double value, bool is_known = true) {
    add({title, Align::right}, has_pick(p) && is_known ? fmt::format(fmt::runtime(format), value) : "-");
  };
  if (!has_pick(p)) row.back().second = "none";
  add_figure("actual / asked", "{:.3f}", a.actual_error / a.error, p.is_resolved());
  add({"met"}, met_in_words(kind, p));
  add_figure("largest of a vertex / asked", "{:.3f}", a.largest_error / a.error, p.is_resolved());
  if (is_long) {
    add_figure("actual / predicted error", "{:.3f}", a.actual_error / a.predicted_error, p.is_resolved());
  } else {
    add_figure("evaluations", "{:.0f}", a.actual_evaluations);
    add_figure("predicted / counted", "{:.3f}", p.count_ratio());
  }
  add_figure("seconds", "{:.3g}", a.actual_s);
  add_figure(is_long ? "printed / measured" : "predicted / measured", "{:.3f}", p.time_ratio(kind));
  if (is_long) {
    add_figure("run / pilots", "{:.1f}", a.actual_s / a.pilot_s);
    add_figure("seen", "{:.2f} %", 100.0 * p.seen_part);
  }
  add({"best of the sweep"}, has_pick(p) && compared ? a.best : "-");
  add_figure("regret", "{:.2f}", a.regret(), compared);
  if (!is_long) add_figure("pilots / run", "{:.2f}", p.pilot_part());
  add({"confidence"}, p.confidence.empty() ? "-" : p.confidence + (p.warned ? ", errors grow exponentially" : ""));
  if (!is_long) add({"reference"}, p.reference);
  return row;
}

}  // namespace

Table audit_table(AuditKind kind, const std::vector<AuditedPair>& pairs) {
  std::vector<Column> columns;
  for (auto& [column, cell] : row_of(kind, {})) columns.push_back(column);
  Table table(columns);
  for (const AuditedPair& p : pairs) {
    std::vector<std::string> cells;
    for (auto& [column, cell] : row_of(kind, p)) cells.push_back(cell);
    table.add_row(std::move(cells));
  }
  return table;
}

Table audited_scenes_table(AuditKind kind, const std::vector<AuditedPair>& pairs) {
  const bool is_long = kind == AuditKind::long_motions;
  std::vector<Column> columns{{"scene"}, {"what was drawn"}, {"vertices", Align::right}, {"T omega_max", Align::right}};
  if (is_long) columns.insert(columns.begin() + 3, {"springs", Align::right});
  if (is_long) columns.push_back({"the other codes differ by", Align::right});
  Table scenes(columns);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const AuditedPair& p = pairs[k];
    if (k > 0 && p.scene == pairs[k - 1].scene) continue;
    std::vector<std::string> row{p.scene, p.what, std::to_string(p.vertices), fmt::format("{:.0f}", p.omega_phase)};
    if (is_long) row.insert(row.begin() + 3, std::to_string(p.springs));
    if (is_long) row.push_back(fmt::format("{:.1e}", 0.1 * p.floor));
    scenes.add_row(std::move(row));
  }
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
          {"seen_part", number(p.seen_part)},
          {"warned", p.warned},
          {"long_prediction", p.is_long_prediction()},
          {"resolved", p.is_resolved()},
          {"actual_error", number(a.actual_error)},
          {"largest_error", number(a.largest_error)},
          {"predicted_error", number(a.predicted_error)},
          {"actual_evaluations", number(a.actual_evaluations)},
          {"predicted_evaluations", number(a.predicted_evaluations)},
          {"actual_cost", number(a.actual_cost)},
          {"predicted_cost", number(a.predicted_cost)},
          {"actual_s", number(a.actual_s)},
          {"predicted_s", number(a.predicted_s)},
          {"printed_s", number(a.printed_s)},
          {"pilot_s", number(a.pilot_s)},
          {"swept", p.swept},
          {"best", a.best},
          {"best_cost", number(a.best_cost)}};
}

Plot audit_plot(AuditKind kind, const std::vector<AuditedPair>& pairs, const std::string& subtitle) {
  const bool is_long = kind == AuditKind::long_motions;
  Plot plot;
  plot.title = is_long ? "recommend, predicted and met" : "recommend, promised and met";
  plot.subtitle = subtitle;
  plot.x_axis = is_long ? "part of the motion that its pilots saw"
                        : "predicted over measured time of the run (between the lines: within 15 %)";
  plot.y_axis = "actual error over the requested error (below the line: met)";
  plot.x_low = is_long ? 1e-4 : 0.3;
  plot.x_high = is_long ? 1.0 : 3.0;
  plot.y_low = 1e-4;
  plot.y_high = is_long ? 100.0 : 10.0;
  const auto line = [&](double x1, double y1, double x2, double y2) {
    PlotSeries series{.title = "", .points = {{x1, y1}, {x2, y2}}, .colour = "#606060", .symbol = 0};
    series.width = 1.5;
    series.dash = "-";
    plot.series.push_back(series);
  };
  line(plot.x_low, 1.0, plot.x_high, 1.0);
  if (!is_long) {
    line(1.0 - cost_margin, plot.y_low, 1.0 - cost_margin, plot.y_high);
    line(1.0 + cost_margin, plot.y_low, 1.0 + cost_margin, plot.y_high);
  }
  static const char* const colours[]{"#d62728", "#1f77b4", "#2ca02c", "#17becf", "#9467bd",
                                     "#ff7f0e", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22"};
  std::map<std::string, PlotSeries> by_pick;
  for (const AuditedPair& p : those_that_count(kind, pairs)) {
    if (!has_pick(p) || !p.is_resolved()) continue;
    PlotSeries& series = by_pick[p.pick];
    series.title = p.pick;
    series.size = 1.3;
    series.points.push_back(
        {std::clamp(is_long ? p.seen_part : p.time_ratio(kind), plot.x_low * 1.01, plot.x_high / 1.01),
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
