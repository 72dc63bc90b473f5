#pragma once
// The parts of a scene, each made of its value in the file. Errors are those of parse_scene.

#include <filesystem>
#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

class SceneValue;

BodySource read_body(const SceneValue& value, const std::filesystem::path& folder);
BodySource read_bodies(const SceneValue& list, const std::filesystem::path& folder);
Material read_material(const SceneValue& value);
InitialVelocity read_velocity(const SceneValue& value);
SceneSleep read_sleep(const SceneValue& value);

// `scene` has what these depend on: its duration, step, accuracy, bodies and materials
SceneDrive read_drive(const SceneValue& value, const SceneFile& scene);
SceneForce read_force(const SceneValue& value, const SceneFile& scene);
SceneEvent read_event(const SceneValue& value, const SceneFile& scene);
/// Obstacles and touches are added to the scene.
void read_contact(const SceneValue& value, SceneFile& scene);

/// The plan as given, in times and in steps.
OutputPlan read_output(const SceneValue& value);
std::vector<Probe> read_probes(const SceneValue& list);
/// All but the hash.
Expectation read_expectation(const SceneValue& value, const std::vector<Probe>& probes);
std::optional<std::uint64_t> read_hash(const SceneValue& expectation);

}  // namespace dartboard
