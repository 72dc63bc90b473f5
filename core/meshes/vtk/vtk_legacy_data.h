#pragma once
// What comes after the grid in a legacy VTK file: data of points and of cells.

#include <string_view>

#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/vtk/vtk_cells.h"

namespace dartboard {

/// Pass over the arrays of a FIELD, whose keyword was read.
void skip_vtk_field(TextScanner& scan, FileNumbers& numbers);
/// Pass over METADATA, whose keyword was read: lines up to an empty one.
void skip_vtk_metadata(TextScanner& scan);

/// Keep the data of cells that are one whole number each, and pass over all others, to the end of the text. What the
/// reader does not know ends it, with a notice.
void read_vtk_legacy_data(TextScanner& scan, FileNumbers& numbers, const VtkCellPlaces& places, MeshBuilder& builder);

}  // namespace dartboard
