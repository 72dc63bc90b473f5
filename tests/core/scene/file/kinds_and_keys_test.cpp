// Events and selections have the keys that the table of keys gives them.

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/scene/file/actions/action.h"
#include "core/scene/file/keys/scene_keys.h"

namespace dartboard::kinds_and_keys_test {
namespace {

using Keys = std::vector<std::string_view>;

template <class... Kinds>
Keys keys_of(std::type_identity<std::variant<Kinds...>>) {
  Keys keys{Kinds::key...};
  std::ranges::sort(keys);
  return keys;
}
template <class Variant>
Keys keys_of() {
  return keys_of(std::type_identity<Variant>());
}

/// The keys of which an object has exactly one.
Keys alternatives(Shape shape) {
  Keys keys;
  for (const SceneRule& rule : scene_rules())
    if (rule.shape == shape && rule.kind == SceneRule::exactly_one)
      keys.insert(keys.end(), rule.keys.begin(), rule.keys.end());
  std::ranges::sort(keys);
  return keys;
}

TEST(Actions, AreTheAlternativesOfAnEvent) { EXPECT_EQ(keys_of<Action>(), alternatives(Shape::event)); }

TEST(Actions, HaveARowOfTheTableEach) {
  for (const std::string_view key : keys_of<Action>())
    EXPECT_TRUE(std::ranges::any_of(scene_keys(), [key](const SceneKey& row) {
      return row.shape == Shape::event && row.name == key && row.type == ValueType::object;
    })) << key;
}

TEST(Actions, AreFoundByTheirKeyInThePathOfAnEvent) {
  EXPECT_EQ((SceneEvent{Tear{1u, {0, 0, 1}}, 0.0, 0.0, {}, "/events/3"}).action_path(), "/events/3/tear");
}

TEST(Selections, AreTheAlternativesOfTheirObjects) {
  EXPECT_EQ(keys_of<VertexSelection>(), alternatives(Shape::vertex_selection));
  EXPECT_EQ(keys_of<CellSelection>(), alternatives(Shape::cell_selection));
  EXPECT_EQ(keys_of<CutRegion>(), alternatives(Shape::within));
}

}  // namespace
}  // namespace dartboard::kinds_and_keys_test
