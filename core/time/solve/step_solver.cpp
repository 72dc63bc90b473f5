#include "core/time/solve/step_solver.h"

#include <algorithm>
#include <cmath>

namespace dartboard {

using Eigen::Vector3d;

void StepSolver::evaluate(const TangentsAt& tangents, const SpringSystem& system, double tau) {
  if (options_.solver == LinearSolver::laplacian) {
    tangents_.resize(system.springs.size());
    for (std::size_t e = 0; e < tangents_.size(); ++e) {
      const double k = system.springs[e].stiffness + system.springs[e].damping / tau;
      tangents_[e] = {Vector3d::Zero(), k, k, 0.0};
    }
  } else {
    tangents.springs(projecting_ ? Compression::projected : Compression::exact, tangents_);
  }
  if (system.terms.empty()) {
    matrix_.evaluate(system, tangents_, tau);
    return;
  }
  using Kind = TermTangents::Kind;
  const Kind kind = options_.solver == LinearSolver::laplacian ? Kind::constant
                    : projecting_                              ? Kind::projected
                                                               : Kind::exact;
  // conjugate gradients need no pattern; where they found none, that of the last change here is used
  if (changed_ || pattern_.node_count() != system.vertex_count()) pattern_ = node_pattern_of(system);
  matrix_.evaluate(system, tangents_, tau, pattern_, {tangents.at, kind});
}

// The factor of `factored_`, to which the terms lead.
SolveStatus StepSolver::factorise(std::span<const RankOneTerm> terms, bool follow, WorkCounters& work) {
  const CholeskyCounters before = cholesky_.counters();
  SolveStatus status = SolveStatus::ok;
  ++work.assemblies;
  factored_.assemble(pattern_, blocks_);
  if (options_.solver == LinearSolver::laplacian) {
    scalars_.pattern = pattern_;
    const auto first = [](const Eigen::Matrix3d& block) { return block(0, 0); };
    scalars_.diagonal.resize(blocks_.diagonal.size());
    scalars_.below.resize(blocks_.below.size());
    std::ranges::transform(blocks_.diagonal, scalars_.diagonal.begin(), first);
    std::ranges::transform(blocks_.below, scalars_.below.begin(), first);
    std::vector<RankOneTerm> of_one_coordinate;
    for (const RankOneTerm& term : terms)
      if (term.direction.x() != 0.0) of_one_coordinate.push_back(term);
    status = follow ? cholesky_.follow(scalars_, of_one_coordinate) : cholesky_.factorise(scalars_);
  } else {
    status = follow ? cholesky_.follow(blocks_, terms) : cholesky_.factorise(blocks_);
  }
  work.analyses += cholesky_.counters().analyses - before.analyses;
  work.factorisations += cholesky_.counters().factorisations - before.factorisations;
  work.rank_one_updates += cholesky_.counters().rank_one_updates - before.rank_one_updates;
  if (status == SolveStatus::ok) work.factor_nonzeros = static_cast<std::uint64_t>(cholesky_.factor_nonzeros());
  return status;
}

void StepSolver::project(WorkCounters& work) {
  projecting_ = true;
  wait_ = std::min(wait_ == 0 ? 1 : 2 * wait_, 16);
  remaining_ = wait_;
  ++work.projections;
}

bool StepSolver::undo_step(WorkCounters& work) {
  // where there was no factor before the step, dropping the present one loses nothing
  if (before_.generation == 0) cholesky_ = Cholesky(options_.cholesky);
  if (cholesky_.generation() != before_.generation) return false;
  work = before_.work;
  tau_ = before_.tau;
  changed_ = before_.changed;
  ready_ = before_.ready;
  due_ = before_.due;
  return true;
}

SolveStatus StepSolver::prepare(const SpringSystem& given, const TangentsAt& tangents, double tau, WorkCounters& work) {
  if (projecting_ && options_.tangent == TangentPolicy::on_demand && remaining_-- == 0) projecting_ = false;
  const bool laplacian = options_.solver == LinearSolver::laplacian;
  SpringSystem system = given;
  if (laplacian) system.held_axes = {};  // one matrix for all coordinates
  const bool keeps = laplacian || options_.solver == LinearSolver::kept_factor;
  // Steps that should be equal may differ by rounding; and as a preconditioner, a factor for a tau that differs by a
  // fifth is still a good one: the condition number is at most 1.44.
  const bool same_step = std::abs(tau - tau_) <= (laplacian ? 1e-12 : 0.2) * std::abs(tau_);
  const bool usable = keeps && ready_ && !due_ && same_step;
  if (laplacian && usable && !changed_) return SolveStatus::ok;
  evaluate(tangents, system, tau);
  if (options_.solver == LinearSolver::conjugate_gradients || (usable && !changed_)) {
    if (!system.terms.empty()) changed_ = false;  // its pattern is found
    return SolveStatus::ok;
  }

  if (changed_ && system.terms.empty()) pattern_ = node_pattern_of(system);
  ready_ = false;
  std::vector<RankOneTerm> terms;
  // the change of an element has rank nine; and changes at held axes have different directions at both ends
  const bool follow = usable && system.terms.empty() && system.held_axes.empty();
  if (follow) {
    terms = factored_.follow(system, tangents_, cholesky_.spare_diagonal());
  } else {
    factored_ = matrix_;
    tau_ = tau;
  }
  changed_ = due_ = false;
  SolveStatus status = factorise(terms, follow, work);
  if (status == SolveStatus::not_positive_definite && follow) {
    factored_ = matrix_;
    tau_ = tau;
    status = factorise({}, false, work);
  }
  if (status == SolveStatus::not_positive_definite && !projecting_ && !laplacian) {
    project(work);
    return prepare(system, tangents, tau, work);
  }
  ready_ = status == SolveStatus::ok;
  return status;
}

SolveStatus StepSolver::solve(std::span<const Vector3d> b, std::span<Vector3d> x, Accuracy accuracy,
                              WorkCounters& work) {
  const bool full = accuracy == Accuracy::full;
  ConjugateGradientsResult result;
  switch (options_.solver) {
    case LinearSolver::fresh_factor:
    case LinearSolver::laplacian: ++work.solves; return cholesky_.solve(b, x);
    case LinearSolver::kept_factor: {
      const std::uint64_t before = cholesky_.counters().solves;
      result = conjugate_gradients_.solve(
          matrix_, cholesky_, b, x,
          {.tolerance = full ? 1e-12 : options_.kept_tolerance, .max_iterations = 4 * options_.patience});
      if (result.iterations > (full ? 3 : 1) * options_.patience) due_ = true;
      if (result.status == SolveStatus::not_converged) {
        // The iterate found by then is a direction of descent: Newton's method can go on from it.
        result.status = SolveStatus::ok;
        if (full) {
          factored_ = matrix_;
          tau_ = matrix_.tau();
          due_ = false;
          result.status = factorise({}, false, work);
          ready_ = result.status == SolveStatus::ok;
          if (ready_) result.status = cholesky_.solve(b, x);
        }
      }
      work.solves += cholesky_.counters().solves - before;
      break;
    }
    case LinearSolver::conjugate_gradients:
      ++work.solves;
      for (Vector3d& p : x) p.setZero();
      result = conjugate_gradients_.solve(matrix_, b, x, options_.conjugate_gradients);
      break;
  }
  work.linear_iterations += static_cast<std::uint64_t>(result.iterations);
  return result.status;
}

std::optional<FactorForecast> forecast_factor(const SpringSystem& system, const ImplicitOptions& options) {
  if (options.solver == LinearSolver::conjugate_gradients) return std::nullopt;
  return Cholesky::forecast(node_pattern_of(system), options.solver == LinearSolver::laplacian ? 1 : 3,
                            options.cholesky);
}

StepResult diagnosis_of(SolveStatus status, const StepSolver& solver) {
  switch (status) {
    case SolveStatus::ok: return {};
    case SolveStatus::not_positive_definite: {
      const std::uint32_t node = solver.cholesky().failed_node();
      if (node == NodePattern::none) return {StepCode::not_positive_definite, Witness::none, 0, "curvature", 0.0};
      return {StepCode::not_positive_definite, Witness::vertex, node, "pivot", 0.0};
    }
    case SolveStatus::not_finite: {
      for (std::uint32_t i = 0; i < solver.matrix().node_count(); ++i)
        if (const Eigen::Matrix3d& block = solver.matrix().diagonal_block(i); !block.allFinite())
          return {StepCode::nonfinite, Witness::vertex, i, "matrix", block.sum()};
      return {StepCode::nonfinite, Witness::none, 0, "solution", NAN};
    }
    case SolveStatus::not_converged: return {StepCode::newton_stalled, Witness::none, 0, "linear residual", NAN};
    case SolveStatus::not_factored:
    case SolveStatus::out_of_memory: return {StepCode::budget, Witness::none, 0, "memory", 0.0};
  }
  return {};
}

}  // namespace dartboard
