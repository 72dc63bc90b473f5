#pragma once
// Two bodies, the second of which is put to the first at random.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/plain/mesh.h"
#include "core/plain/random.h"
#include "core/scene/body/simulated_body.h"
#include "validation/contact/judged_overlaps.h"

namespace dartboard {

/// pre     meshes of tetrahedra, of convex bodies: outwards is away from the mean of the vertices
/// units   meshes [m]
class PlacedBodies {
 public:
  PlacedBodies(const Mesh& first, const Mesh& second, std::uint64_t seed);

  const BodyContact& contact() const { return *body_->contacts().bodies; }
  /// The present places of the vertices of both.
  std::span<const Eigen::Vector3d> x() const { return x_; }
  std::span<const CellCorners> cells() const { return cells_; }
  /// [m] of the cells at the boundary
  double least_altitude() const { return contact().least_altitude(rest_); }

  /// Put a place on the surface of the second (a corner, on an edge, in a face, as often each) into such a place of the
  /// first, turned so that the outward directions at both are opposite. `shallowest` least altitudes deep to one, each
  /// depth as often; below 0 the two places are apart.
  void place(double shallowest = 0.0);
  /// Move the second on, by less than `share` of the least altitude: so little that lists and ways out are used again.
  void shift(double share);
  /// The overlaps of cells of the first with cells of the second, and whether they are felt.
  std::vector<JudgedOverlap> overlaps() const;

 private:
  /// The triangles of the boundary of a body, its vertices, and its centre at rest.
  struct Shape {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> vertices;
    Eigen::Vector3d centre{0, 0, 0};
  };
  Eigen::Vector3d place_on(const Shape& shape);

  SplitMix64 random_;
  std::unique_ptr<SimulatedBody> body_;
  std::size_t cells_of_first_ = 0;
  std::vector<Eigen::Vector3d> rest_, x_;
  std::vector<CellCorners> cells_;
  std::array<Shape, 2> shapes_;
};

}  // namespace dartboard
