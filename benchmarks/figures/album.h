#pragma once
// A run as pictures show it.

#include <cstdint>
#include <utility>
#include <vector>

#include "benchmarks/figures/body_facets.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

/// The start of a run of so many steps, and of its evenly spaced times, so many of them, the first steps after each.
std::vector<std::uint64_t> even_steps(std::uint64_t steps, std::uint64_t pictures);

/// A run after some steps, as pictures that have a `time` [s].
template <class Picture>
class PicturesOfRun : public RunWatcher {
 public:
  void stepped(const Simulation& simulation) override {
    const std::uint64_t n = simulation.steps_done();
    while (next_ < steps_.size() && steps_[next_] < n) ++next_;
    if (next_ < steps_.size() && steps_[next_] == n) pictures_.push_back(picture_of(simulation));
  }
  /// The last good state of a run that ended before its time, and none after it.
  void ended(const Simulation& simulation) {
    while (pictures_.size() > 1 && pictures_.back().time > simulation.time()) pictures_.pop_back();
    const bool is_early = !steps_.empty() && simulation.steps_done() < steps_.back();
    if (pictures_.empty() || (is_early && pictures_.back().time < simulation.time()))
      pictures_.push_back(picture_of(simulation));
  }
  const std::vector<Picture>& pictures() const { return pictures_; }

 protected:
  /// pre  the steps ascend
  explicit PicturesOfRun(std::vector<std::uint64_t> steps) : steps_(std::move(steps)) {}
  /// Called once at the start, by which colours of later pictures are chosen, and kept if it is asked for.
  void begin(Picture first) {
    if (!steps_.empty() && steps_[0] == 0) pictures_.push_back(std::move(first));
  }
  virtual Picture picture_of(const Simulation& simulation) = 0;

 private:
  std::vector<std::uint64_t> steps_;
  std::size_t next_ = 0;  // of them
  std::vector<Picture> pictures_;
};

/// The bodies as they are seen after some steps; what is inside is not kept.
class Album : public PicturesOfRun<BodyPanel> {
 public:
  /// pre  the steps ascend
  Album(const Simulation& simulation, std::vector<std::uint64_t> steps, const Look& look);

 private:
  BodyPanel picture_of(const Simulation& simulation) override { return facets_.of(simulation.frame(fields_)); }

  FrameFields fields_;
  BodyFacets facets_;
};

/// Of a scene, so that what its gravity pulls down is below.
Look look_of(const SceneFile& scene, ColourBy colour = ColourBy::component,
             const Eigen::Vector3d& from = Eigen::Vector3d::Zero());

}  // namespace dartboard
