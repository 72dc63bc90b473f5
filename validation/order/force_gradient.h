#pragma once
// Forces against the derivative of the energy.

#include <cstdint>

#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The force component that comes closest to its bound, or exceeds it most.
struct ForceGradient {
  double ratio = 0.0;          // of the deviation to the bound; at most 1 if all is well
  double deviation = 0.0;      // [N] of that component
  double bound = 0.0;          // [N]
  double largest_force = 0.0;  // [N] of any vertex
  std::uint32_t vertex = 0;
  int axis = 0;
};

/// Core's conservative forces at the start of a scene against central differences of the energy of its plain network,
/// in extended precision. The bound is derived in the source.
ForceGradient compare_forces_with_energy(const TradeoffScene& scene);

}  // namespace dartboard
