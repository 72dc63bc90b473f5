#pragma once
// Frames as VTK XML unstructured grids, which ParaView and meshio read.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/meshes/bytes/compressed_block.h"
#include "core/scene/body/frame.h"

namespace dartboard {

/// The text of a .vtu file: arrays inline in base64 after a length of 64 bits, little-endian; or in compressed blocks
/// after their lengths.
///
/// Point data: velocity [m/s], mass [kg], mesh_point, the vertex's number in the file of the mesh (in a generated one),
/// -1 if refinement made it. Cell data: mesh_cell, the cell's number in the mesh that the body came from, and
/// component. Positions and values keep their bits. Where the frame has them, point data held (0 free, 1 fixed, 2
/// driven), largest_principal_stress, largest_stress_magnitude and von_mises_stress [Pa] and displacement [m]; cell
/// data tension [N] of the links of a chain, and strain, with every spring of another body as a line after the cells.
/// These lines have mesh_cell and component -1, and cells have the strain 0.
/// throws  InputError if the columns of the frame are not as long as its points and cells
std::string to_vtu(const Frame& frame, std::optional<Compressor> compressor = {});

/// Returns the number of bytes. The text is written in blocks, and never held as a whole.
/// throws  IoError if the file cannot be written; as to_vtu
std::uint64_t write_vtu(const std::filesystem::path& path, const Frame& frame,
                        std::optional<Compressor> compressor = {});

}  // namespace dartboard
