// The folder of an earlier run is emptied only if it holds nothing else.

#include "benchmarks/cli/scenes/earlier_run.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/base/folder_claim.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::earlier_run_test {
namespace {

class EarlierRun : public FolderTest {
 protected:
  void put(const std::string& name, const std::string& text = "x") { std::ofstream(folder_ / name) << text; }
  void put_run() {
    put("manifest.json", R"({"dartboard": "0.1.0"})");
    for (const char* name :
         {"summary.json", "frames.pvd", "frame_000000.vtu", "diagnostics.csv", "probes.csv", "checkpoint",
          "picture.png", "picture.svg", "picture.gnuplot", "picture.dat", "film.gif", "picture_from_step_20.png"})
      put(name);
  }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) found.insert(entry.path().filename());
    return found;
  }
  void expect_refused(const std::string& why, const std::vector<std::filesystem::path>& inputs = {}) {
    const auto before = names();
    try {
      empty_run_folder(folder_, inputs);
      ADD_FAILURE() << "emptied";
    } catch (const IoError& error) {
      EXPECT_EQ(error.what(),
                folder_.string() + ": " + why + "; expected the folder of a run to replace, and nothing else in it");
    }
    EXPECT_EQ(names(), before);
  }
};

TEST_F(EarlierRun, LeavesAnEmptyFolder) {
  put_run();
  ASSERT_TRUE(is_run_folder(folder_));
  empty_run_folder(folder_);
  EXPECT_EQ(names(), std::set<std::string>{});
  EXPECT_FALSE(is_run_folder(folder_));
}

TEST_F(EarlierRun, MayBeMissing) {
  empty_run_folder(folder_);
  empty_run_folder(folder_ / "none");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
}

TEST_F(EarlierRun, KeepsAFileThatTheNewRunReads) {
  put_run();
  expect_refused("has 'frame_000000.vtu', which the new run reads",
                 {folder_ / "none.mesh", folder_ / ".." / folder_.filename() / "frame_000000.vtu"});
}

TEST_F(EarlierRun, HasAManifestOfThisProgram) {
  put("diagnostics.csv");
  expect_refused("has no manifest of a run");
  put("manifest.json", R"({"name": "another program"})");
  expect_refused("has no manifest of a run");
  put("manifest.json", "[");
  expect_refused("has no manifest of a run");
}

TEST_F(EarlierRun, IsKeptWholeIfItHoldsAnythingElse) {
  put_run();
  for (const char* name : {"notes.txt", "frame_1.stl", "picture.txt", "scene.json"}) {
    put(name);
    expect_refused("has '" + std::string(name) + "'");
    std::filesystem::remove(folder_ / name);
  }
  std::filesystem::create_directory(folder_ / "frame_.vtu");
  expect_refused("has 'frame_.vtu'");
  std::filesystem::remove(folder_ / "frame_.vtu");
  std::filesystem::create_symlink("/dev/null", folder_ / "picture.png.svg");
  std::filesystem::rename(folder_ / "picture.png.svg", folder_ / "film.png");
  expect_refused("has 'film.png'");
}

TEST_F(EarlierRun, IsKeptWhileItIsInUse) {
  put_run();
  const FolderClaim claim = FolderClaim::of_ended_run(folder_);
  EXPECT_THROW(empty_run_folder(folder_), IoError);
  EXPECT_EQ(names().size(), 13u);
}

}  // namespace
}  // namespace dartboard::earlier_run_test
