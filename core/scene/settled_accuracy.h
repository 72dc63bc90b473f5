#pragma once
// The step of a scene that asks for an accuracy, and its integrator where it names none, as they were chosen.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace dartboard {

/// The choice for a scene, and the reason for it.
struct SettledAccuracy {
  double accuracy = 0.0;  // [mean edge lengths] asked for
  std::string integrator{};
  bool integrator_named = false;         // by the scene
  double step = 0.0;                     // [s]
  bool exact_events = false;             // steps are divided at the times of events and loads
  double recommended_step = 0.0;         // [s] before it was fitted to the duration and to output
  double predicted_error = 0.0;          // [mean edge lengths]
  double predicted_s = 0.0;              // [s] of the run
  double pilot_s = 0.0;                  // [s] that the choice took
  std::vector<std::string> omissions{};  // what it leaves out of consideration
  std::vector<std::string> untried{};    // the methods that there was no time to try
};
/// The choice in one line, and a second with the members of the scene that make it a fixed one; a third for what was
/// not tried.
std::string to_string(const SettledAccuracy& settled);
void to_json(nlohmann::json& json, const SettledAccuracy& settled);
void from_json(const nlohmann::json& json, SettledAccuracy& settled);

}  // namespace dartboard
