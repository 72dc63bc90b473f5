#pragma once
// Bodies of elements that are cut, torn and eroded at random: energies, forces and masses held against other code.

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
  // for tests: what goes wrong behind the map's back after an operation, before anybody looks
  std::function<void(std::size_t operation, std::vector<Eigen::Vector3d>& position, std::vector<RestShape>& shape)>
      meddles{};
};

/// What was done to a body of elements, and the largest of what was wrong, as parts of the sums that it was seen in.
struct ElementOperations {
  Model model = Model::neo_hookean;
  std::size_t dissociated = 0;  // operations that separate cells: faces, and fans around an edge or a vertex
  std::size_t removed = 0;      // cells
  std::size_t compared = 0;     // bodies built anew
  double dissociation = 0.0;    // change of energy by an operation that separates cells alone
  double removal = 0.0;         // change of energy by a removal, less the energy of the cell by `reference`
  double energy = 0.0;  // less the sum over cells by `reference`; of cells of other kinds, of the body built anew
  double force = 0.0;   // at a vertex, less that of a body built anew; of the sizes that rounding acts on there
  double mass = 0.0;    // the same of masses

  std::size_t operations() const { return dissociated + removed; }
};

/// Shake a body of this mesh out of rest, then operate on it at random; when half of it is gone, begin again with the
/// whole, shaken otherwise. After every operation the energy is looked at; every so often all forces and masses are
/// compared with those of a body that is built from the cells that are left.
///
/// pre     `model` is one of elements, the mesh is of solid cells
/// throws  InputError as build_body
/// cost    O(operations * cells)
ElementOperations operate_on_elements(const Mesh& mesh, Model model, const ElementOperationsPlan& plan,
                                      const std::function<void(std::size_t)>& tells = {});

}  // namespace dartboard
