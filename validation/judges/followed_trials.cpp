#include "validation/judges/followed_trials.h"

#include <fmt/format.h>

#include <limits>

#include "core/plain/nan_maximum.h"
#include "reference/error_norms.h"
#include "validation/recommend/recommend.h"

namespace dartboard {
namespace {

/// Equal up to a rounding of the largest coordinate in each step.
bool same_run(const TimedRun& a, const TimedRun& b) {
  if (a.states.size() != b.states.size()) return false;
  double largest = 0.0, apart = 0.0;
  for (std::size_t c = 0; c < a.states.size(); ++c)
    for (std::size_t i = 0; i < a.states[c].x.size(); ++i) {
      largest = max_or_nan(largest, a.states[c].x[i].cwiseAbs().maxCoeff());
      apart = max_or_nan(apart, (a.states[c].x[i] - b.states[c].x[i]).cwiseAbs().maxCoeff());
    }
  return apart <= std::numeric_limits<double>::epsilon() * static_cast<double>(a.work.steps + 4) * largest;
}

}  // namespace

std::vector<JudgeTrial> try_followed(const TradeoffScene& scene, const SceneReference& reference,
                                     std::span<const IntegratorEntry> methods, double error, const CpuClock& clock) {
  std::vector<JudgeTrial> trials;
  for (const WrongIntegrator& wrong : wrong_integrators())
    trials.push_back({"recommend --verify", scene.name, wrong.kind});
  const auto error_of = [&](const TimedRun& run) {
    return run.result.ok() ? reference::motion_errors(scene.motion, run.states, reference.states).x
                           : std::numeric_limits<double>::infinity();
  };
  for (const IntegratorEntry& entry : methods) {
    const Recommendation r =
        recommend(scene, error, clock, {.most_steps = 1e5, .adaptive = false, .only = std::string(entry.name)});
    if (r.pick() == nullptr) continue;
    const RunSetting setting = r.pick()->setting();
    const TimedRun sound = run_timed(scene, *entry.make(), setting, clock);
    if (!(error_of(sound) <= error)) continue;
    for (JudgeTrial& trial : trials) {
      const TimedRun wrong = run_timed(scene, *make_wrong(trial.kind, entry.name), setting, clock);
      ++trial.right;
      if (const double missed = error_of(wrong); !(missed <= error))
        ++trial.seen;
      else if (same_run(sound, wrong))
        ++trial.same;
      else
        trial.unseen.push_back(fmt::format("{}: {:.2g} of the requested error", entry.name, missed / error));
    }
  }
  return trials;
}

}  // namespace dartboard
