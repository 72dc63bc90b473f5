#pragma once
// What damps linear tetrahedra.

#include <memory>

#include "core/elements/tetrahedra.h"
#include "core/forces/term_damping.h"
#include "core/plain/cell_materials.h"

namespace dartboard {

/// The damping of the same tetrahedra as `make_tetrahedra` (strain_damping.h); null where no material is damped. A
/// source of its own: beside it the compiler inlines less of the elastic forces.
std::unique_ptr<TermDamping> make_tetrahedra_damping(const CellMaterials& materials, const TetrahedronColumns& columns);

}  // namespace dartboard
