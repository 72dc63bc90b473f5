#include "benchmarks/studies/tradeoff/recommend_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/tradeoff/recommend_report.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {

Report recommend_study(const RecommendPlan& plan, StudyLog& log) {
  const TradeoffScene scene = find_scene(plan.scene, source_folder() / "benchmarks" / "meshes");
  for (const std::string& omission : scene.omissions) log.say(omission);
  const CpuClock clock = thread_cpu_ns;
  Report report{.numbers = nlohmann::ordered_json::array()};
  std::vector<Recommendation> all;
  for (const double error : plan.errors) {
    RecommendOptions options;
    options.budget_s = plan.budget_s;
    options.tells = [&log](const std::string& integrator) { log.advance(integrator); };
    log.begin(fmt::format("short runs for an error of {:g} edges", error), 0);
    all.push_back(recommend(scene, error, clock, options));
    log.say(text_of(all.back(), plan.realtime, scene.duration));
    report.numbers.push_back(nlohmann::ordered_json(json_of(all.back())));
    if (all.back().pick() == nullptr)
      report.disagreements.push_back(fmt::format("No method is recommended for an error of {:g} edges.", error));
    else if (plan.realtime && all.back().realtime_factor < 1.0)
      report.disagreements.push_back(
          fmt::format("An error of {:g} edges is not met as fast as the motion itself.", error));
  }
  if (plan.verify) {
    log.say(fmt::format("computing a reference: runs of up to {:.0f} s each", ReferenceOptions{}.oracle_s));
    const SceneReference reference = reference_of(scene, clock, {.gain = false});
    log.say(
        fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", reference.what, reference.floor, reference.cpu_s));
    // for all methods, no longer than a few times the longest pick; methods that cannot reach the largest error are
    // abandoned
    double longest = 0.05;
    for (const Recommendation& r : all)
      if (r.pick() != nullptr) longest = std::max(longest, 3.0 * r.pick()->predicted_s);
    std::vector<TradeoffContender> contenders = tradeoff_contenders();
    std::erase_if(contenders, &TradeoffContender::peer);
    WorkPrecisionOptions how;
    how.most_s = longest;
    how.fewest_repetitions = 2;
    how.repetitions_s = 0.1;
    how.useful_error = *std::ranges::max_element(plan.errors);
    log.begin(fmt::format("sweep of {} methods", contenders.size()), 0);
    const WorkPrecision sweep = work_precision(scene, reference, contenders, clock, how,
                                               [&log](const WorkPoint& p) { log.advance(p.contender); });
    std::vector<FollowedPick> followed;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].pick() == nullptr) continue;
      const Audit a = audit(scene, reference, all[k], sweep.points, clock);
      report.numbers[k]["audit"] = json_of(a);
      followed.push_back({all[k].pick()->contender, a, a.error >= reference.floor});
      if (followed.back().misses())
        report.disagreements.push_back(fmt::format("The pick for an error of {:g} edges misses it.", a.error));
    }
    report.tables = {{"", "Predicted and actual", followed_table(followed)}};
  }
  return report;
}

}  // namespace dartboard
