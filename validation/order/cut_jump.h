#pragma once
// Quantities that a cut must not change: the energy and the momenta of a body that moves.

#include <vector>

#include "core/time/method/integrator.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// Jumps at an event, relative: of the energy to the kinetic and elastic energy before, of the momentum to the sum of
/// m |v|, of the angular momentum to the sum of m |x - c| |v|, about the centre of mass c.
struct CutJump {
  double time = 0.0;  // [s]
  std::size_t vertices_before = 0, vertices_after = 0;
  double energy = 0.0, momentum = 0.0, angular = 0.0;
};

/// Run a scene by the integrator with at most h between events, and measure at each
/// time of events.
///
/// throws  SolverError if a step is not ok
std::vector<CutJump> cut_jumps(const TradeoffScene& scene, Integrator& integrator, double h);

}  // namespace dartboard
