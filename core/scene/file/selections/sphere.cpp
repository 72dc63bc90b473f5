#include "core/scene/file/selections/selection.h"

#include <algorithm>

#include "core/places/border.h"
#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

SphereSelection SphereSelection::read(const SceneValue& value) {
  return {value.get<Eigen::Vector3d>("centre"), value.get<double>("radius")};
}

bool contains(const SphereSelection& sphere, const Eigen::Vector3d& x, double thickness) {
  const double size = std::max(x.lpNorm<Eigen::Infinity>(), sphere.centre.lpNorm<Eigen::Infinity>());
  return is_inside(sphere.radius - (x - sphere.centre).norm(), std::max(size, sphere.radius), thickness);
}

}  // namespace dartboard
