#pragma once
// Bodies of elements that are cut, torn and eroded at random: energies, forces and masses compared with other code.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/elements/tetrahedra.h"
#include "core/plain/material.h"
#include "core/plain/mesh.h"

namespace dartboard {

struct ElementOperationsPlan {
  std::size_t operations = 100'000;
  std::size_t check_every = 1000;  // operations from one comparison with a body built anew to the next
  std::uint64_t seed = 1;
  // for tests: alters the body unknown to the map after an operation, before the comparisons
  std::function<void(std::size_t operation, std::vector<Eigen::Vector3d>& position, std::vector<RestShape>& shape)>
      meddles{};
};

/// The operations on a body of elements, and the largest errors, as parts of the sums in which they were seen.
struct ElementOperations {
  Model model = Model::neo_hookean;
  std::size_t dissociated = 0;  // operations that separate cells: faces, and fans around an edge or a vertex
  std::size_t removed = 0;      // cells
  std::size_t compared = 0;     // bodies built anew
  double dissociation = 0.0;    // change of energy by an operation that separates cells alone
  double removal = 0.0;         // change of energy by a removal, less the energy of the cell by `reference`
  double energy = 0.0;  // less the sum over cells by `reference`; for cells of other kinds, that of the body built anew
  double force = 0.0;   // at a vertex, less that of a body built anew; relative to the sizes that rounding acts on
  double mass = 0.0;    // the same for masses

  std::size_t operations() const { return dissociated + removed; }
};

/// Displace a body of this mesh from rest at random, then operate on it at random; when half of it is gone, begin again
/// with the whole, displaced differently. After every operation the energy is compared; every so often all forces and
/// masses are compared with those of a body that is built from the remaining cells.
///
/// pre     `model` is one of elements, the mesh is of solid cells
/// throws  InputError as build_body
/// cost    O(operations * cells)
ElementOperations operate_on_elements(const Mesh& mesh, Model model, const ElementOperationsPlan& plan,
                                      const std::function<void(std::size_t)>& tells = {});

}  // namespace dartboard
