#include "benchmarks/studies/tradeoff/tradeoff_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/tradeoff/tradeoff_json.h"
#include "benchmarks/studies/tradeoff/tradeoff_report.h"
#include "benchmarks/studies/tradeoff/tradeoff_tables.h"
#include "benchmarks/studies/tradeoff/work_precision_plot.h"
#include "core/base/escape.h"
#include "core/plain/error.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

/// The contenders that take part.
///
/// throws  InputError for an unknown name
std::vector<TradeoffContender> contenders_of(const TradeoffPlan& plan) {
  std::vector<TradeoffContender> contenders = tradeoff_contenders(plan.solvers);
  std::string known;
  for (const TradeoffContender& c : contenders) known += fmt::format("{}'{}'", known.empty() ? "" : ", ", c.name);
  for (const std::string& name : plan.only)
    if (std::ranges::find(contenders, name, &TradeoffContender::name) == contenders.end())
      throw InputError(fmt::format("--only: no integrator '{}' takes part; expected some of {}", name, known));
  if (!plan.only.empty())
    std::erase_if(contenders,
                  [&](const TradeoffContender& c) { return std::ranges::find(plan.only, c.name) == plan.only.end(); });
  return contenders;
}

Report study_scene(const std::string& scene_name, const TradeoffPlan& plan, StudyLog& log) {
  const TradeoffScene scene = find_scene(scene_name, source_folder() / "benchmarks" / "meshes");
  log.say(fmt::format("{}: {}; T omega_max = {:.4g}", one_line(scene.name), one_line(scene.what, 400),
                      scene.duration * scene.fastest_rate));
  const CpuClock clock = thread_cpu_ns;
  const ReferenceOptions effort{
      .oracle_s = plan.quick ? 6.0 : 60.0, .self_converged_s = plan.quick ? 4.0 : 40.0, .gain = !plan.quick};
  log.say(fmt::format("computing a reference: runs of up to {:.0f} s each",
                      std::max(effort.oracle_s, effort.self_converged_s)));
  const SceneReference reference = reference_of(scene, clock, effort);
  log.say(fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", reference.what, reference.floor, reference.cpu_s));

  WorkPrecisionOptions how;
  how.seed = plan.seed;
  how.most_s = plan.most_s > 0.0 ? plan.most_s : plan.quick ? 0.4 : 8.0;
  if (plan.quick) {
    how.fewest_repetitions = 2;
    how.repetitions_s = 0.05;
  }
  const auto contenders = contenders_of(plan);
  log.begin(fmt::format("runs of {} methods", contenders.size()), 0);
  WorkPrecision study = work_precision(scene, reference, contenders, clock, how, [&](const WorkPoint& p) {
    log.sample(json_of(scene.name, p));
    log.advance(p.contender);
  });
  if (reference.gain > 0.0) log.say(fmt::format("a small disturbance grows by {:.3g}", reference.gain));
  if (!plan.solvers)
    study.omissions.emplace_back(
        "Implicit methods solve with a kept factor only; --solvers adds fresh factors and conjugate gradients.");
  study.omissions.emplace_back(
      "Steps are powers of two of the distance of checkpoints; the largest stable step lies "
      "up to a factor of two above the largest tried.");
  study.omissions.emplace_back("No multirate, exponential or multigrid method takes part.");

  const std::string stem = file_name_of(scene.name);  // the name of the files
  Report report;
  report.tables = {
      {stem, "The cheapest method for an error", winners_table(study),
       fmt::format("{}; T omega_max = {:.4g}; {}. Reference: {}; errors below {:.1e} edges say nothing.", study.what,
                   study.duration * study.fastest_rate, sizes_in_words(study.vertices, study.springs, study.pieces),
                   study.reference.what, study.reference.floor)},
      {stem + "-regrets", "Regret of a fixed choice", regrets_table(study)},
      {.name = stem + "-runs",
       .heading = "All runs",
       .table = points_table(study),
       .note = reading_of_costs(),
       .on_page = true}};
  for (const std::string& omission : study.omissions) report.limits.push_back(scene.name + ": " + omission);
  report.pictures = {{stem, work_precision_plot(study)}};
  report.numbers = summary_of(study);
  if (const std::string trouble = trouble_of(study); !trouble.empty()) report.disagreements.push_back(trouble);
  return report;
}

}  // namespace

void check_tradeoff(const TradeoffPlan& plan) { contenders_of(plan); }

Report tradeoff_study(const TradeoffPlan& plan, StudyLog& log) {
  check_tradeoff(plan);
  nlohmann::ordered_json summaries = nlohmann::ordered_json::array();
  for (const std::string& scene : plan.scenes) {
    const Report found = study_scene(scene, plan, log);
    log.finished(found);
    summaries.push_back(found.numbers);
  }
  return {.data_files = {{"winners.json", summaries}}, .numbers = {{"scenes", summaries}}};
}

}  // namespace dartboard
