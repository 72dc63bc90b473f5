#include "core/time/cholesky.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/plain/error.h"
#include "core/time/nan_proof.h"

// Present where OpenBLAS is the BLAS.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace dartboard {

using Eigen::Matrix3d;
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

namespace {

constexpr int none = -1;

double entry(const Matrix3d& block, int r, int c) { return block(r, c); }
double entry(double number, int, int) { return number; }

// Neighbours of every node, from the lower triangle.
struct Adjacency {
  std::vector<std::uint32_t> start, node;
  explicit Adjacency(const NodePattern& p) : start(p.node_count() + 1, 0), node(2 * p.row.size()) {
    const std::size_t n = p.node_count();
    for (std::size_t j = 0; j < n; ++j)
      for (std::uint32_t k = p.column_start[j]; k < p.column_start[j + 1]; ++k) {
        ++start[j + 1];
        ++start[p.row[k] + 1];
      }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t k = p.column_start[j]; k < p.column_start[j + 1]; ++k) {
        node[next[j]++] = p.row[k];
        node[next[p.row[k]]++] = j;
      }
  }
  std::span<const std::uint32_t> of(std::uint32_t j) const {
    return std::span(node).subspan(start[j], start[j + 1] - start[j]);
  }
};

// The node below `old_count` that shares most neighbours with `i`: the one it was dissociated from, if it was.
std::uint32_t twin_of(std::uint32_t i, std::size_t old_count, const Adjacency& adjacency,
                      std::vector<std::uint32_t>& shared) {
  std::uint32_t twin = NodePattern::none, most = 0;
  for (const std::uint32_t j : adjacency.of(i))
    for (const std::uint32_t k : adjacency.of(j)) {
      if (k >= old_count) continue;
      const std::uint32_t count = ++shared[k];
      if (count > most || (count == most && k < twin)) {
        most = count;
        twin = k;
      }
    }
  for (const std::uint32_t j : adjacency.of(i))
    for (const std::uint32_t k : adjacency.of(j)) shared[k] = 0;
  return twin;
}

// `order` of old nodes with those that are added put beside their twins, and spare ones last.
std::vector<int> extended(const std::vector<int>& order, std::size_t old_count, const NodePattern& pattern,
                          std::size_t capacity) {
  const std::size_t n = pattern.node_count();
  std::vector<int> result;
  result.reserve(capacity);
  std::vector<std::vector<int>> beside(old_count);
  std::vector<int> last;
  if (n > old_count) {
    const Adjacency adjacency(pattern);
    std::vector<std::uint32_t> shared(n, 0);
    for (auto i = static_cast<std::uint32_t>(old_count); i < n; ++i) {
      const std::uint32_t twin = twin_of(i, old_count, adjacency, shared);
      (twin == NodePattern::none ? last : beside[twin]).push_back(static_cast<int>(i));
    }
  }
  for (const int node : order) {
    if (static_cast<std::size_t>(node) >= old_count || static_cast<std::size_t>(node) >= n) continue;
    result.push_back(node);
    for (const int next : beside[static_cast<std::size_t>(node)]) result.push_back(next);
  }
  result.insert(result.end(), last.begin(), last.end());
  for (std::size_t i = n; i < capacity; ++i) result.push_back(static_cast<int>(i));
  return result;
}

}  // namespace

struct Cholesky::Implementation {
  CholeskyOptions options;
  CholeskyCounters counters;
  cholmod_common common;
  cholmod_factor* L = nullptr;
  cholmod_factor* symbolic = nullptr;  // L as it was analysed
  cholmod_sparse* A = nullptr;         // lower triangle of the unknowns
  cholmod_dense *X = nullptr, *Y = nullptr, *E = nullptr;
  std::vector<double> b;

  std::vector<std::uint32_t> column_start, row;  // pattern that L was analysed for
  std::size_t rows_per_node = 3;
  std::vector<int> order;    // of nodes
  std::vector<int> inverse;  // position of each unknown in L
  std::size_t order_nodes = 0;
  double order_nonzeros = 0.0;  // nnz(L) when the ordering was found
  double nonzeros = 0.0, flops = 0.0;
  double spare = 1.0;
  std::uint32_t failed = NodePattern::none;
  std::size_t updates = 0;  // of rank one, since L was factored
  bool factored = false;
  bool pattern_kept = false;  // L still has the form of its analysis

  explicit Implementation(const CholeskyOptions& o) : options(o) {
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.try_catch = 1;  // no error handler, no message
    common.error_handler = nullptr;
    common.quick_return_if_not_posdef = 1;
    common.final_pack = 0;  // columns keep room to grow, for updates
    if (openblas_set_num_threads) openblas_set_num_threads(1);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    free_factor();
    cholmod_free_sparse(&A, &common);
    cholmod_free_dense(&X, &common);
    cholmod_free_dense(&Y, &common);
    cholmod_free_dense(&E, &common);
    cholmod_finish(&common);
  }

  void free_factor() {
    if (L) cholmod_free_factor(&L, &common);
    if (symbolic) cholmod_free_factor(&symbolic, &common);
    factored = pattern_kept = false;
  }
  std::size_t capacity() const { return order.size(); }

  // The order of the nodes from CHOLMOD's AMD or METIS, on a graph of `per_node` rows for each node.
  bool find_order(const NodePattern& p, std::size_t per_node) {
    const std::size_t n = p.node_count() * per_node;
    cholmod_sparse* graph = cholmod_allocate_sparse(n, n, per_node * per_node * p.row.size() + n * per_node, 1, 1, -1,
                                                    CHOLMOD_PATTERN, &common);
    if (!graph) return false;
    int* start = static_cast<int*>(graph->p);
    int* index = static_cast<int*>(graph->i);
    int next = 0, column = 0;
    for (std::size_t j = 0; j < p.node_count(); ++j)
      for (std::size_t c = 0; c < per_node; ++c) {
        start[column++] = next;
        for (std::size_t r = c; r < per_node; ++r) index[next++] = static_cast<int>(j * per_node + r);
        for (std::uint32_t k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          for (std::size_t r = 0; r < per_node; ++r) index[next++] = static_cast<int>(p.row[k] * per_node + r);
      }
    start[column] = next;
    std::vector<int> permutation(n);
    const int found = options.ordering == Ordering::metis
                          ? cholmod_metis(graph, nullptr, 0, 1, permutation.data(), &common)
                          : cholmod_amd(graph, nullptr, 0, permutation.data(), &common);
    cholmod_free_sparse(&graph, &common);
    if (!found) return false;
    ++counters.orderings;
    order.clear();
    if (per_node == 1) {
      order = std::move(permutation);
    } else {
      // The unknowns of a node are not kept together by their own ordering: a node stands where its first one does.
      std::vector<std::uint8_t> seen(p.node_count(), 0);
      for (const int unknown : permutation)
        if (const std::size_t node = static_cast<std::size_t>(unknown) / per_node; !seen[node]) {
          seen[node] = 1;
          order.push_back(static_cast<int>(node));
        }
    }
    for (std::size_t i = 0; i < options.spare_nodes; ++i) order.push_back(static_cast<int>(p.node_count() + i));
    order_nodes = p.node_count();
    return true;
  }

  // The symbolic factor with the present order.
  bool analyse_with_order() {
    std::vector<int> permutation;
    permutation.reserve(order.size() * rows_per_node);
    for (const int node : order)
      for (std::size_t r = 0; r < rows_per_node; ++r)
        permutation.push_back(node * static_cast<int>(rows_per_node) + static_cast<int>(r));
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    common.final_ll = options.kind == FactorKind::simplicial ? 0 : common.final_ll;
    common.supernodal = options.kind == FactorKind::simplicial   ? CHOLMOD_SIMPLICIAL
                        : options.kind == FactorKind::supernodal ? CHOLMOD_SUPERNODAL
                                                                 : CHOLMOD_AUTO;
    L = cholmod_analyze_p(A, permutation.data(), nullptr, 0, &common);
    if (!L) return false;
    symbolic = cholmod_copy_factor(L, &common);
    if (!symbolic) return false;
    ++counters.analyses;
    nonzeros = common.lnz;
    flops = common.fl;
    const int* where = static_cast<const int*>(L->Perm);
    inverse.resize(L->n);
    for (std::size_t k = 0; k < L->n; ++k) inverse[static_cast<std::size_t>(where[k])] = static_cast<int>(k);
    return true;
  }

  // Make A's arrays for a pattern of p.node_count() nodes, and spare ones up to the capacity.
  bool shape(const NodePattern& p) {
    const std::size_t d = rows_per_node, spares = capacity() - p.node_count(), n = d * capacity();
    const std::size_t entries = p.node_count() * d * (d + 1) / 2 + p.row.size() * d * d + spares * d;
    cholmod_free_sparse(&A, &common);
    A = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_REAL, &common);
    if (!A) return false;
    int* start = static_cast<int*>(A->p);
    int* index = static_cast<int*>(A->i);
    int next = 0, column = 0;
    for (std::size_t j = 0; j < p.node_count(); ++j)
      for (std::size_t c = 0; c < d; ++c) {
        start[column++] = next;
        for (std::size_t r = c; r < d; ++r) index[next++] = static_cast<int>(j * d + r);
        for (std::uint32_t k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          for (std::size_t r = 0; r < d; ++r) index[next++] = static_cast<int>(p.row[k] * d + r);
      }
    for (; column < static_cast<int>(n); ++column) {
      start[column] = next;
      index[next++] = column;
    }
    start[column] = next;
    return true;
  }

  template <class Matrix>
  void copy_values(const Matrix& m) {
    const int d = static_cast<int>(rows_per_node);
    double sum = 0.0;
    double* value = static_cast<double*>(A->x);
    for (std::size_t j = 0; j < m.node_count(); ++j) {
      for (int c = 0; c < d; ++c) {
        for (int r = c; r < d; ++r) *value++ = entry(m.diagonal[j], r, c);
        for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k)
          for (int r = 0; r < d; ++r) *value++ = entry(m.below[k], r, c);
      }
      sum += entry(m.diagonal[j], 0, 0);
    }
    // Spare rows are of the size of the others, so that what an update puts there is not lost against them.
    spare = m.node_count() ? sum / static_cast<double>(m.node_count()) : 1.0;
    for (std::size_t k = (capacity() - m.node_count()) * rows_per_node; k > 0; --k) *value++ = spare;
  }

  template <class Matrix>
  bool analyse(const Matrix& m) {
    const NodePattern& p = m.pattern;
    free_factor();
    const bool keep_order = !order.empty() && p.node_count() >= order_nodes && order_nodes > 0;
    if (keep_order) {
      const std::size_t room =
          p.node_count() <= capacity() ? capacity() : p.node_count() + std::size_t{options.spare_nodes};
      order = extended(order, order_nodes, p, room);
      order_nodes = p.node_count();
    } else if (!find_order(p, options.graph == AnalysisGraph::nodes ? 1 : rows_per_node)) {
      return false;
    }
    if (!shape(p) || !analyse_with_order()) return false;
    if (keep_order && nonzeros > options.order_again * order_nonzeros) {
      free_factor();
      if (!find_order(p, options.graph == AnalysisGraph::nodes ? 1 : rows_per_node) || !shape(p) ||
          !analyse_with_order())
        return false;
      order_nonzeros = nonzeros;
    }
    if (!keep_order) order_nonzeros = nonzeros;
    column_start = p.column_start;
    row = p.row;
    pattern_kept = true;
    return true;
  }

  SolveStatus failure(std::size_t position) {
    const std::size_t unknown = static_cast<std::size_t>(static_cast<const int*>(L->Perm)[position]);
    failed = static_cast<std::uint32_t>(unknown / rows_per_node);
    factored = false;
    return SolveStatus::not_positive_definite;
  }
  SolveStatus memory_failure() {
    free_factor();
    return SolveStatus::out_of_memory;
  }

  // CHOLMOD returns TRUE for a matrix that is not positive definite; and L D L' exists for some that are not.
  SolveStatus checked() {
    factored = false;
    if (common.status < CHOLMOD_OK) return memory_failure();
    if (common.status == CHOLMOD_NOT_POSDEF || L->minor < L->n)
      return failure(std::min<std::size_t>(L->minor, L->n - 1));
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

  template <class Matrix>
  SolveStatus factorise(const Matrix& m, std::size_t per_node) {
    factored = false;
    failed = NodePattern::none;
    if (m.node_count() == 0) return SolveStatus::not_factored;
    if (per_node != rows_per_node) order.clear();
    rows_per_node = per_node;
    if (!L || column_start != m.pattern.column_start || row != m.pattern.row || m.node_count() != order_nodes) {
      if (!analyse(m)) return memory_failure();
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
    if (!cholmod_factorize(A, L, &common) && common.status >= CHOLMOD_OK) return SolveStatus::not_factored;
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

  SolveStatus update(std::span<const RankOneTerm> terms) {
    if (!factored) return SolveStatus::not_factored;
    for (const RankOneTerm& term : terms)
      if (!term.direction.allFinite() || !std::isfinite(term.weight)) return SolveStatus::not_finite;
    pattern_kept = false;  // entries may be added
    // What is added goes first: then no matrix in between is less definite than the last.
    for (const bool adding : {true, false}) {
      const auto count = static_cast<std::size_t>(std::count_if(
          terms.begin(), terms.end(), [adding](const RankOneTerm& t) { return (t.weight > 0.0) == adding; }));
      if (count == 0) continue;
      cholmod_sparse* C =
          cholmod_allocate_sparse(L->n, count, 2 * rows_per_node * count, 1, 1, 0, CHOLMOD_REAL, &common);
      if (!C) return memory_failure();
      int* start = static_cast<int*>(C->p);
      int* index = static_cast<int*>(C->i);
      double* value = static_cast<double*>(C->x);
      int next = 0, column = 0;
      for (const RankOneTerm& term : terms) {
        if ((term.weight > 0.0) != adding) continue;
        start[column++] = next;
        const double size = std::sqrt(std::abs(term.weight));
        const int first = next;
        for (const std::uint32_t node : {term.first, term.second}) {
          if (node == NodePattern::none) continue;
          for (std::size_t r = 0; r < rows_per_node; ++r) {
            const double coordinate = term.direction[static_cast<Eigen::Index>(r)];
            if (coordinate == 0.0) continue;
            const int place = inverse[node * rows_per_node + r];
            int k = next++;  // by insertion: rows ascend
            for (; k > first && index[k - 1] > place; --k) {
              index[k] = index[k - 1];
              value[k] = value[k - 1];
            }
            index[k] = place;
            value[k] = node == term.first ? size * coordinate : -size * coordinate;
          }
        }
      }
      start[column] = next;
      common.status = CHOLMOD_OK;
      const int done = cholmod_updown(adding ? 1 : 0, C, L, &common);
      cholmod_free_sparse(&C, &common);
      if (!done && common.status >= CHOLMOD_OK) {
        factored = false;
        return SolveStatus::not_factored;
      }
      counters.rank_one_updates += count;
      updates += count;
      if (const SolveStatus status = checked(); status != SolveStatus::ok) return status;
    }
    return SolveStatus::ok;
  }

  bool has_room(std::span<const RankOneTerm> terms) const {
    return std::all_of(terms.begin(), terms.end(), [this](const RankOneTerm& t) {
      return t.first < capacity() && (t.second < capacity() || t.second == NodePattern::none);
    });
  }

  // Flops of a rank-one update are those of the columns on the path of the elimination tree from its first row to the
  // root, four for each nonzero.
  double update_cost(std::span<const RankOneTerm> terms) const {
    if (!factored) return std::numeric_limits<double>::infinity();
    std::vector<double> to_root(L->n, 0.0);
    const auto add = [&to_root](std::size_t column, double count, int parent) {
      to_root[column] = 4.0 * count + (parent == none ? 0.0 : to_root[static_cast<std::size_t>(parent)]);
    };
    if (L->is_super) {
      const int* super = static_cast<const int*>(L->super);
      const int* pi = static_cast<const int*>(L->pi);
      const int* rows = static_cast<const int*>(L->s);
      for (std::size_t s = L->nsuper; s-- > 0;) {
        const int height = pi[s + 1] - pi[s], width = super[s + 1] - super[s];
        for (int c = width; c-- > 0;) {
          const int next = c + 1 < width ? super[s] + c + 1 : height > width ? rows[pi[s] + width] : none;
          add(static_cast<std::size_t>(super[s] + c), height - c, next);
        }
      }
    } else {
      const int* start = static_cast<const int*>(L->p);
      const int* rows = static_cast<const int*>(L->i);
      const int* count = static_cast<const int*>(L->nz);
      for (std::size_t j = L->n; j-- > 0;) add(j, count[j], count[j] > 1 ? rows[start[j] + 1] : none);
    }
    double sum = 0.0;
    for (const RankOneTerm& term : terms) {
      std::size_t first = L->n;
      for (const std::uint32_t node : {term.first, term.second}) {
        if (node == NodePattern::none || node >= capacity()) continue;
        for (std::size_t r = 0; r < rows_per_node; ++r)
          if (term.direction[static_cast<Eigen::Index>(r)] != 0.0)
            first = std::min(first, static_cast<std::size_t>(inverse[node * rows_per_node + r]));
      }
      if (first < L->n) sum += to_root[first];
    }
    return sum * options.rates.update_flop + (L->is_super ? nonzeros * options.rates.conversion : 0.0);
  }

  double factorisation_cost() const {
    if (!A) return 0.0;
    const bool supernodal =
        options.kind == FactorKind::supernodal || (options.kind == FactorKind::automatic && flops >= 40.0 * nonzeros);
    const double entries = static_cast<const int*>(A->p)[A->ncol] + static_cast<double>(A->ncol);
    return entries * options.rates.analysis +
           (supernodal ? flops * options.rates.supernodal_flop + nonzeros * options.rates.supernodal_nonzero
                       : flops * options.rates.simplicial_flop);
  }

  template <class Matrix>
  SolveStatus follow(const Matrix& after, std::span<const RankOneTerm> terms, std::size_t per_node) {
    const bool accurate = updates + terms.size() <= options.renew_after;
    if (factored && per_node == rows_per_node && accurate && has_room(terms) &&
        update_cost(terms) < factorisation_cost()) {
      ++counters.update_chosen;
      if (const SolveStatus status = update(terms); status == SolveStatus::ok) return status;
      ++counters.update_failed;
    } else {
      ++counters.refactor_chosen;
    }
    return factorise(after, per_node);
  }

  SolveStatus solve(std::span<const Vector3d> right, std::span<Vector3d> x) {
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
};

Cholesky::Cholesky(const CholeskyOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

SolveStatus Cholesky::factorise(const BlockMatrix& matrix) { return implementation_->factorise(matrix, 3); }
SolveStatus Cholesky::factorise(const ScalarMatrix& matrix) { return implementation_->factorise(matrix, 1); }
SolveStatus Cholesky::update(std::span<const RankOneTerm> terms) {
  return implementation_->has_room(terms) ? implementation_->update(terms) : SolveStatus::not_factored;
}
SolveStatus Cholesky::follow(const BlockMatrix& after, std::span<const RankOneTerm> terms) {
  return implementation_->follow(after, terms, 3);
}
SolveStatus Cholesky::follow(const ScalarMatrix& after, std::span<const RankOneTerm> terms) {
  return implementation_->follow(after, terms, 1);
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

std::size_t Cholesky::predicted_nonzeros(const NodePattern& pattern, std::size_t rows_per_node,
                                         const CholeskyOptions& options) {
  Implementation analysis(options);
  analysis.rows_per_node = rows_per_node;
  if (!analysis.analyse(ScalarMatrix{pattern, {}, {}})) throw SolverError("a matrix could not be analysed");
  return static_cast<std::size_t>(analysis.nonzeros);
}

namespace {

using Extended = Eigen::Matrix<long double, 3, 1>;

// b - A x in extended precision.
std::vector<Extended> residual(const BlockMatrix& m, std::span<const Vector3d> b, std::span<const Vector3d> x) {
  std::vector<Extended> r(b.size());
  for (std::size_t i = 0; i < b.size(); ++i)
    r[i] = b[i].cast<long double>() - m.diagonal[i].cast<long double>() * x[i].cast<long double>();
  for (std::size_t j = 0; j < b.size(); ++j)
    for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k) {
      const Eigen::Matrix<long double, 3, 3> block = m.below[k].cast<long double>();
      r[j] -= block * x[m.pattern.row[k]].cast<long double>();
      r[m.pattern.row[k]] -= block * x[j].cast<long double>();
    }
  return r;
}

}  // namespace

SolveStatus Cholesky::solve_refined(const BlockMatrix& matrix, std::span<const Vector3d> b, std::span<Vector3d> x) {
  const std::vector<Vector3d> right(b.begin(), b.end());
  if (const SolveStatus status = solve(right, x); status != SolveStatus::ok) return status;
  const std::vector<Extended> r = residual(matrix, right, x);
  std::vector<Vector3d> correction(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) correction[i] = r[i].cast<double>();
  if (const SolveStatus status = solve(correction, correction); status != SolveStatus::ok) return status;
  ++implementation_->counters.refinements;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
  return all_finite(x) ? SolveStatus::ok : SolveStatus::not_finite;
}

double backward_error(const BlockMatrix& m, std::span<const Vector3d> b, std::span<const Vector3d> x) {
  const std::vector<Extended> r = residual(m, b, x);
  std::vector<Vector3d> scale(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) scale[i] = b[i].cwiseAbs() + m.diagonal[i].cwiseAbs() * x[i].cwiseAbs();
  for (std::size_t j = 0; j < b.size(); ++j)
    for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k) {
      scale[j] += m.below[k].cwiseAbs() * x[m.pattern.row[k]].cwiseAbs();
      scale[m.pattern.row[k]] += m.below[k].cwiseAbs() * x[j].cwiseAbs();
    }
  double error = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto size = static_cast<double>(std::abs(r[i][c]));
      error = max_or_nan(error, size == 0.0 ? 0.0 : size / scale[i][c]);
    }
  return error;
}

}  // namespace dartboard
