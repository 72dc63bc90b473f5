#include "core/scene/file/selections/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/places/border.h"
#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

BoxSelection BoxSelection::read(const SceneValue& value) {
  BoxSelection box{value.get<Eigen::Vector3d>("min"), value.get<Eigen::Vector3d>("max")};
  for (int k = 0; k < 3; ++k)
    if (box.min[k] > box.max[k])
      value.fail(fmt::format("has a min[{}] of {} and a max[{}] of {}", k, box.min[k], k, box.max[k]),
                 "no min above its max");
  return box;
}

bool contains(const BoxSelection& box, const Eigen::Vector3d& x, double thickness) {
  for (int k = 0; k < 3; ++k) {
    const auto is_beyond = [&](double distance, double border) {
      return !is_inside(distance, std::max(std::abs(x[k]), std::abs(border)), thickness);
    };
    if (is_beyond(x[k] - box.min[k], box.min[k]) || is_beyond(box.max[k] - x[k], box.max[k])) return false;
  }
  return true;
}

}  // namespace dartboard
