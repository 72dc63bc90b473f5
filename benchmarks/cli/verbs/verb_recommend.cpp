#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/studies/study_names.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/models/model_advice_study.h"
#include "benchmarks/studies/tradeoff/audit_study.h"
#include "benchmarks/studies/tradeoff/recommend_study.h"
#include "core/base/counted.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

struct RecommendOptions : StudyOptions {
  RecommendPlan plan;
  std::string against;
  bool audit = false, long_motions = false;
};

void recommend_model(const RecommendOptions& options, Outcome& outcome) {
  if (options.plan.scenes.size() > 1)
    throw InputError(fmt::format("--against: {} scenes are given; expected one", options.plan.scenes.size()));
  const std::string& given = options.plan.scenes.at(0);
  const ModelsPlan plan =
      models_plan(given == "cantilever" ? given : scene_file(given, std::vector<std::string>{"cantilever"}).string());
  run_study(
      options, {.label = "recommend", .keeps_folder = false},
      [&](StudyLog& log) { return model_advice_study(plan, options.plan.errors, log); }, outcome);
}

void recommend_verb(const RecommendOptions& options, Outcome& outcome) {
  RecommendPlan plan = options.plan;
  if (options.audit) {
    if (!plan.scenes.empty() || !plan.errors.empty())
      throw InputError("--audit draws its scenes and errors itself: give neither SCENE nor --error");
    const auto kind = options.long_motions ? AuditKind::long_motions : AuditKind::scenes;
    const auto gallery = options.long_motions || options.quick ? std::vector<std::filesystem::path>() : gallery_files();
    run_study(
        options,
        {.label = "recommend", .facts = {.seeds = {{"scenes and errors", options.seed}}, .input_files = gallery}},
        [&](StudyLog& log) { return audit_study(kind, options.seed, options.quick, gallery, log); }, outcome);
    return;
  }
  if (plan.scenes.empty() || plan.errors.empty()) throw InputError("give a SCENE and an --error, or --audit");
  if (!options.against.empty()) return recommend_model(options, outcome);
  if (!options.out.empty() && !plan.verify) throw InputError("--out: expected --verify or --audit with it");
  for (std::string& scene : plan.scenes) scene = study_scene_or_file(scene);
  if (!plan.write.empty() && (plan.errors.size() > 1 || plan.scenes.size() > 1))
    throw InputError(fmt::format("--write: {} and {} are given; expected one of each",
                                 counted(plan.scenes.size(), "scene"), counted(plan.errors.size(), "error")));
  if (!plan.write.empty() && !plan.scenes[0].ends_with(".json"))
    throw InputError(fmt::format("--write: '{}' has no scene file; expected a scene that has one", plan.scenes[0]));
  run_study(
      options, {.label = "recommend", .keeps_folder = false}, [&](StudyLog& log) { return recommend_study(plan, log); },
      outcome);
}

}  // namespace

void add_recommend(CLI::App& app, Outcome& outcome) {
  auto* verb = app.get_subcommand("recommend");
  auto options =
      study_options<RecommendOptions>(*verb, {.quick = "audit a few small scenes only",
                                              .seed = "the audit",
                                              .out = "folder of --verify or of the audit, new or empty [of the audit: "
                                                     "dartboard-results/recommend-TIME]"});
  verb->add_option("SCENE", options->plan.scenes,
                   "scene files (.json), names of the gallery, or some of " + study_scene_names());
  verb->add_option("--error", options->plan.errors,
                   "largest error of positions, in mean edge lengths: the root mean square over the mass, at the time "
                   "at which it is largest; single vertices may be several times farther off. Several may be given")
      ->check(positive_number());
  auto* against =
      verb->add_option("--against", options->against,
                       "truth: compared with converged quadratic elements, of a scene whose box is held at one end, "
                       "or of 'cantilever'; errors are then shares of how far it is bent, over one period")
          ->check(CLI::IsMember({"truth"}));
  verb->add_option("--budget", options->plan.budget_s,
                   "seconds that the pilots of a recommendation may take [0.5 and a tenth of the run]")
      ->check(positive_number());
  verb->add_flag("--realtime", options->plan.realtime,
                 "say whether that is as fast as the motion itself, and what would be");
  auto* write = verb->add_option(
      "--write", options->plan.write,
      "a new file for the scene with that integrator and step, which `simulate` then runs with that error");
  verb->add_flag("--verify", options->plan.verify,
                 "run that scene as `simulate` does, against the oracle, and a sweep of all methods");
  auto* audit = verb->add_flag(
      "--audit", options->audit,
      "follow the recommendations for scenes and errors drawn from a seed, and say what they were worth");
  verb->add_flag("--long", options->long_motions,
                 "audit long motions, of which the pilots take a twentieth of the run's time and see some thousandths");
  for (const char* of_the_audit : {"--seed", "--quick", "--long"}) verb->get_option(of_the_audit)->needs(audit);
  audit->excludes(write);
  for (const char* of_one_model : {"--budget", "--realtime", "--verify", "--write", "--audit", "--out"})
    against->excludes(verb->get_option(of_one_model));
  verb->callback([options, &outcome] { recommend_verb(*options, outcome); });
}

}  // namespace dartboard
