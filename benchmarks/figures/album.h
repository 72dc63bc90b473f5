#pragma once
// The few pictures of a run that are kept.

#include <cstdint>
#include <vector>

#include "benchmarks/figures/body_picture.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

/// The body at the start, after one and two thirds of the run, and at its end.
class Album : public RunWatcher {
 public:
  Album(const Simulation& simulation, std::uint64_t steps) : steps_(steps) { take(simulation); }

  void stepped(const Simulation& simulation) override {
    const std::uint64_t n = simulation.steps_done();
    if (n == steps_ / 3 || n == 2 * steps_ / 3 || n == steps_) take(simulation);
  }
  /// The last good state of a run that ended before its time, and none after it.
  void ended(const Simulation& simulation) {
    while (panels_.size() > 1 && panels_.back().time > simulation.time()) panels_.pop_back();
    if (panels_.back().time < simulation.time()) take(simulation);
  }
  const std::vector<Frame>& panels() const { return panels_; }

 private:
  void take(const Simulation& simulation) { panels_.push_back(simulation.frame({})); }
  std::uint64_t steps_;
  std::vector<Frame> panels_;
};

}  // namespace dartboard
