#pragma once
// A body to be cut, with a witness that knows its cells, their exact masses, and no dart.

#include <functional>
#include <span>
#include <vector>

#include "core/mechanics/adapt.h"
#include "reference/exact_measure.h"
#include "validation/conservation/subjects.h"

namespace dartboard {

/// The function that makes a body follow a change of its map: core's `adapt`, or a faulty stand-in.
using Adapt = std::function<void(LiveBody<Map3>&, const TopologyChange&)>;
inline const Adapt core_adapt = [](LiveBody<Map3>& body, const TopologyChange& change) { adapt(body, change); };

struct CutSubject : Subject<Map3> {
  std::vector<reference::Rational> share;  // by cell: the exact share of each of its nodes in its mass [kg]
  std::vector<double> rounding;            // by cell: bound on the error of core's share

  /// pre  a solid without a Young's modulus, which outlives this
  explicit CutSubject(const Problem& problem);

  /// The common mass of the corners of one vertex, and a bound on the error of core's sum of as many shares.
  struct Mass {
    double exact, bound;
  };
  Mass mass_of(std::span<const std::uint32_t> corners) const;

  std::uint32_t cell_of_side(std::uint32_t side) const { return cell(places.side[side]); }
  /// The corners of a side of a cell, and its edges.
  std::vector<std::uint32_t> corners_of(std::uint32_t side) const;
  std::vector<std::uint32_t> edges_of(std::uint32_t side) const;

  /// Sheared, stretched and in motion: nothing that is computed from the present shape has its value at rest.
  void deform();
};

}  // namespace dartboard
