#pragma once
// The one system of equations that every implicit method solves in its stages.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/time/method/trial_state.h"
#include "core/time/solve/step_solver.h"

namespace dartboard {

/// Where the forces of a stage are taken.
enum class StageForce : std::uint8_t {
  at_end,            // f(xh + tau w, w)
  discrete_gradient  // between xh and xh + 2 tau w, so that the work they do is the elastic energy they lose
};

/// Newton's method for the velocities w of a stage: r(w) = M (w - vh) - tau f(xh + tau w, w) = 0.
///
/// With conservative forces r is the gradient of the incremental potential
/// |w - vh|_M^2 / 2 + U(xh + tau w) + tau/2 sum c (d.dw)^2 + tau/2 sum viscosity |w|^2, the directions d of the dampers
/// held, and the positions in damped force terms; a line search on the potential makes the method globally convergent.
/// Without the dissipation in it the search would stall. Its changes are summed spring by spring from differences that
/// do not cancel, and a change within their rounding is accepted. The matrix is M + tau C + tau^2 K (tangent.h):
/// exact first, projected where that is not positive definite. Where ten iterations have not lowered |r|, K gets the
/// tension of dampers too, which is what turns with them.
///
/// Converged when at every vertex |r| / m is within tolerance times the largest of |vh| and tau |f| / m, which compares
/// accelerations whatever the masses, or within what rounding leaves of r. With a
/// tolerance of 0, iterations go on below that until they stop gaining.
/// source  Longva, Loeschner, Fernandez, Larionov, Ascher, Bender: Pitfalls of projection, arXiv 2311.14526
class ImplicitStage {
 public:
  explicit ImplicitStage(const ImplicitOptions& options) : options_(options), solver_(options) {}

  void begin_step(const WorkCounters& work = {}) { solver_.begin_step(work); }
  void system_changed() {
    solver_.system_changed();
    terms_.forget();
  }

  /// Find w, starting from the w given. Fixed vertices keep the velocity they have in vh.
  ///
  /// returns newton_stalled with the residual in the norm of M^-1, not_positive_definite, or nonfinite, when there is
  ///         no solution to use
  StepResult solve(const SpringSystem& system, std::span<const Eigen::Vector3d> xh, std::span<const Eigen::Vector3d> vh,
                   double tau, StageForce force, std::span<Eigen::Vector3d> w, WorkCounters& work);

  template <class Archive>
  void state(Archive& archive) {
    archive(solver_);
  }

  StepSolver& solver() { return solver_; }
  std::size_t bytes() const { return solver_.bytes() + bytes_of(residual_, direction_, trial_, forces_, allowed_); }
  std::size_t solver_bytes() const { return solver_.bytes(); }
  const ImplicitOptions& options() const { return options_; }

 private:
  struct Problem {
    const SpringSystem& system;
    std::span<const Eigen::Vector3d> xh, vh;
    double tau;
    StageForce force;
  };
  void set_residual(const Problem& p, std::span<const Eigen::Vector3d> w, WorkCounters& work);
  template <bool damped>
  void subtract_forces(const Problem& p, std::span<const Eigen::Vector3d> w);
  void set_allowed(const Problem& p, std::span<const Eigen::Vector3d> w);
  double excess() const;
  StepResult nonfinite_residual(double excess) const;
  double residual_norm(const Problem& p) const;
  struct Change {
    double value, rounding;
  };
  double residual_scale() const;
  Change potential_change(const Problem& p, std::span<const Eigen::Vector3d> w, double alpha, double unit) const;
  void choose_start(const Problem& p, std::span<Eigen::Vector3d> w, WorkCounters& work);
  bool search(const Problem& p, std::span<Eigen::Vector3d> w, WorkCounters& work);

  ImplicitOptions options_;
  StepSolver solver_;
  KnownTerms terms_;
  std::vector<Eigen::Vector3d> residual_, direction_, trial_;
  std::vector<Eigen::Vector3d> forces_;  // of force terms
  std::vector<double> allowed_;
};

}  // namespace dartboard
