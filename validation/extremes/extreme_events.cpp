// The axis of events: bodies that come apart while they move.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <string_view>

#include "core/mechanics/adapt.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/plain/random.h"
#include "core/time/method/trial_state.h"
#include "core/time/system/energy.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/stable_step.h"
#include "core/views/spring_ends.h"
#include "validation/extremes/extreme_judgement.h"
#include "validation/extremes/extreme_matrix.h"
#include "validation/extremes/step_evidence.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr std::chrono::milliseconds budget{1600};  // of a run

/// A run of a body on a map, with changes after every step.
///
/// `events` are those at the end of each step: d, a random face is dissociated, r, a random volume is removed; D and R,
/// the same at the place of the event before.
ExtremeCell run_events(const ExtremeCase& which, std::string_view events, bool all_first, const MakeIntegrator& make) {
  ExtremeCell cell{which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::ok, {}, 0, {}, ""};
  Problem problem;
  problem.mesh = kuhn_box(2, 2, 2, 0.1, 0.1, 5);
  problem.surroundings.gravity = {0, 0, 0};
  problem.material.damping = problem.material.viscosity = 0.0;
  for (const Vector3d& p : problem.mesh.points)
    problem.initial_velocity.push_back({0.1 * p[1], -0.1 * p[0], 0.05 * p[2]});
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  SpringEndsView ends;
  ends.rebuild(body);
  const auto integrator = make(which.integrator);
  SplitMix64 random(7);
  const auto system = [&body, &ends] {
    const VertexColumns& v = body.vertices;
    return SpringSystem{ends.ends, body.springs, v.mass, v.inverse_mass, v.viscosity, v.fixed, {0, 0, 0}};
  };
  const auto motion = [&body] { return Motion{body.vertices.position, body.vertices.velocity}; };
  const auto change = [&] {
    Dart d = no_dart;
    for (const char event : events) {
      if (body.map.dart_count() == 0) return;
      if (event == 'd' || event == 'r' || !body.map.is_live(d)) {
        d = Dart{random.below(body.map.capacity())};
        while (!body.map.is_live(d)) d = Dart{random.below(body.map.capacity())};
      }
      const bool removal = event == 'r' || event == 'R';
      ends.apply(body, adapt(body, removal ? remove_volume(body.map, d) : dissociate_face(body.map, d)));
    }
  };
  if (all_first)
    for (std::uint32_t d = 0; d < body.map.capacity(); ++d)
      if (body.map.is_live(Dart{d})) ends.apply(body, adapt(body, dissociate_face(body.map, Dart{d})));
  StableStepEstimate estimate;
  const double h = 0.3 / estimate.refresh(system(), body.vertices.position).upper;
  DivergenceDetector detector;
  StepResult result = detector.start(system(), motion(), h);
  cell.refused = !result.ok();
  const double before = total_energy(system(), body.vertices.position, body.vertices.velocity);
  const auto deadline = std::chrono::steady_clock::now() + budget;
  StepEvidence evidence(which.integrator, 60);
  for (; cell.step < 60 && result.ok(); ++cell.step) {
    evidence.before(system(), motion(), h);
    result = integrator->step(system(), motion(), h);
    result = result.ok() ? detector.after_step(system(), motion()) : detector.with_witness(result, system(), motion());
    if (!result.ok()) break;
    evidence.after(motion());
    change();
    if (!events.empty()) {
      integrator->restart();
      evidence.restarted();
      result = detector.system_changed(system(), motion());
      if (estimate.refresh(system(), body.vertices.position).upper * h > 0.9 && cell.warnings.empty())
        cell.warnings.emplace_back("UNSTABLE_DT");
    }
    if (std::chrono::steady_clock::now() > deadline)
      result = {StepCode::budget, Witness::none, 0, "steps", static_cast<double>(cell.step)};
  }
  if (result.ok()) result = detector.check_all(system(), motion());
  cell.diagnosis = result;
  if (!result.ok()) {
    cell.outcome = ExtremeOutcome::diagnosed;
    cell.judged_by = JudgedBy::diagnosis;
    return cell;
  }
  cell.outcome = cell.warnings.empty() ? ExtremeOutcome::ok : ExtremeOutcome::degraded;
  const bool removes = events.find_first_of("rR") != std::string_view::npos;
  const ExtremeVerdict verdict = verdict_of(
      EventsObservation{.finite = check_finite(body.vertices.position, body.vertices.velocity).ok(),
                        .energy_before = before,
                        .energy_after = total_energy(system(), body.vertices.position, body.vertices.velocity),
                        .explicit_euler = which.integrator == "explicit-euler",
                        .must_live = conserves_energy(integrator->scheme()) && !removes});
  if (verdict.outcome == ExtremeOutcome::silent) {
    cell.outcome = verdict.outcome;
    cell.note = verdict.note;
  }
  cell.end = numbers_of(body.vertices.position, body.vertices.velocity);
  judge_steps(cell, evidence, false);
  return cell;
}

}  // namespace

void add_events(ExtremeMatrix& matrix) {
  const auto at = [&matrix](const char* value, std::string_view events, bool all_first = false) {
    matrix.add_run(value, "box on a map", [events, all_first](const ExtremeCase& which, const MakeIntegrator& make) {
      return run_events(which, events, all_first, make);
    });
  };
  at("a dissociation per step", "d");
  at("two dissociations per step", "dd");
  at("eight dissociations per step", "dddddddd");
  at("all dissociated", "", true);
  at("a removal per step", "r");
  at("two removals per step, until nothing is left", "rr");
  at("all dissociated, then removed", "r", true);
  at("a dissociation and a removal at one time", "dr");
  at("a removal and a dissociation at one time", "rd");
  at("one face dissociated twice at one time", "dD");
  at("a face dissociated and its volume removed at one time", "dR");
}

}  // namespace dartboard
