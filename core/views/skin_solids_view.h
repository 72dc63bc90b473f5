#pragma once
// The tetrahedra and triangles along the boundary for contact, as they follow every change of the topology.

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/contact/skin_solids.h"
#include "core/mechanics/adapt.h"

namespace dartboard {

/// The tetrahedra along the boundary of a solid and the triangles of its boundary, in addition to Skin; empty for a
/// surface, and for a body that does not keep its rest positions (VertexColumns::keep_rest).
///
/// A cell with more than four corners is split into the pyramids over its faces from the corner whose mesh point has
/// the lowest number, and a face into the triangles from its own lowest corner: neighbours split the face between them
/// in the same way, also after cuts and renumbering. The orientation is found from rest positions.
class SkinSolidsView {
 public:
  /// The body of a scene that a cell belongs to, by the cell's number; empty: all belong to one.
  using GroupOfCell = std::function<std::uint32_t(std::uint32_t)>;

  SkinSolidsView() = default;
  explicit SkinSolidsView(GroupOfCell group) : group_(std::move(group)) {}

  /// cost    O(cells)
  template <class Body>
  void rebuild(const Body& body);

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(changed cells, and the cells around changed vertices and around the corners of changed faces), whatever
  ///         the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed);

  const SkinSolids& solids() const { return solids_; }
  friend bool operator==(const SkinSolidsView& a, const SkinSolidsView& b) { return a.solids_ == b.solids_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(solids_);
  }
  std::size_t bytes() const { return solids_.bytes(); }

 private:
  /// A face of a cell: corners in order, from that of the lowest point.
  struct Face {
    std::array<std::uint32_t, 4> nodes{};
    std::uint32_t count = 0;
    bool outer = false;
  };
  template <class Body>
  void add_face(const Body& body, std::uint32_t number);
  template <class Body>
  void add_cell(const Body& body, std::uint32_t number);

  GroupOfCell group_;
  SkinSolids solids_;

  // scratch, kept between calls
  std::vector<std::uint32_t> cells_, faces_;
  std::vector<Face> around_;
};

#define DARTBOARD_SKIN_SOLIDS(prefix, Map)                                                       \
  prefix template void SkinSolidsView::rebuild(const MassSpringBody<Map, Held::by_every_dart>&); \
  prefix template void SkinSolidsView::apply(const MassSpringBody<Map, Held::by_every_dart>&, const ChangedEmbeddings&);
DARTBOARD_SKIN_SOLIDS(extern, Map2)
DARTBOARD_SKIN_SOLIDS(extern, Map3)
DARTBOARD_SKIN_SOLIDS(extern, TetMap)

}  // namespace dartboard
