#pragma once
// Paired times of the work of linear solvers for a step and for a topological change.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "core/time/system/node_matrix.h"

namespace dartboard {

/// Times of one body, and the work behind them.
struct SolverTimes {
  std::string body;  // "512 vertices, at rest"
  std::size_t vertices = 0;
  bool stretched = false;
  double h_omega = 0.0;
  std::size_t terms = 0;  // of rank one, that make up the change
  std::size_t rows = 0;   // that the rule replaced instead; 0 where it did not
  std::vector<Sample> samples;
  std::vector<std::string> tasks;

  /// Median over the rounds of task / baseline in the same round. The interval is over the rounds of this one process:
  /// it shows how steady the process was, not the value of another one (paired.h), and is to be printed as such.
  Figure ratio(const std::string& task, const std::string& baseline) const;
  double milliseconds(const std::string& task) const;  // median
  Figure time_ms(const std::string& task) const;       // and its interval over the rounds
};

/// Bound on the normwise backward error of a solution by a factor, after so many updates of rank one.
///
/// Higham, theorem 10.4: (A + E) x = b with |E| <= gamma_{3n+1} |L| |L'|, and the norm of |L| |L'| is at most the trace
/// of A, which is at most n times the norm of A. An update is as backward stable as a factorisation and counts as one.
double factor_bound(std::size_t unknowns, std::size_t updates);

/// No timing without agreement: all contenders solve the same system.
///
/// throws  SolverError for a task whose solution x of A x = b has a larger normwise backward error
void require_agreement(const std::string& task, const BlockMatrix& matrix, std::span<const Eigen::Vector3d> b,
                       std::span<const Eigen::Vector3d> x, double bound);

/// One interior vertex is dissociated, another one in each round: the factor follows, by the rule, by rank-one terms
/// and by rows, or is analysed with the old ordering extended and found again; with AMD and with METIS. Assembly of the
/// matrix, which all need, is left out; finding the terms is included. The factor before is ready for updates.
///
/// throws  SolverError for a task whose factor does not solve the system it was made for, within `factor_bound`, before
///         the timing or in any of its rounds
SolverTimes time_updates(int side, double stretch, int rounds, std::uint64_t seed);

/// One linearly implicit step of liver564 in soft motion, with h [s] of `h_omega`: conjugate gradients to a residual of
/// 1e-6, a fresh factor, and a kept one.
///
/// throws  SolverError for a solver whose velocities do not solve the equations of the step within its bound, or that
///         leaves another state in another round
SolverTimes time_implicit_step(double h_omega, int rounds, std::uint64_t seed);

}  // namespace dartboard
