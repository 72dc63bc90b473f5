#pragma once
// The mass/spring body of section 4.1: a map whose cells carry the mechanics.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/elements/cell_springs.h"
#include "core/forces/springs.h"
#include "core/mechanics/columns.h"
#include "core/mechanics/element_shapes.h"
#include "core/mechanics/embedding.h"
#include "core/mechanics/vertex_columns.h"
#include "core/plain/problem.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

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
  ElementShapes
      elements;  // which elements its cells are, if any, and their rest shapes with the corners of `find_nodes`
  // By cell: the springs on its diagonals; empty where no cell has any.
  std::vector<CellSprings> cell_springs;
  // By cell: the number of its material in `materials`; both are empty in a body of one material.
  std::vector<MaterialNumber> cell_material;
  // Stiffness that a cell contributes to its edges over that of its material, by slot<1>; empty, and 1 for all, until
  // the body is refined, if no springs have a Young's modulus.
  std::vector<double> edge_share;

  /// The columns of cells, except their darts. Cells are added and removed whole: no cell is dissociated.
  static constexpr auto embedded_in_cells() {
    using B = MassSpringBody;
    return std::tuple{EmbeddedColumn{"cell mass", &B::cell_mass, Adapts::recomputed},
                      EmbeddedColumn{"node share", &B::node_share, Adapts::recomputed},
                      EmbeddedColumn{"inside out", &B::cell_inside_out, Adapts::duplicated},
                      EmbeddedColumn{"rest shape", &B::elements, Adapts::duplicated},
                      EmbeddedColumn{"springs within", &B::cell_springs, Adapts::duplicated},
                      EmbeddedColumn{"material", &B::cell_material, Adapts::duplicated}};
  }

  Material material;
  std::vector<Material> materials;
  Surroundings surroundings;

  /// The materials of its cells, by their numbers.
  CellMaterials cell_materials() const { return {material, materials, cell_material}; }

  /// Mass of a vertex [kg]: its share of each incident cell, eq. (1), on the rest shape. Summed in the order of the
  /// cells' darts, so that the bits depend neither on the order of the walk nor on the numbers of the cells.
  double mass_of(Vertex v) const;
  /// Mass of a vertex of which at least one dart in each of its cells is given.
  double mass_of(std::span<const Dart> darts) const;
  /// Volume at rest of a vertex [m^3] (area): the same share of each incident cell.
  double volume_of(Vertex v) const;
  /// Set the mass of vertex embedding k, and what is proportional to it.
  void set_mass(std::uint32_t k, double mass) {
    vertices.mass[k] = mass;
    vertices.inverse_mass[k] = 1.0 / mass;
    vertices.viscosity[k] = material.viscosity * mass;
  }
  /// The spring of an edge: the stiffness and damping of its incident cells, as springs in parallel.
  Spring spring_of(Edge e, double rest_length) const;
  /// The spring of an edge of which at least one dart in each of its cells is given.
  Spring spring_of(std::span<const Dart> darts, double rest_length) const;

  /// Positions and velocities by mesh point.
  /// throws  InputError when a cut or a removal has left a point with no vertex or with several (set_state throws it
  ///         too)
  PointState state() const;
  /// Fixed vertices take the position and stay at rest.
  void set_state(const PointState& state);
  /// A hash of positions and velocities, in the order of the embeddings' numbers.
  std::uint64_t state_hash() const;
  /// Writes or reads what a checkpoint holds: all but the materials and the surroundings, which do not change.
  template <class Archive>
  void state(Archive& archive) {
    archive(map, vertex, edge, face, cell, vertices, springs, edge_dart, face_dart, cell_dart, edge_share);
    columns_state(archive, *this, embedded_in_cells());
  }
  std::size_t embedding_bytes() const { return vertex.bytes() + edge.bytes() + face.bytes() + cell.bytes(); }
};

/// Build the body of a problem. Bodies of elements keep springs of stiffness 0, because refinement needs their rest
/// lengths. Embeddings are numbered in the order in which a coverage meets their cells.
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
