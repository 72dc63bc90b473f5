#pragma once
// Bodies of elements and springs, cut, torn and eroded at random: energies, forces and masses compared with other code.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/mechanics/element_shapes.h"
#include "core/plain/cell_materials.h"
#include "core/plain/mesh.h"
#include "validation/elements/region_mix.h"

namespace dartboard {

/// Columns of a body that a test may alter.
struct OperatedColumns {
  std::vector<Eigen::Vector3d>& position;
  ElementShapes& shape;
  std::vector<MaterialNumber>& cell_material;
  std::vector<AttachedVertex>& attached;
};

struct ElementOperationsPlan {
  std::size_t operations = 100'000;
  std::size_t check_every = 1000;  // operations from one comparison with a body built anew to the next
  std::uint64_t seed = 1;
  // for tests: alters the body unknown to the map after an operation, before the comparisons
  std::function<void(std::size_t operation, const OperatedColumns& columns)> meddles{};
};

/// The operations on a body, and the largest errors, as parts of the sums in which they were seen.
struct ElementOperations {
  std::string model;            // the name of the mix
  std::size_t dissociated = 0;  // operations that separate cells: faces, and fans around an edge or a vertex
  std::size_t removed = 0;      // cells
  std::size_t compared = 0;     // bodies built anew
  double dissociation = 0.0;    // change of energy by an operation that separates cells alone
  double removal = 0.0;         // change of energy by a removal, less that of the cell by `reference` and attachments
  double energy = 0.0;  // less the sum over cells by `reference`; for cells of other kinds, that of the body built anew
  double force = 0.0;   // at a vertex, less that of a body built anew; relative to the sizes that rounding acts on
  double mass = 0.0;    // the same for masses
  std::size_t strangers = 0;  // cells whose corners or material are not those of their cell of the mesh

  std::size_t operations() const { return dissociated + removed; }
};

/// Displace a body of this mesh from rest at random, then operate on it at random; when half of it is gone, begin again
/// with the whole, displaced differently. After every operation the energy is compared; every so often all forces and
/// masses are compared with those of a body that is built from the remaining cells, and each cell with the one of the
/// mesh that it is.
///
/// pre     the mesh is of solid cells
/// throws  InputError as build_body
/// cost    O(operations * cells)
ElementOperations operate_on_elements(const Mesh& mesh, const RegionMix& mix, const ElementOperationsPlan& plan,
                                      const std::function<void(std::size_t)>& tells = {});

}  // namespace dartboard
