#pragma once
// The materials of some of the cells of a body.

#include <cstdint>
#include <vector>

#include "core/forces/rows_of_part.h"
#include "core/plain/cell_materials.h"

namespace dartboard {

/// The numbers of their materials; none where there is one material for all.
inline std::vector<MaterialNumber> materials_of_part(const CellMaterials& materials,
                                                     const std::vector<std::uint32_t>& cells) {
  return materials.numbers() == nullptr ? std::vector<MaterialNumber>{} : rows_of_part(*materials.numbers(), cells);
}

}  // namespace dartboard
