// dartboard recommend: the cheapest integrator and step for an error, predicted, and audited on request.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/json_number.h"
#include "benchmarks/json_text.h"
#include "benchmarks/study_names.h"
#include "benchmarks/table.h"
#include "benchmarks/tell.h"
#include "benchmarks/verb_recommend.h"
#include "core/plain/error.h"
#include "validation/recommendation_audit.h"
#include "validation/scene_of_file.h"

namespace dartboard {
namespace {

struct Options {
  std::string scene;
  std::vector<double> errors;
  bool realtime = false, verify = false, json = false, audit = false;
  AuditOptions auditing;
};

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

nlohmann::json json_of(const Recommendation& r) {
  const SceneFeatures& f = r.features;
  nlohmann::json candidates = nlohmann::json::array();
  for (const Candidate& c : r.candidates) candidates.push_back(json_of(c));
  return {{"scene", r.scene},
          {"error", r.error},
          {"features",
           {{"vertices", f.vertices},
            {"springs", f.springs},
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

std::string milliseconds(double s) { return s < 1.0 ? fmt::format("{:.3g} ms", 1e3 * s) : fmt::format("{:.3g} s", s); }

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

std::string text_of(const Recommendation& r, bool realtime, double duration) {
  const SceneFeatures& f = r.features;
  std::string text = fmt::format(
      "{} with an error of at most {:.0e} edges\n{} vertices, {} springs, {} events; omega_max {:.4g} .. {:.4g} 1/s, "
      "damping ratio there {:.2g}, T omega_max = {:.4g}; a force evaluation takes {:.3g} us here\n\n{}",
      one_line(r.scene), r.error, f.vertices, f.springs, f.events, f.omega_low, f.omega_high, f.damping_ratio, f.phase,
      1e6 * f.force_s, to_text(candidates_table(r)));
  for (const Candidate& c : r.candidates)
    if (!c.usable()) text += fmt::format("  not {}: {}\n", c.contender, c.pruned);
  if (const auto untried = r.untried(); !untried.empty())
    text += fmt::format("{} of {} methods were not tried for want of time, and another run may pick one of them: {}\n",
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
      "\nTake {} with {}{}: error {:.1e}, {} here (the time of {:.0f} force evaluations; it makes {:.0f}).\n",
      pick->contender,
      pick->adaptive ? fmt::format("a tolerance of {:.2e} edges, about {} steps", pick->tolerance, pick->steps)
                     : fmt::format("h = {:.4g} s, {} steps", pick->h, pick->steps),
      pick->limited_by_stability ? ", all that stability allows"
      : pick->fewest_steps       ? ", the fewest steps tried"
                                 : "",
      pick->predicted_error, milliseconds(pick->predicted_s), pick->predicted_cost, pick->predicted_evaluations);
  if (std::isfinite(pick->limit_h)) text += fmt::format("It is stable up to h = {:.4g} s.\n", pick->limit_h);
  if (const Candidate* second = r.runner_up())
    text += fmt::format("Runner-up: {} with h = {:.4g} s, {:.2f} times the cost.\n", second->contender, second->h,
                        second->predicted_cost / pick->predicted_cost);
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

void recommend_verb(const Options& options, Outcome& outcome) {
  if (options.audit) {
    if (!options.scene.empty() || !options.errors.empty())
      throw InputError("--audit draws its scenes and errors itself: give neither SCENE nor --error");
    AuditOptions auditing = options.auditing;
    auditing.json = options.json;
    audit_recommendations(auditing, outcome);
    return;
  }
  if (options.scene.empty() || options.errors.empty()) throw InputError("give a SCENE and an --error, or --audit");
  const auto say = [&](const std::string& text) {
    tell(options.json ? stderr : stdout, "{}\n", text);
    std::fflush(options.json ? stderr : stdout);
  };
  const TradeoffScene scene = find_scene(study_scene_or_file(options.scene),
                                         std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes");
  for (const std::string& omission : scene.omissions) say(omission);
  const CpuClock clock = thread_cpu_ns;
  nlohmann::json report = nlohmann::json::array();
  std::vector<Recommendation> all;
  for (const double error : options.errors) {
    all.push_back(recommend(scene, error, clock));
    say(text_of(all.back(), options.realtime, scene.duration));
    report.push_back(json_of(all.back()));
    if (all.back().pick() == nullptr || (options.realtime && all.back().realtime_factor < 1.0))
      outcome.exit_code = exit_disagrees;
  }
  if (options.verify) {
    const SceneReference reference = reference_of(scene, clock, {.gain = false});
    say(fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", reference.what, reference.floor, reference.cpu_s));
    // the sweep: everything that was not left out for some error, no longer than a few times the longest pick
    double longest = 0.05;
    std::vector<TradeoffContender> contenders;
    for (const Recommendation& r : all) {
      if (r.pick() != nullptr) longest = std::max(longest, 3.0 * r.pick()->predicted_s);
      for (const TradeoffContender& c : tradeoff_contenders()) {
        const auto usable = [&](const Candidate& candidate) {
          return candidate.contender == c.name && candidate.usable();
        };
        if (std::ranges::any_of(r.candidates, usable) &&
            std::ranges::find(contenders, c.name, &TradeoffContender::name) == contenders.end())
          contenders.push_back(c);
      }
    }
    WorkPrecisionOptions how;
    how.most_s = longest;
    how.fewest_repetitions = 2;
    how.repetitions_s = 0.1;
    const WorkPrecision sweep = work_precision(scene, reference, contenders, clock, how);
    Table table({{"error", Align::right},
                 {"pick"},
                 {"actual", Align::right},
                 {"predicted", Align::right},
                 {"met"},
                 {"cost [evaluations' time]", Align::right},
                 {"predicted/actual", Align::right},
                 {"best of the sweep"},
                 {"regret", Align::right}});
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].pick() == nullptr) continue;
      const Audit a = audit(scene, reference, all[k], sweep.points, clock);
      report[k]["audit"] = json_of(a);
      const bool told = a.error >= reference.floor;
      if (told && !a.met()) outcome.exit_code = exit_disagrees;
      table.add_row({fmt::format("{:.0e}", a.error), all[k].pick()->contender,
                     told ? fmt::format("{:.2e}", a.actual_error) : "-", fmt::format("{:.2e}", a.predicted_error),
                     !told     ? "not judged: the reference is no better than that"
                     : a.met() ? "yes"
                               : "NO",
                     fmt::format("{:.0f}", a.actual_cost), fmt::format("{:.3f}", a.predicted_cost / a.actual_cost),
                     a.best.empty() ? "-" : a.best,
                     std::isfinite(a.best_cost) ? fmt::format("{:.2f}", a.regret()) : "-"});
    }
    say("Predicted and actual\n\n" + to_text(table));
  }
  if (options.json) tell("{}\n", json_text(report, 2));
}

}  // namespace

void add_recommend(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand(
      "recommend", "The cheapest integrator and step for an error, predicted from short runs of the scene.");
  std::string known;
  for (const TradeoffEntry& entry : tradeoff_scenes())
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  verb->add_option("SCENE", options->scene, "a scene file (.json), the name of one of the gallery, or one of " + known);
  verb->add_option("--error", options->errors, "largest error of positions, in mean edge lengths; several may be given")
      ->check(positive_number());
  verb->add_flag("--realtime", options->realtime,
                 "say whether that is as fast as the motion itself, and what would be");
  verb->add_flag("--verify", options->verify, "run it, against the oracle and a sweep of all methods");
  auto* audit = verb->add_flag(
      "--audit", options->audit,
      "follow the recommendations for scenes and errors drawn from a seed, and say what they were worth");
  verb->add_option("--seed", options->auditing.seed, "of the audit [1]")->needs(audit);
  verb->add_flag("--quick", options->auditing.quick, "audit a few small scenes only")->needs(audit);
  verb->add_option("--out", options->auditing.out,
                   "folder of the audit, new or empty [dartboard-results/recommend-TIME]")
      ->needs(audit);
  verb->add_flag("--json", options->json, "print the report as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { recommend_verb(*options, outcome); });
}

}  // namespace dartboard
