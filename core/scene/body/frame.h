#pragma once
// One picture of a moving body: the contents of a frame's file.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/plain/mesh.h"
#include "core/scene/file/frame_fields.h"

namespace dartboard {

/// A triangle on the boundary of a refined solid that has a vertex which refinement made, and the face of the mesh in
/// which it lies.
struct RefinedFacet {
  std::array<std::uint32_t, 3> points;
  std::array<std::int64_t, 3> lies_in;  // the numbers of the corners of that face, as in mesh_point
};

/// A place of the boundary inside an obstacle or a body: the mean of its points.
struct FramePair {
  static constexpr std::int64_t none = -1;

  std::array<std::int64_t, 4> sample{none, none, none, none};  // one point, or the three or four of a face
  std::array<std::int64_t, 3> face{none, none, none};          // of the body: the points of the nearest triangle
  std::int64_t obstacle = none;                                // or the number of the obstacle in the scene
  double depth = 0.0;                                          // [m]
};

/// The cells of a body where they are now. Points are its vertices: the parts of a dissociated vertex are two points.
struct Frame {
  double time = 0.0;  // [s]
  Mesh mesh;
  std::vector<Eigen::Vector3d> velocity;  // [m/s] by point
  std::vector<double> mass;               // [kg] by point
  std::vector<std::int64_t> mesh_point;   // by point: its number in the file of the mesh, or -1: refinement made it
  std::vector<std::array<std::uint32_t, 2>> links;  // of chains: the ends of each, which are its cells
  // by cell, then by link
  std::vector<std::uint32_t> mesh_cell;  // its number in the mesh that the body came from
  std::vector<std::uint32_t> component;
  std::vector<std::uint8_t> material;        // its number; of a body of several
  std::vector<std::uint32_t> body;           // its number in the scene; of a scene of several
  std::vector<RefinedFacet> refined_facets;  // not written to files; those within a cell of the mesh are not among them

  FrameFields fields;              // which of the following are filled; the others are empty
  std::vector<std::uint8_t> held;  // by point: 0 free, 1 fixed, 2 driven, 3 held along some axes
  // [Pa] (of a surface [N/m], of a chain next to other bodies 0) by point of a body with cells; files have
  // `measures_of` each
  std::vector<Eigen::Matrix3d> stress;
  // not written to files: the largest_stress of the body, where there are stresses
  std::optional<double> largest_stress;
  std::vector<double> tension;                        // [N] of chains, by link; negative where it is pressed together
  std::vector<Eigen::Vector3d> displacement;          // [m] by point, from where it was at rest
  std::vector<Eigen::Vector3d> contact_force;         // [N] by point: of contacts, without friction and damping
  std::vector<double> contact_depth;                  // [m] by point: the depth inside an obstacle or body; 0 outside
  std::vector<FramePair> contact_pairs;               // with obstacles, then with bodies
  std::vector<std::array<std::uint32_t, 2>> springs;  // of a body with cells: the ends of each
  std::vector<double> strain;                         // (l - L) / L by link of a chain, then by spring
  // not written to files: [m] of each spring of an attachment, its vertex and the place that this is attached to
  std::vector<std::array<Eigen::Vector3d, 2>> attachments;
};

}  // namespace dartboard
