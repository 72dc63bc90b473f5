#include "benchmarks/figures/album.h"

#include <algorithm>

namespace dartboard {

Album::Album(const Simulation& simulation, std::uint64_t steps, std::uint64_t pictures, const Look& look)
    : steps_(steps),
      pictures_(std::min(steps, pictures)),
      fields_(BodyFacets::fields(look)),
      facets_(look, frame_of(simulation)) {
  take(simulation);
}

void Album::stepped(const Simulation& simulation) {
  const std::uint64_t n = simulation.steps_done();
  if (n * pictures_ / steps_ > (n - 1) * pictures_ / steps_) take(simulation);
}

void Album::ended(const Simulation& simulation) {
  while (panels_.size() > 1 && panels_.back().time > simulation.time()) panels_.pop_back();
  if (panels_.back().time < simulation.time()) take(simulation);
}

Look look_of(const SceneFile& scene, ColourBy colour) {
  Look look{.up = -scene.gravity, .colour = colour};
  for (const SceneObstacle& one : scene.obstacles) look.obstacles.push_back(one.obstacle);
  return look;
}

}  // namespace dartboard
