#pragma once
// The file that a run can be continued from: its scene, its state, and the extent of its output.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/archive.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

/// The name of that file in the folder of a run.
inline constexpr const char* checkpoint_name = "checkpoint";

/// A binary file of numbers as this processor stores them, after a word, an order of bytes and the number of this
/// format, and before a hash of all of it.
///
/// A run that goes on from it has the bits of a run without interruption, if the program is the same.
class Checkpoint {
 public:
  /// Write one, in place of the last at once. `notes` are the caller's own.
  ///
  /// pre     the scene is the one that the simulation was made of, as parse_scene and reseed left it, and with the step
  ///         and the integrator of the run
  /// throws  IoError if it cannot be written
  /// cost    the state is held in memory twice while it is written
  static void write(const std::filesystem::path& file, const SceneFile& scene, const Simulation& simulation,
                    const RunProgress& progress, const OutputSoFar& output, const std::string& notes = "");

  /// throws  IoError if it cannot be read, is of another kind or format, is cut short, or has been changed
  explicit Checkpoint(const std::filesystem::path& file);

  /// The scene as it was run, with a longer duration if that is the only change in its file.
  ///
  /// throws  InputError if the file of the scene has changed otherwise, or its mesh has changed; IoError if its mesh
  ///         cannot be read. A scene file that is gone is not needed
  SceneFile scene() const;
  std::uint64_t steps_done() const { return steps_done_; }
  const RunProgress& progress() const { return progress_; }
  const OutputSoFar& output() const { return output_; }
  const std::string& notes() const { return notes_; }

  /// Put a simulation of that scene into the state of the checkpoint; this can be done once only.
  ///
  /// pre     it has taken no step
  /// throws  IoError if it is not the state of such a simulation; then the simulation must not be used
  void load_into(Simulation& simulation);

 private:
  /// The origin of a scene, and what was done to it since.
  struct Origin {
    std::string file, folder, text, integrator;
    double step = 0.0;
    std::uint64_t added_seed = 0;
    std::uint64_t mesh_hash = 0;  // of a mesh from a file, else 0
    template <class SomeArchive>
    void state(SomeArchive& archive) {
      archive(file, folder, text, integrator, step, added_seed, mesh_hash);
    }
  };
  static std::uint64_t hash_of_mesh(const SceneFile& scene);
  /// The difference of a scene from that of the run.
  enum class Difference { none, longer_duration, other };
  Difference difference_of(const std::string& text) const;

  std::filesystem::path file_;
  std::unique_ptr<std::string> bytes_;  // `archive_` refers to them
  Archive archive_;
  Origin origin_;
  RunProgress progress_;
  OutputSoFar output_;
  std::string notes_;
  std::uint64_t steps_done_ = 0;
};

}  // namespace dartboard
