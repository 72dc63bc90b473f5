#include "benchmarks/harness/manifest.h"

#include <cholmod.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Core>
#include <array>
#include <boost/version.hpp>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/processes.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::manifest_test {
namespace {

namespace fs = std::filesystem;

class ManifestTest : public FolderTest {
 protected:
  fs::path file_with(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  void git(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"-C", folder_.string(), "-c", "user.name=T", "-c", "user.email=t@example.org"});
    run_program(
        "git", arguments, [](std::string_view) {}, Stderr::discarded);
  }
};

/// The first string anywhere in `json` that is, or contains as a word, an absolute path; empty if there is none.
std::string absolute_path_in(const nlohmann::json& json) {
  if (json.is_string()) {
    const std::string text = " " + json.get<std::string>();
    const bool found = text.find(" /") != text.npos || text.find("=/") != text.npos || text.find("-I/") != text.npos;
    return found ? text : "";
  }
  if (json.is_structured())
    for (const auto& part : json)
      if (std::string found = absolute_path_in(part); !found.empty()) return found;
  return "";
}

// The reference values of the published FNV-1a test suite for "" and "a".
TEST_F(ManifestTest, HashesTheBytesOfAFile) {
  EXPECT_EQ(file_hash(file_with("empty", "")), "fnv1a64:cbf29ce484222325");
  EXPECT_EQ(file_hash(file_with("letter", "a")), "fnv1a64:af63dc4c8601ec8c");
}

TEST_F(ManifestTest, HashesFilesLongerThanOneBlock) {
  const std::string block(70000, 'x');
  EXPECT_NE(file_hash(file_with("one", block + "1")), file_hash(file_with("other", block + "2")));
}

TEST_F(ManifestTest, RefusesToHashWhatCannotBeRead) {
  EXPECT_THROW(file_hash(folder_ / "missing"), IoError);
  EXPECT_THROW(file_hash(folder_), IoError);
}

TEST_F(ManifestTest, KnowsItsRun) {
  const fs::path mesh = file_with("body.mesh", "a");
  const auto manifest = begin_manifest({.command_line = {"/opt/bin/dartboard", "reproduce", "--out=/srv/private/run"},
                                        .seeds = {{"order", 42}},
                                        .libraries = {{"CGAL", "5.5.1"}},
                                        .input_files = {mesh}});
  EXPECT_EQ(manifest.at("command_line"), (nlohmann::json{"dartboard", "reproduce", "--out=run"}));
  EXPECT_EQ(manifest.at("seeds").at("order"), 42);
  EXPECT_EQ(manifest.at("libraries").at("CGAL"), "5.5.1");
  EXPECT_TRUE(manifest.at("libraries").contains("Eigen"));
  EXPECT_EQ(manifest.at("inputs").at(0).at("file"), "body.mesh");
  EXPECT_EQ(manifest.at("inputs").at(0).at("hash"), "fnv1a64:af63dc4c8601ec8c");
}

TEST_F(ManifestTest, HasTheVersionsThatTheHeadersOfLibrariesGive) {
  const auto libraries = begin_manifest({}).at("libraries");
  const auto parts = [&](const char* name) {
    int major = -1, minor = -1, patch = -1;
    const auto version = libraries.at(name).get<std::string>();
    EXPECT_EQ(std::sscanf(version.c_str(), "%d.%d.%d", &major, &minor, &patch), 3) << name << " " << version;
    return std::array{major, minor, patch};
  };
  const auto boost = parts("Boost"), fmt_ = parts("fmt"), eigen = parts("Eigen"), json = parts("nlohmann-json"),
             cholmod = parts("CHOLMOD"), suite_sparse = parts("SuiteSparse");
  EXPECT_EQ(100000 * boost[0] + 100 * boost[1] + boost[2], BOOST_VERSION);
  EXPECT_EQ(10000 * fmt_[0] + 100 * fmt_[1] + fmt_[2], FMT_VERSION);
  EXPECT_EQ(eigen, (std::array{EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION}));
  EXPECT_EQ(json, (std::array{NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH}));
  // the loaded library reports its version, too
  std::array<int, 3> loaded{};
  const int code = cholmod_version(loaded.data());
  EXPECT_EQ(code, CHOLMOD_VER_CODE(loaded[0], loaded[1]));
  EXPECT_EQ(cholmod, loaded);
  EXPECT_EQ(SUITESPARSE_VER_CODE(suite_sparse[0], suite_sparse[1]), SUITESPARSE_VERSION);
  EXPECT_EQ(suite_sparse[2], SUITESPARSE_SUBSUB_VERSION);
}

TEST_F(ManifestTest, NamesTheProcessorAsTheSystemDoes) {
  std::vector<std::string> models;
  run_program("sed", {"-n", "s/^model name[^:]*: //p", "/proc/cpuinfo"},
              [&](std::string_view line) { models.emplace_back(line); });
  const auto cpu = begin_manifest({}).at("machine").at("cpu");
  if (models.empty())
    EXPECT_TRUE(cpu.is_null());
  else
    EXPECT_EQ(cpu, models[0]);
}

TEST_F(ManifestTest, NamesTheLibraryOfAFunction) {
  const auto library = library_of(reinterpret_cast<const void*>(&::getpid));
  ASSERT_TRUE(library);
  EXPECT_NE(library->find("/libc"), std::string::npos) << *library;
  EXPECT_NE(library->front(), '/');
  EXPECT_FALSE(library_of(nullptr));
  const int here = 0;
  EXPECT_FALSE(library_of(&here));
}

TEST_F(ManifestTest, NamesNoAbsolutePath) {
  auto manifest = begin_manifest(
      {.command_line = {"/opt/bin/dartboard", folder_.string()}, .input_files = {file_with("body.mesh", "a")}});
  finish_manifest(manifest);
  EXPECT_EQ(absolute_path_in(manifest), "");
}

TEST_F(ManifestTest, HasEveryFactEvenWhereItIsUnknown) {
  auto manifest = begin_manifest({});
  finish_manifest(manifest);
  for (const char* pointer :
       {"/dartboard", "/git/commit", "/git/dirty", "/build/compiler", "/build/flags", "/build/type", "/blas/name",
        "/blas/threads", "/machine/cpu", "/machine/cores", "/machine/caches", "/machine/governor", "/machine/kernel",
        "/started/utc", "/started/load_average", "/finished/utc", "/finished/load_average"})
    EXPECT_TRUE(manifest.contains(nlohmann::json::json_pointer(pointer))) << pointer;
}

TEST_F(ManifestTest, PublishesCommandsWithoutPathsOfTheMachine) {
  EXPECT_EQ(published_command("-O3 -I/opt/include -isystem /usr/include/eigen3 --out=/srv/run"),
            "-O3 -Iinclude -isystem eigen3 --out=run");
  EXPECT_EQ(published_command("km/h a/b -DX=1/2"), "km/h a/b -DX=1/2");
  EXPECT_EQ(published_path(fs::current_path() / "meshes" / "body.mesh"), published_path("meshes/body.mesh"));
  EXPECT_EQ(published_path("/srv/private/folder/"), "folder");
}

TEST_F(ManifestTest, ReportsNoCommitOutsideARepository) {
  EXPECT_TRUE(git_state(folder_ / "missing").at("commit").is_null());
}

TEST_F(ManifestTest, ReportsCommitAndChangesButNotResults) {
  git({"init", "--quiet"});  // set-up installs it
  file_with("source.cpp", "int x;");
  git({"add", "."});
  git({"commit", "--quiet", "-m", "first"});
  fs::create_directories(folder_ / "results" / "run");
  file_with("results/run/manifest.json", "{}");
  const auto clean = git_state(folder_);
  EXPECT_EQ(clean.at("commit").get<std::string>().size(), 40u);
  EXPECT_EQ(clean.at("dirty"), false);

  file_with("source.cpp", "int y;");
  EXPECT_EQ(git_state(folder_).at("dirty"), true);

  // sources unpacked inside another repository have no commit of their own
  EXPECT_TRUE(git_state(folder_ / "results").at("commit").is_null());
}

}  // namespace
}  // namespace dartboard::manifest_test
