#pragma once
// A run as pictures show it, at evenly spaced times.

#include <cstdint>
#include <vector>

#include "benchmarks/figures/body_facets.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

/// The bodies as they are seen at the start and at some evenly spaced times to the end; what is inside is not kept.
class Album : public RunWatcher {
 public:
  /// `pictures` after the first, or one of each step if there are fewer.
  Album(const Simulation& simulation, std::uint64_t steps, std::uint64_t pictures, const Look& look);

  void stepped(const Simulation& simulation) override;
  /// The last good state of a run that ended before its time, and none after it.
  void ended(const Simulation& simulation);
  const std::vector<BodyPanel>& panels() const { return panels_; }

 private:
  Frame frame_of(const Simulation& simulation) const { return simulation.frame(fields_); }
  void take(const Simulation& simulation) { panels_.push_back(facets_.of(frame_of(simulation))); }

  std::uint64_t steps_, pictures_;
  FrameFields fields_;
  BodyFacets facets_;
  std::vector<BodyPanel> panels_;
};

/// Of a scene, so that what its gravity pulls down is below.
Look look_of(const SceneFile& scene, ColourBy colour = ColourBy::component);

}  // namespace dartboard
