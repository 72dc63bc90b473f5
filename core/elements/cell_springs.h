#pragma once
// Springs within cells as a force term: between corners that no edge joins (section 3.1).

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/elements/solids.h"
#include "core/forces/force_term.h"
#include "core/plain/diagonals.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// The embedding of a cell's diagonals. Each cell has springs of its own, also across a face that it shares, so that no
/// dissociation changes any of them.
struct CellSprings {
  CellKind kind = CellKind::tetrahedron;
  Diagonals which = Diagonals::none;
  bool elastic =
      false;  // the modulus is E V [N m] and a spring has weight E V / l^2; else each has that stiffness [N/m]
  double modulus = 0.0;
  std::array<double, most_diagonals> rest_length{};  // [m] in the order of diagonals_of

  template <class Archive>
  void state(Archive& archive) {
    archive(kind, which, elastic, modulus, rest_length);
  }
};

/// The springs of a cell whose corners are at `x` at rest, in the order of its kind.
CellSprings cell_springs_of(CellKind kind, Diagonals which, bool elastic, double modulus,
                            std::span<const Eigen::Vector3d> x);

/// The columns of the cells of a body; the term reads them anew in each call.
struct CellSpringColumns {
  const std::vector<SolidNodes>& nodes;
  const std::vector<CellSprings>& springs;
};

/// The forces of springs within cells, a piece for each cell; one without diagonals has no vertices and no force.
std::unique_ptr<ForceTerm> make_cell_springs(const CellSpringColumns& columns);

/// The term's virial of one cell with its corners at x, with the same bits.
Virial cell_springs_virial(const CellSprings& springs, std::span<const Eigen::Vector3d> x);

}  // namespace dartboard
