#include "core/time/solve/cholesky.h"

#include <numeric>

#include "core/plain/error.h"
#include "core/time/solve/backward_error.h"
#include "core/time/solve/cholesky_implementation.h"
#include "core/time/solve/stop_request.h"
#include "core/time/system/nan_proof.h"

namespace dartboard {

using Eigen::Vector3d;

std::string_view to_string(SolveStatus status) {
  switch (status) {
    case SolveStatus::ok: return "ok";
    case SolveStatus::not_positive_definite: return "not positive definite";
    case SolveStatus::not_finite: return "not finite";
    case SolveStatus::not_factored: return "no factor";
    case SolveStatus::not_converged: return "not converged";
    case SolveStatus::out_of_memory: return "out of memory";
  }
  return "?";
}

Cholesky::Cholesky(const CholeskyOptions& options) : implementation_(std::make_shared<Implementation>(options)) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

// Work that is given up keeps its data, and we begin anew.
template <class Action>
SolveStatus Cholesky::unless_stopped(Action&& action) {
  ++generation_;
  try {
    return action(*implementation_);
  } catch (const Stopped&) {
    implementation_ = std::make_shared<Implementation>(CholeskyOptions(implementation_->options));
    throw;
  }
}

SolveStatus Cholesky::factorise(const BlockMatrix& matrix) {
  return unless_stopped([&](Implementation& i) { return i.factorise(NodeEntries(matrix)); });
}
SolveStatus Cholesky::factorise(const ScalarMatrix& matrix) {
  return unless_stopped([&](Implementation& i) { return i.factorise(NodeEntries(matrix)); });
}
SolveStatus Cholesky::update(std::span<const RankOneTerm> terms) {
  ++generation_;
  return implementation_->has_room(terms) ? implementation_->update(terms) : SolveStatus::not_factored;
}
SolveStatus Cholesky::follow(const BlockMatrix& after, std::span<const RankOneTerm> terms) {
  return unless_stopped([&](Implementation& i) { return i.follow(NodeEntries(after), terms); });
}
SolveStatus Cholesky::follow(const ScalarMatrix& after, std::span<const RankOneTerm> terms) {
  return unless_stopped([&](Implementation& i) { return i.follow(NodeEntries(after), terms); });
}
SolveStatus Cholesky::solve(std::span<const Vector3d> b, std::span<Vector3d> x) { return implementation_->solve(b, x); }

bool Cholesky::has_factor() const { return implementation_->factored; }
bool Cholesky::is_supernodal() const { return implementation_->factored && implementation_->L->is_super; }
double Cholesky::update_cost(std::span<const RankOneTerm> terms) const { return implementation_->update_cost(terms); }
double Cholesky::factorisation_cost() const { return implementation_->factorisation_cost(); }
std::size_t Cholesky::capacity() const { return implementation_->capacity(); }
double Cholesky::spare_diagonal() const { return implementation_->spare; }
double Cholesky::factor_nonzeros() const {
  const cholmod_factor* L = implementation_->L;
  if (!implementation_->factored || L->is_super) return implementation_->nonzeros;
  const int* count = static_cast<const int*>(L->nz);
  return std::accumulate(count, count + L->n, 0.0);
}
double Cholesky::factor_flops() const { return implementation_->flops; }
std::uint32_t Cholesky::failed_node() const { return implementation_->failed; }
const CholeskyCounters& Cholesky::counters() const { return implementation_->counters; }
std::size_t Cholesky::bytes() const {
  const Implementation& i = *implementation_;
  return bytes_of(i.b, i.column_start, i.row, i.order, i.inverse) +
         (i.factored ? sizeof(double) * static_cast<std::size_t>(factor_nonzeros()) : 0);
}

FactorForecast Cholesky::forecast(const NodePattern& pattern, std::size_t rows_per_node,
                                  const CholeskyOptions& options) {
  Implementation analysis(options);
  analysis.rows_per_node = rows_per_node;
  if (!analysis.analyse(pattern)) throw SolverError("a matrix could not be analysed");
  return {.unknowns = rows_per_node * pattern.node_count(),
          .numbers = static_cast<std::size_t>(analysis.nonzeros),
          .seconds = analysis.factorisation_cost()};
}

SolveStatus Cholesky::solve_refined(const BlockMatrix& matrix, std::span<const Vector3d> b, std::span<Vector3d> x) {
  const std::vector<Vector3d> right(b.begin(), b.end());
  if (const SolveStatus status = solve(right, x); status != SolveStatus::ok) return status;
  const std::vector<ExtendedVector> r = extended_residual(matrix, right, x);
  std::vector<Vector3d> correction(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) correction[i] = r[i].cast<double>();
  if (const SolveStatus status = solve(correction, correction); status != SolveStatus::ok) return status;
  ++implementation_->counters.refinements;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
  return all_finite(x) ? SolveStatus::ok : SolveStatus::not_finite;
}

}  // namespace dartboard
