#include "validation/drawn/relations/judged_scene.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "core/contact/box_around.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/time/integrators.h"
#include "validation/drawn/changed_scene.h"
#include "validation/drawn/scene_walk.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double disturbance = 0x1p-34;

}  // namespace

JudgedScene::JudgedScene(Json json, fs::path folder, fs::path scratch)
    : json_(std::move(json)), folder_(std::move(folder)), scratch_(std::move(scratch)) {
  file_ = parse_scene(json_.dump(), "scene", folder_);
  if (file_.accuracy) file_.fail("/accuracy", "leaves the step to whole studies", "'step' in its place");
  load_mesh(file_);
  const auto integrator = make_integrator(file_.integrator);
  scheme_ = integrator->scheme();
  adaptive_ = dynamic_cast<const AdaptiveIntegrator*>(integrator.get()) != nullptr;
  Problem problem = make_problem(file_);
  first_points_ = problem.bodies.point;
  mesh_ = std::move(problem.mesh);
  std::set<int> dimensions;
  for (const CellKind kind : mesh_.kinds) dimensions.insert(dartboard::dimension(kind));
  if (!mesh_.links.empty()) dimensions.insert(1);
  if (dimensions.size() == 1) dimension_ = *dimensions.begin();
  motion_ = run(json_);
  double mass = 0.0;
  for (const Quantity& q : motion_.quantities)
    if (q.name.starts_with("mass at")) mass = std::max(mass, q.values[0]);
  const BoxAround box = box_around(mesh_.points);
  // where events at the start leave nothing, nothing is compared
  scales_ = {(box.high - box.low).maxCoeff(), file_.step, mass > 0.0 ? mass : 1.0};
}

bool JudgedScene::is_damped() const {
  return std::ranges::any_of(file_.tissues(), [](const SceneFile::Tissue& tissue) {
    return tissue.material.damping > 0.0 || tissue.material.damping_time > 0.0;
  });
}

bool JudgedScene::has_losses() const {
  const auto is_lossy = [](const auto& one) { return one.law.friction > 0.0 || one.law.restitution < 1.0; };
  return std::ranges::any_of(file_.obstacles, is_lossy) || std::ranges::any_of(file_.touches, is_lossy);
}

bool JudgedScene::has_box_obstacle() const {
  return std::ranges::any_of(
      file_.obstacles, [](const SceneObstacle& one) { return std::holds_alternative<Block>(one.obstacle.shape); });
}

bool JudgedScene::chooses_from_all() const { return has_key(json_, "random") || has_key(json_, "most_per_step"); }

const DrawnMotion& JudgedScene::in_shorter_steps(int parts) const {
  const auto found = shorter_.find(parts);
  if (found != shorter_.end()) return found->second;
  return shorter_[parts] = run(dartboard::in_shorter_steps(json_, parts), {.parts = static_cast<std::uint64_t>(parts)});
}

const DrawnMotion& JudgedScene::disturbed(bool other_way) const {
  const auto found = disturbed_.find(other_way);
  if (found != disturbed_.end()) return found->second;
  return disturbed_[other_way] = run(with_disturbance(json_, other_way ? -disturbance : disturbance, scales_.length));
}

DrawnMotion JudgedScene::run(const Json& json, const DrawnRunOptions& options) const {
  return run_drawn(json, folder_, options);
}

}  // namespace dartboard
