#include "core/scene/file/selections/selection.h"

#include "core/places/border.h"
#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

PlaneSelection PlaneSelection::read(const SceneValue& value) {
  return {value.get<Eigen::Vector3d>("point"), value.at("normal").direction()};
}

bool contains(const PlaneSelection& plane, const Eigen::Vector3d& x, double thickness) {
  return is_in_front(x, plane.point, plane.normal, thickness);
}

}  // namespace dartboard
