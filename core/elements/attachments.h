#pragma once
// Attachments: springs without length between vertices and points of cells, or fixed places.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/forces/force_term.h"

namespace dartboard {

/// A point of a mesh and where it is attached: to a point of a cell, or to a fixed place.
struct Attachment {
  static constexpr std::uint32_t no_cell = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t point = 0;                 // of the mesh
  std::uint32_t cell = no_cell;            // of the mesh; no_cell: a fixed place
  std::uint32_t count = 0;                 // of corners: of a triangle or a tetrahedron in the cell
  std::array<std::uint32_t, 4> corners{};  // points of the mesh
  std::array<double, 4> weight{};          // of the corners, 1 together; negative beyond a side
  Eigen::Vector3d place{0, 0, 0};          // [m] the fixed place
  double per_mass = 0.0;                   // [1/s^2] the stiffness over the mass of the vertex

  bool has_cell() const { return cell != no_cell; }
};

/// One spring: the vertex, and the point that it is attached to by the vertices at its corners.
struct AttachedVertex {
  std::uint32_t count = 1;               // of vertices: 1 with a fixed place, otherwise 4 or 5
  std::array<std::uint32_t, 5> nodes{};  // the vertex, then those at the corners
  std::array<double, 4> weight{};        // of the corners
  Eigen::Vector3d place{0, 0, 0};        // [m] the fixed place
  double per_mass = 0.0;                 // [1/s^2]

  friend bool operator==(const AttachedVertex&, const AttachedVertex&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(count, nodes, weight, place, per_mass);
  }
};

/// [m] The place that the vertex of a spring is attached to, with the vertices at x.
Eigen::Vector3d place_of(const AttachedVertex& spring, std::span<const Eigen::Vector3d> x);

/// The spring of an attachment of a vertex; the vertices at its corners follow in the same order.
AttachedVertex attached(const Attachment& attachment, std::uint32_t vertex);

/// The energy of a spring is k |x - sum of w_a x_a|^2 / 2, with k = per_mass times the mass of its vertex: parts of a
/// vertex share the stiffness as they share the mass, so a dissociation changes no energy. Its matrix is constant and
/// positive semidefinite. Springs to cells keep momentum and angular momentum: the force is along the line between
/// the vertex and the point.
///
/// The term reads the rows and masses anew in each call. It has no virial: its springs are no part of the material.
std::unique_ptr<ForceTerm> make_attachments(const std::vector<AttachedVertex>& rows, const std::vector<double>& mass);

}  // namespace dartboard
