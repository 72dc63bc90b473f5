#include "validation/scenes/contact_order.h"

#include <fmt/format.h>

#include <variant>

namespace dartboard {

ContactOrder contact_order(const SceneFile& file) {
  ContactOrder found;
  const auto limit = [&found](double order, std::string because) {
    if (order < found.most) found = {order, std::move(because)};
  };
  if (!file.touches.empty()) limit(0.0, "bodies, whose nearest face changes");
  for (const SceneObstacle& o : file.obstacles) {
    if (std::holds_alternative<Block>(o.obstacle.shape)) limit(0.0, "boxes, whose nearest face changes");
    const int p = o.law.exponent;
    limit(p, fmt::format("an energy of exponent {}", p));
    if (o.law.restitution < 1.0) limit(0.5 * p, fmt::format("speed that is lost, with exponent {}", p));
    if (o.moves()) limit(2.0, "obstacles that move");
    if (o.law.friction > 0.0) limit(1.0, "friction");
  }
  return found;
}

ContactOrder contact_order(const TradeoffScene& scene) {
  return scene.frozen ? contact_order(scene.frozen->file) : ContactOrder{};
}

}  // namespace dartboard
