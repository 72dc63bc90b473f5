#pragma once
// The memory that an integrator must hold between its steps, computed by hand from the counts of a system: the oracle
// of Integrator::bytes.

#include <fmt/format.h>

#include <array>
#include <optional>

#include "core/base/lanes.h"
#include "core/base/padded_vector.h"
#include "core/plain/error.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/integrators.h"
#include "core/time/solve/step_solver.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/node_pattern.h"

namespace dartboard::memory {

constexpr std::size_t vector = sizeof(Eigen::Vector3d), block = sizeof(Eigen::Matrix3d);

/// The memory of a method in addition to its matrices: columns of vectors by vertex, and, if anything is damped, the
/// directions of the springs and factors of their flow.
struct Columns {
  std::string_view integrator;
  std::size_t vectors;                    // by vertex
  std::size_t vectors_damped = 0;         // more of them with damping or viscosity
  bool directions = false, flow = false;  // of a splitting: by spring, and by spring and vertex
  std::size_t numbers = 0;                // by vertex: the tolerance of an implicit stage for its residual
};

// The columns of the classes of these names; an implicit stage has residual, direction and trial, and every method the
// position and velocity at its end.
constexpr std::array integrator_columns{
    Columns{"explicit-euler", 2},
    Columns{"symplectic-euler", 3, 0, true, true},
    Columns{"verlet", 3, 0, true, true},
    Columns{"verlet-compensated", 9, 2, true},
    Columns{"blanes-moan-4", 3, 1, true},
    Columns{"blanes-moan-4-compensated", 9, 2, true},
    Columns{"rk4", 5},  // padded where springs are alone
    Columns{"dormand-prince-54", 17},
    Columns{.integrator = "backward-euler", .vectors = 5, .numbers = 1},
    Columns{"baraff-witkin", 4},
    Columns{.integrator = "local-global", .vectors = 5, .numbers = 1},
    Columns{"ros2", 9},
    Columns{.integrator = "sdirk2", .vectors = 9, .numbers = 1},
    Columns{.integrator = "implicit-midpoint", .vectors = 5, .numbers = 1},
    Columns{.integrator = "energy-momentum", .vectors = 5, .numbers = 1},
    Columns{.integrator = "bdf2", .vectors = 9, .numbers = 1},
};

/// The counts that determine an integrator's memory.
struct SystemCounts {
  std::size_t vertices = 0, springs = 0;
  std::size_t links = 0;    // springs between two free vertices
  std::size_t anchors = 0;  // springs between a free and a fixed vertex
  bool damping = false, viscosity = false;
  bool damped_terms = false;
  bool springs_alone = false;
  bool held_axes = false;
};

inline SystemCounts counts_of(const SpringSystem& system) {
  const Terms terms = terms_of(system);
  SystemCounts counts{.vertices = system.vertex_count(),
                      .springs = system.springs.size(),
                      .damping = terms.damping,
                      .viscosity = terms.viscosity,
                      .damped_terms = has_damped_terms(system),
                      .springs_alone = system.terms.empty(),
                      .held_axes = !system.held_axes.empty()};
  for (const auto& [a, b] : system.ends) {
    if (a == b || (system.fixed[a] && system.fixed[b])) continue;
    ++(system.fixed[a] || system.fixed[b] ? counts.anchors : counts.links);
  }
  return counts;
}

/// Bytes after the first step that had something to solve; without matrix and factor of an implicit method.
inline std::size_t predicted_integrator_bytes(std::string_view integrator, const SystemCounts& c) {
  for (const Columns& columns : integrator_columns) {
    if (columns.integrator != integrator) continue;
    const bool damped = c.damping || c.viscosity;
    const bool padded = integrator == "rk4" && c.springs_alone && lanes_are_on();
    std::size_t bytes =
        c.vertices * ((padded ? sizeof(PaddedVector) : vector) * columns.vectors + sizeof(double) * columns.numbers);
    if (damped) bytes += c.vertices * vector * columns.vectors_damped;
    if (columns.directions && c.damping) bytes += c.springs * vector;
    if (columns.directions && c.damped_terms) bytes += c.vertices * vector;  // positions of vertices at rest
    if (columns.flow && damped) bytes += c.vertices * sizeof(double);        // inverse masses, 0 where fixed
    if (columns.flow && c.damping) bytes += c.springs * sizeof(double);      // relaxation of each spring
    const bool sweeps_padded = c.damping && c.springs > 0 && !c.held_axes && lanes_are_on();
    if (columns.flow && sweeps_padded) bytes += c.vertices * sizeof(PaddedVector);  // velocities during sweeps
    if (columns.flow && c.viscosity) bytes += c.vertices * sizeof(double);  // the remaining part of each velocity
    return bytes;
  }
  throw InputError(fmt::format("the memory of an integrator '{}' is not known", integrator));
}

/// Bytes of the matrices, the factor and the solver's vectors; 0 for an explicit method.
inline std::size_t predicted_solver_bytes(std::string_view integrator, const SpringSystem& system) {
  if (!scheme_of(integrator).implicit) return 0;
  const bool scalar = integrator == "local-global";
  const ImplicitOptions options = scalar ? LocalGlobal::with_iterations(20) : ImplicitOptions{};
  const SystemCounts c = counts_of(system);
  const NodePattern pattern = node_pattern_of(system);
  const std::size_t entries = pattern.row.size();
  // the springs' blocks with their sources, inertia and diagonal: once at present, once as they were factored
  const std::size_t springs_form = c.vertices * (sizeof(double) + 1 + block) +
                                   c.springs * (sizeof(SpringEnds) + vector + 4 * sizeof(double)) +
                                   (c.links + c.anchors) * sizeof(std::uint32_t);
  const std::size_t rows = scalar ? 1 : 3, capacity = c.vertices + options.cholesky.spare_nodes;
  std::size_t bytes = 2 * springs_form + sizeof(SpringTangent) * c.springs;
  bytes += 2 * pattern.bytes() + (c.vertices + entries) * block;  // the pattern, and the matrix on a copy of it
  bytes += scalar ? pattern.bytes() + (c.vertices + entries) * sizeof(double) : NodePattern().bytes();
  if (!scalar) bytes += 3 * c.vertices * vector;  // conjugate gradients
  bytes += bytes_of(pattern.column_start, pattern.row) + capacity * (1 + rows) * sizeof(int);
  bytes += 3 * capacity * sizeof(double);  // the right-hand side
  return bytes + sizeof(double) * Cholesky::forecast(pattern, rows, options.cholesky).numbers;
}

}  // namespace dartboard::memory
