#include "validation/recommend/settle_accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/counted.h"
#include "core/plain/error.h"
#include "validation/recommend/recommended_scene.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {

std::string to_string(const SettledAccuracy& s) {
  return fmt::format(
      "for an accuracy of {:.3g} edges: {}{} with h = {:.6g} s; expected error {:.1e} edges{}, expected time {:.3g} s; "
      "the choice took {:.3g} s\n  in place of /accuracy, these settle it for good: \"integrator\": \"{}\", \"step\": "
      "{}{}{}",
      s.accuracy, s.integrator, s.integrator_named ? " (named by the scene)" : "", s.step, s.predicted_error,
      s.omissions.empty() ? "" : fmt::format(", {} aside", counted(s.omissions.size(), "thing")), s.predicted_s,
      s.pilot_s, s.integrator, nlohmann::json(s.step).dump(), s.exact_events ? ", \"event_times\": \"exact\"" : "",
      s.untried.empty() ? ""
                        : fmt::format("\n  not tried for want of time, and another run may choose one of them: {}",
                                      fmt::join(s.untried, "; ")));
}

void to_json(nlohmann::json& json, const SettledAccuracy& s) {
  json = {{"accuracy", s.accuracy},
          {"integrator", s.integrator},
          {"integrator_named", s.integrator_named},
          {"step", s.step},
          {"exact_events", s.exact_events},
          {"recommended_step", s.recommended_step},
          {"predicted_error", s.predicted_error},
          {"predicted_s", s.predicted_s},
          {"pilot_s", s.pilot_s},
          {"omissions", s.omissions},
          {"untried", s.untried}};
}

void from_json(const nlohmann::json& json, SettledAccuracy& s) {
  json.at("accuracy").get_to(s.accuracy);
  json.at("integrator").get_to(s.integrator);
  json.at("integrator_named").get_to(s.integrator_named);
  json.at("step").get_to(s.step);
  json.at("exact_events").get_to(s.exact_events);
  json.at("recommended_step").get_to(s.recommended_step);
  json.at("predicted_error").get_to(s.predicted_error);
  json.at("predicted_s").get_to(s.predicted_s);
  json.at("pilot_s").get_to(s.pilot_s);
  json.at("omissions").get_to(s.omissions);
  json.at("untried").get_to(s.untried);
}

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
