#pragma once
// The parts of a running scene, and the memory that each takes, as its objects report it.

#include <cstddef>
#include <string_view>
#include <vector>

namespace dartboard {

struct VertexColumns;

/// Bytes are those of the elements of every container that lives as long as the run: its size times that of an element
/// (core/base/bytes.h), and the numbers of a factor. Objects of fixed size are not counted, nor what containers and
/// libraries set aside beyond that. It is the memory at the start, before the first operation, after a step that had
/// something to solve.
enum class Part {
  map,           // alphas and generations
  marks,         // bits by dart
  embeddings,    // the number of the embedding at every dart
  cell_darts,    // the lowest dart of each vertex, edge, face and cell
  cells,         // masses of cells, and the data of cells that changes need
  components,    // the connected component of each cell
  vertices,      // mass, 1/mass, position, velocity, point of the mesh
  viscosity,     // by vertex
  fixed,         // by vertex
  rest,          // rest position by vertex
  pull,          // external forces by vertex, and the points that they act on
  driven,        // paths of driven vertices, and the lists that their work is summed over
  springs,       // rest length, stiffness, and the two ends
  damping,       // by spring, in the same row
  elements,      // rest shape and corners of each cell, in place of springs
  cell_damping,  // of elements, by the rate of their strain: time only
  cell_springs,  // rest lengths of the diagonals of each cell, and its corners
  force,         // rows of one of the kinds of core/scene/forces
  contact,       // samples of the boundary, and the obstacles
  gravity,       // a force term: time only
  integrator,    // columns kept between steps
  solver,        // matrices, factor and vectors of implicit methods
  detector,      // the last good state
  speed_check,   // time only
  event,         // what one event looked up at the start
  step_check,    // estimates of the stable step after operations: time only
  output_cells,  // cells and boundary by vertex numbers, for frames and diagnostics of a body without a map
  frames,        // time only
  probes,        // the vertices followed
  diagnostics,   // time only
  sleeping,      // the component of each vertex
};
std::string_view name(Part part);
/// For a kind of force its own name.
std::string_view name_of(Part part, std::size_t which);

struct MemoryItem {
  Part part;
  std::size_t bytes;
  std::size_t which = 0;  // event, or kind of force
};
using MemoryReport = std::vector<MemoryItem>;

/// The bytes of Part::vertices: of the columns that are not parts of their own.
std::size_t bytes_of_vertices(const VertexColumns& vertices);

}  // namespace dartboard
