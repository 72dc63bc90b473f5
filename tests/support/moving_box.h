#pragma once
// A small moving box of tetrahedra: the scene that most tests of simulations start from.

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

#include "core/plain/error.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"

namespace dartboard::moving {

using Json = nlohmann::json;

// 48 tetrahedra of a box of 2 x 2 x 2 cubes, moving. Their masses are powers of two: the volume is (2^-3)^3 / 6,
// rounded, times 768 = 6 * 2^7, and 6 fl(1/6) rounds to 1; so 2^-2 kg each.
inline Json moving_box() {
  return Json::parse(R"({
    "name": "box", "step": 0.001, "duration": 0.01,
    "body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.125, "pattern": "kuhn"}}},
    "material": {"density": 768, "stiffness": 64, "damping": 0.25, "viscosity": 0.5},
    "initial_velocity": {"linear": [[1, -2, 0], [2, 0.5, 0], [0, 0, -1]], "centre": [0.125, 0.125, 0.125]}})");
}
inline SceneFile parse(const Json& json) { return parse_scene(json.dump(), "file", ""); }
inline Json with_events(Json json, const char* events) {
  json["events"] = Json::parse(events);
  return json;
}
/// The message with which the simulation refuses the scene, or "accepted".
inline std::string refusal(const Json& scene) {
  try {
    const Simulation simulation(parse(scene));
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}
inline std::size_t cells(const Simulation& simulation) { return simulation.body().counts().cells; }

/// A step; its divergence if it has one.
inline std::optional<Divergence> divergence_of_step(Simulation& simulation) {
  const std::optional<EarlyEnd> end = simulation.advance();
  return end ? std::optional(std::get<Divergence>(*end)) : std::nullopt;
}

inline void run(Simulation& simulation) {
  while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance());
}

}  // namespace dartboard::moving
