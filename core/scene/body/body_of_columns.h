#pragma once
// A simulated body whose topology never changes: columns and arrays, and no dart once it is built.

#include <cstdint>
#include <span>
#include <vector>

#include "core/elements/cell_springs.h"
#include "core/mechanics/element_shapes.h"
#include "core/plain/mesh.h"
#include "core/scene/body/simulated_body.h"
#include "core/views/element_nodes_view.h"
#include "core/views/spring_ends.h"

namespace dartboard {

struct VertexVolumes;

/// The body of a scene without events. It is built on a map, so its numbers are those of a body on a map and it moves
/// with the same bits; the map and all that was held by darts are then freed.
class BodyOfColumns final : public SimulatedBody {
 public:
  /// A mesh with links and without cells makes chains: each link is a spring of its material's stiffness and damping,
  /// and gives half its mass, density times length, to each of its ends.
  ///
  /// throws  InputError as build_body does; for a point without a link, a link whose length or mass is not a number above
  ///         0, and for a velocity that is not finite
  explicit BodyOfColumns(const Problem& problem) : BodyOfColumns(problem, body_needs(problem, false)) {}
  /// `mesh_cell` are the numbers of the cells in the mesh that `needs` refers to; empty: their own.
  BodyOfColumns(const Problem& problem, const BodyNeeds& needs, std::vector<std::uint32_t> mesh_cell = {});

  std::string map_name() const override { return "no map"; }
  VertexColumns& vertices() override { return vertices_; }
  using SimulatedBody::vertices;
  SpringSystem system() const override { return system_of(vertices_, ends_, springs_, gravity_, forces_.terms()); }
  /// throws  InputError for an event that would change the topology
  std::unique_ptr<ReadyEvent> make_ready(const SceneEvent& event) override;

  std::vector<std::vector<CellCorner>> corners_of(std::span<const std::uint32_t> mesh_cells) const override;

  double mass() const override;
  double removed_mass() const override { return 0.0; }
  CellCounts counts() const override { return counts_; }
  double boundary() const override;
  double largest_stress() const override;
  Frame frame(const FrameFields& fields) const override;
  std::string violation() const override { return {}; }
  void state(Archive& archive) override {
    SimulatedBody::state(archive);
    archive(vertices_);
  }
  MemoryReport memory() const override;

 private:
  void link(const Problem& problem, const BodyNeeds& needs);
  double largest_tension() const;  // [N] of the links of a chain; 0 where none is stretched
  VertexVolumes volumes(std::vector<double>& room) const;
  std::uint32_t mesh_cell(std::uint32_t cell) const { return mesh_cell_.empty() ? cell : mesh_cell_[cell]; }
  template <class Map>
  void take(MassSpringBody<Map, Held::by_every_dart> body, const Mesh& mesh, const BodyNeeds& needs);

  VertexColumns vertices_;  // without darts and forces; viscosity, fixed and rest positions only where needed
  Springs springs_;
  std::vector<SpringEnds> ends_;
  // the elements of a body that has any, which has springs only where some cells are; one column of corners is filled
  ElementShapes shapes_;
  std::vector<TetrahedronNodes> nodes_;
  std::vector<SolidNodes> solid_nodes_;
  std::vector<TriangleNodes> triangle_nodes_;
  std::unique_ptr<ForceTerm> elements_;  // null where all are springs
  std::vector<CellSprings> springs_within_;
  std::unique_ptr<ForceTerm> cell_springs_;
  std::vector<SkinSample> samples_;  // of its boundary, where there is contact
  SkinSolids skin_solids_;           // tetrahedra along the boundary; empty without contact between bodies
  Eigen::Vector3d gravity_{0, 0, 0};
  Material material_;
  std::vector<Material> materials_;            // of a body of several
  std::vector<MaterialNumber> cell_material_;  // by cell: its number
  std::vector<double> volume_;                 // [m^3] of each vertex, where densities differ

  // for frames and diagnostics: the cells and the boundary by vertex numbers
  CellCounts counts_;
  Mesh cells_;                                              // its points are not used
  std::vector<std::uint32_t> mesh_cell_;                    // by cell; empty: their own numbers
  std::vector<double> cell_mass_;                           // of a chain, by link
  std::vector<std::uint32_t> component_;                    // by cell; by link of several chains
  std::vector<std::uint32_t> facet_first_{0}, facet_node_;  // corners of the facets of the boundary
};

}  // namespace dartboard
