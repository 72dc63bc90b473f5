#include "benchmarks/studies/tradeoff/audit_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/tradeoff/audit_report.h"
#include "validation/recommend/recommended_scene.h"
#include "validation/scenes/other_codes.h"

namespace dartboard {
namespace {

// The largest difference between the other codes, as a part of the smallest requested error.
constexpr double resolved = 0.1;
// [s] Longer runs are not followed.
constexpr double longest_run_s = 15.0;

SceneReference reference_for(AuditKind kind, const AuditCase& drawn) {
  if (kind == AuditKind::long_motions)
    return reference_by_other_codes(drawn.scene, resolved * *std::ranges::min_element(drawn.errors));
  SceneReference none;
  none.floor = std::numeric_limits<double>::infinity();
  if (drawn.check == AuditCheck::costs_only) return none;
  const double oracle_s = drawn.check == AuditCheck::reference_and_sweep ? 30.0 : 2.0;
  return reference_of(drawn.scene, thread_cpu_ns, {.oracle_s = oracle_s, .self_converged_s = 6.0, .gain = false});
}

WorkPrecision sweep_for(AuditKind kind, const AuditCase& drawn, const SceneReference& reference, double dearest_s) {
  WorkPrecisionOptions how;
  how.most_s = longest_sweep_run(dearest_s);
  how.fewest_repetitions = 2;
  how.repetitions_s = 0.02;
  std::vector<TradeoffContender> all = tradeoff_contenders();
  if (kind == AuditKind::long_motions) {
    how.fewest_repetitions = 1;
    how.enough_error = *std::ranges::min_element(drawn.errors);
    how.useful_error = *std::ranges::max_element(drawn.errors);
    std::erase_if(all, &TradeoffContender::peer);
  }
  return work_precision(drawn.scene, reference, all, thread_cpu_ns, how);
}

std::vector<AuditedPair> follow(AuditKind kind, const AuditCase& drawn, StudyLog& log) {
  const auto& [scene, errors, check, budget_s] = drawn;
  const bool is_long = kind == AuditKind::long_motions;
  std::vector<Recommendation> all;
  for (const double error : errors) all.push_back(recommend(scene, error, thread_cpu_ns, {.budget_s = budget_s}));
  const SceneReference reference = reference_for(kind, drawn);
  if (is_long) log.say(fmt::format("{}: {}", scene.name, reference.what));
  std::vector<AuditedPair> pairs;
  double dearest_s = 0.0;  // of those that met their errors: only they are compared with the sweep
  for (Recommendation& r : all) {
    AuditedPair p;
    p.scene = scene.name;
    p.what = scene.what;
    p.reference = check == AuditCheck::costs_only ? "none" : name(reference.kind);
    p.floor = reference.floor;
    p.omega_phase = scene.duration * scene.fastest_rate;
    p.vertices = scene.motion.network.point_count();
    p.springs = scene.motion.network.springs.size();
    p.swept = check == AuditCheck::reference_and_sweep;
    p.audit.error = r.error;
    p.audit.pilot_s = r.pilot_s;
    const Candidate* pick = r.pick();
    if (pick == nullptr && !is_long && budget_s > 0.0) {
      p.followed = false;
      p.confidence = fmt::format("no pilots within {:.0f} s", budget_s);
    } else if (pick != nullptr && pick->predicted_s > longest_run_s) {
      p.followed = false;
      p.confidence = fmt::format("{} for {:.0f} s: too long to follow", pick->contender, pick->predicted_s);
    } else if (pick != nullptr) {
      const RecommendedScene made = recommended_scene(scene, r);  // which fits the pick to the scene
      p.pick = pick->contender;
      p.confidence = fmt::format("{}{}", name(pick->confidence), pick->full_length ? ", full length" : "");
      p.setting = pick->setting();
      p.seen_part = pick->seen_part;
      p.warned = pick->growth_rate > 0.0;
      p.audit = audit(scene, reference, r, {}, thread_cpu_ns, is_long ? 1 : 3);
      if (!reference.states.empty()) {  // the errors of the scene as `simulate` runs it
        const reference::MotionErrors found = errors_of(made, scene, reference);
        p.audit.actual_error = found.x;
        p.audit.largest_error = found.x_largest;
      }
      if (p.is_resolved() && p.audit.met()) dearest_s = std::max(dearest_s, p.audit.actual_s);
    }
    pairs.push_back(std::move(p));
  }
  if (check != AuditCheck::reference_and_sweep || !(dearest_s > 0.0)) return pairs;
  const std::vector<Winner> best = winners(sweep_for(kind, drawn, reference, dearest_s).points, errors);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (best[k].contender.empty()) continue;
    pairs[k].audit.best = best[k].contender;
    pairs[k].audit.best_cost = best[k].cost;
  }
  return pairs;
}

constexpr std::string_view reading =
    "Scenes and errors are drawn from the seed. What is followed is the scene that --write writes, by the road of "
    "`simulate`. Errors are in mean edge lengths, from the reference: root mean squares over the mass, the largest over "
    "time. The seconds that were predicted are the predicted cost in force evaluations times what one takes around the run, so that a machine "
    "that is busier than during the pilots does not count. Regret is the cost of the pick over that of the cheapest "
    "setting of a sweep of all methods, interpolated between steps; the sweep leaves out what takes longer than 2.2 "
    "times the dearest pick of the scene. Some scenes are followed for their costs only; the last ones are those of the gallery, of which those "
    "whose pilots are whole runs have 40 s for the pilots of each error. Runs predicted to take longer than 15 s are not followed.";

constexpr std::string_view reading_of_long_motions =
    "Scenes and errors are drawn from the seed. Errors are in mean edge lengths, the largest of eight checkpoints, "
    "against a run in extended precision that another library confirms (the table of scenes says how far they differ; ten times that "
    "is what can be judged). Seconds are as recommend prints them, nothing is corrected. 'seen' is the part of the "
    "motion that the longest pilots of the pick ran: the rest is predicted. Counted are runs that cost 20 times their "
    "pilots. Regret is the cost of the pick over that of the cheapest setting of a sweep of all methods, interpolated "
    "between steps; a method ends there when it is as good as the smallest error, when a run takes 2.2 times the "
    "dearest pick, or when it could not come to the largest error in that time.";

}  // namespace

Report audit_study(AuditKind kind, std::uint64_t seed, bool quick, const std::vector<std::filesystem::path>& gallery,
                   StudyLog& log) {
  const bool is_long = kind == AuditKind::long_motions;
  AuditCases cases(kind, seed, quick, gallery);
  std::vector<AuditedPair> pairs;
  Report report;
  report.numbers = {{"pairs", nlohmann::ordered_json::array()}};
  const std::int64_t start = thread_cpu_ns();
  log.begin(is_long ? "audit of long motions" : "audit", cases.size());
  for (std::uint64_t k = 0; k < cases.size(); ++k) {
    const AuditCase drawn = cases.next();
    for (const AuditedPair& p : follow(kind, drawn, log)) {
      log.sample(json_of(p));
      report.numbers["pairs"].push_back(nlohmann::ordered_json(json_of(p)));
      pairs.push_back(p);
    }
    log.advance(drawn.scene.what);
  }
  const double cpu_s = 1e-9 * static_cast<double>(thread_cpu_ns() - start);
  report.facts["cpu_s"] = cpu_s;
  const std::string name = is_long ? "long" : "audit";
  report.tables = {
      {"scenes", "The scenes", audited_scenes_table(kind, pairs)},
      {name, is_long ? "Recommendations for long motions and what happened" : "Recommendations and what happened",
       audit_table(kind, pairs), std::string(is_long ? reading_of_long_motions : reading)}};
  report.claims = audit_claims(kind, pairs);
  report.limits = {
      "Which methods are tried depends on timings, so that picks which cost nearly the same change from run to run.",
      "The floor of rounding is calibrated on chains, the paper's body and a damped beam; chaos is not in it.",
      "The reference of the swinging liver is confirmed by a second method of the same library only.",
      "Pilots do not see what happens later: a body that crumples after a cut may miss its error, and one that comes to "
      "rest costs many times what the cheapest method would take."};
  const std::string subtitle = fmt::format("{} pairs of {} and an error, seed {}", pairs.size(),
                                           is_long ? "a long motion" : "an unseen scene", seed);
  report.pictures = {{name, audit_plot(kind, pairs, subtitle)}};
  report.sentence = fmt::format("{:.0f} s of processor time. {}", cpu_s, in_words(report.claims));
  return report;
}

}  // namespace dartboard
