#pragma once
// Cholesky factors of matrices on vertices, kept and updated: one small facade over CHOLMOD.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/base/archive.h"
#include "core/time/method/integrator.h"
#include "core/time/solve/step_matrix.h"
#include "core/time/system/node_matrix.h"

namespace dartboard {

/// The outcome of a factorisation or a solution. Nothing but `ok` may be used.
enum class SolveStatus : std::uint8_t {
  ok,
  not_positive_definite,
  not_finite,     // a NaN or an infinity in the matrix, the factor or the solution
  not_factored,   // there is no factor
  not_converged,  // of iterative methods: the iterations allowed are used up
  out_of_memory   // or the factor is too large for its index type
};
std::string_view to_string(SolveStatus status);

enum class Ordering : std::uint8_t { amd, metis };  // METIS halves the work from some 4,000 vertices on
enum class FactorKind : std::uint8_t { automatic, simplicial, supernodal };
enum class AnalysisGraph : std::uint8_t { nodes, unknowns };  // the graph that is ordered

/// Seconds that one unit of work takes, for the rule that chooses between an update and a factorisation. Constants
/// rather than clocks, so that equal runs make equal choices; the defaults were measured with OpenBLAS on one thread,
/// bodies of 500 to 4,000 vertices.
struct FactorRates {
  double supernodal_flop = 1.8e-11;
  double supernodal_nonzero = 1.2e-8;
  double simplicial_flop = 3.8e-10;
  double update_flop = 1.5e-10;
  double row_flop = 4e-10;     // of a row that is replaced
  double conversion = 8.5e-9;  // of a supernodal factor to a simplicial one, per nonzero
  double analysis = 2.5e-8;    // per unknown and per entry of the matrix, with a given ordering
};

struct CholeskyOptions {
  Ordering ordering = Ordering::amd;
  FactorKind kind = FactorKind::automatic;
  AnalysisGraph graph = AnalysisGraph::nodes;
  std::uint32_t spare_nodes = 0;  // rows kept for vertices added later, so that they can enter by updates
  double order_again = 1.2;       // when nnz(L) grows by this factor, a fresh ordering is found
  // Rank-one updates after which `follow` factors again, a replaced row counting as two: their rounding adds up. During
  // 3,000 edits of a body of 512 vertices the normwise backward error stays below 5e-16; never renewed it reaches 2e-15
  // by rows and 1e-14 by terms. One refinement brings it to 2e-17, but doubles the cost of every solution.
  std::uint32_t renew_after = 1500;
  // Where an update would subtract from a diagonal entry more than so many times what remains of it, `follow` factors
  // again: the update would lose as many digits.
  double cancellation = 1e3;
  bool ready_for_updates = false;  // convert supernodal factors at once: an update is then three to five times cheaper
  FactorRates rates = {};
};

/// Counts of the operations on a factor.
struct CholeskyCounters {
  std::uint64_t orderings = 0;       // AMD or METIS
  std::uint64_t analyses = 0;        // symbolic, with a fresh or a kept ordering
  std::uint64_t factorisations = 0;  // numeric
  std::uint64_t solves = 0;
  std::uint64_t refinements = 0;
  std::uint64_t rank_one_updates = 0;
  std::uint64_t rows_replaced = 0;
  std::uint64_t update_chosen = 0;    // `follow` updated
  std::uint64_t refactor_chosen = 0;  // `follow` factored again because that was cheaper, or there was no room
  std::uint64_t update_failed = 0;    // `follow` updated, lost definiteness, and factored again

  template <class Archive>
  void state(Archive& archive) {
    archive(orderings, analyses, factorisations, solves, refinements, rank_one_updates, rows_replaced, update_chosen,
            refactor_chosen, update_failed);
  }
};

/// P A P' = L L' or L D L'.
///
/// Ordering works on the graph of the vertices, a third of the unknowns; the three rows of a vertex stay together.
/// A matrix that is not positive definite never passes: CHOLMOD's status, the column it stopped at, the signs of D and
/// the finiteness of every solution are all checked.
/// source  Chen, Davis, Hager, Rajamanickam, ACM TOMS 35 (2008), algorithm 887; Davis, Hager, SIAM J. Matrix Anal.
///         Appl. 22 (2001), multiple-rank updates
class Cholesky {
 public:
  explicit Cholesky(const CholeskyOptions& options = {});
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Factor a matrix; it is analysed if its pattern is not that of the last call. A pattern that has grown or changed
  /// keeps the ordering: an added vertex is placed next to the vertex that it shares most neighbours with.
  ///
  /// throws  Stopped (stop_request.h) where a stop was asked for during long work; there is no factor then
  SolveStatus factorise(const BlockMatrix& matrix);
  SolveStatus factorise(const ScalarMatrix& matrix);

  /// Change the factor as the matrix changes by `terms`. Directions for a scalar matrix have the first coordinate only.
  ///
  /// A supernodal factor becomes a simplicial one first and stays it until the next factorisation. After failure there
  /// is no factor.
  SolveStatus update(std::span<const RankOneTerm> terms);

  /// Make the factor that of `after`, to which `terms` lead, by the way predicted to be cheapest: an update by the
  /// terms; replacing rows, where the terms leave the diagonal blocks of all other vertices as they are; an analysis
  /// with the kept ordering and a factorisation. The last is also taken where an update would cancel digits
  /// (`cancellation`) or `renew_after` is exceeded.
  ///
  /// A vertex that is dissociated hands springs to its twin at the same place: only their rows change, however many
  /// springs there are and however they are stretched. The twin's row is a spare one.
  /// throws  as factorise
  SolveStatus follow(const BlockMatrix& after, std::span<const RankOneTerm> terms);
  SolveStatus follow(const ScalarMatrix& after, std::span<const RankOneTerm> terms);

  /// x = A^-1 b. May be called with x and b the same.
  SolveStatus solve(std::span<const Eigen::Vector3d> b, std::span<Eigen::Vector3d> x);
  /// x = A^-1 b with one step of iterative refinement, whose residual is in extended precision.
  ///
  /// Brings the componentwise backward error (backward_error.h) from up to 3e-11, where scales differ widely, to 4e-16.
  /// cost    two solutions, and a product with the matrix in extended precision
  SolveStatus solve_refined(const BlockMatrix& matrix, std::span<const Eigen::Vector3d> b,
                            std::span<Eigen::Vector3d> x);

  /// Writes or reads the factor with all that later updates depend on: the order of its rows, the room in its
  /// columns, its symbolic analysis. A factor that was updated differs in its last bits from a fresh one.
  void state(Archive& archive);
  /// A number that changes whenever the factor is changed or given up; 0 as long as there never was a factor.
  std::uint64_t generation() const { return generation_; }

  bool has_factor() const;
  bool is_supernodal() const;
  /// Predicted seconds of `update(terms)`, and of an analysis and a factorisation.
  double update_cost(std::span<const RankOneTerm> terms) const;
  double factorisation_cost() const;
  /// Vertices that have a row, in use or spare.
  std::size_t capacity() const;
  /// The diagonal of the rows that are not in use.
  double spare_diagonal() const;
  double factor_nonzeros() const;
  double factor_flops() const;
  /// After not_positive_definite: the vertex of the first bad pivot.
  std::uint32_t failed_node() const;
  const CholeskyCounters& counters() const;
  /// Bytes of the numbers of L and of the columns kept with it; not the indices, copies and workspace of the library.
  std::size_t bytes() const;
  /// The factor that a pattern will have, ordered and analysed, nothing factored. With one row for each vertex, or
  /// three.
  /// throws  SolverError where the library has not the memory for it
  static FactorForecast forecast(const NodePattern& pattern, std::size_t rows_per_node, const CholeskyOptions& options);

 private:
  struct Implementation;
  template <class Action>
  SolveStatus unless_stopped(Action&& action);
  std::shared_ptr<Implementation> implementation_;  // shared with work that was given up
  std::uint64_t generation_ = 0;
};

}  // namespace dartboard
