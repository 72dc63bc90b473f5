#pragma once
// Section 4.3 on the body as it is built: eq. (1), and stiffnesses as sums over cells.

#include "core/mechanics/mass_spring_body.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Every cell has its exact mass and every vertex the exact sum of its shares, eq. (1), up to the rounding of each; so
/// the sums of both are equal, too.
/// pre  one vertex for each mesh point, no Young's modulus
ClaimAnswer masses_are_of_cells(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem);

/// Every edge has k for each cell around it, to the last bit, counted in the mesh by pairs of points; so all together
/// have k for each edge of each cell.
ClaimAnswer stiffnesses_are_of_cells(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem);

}  // namespace dartboard
