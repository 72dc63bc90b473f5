#include "validation/drawn/relations/drawn_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/plain/error.h"
#include "validation/drawn/changed_scene.h"
#include "validation/drawn/smallest_scene.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// [s] When a drive begins.
double begin_of(const Json& drive) {
  if (drive.contains("path")) return drive["path"][0]["at"].get<double>();
  if (drive.contains("turn")) return drive["turn"]["angles"][0]["at"].get<double>();
  return drive.value("from", 0.0);
}

RelationFound judge(const JudgedScene& scene, const Relation& relation) {
  try {
    return relation.judge(scene);
  } catch (const std::exception& error) {
    return {RelationOutcome::breaks, fmt::format("one of the runs ends by \"{}\"", error.what())};
  }
}

/// Does it hold where all begins elsewhere by a millionth, so that what is equally near to two is so no more?
bool holds_nearby(const JudgedScene& scene, const Relation& relation) {
  return std::ranges::all_of(std::array{1e-6, -1e-6}, [&](double share) {
    const Json other = with_disturbance(scene.json(), share, scene.scales().length);
    return judge(JudgedScene(other, scene.folder(), scene.scratch()), relation).outcome == RelationOutcome::holds;
  });
}

}  // namespace

const Relation& find_relation(std::string_view name) {
  std::string known;
  for (const Relation& relation : relations()) {
    if (relation.name == name) return relation;
    known += (known.empty() ? "" : ", ") + std::string(relation.name);
  }
  throw InputError(fmt::format("there is no relation '{}'; expected one of {}", name, known));
}

RelationFound try_relation(const JudgedScene& scene, const Relation& relation) {
  RelationFound found = judge(scene, relation);
  if (found.outcome == RelationOutcome::breaks && relation.bound.starts_with("rounding") &&
      holds_nearby(scene, relation))
    return {RelationOutcome::does_not_apply, "rounding decides: it holds where nothing is equally near to two"};
  return found;
}

Json first_steps(Json scene, std::uint64_t steps) {
  if (!scene.contains("step")) return scene;
  scene.erase("expect");
  const double end = static_cast<double>(steps) * scene["step"].get<double>();
  if (!(scene["duration"].get<double>() > end)) return scene;
  scene["duration"] = end;
  const auto keep = [&scene](const char* key, const auto& is_kept) {
    if (!scene.contains(key)) return;
    Json kept = Json::array();
    for (const Json& one : scene[key])
      if (is_kept(one)) kept.push_back(one);
    scene[key] = kept;
  };
  keep("forces", [end](const Json& force) { return force.value("from", 0.0) < end; });
  keep("events", [end](const Json& event) { return event.value(event.contains("at") ? "at" : "from", 0.0) <= end; });
  Json held = scene.value("fixed", Json::array());
  keep("driven", [&](const Json& drive) {
    if (begin_of(drive) < end) return true;
    Json selection = drive;
    for (const char* key : {"velocity", "path", "turn", "from", "until", "reverse_every"}) selection.erase(key);
    held.push_back(selection);
    return false;
  });
  if (!held.empty()) scene["fixed"] = held;
  if (scene.contains("contact") && scene["contact"].contains("obstacles"))
    for (Json& obstacle : scene["contact"]["obstacles"])
      if (obstacle.value("from", 0.0) >= end)
        for (const char* key : {"velocity", "from", "until"}) obstacle.erase(key);
  return scene;
}

std::vector<RelationTrial> try_relations(const Json& scene, const fs::path& folder, const fs::path& scratch,
                                         std::string_view only) {
  const JudgedScene judged(scene, folder, scratch);
  std::vector<RelationTrial> trials;
  for (const Relation& relation : relations())
    if (only.empty() || only == relation.name) trials.push_back({&relation, try_relation(judged, relation)});
  return trials;
}

Json smallest_breaking(const Json& scene, const Relation& relation, const fs::path& folder, const fs::path& scratch) {
  return smallest_scene(scene, [&](const Json& smaller) {
    try {
      return try_relation(JudgedScene(smaller, folder, scratch), relation).outcome == RelationOutcome::breaks;
    } catch (const std::exception&) {
      return false;
    }
  });
}

}  // namespace dartboard
