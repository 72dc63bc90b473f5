#pragma once
// A scene as a user writes it: plain structs, and the strict parser that fills them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/time_table.h"
#include "core/contact/contact_law.h"
#include "core/contact/obstacle.h"
#include "core/meshes/bytes/compressed_block.h"
#include "core/plain/diagonals.h"
#include "core/plain/material.h"
#include "core/scene/file/actions/action.h"
#include "core/scene/file/frame_fields.h"
#include "core/scene/file/selections/selection.h"

namespace dartboard {

struct LoadedMesh;

inline constexpr double speed_of_light = 299792458.0;  // [m/s]

struct BoxMesh {
  std::array<int, 3> cells;
  double spacing;
  std::string kind;  // tetrahedra, hexahedra, mixed
  double jitter;
  std::uint64_t seed;
  std::string pattern = "mirrored";  // of tetrahedra: mirrored, kuhn
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

/// The resistance of a surface to bending; at most one of the two is above 0.
struct Bending {
  double rigidity = 0.0;           // [N m] flexural rigidity of the sheet
  double second_neighbours = 0.0;  // [N/m] stiffness of Provot's springs between second neighbours

  bool any() const { return rigidity > 0.0 || second_neighbours > 0.0; }
};

/// v(x) = constant + linear (x - centre)
struct InitialVelocity {
  Eigen::Vector3d constant{0, 0, 0};
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre{0, 0, 0};

  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return constant + linear * (x - centre); }
};

struct BodySource;
/// Bodies side by side: their points and cells count on from one to the next.
struct BodyList {
  std::vector<BodySource> all;
};

/// The mesh of a body: a file or a generator, then scaled, then turned, then moved; or several bodies.
struct BodySource {
  std::variant<std::filesystem::path, BoxMesh, SheetMesh, BallMesh, ChainMesh, BodyList> mesh;
  double scale;
  Eigen::Vector3d translate;
  bool split_touching = true;  // cells that touch without sharing a face are split there; false: they are refused
  Eigen::Matrix3d rotate = Eigen::Matrix3d::Identity();
  std::shared_ptr<const LoadedMesh> loaded{};  // the mesh of the file, touching points split (load_mesh)
  // for one of several bodies; without a material it has that of the scene
  std::string path = "/body";
  std::optional<Material> material{};
  std::optional<InitialVelocity> velocity{};
  std::optional<double> weld{};  // [units of the file] points of the mesh file at most so far apart become one
};

/// Cells made of a material other than that of the body around them.
struct SceneRegion {
  CellSelection cells;
  Material material;
  std::string path;  // "/regions/3"
};

/// A turn about an axis through a place.
struct SceneTurn {
  Eigen::Vector3d axis;     // of length 1
  Eigen::Vector3d centre;   // [m]
  TimeTable<double> angle;  // [rad]
};

/// Vertices that move in a given way, and are held still at other times: at a velocity, which may be reversed at
/// intervals; along a path; or turned about an axis.
struct SceneDrive {
  VertexSelection vertices;
  InitialVelocity velocity;             // by rest position
  double from;                          // [s]
  std::optional<double> until;          // [s] no value: to the end
  std::optional<double> reverse_every;  // [s]
  std::string path;                     // "/driven/3"
  // in place of a velocity
  TimeTable<Eigen::Vector3d> way{};  // [m] of all of them, from the first place
  std::optional<SceneTurn> turn{};

  bool has_table() const { return !way.empty() || turn; }
  /// "/driven/3/path"
  std::string path_of_motion() const { return path + (turn ? "/turn" : way.empty() ? "/velocity" : "/path"); }
  /// [m/s] The mean velocity, from one time to another, of a vertex that is at x at rest.
  Eigen::Vector3d velocity_of(const Eigen::Vector3d& x, double begin, double end) const;
  /// [m/s] A bound of its speed at any time.
  double largest_speed_of(const Eigen::Vector3d& x) const;
};

/// What shares a force: vertices in proportion to their masses; faces of the boundary, or edges of the border of a
/// surface, in proportion to their sizes, and the corners of each as linear shape functions do.
enum class SharedBy { vertices, faces, edges };

/// Vertices that an external force pulls or pushes: in a constant direction, but for a pressure that follows its faces.
struct SceneForce {
  VertexSelection vertices;
  // exactly one of these two, a traction, an acceleration and a torque has a value
  std::optional<Eigen::Vector3d> force;  // [N] on all of them together
  std::optional<double> pressure;  // [Pa] on the faces of the boundary between them; of a surface, against normals
  double from;                     // [s]
  std::optional<double> until;     // [s] no value: to the end
  std::string path;                // "/forces/3"
  std::optional<Eigen::Vector3d> traction{};      // [Pa] on faces, [N/m] on edges
  SharedBy shared_by = SharedBy::vertices;        // a force, or a traction
  std::optional<Eigen::Vector3d> acceleration{};  // [m/s^2] of each
  std::optional<Eigen::Vector3d> torque{};        // [N m] about their centre of mass at rest
  TimeTable<double> factor{};                     // of any of these; empty: 1
  bool follows = false;                           // a pressure follows its faces as they move and turn

  /// Does the force act from the start to the end, and always alike?
  bool lasts() const { return from == 0.0 && !until && factor.empty() && !follows; }
  std::string_view kind() const {
    return force ? "force" : traction ? "traction" : pressure ? "pressure" : acceleration ? "acceleration" : "torque";
  }
};

/// Vertices that springs without length hold to points of the cells of a body, or to the places where they are at rest.
struct SceneAttachment {
  VertexSelection vertices;
  std::optional<std::uint32_t> to;  // the number of a body, counted from 0; no value: to fixed places
  double stiffness;                 // [N/m] of all springs together, shared in proportion to the masses of vertices
  std::string path;                 // "/attachments/3"
};

/// What resists the motion of every face along its normal.
struct Air {
  double drag = 0.0;                  // [N s/m^3] force per area and per relative speed
  Eigen::Vector3d velocity{0, 0, 0};  // [m/s]
};

/// An obstacle for the body, and the law of the contact with it.
struct SceneObstacle {
  Obstacle obstacle;
  ContactLaw law;
  std::string path;  // "/contact/obstacles/3"

  bool moves() const { return !obstacle.velocity.isZero(0.0); }
};

/// Two bodies that touch, or one that touches itself, and the law of that contact.
struct SceneTouch {
  std::uint32_t first = 0, second = 0;  // of the bodies, counted from 0; first <= second
  ContactLaw law;
  std::string path;  // of the key that gives it: "/contact/bodies", "/contact/pairs/3"
};

/// The treatment of a step that is too long to be stable.
enum class UnstableStep { warn, refuse, substep };

/// When a component that has come to rest is no longer stepped.
struct SceneSleep {
  double speed = 0.0;  // [m/s] no vertex is faster than this ...
  double time = 0.0;   // [s] ... for so long
};

struct OutputPlan {
  std::optional<std::uint64_t> frame_steps{}, diagnostic_steps{}, probe_steps{};  // steps from one to the next
  std::optional<double> frame_time{}, diagnostic_time{}, probe_time{};  // [s] the same where the scene has no step yet
  std::optional<double> checkpoint_time{};                              // [s] from one to the next
  std::optional<std::uint64_t> checkpoint_steps{};
  FrameFields fields{};                    // that frames hold
  std::optional<Compressor> compressor{};  // of the arrays in their files

  /// The plan with times turned into steps.
  /// pre  step > 0
  OutputPlan in_steps_of(double step) const;
};

/// A vertex whose motion is recorded: a point of the mesh, or the vertex nearest to a place at rest.
struct Probe {
  std::string name;
  std::variant<std::uint32_t, Eigen::Vector3d> vertex;
  std::string path;  // "/output/probes/3"
};

struct ExpectedPlace {
  std::size_t probe;  // its place in the list of probes
  Eigen::Vector3d position;
  double within;         // [m]
  bool of_part = false;  // true: the centre of mass of the vertex's component, not the vertex
  std::string why;       // the source of the numbers
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
  std::string file;  // its name in error messages
  std::string name, about;
  BodySource body;
  Material material;
  std::vector<SceneRegion> regions;        // cells of two regions belong to the later one
  std::vector<std::string> without_model;  // keys of the materials that name no model
  Diagonals diagonals = Diagonals::none;
  Bending bending;
  Eigen::Vector3d gravity;
  InitialVelocity initial_velocity;
  std::vector<HeldSelection> fixed;
  std::vector<SceneDrive> driven;
  std::vector<SceneForce> forces;
  std::vector<SceneAttachment> attachments;
  std::optional<Air> air;
  std::vector<SceneObstacle> obstacles;  // without any, and without touches, there is no contact
  std::vector<SceneTouch> touches;       // each pair once, in ascending order
  // exactly one of step and accuracy is given; before it is simulated, a scene that asks for an accuracy gets a step,
  // and an integrator if it does not name one
  double step = 0.0;               // [s]; 0 until then
  std::optional<double> accuracy;  // [mean edge lengths]
  double duration = 0.0;           // [s]
  std::string integrator;          // empty until then
  std::string solver;              // of linear systems; empty for the integrator's own
  UnstableStep unstable_step;
  bool exact_events = false;        // events happen at their times, not at the step boundaries after them
  std::optional<SceneSleep> sleep;  // no value: every component is stepped to the end
  std::vector<SceneEvent> events;
  OutputPlan output;
  std::vector<Probe> probes;
  Expectation expect;
  // the text it was read from, for a run that is to be continued
  std::string text;
  std::filesystem::path folder;  // its paths are relative to this
  std::uint64_t added_seed = 0;  // by `reseed`

  bool has_elements() const;  // in any tissue
  bool has_springs() const;   // in any tissue, or diagonals
  bool holds_axes() const;    // for some vertices some axes, but not all three
  bool has_times() const;     // at which an event happens, or a load begins, changes or ends
  bool has_contact() const { return !obstacles.empty() || !touches.empty(); }
  /// The key of springs or bending that no edge stands for, which references do not support; empty without them.
  std::string_view key_beside_edges() const {
    return diagonals != Diagonals::none ? "/diagonals" : bending.any() ? "/bending" : "";
  }
  /// Is every body a chain?
  bool is_chain() const;
  /// The one body, or each of several.
  std::span<const BodySource> bodies() const;
  /// A material that some cells may be made of, with its key.
  struct Tissue {
    Material material;
    std::string path;  // "/material", "/bodies/1/material", "/regions/0/material"
    bool names_model;
  };
  std::vector<Tissue> tissues() const;

  /// throws  InputError "FILE: PATH: found; expected ..."
  [[noreturn]] void fail(std::string_view path, std::string_view found, std::string_view expected) const;
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

/// Let every random selection draw other cells: `seed` is added to its own. False if there is no such selection.
bool reseed(SceneFile& scene, std::uint64_t seed);

}  // namespace dartboard
