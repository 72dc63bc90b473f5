#include "benchmarks/figures/album.h"

#include <algorithm>
#include <utility>

namespace dartboard {

std::vector<std::uint64_t> even_steps(std::uint64_t steps, std::uint64_t pictures) {
  std::vector<std::uint64_t> all{0};
  pictures = std::min(steps, pictures);
  for (std::uint64_t k = 1; k <= pictures; ++k) all.push_back((k * steps + pictures - 1) / pictures);
  return all;
}

Album::Album(const Simulation& simulation, std::vector<std::uint64_t> steps, const Look& look)
    : steps_(std::move(steps)), fields_(BodyFacets::fields(look)), facets_(look, frame_of(simulation)) {
  take(simulation);  // by which colours of later ones are chosen
  if (steps_.empty() || steps_[0] > 0) panels_.clear();
}

void Album::stepped(const Simulation& simulation) {
  const std::uint64_t n = simulation.steps_done();
  while (next_ < steps_.size() && steps_[next_] < n) ++next_;
  if (next_ < steps_.size() && steps_[next_] == n) take(simulation);
}

void Album::ended(const Simulation& simulation) {
  while (panels_.size() > 1 && panels_.back().time > simulation.time()) panels_.pop_back();
  const bool is_early = !steps_.empty() && simulation.steps_done() < steps_.back();
  if (panels_.empty() || (is_early && panels_.back().time < simulation.time())) take(simulation);
}

Look look_of(const SceneFile& scene, ColourBy colour, const Eigen::Vector3d& from) {
  Look look{.view = PictureView(-scene.gravity, from), .colour = colour};
  for (const SceneObstacle& one : scene.obstacles) look.obstacles.push_back(one.obstacle);
  return look;
}

}  // namespace dartboard
