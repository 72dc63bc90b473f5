#include "validation/recommend/settle_accuracy.h"

#include <fmt/format.h>

#include <cmath>

#include "core/plain/error.h"
#include "validation/recommend/recommended_scene.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {

std::optional<SettledAccuracy> settle_accuracy(SceneFile& scene, const CpuClock& clock,
                                               const std::function<void(const std::string&)>& tells) {
  if (!scene.accuracy) return {};
  SettledAccuracy settled;
  settled.accuracy = *scene.accuracy;
  settled.integrator_named = !scene.integrator.empty();
  if (scene.duration > 0.0) {
    const TradeoffScene studied = scene_of_file(scene);
    RecommendOptions options;
    options.adaptive = false;  // a simulation has one step throughout
    options.only = scene.integrator;
    options.tells = tells;
    const Recommendation r = recommend(studied, *scene.accuracy, clock, options);
    const Candidate* pick = r.pick();
    if (pick == nullptr && std::isfinite(r.best_error))
      throw InputError(
          fmt::format("{}: /accuracy: is {} mean edge lengths, which cannot be met in double precision; expected a "
                      "larger one: about {:.1e} is the best, with {}",
                      scene.file, *scene.accuracy, r.best_error, r.best_error_by));
    if (pick == nullptr)
      throw InputError(
          fmt::format("{}: /accuracy: is {} mean edge lengths, and no step{} was found to meet it; "
                      "expected a larger one, or 'step' in its place",
                      scene.file, *scene.accuracy, settled.integrator_named ? " of " + scene.integrator : ""));
    const FittedPick fitted = fit_pick(scene, *pick, r.features);
    settled.recommended_step = pick->h;
    settled.predicted_error = fitted.predicted_error;
    settled.predicted_s = fitted.predicted_s;
    settled.pilot_s = r.pilot_s;
    settled.omissions = studied.omissions;
    settled.untried = r.untried();
  } else {
    // nothing moves: any step will do
    scene.step = 1.0;
    if (scene.integrator.empty()) scene.integrator = "rk4";
  }
  settled.integrator = scene.integrator;
  settled.step = scene.step;
  settled.exact_events = scene.exact_events && scene.has_times();
  scene.output = scene.output.in_steps_of(scene.step);
  return settled;
}

}  // namespace dartboard
