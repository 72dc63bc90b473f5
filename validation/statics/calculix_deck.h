#pragma once
// A static problem as input of CalculiX, and the output of CalculiX on it.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reference/elements/quadratic_solid.h"
#include "validation/statics/static_problem.h"

namespace dartboard {

/// The input deck: C3D4 or C3D8 (full integration), the same points, clamps and forces, displacements printed. For
/// large displacements NLGEOM, in which *ELASTIC is St. Venant-Kirchhoff's law, with iterations to a residual of 1e-9.
///
/// Numbers have 14 digits: CalculiX reads twenty characters of each.
/// throws  InputError for another kind of cell than tetrahedra or hexahedra, and for both together
std::string calculix_deck(const StaticProblem& problem);
/// A deck of C3D10, quadratic tetrahedra whose nodes are those of the reference: forces are the reference's, one
/// for each of its nodes.
std::string calculix_deck(const StaticProblem& problem, const reference::QuadraticSolid& solid,
                          const std::vector<std::uint32_t>& held, const Eigen::VectorXd& force);

/// The last displacements [m] in a printed .dat file, node after node.
///
/// throws  IoError "calculix: line 7: ..." if a line is not of the expected node, and if nodes are missing
std::vector<Eigen::Vector3d> calculix_displacements(std::string_view printed, std::size_t nodes);

}  // namespace dartboard
