#include "validation/drawn/value_pairs.h"

#include <fmt/format.h>

#include "validation/drawn/scene_walk.h"

namespace dartboard {

std::set<std::string> values_of(const nlohmann::ordered_json& scene) {
  nlohmann::ordered_json copy = scene;
  std::set<std::string> values;
  for_each_key(copy, Shape::scene, "", [&](const SceneKey& key, nlohmann::ordered_json& value, const std::string&) {
    const std::string name = fmt::format("{}.{}", help_of(key.shape).name, key.name);
    if (key.type == ValueType::choice)
      values.insert(name + "=" + value.get<std::string>());
    else if (key.type == ValueType::choices)
      for (const auto& word : value) values.insert(name + "=" + word.get<std::string>());
    else if (!key.required)
      values.insert(name);
  });
  return values;
}

void ValuePairs::add(const std::set<std::string>& values) {
  values_.insert(values.begin(), values.end());
  for (auto a = values.begin(); a != values.end(); ++a)
    for (auto b = values.begin(); b != a; ++b) pairs_.insert({*b, *a});
}

}  // namespace dartboard
