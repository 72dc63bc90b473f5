#include "core/scene/settled_accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "core/base/counted.h"

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

}  // namespace dartboard
