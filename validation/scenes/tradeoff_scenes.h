#pragma once
// The scenes in which the trade between speed and accuracy is measured.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/frozen/frozen_scene.h"
#include "validation/scenes/spring_scene.h"

namespace dartboard {

/// A scene that is ready to be run many times: a scene file, a body of the table on its map, or point masses and
/// springs alone. A scene file cannot state the closed form of a scene of the table.
struct TradeoffScene {
  std::string name, what;
  std::shared_ptr<const FrozenScene> frozen{};                // of a scene file (scene_of_file.h)
  std::optional<PreparedScene> body{};                        // without both, motion.network moves
  reference::NetworkMotion motion;                            // for references; that of the body where there is one
  std::string beyond_references{};                            // "membranes": `motion` has only the masses of these
  std::function<std::vector<PointState>()> closed_form = {};  // the exact states at the checkpoints, where known
  double duration = 1.0;                                      // [s]
  double fastest_rate = 0.0;                                  // [1/s] reference::fastest_rate, the largest over time
  double edge = 1.0;                                          // [m] mean rest length at the start
  std::vector<std::string> omissions = {};                    // what the scene leaves out, in plain sentences

  bool has_contact() const { return frozen && frozen->file.has_contact(); }
};

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

/// A scene of a body that is not in the table.
TradeoffScene tradeoff_scene(std::string what, const SpringScene& scene);

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

/// Multiply what some cells contribute to the stiffness and damping of their edges, in the body and in its network.
///
/// The network's numbers come from the cells of the mesh, the body's from its own sum over the darts around an edge.
/// pre     the scene has no events, and `stiff` has one entry per cell of the mesh
/// throws  InputError otherwise
void stiffen(PreparedScene& scene, const Mesh& mesh, std::span<const std::uint8_t> stiff, double factor);

}  // namespace dartboard
