// dartboard recommend --audit: unseen scenes, their recommendations, and what happens when they are followed.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/verbs/verb_recommend.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/tradeoff/audit_plan.h"
#include "benchmarks/studies/tradeoff/audit_report.h"

namespace dartboard {
namespace {

std::vector<AuditedPair> audit_case(const AuditCase& drawn) {
  const auto& [scene, errors, check] = drawn;
  const CpuClock clock = thread_cpu_ns;
  std::vector<Recommendation> all;
  double longest = 0.0;
  for (const double error : errors) {
    all.push_back(recommend(scene, error, clock));
    if (const Candidate* pick = all.back().pick()) longest = std::max(longest, pick->predicted_s);
  }
  SceneReference reference;
  reference.floor = std::numeric_limits<double>::infinity();
  if (check != AuditCheck::costs_only)
    reference = reference_of(
        scene, clock,
        {.oracle_s = check == AuditCheck::reference_and_sweep ? 30.0 : 2.0, .self_converged_s = 6.0, .gain = false});
  WorkPrecision sweep;
  const bool sweep_too = check == AuditCheck::reference_and_sweep;
  if (sweep_too) {
    WorkPrecisionOptions how;
    how.most_s = longest_sweep_run(longest);
    how.fewest_repetitions = 2;
    how.repetitions_s = 0.02;
    sweep = work_precision(scene, reference, tradeoff_contenders(), clock, how);
  }
  std::vector<AuditedPair> pairs;
  for (const Recommendation& r : all) {
    AuditedPair p;
    p.scene = scene.name;
    p.what = scene.what;
    p.reference = check == AuditCheck::costs_only ? "none" : name(reference.kind);
    p.floor = reference.floor;
    p.omega_phase = scene.duration * scene.fastest_rate;
    p.vertices = scene.motion.network.point_count();
    p.springs = scene.motion.network.springs.size();
    p.swept = sweep_too;
    p.audit.error = r.error;
    if (const Candidate* pick = r.pick()) {
      p.pick = pick->contender;
      p.confidence = fmt::format("{}{}", name(pick->confidence), pick->full_length ? ", full length" : "");
      p.setting = pick->setting();
      p.audit = audit(scene, reference, r, sweep.points, clock);
    }
    pairs.push_back(std::move(p));
  }
  return pairs;
}

constexpr std::string_view reading =
    "Scenes and errors are drawn from the seed. Errors are in mean edge lengths, from the reference. The seconds that "
    "were predicted are the predicted cost in force evaluations times what one takes around the run, so that a machine "
    "that is busier than during the pilots does not count. Regret is the cost of the pick over that of the cheapest "
    "setting of a sweep of all methods, interpolated between steps; the sweep leaves out what takes longer than 2.2 "
    "times the dearest pick of the scene. The last scenes are followed for their costs only.";

}  // namespace

void audit_recommendations(const AuditOptions& options, Outcome& outcome) {
  const auto say = [&](const std::string& text) {
    tell(options.json ? stderr : stdout, "{}\n", text);
    std::fflush(options.json ? stderr : stdout);
  };
  const RunFolder folder(run_path(options.out, "recommend"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"scenes and errors", options.seed}};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);
  auto samples = folder.json_lines("samples.jsonl");

  AuditCases cases(options.seed, options.quick);
  std::vector<AuditedPair> pairs;
  const std::int64_t start = thread_cpu_ns();
  {
    Progress progress("audit", cases.size(), options.json);
    for (std::uint64_t k = 0; k < cases.size(); ++k) {
      const AuditCase drawn = cases.next();
      for (const AuditedPair& p : audit_case(drawn)) {
        samples.append(json_of(p));
        pairs.push_back(p);
      }
      progress.advance(drawn.scene.what);
    }
  }
  const double cpu_s = 1e-9 * static_cast<double>(thread_cpu_ns() - start);
  manifest["cpu_s"] = cpu_s;
  const std::vector<Claim> claims = audit_claims(pairs);
  const Table table = audit_table(pairs);
  const Table scenes = audited_scenes_table(pairs);
  folder.write_claims(claims);
  folder.write_table("audit", "Recommendations and what happened", table, reading);
  folder.write_table("scenes", "The scenes", scenes);
  const std::string trouble = draw(
      audit_plot(pairs, fmt::format("{} pairs of an unseen scene and an error, seed {}", pairs.size(), options.seed)),
      folder.path(), "audit");
  if (!trouble.empty()) say(trouble);
  finish_manifest(manifest);
  folder.write_manifest(manifest);

  say(to_text(scenes) + "\n" + to_text(table) + "\n" + to_text(claims));
  say(fmt::format("{:.0f} s of processor time. Written to {}.", cpu_s, folder.path().string()));
  if (options.json) {
    nlohmann::json report{{"claims", claims}, {"pairs", nlohmann::json::array()}, {"manifest", manifest}};
    for (const AuditedPair& p : pairs) report["pairs"].push_back(json_of(p));
    tell("{}\n", json_text(report, 2));
  }
  outcome.exit_code = exit_code(claims);
  picture_missing(outcome, trouble);
}

}  // namespace dartboard
