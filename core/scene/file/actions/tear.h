#pragma once
// The event that tears a fan of faces around one vertex.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace dartboard {

class SceneValue;

struct Tear {
  static constexpr std::string_view key = "tear";
  static constexpr bool changes_topology = true, dissociates = true;
  static Tear read(const SceneValue& value);

  std::variant<std::uint32_t, Eigen::Vector3d> vertex;  // a point of the mesh; or the one nearest to a place
  Eigen::Vector3d direction;

  template <class Self, class F>
  static void for_each_choice(Self& self, const std::string& path, F&& f) {
    if (auto* point = std::get_if<std::uint32_t>(&self.vertex)) f(path + "/vertex", *point);
  }
};

}  // namespace dartboard
