#include "validation/scenes/order_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace dartboard {

OrderLimit order_limit(const SceneFile& file) {
  OrderLimit found;
  const auto limit = [&found](double order, std::string because) {
    if (!(order < found.most)) return;
    found.most = order;
    found.because = std::move(because);
  };
  if (changes_in_every_step(file)) limit(2.0, "loads that change in time");
  // driven vertices are where they should be at the end of each step, for every method
  found.late_loads = std::ranges::any_of(file.forces, [](const SceneForce& force) { return !force.factor.empty(); });
  if (!file.touches.empty()) limit(0.0, "bodies, whose nearest face changes");
  for (const SceneObstacle& o : file.obstacles) {
    if (std::holds_alternative<Block>(o.obstacle.shape)) limit(0.0, "boxes, whose nearest face changes");
    const int p = o.law.exponent;
    limit(p, fmt::format("an energy of exponent {}", p));
    if (o.law.restitution < 1.0) limit(2.0, "speed that is lost");
    if (o.moves()) limit(2.0, "obstacles that move");
    if (o.law.friction > 0.0) limit(1.0, "friction");
  }
  return found;
}

OrderLimit order_limit(const TradeoffScene& scene) {
  return scene.frozen ? order_limit(scene.frozen->file) : OrderLimit{};
}

}  // namespace dartboard
