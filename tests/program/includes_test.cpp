// The direction of the architecture, read from the sources: allowed includes between folders.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::includes_test {
namespace {

namespace fs = std::filesystem;

struct Include {
  std::string from, to;  // file relative to the root; the text between quotes or angle brackets
};

std::vector<Include> includes_of_project() {
  const fs::path root = source_folder();
  std::vector<Include> found;
  for (const char* room : {"core", "reference", "validation", "benchmarks"})
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      for (std::string text; std::getline(file, text);) {
        const auto open = text.find_first_of("<\"");
        if (!text.starts_with("#include") || open == std::string::npos) continue;
        found.push_back({fs::relative(entry.path(), root).generic_string(),
                         text.substr(open + 1, text.find_first_of(">\"", open + 1) - open - 1)});
      }
    }
  return found;
}

using Files = std::vector<std::string>;

std::string folder_of(const std::string& file) { return fs::path(file).parent_path().generic_string(); }

// The folders that each may include besides itself, core/plain and core/base, as the CMakeLists.txt of the rooms say: a
// line of them reads "core/views: core/forces core/mechanics".
std::map<std::string, std::set<std::string>> rules() {
  std::map<std::string, std::set<std::string>> seen;
  std::ifstream file(folders_file());
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(line.find(':') + 1));
    auto& folders = seen[line.substr(0, line.find(':'))];
    for (std::string word; words >> word;) folders.insert(word);
  }
  return seen;
}

TEST(Includes, AreFoundAtAll) {
  EXPECT_GT(includes_of_project().size(), 100u);
  EXPECT_GT(rules().size(), 40u);
}

TEST(Includes, GoWhereTheFolderSays) {
  const auto allowed = rules();
  Files wrong;
  for (const auto& [from, to] : includes_of_project()) {
    const std::string here = folder_of(from), there = folder_of(to);
    const bool all_may = there == "core/plain" || (there == "core/base" && !here.starts_with("reference"));
    if (!fs::exists(source_folder() / to) || there == here || all_may) continue;
    const auto rule = allowed.find(here);
    if (rule == allowed.end() || !rule->second.contains(there)) wrong.push_back(from + " includes " + to);
  }
  EXPECT_EQ(wrong, Files{});
}

TEST(Includes, MakeUseOfEachFolderThatMayBeSeen) {
  std::set<std::pair<std::string, std::string>> used;
  for (const auto& [from, to] : includes_of_project()) used.emplace(folder_of(from), folder_of(to));
  Files idle;
  for (const auto& [folder, seen] : rules())
    for (const std::string& other : seen)
      if (!used.contains({folder, other})) idle.push_back(folder + " never includes " + other);
  EXPECT_EQ(idle, Files{});
}

/// Among the folders of one room: those that see another whose name begins otherwise than allowed.
Files strays(const std::string& room, const std::vector<std::string>& allowed) {
  Files found;
  for (const auto& [folder, seen] : rules())
    for (const std::string& other : seen)
      if (folder.starts_with(room) &&
          std::ranges::none_of(allowed, [&](const std::string& begin) { return other.starts_with(begin); }))
        found.push_back(folder + " sees " + other);
  return found;
}

TEST(Rooms, AreIndependentWhereTheHarnessNeedsThemToBe) {
  EXPECT_EQ(strays("core", {"core"}), Files{});
  EXPECT_EQ(strays("reference", {"reference"}), Files{});
  EXPECT_EQ(strays("validation", {"core", "reference", "validation"}), Files{});
}
TEST(Rooms, KeepTheMapOutOfTime) { EXPECT_EQ(strays("core/time", {"core/forces", "core/time"}), Files{}); }
TEST(Rooms, KeepMechanicsOutOfTopology) {
  EXPECT_EQ(strays("core/topology", {"core/topology"}), Files{});
  EXPECT_EQ(strays("core/operations", {"core/topology", "core/operations"}), Files{});
}
TEST(Rooms, LeaveCgalToTwoFolders) {
  Files users;
  for (const auto& [from, to] : includes_of_project())
    if (to.starts_with("CGAL/") && folder_of(from) != "reference/cgal" && folder_of(from) != "validation/cgal")
      users.push_back(from);
  EXPECT_EQ(users, Files{});
}
TEST(Rooms, AreOfASizeThatOneSeesAtAGlance) {
  const fs::path root = source_folder();
  Files large;
  for (const char* room : {"core", "reference", "validation", "benchmarks", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      if (!entry.is_directory()) continue;
      const auto count = std::count_if(fs::directory_iterator(entry.path()), fs::directory_iterator(),
                                       [](const auto& inside) { return inside.is_regular_file(); });
      // the gallery is a list of data that a verb shows, not a room that is searched
      const bool is_list = entry.path() == root / "benchmarks" / "scenes";
      if (count > (is_list ? 40 : 26))
        large.push_back(fs::relative(entry.path(), root).generic_string() + ": " + std::to_string(count));
    }
  EXPECT_EQ(large, Files{});
}

/// Files below `room`, except the `allowed` ones, that contain one of some words.
Files users_of(const std::string& room, const std::vector<std::string>& words, const Files& allowed) {
  const fs::path root = source_folder();
  Files users;
  for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
    const std::string name = fs::relative(entry.path(), root).generic_string();
    if (!entry.is_regular_file() || std::ranges::find(allowed, name) != allowed.end()) continue;
    std::ifstream file(entry.path());
    for (std::string text; std::getline(file, text);)
      for (const std::string& word : words)
        if (text.find(word) != std::string::npos) users.push_back(name + ": " + text);
  }
  return users;
}

/// The sources of core in which a name stands as a word.
Files sources_of_core_with(const std::string& name) {
  const fs::path root = source_folder();
  const std::regex word("(^|[^A-Za-z0-9_])(" + name + ")($|[^A-Za-z0-9_])");
  Files found;
  for (const auto& entry : fs::recursive_directory_iterator(root / "core")) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string text; std::getline(file, text);)
      if (std::regex_search(text, word)) {
        found.push_back(fs::relative(entry.path(), root).generic_string());
        break;
      }
  }
  std::ranges::sort(found);
  return found;
}

// What an author edits in core, by an example of each kind (core/README.md, "To add").
TEST(Additions, OfAForceOfASceneNeedFourSources) {
  EXPECT_EQ(sources_of_core_with("Air|air_kind|Shape::air|scene[.]air|  air,"),
            (Files{"core/scene/file/keys/scene_keys.h", "core/scene/file/scene_file.h", "core/scene/forces/air.cpp",
                   "core/scene/forces/kinds.h"}));
}
TEST(Additions, OfAViewForAForceNeedItselfAndTheForce) {
  EXPECT_EQ(sources_of_core_with("PressedFacesView"),
            (Files{"core/scene/forces/pressures.cpp", "core/views/pressed_faces.cpp", "core/views/pressed_faces.h"}));
}
TEST(Additions, OfAnIntegratorNeedItselfAndItsRow) {
  EXPECT_EQ(sources_of_core_with("Ros2"),
            (Files{"core/time/implicit/ros2.cpp", "core/time/implicit/ros2.h", "core/time/integrators.cpp"}));
}
TEST(Additions, OfAMeshFormatNeedItselfItsDeclarationAndItsCases) {
  EXPECT_EQ(sources_of_core_with("read_off"), (Files{"core/meshes/mesh_io.cpp", "core/meshes/surfaces/off.cpp",
                                                     "core/meshes/surfaces/surface_formats.h"}));
}
TEST(Additions, OfAnEventNeedItsActionItsEventAndTheListsThatACompilerNames) {
  EXPECT_EQ(sources_of_core_with("Release"),
            (Files{"core/scene/body/body_of_parts.cpp", "core/scene/body/events/ready.h",
                   "core/scene/body/events/release_event.cpp", "core/scene/body/needs.cpp",
                   "core/scene/file/actions/action.h", "core/scene/file/actions/release.h",
                   "core/scene/file/scene_problem.cpp", "core/scene/file/scene_rules.cpp", "core/scene/soft_body.h"}));
}

// Printed text and JSON have been made harmless on their way; nothing goes through a shell.
TEST(Sources, PrintThroughTellAlone) {
  EXPECT_EQ(users_of("benchmarks", {"fmt::print(", "std::cout <<", "std::cerr", "printf(", "fputs("},
                     {"benchmarks/harness/tell.h", "benchmarks/harness/progress.cpp"}),
            Files{});
  for (const char* room : {"core", "reference", "validation"})
    EXPECT_EQ(users_of(room, {"fmt::print(", "std::cout", "std::cerr", " printf("}, {}), Files{}) << room;
}
TEST(Sources, WriteJsonThroughJsonTextAlone) {
  // for numbers, and for scenes made in memory
  EXPECT_EQ(users_of("benchmarks", {".dump("},
                     {"benchmarks/harness/json_text.h", "benchmarks/studies/contact/contact_costs.cpp",
                      "benchmarks/studies/scenes/ablation_study.cpp"}),
            Files{});
}
TEST(Sources, StartNoShell) {
  for (const char* room : {"core", "reference", "validation", "benchmarks"})
    EXPECT_EQ(users_of(room, {"popen(", "std::system(", " system(\"", "\"/bin/sh\"", "\"sh\""}, {}), Files{}) << room;
}

// The formatter joins a tag to the sentence before it where no empty line stands between them.
TEST(Sources, HaveEachTagOfADocstringOnALineOfItsOwn) {
  for (const char* room : {"core", "reference", "validation", "benchmarks"})
    EXPECT_EQ(users_of(room, {". cost  ", ". pre  ", ". throws  ", ". returns  ", ". source  "}, {}), Files{}) << room;
}

}  // namespace
}  // namespace dartboard::includes_test
