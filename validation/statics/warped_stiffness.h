#pragma once
// The stiffness that the paper's corotational elements were solved with: at rest, turned with each element.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/time/system/spring_system.h"

namespace dartboard {

/// R K R' of each tetrahedron, K its stiffness at rest and R its rotation: symmetric and positive semidefinite in any
/// position, and the exact tangent of corotational elements except for the change of R itself. Kept in addition to the
/// exact one for comparison; core knows nothing of it.
///
/// source  Mueller, Gross, Interactive virtual materials, Graphics Interface 2004
class WarpedStiffness {
 public:
  /// pre     the force terms of the system are tetrahedra; it has no springs
  /// throws  InputError for a piece of other than four vertices
  WarpedStiffness(const SpringSystem& system, std::span<const Eigen::Vector3d> rest);

  /// [N/m] over all unknowns, with the tetrahedra at x.
  Eigen::SparseMatrix<double> operator()(std::span<const Eigen::Vector3d> x) const;

 private:
  struct Element {
    std::array<std::uint32_t, 4> node;
    Eigen::Matrix3d inverse;                 // of the edges from the first corner, at rest
    std::array<Eigen::Matrix3d, 10> blocks;  // K_ab at rest, b <= a
  };
  std::vector<Element> elements_;
  std::size_t vertices_;
};

}  // namespace dartboard
