#include "core/scene/file/keys/scene_value.h"

#include <fmt/format.h>

#include "core/plain/error.h"
#include "core/scene/file/keys/scene_check.h"

namespace dartboard {

SceneValue SceneValue::at(std::string_view key) const {
  return {json_->at(key), scene_, fmt::format("{}/{}", path_, key)};
}

std::vector<SceneValue> SceneValue::entries() const {
  std::vector<SceneValue> all;
  for (const Json& entry : *json_) all.emplace_back(entry, scene_, fmt::format("{}/{}", path_, all.size()));
  return all;
}

Eigen::Vector3d SceneValue::direction() const {
  auto d = as<Eigen::Vector3d>();
  const double largest = d.lpNorm<Eigen::Infinity>();
  if (largest == 0.0) fail("is " + shown(), "a direction, of a length other than 0");
  // the square of a length must not overflow, nor lose digits; others keep their bits
  if (largest > 1e150 || largest < 1e-140) d /= largest;
  return d / d.norm();
}

std::string SceneValue::shown() const { return dartboard::shown(*json_); }

void SceneValue::fail(std::string_view found, std::string_view expected) const {
  throw InputError(fmt::format("{}: {}: {}; expected {}", scene_, path_, found, expected));
}

void SceneValue::fail_at(std::string_view key, std::string_view found, std::string_view expected) const {
  throw InputError(fmt::format("{}: {}/{}: {}; expected {}", scene_, path_, key, found, expected));
}

}  // namespace dartboard
