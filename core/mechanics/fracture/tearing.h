#pragma once
// Tearing where "the inner forces go beyond a given threshold" (section 5.1): which vertex, and along which faces.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/operations/topology_change.h"

namespace dartboard {

/// Says whether an interior face, given by any of its darts, may be torn; an empty function allows all of them.
using FaceFilter = std::function<bool(Dart)>;

/// Makes the body, its views and all else that depends on the map follow a change of it: `adapt` at least.
using FollowChange = std::function<void(const TopologyChange&)>;

/// The interior face around vertex k "whose normal best approximates the inner stress direction": the largest
/// |n . direction| / |direction| of those that the filter accepts and that reach `least_alignment`, n the unit normal
/// at the positions now. Returns the lowest of its darts at the vertex; no_dart if there is no such face.
///
/// Degenerate faces, whose area is below 2^-40 of the sum of the squares of their sides, are skipped: their normal is
/// rounding. Ties, faces equal to 24 bits of that number, are decided by the number of the dart returned: so a regular
/// mesh tears alike however it lies in space, and numbers matter for ties only.
/// throws  InputError if the direction is zero or not finite
/// cost    O(darts around the vertex)
/// source  section 5.1
template <class Map>
Dart starting_face(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k,
                   const Eigen::Vector3d& direction, const FaceFilter& filter = {}, double least_alignment = 0.0);

/// The rule by which a body tears.
struct TearRule {
  double threshold;  // [Pa] of the principal stress of a vertex
  // The least |n . direction| of the starting face: a face along the tension carries none of it. With 0, a body torn
  // across continues to tear lengthwise as long as the two sides are still under stress. 1/2 is 60 degrees.
  double least_alignment = 0.5;
  std::size_t most_per_step = std::numeric_limits<std::size_t>::max();  // vertices torn in one call
};

struct TornVertices {
  std::size_t stressed = 0;     // vertices above the threshold before the first tear
  std::size_t tears = 0;        // vertices whose faces were dissociated
  std::size_t faces = 0;        // faces dissociated
  double largest_stress = 0.0;  // [Pa] the largest principal stress before the first tear; 0 for an empty body
};

/// Tear the body at every vertex whose principal stress is above the threshold, fixed ones too.
///
/// Vertices are taken in descending order of stress, ties (to 24 bits, as in `starting_face`) by dart. Each is
/// examined again when its turn comes, on the map as earlier tears left it; if they took it apart, all its parts wait
/// for the next call. Without a filter the fan of the starting face is torn (`tear_fan`), from the side that keeps it
/// nearer to the plane across the stress, so that numbers do not choose it. With a filter, a seam, torn are the
/// accepted faces around the vertex that are connected with the starting face by edges at the vertex: where the seam
/// is a surface, the piece of it there. A vertex without a face to tear, such as that of a single cell, is skipped.
///
/// `follow` is called after each tear. `stress` is scratch, by vertex number, and holds the stresses before the first
/// tear afterwards.
///
/// pre     `ends` by edge number, and corners by cell number or empty, as the body has them; neither is used once
///         `follow` is called
/// throws  InputError if the threshold is not positive, or the alignment is above 1 or not a number;
///         StressError if a stress is not finite; then the body is unchanged
/// cost    O(springs + cells), and around the vertices torn; corners that are not given are walked to
/// source  section 5.1
template <class Map>
TornVertices tear_where_stressed(MassSpringBody<Map, Held::by_every_dart>& body,
                                 std::span<const std::array<std::uint32_t, 2>> ends, const TearRule& rule,
                                 const FaceFilter& filter, const FollowChange& follow,
                                 std::vector<Eigen::Matrix3d>& stress, ForceTerms terms = {},
                                 const CornerRows& corners = {});

#define DARTBOARD_TEARING(prefix, Map)                                                                           \
  prefix template Dart starting_face(const MassSpringBody<Map, Held::by_every_dart>&, std::uint32_t,             \
                                     const Eigen::Vector3d&, const FaceFilter&, double);                         \
  prefix template TornVertices tear_where_stressed(                                                              \
      MassSpringBody<Map, Held::by_every_dart>&, std::span<const std::array<std::uint32_t, 2>>, const TearRule&, \
      const FaceFilter&, const FollowChange&, std::vector<Eigen::Matrix3d>&, ForceTerms, const CornerRows&);
DARTBOARD_TEARING(extern, Map3)
DARTBOARD_TEARING(extern, TetMap)

}  // namespace dartboard
