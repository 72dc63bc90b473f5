#include "validation/drawn/scene_walk.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/plain/error.h"

namespace dartboard::scene_walk_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(SceneWalk, KnowsTheDimensionsOfUnits) {
  EXPECT_EQ(dimensions_of("N s/m"), (Dimensions{0, -1, 1}));
  EXPECT_EQ(dimensions_of("kg/m^3"), (Dimensions{-3, 0, 1}));
  EXPECT_EQ(dimensions_of("m/s^2"), (Dimensions{1, -2, 0}));
  EXPECT_EQ(dimensions_of("1/s"), (Dimensions{0, -1, 0}));
  EXPECT_EQ(dimensions_of("mean edge lengths"), Dimensions{});
  EXPECT_THROW((void)dimensions_of("furlong"), InputError);
}

TEST(SceneWalk, KnowsEveryUnitOfTheTable) {
  for (const SceneKey& key : scene_keys()) EXPECT_NO_THROW((void)dimensions_of(key.unit)) << key.name;
}

TEST(SceneWalk, PassesKeysOfObjectsWithinLists) {
  Json scene{{"name", "x"}, {"fixed", Json::array({{{"sphere", {{"centre", {0, 0, 0}}, {"radius", 1}}}}})}};
  std::vector<std::string> paths;
  for_each_key(scene, Shape::scene, "",
               [&](const SceneKey&, Json&, const std::string& path) { paths.push_back(path); });
  EXPECT_EQ(paths, (std::vector<std::string>{"/name", "/fixed", "/fixed/0/sphere", "/fixed/0/sphere/centre",
                                             "/fixed/0/sphere/radius"}));
}

TEST(SceneWalk, WritesOutStandardsThatHaveAUnit) {
  const Json scene = with_standards(Json{{"name", "x"}, {"material", {{"young", 1000}, {"poisson", 0.3}}}});
  EXPECT_EQ(scene["gravity"], (Json{0, 0, -9.81}));
  EXPECT_EQ(scene["material"]["density"], 1000);
  EXPECT_EQ(scene["material"]["viscosity"], 0.1);
  // what young and poisson exclude
  EXPECT_FALSE(scene["material"].contains("stiffness"));
  EXPECT_FALSE(scene["material"].contains("damping"));
}

}  // namespace
}  // namespace dartboard::scene_walk_test
