#include "validation/drawn/broken_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "core/scene/run/simulation.h"
#include "validation/drawn/scene_walk.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

/// The first number of a value, which may be a list of lists of them; null without one.
Json* first_number(Json& value) {
  if (value.is_number()) return &value;
  if (!value.is_array() || value.empty()) return nullptr;
  return first_number(value[0]);
}

struct Place {
  const SceneKey* key;
  std::string path;
};

}  // namespace

BrokenScene broken_scene(Json scene, Draw& draw) {
  std::vector<Place> places;
  for_each_key(scene, Shape::scene, "", [&places](const SceneKey& key, Json&, const std::string& path) {
    places.push_back({&key, path});
  });
  for (;;) {
    const auto& [key, path] = places[draw.below(places.size())];
    const Json::json_pointer at(path);
    Json& value = scene.at(at);
    Json& parent = scene.at(at.parent_pointer());
    switch (draw.below(4)) {
      case 0: {
        const std::string name = at.back() + "_x";
        parent[name] = value;
        return {scene, (at.parent_pointer() / name).to_string(), "an unknown key"};
      }
      case 1: {
        const bool is_text = value.is_string();
        value = is_text ? Json(17) : Json("seventeen");
        return {scene, path, "another type"};
      }
      case 2: {
        Json* const number = first_number(value);
        if (number == nullptr || !std::isfinite(key->range.least)) break;
        *number = key->range.above ? key->range.least : key->range.least - 1.0;
        return {scene, path, "a number out of range"};
      }
      default:
        if (!key->required) break;
        parent.erase(at.back());
        return {scene, path, "nothing where a key is required"};
    }
  }
}

std::optional<std::string> wrong_refusal(const BrokenScene& broken) {
  try {
    (void)Simulation(parse_scene(broken.json.dump(), "scene", ""));
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.starts_with("scene: " + broken.path) && text.find('\n') == std::string::npos) return std::nullopt;
    return fmt::format("{} in {} is refused by \"{}\"", broken.fault, broken.path, text);
  } catch (const std::exception& error) {
    return fmt::format("{} in {} ends by \"{}\"", broken.fault, broken.path, error.what());
  }
  return fmt::format("{} in {} is taken", broken.fault, broken.path);
}

}  // namespace dartboard
