#pragma once
// A scene as a user writes it: plain structs, and the strict parser that fills them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/plain/material.h"
#include "core/scene/file/frame_fields.h"
#include "core/scene/file/selection.h"

namespace dartboard {

struct LoadedMesh;

inline constexpr double speed_of_light = 299792458.0;  // [m/s]

struct BoxMesh {
  std::array<int, 3> cells;
  double spacing;
  std::string kind;  // tetrahedra, hexahedra, mixed
  double jitter;
  std::uint64_t seed;
};
struct SheetMesh {
  std::array<int, 2> cells;
  double spacing;
  std::string kind;  // triangles, quadrilaterals
};
struct BallMesh {
  int layers;
  double radius;
};
/// Points and springs between neighbours; there are no cells.
struct ChainMesh {
  int links;
  double spacing;
};

/// The mesh of a body: a file or a generator, then scaled, then turned, then moved.
struct BodySource {
  std::variant<std::filesystem::path, BoxMesh, SheetMesh, BallMesh, ChainMesh> mesh;
  double scale;
  Eigen::Vector3d translate;
  bool split_touching = true;  // cells that touch without sharing a face: come apart there, or are refused
  Eigen::Matrix3d rotate = Eigen::Matrix3d::Identity();
  std::shared_ptr<const LoadedMesh> loaded{};  // what was read from the file, points that touch split (load_mesh)
};

/// v(x) = constant + linear (x - centre)
struct InitialVelocity {
  Eigen::Vector3d constant{0, 0, 0};
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre{0, 0, 0};

  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return constant + linear * (x - centre); }
};

/// Vertices that move at a velocity of their own, turning round every so often, and are held still at other times.
struct SceneDrive {
  VertexSelection vertices;
  InitialVelocity velocity;             // by place at rest
  double from;                          // [s]
  std::optional<double> until;          // [s] nothing: to the end
  std::optional<double> reverse_every;  // [s]
  std::string path;                     // "/driven/3"
};

// ---- events

struct Dissociate {
  // by the points around each; on a plane; or where a blade sweeps
  std::variant<std::vector<std::vector<std::uint32_t>>, PlaneSelection, BladeSweep> faces;
  std::optional<CutRegion> within{};  // of those on a plane, the faces with their centre there
};
struct Remove {
  CellSelection cells;
};
struct Tear {
  std::variant<std::uint32_t, Eigen::Vector3d> vertex;  // a point of the mesh; or the one nearest to a place
  Eigen::Vector3d direction;
};
struct TearWhereStressed {
  double threshold;                    // [Pa]
  std::optional<PlaneSelection> seam;  // through the body at rest
  std::optional<std::size_t> most_per_step;
};
struct Refine {
  CellSelection cells;
  bool at_centre;  // else in the longest edge
  double bracing;
};

/// Vertices held still are let go.
struct Release {
  VertexSelection vertices;  // by where they are at rest
};

using Action = std::variant<Dissociate, Remove, Tear, TearWhereStressed, Refine, Release>;
bool changes_topology(const Action& action);
/// "dissociate": the key that an event tells its action by.
std::string_view key_of(const Action& action);

/// What happens, and at which steps: an event that is due at n happens after n steps.
struct SceneEvent {
  Action action;
  double from, until;           // [s]; equal for an event that happens once
  std::optional<double> every;  // [s]; nothing: at every step
  std::string path;             // "/events/3"
};

/// What is done about a step that is too long to be stable.
enum class UnstableStep { warn, refuse, substep };

struct OutputPlan {
  std::optional<std::uint64_t> frame_steps{}, diagnostic_steps{}, probe_steps{};  // steps from one to the next
  std::optional<double> frame_time{}, diagnostic_time{}, probe_time{};  // [s] the same where the scene has no step yet
  std::optional<double> checkpoint_time{};                              // [s] from one to the next
  std::optional<std::uint64_t> checkpoint_steps{};
  FrameFields fields{};  // that frames hold

  /// The same plan with times turned into steps.
  /// pre  step > 0
  OutputPlan in_steps_of(double step) const;
};

/// A vertex whose motion is recorded: a point of the mesh, or the one nearest to a place at rest.
struct Probe {
  std::string name;
  std::variant<std::uint32_t, Eigen::Vector3d> vertex;
  std::string path;  // "/output/probes/3"
};

struct ExpectedPlace {
  std::size_t probe;  // its place in the list of probes
  Eigen::Vector3d position;
  double within;         // [m]
  bool of_part = false;  // the centre of mass of the component, not the vertex
  std::string why;       // where the numbers come from
};

struct Expectation {
  std::optional<std::uint64_t> vertices, edges, faces, cells, components, components_at_least, operations;
  std::optional<double> mass;                  // [kg]
  std::optional<double> kinetic_at_most;       // [J]
  std::optional<double> energy_drift_at_most;  // of the largest kinetic plus elastic energy
  std::vector<ExpectedPlace> places;
  std::optional<std::uint64_t> hash;
  std::string why;

  bool empty() const;
};

struct SceneFile {
  std::string file;  // as errors name it
  std::string name, about;
  BodySource body;
  Material material;
  Eigen::Vector3d gravity;
  InitialVelocity initial_velocity;
  std::vector<VertexSelection> fixed;
  std::vector<SceneDrive> driven;
  // exactly one of step and accuracy is given; before it is simulated, a scene that asks for an accuracy gets a step,
  // and an integrator where it names none
  double step = 0.0;               // [s]; 0 until then
  std::optional<double> accuracy;  // [mean edge lengths]
  double duration = 0.0;           // [s]
  std::string integrator;          // empty until then
  std::string solver;              // of linear systems; empty for the integrator's own
  UnstableStep unstable_step;
  bool exact_events = false;  // events happen at their times, not at the step boundaries after them
  std::vector<SceneEvent> events;
  OutputPlan output;
  std::vector<Probe> probes;
  Expectation expect;
  // what it was read from, for a run that is to be continued
  std::string text;
  std::filesystem::path folder;  // that its paths are relative to
  std::uint64_t added_seed = 0;  // by `reseed`

  bool has_elements() const { return material.model != Model::springs; }
  bool is_chain() const { return std::holds_alternative<ChainMesh>(body.mesh); }
};

/// A scene from a text; `name` stands for the file in errors, and paths are relative to `folder`.
///
/// throws  InputError "NAME: /path: ..." or "NAME:LINE:COLUMN: ..." for a scene that is wrong
SceneFile parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder);

/// The scene in a file. Its point numbers, counted from 0 in the order of the mesh file, become those of the body,
/// which has only the points of cells.
///
/// throws  IoError if the file cannot be read, InputError if it is wrong
SceneFile read_scene(const std::filesystem::path& path);

/// Let every random selection draw other cells: `seed` is added to its own. False where that changes none.
bool reseed(SceneFile& scene, std::uint64_t seed);

}  // namespace dartboard
