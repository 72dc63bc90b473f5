#pragma once
// The faces that pressures follow, as a body changes.

#include <cstdint>
#include <vector>

#include "core/forces/face_pressure.h"
#include "core/plain/mesh.h"
#include "core/views/followed_cells.h"

namespace dartboard {

/// The faces that a pressure can act on: of solids those of the boundary, seen from outside; of a surface its cells, as
/// the mesh gives them. Their stiffness is that under 1 Pa.
///
/// cost    O(n log n) for n cells
std::vector<PressedFace> outer_faces(const Mesh& mesh);

/// One row for each face that is there. A face stays at its cell whatever is cut around that, and goes with it when
/// that is removed; faces that a cut exposes are not under pressure.
///
/// pre  the body is not refined
class PressedFacesView {
 public:
  PressedFacesView() = default;
  PressedFacesView(std::vector<PressedFace> of_mesh, FollowedCells::MeshCell mesh_cell);

  std::vector<PressedFace> rows;

  /// cost    O(cells)
  template <class Body>
  void rebuild(const Body& body);

  /// Follow what `adapt` reports; gives what `rebuild` would, but for the order of the rows.
  ///
  /// cost    O(cells around changed vertices), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed);

  /// Have both the same rows, in whatever order?
  friend bool operator==(const PressedFacesView& a, const PressedFacesView& b);
  template <class Archive>
  void state(Archive& archive) {
    archive(rows, face_, row_, cells_);
  }
  std::size_t bytes() const;
  void shrink_to_fit();

 private:
  template <class Body>
  void find_corners(const Body& body, std::uint32_t place);

  void erase_all_of(std::uint32_t place);

  std::vector<PressedFace> of_mesh_;  // ascending by cell; constant
  std::vector<std::uint32_t> first_;  // face of each followed cell, and the end; constant
  FollowedCells cells_;
  std::vector<std::uint32_t> face_;  // by row: its place in of_mesh_
  std::vector<std::uint32_t> row_;   // by face; nothing once its cell is removed

  // scratch, kept between calls
  std::vector<std::uint32_t> touched_;
  std::vector<FollowedCells::Corner> corners_;
};

#define DARTBOARD_PRESSED_FACES(prefix, Map)                                                       \
  prefix template void PressedFacesView::rebuild(const MassSpringBody<Map, Held::by_every_dart>&); \
  prefix template void PressedFacesView::apply(const MassSpringBody<Map, Held::by_every_dart>&,    \
                                               const ChangedEmbeddings&);
DARTBOARD_PRESSED_FACES(extern, Map2)
DARTBOARD_PRESSED_FACES(extern, Map3)
DARTBOARD_PRESSED_FACES(extern, TetMap)

}  // namespace dartboard
