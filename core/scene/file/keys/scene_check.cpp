#include "core/scene/file/keys/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/plain/error.h"
#include "core/scene/file/keys/strict_json.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

class Checker {
 public:
  explicit Checker(std::string_view name) : name_(name) {}

  Json object(const Json& value, Shape shape, const std::string& path) const {
    if (!value.is_object()) fail(path, is_instead(value), fmt::format("an object ({})", help_of(shape).name));
    for (const auto& [key, unused] : value.items())
      if (find_key(shape, key) == nullptr) fail_unknown(shape, path, key);
    for (const SceneRule& rule : scene_rules())
      if (rule.shape == shape) require(rule, value, path);
    Json complete = Json::object();
    for (const SceneKey& key : scene_keys()) {
      if (key.shape != shape) continue;
      const std::string name(key.name), here = fmt::format("{}/{}", path, name);
      if (value.contains(name))
        complete[name] = checked(key, value.at(name), here);
      else if (key.required)
        fail(here, "is missing", expectation(key));
      else if (!key.standard.empty())
        complete[name] = checked(key, Json::parse(key.standard), here);
    }
    return complete;
  }

 private:
  [[noreturn]] void fail(const std::string& path, std::string_view found, std::string_view expected) const {
    throw InputError(fmt::format("{}: {}: {}; expected {}", name_, path.empty() ? "/" : path, found, expected));
  }
  static std::string is_instead(const Json& value) { return fmt::format("is {}", shown(value)); }

  [[noreturn]] void fail_unknown(Shape shape, const std::string& path, const std::string& name) const {
    std::vector<std::string> keys;
    for (const SceneKey& key : scene_keys())
      if (key.shape == shape) keys.emplace_back(key.name);
    const auto nearest = nearest_of(keys, name);
    const std::string hint = nearest ? fmt::format("the nearest valid key is '{}'", *nearest)
                                     : "the valid keys are " + quoted_list(keys, ", ");
    throw InputError(fmt::format("{}: {}/{}: unknown key; {}", name_, path, pointer_step(name), hint));
  }

  void require_choice(SceneKey key, const Json& value, const std::string& path) const {
    key.type = ValueType::choice;  // a word within a list is reported alone
    if (!value.is_string()) fail(path, is_instead(value), expectation(key));
    const auto text = value.get<std::string>();
    if (std::ranges::find(key.choices, text) != key.choices.end()) return;
    const auto nearest = nearest_of(key.choices, text);
    fail(path, is_instead(value),
         expectation(key) + (nearest ? fmt::format("; the nearest is '{}'", *nearest) : std::string()));
  }

  Json choices(const SceneKey& key, const Json& value, const std::string& path) const {
    Json words = each(key, value, path, key.least_size, many, [&](const Json& word, const std::string& at) {
      require_choice(key, word, at);
      return word;
    });
    for (std::size_t k = 0; k < words.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (words[j] == words[k])
          fail(fmt::format("{}/{}", path, k), fmt::format("is {}, like {}/{}", shown(words[k]), path, j),
               "each word once");
    return words;
  }

  void require(const SceneRule& rule, const Json& value, const std::string& path) const {
    std::vector<std::string_view> given;
    for (const auto key : rule.keys)
      if (value.contains(std::string(key))) given.push_back(key);
    const auto quoted = [](const std::vector<std::string_view>& keys) {
      std::string text;
      for (const auto key : keys) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", key);
      return text;
    };
    if (rule.kind == SceneRule::exactly_one && given.size() != 1)
      fail(path, given.empty() ? "has none of the keys that it needs" : "has " + quoted(given),
           "exactly one of " + quoted(rule.keys));
    if (rule.kind == SceneRule::at_most_one && given.size() > 1)
      fail(path, "has " + quoted(given), "at most one of them");
    if (rule.kind == SceneRule::needs_object && given.size() > 1 && given[0] == rule.keys[0])
      for (std::size_t k = 1; k < given.size(); ++k)
        if (const std::string key(given[k]); !value.at(key).is_object())
          fail(fmt::format("{}/{}", path, key), fmt::format("is {} together with '{}'", shown(value.at(key)), given[0]),
               fmt::format("an object ({})", help_of(find_key(rule.shape, key)->of).name));
    if (rule.kind == SceneRule::excludes && given.size() > 1 && given[0] == rule.keys[0])
      fail(path, "has " + quoted(given), fmt::format("'{}' without the others", rule.keys[0]));
  }

  Json checked(const SceneKey& key, const Json& value, const std::string& path) const {
    switch (key.type) {
      case ValueType::text:
        if (!value.is_string()) fail(path, is_instead(value), expectation(key));
        return value;
      case ValueType::choice: require_choice(key, value, path); return value;
      case ValueType::choices: return choices(key, value, path);
      case ValueType::integer: return number(key, value, path, true);
      case ValueType::real: return number(key, value, path, false);
      case ValueType::integers: return list(key, value, path, 1, many, true);
      case ValueType::point: return list(key, value, path, 3, 3, false);
      case ValueType::integer_pair: return list(key, value, path, 2, 2, true);
      case ValueType::integer_triple: return list(key, value, path, 3, 3, true);
      case ValueType::points:
        return each(key, value, path, key.least_size, many,
                    [&](const Json& one, const std::string& at) { return list(key, one, at, 3, 3, false); });
      case ValueType::matrix:
        return each(key, value, path, 3, 3,
                    [&](const Json& row, const std::string& at) { return list(key, row, at, 3, 3, false); });
      case ValueType::integer_lists:
        return each(key, value, path, 1, many,
                    [&](const Json& row, const std::string& at) { return list(key, row, at, 2, 3, true); });
      case ValueType::object: return object(value, key.of, path);
      case ValueType::objects:
        return each(key, value, path, 0, many,
                    [&](const Json& part, const std::string& at) { return object(part, key.of, at); });
      case ValueType::real_or_object:
        if (!value.is_object() && !value.is_number()) fail(path, is_instead(value), expectation(key));
        return value.is_object() ? object(value, key.of, path) : number(key, value, path, false);
      case ValueType::point_or_object: break;
    }
    return value.is_object() ? object(value, key.of, path) : list(key, value, path, 3, 3, false);
  }

  static constexpr std::size_t many = static_cast<std::size_t>(-1);

  template <class F>
  Json each(const SceneKey& key, const Json& value, const std::string& path, std::size_t least, std::size_t most,
            F&& f) const {
    if (!value.is_array()) fail(path, is_instead(value), expectation(key));
    if (value.size() < least || value.size() > most)
      fail(path, fmt::format("is a list of {}, {}", value.size(), shown(value)), expectation(key));
    Json parts = Json::array();
    for (std::size_t k = 0; k < value.size(); ++k) parts.push_back(f(value[k], fmt::format("{}/{}", path, k)));
    return parts;
  }
  Json list(const SceneKey& key, const Json& value, const std::string& path, std::size_t least, std::size_t most,
            bool whole) const {
    return each(key, value, path, least, most,
                [&](const Json& part, const std::string& at) { return number(key, part, at, whole); });
  }

  Json number(const SceneKey& key, const Json& value, const std::string& path, bool whole) const {
    const auto expected = [&] {
      SceneKey one = key;  // a number within a list is reported alone
      one.type = whole ? ValueType::integer : ValueType::real;
      return expectation(one);
    };
    if (!value.is_number()) fail(path, is_instead(value), expected());
    const auto x = value.get<double>();
    // 3.0 and 3e0 are integers to JSON Schema too
    const bool is_whole = value.is_number_integer() || x == std::floor(x);
    if (whole && !is_whole) fail(path, is_instead(value), expected());
    const Range& range = key.range;
    if (!std::isfinite(x) || x < range.least || x > range.most || (range.above && x == range.least))
      fail(path, is_instead(value), expected());
    if (whole && !value.is_number_integer()) return static_cast<std::int64_t>(x);  // all ranges of integers fit
    return value;
  }

  std::string_view name_;
};

}  // namespace

Json check_and_complete(const Json& value, Shape shape, std::string_view name) {
  return Checker(name).object(value, shape, "");
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // d[i][j]: between the first i letters of a and the first j of b
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t differ = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + differ});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::optional<std::string> nearest_of(std::span<const std::string> words, std::string_view word) {
  // words that differ only in case and dashes are the same to a person
  const auto plain = [](std::string_view text) {
    std::string letters;
    for (const char c : text)
      if (c != '-' && c != '_' && c != ' ') letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return letters;
  };
  std::optional<std::string> nearest;
  std::size_t least = std::string::npos;
  for (const std::string& known : words) {
    const std::string a = plain(word), b = plain(known);
    // the distance is at least the difference of the lengths, and a word may be of any length
    const std::size_t shorter = std::min(a.size(), b.size()), longer = std::max(a.size(), b.size());
    if (3 * (longer - shorter) > longer) continue;
    const std::size_t far = edit_distance(a, b);
    if (far >= least || 3 * far > longer) continue;
    least = far;
    nearest = known;
  }
  return nearest;
}

std::string shown(const Json& value) {
  constexpr std::size_t longest = 60;
  if (value.is_object()) return fmt::format("an object with {} keys", value.size());
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

}  // namespace dartboard
