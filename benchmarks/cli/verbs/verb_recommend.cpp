// dartboard recommend: the cheapest integrator and step for an error, predicted, and audited on request.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/study_names.h"
#include "benchmarks/cli/verbs/verb_recommend.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/tradeoff/recommend_report.h"
#include "core/plain/error.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

struct Options {
  std::string scene;
  std::vector<double> errors;
  bool realtime = false, verify = false, json = false, audit = false;
  AuditOptions auditing;
};

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
    std::vector<FollowedPick> followed;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].pick() == nullptr) continue;
      const Audit a = audit(scene, reference, all[k], sweep.points, clock);
      report[k]["audit"] = json_of(a);
      followed.push_back({all[k].pick()->contender, a, a.error >= reference.floor});
      if (followed.back().misses()) outcome.exit_code = exit_disagrees;
    }
    say("Predicted and actual\n\n" + to_text(followed_table(followed)));
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
