#pragma once
// The classical Runge-Kutta method for springs alone, in rows of four numbers.

#include <cstddef>
#include <vector>

#include "core/base/bytes.h"
#include "core/base/padded_vector.h"
#include "core/time/method/integrator.h"
#include "core/time/system/accelerations.h"

namespace dartboard {

/// The step of ClassicalRungeKutta, with its bits, in padded rows: each vertex is loaded and stored as one packet, and
/// one loop goes from the forces of a stage to the stage that follows.
class PaddedRungeKutta {
 public:
  /// Only springs may act between vertices, and lanes are on (core/base/lanes.h).
  static bool can_step(const SpringSystem& system);

  /// pre     can_step(system)
  StepResult step(const SpringSystem& system, const Terms& terms, Motion motion, double h, WorkCounters& work);
  std::size_t bytes() const { return bytes_of(x_, v_, force_, sum_x_, sum_v_); }

 private:
  std::vector<PaddedVector> x_, v_;          // of the stage
  std::vector<PaddedVector> force_;          // zero between steps
  std::vector<PaddedVector> sum_x_, sum_v_;  // weighted, over the stages
};

}  // namespace dartboard
