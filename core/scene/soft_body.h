#pragma once
// A body for programs: made of a problem, moved step by step, and changed in between.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/forces/force_term.h"
#include "core/mechanics/vertex_columns.h"
#include "core/plain/problem.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/time/method/integrator.h"

namespace dartboard {

/// A solid, a surface or a chain, of springs or of elements, moved by one integrator and changed by the operations of
/// scenes. Contact, driven vertices, applied forces, attachments, bending and springs on diagonals need a scene
/// (recorded_run.h); the map itself and its embeddings are in core/mechanics/mass_spring_body.h.
///
/// A body has the bits that a `Simulation` of the same problem, operations and steps has.
class SoftBody {
 public:
  /// At rest in the mesh of the problem, with its initial velocities.
  ///
  /// throws  InputError as build_body does, and for the name of an integrator that is not in the table (integrators.h)
  explicit SoftBody(const Problem& problem, std::string_view integrator = "rk4");
  ~SoftBody();
  SoftBody(SoftBody&&) noexcept;
  SoftBody& operator=(SoftBody&&) noexcept;

  /// One step of h [s].
  ///
  /// throws  InputError unless h is above 0 and finite; SolverError with the diagnosis of the integrator: a position or
  ///         velocity that is not finite, an equation without a solution. The body must then not be moved any further
  void step(double h);
  double time() const { return time_; }  // [s] the sum of all steps

  /// Dissociate the facets between cells on different sides of a plane (section 3.2): faces of a solid, edges of a
  /// surface. Vertices whose cells come apart are duplicated; their masses and stiffnesses are shared out.
  ///
  /// returns the number of facets that came apart
  std::size_t dissociate(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
  /// Any operation of the events of a scene: `Dissociate`, `Remove`, `Tear`, `TearWhereStressed`, `Refine`, `Release`.
  ///
  /// returns the operations made: facets dissociated, cells removed, vertices put in or released
  /// throws  InputError for an operation that the body does not admit: "/dissociate/points/0: ..."
  std::size_t apply(const Action& action);

  /// Add a force of the program's own, such as a `PieceTerm` (core/forces/piece_term.h). Vertices have other numbers
  /// after an operation: `follow` is called then.
  void add(std::unique_ptr<ForceTerm> force, std::function<void(const VertexColumns&)> follow = {});
  /// The vertex that came from a point of the mesh; of several parts the first. No value once it is removed.
  std::optional<std::uint32_t> vertex_of(std::uint32_t point) const;

  /// Columns by vertex number: positions, velocities, masses, the point of the mesh that each vertex came from.
  const VertexColumns& vertices() const;
  /// Positions and velocities, to be changed by the program; `restart` has to follow. Valid until the next operation.
  Motion motion();
  /// Let the integrator forget what it keeps of earlier steps.
  void restart() { integrator_->restart(); }

  /// All that acts on the vertices, for the energies and momenta of core/time/system/energy.h. Valid until the next
  /// operation.
  SpringSystem system() const;
  /// Counts of cells, mass, boundary, stress, memory and the validity of the map.
  const SimulatedBody& body() const { return *body_; }

  /// Cells, vertices in the order of the mesh's points, and the fields asked for.
  Frame frame(const FrameFields& fields = {.stress = true}) const;
  /// Write such a frame as a .vtu file (write_vtu.h).
  ///
  /// throws  IoError if it cannot be written
  void write(const std::filesystem::path& file, const FrameFields& fields = {.stress = true}) const;

 private:
  struct Added {
    std::unique_ptr<ForceTerm> force;
    std::function<void(const VertexColumns&)> follow;
  };
  void list_forces();

  std::unique_ptr<SimulatedBody> body_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<Added> added_;
  std::vector<const ForceTerm*> forces_;  // of the body, then those added; empty where none is
  double time_ = 0.0;
};

}  // namespace dartboard
