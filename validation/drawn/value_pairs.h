#pragma once
// What scenes have of the table of keys, one by one and in pairs.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

namespace dartboard {

/// The keys of a scene that it need not have, and the choices of those that have choices: "event.remove",
/// "box_mesh.kind=mixed".
std::set<std::string> values_of(const nlohmann::ordered_json& scene);

/// The values that scenes have had, and the pairs of values that one scene has had.
class ValuePairs {
 public:
  void add(const std::set<std::string>& values);
  std::size_t values() const { return values_.size(); }
  std::size_t pairs() const { return pairs_.size(); }
  bool has(const std::string& value) const { return values_.contains(value); }

 private:
  std::set<std::string> values_;
  std::set<std::pair<std::string, std::string>> pairs_;
};

}  // namespace dartboard
