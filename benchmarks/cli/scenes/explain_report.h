#pragma once
// The report of `dartboard explain` on a plan, and on the time that its first steps took.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/scene/file/scene_file.h"
#include "core/scene/plan/scene_plan.h"

namespace dartboard {

/// With --measure: the processor time of the first steps of the run, with their events and output; nothing is written.
struct MeasuredSteps {
  std::uint64_t steps = 0;
  double ns = 0.0;  // of one
};

std::string to_text(const SceneFile& scene, const ScenePlan& plan, const std::optional<MeasuredSteps>& measured);
nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan,
                               const std::optional<MeasuredSteps>& measured);

}  // namespace dartboard
