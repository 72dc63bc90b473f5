#pragma once
// What scenes have of the table of keys: one by one, in pairs and in triples.

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace dartboard {

/// The keys of a scene that it need not have, and the choices of those that have choices: "event.remove",
/// "box_mesh.kind=mixed".
std::set<std::string> values_of(const nlohmann::ordered_json& scene);

/// The values that scenes have had, and the pairs and triples of values that one scene has had.
class MetValues {
 public:
  /// Returns the number of pairs that no scene before has had.
  /// throws  InputError for more than 512 values in all
  std::size_t add(const std::set<std::string>& values);
  std::size_t values() const { return number_.size(); }
  std::size_t pairs() const { return pairs_; }
  std::size_t triples() const { return triples_; }
  bool has(const std::string& value) const { return number_.contains(value); }

 private:
  std::map<std::string, std::size_t> number_;
  std::vector<bool> has_pair_, has_triple_;
  std::size_t pairs_ = 0, triples_ = 0;
};

/// The numbers of some of these scenes, which have all pairs that one of them has: in each turn the one that has most
/// of those that are left. All pairs of the first ones, rare ones of the last.
///
/// cost  some turns look at most of the scenes: 3 s for 6,000 of 55 values
std::vector<std::size_t> covering(const std::vector<std::set<std::string>>& scenes);

}  // namespace dartboard
