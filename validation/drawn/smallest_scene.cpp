#include "validation/drawn/smallest_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

void add_paths(const Json& value, const Pointer& here, std::vector<Pointer>& paths) {
  if (value.is_object())
    for (const auto& [key, part] : value.items()) {
      paths.push_back(here / key);
      add_paths(part, here / key, paths);
    }
  if (value.is_array())
    for (std::size_t k = value.size(); k-- > 0;) {
      paths.push_back(here / k);
      add_paths(value[k], here / k, paths);
    }
}

/// The scene without what is at a path.
Json without(Json scene, const Pointer& path) {
  Json& parent = scene.at(path.parent_pointer());
  if (parent.is_object())
    parent.erase(path.back());
  else
    parent.erase(std::stoul(path.back()));
  return scene;
}

/// Simpler values than this one, the simplest first.
std::vector<Json> simpler(const Json& value) {
  std::vector<Json> values;
  if (value.is_number_integer() && value.get<long long>() > 1) values = {1, value.get<long long>() / 2};
  if (value.is_number_float()) {
    const auto x = value.get<double>();
    for (const int digits : {1, 2, 3}) {
      const double rounded = std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr);
      if (rounded != x) values.emplace_back(rounded);
    }
    if (x != 0.0 && std::abs(x) != 1.0) values.insert(values.begin(), 0.0);
  }
  return values;
}

}  // namespace

Json smallest_scene(Json scene, const std::function<bool(const Json&)>& is_at_fault, std::size_t most_trials) {
  std::size_t trials = 0;
  const auto take = [&](Json smaller) {
    if (++trials > most_trials || !is_at_fault(smaller)) return false;
    scene = std::move(smaller);
    return true;
  };
  for (bool again = true; again && trials < most_trials;) {
    again = false;
    std::vector<Pointer> paths;
    add_paths(scene, Pointer(), paths);
    for (const Pointer& path : paths)
      if (scene.contains(path) && take(without(scene, path))) again = true;
    paths.clear();
    add_paths(scene, Pointer(), paths);
    for (const Pointer& path : paths)
      for (Json& value : simpler(scene.at(path))) {
        Json other = scene;
        other.at(path) = std::move(value);
        if (!take(std::move(other))) continue;
        again = true;
        break;
      }
  }
  return scene;
}

}  // namespace dartboard
