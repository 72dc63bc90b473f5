#pragma once
// A run as pictures show it.

#include <cstdint>
#include <vector>

#include "benchmarks/figures/body_facets.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

/// The start of a run of so many steps, and of its evenly spaced times, so many of them, the first steps after each.
std::vector<std::uint64_t> even_steps(std::uint64_t steps, std::uint64_t pictures);

/// The bodies as they are seen after some steps; what is inside is not kept.
class Album : public RunWatcher {
 public:
  /// pre  the steps ascend
  Album(const Simulation& simulation, std::vector<std::uint64_t> steps, const Look& look);

  void stepped(const Simulation& simulation) override;
  /// The last good state of a run that ended before its time, and none after it.
  void ended(const Simulation& simulation);
  const std::vector<BodyPanel>& panels() const { return panels_; }

 private:
  Frame frame_of(const Simulation& simulation) const { return simulation.frame(fields_); }
  void take(const Simulation& simulation) { panels_.push_back(facets_.of(frame_of(simulation))); }

  std::vector<std::uint64_t> steps_;
  std::size_t next_ = 0;  // of them
  FrameFields fields_;
  BodyFacets facets_;
  std::vector<BodyPanel> panels_;
};

/// Of a scene, so that what its gravity pulls down is below.
Look look_of(const SceneFile& scene, ColourBy colour = ColourBy::component,
             const Eigen::Vector3d& from = Eigen::Vector3d::Zero());

}  // namespace dartboard
