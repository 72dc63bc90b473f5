#pragma once
// The implementation of cholesky.h: CHOLMOD's objects and how they are kept in step. For its sources and tests
// only.

#include <cholmod.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "core/time/solve/cholesky.h"

namespace dartboard {

/// A matrix on nodes as plain arrays: `rows` x `rows` numbers for each entry, by column.
struct NodeEntries {
  const NodePattern& pattern;
  const double *diagonal, *below;
  std::size_t nodes, rows;

  explicit NodeEntries(const BlockMatrix& m)
      : pattern(m.pattern),
        diagonal(m.diagonal.empty() ? nullptr : m.diagonal[0].data()),
        below(m.below.empty() ? nullptr : m.below[0].data()),
        nodes(m.node_count()),
        rows(3) {}
  explicit NodeEntries(const ScalarMatrix& m)
      : pattern(m.pattern), diagonal(m.diagonal.data()), below(m.below.data()), nodes(m.node_count()), rows(1) {}

  double diagonal_at(std::size_t node, std::size_t r, std::size_t c) const {
    return diagonal[(node * rows + c) * rows + r];
  }
  double below_at(std::size_t entry, std::size_t r, std::size_t c) const {
    return below[(entry * rows + c) * rows + r];
  }
};

/// `order` of the first `old_count` nodes, with added nodes next to their twins, and spare ones last.
std::vector<int> extended_order(const std::vector<int>& order, std::size_t old_count, const NodePattern& pattern,
                                std::size_t capacity);

struct Cholesky::Implementation : std::enable_shared_from_this<Implementation> {
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

  explicit Implementation(const CholeskyOptions& o);
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation();
  void free_factor();
  std::size_t capacity() const { return order.size(); }

  // cholesky_state.cpp
  void state(Archive& archive);

  // cholesky_analysis.cpp
  bool find_order(const NodePattern& pattern, std::size_t per_node);
  bool analyse_with_order();
  bool shape(const NodePattern& pattern);
  bool analyse(const NodePattern& pattern);
  double predicted_analysis_seconds(const NodePattern& pattern) const;

  // cholesky_factor.cpp
  void copy_values(const NodeEntries& m);
  SolveStatus failure(std::size_t position);
  SolveStatus memory_failure();
  SolveStatus checked();
  int unless_stopped(double seconds, std::function<int(Implementation&)> work);
  SolveStatus factorise(const NodeEntries& m);
  SolveStatus solve(std::span<const Eigen::Vector3d> right, std::span<Eigen::Vector3d> x);

  // cholesky_update.cpp
  bool has_room(std::span<const RankOneTerm> terms) const;
  SolveStatus update(std::span<const RankOneTerm> terms);
  std::vector<double> flops_to_root() const;  // by column
  double update_cost(std::span<const RankOneTerm> terms) const;
  double factorisation_cost() const;
  SolveStatus follow(const NodeEntries& after, std::span<const RankOneTerm> terms);

  // cholesky_rows.cpp
  struct ChangedRows {
    std::vector<std::uint32_t> nodes;  // whose diagonal block changes, ascending
    bool are_all = false;              // every term has an end among them: nothing else changes
    bool cancels = false;              // what remains of some entry is small against what was subtracted
  };
  ChangedRows changed_rows(const NodeEntries& after, std::span<const RankOneTerm> terms) const;
  double rows_cost(const NodeEntries& after, std::span<const std::uint32_t> nodes) const;
  SolveStatus replace_rows(const NodeEntries& after, std::span<const std::uint32_t> nodes);
};

}  // namespace dartboard
