// Scenes that are wrong: each gives one clear message that names the key.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/run/simulation.h"

namespace dartboard::bad_scenes_test {
namespace {

namespace fs = std::filesystem;
const fs::path folder = source_folder() / "tests" / "scenes_bad";

struct BadScene {
  std::string name, exit_code, part, text;
};

std::string unescaped(const std::string& line) {
  std::string text;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] != '\\')
      text += line[k];
    else
      text += line[++k] == 'n' ? '\n' : line[k];
  }
  return text;
}

std::vector<BadScene> bad_scenes() {
  std::vector<BadScene> scenes;
  std::ifstream file(folder / "scenes.txt");
  nlohmann::json base;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (base.is_null()) {
      base = nlohmann::json::parse(line);
      continue;
    }
    std::array<std::string, 3> word;
    for (std::string& w : word) {
      const auto end = line.find(" | ");
      w = line.substr(0, end);
      line.erase(0, end + 3);
    }
    nlohmann::json scene = base;
    const bool whole = line.starts_with("text ");
    if (!whole) scene.merge_patch(nlohmann::json::parse(line));
    scenes.push_back({word[0], word[1], word[2], whole ? unescaped(line.substr(5)) : scene.dump()});
  }
  return scenes;
}

/// The exit code of a command line, and its message.
std::pair<std::string, std::string> answer(const std::string& text) {
  try {
    SceneFile scene = parse_scene(text, "bad.json", folder);
    load_mesh(scene);
    const Simulation simulation(scene);
    return {"0", ""};
  } catch (const InputError& error) {
    return {"2", error.what()};
  } catch (const IoError& error) {
    return {"3", error.what()};
  }
}

TEST(BadScenes, AreEachRefusedWithAMessageThatNamesFileAndKey) {
  const std::vector<BadScene> scenes = bad_scenes();
  EXPECT_GE(scenes.size(), 180u);
  for (const BadScene& scene : scenes) {
    const auto [exit_code, message] = answer(scene.text);
    EXPECT_EQ(exit_code, scene.exit_code) << scene.name << ": " << message;
    EXPECT_NE(message.find(scene.part), std::string::npos)
        << scene.name << "\n  said:     " << message << "\n  expected: " << scene.part;
    EXPECT_EQ(message.rfind("bad.json", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace dartboard::bad_scenes_test
