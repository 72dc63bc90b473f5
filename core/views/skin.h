#pragma once
// Contact samples of the boundary of a body: places with weights that follow every change of the topology.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/contact/skin_samples.h"
#include "core/mechanics/adapt.h"

namespace dartboard {

/// Samples of the boundary of a solid, which is its 3-free faces, or of all cells of a surface: their vertices and
/// their middles, by their areas at rest.
///
/// A triangle of area A gives A/12 to each of its corners and 3A/4 to its middle, which integrates quadratic functions
/// exactly. A quadrilateral gives 2A/3 to its middle and to each corner a sixth of the triangle that the corner spans
/// with both its neighbours, A/12 for a parallelogram: quadratic functions are exact on parallelograms, linear ones on
/// any flat and convex quadrilateral. If it is not convex, corners get A/12 each. One that is not flat counts as its
/// projection onto the plane that its diagonals span.
///
/// A vertex has its share of a face however little of the face is inside an obstacle. So the vertices at the foot of
/// the sides of a box carry for these too: a cube of width L, of cells of side h, rests as if its bottom were larger by
/// about h / 2 L of itself (tetrahedra; 2 h / 3 L for hexahedra), and a cut right through a body pressed against an
/// obstacle adds the foot of its two sides. Away from there a cut adds samples that touch nothing.
///
/// Samples are in no particular order: at first vertices by number, then faces by number, afterwards as changes left
/// them; two skins are equal if they have the same samples, to the last bit. Places without area are no samples, and
/// a body that does not keep its rest positions has no samples at all (VertexColumns::keep_rest).
class Skin {
 public:
  static constexpr std::uint32_t no_place = std::numeric_limits<std::uint32_t>::max();

  /// cost    O(vertices and faces)
  template <class Body>
  void rebuild(const Body& body);

  /// Follow what `adapt` reports; gives the samples of `rebuild`.
  ///
  /// cost    O(changed faces and the faces around their vertices and changed vertices), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed);

  const std::vector<SkinSample>& samples() const { return samples_; }
  /// The place in `samples()` of the vertex; no_place if it is not on the boundary.
  std::uint32_t place_of_vertex(std::uint32_t number) const { return of_vertex_[number]; }
  /// The place of the middle of the face, in a solid; of the cell, in a surface.
  std::uint32_t place_of_face(std::uint32_t number) const { return of_face_[number]; }

  friend bool operator==(const Skin& a, const Skin& b);

  template <class Archive>
  void state(Archive& archive) {
    archive(samples_, owner_, of_vertex_, of_face_);
  }
  std::size_t bytes() const;

 private:
  template <class Body>
  void find_face(const Body& body, std::uint32_t k);
  template <class Body>
  void find_vertex(const Body& body, std::uint32_t k);
  void resize(std::size_t vertices, std::size_t faces);
  // `owner`: twice the number of a vertex, or twice that of a face and 1
  void set(std::uint32_t owner, const SkinSample& sample);
  void erase(std::uint32_t owner);
  std::uint32_t& place(std::uint32_t owner) { return (owner % 2 == 0 ? of_vertex_ : of_face_)[owner / 2]; }

  std::vector<SkinSample> samples_;
  std::vector<std::uint32_t> owner_;                // of each sample
  std::vector<std::uint32_t> of_vertex_, of_face_;  // by number

  // scratch, kept between calls
  std::vector<std::uint32_t> touched_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> around_;  // lowest dart, number of a face
};

#define DARTBOARD_SKIN(prefix, Map)                                                    \
  prefix template void Skin::rebuild(const MassSpringBody<Map, Held::by_every_dart>&); \
  prefix template void Skin::apply(const MassSpringBody<Map, Held::by_every_dart>&, const ChangedEmbeddings&);
DARTBOARD_SKIN(extern, Map2)
DARTBOARD_SKIN(extern, Map3)
DARTBOARD_SKIN(extern, TetMap)

}  // namespace dartboard
