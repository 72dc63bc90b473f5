#pragma once
// Cells of one material that follow each other, which loops take together.

#include <cstddef>

#include "core/plain/cell_materials.h"

namespace dartboard {

/// The first cell after `first` that is of another material, or `last`.
inline std::size_t end_of_material(const CellMaterials& materials, std::size_t first, std::size_t last) {
  if (materials.is_one()) return last;
  std::size_t end = first + 1;
  while (end < last && materials.number(end) == materials.number(first)) ++end;
  return end;
}

}  // namespace dartboard
