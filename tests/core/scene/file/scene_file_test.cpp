#include "core/scene/file/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/plain/error.h"
#include "core/scene/file/keys/scene_check.h"
#include "core/scene/file/keys/scene_keys.h"
#include "core/scene/file/keys/scene_pages.h"
#include "core/scene/file/keys/strict_json.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/timeline/event_clock.h"

namespace dartboard::scene_file_test {
namespace {

using Json = nlohmann::ordered_json;

Json smallest() {
  return Json::parse(R"({"name": "s", "body": {"generate": {"box": {"cells": [1, 2, 3], "spacing": 0.5}}},
                         "step": 0.25, "duration": 1})");
}
SceneFile parse(const Json& json) { return parse_scene(json.dump(), "file", "/folder"); }

std::string refusal(const std::string& text) {
  try {
    parse_scene(text, "file", "");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneFile, FillsInTheDefaultsOfTheTable) {
  const SceneFile scene = parse(smallest());
  EXPECT_EQ(scene.name, "s");
  EXPECT_EQ(scene.integrator, "rk4");
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(scene.material.density, Material{}.density);
  EXPECT_EQ(scene.material.stiffness, Material{}.stiffness);
  EXPECT_EQ(scene.material.damping, Material{}.damping);
  EXPECT_EQ(scene.material.viscosity, Material{}.viscosity);
  EXPECT_EQ(scene.body.scale, 1.0);
  EXPECT_TRUE(scene.events.empty());
  EXPECT_FALSE(scene.output.frame_steps);
  EXPECT_TRUE(scene.expect.empty());
}

TEST(SceneFile, ReadsMeshPathsRelativeToItself) {
  Json json = smallest();
  json["body"] = {{"mesh", "meshes/a.mesh"}};
  EXPECT_EQ(std::get<std::filesystem::path>(parse(json).body.mesh), "/folder/meshes/a.mesh");
}

TEST(SceneFile, ScalesTheBodyAndThenMovesIt) {
  Json json = smallest();
  json["body"]["scale"] = 2;
  json["body"]["translate"] = {1, 0, -1};
  const Mesh mesh = make_mesh(parse(json));
  EXPECT_EQ(mesh.points.front(), Eigen::Vector3d(1, 0, -1));
  EXPECT_EQ(mesh.points.back(), Eigen::Vector3d(2, 2, 2));  // 2 (0.5, 1, 1.5) + (1, 0, -1)
}

// A quarter turn about z takes x to y, and y to -x.
TEST(SceneFile, TurnsTheBodyAfterScalingAndBeforeMovingIt) {
  Json json = smallest();
  json["body"]["scale"] = 2;
  json["body"]["rotate"] = Json::parse(R"({"axis": [0, 0, 5], "degrees": 90})");
  json["body"]["translate"] = {1, 0, -1};
  // (1, 2, 3) turned is (-2, 1, 3); the sine and cosine of the half angle round to 2^-53
  EXPECT_LT((make_mesh(parse(json)).points.back() - Eigen::Vector3d(-1, 1, 2)).norm(), 16 * 0x1p-53);
  json["body"]["rotate"]["axis"] = {0, 0, 0};
  EXPECT_THROW(parse(json), InputError);
}

TEST(SceneFile, TakesOneVelocityForAllOrOneLinearInPlace) {
  Json json = smallest();
  json["initial_velocity"] = {1, 2, 3};
  EXPECT_EQ(parse(json).initial_velocity.at({5, 5, 5}), Eigen::Vector3d(1, 2, 3));
  json["initial_velocity"] = Json::parse(R"({"linear": [[0, -1, 0], [1, 0, 0], [0, 0, 0]], "centre": [1, 1, 0]})");
  EXPECT_EQ(parse(json).initial_velocity.at({3, 1, 7}), Eigen::Vector3d(0, 2, 0));
}

TEST(SceneFile, CountsOutputInStepsWhicheverWayItIsGiven) {
  Json json = smallest();
  json["output"] = {{"frames_every", 0.5}, {"diagnostics_every", {{"steps", 7}}}};
  EXPECT_EQ(parse(json).output.frame_steps, 2u);
  EXPECT_EQ(parse(json).output.diagnostic_steps, 7u);
}

TEST(SceneFile, MayAskForAnAccuracyInsteadOfAStep) {
  Json json = smallest();
  json.erase("step");
  json["accuracy"] = 1e-3;
  json["output"] = {{"frames_every", 0.5}, {"diagnostics_every", {{"steps", 7}}}, {"fields", {"springs"}}};
  SceneFile scene = parse(json);
  EXPECT_EQ(scene.accuracy, 1e-3);
  EXPECT_EQ(scene.step, 0.0);
  EXPECT_EQ(scene.integrator, "");
  json["integrator"] = "verlet";
  EXPECT_EQ(parse(json).integrator, "verlet");
  // values in time wait until the step is known
  EXPECT_EQ(scene.output.in_steps_of(0.125).frame_steps, 4u);
  EXPECT_EQ(scene.output.in_steps_of(0.125).diagnostic_steps, 7u);
  EXPECT_TRUE(scene.output.in_steps_of(0.125).fields.springs);
  EXPECT_FALSE(scene.output.in_steps_of(0.125).fields.stress);
}

TEST(SceneFile, AsksForExactlyOneOfStepAndAccuracy) {
  Json json = smallest();
  json["accuracy"] = 1e-3;
  EXPECT_EQ(refusal(json.dump()), "file: /: has 'step', 'accuracy'; expected exactly one of 'step', 'accuracy'");
}

TEST(SceneFile, MakesBallsAndChainsOnTheSpot) {
  Json json = smallest();
  json["body"] = Json::parse(R"({"generate": {"ball": {"layers": 2, "radius": 3}}, "translate": [1, 0, 0]})");
  const Mesh ball = make_mesh(parse(json));
  EXPECT_EQ(ball.cell_count(), 64u);
  EXPECT_EQ(ball.points.front(), Eigen::Vector3d(1, 0, -3));
  EXPECT_FALSE(parse(json).is_chain());
  json["body"] = Json::parse(R"({"generate": {"chain": {"links": 3, "spacing": 0.5}}, "scale": 2})");
  const Mesh chain = make_mesh(parse(json));
  EXPECT_EQ(chain.cell_count(), 0u);
  EXPECT_EQ(chain.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_TRUE(parse(json).is_chain());
}

TEST(SceneFile, DrivesVerticesFromTheStartToTheEndUnlessItSaysOtherwise) {
  Json json = smallest();
  json["driven"] = Json::parse(R"([{"ids": [3], "velocity": [1, 2, 3]},
                                   {"ids": [4], "velocity": [0, 0, 1], "from": 0.5, "until": 9, "reverse_every": 0.25}])");
  const SceneFile scene = parse(json);
  EXPECT_EQ(scene.driven.at(0).from, 0.0);
  EXPECT_FALSE(scene.driven.at(0).until);
  EXPECT_EQ(scene.driven.at(0).velocity.at({7, 7, 7}), Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(scene.driven.at(0).reverse_every);
  EXPECT_EQ(scene.driven.at(1).from, 0.5);
  EXPECT_FALSE(scene.driven.at(1).until);  // beyond the duration of 1 s
  EXPECT_EQ(scene.driven.at(1).reverse_every, 0.25);
  EXPECT_EQ(make_problem(scene).fixed, (std::vector<std::uint32_t>{3, 4}));
}

TEST(SceneFile, ReseedsRandomSelectionsOnly) {
  Json json = smallest();
  json["events"] = Json::parse(R"([{"at": 0, "remove": {"random": {"count": 1, "seed": 40}}},
                                   {"at": 0, "remove": {"ids": [1]}}])");
  SceneFile scene = parse(json);
  EXPECT_TRUE(reseed(scene, 2));
  EXPECT_EQ(std::get<RandomSelection>(std::get<Remove>(scene.events[0].action).cells).seed, 42u);
}

TEST(SceneFile, SaysWhetherAnythingIsReseeded) {
  Json json = smallest();
  json["events"] = Json::parse(R"([{"at": 0, "remove": {"random": {"count": 1, "seed": 40}}}])");
  SceneFile random = parse(json), certain = parse(smallest());
  EXPECT_FALSE(reseed(random, 0));
  EXPECT_FALSE(reseed(certain, 7));
}

TEST(SceneFile, TellsLineAndColumnOfASyntaxError) {
  EXPECT_EQ(refusal("{\n  \"name\": \"a\",\n  \"step\" 1\n}").rfind("file:3:10: syntax error", 0), 0u)
      << refusal("{\n  \"name\": \"a\",\n  \"step\" 1\n}");
}

TEST(SceneFile, NamesTheNearestKeyBySwapsToo) {
  EXPECT_EQ(edit_distance("denisty", "density"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  // characters before a word are ignored: the 'a' here would make a swap
  EXPECT_EQ(edit_distance("ba", std::string_view("ab").substr(1)), 1u);
  EXPECT_EQ(edit_distance(std::string_view("ab").substr(1), "ba"), 1u);
  Json json = smallest();
  json["stpe"] = 1;
  EXPECT_EQ(refusal(json.dump()), "file: /stpe: unknown key; the nearest valid key is 'step'");
}

TEST(SceneCheck, HintsOnlyAtWhatIsNear) {
  const std::vector<std::string> words{"driven", "duration", "blanes-moan-4", "rk4"};
  EXPECT_EQ(nearest_of(words, "drivn"), "driven");
  EXPECT_EQ(nearest_of(words, "RK-4"), "rk4");
  EXPECT_EQ(nearest_of(words, "Blanes_Moan_4"), "blanes-moan-4");
  EXPECT_EQ(nearest_of(words, "solver"), std::nullopt);
  EXPECT_EQ(nearest_of(words, ""), std::nullopt);
}

TEST(SceneFile, TakesARealThatIsAnIntegerForOne) {
  Json json = smallest();
  json["fixed"] = Json::parse(R"([{"ids": [1.0, 2e0]}])");
  EXPECT_EQ(std::get<IdSelection>(parse(json).fixed.at(0).vertices).ids, (std::vector<std::uint32_t>{1, 2}));
}

TEST(SceneFile, TakesADirectionOfAnyLengthButZero) {
  Json json = smallest();
  json["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}])");
  for (const double length : {1e-320, 1e-200, 1.0, 1e200, 1.7e308}) {
    json["fixed"][0]["plane"]["normal"][2] = length;
    EXPECT_EQ(std::get<PlaneSelection>(parse(json).fixed.at(0).vertices).normal, Eigen::Vector3d(0, 0, 1)) << length;
  }
}

TEST(SceneFile, AcceptsTheBoundOfARangeUnlessItIsOpen) {
  Json json = smallest();
  json["material"] = {{"damping", 0}};
  EXPECT_EQ(parse(json).material.damping, 0.0);
  json["material"] = {{"density", 0}};
  EXPECT_EQ(refusal(json.dump()), "file: /material/density: is 0; expected a number > 0 [kg/m^3]");
}

TEST(StrictJson, KeepsValuesAndTheOrderOfKeys) {
  const std::string text = R"({"z":[1,-2,0.5,true,null,"t"],"a":{"b":{},"c":[[]]}})";
  EXPECT_EQ(parse_strict_json(text, "file").dump(), text);
}

TEST(StrictJson, AllowsTheSameKeyInDifferentObjects) {
  EXPECT_NO_THROW(parse_strict_json(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})", "file"));
}

// ---- the table

TEST(SceneKeys, HaveDefaultsThatTheTableAccepts) {
  for (const SceneKey& key : scene_keys()) {
    if (key.standard.empty()) continue;
    EXPECT_FALSE(key.required) << key.name;
    if (key.type == ValueType::object) continue;  // its own keys are checked here one by one
    EXPECT_TRUE(Json::accept(key.standard)) << key.name;
  }
  // smallest() uses every default of the scene; the shapes within a selection or event have no defaults that fail there
  EXPECT_NO_THROW(check_and_complete(smallest(), Shape::scene, "file"));
}

TEST(SceneKeys, AreUniqueWithinAShapeAndExplained) {
  std::set<std::pair<Shape, std::string_view>> met;
  for (const SceneKey& key : scene_keys()) {
    EXPECT_TRUE(met.insert({key.shape, key.name}).second) << key.name;
    EXPECT_FALSE(key.help.empty()) << key.name;
    EXPECT_EQ(key.type == ValueType::choice || key.type == ValueType::choices, !key.choices.empty()) << key.name;
  }
  for (std::size_t k = 0; k < scene_shapes().size(); ++k)
    EXPECT_EQ(scene_shapes()[k].shape, static_cast<Shape>(k));  // help_of looks up by place
}

TEST(SceneKeys, OfEveryRuleExist) {
  for (const SceneRule& rule : scene_rules())
    for (const auto name : rule.keys)
      EXPECT_TRUE(std::any_of(scene_keys().begin(), scene_keys().end(), [&](const SceneKey& key) {
        return key.shape == rule.shape && key.name == name;
      })) << name;
}

TEST(SceneSchema, NamesEveryKeyOfTheTableAndAllowsNoOther) {
  const Json schema = scene_schema();
  for (const SceneKey& key : scene_keys()) {
    const Json& shape =
        key.shape == Shape::scene ? schema : schema.at("$defs").at(std::string(help_of(key.shape).name));
    EXPECT_TRUE(shape.at("properties").contains(std::string(key.name))) << key.name;
    EXPECT_EQ(shape.at("additionalProperties"), false);
  }
  EXPECT_EQ(schema.at("$defs").at("material").at("properties").at("density").at("exclusiveMinimum"), 0.0);
  EXPECT_EQ(schema.at("required"), Json::parse(R"(["name", "duration"])"));
}

TEST(SceneSchema, WantsWordsOfAListOnce) {
  const Json fields = scene_schema().at("$defs").at("output").at("properties").at("fields");
  EXPECT_EQ(fields.at("type"), "array");
  EXPECT_EQ(fields.at("uniqueItems"), true);
  EXPECT_EQ(fields.at("items"), Json::parse(R"({"enum": ["held", "stress", "displacement", "springs", "contact"]})"));
  EXPECT_FALSE(fields.contains("minItems"));
  EXPECT_EQ(fields.at("default"), Json::parse(R"(["held", "stress"])"));
}

// The lower and upper end of a number; a range without an end has no key for it.
TEST(SceneSchema, HasTheRangesOfTheTable) {
  const Json schema = scene_schema();
  std::size_t ends = 0;
  for (const SceneKey& key : scene_keys()) {
    if (key.type != ValueType::real && key.type != ValueType::integer) continue;
    const Json& shape =
        key.shape == Shape::scene ? schema : schema.at("$defs").at(std::string(help_of(key.shape).name));
    const Json& number = shape.at("properties").at(std::string(key.name));
    const char* least = key.range.above ? "exclusiveMinimum" : "minimum";
    ASSERT_EQ(number.contains("maximum"), std::isfinite(key.range.most)) << key.name;
    ASSERT_EQ(number.contains(least), std::isfinite(key.range.least)) << key.name;
    if (std::isfinite(key.range.most)) {
      EXPECT_EQ(number.at("maximum").get<double>(), key.range.most) << key.name;
    }
    if (std::isfinite(key.range.least)) {
      EXPECT_EQ(number.at(least).get<double>(), key.range.least) << key.name;
    }
    ends += !std::isfinite(key.range.most);
  }
  EXPECT_GT(ends, 0u);
}

TEST(SceneReference, HasALineForEveryKey) {
  const std::string page = scene_reference();
  for (const SceneKey& key : scene_keys()) EXPECT_NE(page.find("| `" + std::string(key.name) + "` |"), page.npos);
}

TEST(SceneReference, SaysWhatRefinementCannotBeCombinedWith) {
  const std::string_view help = find_key(Shape::event, "refine")->help;
  for (const char* words : {"/driven", "/forces", "/attachments", "'release'", "'plane' of 'tear_where_stressed'"})
    EXPECT_NE(help.find(words), help.npos) << words;
}

TEST(SceneReference, HasEachSectionAlone) {
  const std::string page = scene_reference();
  std::string together = page.substr(0, page.find("\n## "));
  for (const ShapeHelp& shape : scene_shapes()) together += "\n" + scene_reference(shape.name);
  EXPECT_EQ(together, page);
  EXPECT_EQ(scene_reference("refine").rfind("## refine\n", 0), 0u);
}

TEST(SceneReference, LeadsFromAKeyToTheObjectsThatAreItsValues) {
  const std::string page = scene_reference("events");
  EXPECT_NE(page.find("| scene | `events` | a list of objects"), page.npos) << page;
  EXPECT_NE(page.find(scene_reference("event")), page.npos) << page;
  const std::string of_numbers = scene_reference("young");
  EXPECT_NE(of_numbers.find("| material | `young` | "), of_numbers.npos) << of_numbers;
  EXPECT_EQ(of_numbers.find("## "), of_numbers.npos) << of_numbers;
}

TEST(SceneReference, NamesAllSectionsWhereOneIsUnknown) {
  try {
    (void)scene_reference("refinement");
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_EQ(
        said.rfind("no object or key of scenes is called 'refinement'; expected a key, or one of the objects: scene, ",
                   0),
        0u)
        << said;
    for (const ShapeHelp& shape : scene_shapes())
      EXPECT_NE(said.find(" " + std::string(shape.name)), said.npos) << shape.name;
  }
}

// ---- times

TEST(EventTimes, FallOnTheMultipleTheyAreInDecimals) {
  // 0.3 / 0.1 is 2.9999999999999996 in doubles, and 0.7 / 0.1 is 6.999999999999999
  EXPECT_EQ(step_of_time(0.3, 0.1), 3u);
  EXPECT_EQ(step_of_time(0.7, 0.1), 7u);
  EXPECT_EQ(step_of_time(0.0, 0.1), 0u);
  for (std::uint64_t n = 0; n < 1000; ++n)  // n / 1000 is the decimal n e-3, correctly rounded
    EXPECT_EQ(step_of_time(static_cast<double>(n) / 1000, 0.001), n);
}

TEST(EventTimes, BetweenTwoStepsBelongToTheLater) {
  EXPECT_EQ(step_of_time(0.25, 0.1), 3u);
  EXPECT_EQ(step_of_time(std::nextafter(3.0, 4.0) + 1e-9, 1.0), 4u);
  EXPECT_EQ(step_until(0.25, 0.1), 2u);
}

std::vector<std::uint64_t> steps_of(EventClock clock) {
  std::vector<std::uint64_t> steps;
  for (; clock.next() != EventClock::never && steps.size() < 100; clock.advance()) steps.push_back(clock.next());
  return steps;
}
using Steps = std::vector<std::uint64_t>;

TEST(EventClock, OfASingleTimeIsDueOnce) { EXPECT_EQ(steps_of({0.2, 0.2, {}, 0.1}), Steps{2}); }
TEST(EventClock, OfASingleTimeBetweenStepsIsDueOnce) { EXPECT_EQ(steps_of({0.25, 0.25, {}, 0.1}), Steps{3}); }
TEST(EventClock, WithoutAnIntervalIsDueAtEveryStep) { EXPECT_EQ(steps_of({0.1, 0.3, {}, 0.1}), (Steps{1, 2, 3})); }
TEST(EventClock, RepeatsUpToTheLastTimeInclusively) { EXPECT_EQ(steps_of({0.1, 0.7, 0.2, 0.1}), (Steps{1, 3, 5, 7})); }
TEST(EventClock, WithAnIntervalBelowTheStepIsDueAtEveryStep) {
  EXPECT_EQ(steps_of({0.0, 0.2, 0.03, 0.1}), (Steps{0, 1, 2}));
  EXPECT_EQ(steps_of({0.0, 0.2, 1e-300, 0.1}), (Steps{0, 1, 2}));
}

TEST(SceneFile, TakesTimesFarBeyondItsEnd) {
  Json json = smallest();  // four steps
  json["output"] = {{"frames_every", 1e300}};
  json["events"] = Json::parse(R"([{"every": 1e300, "until": 1e300, "remove": {"ids": [0]}}])");
  const SceneFile scene = parse(json);
  EXPECT_GT(scene.output.frame_steps, 4u);  // a number above that of all steps
  const SceneEvent& event = scene.events.at(0);
  EXPECT_EQ(steps_of({event.from, event.until, event.every, scene.step}), Steps{0});
}

// ---- contact

TEST(SceneFile, ReadsContactsAndTheirObstacles) {
  const SceneFile scene = parse_scene(R"({"name": "s", "step": 0.1, "duration": 2,
    "body": {"generate": {"box": {"cells": [1, 1, 1], "spacing": 1}}},
    "contact": {"pressure": 1500, "depth": 0.25, "exponent": 4, "restitution": 0.5, "friction": 0.125,
      "obstacles": [{"plane": {"point": [1, 2, 3], "normal": [0, 3, 4]}},
        {"sphere": {"centre": [4, 5, 6], "radius": 7}, "friction": 0.75, "restitution": 1, "pressure": 3000, "depth": 2},
        {"box": {"min": [-1, -2, -3], "max": [1, 2, 3]}, "velocity": [9, 8, 7], "from": 0.5, "until": 1.5}]}})",
                                      "file", "");
  ASSERT_EQ(scene.obstacles.size(), 3u);
  const auto law_is = [](const ContactLaw& law, double pressure, double depth, double restitution, double friction) {
    return law.pressure == pressure && law.depth == depth && law.restitution == restitution &&
           law.friction == friction && law.exponent == 4;
  };
  EXPECT_TRUE(law_is(scene.obstacles[0].law, 1500, 0.25, 0.5, 0.125));
  EXPECT_TRUE(law_is(scene.obstacles[1].law, 3000, 2, 1, 0.75));
  EXPECT_TRUE(law_is(scene.obstacles[2].law, 1500, 0.25, 0.5, 0.125));
  const auto& plane = std::get<HalfSpace>(scene.obstacles[0].obstacle.shape);
  EXPECT_EQ(plane.point, Eigen::Vector3d(1, 2, 3));
  EXPECT_LE((plane.normal - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  const auto& ball = std::get<Ball>(scene.obstacles[1].obstacle.shape);
  EXPECT_EQ(ball.centre, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(ball.radius, 7);
  const auto& block = std::get<Block>(scene.obstacles[2].obstacle.shape);
  EXPECT_EQ(block.low, Eigen::Vector3d(-1, -2, -3));
  EXPECT_EQ(block.high, Eigen::Vector3d(1, 2, 3));
  const Obstacle& moves = scene.obstacles[2].obstacle;
  EXPECT_EQ(moves.velocity, Eigen::Vector3d(9, 8, 7));
  EXPECT_EQ(moves.from, 0.5);
  EXPECT_EQ(moves.until, 1.5);
  EXPECT_TRUE(scene.obstacles[2].moves());
  EXPECT_FALSE(scene.obstacles[0].moves());
  EXPECT_TRUE(std::isinf(scene.obstacles[0].obstacle.until));
  EXPECT_EQ(scene.obstacles[2].path, "/contact/obstacles/2");
}

TEST(SceneFile, GivesContactsTheDefaultsOfTheirPage) {
  const SceneFile scene = parse_scene(R"({"name": "s", "step": 0.1, "duration": 2,
    "body": {"generate": {"box": {"cells": [1, 1, 1], "spacing": 1}}},
    "contact": {"pressure": 1500, "depth": 0.25, "obstacles": [{"sphere": {"centre": [0, 0, -9], "radius": 1}}]}})",
                                      "file", "");
  const ContactLaw& law = scene.obstacles.at(0).law;
  EXPECT_EQ(law.exponent, 3);
  EXPECT_EQ(law.restitution, 1.0);
  EXPECT_EQ(law.friction, 0.0);
}

}  // namespace
}  // namespace dartboard::scene_file_test
