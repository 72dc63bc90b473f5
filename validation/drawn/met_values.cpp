#include "validation/drawn/met_values.h"

#include <fmt/format.h>

#include <cstdint>
#include <queue>
#include <utility>

#include "core/plain/error.h"
#include "validation/drawn/scene_walk.h"

namespace dartboard {
namespace {

constexpr std::size_t most_values = 512;

using Numbers = std::map<std::string, std::size_t>;

/// Of each value, in order; one that is new gets the next one.
std::vector<std::size_t> numbers_of(const std::set<std::string>& values, Numbers& known) {
  std::vector<std::size_t> numbers;
  for (const std::string& value : values) numbers.push_back(known.try_emplace(value, known.size()).first->second);
  if (known.size() > most_values) throw InputError(fmt::format("there are more than {} values", most_values));
  std::ranges::sort(numbers);
  return numbers;
}

}  // namespace

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

std::size_t MetValues::add(const std::set<std::string>& values) {
  has_pair_.resize(most_values * most_values);
  has_triple_.resize(most_values * most_values * most_values);
  const std::vector<std::size_t> numbers = numbers_of(values, number_);
  const auto meet = [](std::vector<bool>& has, std::size_t at, std::size_t& count) {
    if (has[at]) return;
    has[at] = true;
    ++count;
  };
  const std::size_t before = pairs_;
  for (std::size_t a = 0; a < numbers.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const std::size_t pair = numbers[a] * most_values + numbers[b];
      meet(has_pair_, pair, pairs_);
      for (std::size_t c = 0; c < b; ++c) meet(has_triple_, pair * most_values + numbers[c], triples_);
    }
  return pairs_ - before;
}

std::vector<std::size_t> covering(const std::vector<std::set<std::string>>& scenes) {
  Numbers known;
  std::vector<std::vector<std::size_t>> pairs;  // of each scene
  for (const auto& values : scenes) {
    const std::vector<std::size_t> numbers = numbers_of(values, known);
    auto& own = pairs.emplace_back();
    for (std::size_t a = 0; a < numbers.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) own.push_back(numbers[a] * most_values + numbers[b]);
  }
  std::vector<bool> is_met(most_values * most_values, false);
  // the most that a scene may add, as it was when it was looked at last: of equals the first one is above
  using Row = std::pair<std::size_t, std::int64_t>;
  std::priority_queue<Row> rows;
  for (std::size_t k = 0; k < scenes.size(); ++k) rows.push({pairs[k].size(), -static_cast<std::int64_t>(k)});
  std::vector<std::size_t> chosen;
  while (!rows.empty()) {
    const auto k = static_cast<std::size_t>(-rows.top().second);
    rows.pop();
    std::erase_if(pairs[k], [&is_met](std::size_t pair) { return is_met[pair]; });
    if (pairs[k].empty()) continue;
    const Row row{pairs[k].size(), -static_cast<std::int64_t>(k)};
    if (!rows.empty() && row < rows.top()) {
      rows.push(row);
      continue;
    }
    chosen.push_back(k);
    for (const std::size_t pair : pairs[k]) is_met[pair] = true;
  }
  return chosen;
}

}  // namespace dartboard
