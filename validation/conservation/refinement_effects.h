#pragma once
// Effects of one refinement on a body: the place of the new vertex, what the corners give away to it, and the forces
// before and after. The formulas: refinement_conservation.h.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/walks/cell_arrays.h"
#include "validation/conservation/conservation.h"
#include "validation/conservation/conserved_sums.h"

namespace dartboard {

/// Means over the corners of the cell that is refined.
struct RefinementMeans {
  Eigen::Vector3d x{0, 0, 0}, v{0, 0, 0};
  Eigen::Vector3d absolute_x{0, 0, 0}, absolute_v{0, 0, 0};
  double off = 0.0, off_v = 0.0;  // errors of the means by rounding, as lengths
  bool all_fixed = true;

  RefinementMeans(const VertexColumns& before, std::span<const std::uint32_t> corners);
};

/// The sums that the corners lose and the new vertex does not get; `mass` [kg] is that of the tetrahedra around the
/// cell. Magnitudes are those of the terms before they cancel.
ConservedSums given_away(const VertexColumns& before, std::span<const std::uint32_t> corners,
                         const RefinementMeans& means, double mass);

/// Forces of the springs by vertex, and a bound on the difference of two such sums by rounding.
struct SpringForceSums {
  std::vector<Eigen::Vector3d> force;
  std::vector<double> terms;  // the sum of the absolute values of its terms
  std::vector<double> moved;  // [N] if the new vertex is off by the rounding of the means
  std::vector<std::size_t> springs;
};
template <class Map>
SpringForceSums spring_force_sums(const LiveBody<Map>& body, const CellArrays& arrays,
                                  std::uint32_t put_in = no_embedding, const RefinementMeans* means = nullptr);

extern template SpringForceSums spring_force_sums(const LiveBody<Map3>&, const CellArrays&, std::uint32_t,
                                                  const RefinementMeans*);
extern template SpringForceSums spring_force_sums(const LiveBody<TetMap>&, const CellArrays&, std::uint32_t,
                                                  const RefinementMeans*);

}  // namespace dartboard
