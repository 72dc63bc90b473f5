#include "benchmarks/studies/tradeoff/recommend_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/tell.h"
#include "core/base/counted.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

nlohmann::json json_of(const Candidate& c) {
  nlohmann::json json{{"integrator", c.contender}, {"implicit", c.implicit}, {"order", c.order}};
  if (!c.usable()) {
    json["pruned"] = c.pruned;
    json["untried"] = c.untried;
    if (c.least_error > 0.0) json["least_error"] = c.least_error;
    return json;
  }
  if (c.adaptive) json["tolerance"] = c.tolerance;
  json.update({{"confidence", name(c.confidence)},
               {"full_length_pilots", c.full_length},
               {"seen_part", number(c.seen_part)},
               {"growth_rate", number(c.growth_rate)},
               {"observed_order", number(c.observed_order)},
               {"stability_limit_h", number(c.limit_h)},
               {"limited_by_stability", c.limited_by_stability},
               {"fewest_steps_tried", c.fewest_steps},
               {"steps", c.steps},
               {"h", c.h},
               {"predicted_error", number(c.predicted_error)},
               {"predicted_seconds", number(c.predicted_s)},
               {"predicted_cost", number(c.predicted_cost)},
               {"predicted_evaluations", number(c.predicted_evaluations)}});
  return json;
}

std::string milliseconds(double s) { return s < 1.0 ? fmt::format("{:.3g} ms", 1e3 * s) : fmt::format("{:.3g} s", s); }

}  // namespace

nlohmann::json json_of(const Recommendation& r, const RecommendedScene* scene) {
  const SceneFeatures& f = r.features;
  nlohmann::json candidates = nlohmann::json::array();
  for (const Candidate& c : r.candidates) candidates.push_back(json_of(c));
  nlohmann::json pick;
  if (const Candidate* c = r.pick()) pick = {{"integrator", c->contender}, {"steps", c->steps}, {"step", c->h}};
  if (scene != nullptr)
    pick.update({{"event_times", scene->file.exact_events ? "exact" : "steps"},
                 {"names_cells", scene->names_cells},
                 {"choice", scene->choice},
                 {"trouble", scene->trouble}});
  return {{"scene", r.scene},
          {"error", r.error},
          {"pick", pick},
          {"features",
           {{"vertices", f.vertices},
            {"springs", f.springs},
            {"pieces", f.pieces},
            {"events", f.events},
            {"omega_low", f.omega_low},
            {"omega_high", f.omega_high},
            {"damping_ratio", f.damping_ratio},
            {"phase", f.phase},
            {"motion_rate", f.motion_rate},
            {"motion_size", f.motion_size},
            {"force_s", f.force_s},
            {"implicit_step_s", number(f.implicit_step_s)}}},
          {"candidates", candidates},
          {"untried", r.untried()},
          {"best_error", {{"error", number(r.best_error)}, {"integrator", r.best_error_by}}},
          {"one_more_digit", {{"cost_ratio", number(r.one_more_digit)}, {"integrator", r.one_more_digit_by}}},
          {"realtime",
           {{"factor", number(r.realtime_factor)}, {"error", number(r.realtime_error)}, {"integrator", r.realtime_by}}},
          {"pilot_s", r.pilot_s}};
}

nlohmann::json json_of(const Audit& a) {
  return {{"error", a.error},
          {"actual_error", number(a.actual_error)},
          {"largest_error", number(a.largest_error)},
          {"predicted_error", number(a.predicted_error)},
          {"met", a.met()},
          {"actual_cost", number(a.actual_cost)},
          {"predicted_cost", number(a.predicted_cost)},
          {"actual_evaluations", number(a.actual_evaluations)},
          {"predicted_evaluations", number(a.predicted_evaluations)},
          {"actual_s", a.actual_s},
          {"best", a.best},
          {"best_cost", number(a.best_cost)},
          {"regret", number(a.regret())}};
}

Table candidates_table(const Recommendation& r) {
  Table table({{"integrator"},
               {"steps", Align::right},
               {"h [ms]", Align::right},
               {"limit of h [ms]", Align::right},
               {"error", Align::right},
               {"cost [evaluations' time]", Align::right},
               {"force evaluations", Align::right},
               {"time", Align::right},
               {"order seen", Align::right},
               {"confidence"}});
  for (const Candidate& c : r.candidates)
    if (c.usable())
      table.add_row({c.contender, fmt::format("{}{}", c.adaptive ? "about " : "", c.steps),
                     fmt::format("{:.4g}", 1e3 * c.h),
                     std::isfinite(c.limit_h) ? fmt::format("{:.4g}", 1e3 * c.limit_h) : "none",
                     fmt::format("{:.1e}", c.predicted_error), fmt::format("{:.0f}", c.predicted_cost),
                     fmt::format("{:.0f}", c.predicted_evaluations), milliseconds(c.predicted_s),
                     c.confidence == Confidence::sufficient ? "-"
                     : c.adaptive                           ? fmt::format("{:.2f} of the tolerance", c.observed_order)
                                                            : fmt::format("{:.2f} of {}", c.observed_order, c.order),
                     fmt::format("{}{}", name(c.confidence), c.full_length ? ", full length" : "")});
  return table;
}

std::string text_of(const Recommendation& r, const RecommendedScene* scene, bool realtime, double duration) {
  const SceneFeatures& f = r.features;
  std::string text = fmt::format(
      "{} with an error of at most {:.3g} edges\n{}, {}; omega_max {:.4g} .. {:.4g} 1/s, "
      "damping ratio there {:.2g}, T omega_max = {:.4g}; a force evaluation takes {:.3g} us here\n\n{}",
      one_line(r.scene), r.error, sizes_in_words(f.vertices, f.springs, f.pieces), counted(f.events, "event"),
      f.omega_low, f.omega_high, f.damping_ratio, f.phase, 1e6 * f.force_s, to_text(candidates_table(r)));
  for (const Candidate& c : r.candidates)
    if (!c.usable() && !c.untried) text += fmt::format("  not {}: {}\n", c.contender, c.pruned);
  if (const auto untried = r.untried(); !untried.empty())
    text += fmt::format(
        "{} of {} methods were not tried for want of time, and another run may pick one of them (--budget SECONDS "
        "grants more): {}\n",
        untried.size(), r.candidates.size(), fmt::join(untried, "; "));
  const Candidate* pick = r.pick();
  if (pick == nullptr)
    return text +
           (std::isfinite(r.best_error)
                ? fmt::format("\nAn error of {:.3g} edges cannot be met in double precision; about {:.1e} is the "
                              "best{}, with {}.\n",
                              r.error, r.best_error, r.untried().empty() ? "" : " of what was tried", r.best_error_by)
                : "\nNothing can be recommended.\n");
  text += fmt::format(
      "\nTake {} with a step of {} s, {}{}: error {:.1e}, {} here (the time of {:.0f} force evaluations; it makes "
      "{:.0f}).\nAn error is the root mean square over the mass, the largest over time; single vertices are farther "
      "off.\n",
      pick->contender, pick->h, counted(pick->steps, "step"),
      pick->limited_by_stability ? ", all that stability allows"
      : pick->fewest_steps       ? ", the fewest steps tried"
                                 : "",
      pick->predicted_error, milliseconds(pick->predicted_s), pick->predicted_cost, pick->predicted_evaluations);
  if (scene != nullptr) {
    text += fmt::format("In the scene file: {}\n", scene->setting());
    if (pick->steps > scene->steps_for_error)
      text += fmt::format("The error takes {}; the events, and the times of loads and output, make them {}.\n",
                          counted(scene->steps_for_error, "step"), pick->steps);
    for (const std::string& sentence : {scene->choice, scene->trouble})
      if (!sentence.empty()) text += sentence + "\n";
    if (scene->names_cells) text += "The scene that --write FILE writes names the cells of the accurate run.\n";
  }
  if (!pick->full_length && pick->seen_part < 1.0)
    text += fmt::format("Its pilots saw {:.2g} % of the motion; the rest is predicted.\n", 100.0 * pick->seen_part);
  if (pick->growth_rate > 0.0)
    text += fmt::format(
        "Errors were seen to grow e-fold in {:.3g} s: the motion is chaotic, and soon no error can be predicted; from "
        "this one to that of an edge it takes {:.3g} s.\n",
        1.0 / pick->growth_rate, max_or_nan(0.0, -std::log(pick->predicted_error)) / pick->growth_rate);
  if (std::isfinite(pick->limit_h)) text += fmt::format("It is stable up to h = {:.4g} s.\n", pick->limit_h);
  // steps of the others are not fitted to the times of the scene
  const bool is_fitted = scene != nullptr && pick->steps > scene->steps_for_error;
  if (const Candidate* second = r.runner_up(); second != nullptr && !is_fitted)
    text += fmt::format("Runner-up: {} with {}, {:.2f} times the cost.\n", second->contender,
                        counted(second->steps, "step"), second->predicted_cost / pick->predicted_cost);
  if (const Candidate* c = r.cheaper_by_tolerance())
    text += fmt::format(
        "A program in which {} chooses its steps, with a tolerance of {:.2e} edges, takes {:.2f} times the cost; "
        "scenes have one step throughout.\n",
        c->make()->scheme().name, c->tolerance, c->predicted_cost / pick->predicted_cost);
  if (!is_fitted)
    text += r.one_more_digit_by.empty() ? "One more digit is beyond double precision, or takes too many steps.\n"
                                        : fmt::format("One more digit costs {:.2f} times as much, with {}.\n",
                                                      r.one_more_digit, r.one_more_digit_by);
  text += fmt::format("The pilots took {}, {:.3g} times the run.\n", milliseconds(r.pilot_s),
                      r.pilot_s / pick->predicted_s);
  if (realtime) {
    text +=
        fmt::format("Real time: {:.4g} s are simulated in {}, {:.2f} times real time{}.\n", duration,
                    milliseconds(pick->predicted_s), r.realtime_factor, r.realtime_factor >= 1.0 ? "" : ": too slow");
    text += std::isfinite(r.realtime_error)
                ? fmt::format("The best that real time allows: an error of {:.1e}, with {}.\n", r.realtime_error,
                              r.realtime_by)
                : std::string("No method is stable in real time.\n");
  }
  return text;
}

Table followed_table(const std::vector<FollowedPick>& picks) {
  Table table({{"scene"},
               {"error", Align::right},
               {"pick"},
               {"actual", Align::right},
               {"largest of a vertex", Align::right},
               {"predicted", Align::right},
               {"met"},
               {"cost [evaluations' time]", Align::right},
               {"predicted/actual", Align::right},
               {"best of the sweep"},
               {"regret", Align::right}});
  for (const auto& [scene, pick, a, is_resolved] : picks)
    table.add_row(
        {scene, fmt::format("{:.3g}", a.error), pick, is_resolved ? fmt::format("{:.2e}", a.actual_error) : "-",
         is_resolved ? fmt::format("{:.2e}", a.largest_error) : "-", fmt::format("{:.2e}", a.predicted_error),
         !is_resolved ? "not judged: below the resolution of the reference"
         : a.met()    ? "yes"
                      : "NO",
         fmt::format("{:.0f}", a.actual_cost), fmt::format("{:.3f}", a.predicted_cost / a.actual_cost),
         a.best.empty() ? "-" : a.best, std::isfinite(a.best_cost) ? fmt::format("{:.2f}", a.regret()) : "-"});
  return table;
}

}  // namespace dartboard
