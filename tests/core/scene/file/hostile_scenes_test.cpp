// Scenes with hostile names: read, run, written and read back.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/escape.h"
#include "core/plain/error.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/run/probes.h"
#include "core/scene/run/scene_run.h"
#include "tests/hostile/hostile_names.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::hostile_scenes_test {
namespace {

using namespace moving;

bool is_utf8(const std::string& text) {
  try {
    (void)Json(text).dump();
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

Json named(const std::string& name) {
  Json scene = Json::parse(R"({"step": 0.001, "duration": 0.001,
                               "body": {"generate": {"chain": {"links": 1, "spacing": 1}}}})");
  scene["name"] = scene["about"] = name;
  if (!name.empty()) scene["output"]["probes"].push_back({{"name", name}, {"vertex", 0}});
  return scene;
}

TEST(HostileScenes, KeepTheirNamesWhateverTheyAre) {
  for (const std::string& name : many_hostile_names(500)) {
    if (!is_utf8(name)) continue;
    const SceneFile scene = parse(named(name));
    EXPECT_EQ(scene.name, name);
    EXPECT_EQ(scene.about, name);
  }
}

TEST(HostileScenes, AreRefusedWithLineAndColumnWhereTheyAreNoUtf8) {
  std::size_t refused = 0;
  for (const std::string& name : many_hostile_names(500)) {
    if (is_utf8(name)) continue;
    std::string text = R"({"step": 1, "duration": 1,
"name": ")";
    for (const char c : name)  // characters that JSON does not allow in a string
      if (static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\') text += c;
    try {
      parse_scene(text + "\"}", "file", "");
      ADD_FAILURE() << terminal_text(name);
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with("file:2:")) << terminal_text(error.what());
      ++refused;
    }
  }
  EXPECT_GT(refused, 100u);
}

TEST(HostileScenes, TellAnUnknownKeyOfAnyLength) {
  for (const std::string& name : many_hostile_names(200)) {
    if (!is_utf8(name)) continue;
    Json scene = named("x");
    scene[name + "x"] = 1;
    EXPECT_THROW(parse(scene), InputError);
  }
}

class HostileProbes : public FolderTest {};

TEST_F(HostileProbes, LeaveAHeaderOfOneLineWithSixColumnsEach) {
  Json scene = named("x");
  scene["output"]["probes"].clear();
  std::size_t probes = 0;
  for (const std::string& name : many_hostile_names(300))
    if (!name.empty() && is_utf8(name) && name.size() < 5000) {
      const Json probe{{"name", name}, {"vertex", 0}};
      if (std::ranges::find(scene["output"]["probes"], probe) != scene["output"]["probes"].end()) continue;
      scene["output"]["probes"].push_back(probe);
      ++probes;
    }
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  SceneOutput output(folder_, file.probes, simulation.dimension());
  output.write(simulation.probes());
  const std::string csv = text("probes.csv");
  ASSERT_EQ(std::ranges::count(csv, '\n'), 2);
  // commas outside quotes
  const std::string header = csv.substr(0, csv.find('\n'));
  std::size_t columns = 1;
  bool quoted = false;
  for (const char c : header) {
    quoted ^= c == '"';
    columns += c == ',' && !quoted;
  }
  EXPECT_EQ(columns, 1 + 6 * probes);
  EXPECT_EQ(std::ranges::count(csv.substr(csv.find('\n')), ','), std::ssize(file.probes) * 6);
  EXPECT_GT(probes, 50u);
}

}  // namespace
}  // namespace dartboard::hostile_scenes_test
