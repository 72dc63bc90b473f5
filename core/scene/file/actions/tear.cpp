#include "core/scene/file/actions/tear.h"

#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

Tear Tear::read(const SceneValue& value) {
  const Eigen::Vector3d toward = value.at("direction").direction();
  if (const auto point = value.find<std::uint32_t>("vertex")) return {*point, toward};
  return {value.get<Eigen::Vector3d>("near"), toward};
}

}  // namespace dartboard
