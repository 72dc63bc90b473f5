#include "core/scene/body/make_contact.h"

#include <algorithm>

namespace dartboard {

std::unique_ptr<ObstacleContact> make_contact(const std::vector<SceneObstacle>& obstacles,
                                              const std::vector<SkinSample>& samples) {
  std::vector<ContactLaw> laws;
  std::vector<Obstacle> shapes;
  laws.reserve(obstacles.size());
  shapes.reserve(obstacles.size());
  for (const SceneObstacle& one : obstacles) {
    laws.push_back(one.law);
    shapes.push_back(one.obstacle);
  }
  return std::make_unique<ObstacleContact>(std::move(laws), std::move(shapes), samples);
}

std::uint32_t body_of_cell(std::span<const std::size_t> first_cell, std::size_t cell) {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(first_cell, cell) - first_cell.begin() - 1);
}

}  // namespace dartboard
