// Scenes that are wrong: each gives one clear message that names the key.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/error.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
const fs::path folder = source_folder() / "tests" / "scenes_bad";

struct BadScene {
  std::string name, exit_code, part;
};

std::vector<BadScene> bad_scenes() {
  std::vector<BadScene> scenes;
  std::ifstream file(folder / "expected.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto first = line.find(" | "), second = line.find(" | ", first + 3);
    scenes.push_back({line.substr(0, first), line.substr(first + 3, second - first - 3), line.substr(second + 3)});
  }
  return scenes;
}

/// The exit code that a command line gives, and the message.
std::pair<std::string, std::string> answer(const fs::path& file) {
  try {
    const Simulation simulation(read_scene(file));
    return {"0", ""};
  } catch (const InputError& error) {
    return {"2", error.what()};
  } catch (const IoError& error) {
    return {"3", error.what()};
  }
}

TEST(BadScenes, AreEachRefusedWithAMessageThatNamesFileAndKey) {
  for (const BadScene& scene : bad_scenes()) {
    const fs::path file = folder / (scene.name + ".json");
    const auto [exit_code, message] = answer(file);
    EXPECT_EQ(exit_code, scene.exit_code) << scene.name << ": " << message;
    EXPECT_NE(message.find(scene.part), std::string::npos)
        << scene.name << "\n  said:     " << message << "\n  expected: " << scene.part;
    EXPECT_EQ(message.rfind(file.string(), 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(BadScenes, AreAllInTheTable) {
  std::set<std::string> listed, there;
  for (const BadScene& scene : bad_scenes()) listed.insert(scene.name);
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") there.insert(entry.path().stem().string());
  EXPECT_EQ(listed, there);
  EXPECT_GE(there.size(), 30u);
}

}  // namespace
}  // namespace dartboard
