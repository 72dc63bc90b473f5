#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/time/solve/cholesky_implementation.h"

// Changes of a few rows and columns: a vertex that is dissociated changes its own rows and those of its new twin.

namespace dartboard {
namespace {

using Eigen::Matrix3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// The change of the diagonal block of a node by the terms.
struct NodeChange {
  Matrix3d sum = Matrix3d::Zero();
  double taken = 0.0;  // the largest diagonal entry of what is subtracted
};

std::map<std::uint32_t, NodeChange> changes_by_node(std::span<const RankOneTerm> terms) {
  std::map<std::uint32_t, NodeChange> changes;
  std::map<std::uint32_t, Eigen::Vector3d> taken;
  for (const RankOneTerm& term : terms)
    for (const std::uint32_t node : {term.first, term.second}) {
      if (node == NodePattern::none) continue;
      changes[node].sum += (term.weight * term.direction) * term.direction.transpose();
      if (term.weight > 0.0) continue;
      const auto [at, added] = taken.try_emplace(node, Eigen::Vector3d::Zero());
      at->second -= term.weight * term.direction.cwiseAbs2();
      changes[node].taken = at->second.maxCoeff();
    }
  return changes;
}

}  // namespace

Cholesky::Implementation::ChangedRows Cholesky::Implementation::changed_rows(const NodeEntries& after,
                                                                             std::span<const RankOneTerm> terms) const {
  ChangedRows rows;
  const auto changes = changes_by_node(terms);
  for (const auto& [node, change] : changes) {
    double largest = spare, least = spare;
    if (node < after.nodes) {
      largest = 0.0;
      least = std::numeric_limits<double>::infinity();
      for (std::size_t r = 0; r < rows_per_node; ++r) {
        largest = std::max(largest, after.diagonal_at(node, r, r));
        least = std::min(least, after.diagonal_at(node, r, r));
      }
    }
    if (!(change.taken <= options.cancellation * least)) rows.cancels = true;
    // springs that move from one vertex to another leave the blocks of their other ends unchanged, except for rounding
    if (!(change.sum.cwiseAbs().maxCoeff() <= 4.0 * epsilon * largest)) rows.nodes.push_back(node);
  }
  const auto among = [&rows](std::uint32_t node) { return std::ranges::binary_search(rows.nodes, node); };
  rows.are_all = std::ranges::all_of(terms, [&](const RankOneTerm& t) { return among(t.first) || among(t.second); });
  return rows;
}

double Cholesky::Implementation::rows_cost(const NodeEntries& after, std::span<const std::uint32_t> nodes) const {
  const std::vector<double> to_root = flops_to_root();
  std::vector<std::size_t> first(capacity(), L->n);  // by node: the first position in L that it couples to
  const auto position = [this](std::size_t node) { return static_cast<std::size_t>(inverse[node * rows_per_node]); };
  for (std::size_t j = 0; j < after.nodes; ++j)
    for (std::uint32_t k = after.pattern.column_start[j]; k < after.pattern.column_start[j + 1]; ++k) {
      const std::uint32_t i = after.pattern.row[k];
      first[j] = std::min(first[j], position(i));
      first[i] = std::min(first[i], position(j));
    }
  double flops_needed = 0.0;
  for (const std::uint32_t node : nodes) {
    const double own = to_root[position(node)];
    const double solve = first[node] < position(node) ? 0.5 * (to_root[first[node]] - own) : 0.0;
    flops_needed += 2.0 * own + std::max(solve, 0.0);
  }
  return static_cast<double>(rows_per_node) * flops_needed * options.rates.row_flop +
         (L->is_super ? nonzeros * options.rates.conversion : 0.0);
}

// Rows become those of the identity one by one, and then, one by one, those of `after`. Every matrix in between is a
// part of the old or of the new one, so it is positive definite if both are.
SolveStatus Cholesky::Implementation::replace_rows(const NodeEntries& after, std::span<const std::uint32_t> nodes) {
  if (!factored) return SolveStatus::not_factored;
  pattern_kept = false;
  const std::size_t d = rows_per_node;
  if (L->is_super && !cholmod_change_factor(CHOLMOD_REAL, 0, 0, 0, 1, L, &common)) return memory_failure();
  common.status = CHOLMOD_OK;
  const auto failed_call = [this] {
    factored = false;
    return common.status < CHOLMOD_OK ? memory_failure() : SolveStatus::not_factored;
  };
  for (const std::uint32_t node : nodes)
    for (std::size_t r = 0; r < d; ++r)
      if (!cholmod_rowdel(static_cast<std::size_t>(inverse[node * d + r]), nullptr, L, &common)) return failed_call();

  // the rows of the new matrix, by node among `nodes`
  struct Coupling {
    std::uint32_t other, entry;
  };
  constexpr std::uint32_t absent = NodePattern::none;
  std::vector<std::uint32_t> which(capacity(), absent);
  for (std::uint32_t k = 0; k < nodes.size(); ++k) which[nodes[k]] = k;
  std::vector<std::vector<Coupling>> couplings(nodes.size());
  for (std::uint32_t j = 0; j < after.nodes; ++j)
    for (std::uint32_t k = after.pattern.column_start[j]; k < after.pattern.column_start[j + 1]; ++k) {
      const std::uint32_t i = after.pattern.row[k];
      if (which[j] != absent) couplings[which[j]].push_back({i, k});
      if (which[i] != absent) couplings[which[i]].push_back({j, k});
    }
  std::vector<std::pair<int, double>> entries;
  for (std::uint32_t which_node = 0; which_node < nodes.size(); ++which_node) {
    const std::uint32_t node = nodes[which_node];
    for (std::size_t r = 0; r < d; ++r) {
      const int place = inverse[node * d + r];
      entries.assign(1, {place, node < after.nodes ? after.diagonal_at(node, r, r) : spare});
      if (node < after.nodes)
        for (std::size_t c = 0; c < r; ++c) entries.emplace_back(inverse[node * d + c], after.diagonal_at(node, r, c));
      for (const auto [other, entry] : couplings[which_node])
        if (which[other] == absent || which[other] < which_node)  // otherwise the other row is still the identity
          for (std::size_t c = 0; c < d; ++c) entries.emplace_back(inverse[other * d + c], after.below_at(entry, r, c));
      std::erase_if(entries, [place](const auto& e) { return e.second == 0.0 && e.first != place; });
      std::sort(entries.begin(), entries.end());
      cholmod_sparse* R = cholmod_allocate_sparse(L->n, 1, entries.size(), 1, 1, 0, CHOLMOD_REAL, &common);
      if (!R) return memory_failure();
      static_cast<int*>(R->p)[1] = static_cast<int>(entries.size());
      for (std::size_t k = 0; k < entries.size(); ++k) {
        static_cast<int*>(R->i)[k] = entries[k].first;
        static_cast<double*>(R->x)[k] = entries[k].second;
      }
      const int done = cholmod_rowadd(static_cast<std::size_t>(place), R, L, &common);
      cholmod_free_sparse(&R, &common);
      if (!done) return failed_call();
    }
  }
  counters.rows_replaced += d * nodes.size();
  updates += 2 * d * nodes.size();  // each row went and came by an update of rank one
  return checked();
}

}  // namespace dartboard
