#include "core/scene/file/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/base/overloads.h"
#include "core/plain/error.h"
#include "core/scene/file/force_kind.h"
#include "core/scene/file/keys/scene_check.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/keys/strict_json.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/read_parts.h"
#include "core/scene/file/scene_rules.h"
#include "core/scene/file/step_times.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

// More steps than this are a mistake in a unit; the limit also keeps step numbers exact in a double.
constexpr double most_steps = 1e12;

SceneRegion read_region(const SceneValue& value) {
  SceneRegion region{read_cells(value.at("cells")), read_material(value.at("material")), value.path()};
  if (std::holds_alternative<RandomSelection>(region.cells))
    value.fail_at("cells/random", "is drawn anew with every seed", "cells by place, by number or by tag");
  return region;
}

/// Fills in a scene that has a name for errors and a folder.
void read(const SceneValue& value, SceneFile& scene) {
  scene.name = value.get<std::string>("name");
  scene.about = value.get<std::string>("about");
  scene.duration = value.get<double>("duration");
  scene.accuracy = value.find<double>("accuracy");
  scene.step = value.find<double>("step").value_or(scene.step);
  if (!scene.accuracy && scene.duration / scene.step > most_steps)
    value.fail_at("duration", fmt::format("is {} s, {:.3g} steps", scene.duration, scene.duration / scene.step),
                  fmt::format("at most {:.0e} steps", most_steps));
  scene.body =
      value.has("body") ? read_body(value.at("body"), scene.folder) : read_bodies(value.at("bodies"), scene.folder);
  scene.material = read_material(value.at("material"));
  for (const SceneValue& region : value.at("regions").entries()) scene.regions.push_back(read_region(region));
  for (const SceneFile::Tissue& tissue : scene.tissues())
    if (!value.json().at(SceneValue::Json::json_pointer(tissue.path)).contains("model"))
      scene.without_model.push_back(tissue.path);
  scene.diagonals = value.at("diagonals").one_of<Diagonals>(diagonals_names);
  scene.gravity = value.get<Eigen::Vector3d>("gravity");
  scene.initial_velocity = read_velocity(value.at("initial_velocity"));
  for (const SceneValue& held : value.at("fixed").entries()) scene.fixed.push_back(HeldSelection::read(held));
  for (const SceneValue& drive : value.at("driven").entries()) scene.driven.push_back(read_drive(drive, scene));
  for (const SceneValue& force : value.at("forces").entries()) scene.forces.push_back(read_force(force, scene));
  for (const ForceKind& kind : force_kinds())
    if (kind.read != nullptr) kind.read(value, scene);
  if (value.has("contact")) read_contact(value.at("contact"), scene);
  scene.integrator = value.find<std::string>("integrator").value_or(scene.accuracy ? "" : standard_integrator);
  scene.solver = value.find<std::string>("solver").value_or("");
  const auto unstable = value.get<std::string>("unstable_step");
  scene.unstable_step = unstable == "refuse"    ? UnstableStep::refuse
                        : unstable == "substep" ? UnstableStep::substep
                                                : UnstableStep::warn;
  // an accuracy needs events at their times
  scene.exact_events = value.get<std::string>("event_times") == "exact" || scene.accuracy;
  if (value.has("sleep")) scene.sleep = read_sleep(value.at("sleep"));
  for (const SceneValue& event : value.at("events").entries()) scene.events.push_back(read_event(event, scene));
  require_rules(scene, ReadUpTo::events);
  const SceneValue output = value.at("output"), expectation = value.at("expect");
  scene.output = read_output(output);
  require_rules(scene, ReadUpTo::output);
  scene.probes = read_probes(output.at("probes"));
  if (!scene.accuracy) scene.output = scene.output.in_steps_of(scene.step);
  scene.expect = read_expectation(expectation, scene.probes);
  require_rules(scene, ReadUpTo::expectation);
  scene.expect.hash = read_hash(expectation);
}

}  // namespace

std::span<const BodySource> SceneFile::bodies() const {
  if (const auto* list = std::get_if<BodyList>(&body.mesh)) return list->all;
  return {&body, 1};
}

bool SceneFile::is_chain() const {
  return std::ranges::all_of(bodies(),
                             [](const BodySource& one) { return std::holds_alternative<ChainMesh>(one.mesh); });
}

std::vector<SceneFile::Tissue> SceneFile::tissues() const {
  std::vector<Tissue> all{{material, "/material", true}};
  for (const BodySource& one : bodies())
    if (one.material) all.push_back({*one.material, one.path + "/material", true});
  for (const SceneRegion& region : regions) all.push_back({region.material, region.path + "/material", true});
  for (Tissue& tissue : all) tissue.names_model = std::ranges::find(without_model, tissue.path) == without_model.end();
  return all;
}

bool SceneFile::has_times() const {
  return !events.empty() || !driven.empty() || !std::ranges::all_of(forces, &SceneForce::lasts);
}

bool SceneFile::has_elements() const {
  return std::ranges::any_of(tissues(), [](const Tissue& tissue) { return tissue.material.model != Model::springs; });
}

bool SceneFile::has_springs() const {
  return diagonals != Diagonals::none ||
         std::ranges::any_of(tissues(), [](const Tissue& tissue) { return tissue.material.model == Model::springs; });
}

bool SceneFile::holds_axes() const {
  return std::ranges::any_of(fixed, [](const HeldSelection& held) { return held.axes != all_axes; });
}

void SceneFile::fail(std::string_view path, std::string_view found, std::string_view expected) const {
  throw InputError(fmt::format("{}: {}: {}; expected {}", file, path, found, expected));
}

OutputPlan OutputPlan::in_steps_of(double step) const {
  const auto steps = [step](const std::optional<std::uint64_t>& given, const std::optional<double>& time) {
    if (given || !time) return given;
    // far beyond the end of any run, so that the number of steps fits
    const double in_reach = std::min(*time, 2.0 * most_steps * step);
    return std::optional(std::max<std::uint64_t>(1, step_of_time(in_reach, step)));
  };
  OutputPlan plan = *this;
  plan.frame_steps = steps(frame_steps, frame_time);
  plan.diagnostic_steps = steps(diagnostic_steps, diagnostic_time);
  plan.probe_steps = steps(probe_steps, probe_time);
  plan.checkpoint_steps = steps(checkpoint_steps, checkpoint_time);
  plan.frame_time = plan.diagnostic_time = plan.probe_time = plan.checkpoint_time = std::nullopt;
  return plan;
}

bool Expectation::empty() const {
  return !vertices && !edges && !faces && !cells && !components && !components_at_least && !operations && !mass &&
         !kinetic_at_most && !energy_drift_at_most && places.empty() && !hash;
}

SceneFile parse_scene(std::string_view text, const std::string& name, const fs::path& folder) {
  const SceneValue::Json complete = check_and_complete(parse_strict_json(text, name), Shape::scene, name);
  SceneFile scene;
  scene.file = name;
  scene.text = text;
  scene.folder = folder;
  read(SceneValue(complete, name), scene);
  return scene;
}

SceneFile read_scene(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw IoError(fmt::format("{}: there is no such file; expected a scene", path.string()));
  if (fs::is_directory(path, error)) throw IoError(fmt::format("{}: is a folder; expected a scene", path.string()));
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw IoError(fmt::format("{}: cannot be read; expected a scene", path.string()));
  SceneFile scene = parse_scene(text.str(), path.string(), path.parent_path());
  load_mesh(scene);
  return scene;
}

bool reseed(SceneFile& scene, std::uint64_t seed) {
  bool changed = false;
  scene.added_seed += seed;
  const auto reseed_cells = [seed, &changed](const std::string&, CellSelection& cells) {
    if (auto* random = std::get_if<RandomSelection>(&cells)) {
      random->seed += seed;
      changed = changed || seed != 0;
    }
  };
  const auto leave = [](const std::string&, const auto&) {};  // nothing else is drawn
  for (SceneEvent& event : scene.events) for_each_choice(event, Overloads{reseed_cells, leave});
  return changed;
}

}  // namespace dartboard
