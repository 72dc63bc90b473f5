#pragma once
// Seams: sets of interior faces along which a body is to come apart; of a surface, sets of interior edges.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/topology/facets.h"

namespace dartboard {

/// A set of faces of a map of volumes, given by any of their darts. It refers to the cells of the map it was made for;
/// new cells in the places of removed ones would be mistaken for them.
///
/// cost    O(1) per query; a bit per face and volume
class FaceSet {
 public:
  template <class Map>
  FaceSet(const Map& map, std::span<const Dart> faces);

  template <class Map>
  bool contains(const Map&, Dart d) const {
    const std::uint32_t slot = Map::template slot<2>(d);
    return slot < in_.size() && in_[slot];
  }

 private:
  std::vector<bool> in_;  // by slot<2>
};

/// The facets between two cells for whose numbers `chosen(a, b)` holds, `a` being that of the lower dart: one dart of
/// each facet, its lowest, ascending.
template <class Map, class Chosen>
std::vector<Dart> facets_between(const MassSpringBody<Map, Held::by_every_dart>& body, Chosen&& chosen) {
  std::vector<Dart> facets;
  for_each_inner_facet(body.map, [&](Dart d) {
    if (chosen(body.cell(body.map, d), body.cell(body.map, body.map.template alpha<Map::dimension>(d))))
      facets.push_back(d);
  });
  return facets;
}

/// The interior faces between cells on different sides of a plane: one dart of each, its lowest, ascending.
///
/// A cell is on the side where the mean of its vertices' positions is now. A mean on the plane, which is as thick as
/// border_thickness() of these positions, is in front of it (where the normal points). Every path from cell to
/// cell between the sides crosses such a face, so dissociating all of them separates the body completely. The normal
/// need not be a unit vector.
///
/// throws  InputError if a number is not finite or the normal is zero
/// cost    O(darts)
template <class Map>
std::vector<Dart> faces_on_plane(const MassSpringBody<Map, Held::by_every_dart>& body, const Eigen::Vector3d& point,
                                 const Eigen::Vector3d& normal);

/// Does the segment from a to b cross the area that a blade sweeps? The blade moves along a path and extends from it by
/// `depth`: the area is a parallelogram on each leg. An end on a leg's plane counts as in front of it. Borders are
/// `thickness` thick (border.h).
///
/// pre     no leg is of length 0 or along the depth
bool crosses_sweep(std::span<const Eigen::Vector3d> path, const Eigen::Vector3d& depth, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b, double thickness);

/// The interior faces, of a surface edges, between cells that the sweep of a blade separates: one dart of each, its
/// lowest, ascending.
///
/// A face is on the sweep if the segment between the means of the vertices of its two cells crosses it.
/// pre     as crosses_sweep
/// cost    O(darts + faces legs)
template <class Map>
std::vector<Dart> facets_on_sweep(const MassSpringBody<Map, Held::by_every_dart>& body,
                                  std::span<const Eigen::Vector3d> path, const Eigen::Vector3d& depth);

/// The mean of the positions of a face's vertices [m]; in a surface of an edge's two.
template <class Map>
Eigen::Vector3d facet_centre(const MassSpringBody<Map, Held::by_every_dart>& body, Dart d);

/// The interior faces that have three given mesh points among their vertices: one dart of each face, its lowest,
/// ascending. Three points identify a quadrilateral too. If several faces have the same three points, all are returned.
///
/// throws  InputError, naming the points, if no interior face has them
/// cost    O(darts log(triples))
template <class Map>
std::vector<Dart> faces_of_points(const MassSpringBody<Map, Held::by_every_dart>& body,
                                  std::span<const std::array<std::uint32_t, 3>> triples);

/// In a surface, the interior edges between faces on different sides of a plane.
std::vector<Dart> edges_on_plane(const MassSpringBody<Map2, Held::by_every_dart>& body, const Eigen::Vector3d& point,
                                 const Eigen::Vector3d& normal);

/// In a surface, the interior edges between two given mesh points.
std::vector<Dart> edges_of_points(const MassSpringBody<Map2, Held::by_every_dart>& body,
                                  std::span<const std::array<std::uint32_t, 2>> pairs);

#define DARTBOARD_SEAMS(prefix, Map)                                                                           \
  prefix template FaceSet::FaceSet(const Map&, std::span<const Dart>);                                         \
  prefix template Eigen::Vector3d facet_centre(const MassSpringBody<Map, Held::by_every_dart>&, Dart);         \
  prefix template std::vector<Dart> faces_on_plane(const MassSpringBody<Map, Held::by_every_dart>&,            \
                                                   const Eigen::Vector3d&, const Eigen::Vector3d&);            \
  prefix template std::vector<Dart> facets_on_sweep(const MassSpringBody<Map, Held::by_every_dart>&,           \
                                                    std::span<const Eigen::Vector3d>, const Eigen::Vector3d&); \
  prefix template std::vector<Dart> faces_of_points(const MassSpringBody<Map, Held::by_every_dart>&,           \
                                                    std::span<const std::array<std::uint32_t, 3>>);
DARTBOARD_SEAMS(extern, Map3)
DARTBOARD_SEAMS(extern, TetMap)
extern template Eigen::Vector3d facet_centre(const MassSpringBody<Map2, Held::by_every_dart>&, Dart);
extern template std::vector<Dart> facets_on_sweep(const MassSpringBody<Map2, Held::by_every_dart>&,
                                                  std::span<const Eigen::Vector3d>, const Eigen::Vector3d&);

}  // namespace dartboard
