#pragma once
// What an integrator will hold between its steps, from the counts of a system: the prediction beside
// Integrator::bytes, which is what it does hold.

#include <cstddef>
#include <string_view>

#include "core/time/system/spring_system.h"

namespace dartboard {

/// The counts that an integrator's memory follows from.
struct SystemCounts {
  std::size_t vertices = 0, springs = 0;
  std::size_t links = 0;    // springs between two free vertices
  std::size_t anchors = 0;  // springs between a free and a fixed vertex
  bool damping = false, viscosity = false;
};
SystemCounts counts_of(const SpringSystem& system);

/// Bytes after the first step that had something to solve; no matrix and no factor of an implicit method.
///
/// throws  InputError for an integrator that is not in the table
std::size_t predicted_integrator_bytes(std::string_view integrator, const SystemCounts& counts);

/// Bytes of the matrices, the factor and what solves with it; 0 for an explicit method.
///
/// The factor is ordered and analysed for that, and not computed: how much it fills in is no matter of counts.
/// cost    O(numbers of the factor)
std::size_t predicted_solver_bytes(std::string_view integrator, const SpringSystem& system);

}  // namespace dartboard
