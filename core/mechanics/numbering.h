#pragma once
// The numbers of a body's vertices and edges, in the order of its darts as far as that pays.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mechanics/adapt.h"

namespace dartboard {

/// Number vertices and edges as build_body does: by their lowest darts, which are in the order of the cells.
///
/// pre      `adapt` has followed all changes of the map
/// returns  by old number of a vertex its new one
/// cost     O(darts + vertices log(vertices) + edges log(edges))
template <class Map>
std::vector<std::uint32_t> renumber(MassSpringBody<Map, Held::by_every_dart>& body);

/// Renumbers a body that changes, where its embeddings have become too scattered.
///
/// Changes number new vertices and edges last, and give the last numbers to those that fill gaps: a loop over the
/// springs then reads vertices from all over memory. The body is renumbered once a share of `most_scattered` of the
/// springs has such a number itself or has such a vertex, by counts since the order was last that of the darts: so all
/// runs of a scene do it after the same change. Cells and faces keep their numbers, and bodies of up to `near_vertices`
/// (curve_order.h) all of theirs.
class Numbering {
 public:
  /// With a tenth, steps of a million tetrahedra took up to a fifth longer than those of a fresh body.
  static constexpr double most_scattered = 1.0 / 16.0;

  Numbering() = default;
  template <class Map>
  explicit Numbering(const MassSpringBody<Map, Held::by_every_dart>& body)
      : vertices_(body.vertices.size()), edges_(body.springs.size()) {}

  /// Follow a change, whose report `changed` is.
  ///
  /// returns  as `renumber`, if the body has been renumbered: views of vertices or edges have to be rebuilt then.
  ///          Empty otherwise
  /// cost     O(1), or that of `renumber`, which is that of eight steps of RK4, once `most_scattered` has changed
  template <class Map>
  std::vector<std::uint32_t> follow(MassSpringBody<Map, Held::by_every_dart>& body, const ChangedEmbeddings& changed);

  template <class Archive>
  void state(Archive& archive) {
    archive(vertices_, edges_, scattered_vertices_, scattered_edges_);
  }

 private:
  std::size_t vertices_ = 0, edges_ = 0;  // after the last change
  std::size_t scattered_vertices_ = 0, scattered_edges_ = 0;
};

#define DARTBOARD_NUMBERING(prefix, Map)                                                                  \
  prefix template std::vector<std::uint32_t> renumber(MassSpringBody<Map, Held::by_every_dart>&);         \
  prefix template std::vector<std::uint32_t> Numbering::follow(MassSpringBody<Map, Held::by_every_dart>&, \
                                                               const ChangedEmbeddings&);
DARTBOARD_NUMBERING(extern, Map2)
DARTBOARD_NUMBERING(extern, Map3)
DARTBOARD_NUMBERING(extern, TetMap)

}  // namespace dartboard
