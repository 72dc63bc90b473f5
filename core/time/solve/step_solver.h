#pragma once
// Solutions with the matrix of an implicit step, M + tau C + tau^2 K, by the linear solver chosen.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/forces/force_term.h"
#include "core/time/method/integrator.h"
#include "core/time/solve/cholesky.h"
#include "core/time/solve/conjugate_gradients.h"
#include "core/time/solve/step_matrix.h"

namespace dartboard {

enum class LinearSolver : std::uint8_t {
  fresh_factor,         // a Cholesky factor of each matrix
  kept_factor,          // conjugate gradients with one factor for as long as it serves, updated at topological changes
  conjugate_gradients,  // no factor
  laplacian             // the constant matrix m + tau c + tau^2 k of the spring graph, whatever the directions
};
enum class TangentPolicy : std::uint8_t {
  on_demand,  // exact first; projected where that is not positive definite
  projected   // always
};

/// How far a solution with a kept factor must go: for an iteration of Newton's method, or all the way.
enum class Accuracy : std::uint8_t { iteration, full };

/// How implicit methods solve their equations.
struct ImplicitOptions {
  LinearSolver solver = LinearSolver::kept_factor;
  TangentPolicy tangent = TangentPolicy::on_demand;
  double tolerance = 1e-10;      // of Newton's method: residual acceleration, relative to what acts
  int max_iterations = 300;      // of Newton's method
  double kept_tolerance = 0.03;  // of the solutions with a kept factor, for an iteration
  int patience = 12;             // iterations that a solution with a kept factor may take; then a fresh one is due
  bool iterate_once = false;     // the iterations allowed are the method: no tolerance has to be met
  CholeskyOptions cholesky = {.spare_nodes = 32};
  ConjugateGradientsOptions conjugate_gradients = {.tolerance = 1e-6, .max_iterations = 2000};
};

/// The tangents at some linearisation: those of all springs, and the places where those of the force terms are taken.
struct TangentsAt {
  std::function<void(Compression, std::vector<SpringTangent>&)> springs;
  StagePlaces at{};
};

/// The matrix and its solvers, kept between steps.
///
/// A matrix that is not positive definite is replaced by that of the projected tangents. A factor that is kept is that
/// of an earlier matrix: it preconditions conjugate gradients on the present one.
class StepSolver {
 public:
  explicit StepSolver(const ImplicitOptions& options) : options_(options), cholesky_(options.cholesky) {}

  /// Exact tangents may be tried again. The kept state and the work so far are noted for `undo_step`.
  void begin_step(const WorkCounters& work = {}) {
    projecting_ = options_.tangent == TangentPolicy::projected;
    wait_ = remaining_ = 0;
    before_ = {work, tau_, changed_, ready_, due_, cholesky_.generation()};
  }
  /// Go back to the beginning of the step: the next solutions are those that would have followed then.
  ///
  /// returns  false where the factor of that time has been replaced or given up since
  bool undo_step(WorkCounters& work);
  /// Topology or material may have changed: check them before the next solution.
  void system_changed() { changed_ = true; }

  /// Get ready to solve with M + tau C + tau^2 K at this linearisation.
  SolveStatus prepare(const SpringSystem& system, const TangentsAt& tangents, double tau, WorkCounters& work);
  /// The exact matrix has failed: project in the next 1, after another failure 2, then 4, ... calls of `prepare`.
  void project(WorkCounters& work);
  bool is_projecting() const { return projecting_; }

  /// x = A^-1 b, in two arrays. Conjugate gradients may find here that A is indefinite.
  SolveStatus solve(std::span<const Eigen::Vector3d> b, std::span<Eigen::Vector3d> x, Accuracy accuracy,
                    WorkCounters& work);

  /// Writes or reads the factor, its matrix, and when it serves; what a step fills before it reads it is left out.
  template <class Archive>
  void state(Archive& archive) {
    archive(cholesky_, factored_, pattern_, tau_, changed_, ready_, due_);
  }

  const StepMatrix& matrix() const { return matrix_; }
  /// The tangents that the matrix was made of.
  std::span<const SpringTangent> tangents() const { return tangents_; }
  const Cholesky& cholesky() const { return cholesky_; }
  std::size_t bytes() const {
    return cholesky_.bytes() + conjugate_gradients_.bytes() + matrix_.bytes() + factored_.bytes() + pattern_.bytes() +
           blocks_.bytes() + scalars_.bytes() + bytes_of(tangents_);
  }

 private:
  SolveStatus factorise(std::span<const RankOneTerm> terms, bool follow, WorkCounters& work);
  void evaluate(const TangentsAt& tangents, const SpringSystem& system, double tau);

  ImplicitOptions options_;
  Cholesky cholesky_;
  ConjugateGradients conjugate_gradients_;
  StepMatrix matrix_;    // of the last `prepare`
  StepMatrix factored_;  // the matrix of the factor
  NodePattern pattern_;
  BlockMatrix blocks_;
  ScalarMatrix scalars_;
  std::vector<SpringTangent> tangents_;
  double tau_ = 0.0;
  int wait_ = 0, remaining_ = 0;  // calls of `prepare` with projection after the last failure, and how many are left
  bool changed_ = true, projecting_ = false, ready_ = false, due_ = false;

  struct Before {  // a step
    WorkCounters work;
    double tau = 0.0;
    bool changed = true, ready = false, due = false;
    std::uint64_t generation = 0;  // of the factor
  };
  Before before_;
};

/// The factor that a solver with these options makes of the matrix of a step.
/// throws  as Cholesky::forecast
std::optional<FactorForecast> forecast_factor(const SpringSystem& system, const ImplicitOptions& options);

/// The diagnosis of a solution that failed.
StepResult diagnosis_of(SolveStatus status, const StepSolver& solver);

}  // namespace dartboard
