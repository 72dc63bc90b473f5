#pragma once
// A value of a scene that has been checked against the table of keys, with its path for errors.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace dartboard {

/// Its types are right and its defaults are filled in. It refers to the JSON and to the name of the scene.
class SceneValue {
 public:
  using Json = nlohmann::ordered_json;
  SceneValue(const Json& json, std::string_view scene, std::string path = "")
      : json_(&json), scene_(scene), path_(std::move(path)) {}

  /// "/events/3"; empty for the scene.
  const std::string& path() const { return path_; }
  const Json& json() const { return *json_; }
  bool has(std::string_view key) const { return json_->contains(key); }
  /// pre  it has the key
  SceneValue at(std::string_view key) const;
  /// The entries of a list.
  std::vector<SceneValue> entries() const;

  /// Eigen::Vector3d from a list of three numbers, vectors of them from a list of such lists.
  template <class T>
  T as() const {
    if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
      return {(*json_)[0].get<double>(), (*json_)[1].get<double>(), (*json_)[2].get<double>()};
    } else if constexpr (std::is_same_v<T, std::vector<Eigen::Vector3d>>) {
      std::vector<Eigen::Vector3d> points;
      for (const Json& point : *json_) points.push_back(SceneValue(point, scene_).as<Eigen::Vector3d>());
      return points;
    } else {
      return json_->get<T>();
    }
  }
  template <class T>
  T get(std::string_view key) const {
    return SceneValue(json_->at(key), scene_).as<T>();
  }
  template <class T>
  std::optional<T> find(std::string_view key) const {
    return has(key) ? std::optional<T>(get<T>(key)) : std::nullopt;
  }
  /// The enumerator with the place that the word has among `names`.
  template <class Enum>
  Enum one_of(const auto& names) const {
    return static_cast<Enum>(std::ranges::find(names, as<std::string>()) - names.begin());
  }
  /// The direction with length 1, whatever its length in the file.
  /// throws  InputError for a length of 0
  Eigen::Vector3d direction() const;

  /// On one line, shortened when long.
  std::string shown() const;
  /// throws  InputError "SCENE: PATH: found; expected ...", here or at one of its keys
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const;
  [[noreturn]] void fail_at(std::string_view key, std::string_view found, std::string_view expected) const;

 private:
  const Json* json_;
  std::string_view scene_;
  std::string path_;
};

/// The alternative of a variant whose `key` the object has, made by its `read`; no value if it has none of their keys.
/// Alternatives that depend on `more` are read with it.
template <class Variant, std::size_t first = 0, class... More>
std::optional<Variant> read_one_of(const SceneValue& object, const More&... more) {
  if constexpr (first == std::variant_size_v<Variant>) {
    return std::nullopt;
  } else {
    using Kind = std::variant_alternative_t<first, Variant>;
    if (!object.has(Kind::key)) return read_one_of<Variant, first + 1>(object, more...);
    if constexpr (requires { Kind::read(object, more...); })
      return Kind::read(object.at(Kind::key), more...);
    else
      return Kind::read(object.at(Kind::key));
  }
}

}  // namespace dartboard
