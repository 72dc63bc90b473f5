#pragma once
// The part after the grid in a legacy VTK file: data of points and of cells.

#include <string_view>

#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/vtk/vtk_cells.h"

namespace dartboard {

/// Skip the arrays of a FIELD, whose keyword was read.
void skip_vtk_field(TextScanner& scan, FileNumbers& numbers);
/// Skip METADATA, whose keyword was read: lines up to an empty one.
void skip_vtk_metadata(TextScanner& scan);

/// Keep the data of cells that are one whole number each, and skip all others, to the end of the text. An unknown
/// keyword ends the reading, with a notice.
void read_vtk_legacy_data(TextScanner& scan, FileNumbers& numbers, const VtkCellPlaces& places, MeshBuilder& builder);

}  // namespace dartboard
