#pragma once
// The embeddings of the vertices of a body: all that moves, without the map whose cells the vertices are.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "core/mechanics/columns.h"
#include "core/plain/held_axes.h"
#include "core/plain/problem.h"
#include "core/topology/storage/dart.h"

namespace dartboard {

/// Stands in place of a mesh point for a vertex that a refinement made.
inline constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// A vertex of a cell, and the point of the mesh that it is a part of.
struct CellCorner {
  std::uint32_t point, vertex;
};

/// The columns of the vertex embeddings. All share one numbering.
struct VertexColumns {
  std::vector<double> mass;               // [kg]  eq. (1)
  std::vector<double> inverse_mass;       // [1/kg]; a product is cheaper than a quotient in the loop
  std::vector<double> viscosity;          // [kg/s], proportional to the mass
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<Eigen::Vector3d> velocity;  // [m/s]
  std::vector<Eigen::Vector3d> force;     // [N] sum of the springs; zero between steps
  std::vector<std::uint8_t> fixed;        // 1: held still
  std::vector<HeldAxes> held_axes;        // axes along which a vertex is held; left out where no vertex is held
  std::vector<std::uint32_t>
      point;  // the mesh point it came from; shared by the parts of a dissociated vertex, or no_point
  std::vector<Eigen::Vector3d> rest;  // [m] where it was at rest; left out until keep_rest
  std::vector<Eigen::Vector3d>
      pull;                // [m/s^2] external forces over its mass, so that parts share them; may be left out
  std::vector<Dart> dart;  // the lowest dart of the vertex

  std::size_t size() const { return mass.size(); }

  /// Keep the rest position of each vertex from now on: pictures of displacement need it, motions do not.
  /// pre  the body is at rest, at the positions of its mesh
  void keep_rest() { rest = position; }

  /// From now on hold the vertices of these points, and no others, along their axes; velocities lose their components
  /// along these axes.
  void hold(std::span<const HeldPoint> points);

  /// Every column except the darts, which are the cells themselves.
  static constexpr auto embedded() {
    using V = VertexColumns;
    return std::tuple{EmbeddedColumn{"mass", &V::mass, Adapts::recomputed},
                      EmbeddedColumn{"inverse mass", &V::inverse_mass, Adapts::recomputed},
                      EmbeddedColumn{"viscosity", &V::viscosity, Adapts::proportional},
                      EmbeddedColumn{"position", &V::position, Adapts::duplicated},
                      EmbeddedColumn{"velocity", &V::velocity, Adapts::duplicated},
                      EmbeddedColumn{"force", &V::force, Adapts::duplicated},
                      EmbeddedColumn{"fixed", &V::fixed, Adapts::duplicated},
                      EmbeddedColumn{"held axes", &V::held_axes, Adapts::duplicated},
                      EmbeddedColumn{"point", &V::point, Adapts::duplicated},
                      EmbeddedColumn{"place at rest", &V::rest, Adapts::duplicated},
                      EmbeddedColumn{"pull", &V::pull, Adapts::duplicated}};
  }

  template <class Archive>
  void state(Archive& archive) {
    columns_state(archive, *this, embedded());
    archive(dart);
  }
};
static_assert(sizeof(VertexColumns) ==
                  (std::tuple_size_v<decltype(VertexColumns::embedded())> + 1) * sizeof(std::vector<double>),
              "a column of vertices is missing in embedded()");

}  // namespace dartboard
