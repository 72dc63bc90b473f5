#pragma once
// What the runs of a scene are compared with, and how far that can be trusted.

#include <string>
#include <vector>

#include "validation/scene_stage.h"

namespace dartboard {

enum class ReferenceKind : std::uint8_t {
  closed_form,
  certified,      // reference/ode_oracle: two independent codes agree
  self_converged  // the finest run of our own; another method of ours agrees
};
std::string_view name(ReferenceKind kind);

struct SceneReference {
  ReferenceKind kind = ReferenceKind::closed_form;
  std::vector<PointState> states;  // at the checkpoints
  double floor = 0.0;              // [edges] errors below this say nothing
  double gain = 0.0;               // growth of a small disturbance, the largest over time; 0 when not known
  double cpu_s = 0.0;              // that it took
  std::string what;                // one line: how it was found, how far it is certain
};

struct ReferenceOptions {
  double oracle_s = 60.0;          // the longest time that one run of the oracle may be expected to take
  double self_converged_s = 20.0;  // the longest time of a run that converges by itself
  bool gain = true;
};

/// The closed form where there is one; the oracle where it is quick enough; else Blanes' and Moan's method with steps
/// halved until it changes by less than 1e-12 edges, or until time is up, and the method of Dormand and Prince beside
/// it.
///
/// throws  SolverError if a run of our own ends with a diagnosis
SceneReference reference_of(const TradeoffScene& scene, const CpuClock& clock, const ReferenceOptions& options = {});

}  // namespace dartboard
