#pragma once
// Comparisons of a body under operations, after each series, and now and then of everything.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "validation/conservation/conservation.h"
#include "validation/conservation/conservation_ledger.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/conservation/subjects.h"

namespace dartboard {

/// Numbers of cells by dimension; of a surface, the fourth is zero.
using CountsByDimension = std::array<std::size_t, 4>;

/// The body before a series of operations.
template <class Map>
struct BeforeSeries {
  ConservedSums sums;
  VertexColumns vertices;
  decltype(LiveBody<Map>::vertex) number;
  CountsByDimension counts;
};

/// The comparisons, each written into the ledger. The witness gives the expected value of a vertex, edge or cell.
template <class AnySubject>
class OperationChecks {
 public:
  using Map = typename AnySubject::Map;

  OperationChecks(const AnySubject& subject, ConservationLedger& ledger) : at_(subject), ledger_(ledger) { begin(); }
  virtual ~OperationChecks() = default;

  /// For a fresh body.
  /// cost  O(cells)
  void begin();
  ConservedSums all_sums() const;
  long euler() const;

  BeforeSeries<Map> before_series() const;
  /// `removed` are the sums of the removed parts, less the boundary that appeared. Returns the sums now.
  ConservedSums after_series(const BeforeSeries<Map>& before, const TopologyChange& change,
                             const ChangedEmbeddings& changed, const ConservedSums& removed);
  /// All columns and arrays have a row for each cell.
  void columns_fit();
  /// Compares the cells that an operation changed, by number, with the witness.
  void changed_cells(const ChangedEmbeddings& changed);
  /// `more`: additional roundings in a term; `elastic`: additional error of the energy [J].
  void sums(const ConservedSums& before, const ConservedSums& after, const ConservedSums& removed, std::size_t more = 0,
            double elastic = 0.0);
  /// Compares each vertex, edge and cell of the witness with the body's, and their numbers.
  void all_cells();
  /// cost    O(cells log cells)
  void everything();

  /// Whether the sums of this quantity are free of rounding.
  bool is_exact(Conserved c) const { return exact_[static_cast<std::size_t>(c)]; }

 protected:
  virtual void vertex(std::uint32_t k, typename AnySubject::VertexPlace place) = 0;
  virtual void edge(std::uint32_t k, typename AnySubject::EdgePlace place) = 0;
  virtual void cell(std::uint32_t) {}
  /// Further comparisons, made together with everything.
  virtual void all_else() {}
  /// In a term of the sums, in addition to those of conserved_sums.h.
  virtual std::size_t more_roundings() const { return 0; }
  /// The views must name the two vertices of an edge.
  void ends(std::uint32_t k, std::uint32_t a, std::uint32_t b);

  const AnySubject& at_;
  ConservationLedger& ledger_;
  std::size_t most_cells_ = 1;  // around a vertex, so far
  std::array<bool, conserved_count> exact_{};

 private:
  CountsByDimension counts_of_body() const;
  void columns_were_duplicated(const BeforeSeries<Map>& before);
  void all_counts();
  void all_views();
  void boundary();
};

/// For a body that is taken apart: bit by bit, and now and then against reference/rebuild.
template <class Map>
class ConservationChecks : public OperationChecks<Subject<Map>> {
 public:
  ConservationChecks(const Subject<Map>& subject, ConservationLedger& ledger);

 private:
  using Base = OperationChecks<Subject<Map>>;
  using Base::at_, Base::ledger_;

  void vertex(std::uint32_t k, std::span<const std::uint32_t> corners) override;
  void edge(std::uint32_t k, std::span<const std::uint32_t> edges) override;
  void all_else() override;
  double mass_from_cells(std::span<const std::uint32_t> corners);

  std::vector<std::uint32_t> numbers_;
};

extern template class OperationChecks<Subject<Map2>>;
extern template class OperationChecks<Subject<Map3>>;
extern template class OperationChecks<Subject<TetMap>>;
extern template class OperationChecks<RefinedSubject<Map3>>;
extern template class OperationChecks<RefinedSubject<TetMap>>;
extern template class ConservationChecks<Map2>;
extern template class ConservationChecks<Map3>;
extern template class ConservationChecks<TetMap>;

}  // namespace dartboard
