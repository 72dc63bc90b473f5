#pragma once
// The keys of a scene as its file has them, each with its row of the table.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/scene/file/keys/scene_keys.h"

namespace dartboard {

/// f(key, value, path) for each key of an object that is there, and of the objects in it: parents first. f may change
/// the value.
///
/// pre  the scene is valid
template <class F>
void for_each_key(nlohmann::ordered_json& object, Shape shape, const std::string& path, const F& f) {
  for (auto& [name, value] : object.items()) {
    const SceneKey& key = *find_key(shape, name);
    const std::string here = fmt::format("{}/{}", path, name);
    f(key, value, here);
    if (key.type == ValueType::objects)
      for (std::size_t k = 0; k < value.size(); ++k) for_each_key(value[k], key.of, fmt::format("{}/{}", here, k), f);
    else if (value.is_object())
      for_each_key(value, key.of, here, f);
  }
}

/// Is there a key of this name somewhere in the scene?
bool has_key(const nlohmann::ordered_json& scene, std::string_view name);

/// The exponents of a unit in the table of keys.
struct Dimensions {
  int length = 0, time = 0, mass = 0;

  friend bool operator==(const Dimensions&, const Dimensions&) = default;
};
/// Those of "N s/m": {0, -1, 1}. None for what counts in other things: "mean edge lengths", "".
///
/// throws  InputError for a unit that it does not know
Dimensions dimensions_of(std::string_view unit);

/// The scene with every standard value of a dimension that is not 0 written out: gravity, density and the like.
nlohmann::ordered_json with_standards(nlohmann::ordered_json scene);

}  // namespace dartboard
