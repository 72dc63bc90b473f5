#pragma once
// What a body under operations is compared with, and when: after each series, and now and then.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "validation/conservation/conservation.h"
#include "validation/conservation/conservation_ledger.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/conservation/mesh_places.h"

namespace dartboard {

/// A body that is being taken apart, and the witness of what should be left of it.
template <class Map>
struct Subject {
  explicit Subject(const Problem& problem);

  const Problem& start;
  RemainingCells whole, cells;  // at first, and now
  LiveBody<Map> fresh, body;
  Views views;
  MeshPlaces places;
};

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

/// The comparisons, each written into the ledger.
template <class Map>
class ConservationChecks {
 public:
  ConservationChecks(const Subject<Map>& subject, ConservationLedger& ledger);

  BeforeSeries<Map> before_series() const;
  /// `removed` are the sums of what was removed, less the boundary that appeared. Returns the sums now.
  ConservedSums after_series(const BeforeSeries<Map>& before, const TopologyChange& change,
                             const ChangedEmbeddings& changed, const ConservedSums& removed);
  /// cost    O(cells log cells)
  void everything();

  /// Whether rounding leaves the sums of this quantity alone.
  bool is_exact(Conserved c) const { return exact_[static_cast<std::size_t>(c)]; }

 private:
  ConservedSums all_sums() const;
  CountsByDimension counts_of_body() const;
  void columns_fit(const CountsByDimension& predicted);
  void columns_were_duplicated(const BeforeSeries<Map>& before);
  void changed_cells(const ChangedEmbeddings& changed);
  ConservedSums sums_are_conserved(const ConservedSums& before, const ConservedSums& removed);
  double mass_from_cells(std::span<const std::uint32_t> corners);
  void vertex(std::uint32_t k, std::span<const std::uint32_t> corners);
  void edge(std::uint32_t k, std::span<const std::uint32_t> edges);
  void all_vertices();
  void all_edges();
  void all_counts();
  void all_views();
  void boundary();
  void soup();

  const Subject<Map>& at_;
  ConservationLedger& ledger_;
  std::size_t most_cells_ = 1;  // around a vertex
  std::array<bool, conserved_count> exact_{};
  std::vector<std::uint32_t> numbers_;
};

extern template struct Subject<Map2>;
extern template struct Subject<Map3>;
extern template struct Subject<TetMap>;
extern template class ConservationChecks<Map2>;
extern template class ConservationChecks<Map3>;
extern template class ConservationChecks<TetMap>;

}  // namespace dartboard
