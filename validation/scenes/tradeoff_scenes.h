#pragma once
// The scenes in which the trade between speed and accuracy is measured.

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/ode_codes.h"
#include "validation/frozen/frozen_scene.h"
#include "validation/scenes/table_scene.h"

namespace dartboard {

/// A scene that is ready to be run many times: a frozen scene, of a file or of the table, or point masses and springs
/// alone.
struct TradeoffScene {
  std::string name, what;
  std::shared_ptr<const FrozenScene> frozen{};                // without one, motion.network moves
  reference::NetworkMotion motion;                            // for references
  std::string beyond_references{};                            // "membranes": `motion` has only the masses of these
  std::function<std::vector<PointState>()> closed_form = {};  // the exact states at the checkpoints, where known
  double duration = 1.0;                                      // [s]
  double fastest_rate = 0.0;                                  // [1/s] reference::fastest_rate, the largest over time
  double edge = 1.0;                                          // [m] mean rest length at the start
  std::vector<std::string> omissions = {};                    // what the scene leaves out, in plain sentences

  bool has_contact() const { return frozen && frozen->file.has_contact(); }
  /// What makes runs take equal steps, from the start to the end: "contact requires equal steps"; empty where nothing
  /// does.
  std::string_view equal_steps() const;
};

/// Can the integrator move the scene? Contact between bodies has kinks, through which energy-momentum has no forces.
bool takes(const TradeoffScene& scene, std::string_view integrator);

struct TradeoffEntry {
  std::string_view name;
  std::string_view what;
};

/// The table of scenes, in the order of the study.
std::span<const TradeoffEntry> tradeoff_scenes();

/// Build one of them; `meshes` is the folder of liver564.mesh.
///
/// throws  InputError for a name that is not in the table, naming those that are; IoError if the mesh cannot be read
TradeoffScene make_tradeoff_scene(std::string_view name, const std::filesystem::path& meshes);

/// The motion of a frozen scene, with its file's name and its sentence about the scene.
TradeoffScene tradeoff_scene(FrozenScene frozen, std::size_t checkpoints);
/// The motion of a scene made by a program.
///
/// throws  as freeze
TradeoffScene tradeoff_scene(std::string what, const TableScene& scene);

/// `count` equal masses on a line between two walls, moving along it in several modes at once; the motion is linear and
/// known exactly.
///
/// `phase` is the duration in units of 1/omega_max.
TradeoffScene chain_scene(int count, double phase, std::size_t checkpoints = 8);

struct StiffSceneOptions {
  bool damped = false;  // with a damping ratio of 1 at omega_max
  double phase = 26.4;  // the duration, in units of 1/omega_max of the soft body
  std::size_t checkpoints = 8;
};
/// A body in soft motion. The tenth of its cells nearest to the middle is stiffer by a factor and starts at rest.
TradeoffScene stiff_scene(std::string what, Mesh mesh, double factor, const StiffSceneOptions& options);

}  // namespace dartboard
