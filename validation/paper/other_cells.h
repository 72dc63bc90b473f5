#pragma once
// Section 4.1: the model "can easily be extended to other volume elements".

#include "validation/paper/cut_subject.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// A body of hexahedra, prisms, pyramids and tetrahedra: cut, eroded and moved as a body of tetrahedra, with the same
/// judges. `mesh` has to hold all four kinds.
ClaimAnswer try_other_cells(const Mesh& mesh, int operations, std::uint64_t seed, const Adapt& follow = core_adapt);

}  // namespace dartboard
