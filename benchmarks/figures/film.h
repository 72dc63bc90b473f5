#pragma once
// A run as a moving picture: an animated GIF, drawn by gnuplot.

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/figures/body_picture.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

/// The visible facets of a body at one time.
struct FilmFrame {
  double time = 0.0;  // [s]
  std::vector<DrawnFacet> facets;
  Eigen::AlignedBox2d box;
};

/// A run as it is seen at its start and at evenly spaced times to its end; the inside of the body is not kept.
class Film : public RunWatcher {
 public:
  static constexpr std::uint64_t most_frames = 120;

  /// `up` is the direction that is shown upwards, as in `upright`.
  Film(const Simulation& simulation, std::uint64_t steps, const Eigen::Vector3d& up);

  void stepped(const Simulation& simulation) override;
  /// The last good state of a run that ended before its time, and none after it.
  void ended(const Simulation& simulation);
  const std::vector<FilmFrame>& frames() const { return frames_; }

 private:
  Frame panel_of(const Simulation& simulation) const;
  void take(const Simulation& simulation);

  std::uint64_t steps_;
  Eigen::Vector3d up_;
  Frame first_;
  std::vector<FilmFrame> frames_;
};

/// Draw frames one after the other at one scale, each with its time; writes `name`.gif with its data and its
/// script.
///
/// The film is as fast as the motion, except for motions of less than 4 or more than 12 seconds. Where the body moves
/// far beyond its size, the picture follows it.
/// returns what went wrong, as `draw` does
/// throws  IoError when the files cannot be written
std::string draw_film(std::span<const FilmFrame> frames, const std::string& title, const std::filesystem::path& folder,
                      const std::string& name, const std::string& gnuplot = "gnuplot");

}  // namespace dartboard
