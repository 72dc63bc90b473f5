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
    : PicturesOfRun(std::move(steps)), fields_(BodyFacets::fields(look)), facets_(look, simulation.frame(fields_)) {
  begin(picture_of(simulation));
}

Look look_of(const SceneFile& scene, ColourBy colour, const Eigen::Vector3d& from) {
  Look look{.view = PictureView(-scene.gravity, from), .colour = colour};
  for (const SceneObstacle& one : scene.obstacles) look.obstacles.push_back(one.obstacle);
  return look;
}

}  // namespace dartboard
