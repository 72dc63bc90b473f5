#include "core/time/solve/cholesky_implementation.h"

#include <numeric>

// The ordering of the nodes, and the symbolic factor that it gives.

namespace dartboard {
namespace {

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

}  // namespace

std::vector<int> extended_order(const std::vector<int>& order, std::size_t old_count, const NodePattern& pattern,
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

// The order of the nodes from CHOLMOD's AMD or METIS, on a graph of `per_node` rows for each node.
bool Cholesky::Implementation::find_order(const NodePattern& p, std::size_t per_node) {
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
    // An ordering of the unknowns does not keep those of a node together: a node takes the place of its first unknown.
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
bool Cholesky::Implementation::analyse_with_order() {
  std::vector<int> permutation;
  permutation.reserve(order.size() * rows_per_node);
  for (const int node : order)
    for (std::size_t r = 0; r < rows_per_node; ++r)
      permutation.push_back(node * static_cast<int>(rows_per_node) + static_cast<int>(r));
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 1;
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
bool Cholesky::Implementation::shape(const NodePattern& p) {
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

// A rough prediction: it only decides whether a thread is started. The ordering takes most of the time.
double Cholesky::Implementation::predicted_analysis_seconds(const NodePattern& p) const {
  return 1e-6 * static_cast<double>(p.row.size() + p.node_count());
}

bool Cholesky::Implementation::analyse(const NodePattern& p) {
  free_factor();
  const bool keep_order = !order.empty() && p.node_count() >= order_nodes && order_nodes > 0;
  if (keep_order) {
    const std::size_t room =
        p.node_count() <= capacity() ? capacity() : p.node_count() + std::size_t{options.spare_nodes};
    order = extended_order(order, order_nodes, p, room);
    order_nodes = p.node_count();
  } else if (!find_order(p, options.graph == AnalysisGraph::nodes ? 1 : rows_per_node)) {
    return false;
  }
  if (!shape(p) || !analyse_with_order()) return false;
  if (keep_order && nonzeros > options.order_again * order_nonzeros) {
    free_factor();
    if (!find_order(p, options.graph == AnalysisGraph::nodes ? 1 : rows_per_node) || !shape(p) || !analyse_with_order())
      return false;
    order_nonzeros = nonzeros;
  }
  if (!keep_order) order_nonzeros = nonzeros;
  column_start = p.column_start;
  row = p.row;
  pattern_kept = true;
  return true;
}

}  // namespace dartboard
