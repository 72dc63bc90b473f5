#include "core/time/solve/cholesky_implementation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dartboard {
namespace {

constexpr int none = -1;

}  // namespace

SolveStatus Cholesky::Implementation::update(std::span<const RankOneTerm> terms) {
  if (!factored) return SolveStatus::not_factored;
  for (const RankOneTerm& term : terms)
    if (!term.direction.allFinite() || !std::isfinite(term.weight)) return SolveStatus::not_finite;
  pattern_kept = false;  // entries may be added
  // Terms that add go first: then no matrix in between is less definite than the last.
  for (const bool adding : {true, false}) {
    const auto count = static_cast<std::size_t>(std::count_if(
        terms.begin(), terms.end(), [adding](const RankOneTerm& t) { return (t.weight > 0.0) == adding; }));
    if (count == 0) continue;
    cholmod_sparse* C = cholmod_allocate_sparse(L->n, count, 2 * rows_per_node * count, 1, 1, 0, CHOLMOD_REAL, &common);
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

bool Cholesky::Implementation::has_room(std::span<const RankOneTerm> terms) const {
  return std::all_of(terms.begin(), terms.end(), [this](const RankOneTerm& t) {
    return t.first < capacity() && (t.second < capacity() || t.second == NodePattern::none);
  });
}

// Flops of a rank-one update are those of the columns on the path of the elimination tree from its first row to the
// root, four for each nonzero.
std::vector<double> Cholesky::Implementation::flops_to_root() const {
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
  return to_root;
}

double Cholesky::Implementation::update_cost(std::span<const RankOneTerm> terms) const {
  if (!factored) return std::numeric_limits<double>::infinity();
  const std::vector<double> to_root = flops_to_root();
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

double Cholesky::Implementation::factorisation_cost() const {
  if (!A) return 0.0;
  const bool supernodal =
      options.kind == FactorKind::supernodal || (options.kind == FactorKind::automatic && flops >= 40.0 * nonzeros);
  const double entries = static_cast<const int*>(A->p)[A->ncol] + static_cast<double>(A->ncol);
  return entries * options.rates.analysis +
         (supernodal ? flops * options.rates.supernodal_flop + nonzeros * options.rates.supernodal_nonzero
                     : flops * options.rates.simplicial_flop);
}

SolveStatus Cholesky::Implementation::follow(const NodeEntries& after, std::span<const RankOneTerm> terms) {
  if (factored && after.rows == rows_per_node && has_room(terms)) {
    const ChangedRows rows = changed_rows(after, terms);
    const double by_rows = rows.are_all ? rows_cost(after, rows.nodes) : std::numeric_limits<double>::infinity();
    const double by_terms = update_cost(terms);
    const std::size_t rank = by_rows < by_terms ? 2 * rows_per_node * rows.nodes.size() : terms.size();
    if (!rows.cancels && updates + rank <= options.renew_after && std::min(by_rows, by_terms) < factorisation_cost()) {
      ++counters.update_chosen;
      const SolveStatus status = by_rows < by_terms ? replace_rows(after, rows.nodes) : update(terms);
      if (status == SolveStatus::ok) return status;
      ++counters.update_failed;
      return factorise(after);
    }
  }
  ++counters.refactor_chosen;
  return factorise(after);
}

}  // namespace dartboard
