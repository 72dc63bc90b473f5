#pragma once
// What one refinement does to a body: where the vertex put in must be, what the corners give away to it, and the forces
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
  double off = 0.0, off_v = 0.0;  // what rounding does to a mean, as a length
  bool all_fixed = true;

  RefinementMeans(const VertexColumns& before, std::span<const std::uint32_t> corners);
};

/// What the corners lose and the vertex put in does not get; `mass` [kg] is that of the tetrahedra around the cell.
/// Magnitudes are those of the terms before they cancel.
ConservedSums given_away(const VertexColumns& before, std::span<const std::uint32_t> corners,
                         const RefinementMeans& means, double mass);

/// Forces of the springs by vertex, and how far rounding may put two such sums apart.
struct SpringForceSums {
  std::vector<Eigen::Vector3d> force;
  std::vector<double> terms;  // the absolute values that went into it
  std::vector<double> moved;  // [N] if the vertex put in is off by the rounding of the means
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
