#include "core/time/solve/cholesky_implementation.h"

#include <algorithm>
#include <cmath>

#include "core/time/solve/stop_request.h"
#include "core/time/system/nan_proof.h"

// Defined where OpenBLAS is the BLAS.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace dartboard {

using Eigen::Vector3d;

Cholesky::Implementation::Implementation(const CholeskyOptions& o) : options(o) {
  cholmod_start(&common);
  common.print = 0;
  common.nmethods = 1;
  common.try_catch = 1;  // no error handler, no message
  common.error_handler = nullptr;
  common.quick_return_if_not_posdef = 1;
  common.final_pack = 0;  // columns keep room to grow, for updates
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

Cholesky::Implementation::~Implementation() {
  free_factor();
  cholmod_free_sparse(&A, &common);
  cholmod_free_dense(&X, &common);
  cholmod_free_dense(&Y, &common);
  cholmod_free_dense(&E, &common);
  cholmod_finish(&common);
}

void Cholesky::Implementation::free_factor() {
  if (L) cholmod_free_factor(&L, &common);
  if (symbolic) cholmod_free_factor(&symbolic, &common);
  factored = pattern_kept = false;
}

void Cholesky::Implementation::copy_values(const NodeEntries& m) {
  const std::size_t d = rows_per_node;
  double sum = 0.0;
  double* value = static_cast<double*>(A->x);
  for (std::size_t j = 0; j < m.nodes; ++j) {
    for (std::size_t c = 0; c < d; ++c) {
      for (std::size_t r = c; r < d; ++r) *value++ = m.diagonal_at(j, r, c);
      for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k)
        for (std::size_t r = 0; r < d; ++r) *value++ = m.below_at(k, r, c);
    }
    sum += m.diagonal_at(j, 0, 0);
  }
  // Spare rows are of the size of the others, so that entries added by an update are not lost against them.
  spare = m.nodes ? sum / static_cast<double>(m.nodes) : 1.0;
  for (std::size_t k = (capacity() - m.nodes) * d; k > 0; --k) *value++ = spare;
}

SolveStatus Cholesky::Implementation::failure(std::size_t position) {
  const std::size_t unknown = static_cast<std::size_t>(static_cast<const int*>(L->Perm)[position]);
  failed = static_cast<std::uint32_t>(unknown / rows_per_node);
  factored = false;
  return SolveStatus::not_positive_definite;
}

SolveStatus Cholesky::Implementation::memory_failure() {
  free_factor();
  return SolveStatus::out_of_memory;
}

// CHOLMOD returns TRUE for a matrix that is not positive definite, and some such matrices have a factor L D L'.
SolveStatus Cholesky::Implementation::checked() {
  factored = false;
  if (common.status < CHOLMOD_OK) return memory_failure();
  if (common.status == CHOLMOD_NOT_POSDEF || L->minor < L->n) return failure(std::min<std::size_t>(L->minor, L->n - 1));
  if (common.status != CHOLMOD_OK || L->xtype != CHOLMOD_REAL) return SolveStatus::not_factored;
  if (!L->is_super) {
    const int* start = static_cast<const int*>(L->p);
    const double* value = static_cast<const double*>(L->x);
    for (std::size_t j = 0; j < L->n; ++j) {
      const double pivot = value[start[j]];
      if (!std::isfinite(pivot)) return SolveStatus::not_finite;
      if (!(pivot > 0.0)) return failure(j);
    }
  }
  factored = true;
  return SolveStatus::ok;
}

// Work predicted to take long gets a thread of its own, which keeps this object alive if the work is given up.
int Cholesky::Implementation::unless_stopped(double seconds, std::function<int(Implementation&)> work) {
  if (!may_be_stopped(seconds)) return work(*this);
  const auto result = std::make_shared<int>(0);
  do_unless_stopped([self = shared_from_this(), work = std::move(work), result] { *result = work(*self); });
  return *result;
}

SolveStatus Cholesky::Implementation::factorise(const NodeEntries& m) {
  factored = false;
  failed = NodePattern::none;
  if (m.nodes == 0) return SolveStatus::not_factored;
  const bool same_rows = m.rows == rows_per_node;
  if (!same_rows) order.clear();
  rows_per_node = m.rows;
  if (!L || !same_rows || column_start != m.pattern.column_start || row != m.pattern.row || m.nodes != order_nodes) {
    const double seconds = predicted_analysis_seconds(m.pattern);
    const bool analysed =
        may_be_stopped(seconds)
            ? unless_stopped(seconds, [p = m.pattern](Implementation& self) { return self.analyse(p) ? 1 : 0; }) != 0
            : analyse(m.pattern);
    if (!analysed) return memory_failure();
  } else if (!pattern_kept) {
    cholmod_free_factor(&L, &common);
    L = cholmod_copy_factor(symbolic, &common);
    if (!L) return memory_failure();
    pattern_kept = true;
  }
  copy_values(m);
  const double* value = static_cast<const double*>(A->x);
  const int entries = static_cast<const int*>(A->p)[A->ncol];
  for (int k = 0; k < entries; ++k)
    if (!std::isfinite(value[k])) return SolveStatus::not_finite;
  common.status = CHOLMOD_OK;
  const int done = unless_stopped(factorisation_cost(),
                                  [](Implementation& self) { return cholmod_factorize(self.A, self.L, &self.common); });
  if (!done && common.status >= CHOLMOD_OK) return SolveStatus::not_factored;
  ++counters.factorisations;
  updates = 0;
  const SolveStatus status = checked();
  if (status == SolveStatus::ok && options.ready_for_updates && L->is_super) {
    pattern_kept = false;
    if (!cholmod_change_factor(CHOLMOD_REAL, 0, 0, 0, 1, L, &common)) return memory_failure();
    return checked();
  }
  return status;
}

SolveStatus Cholesky::Implementation::solve(std::span<const Vector3d> right, std::span<Vector3d> x) {
  if (!factored) return SolveStatus::not_factored;
  const std::size_t n = L->n, d = rows_per_node, columns = 3 / d;
  b.assign(n * columns, 0.0);
  for (std::size_t i = 0; i < right.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) b[d == 3 ? 3 * i + c : c * n + i] = right[i][static_cast<Eigen::Index>(c)];
  cholmod_dense B{};
  B.nrow = B.d = n;
  B.ncol = columns;
  B.nzmax = n * columns;
  B.x = b.data();
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  common.status = CHOLMOD_OK;
  if (!cholmod_solve2(CHOLMOD_A, L, &B, nullptr, &X, nullptr, &Y, &E, &common))
    return common.status < CHOLMOD_OK ? SolveStatus::out_of_memory : SolveStatus::not_factored;
  ++counters.solves;
  const double* solution = static_cast<const double*>(X->x);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) x[i][static_cast<Eigen::Index>(c)] = solution[d == 3 ? 3 * i + c : c * n + i];
  return all_finite(x) ? SolveStatus::ok : SolveStatus::not_finite;
}

}  // namespace dartboard
