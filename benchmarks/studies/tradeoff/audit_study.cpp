#include "benchmarks/studies/tradeoff/audit_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "benchmarks/harness/clock.h"
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

Report audit_study(std::uint64_t seed, bool quick, StudyLog& log) {
  AuditCases cases(seed, quick);
  std::vector<AuditedPair> pairs;
  Report report;
  report.numbers = {{"pairs", nlohmann::json::array()}};
  const std::int64_t start = thread_cpu_ns();
  log.begin("audit", cases.size());
  for (std::uint64_t k = 0; k < cases.size(); ++k) {
    const AuditCase drawn = cases.next();
    for (const AuditedPair& p : audit_case(drawn)) {
      log.sample(json_of(p));
      report.numbers["pairs"].push_back(nlohmann::ordered_json(json_of(p)));
      pairs.push_back(p);
    }
    log.advance(drawn.scene.what);
  }
  const double cpu_s = 1e-9 * static_cast<double>(thread_cpu_ns() - start);
  report.facts["cpu_s"] = cpu_s;
  report.tables = {{"scenes", "The scenes", audited_scenes_table(pairs)},
                   {"audit", "Recommendations and what happened", audit_table(pairs), std::string(reading)}};
  report.claims = audit_claims(pairs);
  report.pictures = {{"audit", audit_plot(pairs, fmt::format("{} pairs of an unseen scene and an error, seed {}",
                                                             pairs.size(), seed))}};
  report.sentence = fmt::format("{:.0f} s of processor time. {}", cpu_s, in_words(report.claims));
  return report;
}

}  // namespace dartboard
