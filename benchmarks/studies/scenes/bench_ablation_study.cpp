#include "benchmarks/studies/scenes/bench_ablation_study.h"

#include <fmt/format.h>

#include <map>
#include <string>

#include "benchmarks/studies/scenes/ablation_study.h"
#include "benchmarks/studies/scenes/bench_ablation_report.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

/// Bytes reported by the built objects, part by part, independent of any plan.
std::map<std::string, AblationBytes> bytes_of_variants() {
  std::map<std::string, AblationBytes> all;
  for (const AblationVariant& variant : ablation_variants()) {
    const CellCounts counts = Simulation(variant.scene).body().counts();
    const MemoryReport report = measured_memory(variant.scene);
    AblationBytes bytes{.tetrahedra = counts.cells,
                        .springs = counts.edges,
                        .not_asked_for = bytes_not_asked_for(report),
                        .damping = bytes_of_damping(report, counts.edges)};
    for (const MemoryItem& item : report) bytes.total += item.bytes;
    all[variant.name] = bytes;
  }
  return all;
}

}  // namespace

Report ablation_bench(const AblationBenchPlan& plan, StudyLog& log) {
  const int processes = plan.quick ? 6 : 11, rounds = plan.quick ? 3 : 12, steps = plan.quick ? 20 : 60;
  AblationFigures results{.samples = {}, .bytes = bytes_of_variants(), .steps = steps};
  log.say(fmt::format("{} scenes and {} loops, {} steps each time, in {} processes", results.bytes.size(), 5, steps,
                      processes));
  log.begin("timing", static_cast<std::size_t>(processes));
  for (int process = 0; process < processes; ++process) {
    log.measure({"measure-ablation", "--process", std::to_string(process), "--rounds", std::to_string(rounds),
                 "--steps", std::to_string(steps), "--seed", std::to_string(plan.seed)},
                [&](const nlohmann::json& json) { results.samples.push_back(json.get<Sample>()); });
    log.advance();
  }
  check_repeats(results.samples);
  std::vector<Claim> claims = claims_of(results);
  for (Claim& claim : claims)
    if (plan.quick && claim.id.ends_with("-time") && claim.verdict == Verdict::falls_short) {
      claim.verdict = Verdict::undecided;
      claim.reason = fmt::format("{} short processes cannot judge half a per cent: leave out --quick", processes);
    }
  return {.tables = {{"features", "Features on and off", features_table(results), features_note()},
                     {"staircase", "The bare scene, with less and less around its loop", staircase_table(results)},
                     {"output", "A scene with its output, from its first step to its last", output_table(results)}},
          .claims = std::move(claims),
          .pictures = {{"ablation", ablation_plot(results)}}};
}

}  // namespace dartboard
