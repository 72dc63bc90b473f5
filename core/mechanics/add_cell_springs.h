#pragma once
// Springs on the diagonals of a body's cells.

#include "core/mechanics/mass_spring_body.h"
#include "core/plain/diagonals.h"

namespace dartboard {

/// Give every cell of springs its diagonals (`cell_springs`), each with the stiffness of the cell's material, undamped.
/// Where the material has a Young's modulus, edges and diagonals share it by their weights (core/plain/diagonals.h). A
/// body whose cells have no such diagonals keeps no column for them.
///
/// pre     the body was just built from this mesh, and has not moved
/// throws  InputError for a diagonal whose stiffness is not finite
template <class Map>
void add_cell_springs(MassSpringBody<Map, Held::by_every_dart>& body, const Mesh& mesh, Diagonals which);

extern template void add_cell_springs(MassSpringBody<Map2, Held::by_every_dart>&, const Mesh&, Diagonals);
extern template void add_cell_springs(MassSpringBody<Map3, Held::by_every_dart>&, const Mesh&, Diagonals);
extern template void add_cell_springs(MassSpringBody<TetMap, Held::by_every_dart>&, const Mesh&, Diagonals);

}  // namespace dartboard
