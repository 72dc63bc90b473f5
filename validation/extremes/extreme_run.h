#pragma once
// One run of the matrix of extremes: its start, and the judgement of its end.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "validation/extremes/extreme_judgement.h"
#include "validation/extremes/extremes.h"
#include "validation/extremes/motion_truth.h"
#include "validation/extremes/step_evidence.h"
#include "validation/scenes/extreme_bodies.h"

namespace dartboard {

/// A run on columns, and the changes made to it.
struct ExtremeSetup {
  SpringColumns body;
  double h = 0.0;
  std::uint64_t steps = 100;
  std::function<void(SpringColumns&)> halfway{};  // in mid-run
  bool announced = false;                         // the detector is notified (not needed if only the state changes)
  bool compare = true;                            // the end with the bound of the method's order
  double offset = 0.0;                            // [m] of the body, along x
  std::vector<Eigen::Vector3d> at_origin{};       // positions of the same body there; empty: no run to compare with
};

/// Checks, runs, watches and judges it.
ExtremeCell run_extreme(const ExtremeCase& which, ExtremeSetup setup, const MakeIntegrator& make = make_sound);

/// Adds the codes of the warnings of a preflight, each once; the first of all is the diagnosis until the run is
/// stopped.
void add_warnings(ExtremeCell& cell, const Preflight& preflight);
/// The run was refused or stopped.
void diagnose(ExtremeCell& cell, const StepResult& result);

/// The scale of a run at its limits, without the amplitude of its motion and the size of its coordinates.
TruthScale truth_scale(const Scheme& scheme, const StableStep& limits, double h, std::uint64_t steps);
/// Compares the end with the true motion if its bound means something: steps are short, and nothing was warned of.
void compare_with_truth(ExtremeObservation& seen, const MotionDistance& motion, const TruthScale& scale);

/// The outcome of a run that ended without a diagnosis: by what was observed, then by its steps and the true motion,
/// and by whether a step that is unstable by theory was predicted.
void judge_end(ExtremeCell& cell, const ExtremeObservation& seen, const StepEvidence& evidence,
               const std::optional<MotionDistance>& motion, bool is_unstable);

/// Does nothing damp the motion, nor does the method?
bool keeps_moving(const Scheme& scheme, const StableStep& limits);

/// The outcome of a run in which no other fault was found: by its steps, and by whether it resolves the motion.
void judge_steps(ExtremeCell& cell, const StepEvidence& evidence, bool motion_resolved);
/// All positions, then all velocities.
std::vector<double> numbers_of(std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v);

/// Does the method keep the energy of an undamped system, or a quantity near it?
bool conserves_energy(const Scheme& scheme);

/// Kinetic, elastic and gravity energy [J], in extended precision and without the detector: the basis of outcomes.
long double energy_of(const SpringColumns& body);

/// omega_max [1/s] at the state of the body, from below.
double highest_frequency(const SpringColumns& body);

/// A body displaced by up to `size` edges and moving as fast as a quarter of its highest frequency allows.
SpringColumns in_motion(SpringColumns body, double size);
/// An extreme body that moves like that.
SpringColumns moving_body(std::string_view scene, double size = 0.01);

/// A run with steps of theta / omega_max.
ExtremeSetup with_theta(SpringColumns body, double theta, std::uint64_t steps = 100);

}  // namespace dartboard
