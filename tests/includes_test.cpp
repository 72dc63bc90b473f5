// The direction of the architecture, read from the sources: who may include whom.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string from, to;  // file relative to the root; the text between quotes or angle brackets
};

std::vector<Include> includes_of_project() {
  const fs::path root = DARTBOARD_SOURCE_DIR;
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

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  for (const auto& prefix : prefixes)
    if (text.starts_with(prefix)) return true;
  return false;
}

// Ours that files below `room` include, but those that start with one of `allowed`.
std::vector<std::string> forbidden(const std::string& room, const std::vector<std::string>& allowed) {
  static const auto all = includes_of_project();
  std::vector<std::string> wrong;
  for (const auto& [from, to] : all)
    if (from.starts_with(room) &&
        starts_with_any(to, {"core/", "reference/", "validation/", "benchmarks/", "tests/", "CGAL/"}) &&
        !starts_with_any(to, allowed))
      wrong.push_back(from + " includes " + to);
  return wrong;
}

using Files = std::vector<std::string>;

TEST(Includes, AreFoundAtAll) { EXPECT_GT(includes_of_project().size(), 100u); }
TEST(Includes, OfThePlainTypesStayAmongThem) { EXPECT_EQ(forbidden("core/plain/", {"core/plain/"}), Files{}); }
TEST(Includes, OfMeshesSeeThePlainTypesOnly) {
  EXPECT_EQ(forbidden("core/meshes/", {"core/plain/", "core/meshes/"}), Files{});
}
TEST(Includes, OfTopologyKnowNoMechanics) {
  EXPECT_EQ(forbidden("core/topology/", {"core/plain/", "core/topology/"}), Files{});
}
TEST(Includes, OfOperationsSeeTopologyOnly) {
  EXPECT_EQ(forbidden("core/operations/", {"core/plain/", "core/topology/", "core/operations/"}), Files{});
}
TEST(Includes, OfCoreNeverReachReferenceOrCgal) { EXPECT_EQ(forbidden("core/", {"core/"}), Files{}); }
TEST(Includes, OfReferenceShareOnlyPlainTypesWithCore) {
  EXPECT_EQ(forbidden("reference/", {"core/plain/", "reference/", "CGAL/"}), Files{});
}
TEST(Includes, OfValidationDoNotReachTheCommandLine) {
  EXPECT_EQ(forbidden("validation/", {"core/", "reference/", "validation/", "CGAL/"}), Files{});
}
TEST(Includes, OfBenchmarksLeaveCgalToTheOthers) {
  EXPECT_EQ(forbidden("benchmarks/", {"core/", "reference/", "validation/", "benchmarks/"}), Files{});
}

/// Files below `room` but the `allowed` ones that hold one of some words.
Files users_of(const std::string& room, const std::vector<std::string>& words, const Files& allowed) {
  const fs::path root = DARTBOARD_SOURCE_DIR;
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

// What is printed, and what is written as JSON, has been made harmless on its way; nothing goes through a shell.
TEST(Sources, PrintThroughTellAlone) {
  EXPECT_EQ(users_of("benchmarks", {"fmt::print(", "std::cout <<", "std::cerr", "printf(", "fputs("},
                     {"benchmarks/tell.h", "benchmarks/progress.cpp"}),
            Files{});
  for (const char* room : {"core", "reference", "validation"})
    EXPECT_EQ(users_of(room, {"fmt::print(", "std::cout", "std::cerr", " printf("}, {}), Files{}) << room;
}
TEST(Sources, WriteJsonThroughJsonTextAlone) {
  // of numbers, and of a scene made in memory
  EXPECT_EQ(users_of("benchmarks", {".dump("},
                     {"benchmarks/json_text.h", "benchmarks/settle_accuracy.cpp", "benchmarks/ablation_study.cpp"}),
            Files{});
}
TEST(Sources, StartNoShell) {
  for (const char* room : {"core", "reference", "validation", "benchmarks"})
    EXPECT_EQ(users_of(room, {"popen(", "std::system(", " system(\"", "\"/bin/sh\"", "\"sh\""}, {}), Files{}) << room;
}

}  // namespace
