#pragma once
// The report of `dartboard explain` on a plan, and on the time that was measured to compare with.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/scene/file/scene_file.h"
#include "core/scene/plan/scene_plan.h"

namespace dartboard {

/// With --measure, `measured_ns` is the time of a step: events and output included, at the pace of the estimate;
/// nothing is written.
std::string to_text(const SceneFile& scene, const ScenePlan& plan, const std::optional<double>& measured_ns);
nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan, const std::optional<double>& measured_ns);

}  // namespace dartboard
