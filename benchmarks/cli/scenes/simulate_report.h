#pragma once
// The report of `dartboard simulate` on a run.

#include <algorithm>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/table.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/scene_verdict.h"
#include "core/scene/run/simulation.h"
#include "core/scene/settled_accuracy.h"
#include "core/scene/survey/scene_survey.h"

namespace dartboard {

/// Everything that the summary needs.
struct SimulationReport {
  const SceneFile& scene;
  const SceneSurvey& survey;
  const Simulation& simulation;
  const RunResult& result;
  std::optional<SettledAccuracy> settled;  // where the scene asks for an accuracy
  std::vector<ExpectedRow> expected;
  std::string unjudged;  // why there is no verdict; empty where there is one
  double wall_s, cpu_s;
  std::string folder;
  std::size_t frames;
  std::string picture;  // a sentence on the picture: its file, or why there is none

  bool holds() const {
    return !result.ended_early() &&
           std::all_of(expected.begin(), expected.end(), [](const auto& row) { return row.holds; });
  }
  /// The step of the last state: after a divergence the one that the body was taken back to.
  std::uint64_t kept_step() const {
    return simulation.steps_done() - (result.divergence ? result.divergence->taken_back : 0);
  }
  /// The change of mass beyond that of removals, relative to the mass at the start.
  double mass_drift() const {
    const SimulatedBody& body = simulation.body();
    return mass_unaccounted_for(result.first.mass + removed_at_start, body.removed_mass(), body.mass());
  }
  double removed_at_start = 0.0;
  std::vector<std::string> warned{};               // the warnings printed before the first step
  std::uint64_t steps_before = 0;                  // for a continued run: the steps that its times do not count
  std::optional<std::uint64_t> continues_after{};  // the step of the checkpoint left by a run that is not over
};

/// The quantities at the start and at the end.
Table summary_of(const SimulationReport& report);

/// The lines before a run: what is simulated and with which step, what the body is made of, and what each selection of
/// the scene holds.
std::string opening_of(const SceneFile& scene, const SceneSurvey& survey, const Simulation& simulation,
                       std::string_view step_in_words);

/// The lines after a run.
std::string to_text(const SimulationReport& report);

nlohmann::ordered_json to_json(const SimulationReport& report);

}  // namespace dartboard
