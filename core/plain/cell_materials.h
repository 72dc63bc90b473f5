#pragma once
// The materials of a body's cells.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plain/material.h"

namespace dartboard {

/// The number of a material in a body of several.
using MaterialNumber = std::uint8_t;
inline constexpr std::size_t most_materials = 256;

/// A view of the materials of cells: one for all, or one for each cell. It reads the columns anew in each call, so that
/// their sizes may change.
class CellMaterials {
 public:
  /// pre  what they refer to outlives them
  CellMaterials(const Material& one) : one_(&one) {}
  /// One for all where `several` is empty.
  CellMaterials(const Material& one, const std::vector<Material>& several, const std::vector<MaterialNumber>& of_cell)
      : one_(&one), several_(several.empty() ? nullptr : &several), of_cell_(&of_cell) {}

  /// These materials for other cells.
  CellMaterials of_cells(const std::vector<MaterialNumber>& of_cell) const {
    CellMaterials other = *this;
    other.of_cell_ = &of_cell;
    return other;
  }
  /// The column of their numbers; null where there is one material for all.
  const std::vector<MaterialNumber>* numbers() const { return is_one() ? nullptr : of_cell_; }

  bool is_one() const { return several_ == nullptr; }
  const Material& operator[](std::size_t cell) const { return is_one() ? *one_ : (*several_)[(*of_cell_)[cell]]; }
  std::span<const Material> all() const { return is_one() ? std::span(one_, 1) : std::span<const Material>(*several_); }
  MaterialNumber number(std::size_t cell) const { return is_one() ? MaterialNumber{0} : (*of_cell_)[cell]; }

  bool any(Model model) const {
    for (const Material& material : all())
      if (material.model == model) return true;
    return false;
  }
  bool has_springs() const { return any(Model::springs); }
  bool has_elements() const {
    for (const Material& material : all())
      if (material.model != Model::springs) return true;
    return false;
  }

 private:
  const Material* one_;
  const std::vector<Material>* several_ = nullptr;
  const std::vector<MaterialNumber>* of_cell_ = nullptr;
};

}  // namespace dartboard
