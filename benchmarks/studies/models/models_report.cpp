#include "benchmarks/studies/models/models_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr double coarse = 0.10, fine = 0.05;  // errors of the tip that the claims are about
constexpr double of_interest = 0.5;           // models that miss by more follow nothing
constexpr double off_the_chart = 0.25;

std::string percent(double share) {
  return share <= ModelsResults::exact ? "0" : fmt::format("{:.{}f} %", 100.0 * share, share < 0.00995 ? 2 : 1);
}

/// "[0.9, 1.1]": one family over another at an error of the tip. If the first has no mesh that is good enough, it
/// loses; if the other has none, it wins; neither depends on times.
void compare(const ModelsResults& results, double poisson, double error, std::string_view family,
             std::string_view other, Claim& claim) {
  const ModelPoint* mine = results.cheapest(Asked::tip, poisson, error, family);
  const ModelPoint* theirs = results.cheapest(Asked::tip, poisson, error, other);
  claim.paper_value = "<= 1";
  if (mine == nullptr && theirs == nullptr) {
    claim.measured = "neither is that near";
    claim.reason = "no mesh of either has so small an error";
    return;
  }
  if (mine == nullptr || theirs == nullptr) {
    claim.measured = fmt::format("no {} are that near", mine == nullptr ? family : other);
    claim.verdict = mine == nullptr ? Verdict::does_not_carry_over : Verdict::holds;
    if (mine == nullptr) claim.reason = "a finding: no mesh of them has so small an error";
    return;
  }
  const Figure ratio = results.cost_ratio(*mine, *theirs);
  claim.measured = fmt::format("{:.3g}", ratio.median);
  claim.bound_or_interval = to_string(ratio.interval);
  judge(claim, at_most(ratio, 1.0));
  if (claim.verdict == Verdict::falls_short) {
    claim.verdict = Verdict::does_not_carry_over;
    claim.reason =
        fmt::format("a finding: {} have that error for {:.3g} of the time", theirs->timed.model, 1.0 / ratio.median);
  }
}

std::string method_of(const ModelPoint& point) {
  return point.measured.method.integrator.empty()
             ? "none"
             : fmt::format("{}, {} steps", point.measured.method.integrator, point.measured.method.steps);
}

// Springs are warm, tetrahedra green to teal, hexahedra blue; jittered meshes are dashed.
PlotSeries look_of(const std::string& model) {
  PlotSeries s{.title = model, .points = {}, .colour = "#404040"};
  s.width = 1.6;
  s.size = 1.1;
  if (model.starts_with("springs")) {
    s.colour = "#d62728";
    s.symbol = 7;
  } else if (model.find("hexahedra") != std::string::npos) {
    s.colour = model.starts_with("corotational") ? "#6a51a3" : "#1f4e9c";
    s.symbol = model.starts_with("corotational") ? 4 : 5;
  } else {
    s.colour = model.starts_with("neo-hookean") ? "#2ca02c" : model.starts_with("stvk") ? "#8c6d31" : "#17a2a2";
    s.symbol = model.starts_with("neo-hookean") ? 9 : model.starts_with("stvk") ? 10 : 8;
  }
  if (model.ends_with("jittered")) {
    s.dash = "-";
    s.colour = "#ff7f0e";
    s.symbol = 6;
  }
  return s;
}

}  // namespace

std::vector<Claim> claims_of(const ModelsResults& results) {
  Claim reference{.id = "models-reference",
                  .text = "tip and frequencies of the reference are sure: a mesh half as fine has them, too",
                  .paper_value = fmt::format("<= {:.0f} %", 100.0 * results.sure)};
  double unsure = results.truths.empty() ? NAN : 0.0;
  for (const BarTruth& t : results.truths)
    for (const Asked asked : {Asked::tip, Asked::frequencies}) unsure = max_or_nan(unsure, error_of(t.unsure, asked));
  reference.measured = percent(unsure);
  judge(reference, met(unsure <= results.sure));

  Claim steps{.id = "models-steps",
              .text = "errors by time steps are a tenth of each model's own, or of the resolution of the reference",
              .paper_value = "all"};
  std::size_t small = 0;
  for (const ModelPoint& p : results.points)
    if (!p.measured.method.integrator.empty() && p.measured.method.error <= p.measured.allowed) ++small;
  steps.measured = fmt::format("{} of {}", small, results.points.size());
  judge(steps, met(small == results.points.size() && small > 0));

  double first = NAN, last = NAN;  // the smallest and the largest of the ratios
  for (const BarTruth& t : results.truths) {
    first = std::isnan(first) ? t.poisson : std::min(first, t.poisson);
    last = std::isnan(last) ? t.poisson : std::max(last, t.poisson);
  }
  Claim springs{.id = "models-springs-coarse",
                .text = fmt::format("springs take no longer than hexahedra for a tip within {:.0f} %", 100 * coarse)};
  compare(results, first, coarse, "springs", "hexahedra", springs);
  Claim hexahedra{.id = "models-hexahedra-fine",
                  .text = fmt::format("hexahedra take no longer than springs for a tip within {:.0f} %", 100 * fine)};
  compare(results, first, fine, "hexahedra", "springs", hexahedra);

  Claim confined{
      .id = "models-springs-confined",
      .text = fmt::format("at a Poisson's ratio of {} the confined modulus of springs is off, however fine", last),
      .paper_value = fmt::format(">= {:.0f} %", 100.0 * off_the_chart)};
  double least = NAN;
  for (const ModelPoint& p : results.points)
    if (p.timed.poisson == last && belongs(p, "springs"))
      least = std::isnan(least) ? p.measured.errors.confined : std::min(least, p.measured.errors.confined);
  confined.measured = std::isnan(least) ? "no springs" : percent(least);
  judge(confined, met(least >= off_the_chart));
  return {reference, steps, springs, hexahedra, confined};
}

Table points_table(const ModelsResults& results) {
  Table table({{"model"},
               {"Poisson's ratio", Align::right},
               {"finer", Align::right},
               {"nodes", Align::right},
               {"tip", Align::right},
               {"frequencies", Align::right},
               {"worst", Align::right},
               {"confined", Align::right},
               {"motion", Align::right},
               {"of it by steps", Align::right},
               {"integrator, steps of a period"},
               {"processor s per simulated s", Align::right}});
  for (const ModelPoint& p : results.points)
    table.add_row({p.timed.model, fmt::format("{}", p.timed.poisson), fmt::format("{}", p.timed.finer),
                   fmt::format("{}", p.measured.nodes), percent(p.measured.errors.tip),
                   percent(p.measured.errors.frequencies), fmt::format("{}.", p.measured.errors.worst_frequency + 1),
                   percent(p.measured.errors.confined), percent(p.measured.errors.motion),
                   percent(p.measured.method.error), method_of(p), fmt::format("{:.3g}", p.cost.median)});
  return table;
}

Table reigns_table(const ModelsResults& results) {
  Table table({{"question"}, {"Poisson's ratio", Align::right}, {"errors"}, {"the cheapest"}});
  for (const BarTruth& t : results.truths)
    for (const Asked asked : all_asked)
      for (const Reign& r : reigns(results, asked, t.poisson))
        table.add_row({std::string(name(asked)), fmt::format("{}", t.poisson),
                       std::isinf(r.below) ? fmt::format("{} and more", percent(r.least))
                                           : fmt::format("{} to {}", percent(r.least), percent(r.below)),
                       r.model});
  return table;
}

Table truths_table(const ModelsResults& results) {
  Table table({{"Poisson's ratio", Align::right},
               {"nodes", Align::right},
               {"work [J]", Align::right},
               {"frequencies [1/s]"},
               {"tip unsure by", Align::right},
               {"frequencies by", Align::right},
               {"motion by", Align::right}});
  for (const BarTruth& t : results.truths) {
    std::string omega;
    for (const double w : t.answers.frequency) omega += fmt::format("{}{:.5g}", omega.empty() ? "" : ", ", w);
    table.add_row({fmt::format("{}", t.poisson), fmt::format("{}", t.answers.nodes),
                   fmt::format("{:.4e}", t.answers.work), omega, percent(t.unsure.tip), percent(t.unsure.frequencies),
                   percent(t.unsure.motion)});
  }
  return table;
}

std::string in_words(const ModelsResults& results) {
  std::string text;
  for (const BarTruth& t : results.truths)
    for (const Asked asked : {Asked::tip, Asked::frequencies, Asked::motion}) {
      std::string one;
      for (const Reign& r : reigns(results, asked, t.poisson))
        if (r.least < of_interest)
          one += fmt::format("{}{} down to {}", one.empty() ? "" : ", ", r.model, percent(r.least));
      if (one.empty()) continue;
      text += fmt::format("{}For the {} at a Poisson's ratio of {} the cheapest are {}.", text.empty() ? "" : " ",
                          name(asked), t.poisson, one);
    }
  return text;
}

Panels models_panels(const ModelsResults& results) {
  Panels picture{.title = fmt::format("What a model misses, and what it costs: {}", results.what),
                 .columns = static_cast<int>(all_asked.size()),
                 .panels = {},
                 .field_label = {}};
  double cheapest = 1e300, dearest = 0.0;
  for (const ModelPoint& p : results.points) {
    cheapest = std::min(cheapest, p.cost.median);
    dearest = std::max(dearest, p.cost.median);
  }
  if (!(cheapest < dearest)) cheapest = 1e-6, dearest = 1.0;
  constexpr double low = 1e-3, high = 2.0;  // of errors; exact results lie on the lower edge
  picture.width = 2000;
  picture.height = 1050;
  for (const BarTruth& t : results.truths)
    for (const Asked asked : all_asked) {
      Panel panel{.title = fmt::format("{}, Poisson's ratio {}", name(asked), t.poisson),
                  .x_axis = "processor s per simulated s",
                  .y_axis = "error"};
      panel.x_log = panel.y_log = true;
      panel.x_low = cheapest / 2.0;
      panel.x_high = dearest * 2.0;
      panel.y_low = low;
      panel.y_high = high;
      for (const ModelPoint& p : results.points) {
        if (p.timed.poisson != t.poisson) continue;
        if (panel.series.empty() || panel.series.back().title != p.timed.model)
          panel.series.push_back(look_of(p.timed.model));
        panel.series.back().points.push_back(
            {p.cost.median, std::clamp(error_of(p.measured.errors, asked), 1.03 * low, high / 1.03)});
      }
      // the reference cannot resolve smaller errors
      PlotSeries floor{.title = "the reference's own", .points = {}, .colour = "#909090", .symbol = 0};
      floor.width = 1.2;
      floor.dash = ".";
      const double unsure = error_of(t.unsure, asked);
      if (unsure > low) floor.points = {{panel.x_low, unsure}, {panel.x_high, unsure}};
      panel.series.push_back(floor);
      picture.panels.push_back(std::move(panel));
    }
  if (!picture.panels.empty()) picture.panels.front().key = "bottom left";
  return picture;
}

nlohmann::json json_of(const ModelPoint& p) {
  nlohmann::json json{{"model", p.timed.model},
                      {"finer", p.timed.finer},
                      {"poisson", p.timed.poisson},
                      {"nodes", p.measured.nodes},
                      {"tip", p.measured.errors.tip},
                      {"frequencies", p.measured.errors.frequencies},
                      {"worst_frequency", p.measured.errors.worst_frequency + 1},
                      {"confined", p.measured.errors.confined},
                      {"motion", p.measured.errors.motion},
                      {"motion_of_model", p.measured.model_motion},
                      {"integrator", p.measured.method.integrator},
                      {"steps", p.measured.method.steps},
                      {"error_by_steps", p.measured.method.error},
                      {"allowed", p.measured.allowed},
                      {"runs_followed", p.measured.method.followed}};
  if (p.cost.median > 0.0) json["cost"] = p.cost.median;  // once it is timed
  return json;
}

nlohmann::ordered_json json_of(const ModelsResults& results) {
  nlohmann::ordered_json json{{"bar", results.what}, {"references", nlohmann::ordered_json::array()}};
  for (const BarTruth& t : results.truths)
    json["references"].push_back({{"poisson", t.poisson},
                                  {"nodes", t.answers.nodes},
                                  {"work", t.answers.work},
                                  {"frequencies", t.answers.frequency},
                                  {"unsure_tip", t.unsure.tip},
                                  {"unsure_frequencies", t.unsure.frequencies},
                                  {"unsure_motion", t.unsure.motion}});
  json["cheapest"] = nlohmann::ordered_json::array();
  for (const BarTruth& t : results.truths)
    for (const Asked asked : all_asked)
      for (const Reign& r : reigns(results, asked, t.poisson))
        json["cheapest"].push_back(
            {{"question", name(asked)},
             {"poisson", t.poisson},
             {"model", r.model},
             {"least_error", r.least},
             {"below", std::isinf(r.below) ? nlohmann::ordered_json() : nlohmann::ordered_json(r.below)}});
  json["points"] = nlohmann::ordered_json::array();
  for (const ModelPoint& p : results.points) json["points"].push_back(nlohmann::ordered_json(json_of(p)));
  return json;
}

}  // namespace dartboard
