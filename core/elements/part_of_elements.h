#pragma once
// Elements at some vertices of a body as a term of their own (ForceTerm::of_part).

#include "core/elements/membranes.h"
#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/forces/force_term.h"
#include "core/plain/cell_materials.h"

namespace dartboard {

// A source of their own: in the sources of the terms, the compiler would inline less of their forces.

/// The pieces of `term`, which has these materials and columns, at the vertices of the part.
TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const TetrahedronColumns& columns,
                            const VertexSubset& part);
TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const SolidColumns& columns,
                            const VertexSubset& part);
TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const TriangleColumns& columns,
                            const VertexSubset& part);
TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const MembraneColumns& columns,
                            const VertexSubset& part);

}  // namespace dartboard
