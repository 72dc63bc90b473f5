#pragma once
// A body that moves and changes, on a map of any type: the one interface that hides the type of the map from scenes.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/mechanics/vertex_columns.h"
#include "core/plain/problem.h"
#include "core/plain/random.h"
#include "core/scene/body/body_forces.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/body/events/ready_event.h"
#include "core/scene/body/frame.h"
#include "core/scene/body/memory.h"
#include "core/scene/body/needs.h"
#include "core/scene/file/scene_file.h"
#include "core/time/method/integrator.h"

namespace dartboard {

class SimulatedBody {
 public:
  SimulatedBody() = default;
  SimulatedBody(const SimulatedBody&) = delete;  // force terms refer to the columns in place
  SimulatedBody& operator=(const SimulatedBody&) = delete;
  virtual ~SimulatedBody() = default;

  /// "tetrahedral 3-g-map", "3-g-map", "2-g-map"
  virtual std::string map_name() const = 0;
  virtual VertexColumns& vertices() = 0;
  const VertexColumns& vertices() const { return const_cast<SimulatedBody*>(this)->vertices(); }
  /// Springs and all that acts on vertices; valid until the next event.
  virtual SpringSystem system() const = 0;
  /// Positions and velocities; valid until the next event.
  Motion motion() { return {vertices().position, vertices().velocity}; }
  /// The pull at each vertex [m/s^2]; empty where the body was made without it. Valid until the next event.
  std::span<Eigen::Vector3d> pull() { return vertices().pull; }
  /// All of its forces but those of springs.
  const BodyForces& forces() const { return forces_; }
  /// The work of forces that have no energy, of parts too (BodyForce::work).
  virtual bool does_work() const { return forces_.do_work(); }
  virtual void begin_work(std::span<const Eigen::Vector3d> x) const { forces_.begin_work(x); }
  virtual double work(std::span<const Eigen::Vector3d> x, double h) const { return forces_.work(x, h); }
  /// The values of loads that a timeline sets, pressures that follow their faces [Pa] by number of force; empty
  /// without.
  std::span<double> loads() {
    BodyForce* const force = forces_.with_loads();
    return force == nullptr ? std::span<double>() : force->loads();
  }
  /// Its contact with obstacles, and that of its parts with each other: the last terms of its system, in this order.
  Contacts contacts() const { return forces_.contacts(); }
  /// The terms without those of contact.
  ForceTerms terms_but_contact(ForceTerms terms) const { return forces_.terms_but_contact(terms); }

  /// Follow a vertex from now on, whatever number it takes: `tracked` grows by one. Tracking does not change the body.
  virtual void track(std::uint32_t vertex) { tracked_.push_back(vertex); }
  /// The numbers now of the vertices tracked; `no_vertex` for those removed.
  std::span<const std::uint32_t> tracked() const { return tracked_; }
  static constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

  /// throws  InputError "/events/3/...: ..." if the event cannot happen to this body
  virtual std::unique_ptr<ReadyEvent> make_ready(const SceneEvent& event) = 0;

  /// The corners of some cells of the mesh, each as often as the body needs to list it; none of a cell that is removed.
  ///
  /// pre   the numbers ascend, and the body is not refined
  /// cost  O(cells log(numbers))
  virtual std::vector<std::vector<CellCorner>> corners_of(std::span<const std::uint32_t> mesh_cells) const = 0;

  /// Mass of all cells [kg], summed by their numbers.
  virtual double mass() const = 0;
  virtual double removed_mass() const = 0;
  virtual CellCounts counts() const = 0;
  /// [m^2] area of the faces with one volume; of a surface [m] length of the edges with one face.
  virtual double boundary() const = 0;
  /// [Pa] Largest principal stress of a vertex, of a chain [N] largest tension of a link or 0; infinite where one is
  /// not finite; 0 for an empty body.
  virtual double largest_stress() const = 0;
  /// pre  the body was made with rest positions if `fields` asks for displacement
  virtual Frame frame(const FrameFields& fields) const = 0;
  /// [m] Of each spring of an attachment, its vertex and the place that this is attached to.
  std::vector<std::array<Eigen::Vector3d, 2>> attachments() const;
  /// A hash of positions and velocities, in the order of the embeddings' numbers.
  std::uint64_t state_hash() const;
  /// The first condition of a generalized map that does not hold; empty for a valid one.
  virtual std::string violation() const = 0;
  /// Writes all that steps and events change, or reads it into a body made of the same scene.
  virtual void state(Archive& archive) {
    archive(tracked_);
    forces_.state(archive);
  }
  /// The memory that its parts take now.
  virtual MemoryReport memory() const = 0;

 protected:
  std::vector<std::uint32_t> tracked_;
  BodyForces forces_;
};

/// The system of a body whose vertices have these columns.
SpringSystem system_of(const VertexColumns& vertices, std::span<const SpringEnds> ends, SpringSpan springs,
                       const Eigen::Vector3d& gravity, ForceTerms terms);

/// A body that holds no more than the scene needs. If its topology can change: a body on the smallest map that can hold
/// it, a 2-g-map for a surface, tetrahedral storage for tetrahedra alone, otherwise a 3-g-map. If it cannot, or for a
/// chain: columns, and no map. A large body is stored along a curve where its mesh is in no good order
/// (core/mechanics/curve_order.h). Solids, surfaces and chains of one mesh are a body each, held together
/// (body_of_parts.h).
///
/// throws  InputError as build_body does
std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, const BodyNeeds& needs);
std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, bool topology_changes);

}  // namespace dartboard
