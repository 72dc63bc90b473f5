#pragma once
// The boundary of a body: the 3-free faces of a solid, the 2-free edges of a surface.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/topology/orientation.h"

namespace dartboard {

/// A face (in a surface an edge) on the boundary: the number of its embedding and a dart that gives its orientation.
struct BoundaryFacet {
  std::uint32_t number;
  Dart dart;
  friend bool operator==(const BoundaryFacet&, const BoundaryFacet&) = default;
};

/// The facets on the boundary, in no particular order, and the place of each in the list.
///
/// In a solid: walked by alpha_0 alpha_1 from its dart, a face runs counter-clockwise seen from outside the body at
/// rest. In a surface: an edge leads from its dart to alpha_0 in the direction in which the mesh gave its face. The
/// dart is the lowest of its facet, or the alpha_0 of that if the lowest has the other orientation.
class BoundarySurface {
 public:
  static constexpr std::uint32_t no_place = std::numeric_limits<std::uint32_t>::max();

  /// cost    O(facets), and O(darts of the cell) for each on the boundary; O(1) for a tetrahedron
  template <class Body>
  void rebuild(const Body& body) {
    facets_.clear();
    place_.clear();
    const auto& darts = facet_darts(body);
    resize(darts.size());
    for (std::uint32_t k = 0; k < darts.size(); ++k) follow(body, k, darts[k]);
  }

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(changed facets), each as in `rebuild`, whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    const auto& darts = facet_darts(body);
    resize(darts.size());
    for (const std::uint32_t k : Body::dimension == 3 ? changed.faces : changed.edges) follow(body, k, darts[k]);
  }

  std::span<const BoundaryFacet> facets() const { return facets_; }
  /// The place in `facets()` of the facet of this number; no_place if it is not on the boundary.
  std::uint32_t place(std::uint32_t number) const { return place_[number]; }

  /// The vertex numbers of a facet, from its dart, in the order of its orientation.
  template <class Body>
  static auto corners(const Body& body, const BoundaryFacet& facet) {
    boost::container::small_vector<std::uint32_t, 4> vertices;
    if constexpr (Body::dimension == 3) {
      Dart d = facet.dart;
      do {
        vertices.push_back(body.vertex(body.map, d));
        d = body.map.template alpha<0, 1>(d);
      } while (d != facet.dart);
    } else {
      vertices.push_back(body.vertex(body.map, facet.dart));
      vertices.push_back(body.vertex(body.map, body.map.template alpha<0>(facet.dart)));
    }
    return vertices;
  }

  /// The area vector [m^2] of a face at the current positions, outwards: half the sum of the cross products along its
  /// corners; if they are not in a plane, that of any surface they span.
  template <class Body>
  static Eigen::Vector3d area_vector(const Body& body, const BoundaryFacet& facet) requires(Body::dimension == 3) {
    const auto& x = body.vertices.position;
    const auto corner = corners(body, facet);
    Eigen::Vector3d twice(0, 0, 0);
    for (std::size_t k = 1; k + 1 < corner.size(); ++k)
      twice += (x[corner[k]] - x[corner[0]]).cross(x[corner[k + 1]] - x[corner[0]]);
    return 0.5 * twice;
  }
  /// The direction of the area vector; zero for a face without area.
  template <class Body>
  static Eigen::Vector3d unit_normal(const Body& body, const BoundaryFacet& facet) requires(Body::dimension == 3) {
    return area_vector(body, facet).stableNormalized();
  }
  /// The vector of an edge of a surface, from its first to its second corner [m] at the current positions.
  template <class Body>
  static Eigen::Vector3d edge_vector(const Body& body, const BoundaryFacet& facet) requires(Body::dimension == 2) {
    const auto corner = corners(body, facet);
    return body.vertices.position[corner[1]] - body.vertices.position[corner[0]];
  }

  /// The area [m^2] of the boundary of a solid, the length [m] of that of a surface, at the current positions.
  template <class Body>
  double total_measure(const Body& body) const {
    double total = 0.0;
    for (const BoundaryFacet& facet : facets_)
      if constexpr (Body::dimension == 3)
        total += area_vector(body, facet).norm();
      else
        total += edge_vector(body, facet).norm();
    return total;
  }

  /// Equal when the same facets are on the boundary with the same darts, in any order.
  friend bool operator==(const BoundarySurface& a, const BoundarySurface& b);

  std::size_t bytes() const {
    return sizeof(BoundaryFacet) * facets_.capacity() + sizeof(std::uint32_t) * place_.capacity();
  }

 private:
  template <class Body>
  static const std::vector<Dart>& facet_darts(const Body& body) {
    if constexpr (Body::dimension == 3)
      return body.face_dart;
    else
      return body.edge_dart;
  }
  template <class Body>
  void follow(const Body& body, std::uint32_t number, Dart lowest) {
    constexpr int n = Body::dimension;
    if (!body.map.template is_free<n>(lowest)) return erase(number);
    const std::uint32_t cell = body.cell(body.map, lowest);
    const bool as_listed = same_orientation(body.map, body.cell_dart[cell], lowest);
    const bool inside_out = body.cell_inside_out[cell] != 0;
    set({number, as_listed != inside_out ? lowest : body.map.template alpha<0>(lowest)});
  }
  void resize(std::size_t count);
  void set(const BoundaryFacet& facet);
  void erase(std::uint32_t number);

  std::vector<BoundaryFacet> facets_;
  std::vector<std::uint32_t> place_;  // by number
};

}  // namespace dartboard
