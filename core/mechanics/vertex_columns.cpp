#include "core/mechanics/vertex_columns.h"

#include <algorithm>

namespace dartboard {

void VertexColumns::hold(std::span<const HeldPoint> points) {
  held_axes.clear();
  if (points.empty()) return;
  held_axes.assign(size(), 0);
  for (std::size_t k = 0; k < size(); ++k) {
    const auto held = std::ranges::lower_bound(points, point[k], {}, &HeldPoint::point);
    if (held == points.end() || held->point != point[k]) continue;
    held_axes[k] = held->axes;
    velocity[k] = free_part(held->axes, velocity[k]);
  }
}

}  // namespace dartboard
