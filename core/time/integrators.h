#pragma once
// The table of all time integrators, by name.

#include <memory>
#include <span>
#include <string_view>

#include "core/time/method/integrator.h"
#include "core/time/solve/step_solver.h"

namespace dartboard {

struct IntegratorEntry {
  std::string_view name;  // that of its scheme
  std::unique_ptr<Integrator> (*make)();
  /// Makes it with another linear solver than its own; null for explicit methods, and where the method is its solver.
  std::unique_ptr<Integrator> (*make_with)(LinearSolver solver) = nullptr;
};

/// All integrators, from the simplest to the most elaborate.
std::span<const IntegratorEntry> integrators();

/// throws  InputError for a name that is not in the table; the message lists those that are
std::unique_ptr<Integrator> make_integrator(std::string_view name);
/// Its scheme.
/// throws  as make_integrator
const Scheme& scheme_of(std::string_view name);

struct SolverEntry {
  std::string_view name;
  LinearSolver solver;
};

/// The linear solvers that a user can choose from.
std::span<const SolverEntry> linear_solvers();

/// The integrator with the linear solver named, or with its own where `solver` is empty.
///
/// throws  InputError for names that are not in the tables, and for an integrator without a choice of solvers; the
///         message lists those with a choice
std::unique_ptr<Integrator> make_integrator(std::string_view name, std::string_view solver);

}  // namespace dartboard
