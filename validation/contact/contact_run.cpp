#include "validation/contact/contact_run.h"

#include <algorithm>
#include <cmath>

#include "core/plain/nan_maximum.h"
#include "core/scene/body/make_contact.h"
#include "core/scene/file/scene_problem.h"

namespace dartboard {
namespace {

/// The sums of absolute terms of the momenta.
struct Sizes {
  double momentum = 0.0, angular = 0.0;
};
Sizes sizes_of(const VertexColumns& v) {
  Sizes sizes;
  for (std::size_t k = 0; k < v.size(); ++k) {
    sizes.momentum += v.mass[k] * v.velocity[k].norm();
    sizes.angular += v.mass[k] * v.velocity[k].norm() * v.position[k].norm();
  }
  return sizes;
}

void look_at_overlaps(const SceneFile& scene, const std::vector<std::size_t>& first_cell, const Simulation& simulation,
                      ContactRun& run) {
  const Frame frame = simulation.body().frame({});  // points by their numbers in the body
  std::vector<CellCorners> cells;
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c) {
    const auto k = frame.mesh.cell(c);
    cells.push_back({k[0], k[1], k[2], k[3]});
  }
  const auto may_touch = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t one = body_of_cell(first_cell, static_cast<std::size_t>(frame.mesh_cell[a])),
                        other = body_of_cell(first_cell, static_cast<std::size_t>(frame.mesh_cell[b]));
    return std::ranges::any_of(scene.touches, [one, other](const SceneTouch& touch) {
      return touch.first == std::min(one, other) && touch.second == std::max(one, other);
    });
  };
  for (const JudgedOverlap& one :
       judged_overlaps(*simulation.body().contacts().bodies, frame.mesh.points, cells, may_touch)) {
    run.by_depth.add(one.overlap.depth / run.allowed, one.felt);
    run.deepest = std::max(run.deepest, one.overlap.depth);
  }
}

}  // namespace

ContactRun judge_run(const SceneFile& scene, std::size_t looks, const std::function<void(Simulation&)>& meddles) {
  const Problem problem = make_problem(scene);
  Simulation simulation(scene, problem);
  ContactRun run{.scene = scene.name,
                 .allowed = scene.touches.front().law.depth,
                 .alone = scene.obstacles.empty() && scene.gravity.isZero(0.0) && scene.fixed.empty() &&
                          scene.driven.empty() && scene.forces.empty()};
  const Diagnostics start = simulation.diagnostics();
  const Sizes sizes = sizes_of(simulation.body().vertices());
  double kinetic = start.kinetic, unaccounted = 0.0;
  for (std::size_t k = 1; k <= looks; ++k) {
    const std::uint64_t until = simulation.step_count() * k / looks;
    while (simulation.steps_done() < until)
      if (simulation.advance()) return run;
    if (meddles) meddles(simulation);
    look_at_overlaps(scene, problem.bodies.cell, simulation, run);
    ++run.looks;
    const Diagnostics now = simulation.diagnostics();
    run.contacts = std::max(run.contacts, now.contact->contacts);
    kinetic = std::max(kinetic, now.kinetic);
    unaccounted = max_or_nan(unaccounted, std::abs(now.energy() + now.contact->damped + now.contact->rubbed -
                                                   now.contact->supplied - start.energy()));
    if (!run.alone) continue;
    run.momentum = max_or_nan(run.momentum, (now.momentum - start.momentum).norm() / sizes.momentum);
    run.angular = max_or_nan(run.angular, (now.angular_momentum - start.angular_momentum).norm() / sizes.angular);
  }
  run.energy = unaccounted / kinetic;
  run.ended = true;
  return run;
}

}  // namespace dartboard
