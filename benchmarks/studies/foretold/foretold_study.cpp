#include "benchmarks/studies/foretold/foretold_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/foretold/foretold_plan.h"
#include "benchmarks/studies/foretold/foretold_report.h"
#include "validation/scenes/other_codes.h"

namespace dartboard {
namespace {

// Of the smallest error asked for, how far the other codes may be apart; of the dearest pick, how long a run of the
// sweep may take: what takes longer cannot be cheaper, but steps are powers of two.
constexpr double resolved = 0.1, sweep_over_pick = 2.2;
// [s] Nobody waits for longer runs.
constexpr double longest_run_s = 15.0;

WorkPrecision sweep_for(const TradeoffScene& scene, const SceneReference& reference, const std::vector<double>& errors,
                        double dearest_s) {
  WorkPrecisionOptions how;
  how.most_s = sweep_over_pick * dearest_s;
  how.fewest_repetitions = 1;
  how.repetitions_s = 0.02;
  how.enough_error = *std::ranges::min_element(errors);
  how.useful_error = *std::ranges::max_element(errors);
  std::vector<TradeoffContender> all = tradeoff_contenders();
  std::erase_if(all, &TradeoffContender::peer);
  return work_precision(scene, reference, all, thread_cpu_ns, how);
}

std::vector<ForetoldPair> follow(const ForetoldCase& drawn, double budget_s, StudyLog& log) {
  const TradeoffScene& scene = drawn.scene;
  const CpuClock clock = thread_cpu_ns;
  std::vector<Recommendation> all;
  for (const double error : drawn.errors) all.push_back(recommend(scene, error, clock, {.budget_s = budget_s}));
  const SceneReference reference = reference_by_other_codes(scene, resolved * *std::ranges::min_element(drawn.errors));
  log.say(fmt::format("{}: {}", scene.name, reference.what));
  std::vector<ForetoldPair> pairs;
  double dearest_s = 0.0;
  for (const Recommendation& r : all) {
    ForetoldPair p;
    p.scene = scene.name;
    p.what = scene.what;
    p.vertices = scene.motion.network.point_count();
    p.springs = scene.motion.network.springs.size();
    p.omega_phase = scene.duration * scene.fastest_rate;
    p.floor = reference.floor;
    p.audit.error = r.error;
    p.audit.pilot_s = r.pilot_s;
    const Candidate* pick = r.pick();
    if (pick != nullptr && pick->predicted_s > longest_run_s) {
      p.followed = false;
      p.confidence = fmt::format("{} for {:.0f} s: too long to follow", pick->contender, pick->predicted_s);
    } else if (pick != nullptr) {
      p.pick = pick->contender;
      p.confidence = name(pick->confidence);
      p.setting = pick->setting();
      p.seen_part = pick->seen_part;
      p.warned = pick->growth_rate > 0.0;
      p.audit = audit(scene, reference, r, {}, clock, 1);
      if (p.told() && p.audit.met()) dearest_s = std::max(dearest_s, p.audit.actual_s);
    }
    pairs.push_back(std::move(p));
  }
  // where the reference tells no error, a sweep would compare nothing
  if (!(dearest_s > 0.0)) return pairs;
  const WorkPrecision sweep = sweep_for(scene, reference, drawn.errors, dearest_s);
  const std::vector<Winner> best = winners(sweep.points, drawn.errors);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (best[k].contender.empty()) continue;
    pairs[k].audit.best = best[k].contender;
    pairs[k].audit.best_cost = best[k].cost;
  }
  return pairs;
}

constexpr std::string_view reading =
    "Scenes and errors are drawn from the seed. Errors are in mean edge lengths, the largest of eight checkpoints, "
    "against a run in extended precision that another library confirms (scenes.md: how far they differ; ten times that "
    "is what can be judged). Seconds are as recommend prints them, nothing is corrected. 'seen' is the part of the "
    "motion that the longest pilots of the pick ran: the rest is foretold. Counted are runs that cost 20 times their "
    "pilots. Regret is the cost of the pick over that of the cheapest setting of a sweep of all methods, interpolated "
    "between steps; a method ends there when it is as good as the smallest error, when a run takes 2.2 times the "
    "dearest pick, or when it could not come to the largest error in that time.";

}  // namespace

Report foretold_study(std::uint64_t seed, bool quick, StudyLog& log) {
  ForetoldCases cases(seed, quick);
  std::vector<ForetoldPair> pairs;
  Report report;
  report.numbers = {{"pairs", nlohmann::ordered_json::array()}};
  const std::int64_t start = thread_cpu_ns();
  log.begin("audit of long motions", cases.size());
  for (std::uint64_t k = 0; k < cases.size(); ++k) {
    const ForetoldCase drawn = cases.next();
    for (const ForetoldPair& p : follow(drawn, cases.budget_s(), log)) {
      log.sample(json_of(p));
      report.numbers["pairs"].push_back(nlohmann::ordered_json(json_of(p)));
      pairs.push_back(p);
    }
    log.advance(drawn.scene.what);
  }
  const double cpu_s = 1e-9 * static_cast<double>(thread_cpu_ns() - start);
  report.facts["cpu_s"] = cpu_s;
  report.tables = {
      {"scenes", "The scenes", foretold_scenes_table(pairs)},
      {"foretold", "Recommendations for long motions and what happened", foretold_table(pairs), std::string(reading)}};
  report.claims = foretold_claims(pairs);
  report.pictures = {{"foretold", foretold_plot(pairs, fmt::format("{} pairs of a long motion and an error, seed {}",
                                                                   pairs.size(), seed))}};
  report.sentence = fmt::format("{:.0f} s of processor time. {}", cpu_s, in_words(report.claims));
  return report;
}

}  // namespace dartboard
