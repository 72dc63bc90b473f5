#include "benchmarks/studies/foretold/foretold_report.h"

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

constexpr double part_asked = 0.95, seconds_margin = 0.15, most_regret = 1.2;
constexpr double times_pilots = 20.0, pilots_s = 2.0, pilots_part = 0.1;
constexpr std::size_t pairs_asked = 40;

bool has_pick(const ForetoldPair& p) { return !p.pick.empty(); }

/// A pair without a pick foretells nothing, and was to.
bool counts(const ForetoldPair& p) { return p.followed && (p.foretold() || !has_pick(p)); }

Claim claim_on_part(std::string id, std::string text, const std::vector<ForetoldPair>& pairs,
                    const std::function<bool(const ForetoldPair&)>& of,
                    const std::function<bool(const ForetoldPair&)>& holds) {
  std::size_t all = 0, good = 0;
  for (const ForetoldPair& p : pairs)
    if (counts(p) && of(p)) {
      ++all;
      good += holds(p) ? 1 : 0;
    }
  return claim_on_share(std::move(id), std::move(text), good, all, part_asked);
}

}  // namespace

bool ForetoldPair::foretold() const {
  return audit.actual_s >= times_pilots * audit.pilot_s &&
         audit.pilot_s <= std::max(pilots_s, pilots_part * audit.actual_s);
}

std::vector<Claim> foretold_claims(const std::vector<ForetoldPair>& pairs) {
  std::vector<Claim> claims;
  const auto foretold = static_cast<std::size_t>(
      std::ranges::count_if(pairs, [](const ForetoldPair& p) { return has_pick(p) && p.foretold(); }));
  Claim enough{.id = "foretold-pairs",
               .text = "runs that cost 20 times their pilots, which take at most 2 s or a tenth of them",
               .paper_value = fmt::format(">= {}", pairs_asked),
               .measured = fmt::format("{} of {} pairs", foretold, pairs.size())};
  if (const auto left = std::ranges::count(pairs, false, &ForetoldPair::followed); left > 0)
    enough.measured += fmt::format("; {} too long to follow", left);
  if (pairs.size() < pairs_asked)
    enough.reason = "fewer pairs were drawn";
  else
    enough.verdict = foretold >= pairs_asked ? Verdict::holds : Verdict::falls_short;
  claims.push_back(std::move(enough));

  claims.push_back(claim_on_part("foretold-error", "the setting recommended meets the error asked for", pairs,
                                 &ForetoldPair::told,
                                 [](const ForetoldPair& p) { return has_pick(p) && p.audit.met(); }));
  claims.push_back(
      claim_on_part("foretold-seconds", "seconds as printed within 15 % of those measured", pairs, has_pick,
                    [](const ForetoldPair& p) { return std::abs(p.seconds_ratio() - 1.0) <= seconds_margin; }));

  Claim regret{.id = "foretold-regret",
               .text = "median cost over that of the cheapest setting of a sweep of all methods",
               .paper_value = "<= 1.2"};
  // a pick that missed its error is cheap for another one: it has no regret to count
  std::vector<double> regrets;
  for (const ForetoldPair& p : pairs)
    if (has_pick(p) && p.foretold() && p.told() && p.audit.met() && std::isfinite(p.audit.best_cost))
      regrets.push_back(p.audit.regret());
  if (regrets.empty()) {
    regret.reason = "no pair to tell it from";
  } else {
    const Figure figure{median(regrets), median_interval(regrets)};
    regret.measured = fmt::format("{:.3f}, {} pairs", figure.median, regrets.size());
    regret.bound_or_interval = to_string(figure.interval);
    judge(regret, at_most(figure, most_regret));
  }
  claims.push_back(std::move(regret));
  return claims;
}

Table foretold_table(const std::vector<ForetoldPair>& pairs) {
  Table table({{"scene"},
               {"error", Align::right},
               {"pick"},
               {"actual / asked", Align::right},
               {"met"},
               {"actual / predicted error", Align::right},
               {"seconds", Align::right},
               {"printed / measured", Align::right},
               {"run / pilots", Align::right},
               {"seen", Align::right},
               {"best of the sweep"},
               {"regret", Align::right},
               {"confidence"}});
  for (const ForetoldPair& p : pairs) {
    const Audit& a = p.audit;
    if (!has_pick(p)) {
      table.add_row({p.scene, fmt::format("{:.1e}", a.error), "none", "-", p.followed ? "NO" : "not followed", "-", "-",
                     "-", "-", "-", "-", "-", p.confidence.empty() ? "-" : p.confidence});
      continue;
    }
    table.add_row({p.scene, fmt::format("{:.1e}", a.error), p.pick,
                   p.told() ? fmt::format("{:.3f}", a.actual_error / a.error) : "-",
                   !p.told()       ? "not judged: the other codes differ by more"
                   : !a.met()      ? "NO"
                   : !p.foretold() ? "yes, but not counted"
                                   : "yes",
                   p.told() ? fmt::format("{:.3f}", a.actual_error / a.predicted_error) : "-",
                   fmt::format("{:.3g}", a.actual_s), fmt::format("{:.3f}", p.seconds_ratio()),
                   fmt::format("{:.1f}", a.actual_s / a.pilot_s), fmt::format("{:.2f} %", 100.0 * p.seen_part),
                   std::isfinite(a.best_cost) ? a.best : "-",
                   std::isfinite(a.best_cost) ? fmt::format("{:.2f}", a.regret()) : "-",
                   p.confidence + (p.warned ? ", errors grow exponentially" : "")});
  }
  return table;
}

Table foretold_scenes_table(const std::vector<ForetoldPair>& pairs) {
  Table scenes({{"scene"},
                {"what was drawn"},
                {"vertices", Align::right},
                {"springs", Align::right},
                {"T omega_max", Align::right},
                {"the other codes differ by", Align::right}});
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (k == 0 || pairs[k].scene != pairs[k - 1].scene)
      scenes.add_row({pairs[k].scene, pairs[k].what, std::to_string(pairs[k].vertices),
                      std::to_string(pairs[k].springs), fmt::format("{:.0f}", pairs[k].omega_phase),
                      fmt::format("{:.1e}", 0.1 * pairs[k].floor)});
  return scenes;
}

nlohmann::json json_of(const ForetoldPair& p) {
  const Audit& a = p.audit;
  return {{"scene", p.scene},
          {"what", p.what},
          {"vertices", p.vertices},
          {"springs", p.springs},
          {"omega_phase", number(p.omega_phase)},
          {"floor", number(p.floor)},
          {"error", a.error},
          {"pick", p.pick},
          {"confidence", p.confidence},
          {"steps", p.setting.steps},
          {"tolerance", p.setting.tolerance},
          {"seen_part", number(p.seen_part)},
          {"warned", p.warned},
          {"foretold", p.foretold()},
          {"told", p.told()},
          {"actual_error", number(a.actual_error)},
          {"predicted_error", number(a.predicted_error)},
          {"actual_evaluations", number(a.actual_evaluations)},
          {"predicted_evaluations", number(a.predicted_evaluations)},
          {"actual_s", number(a.actual_s)},
          {"printed_s", number(a.printed_s)},
          {"pilot_s", number(a.pilot_s)},
          {"actual_cost", number(a.actual_cost)},
          {"best", a.best},
          {"best_cost", number(a.best_cost)}};
}

Plot foretold_plot(const std::vector<ForetoldPair>& pairs, const std::string& subtitle) {
  Plot plot;
  plot.title = "recommend, foretold and met";
  plot.subtitle = subtitle;
  plot.x_axis = "part of the motion that its pilots saw";
  plot.y_axis = "actual error over the error asked for (below the line: met)";
  plot.x_low = 1e-4;
  plot.x_high = 1.0;
  plot.y_low = 1e-4;
  plot.y_high = 100.0;
  PlotSeries line{.title = "", .points = {{plot.x_low, 1.0}, {plot.x_high, 1.0}}, .colour = "#606060", .symbol = 0};
  line.width = 1.5;
  line.dash = "-";
  plot.series.push_back(line);
  static const char* const colours[]{"#d62728", "#1f77b4", "#2ca02c", "#17becf", "#9467bd",
                                     "#ff7f0e", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22"};
  std::map<std::string, PlotSeries> by_pick;
  for (const ForetoldPair& p : pairs) {
    if (!has_pick(p) || !p.told() || !p.foretold()) continue;
    PlotSeries& series = by_pick[p.pick];
    series.title = p.pick;
    series.size = 1.3;
    series.points.push_back({std::clamp(p.seen_part, plot.x_low * 1.01, plot.x_high / 1.01),
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
