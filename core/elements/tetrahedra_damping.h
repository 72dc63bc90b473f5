#pragma once
// The damping of linear tetrahedra.

#include <memory>

#include "core/elements/tetrahedra.h"
#include "core/forces/term_damping.h"
#include "core/plain/cell_materials.h"

namespace dartboard {

/// The damping of the tetrahedra of `make_tetrahedra` (strain_damping.h); null if no material is damped. It has its own
/// source file, because in the same file the compiler would inline less of the elastic forces.
std::unique_ptr<TermDamping> make_tetrahedra_damping(const CellMaterials& materials, const TetrahedronColumns& columns);

}  // namespace dartboard
