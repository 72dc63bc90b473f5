#pragma once
// The mass/spring body of section 4.1: a map whose cells carry the mechanics.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/elements/cell_springs.h"
#include "core/elements/membranes.h"
#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/forces/springs.h"
#include "core/mechanics/columns.h"
#include "core/mechanics/embedding.h"
#include "core/plain/problem.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// In place of a mesh point, for a vertex that a refinement made.
inline constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// What vertices embed. Columns share one numbering, that of the vertex embeddings.
struct VertexColumns {
  std::vector<double> mass;               // [kg]  eq. (1)
  std::vector<double> inverse_mass;       // [1/kg]; a product is cheaper than a quotient in the loop
  std::vector<double> viscosity;          // [kg/s], proportional to the mass
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<Eigen::Vector3d> velocity;  // [m/s]
  std::vector<Eigen::Vector3d> force;     // [N] sum of the springs; zero between steps
  std::vector<std::uint8_t> fixed;        // 1: held still
  std::vector<HeldAxes> held_axes;        // of those that move along the others; left out where there are none
  std::vector<std::uint32_t>
      point;  // the mesh point it came from; shared by the parts of a dissociated vertex, or no_point
  std::vector<Eigen::Vector3d> rest;  // [m] where it was at rest; left out until keep_rest
  std::vector<Eigen::Vector3d>
      pull;                // [m/s^2] forces from outside over its mass, so that parts share them; or left out
  std::vector<Dart> dart;  // the lowest dart of the vertex

  std::size_t size() const { return mass.size(); }

  /// Hold from now on where each vertex was at rest, which pictures of displacement need and no motion does.
  /// pre  the body is at rest where its mesh has it
  void keep_rest() { rest = position; }

  /// Hold the vertices of these points along their axes from now on, and nothing else; velocities lose what is along
  /// them.
  void hold(std::span<const HeldPoint> points);

  /// Every column but the darts, which are the cells themselves.
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

/// A body on a map of type Map, its embeddings held by one dart of each orbit or by every dart.
template <class Map, Held held>
struct MassSpringBody {
  static constexpr int dimension = Map::dimension;

  Map map;
  CellEmbedding<0, Map, held> vertex;
  CellEmbedding<1, Map, held> edge;
  CellEmbedding<2, Map, held> face;          // of a solid; the faces of a surface are its cells
  CellEmbedding<dimension, Map, held> cell;  // the volumes of a solid, the faces of a surface

  VertexColumns vertices;
  Springs springs;
  std::vector<Dart> edge_dart;     // of each spring: the lowest dart of its edge
  std::vector<Dart> face_dart;     // of a solid: the lowest dart of each face
  std::vector<double> cell_mass;   // [kg]
  std::vector<double> node_share;  // [kg] of each cell: its mass over its number of nodes
  std::vector<Dart> cell_dart;     // the lowest dart of each cell
  // 1 where the face of that dart, walked along alpha_0 alpha_1 from it, runs clockwise seen from outside the cell at
  // rest
  std::vector<std::uint8_t> cell_inside_out;
  // What elements need of the rest shape of each cell, whose corners are those of `find_nodes`: where all are
  // tetrahedra, or of cells of any kind; of a surface where all are triangles, or of any; empty with springs.
  std::vector<RestShape> cell_shape;
  std::vector<SolidShape> cell_solid;
  std::vector<PlaneInverse> cell_triangle;
  std::vector<MembraneShape> cell_membrane;
  // Of each cell the springs on its diagonals; empty where no cell has any.
  std::vector<CellSprings> cell_springs;
  // Of each cell the number of its material in `materials`; both empty in a body of one.
  std::vector<MaterialNumber> cell_material;
  // Stiffness that a cell contributes to its edges over that of its material, by slot<1>; empty, and 1 for all, until
  // the body is refined, where no springs have a Young's modulus.
  std::vector<double> edge_share;

  /// The columns of cells, but for their darts. Cells come and go whole: none is dissociated.
  static constexpr auto embedded_in_cells() {
    using B = MassSpringBody;
    return std::tuple{EmbeddedColumn{"cell mass", &B::cell_mass, Adapts::recomputed},
                      EmbeddedColumn{"node share", &B::node_share, Adapts::recomputed},
                      EmbeddedColumn{"inside out", &B::cell_inside_out, Adapts::duplicated},
                      EmbeddedColumn{"rest shape", &B::cell_shape, Adapts::duplicated},
                      EmbeddedColumn{"shape of a solid", &B::cell_solid, Adapts::duplicated},
                      EmbeddedColumn{"shape of a triangle", &B::cell_triangle, Adapts::duplicated},
                      EmbeddedColumn{"shape of a membrane", &B::cell_membrane, Adapts::duplicated},
                      EmbeddedColumn{"springs within", &B::cell_springs, Adapts::duplicated},
                      EmbeddedColumn{"material", &B::cell_material, Adapts::duplicated}};
  }

  Material material;
  std::vector<Material> materials;
  Surroundings surroundings;

  /// The materials of its cells, by their numbers.
  CellMaterials cell_materials() const { return {material, materials, cell_material}; }

  /// Mass of a vertex [kg]: its share of each incident cell, eq. (1), on the rest shape. Summed by the cells' darts,
  /// so that neither the order of the walk nor the numbers of the cells leave a trace in the bits.
  double mass_of(Vertex v) const;
  /// The same for a vertex of which at least one dart in each of its cells is given.
  double mass_of(std::span<const Dart> darts) const;
  /// Volume at rest of a vertex [m^3] (area): that share of each incident cell.
  double volume_of(Vertex v) const;
  /// The mass of vertex embedding k, and what is proportional to it.
  void set_mass(std::uint32_t k, double mass) {
    vertices.mass[k] = mass;
    vertices.inverse_mass[k] = 1.0 / mass;
    vertices.viscosity[k] = material.viscosity * mass;
  }
  /// Stiffness and damping of an edge: what its incident cells contribute, as springs in parallel.
  Spring spring_of(Edge e, double rest_length) const;
  /// The same for an edge of which at least one dart in each of its cells is given.
  Spring spring_of(std::span<const Dart> darts, double rest_length) const;

  /// Positions and velocities by mesh point.
  /// throws  InputError when a cut or a removal has left a point with another number of vertices than one (set_state
  ///         too)
  PointState state() const;
  /// Fixed vertices take the position and stay at rest.
  void set_state(const PointState& state);
  /// Of positions and velocities, in the order of the embeddings' numbers.
  std::uint64_t state_hash() const;
  /// What a checkpoint holds of it: all but the materials and the surroundings, which do not change.
  template <class Archive>
  void state(Archive& archive) {
    archive(map, vertex, edge, face, cell, vertices, springs, edge_dart, face_dart, cell_dart, edge_share);
    columns_state(archive, *this, embedded_in_cells());
  }
  std::size_t embedding_bytes() const { return vertex.bytes() + edge.bytes() + face.bytes() + cell.bytes(); }
};

/// Build the body of a problem. With a model of elements its springs have no stiffness: what they have is their rest
/// lengths, which refinement goes on with. Embeddings are numbered in the order in which a coverage meets their cells.
///
/// throws  InputError if the mesh does not fit the map (build_map), a point belongs to no cell, a fixed point does not
///         exist, a number is not finite or a density is not positive, or one mesh point is several vertices of the map
///         (cells that touch in a point or an edge only are not connected in a quasi-manifold); for a model of elements
///         if a surface does not have it, or a cell is too flat for its shape to be a number, or turned inside out at a
///         Gauss point; for cells without a material, or more than `most_materials`
template <class Map, Held held>
MassSpringBody<Map, held> build_body(const Problem& problem);

#define DARTBOARD_BODY(prefix, Map, held)           \
  prefix template struct MassSpringBody<Map, held>; \
  prefix template MassSpringBody<Map, held> build_body(const Problem&);
#define DARTBOARD_BODIES(prefix)                    \
  DARTBOARD_BODY(prefix, Map2, Held::by_one_dart)   \
  DARTBOARD_BODY(prefix, Map2, Held::by_every_dart) \
  DARTBOARD_BODY(prefix, Map3, Held::by_one_dart)   \
  DARTBOARD_BODY(prefix, Map3, Held::by_every_dart) \
  DARTBOARD_BODY(prefix, TetMap, Held::by_one_dart) \
  DARTBOARD_BODY(prefix, TetMap, Held::by_every_dart)
DARTBOARD_BODIES(extern)

}  // namespace dartboard
