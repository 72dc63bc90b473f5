#include "validation/drawn/scene_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

bool has_number(const Json& value) {
  if (value.is_array()) return std::ranges::any_of(value, has_number);
  return value.is_number() && value.get<double>() != 0.0;
}

/// May the object have this key beside those that it has?
bool may_have(const Json& object, const SceneKey& key) {
  return std::ranges::none_of(scene_rules(), [&](const SceneRule& rule) {
    const bool is_in_it = rule.shape == key.shape && std::ranges::find(rule.keys, key.name) != rule.keys.end();
    return is_in_it &&
           std::ranges::any_of(rule.keys, [&](std::string_view other) { return object.contains(std::string(other)); });
  });
}

void write_standards(Json& object, Shape shape) {
  for (const SceneKey& key : scene_keys()) {
    if (key.shape != shape || key.unit.empty() || key.standard.empty() || object.contains(std::string(key.name)))
      continue;
    const Json standard = Json::parse(key.standard);
    if (has_number(standard) && may_have(object, key)) object[std::string(key.name)] = standard;
  }
}

}  // namespace

bool has_key(const Json& scene, std::string_view name) {
  bool has = false;
  Json copy = scene;
  for_each_key(copy, Shape::scene, "",
               [&](const SceneKey& key, Json&, const std::string&) { has = has || key.name == name; });
  return has;
}

Dimensions dimensions_of(std::string_view unit) {
  static const std::map<std::string_view, Dimensions> units{{"m", {1, 0, 0}},  {"s", {0, 1, 0}},  {"kg", {0, 0, 1}},
                                                            {"N", {1, -2, 1}}, {"1", {}},         {"Pa", {-1, -2, 1}},
                                                            {"J", {2, -2, 1}}, {"Hz", {0, -1, 0}}};
  Dimensions all;
  if (unit.empty() || unit == "mean edge lengths") return all;
  int sign = 1;
  for (std::size_t at = 0; at < unit.size();) {
    const std::size_t end = std::min(unit.find_first_of(" /", at), unit.size());
    std::string_view factor = unit.substr(at, end - at);
    int power = sign;
    if (const std::size_t hat = factor.find('^'); hat != std::string_view::npos) {
      power *= factor[hat + 1] - '0';
      factor = factor.substr(0, hat);
    }
    const auto found = units.find(factor);
    if (found == units.end()) throw InputError(fmt::format("'{}' in '{}' is no unit that is known", factor, unit));
    all.length += power * found->second.length;
    all.time += power * found->second.time;
    all.mass += power * found->second.mass;
    if (end < unit.size() && unit[end] == '/') sign = -1;
    at = end + 1;
  }
  return all;
}

Json with_standards(Json scene) {
  if (!scene.contains("material")) scene["material"] = Json::object();
  write_standards(scene, Shape::scene);
  for_each_key(scene, Shape::scene, "", [](const SceneKey& key, Json& value, const std::string&) {
    if (key.type == ValueType::objects)
      for (Json& one : value) write_standards(one, key.of);
    else if (value.is_object())
      write_standards(value, key.of);
  });
  return scene;
}

}  // namespace dartboard
