#pragma once
// The reference that the runs of a scene are compared with, and how far it can be trusted.

#include <string>
#include <vector>

#include "reference/ode_oracle.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {

enum class ReferenceKind : std::uint8_t {
  closed_form,
  certified,       // reference/ode_oracle; `what` says how far
  self_converged,  // the finest run of our own; another method of ours agrees
  other_codes      // scenes/other_codes
};
std::string_view name(ReferenceKind kind);

struct SceneReference {
  ReferenceKind kind = ReferenceKind::closed_form;
  std::vector<PointState> states;  // at the checkpoints
  double floor = 0.0;              // [edges] smaller errors are not resolved
  double agreement = 0.0;          // [edges] the distance of a second method; 0 for closed forms
  double gain = 0.0;               // growth of a small disturbance, the largest over time; 0 when not known
  double cpu_s = 0.0;              // spent on it
  std::string what;                // one line: how it was found, how far it is certain
};

struct ReferenceOptions {
  double oracle_s = 60.0;          // the longest time that one run of the oracle may be expected to take
  double self_converged_s = 20.0;  // the longest time of a self-converging run
  bool gain = true;
  bool low_floor = false;  // in extended precision throughout, which takes three times as long
};

/// In words, the agreement behind a certified reference: two independent codes, two methods of one library, or nothing.
std::string certainty_of(const reference::CertifiedMotion& certified);

/// [edges] The error that a run of a method of order 4 cannot resolve: the largest of ten fifteenths of the change by
/// its last halving, 1e-12, and the distance of the second method; NaN where one is.
double self_converged_floor(double change, double agreement);

/// The closed form where there is one; the oracle where it is quick enough; else Blanes' and Moan's method with steps
/// halved until it changes by less than 1e-12 edges, or until time is up, together with the method of Dormand and
/// Prince, with steps halved until it confirms that, or time is up. Errors that the second method does not confirm are
/// below the floor.
///
/// throws  SolverError if a run of our own ends with a diagnosis
SceneReference reference_of(const TradeoffScene& scene, const CpuClock& clock, const ReferenceOptions& options = {});

}  // namespace dartboard
