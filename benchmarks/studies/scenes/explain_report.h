#pragma once
// What `dartboard explain` says of a plan, and of what was measured beside it.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/scene/file/scene_file.h"
#include "core/scene/plan/measured_plan.h"

namespace dartboard {

/// What --measure adds: the bytes of each item, and the time of the run.
struct MeasuredScene {
  MeasuredPlan found;
  bool equal = true;
  std::size_t total = 0;
  double ns = 0.0;  // per step, events and output included, at the pace of the estimate; nothing is written
};

std::string to_text(const SceneFile& scene, const ScenePlan& plan, const std::optional<MeasuredScene>& measured);

nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan,
                               const std::optional<MeasuredScene>& measured);

}  // namespace dartboard
