#include "benchmarks/studies/tradeoff/recommend_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/tradeoff/recommend_report.h"
#include "core/scene/recorded_run.h"
#include "core/scene/survey/scene_warnings.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

/// A recommendation, and the scene of its pick where the study has a file.
struct Advice {
  Recommendation recommendation;
  std::optional<RecommendedScene> scene;
};

/// Says what `simulate` warns of before the first step, without the step, which is to be chosen.
/// throws  InputError for a scene that `simulate` refuses
void say_warnings(const std::string& file, StudyLog& log) {
  SceneFile scene = read_scene(std::filesystem::path(file));
  if (scene.accuracy) return;  // it has no step yet
  const RecordedRun run(std::move(scene));
  for (const std::string& warning : warnings_but_of_step(run.scene(), run.survey(), run.simulation()))
    log.say("warning: " + warning);
}

std::vector<Advice> advise(const TradeoffScene& scene, bool has_file, const RecommendPlan& plan, StudyLog& log,
                           Report& report) {
  std::vector<Advice> all;
  for (const double error : plan.errors) {
    RecommendOptions options;
    options.budget_s = plan.budget_s;
    options.tells = [&log](const std::string& integrator) { log.advance(integrator); };
    log.begin(fmt::format("short runs for an error of {:g} edges", error), 0);
    all.push_back({recommend(scene, error, thread_cpu_ns, options), std::nullopt});
    Recommendation& r = all.back().recommendation;
    const RecommendedScene* made = nullptr;
    if (has_file && r.pick() != nullptr) made = &all.back().scene.emplace(recommended_scene(scene, r));
    log.say(text_of(r, made, plan.realtime, scene.duration));
    report.numbers.push_back(nlohmann::ordered_json(json_of(r, made)));
    if (made != nullptr && !made->trouble.empty()) report.disagreements.push_back(made->trouble);
    if (made != nullptr && !plan.write.empty()) {
      write_scene(*made, plan.write);
      log.say(fmt::format("{} is written: the scene with that setting, for `dartboard simulate`.", plan.write));
    }
    if (r.pick() == nullptr)
      report.disagreements.push_back(fmt::format("No method is recommended for an error of {:g} edges.", error));
    else if (plan.realtime && r.realtime_factor < 1.0)
      report.disagreements.push_back(
          fmt::format("An error of {:g} edges is not met as fast as the motion itself.", error));
  }
  return all;
}

/// Follows the picks; their audits are added to the last numbers of the report.
std::vector<FollowedPick> verify(const TradeoffScene& scene, const std::vector<Advice>& all, StudyLog& log,
                                 Report& report) {
  log.say(fmt::format("computing a reference: runs of up to {:.0f} s each", ReferenceOptions{}.oracle_s));
  const CpuClock clock = thread_cpu_ns;
  const SceneReference reference = reference_of(scene, clock, {.gain = false});
  log.say(fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", reference.what, reference.floor, reference.cpu_s));
  // for all methods, no longer than a few times the longest pick; methods that cannot reach the largest error are
  // abandoned
  double longest = 0.05, largest_error = 0.0;
  for (const Advice& advice : all) {
    const Recommendation& r = advice.recommendation;
    largest_error = std::max(largest_error, r.error);
    if (r.pick() != nullptr) longest = std::max(longest, 3.0 * r.pick()->predicted_s);
  }
  std::vector<TradeoffContender> contenders = tradeoff_contenders();
  std::erase_if(contenders, &TradeoffContender::peer);
  WorkPrecisionOptions how;
  how.most_s = longest;
  how.fewest_repetitions = 2;
  how.repetitions_s = 0.1;
  how.useful_error = largest_error;
  log.begin(fmt::format("sweep of {} methods", contenders.size()), 0);
  const WorkPrecision sweep = work_precision(scene, reference, contenders, clock, how,
                                             [&log](const WorkPoint& p) { log.advance(p.contender); });
  std::vector<FollowedPick> followed;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Recommendation& r = all[k].recommendation;
    if (r.pick() == nullptr) continue;
    Audit a = audit(scene, reference, r, sweep.points, clock);
    if (all[k].scene) {  // the errors of the scene as `simulate` runs it
      const reference::MotionErrors errors = errors_of(*all[k].scene, scene, reference);
      a.actual_error = errors.x;
      a.largest_error = errors.x_largest;
    }
    nlohmann::ordered_json& numbers = report.numbers[report.numbers.size() - all.size() + k];
    numbers["audit"] = json_of(a);
    log.sample(numbers);
    followed.push_back({scene.name, r.pick()->contender, a, a.error >= reference.floor});
    if (followed.back().misses())
      report.disagreements.push_back(
          fmt::format("{}: the pick for an error of {:g} edges misses it.", scene.name, a.error));
  }
  return followed;
}

}  // namespace

Report recommend_study(const RecommendPlan& plan, StudyLog& log) {
  if (!plan.write.empty()) require_new(plan.write);
  Report report{.numbers = nlohmann::ordered_json::array()};
  std::vector<FollowedPick> followed;
  for (const std::string& name : plan.scenes) {
    if (name.ends_with(".json")) say_warnings(name, log);
    const TradeoffScene scene = find_scene(name, source_folder() / "benchmarks" / "meshes");
    for (const std::string& omission : scene.omissions) log.say("In the pilots: " + omission);
    const std::vector<Advice> all = advise(scene, name.ends_with(".json"), plan, log, report);
    if (!plan.verify) continue;
    for (FollowedPick& pick : verify(scene, all, log, report)) followed.push_back(std::move(pick));
  }
  if (plan.verify) report.tables = {{"verdicts", "Promised and found", followed_table(followed)}};
  return report;
}

}  // namespace dartboard
