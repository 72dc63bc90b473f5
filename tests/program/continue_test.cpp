// A run continued by the program: every file in its folder is that of one run.

#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/folder_for_tests.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::continue_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Some seconds of steps, so that there is time to interrupt them.
json eventful_scene() {
  return json::parse(R"({"name": "eventful", "integrator": "bdf2", "step": 0.001, "duration": 0.4,
    "body": {"generate": {"box": {"cells": [3, 3, 3], "spacing": 0.1}}},
    "fixed": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}],
    "events": [{"every": 0.01, "remove": {"random": {"count": 1}}, "until": 0.3},
               {"at": 0.03, "dissociate": {"plane": {"point": [0.15, 0, 0], "normal": [1, 0, 0]}}}],
    "output": {"frames_every": 0.05, "diagnostics_every": 0.02, "checkpoint": 0.1,
               "probes": [{"name": "top", "near": [0.3, 0.3, 0.3]}]}})");
}

class Continue : public FolderTest {
 protected:
  void leave_scene(const json& scene) const { std::ofstream(folder_ / "scene.json") << scene.dump(); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// The files of a run that do not depend on when and how it ran.
  std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_ / out))
      files[entry.path().filename().string()] = contents(entry.path());
    files.erase("manifest.json");
    json summary = json::parse(files.at("summary.json"));
    for (const char* key : {"wall_s", "cpu_s", "folder"}) summary.erase(key);
    files["summary.json"] = summary.dump();
    return files;
  }
  void expect_same_results(const std::string& one, const std::string& other) const {
    const auto a = results(one), b = results(other);
    for (const auto& [name, text] : a) EXPECT_TRUE(b.contains(name) && b.at(name) == text) << name;
    EXPECT_EQ(a.size(), b.size());
  }
  /// Interrupts the run as soon as a file is there.
  int interrupted_at(const std::string& file, const std::string& out) const {
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGINT, SIG_DFL);
      (void)!freopen("/dev/null", "w", stdout);
      (void)!freopen("/dev/null", "w", stderr);
      execl(program_path().c_str(), program_path().c_str(), "simulate", path("scene.json").c_str(), "--seed", "5",
            "--out", path(out).c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    while (!fs::exists(folder_ / out / file) && waitpid(child, &status, WNOHANG) == 0) usleep(200);
    kill(child, SIGINT);
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(Continue, LeavesTheFilesOfOneRun) {
  leave_scene(eventful_scene());
  ASSERT_EQ(run("simulate " + path("scene.json") + " --seed 5 --out " + path("one")).status, 0);
  const Answer first = run("simulate " + path("scene.json") + " --seed 5 --steps 137 --out " + path("two"));
  ASSERT_EQ(first.status, 0) << first.out;
  EXPECT_NE(first.out.find("From its checkpoint of step 137 the run goes on with: dartboard simulate --continue " +
                           path("two")),
            std::string::npos)
      << first.out;
  const Answer second = run("simulate --continue " + path("two"));
  EXPECT_EQ(second.status, 0) << second.out;
  expect_same_results("one", "two");
  const json manifest = json::parse(text("two/manifest.json"));
  ASSERT_EQ(manifest.at("continued").size(), 1u);
  EXPECT_EQ(manifest.at("seeds").size(), 1u);
  EXPECT_TRUE(manifest.contains("finished"));
}

// Wherever the signal arrives; without the key it leaves a checkpoint too, unless a step had just got a new factor.
TEST_F(Continue, GoesOnWhereARunWasInterrupted) {
  json scene = eventful_scene();
  scene["integrator"] = "rk4";
  scene["step"] = 0.00005;
  scene["output"].erase("checkpoint");
  leave_scene(scene);
  ASSERT_EQ(run("simulate " + path("scene.json") + " --seed 5 --out " + path("one")).status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "one" / "checkpoint")) << "it was not interrupted";
  // on a busy machine a run may be over before the signal arrives
  for (int attempt = 0; attempt < 20 && interrupted_at("frame_000001.vtu", "two") != 130; ++attempt)
    fs::remove_all(folder_ / "two");
  ASSERT_TRUE(fs::exists(folder_ / "two" / "checkpoint"));
  const Answer answer = run("simulate --continue " + path("two"));
  EXPECT_EQ(answer.status, 0) << answer.out;
  fs::remove(folder_ / "two" / "checkpoint");
  expect_same_results("one", "two");
}

TEST_F(Continue, RefusesARunThatIsOver) {
  leave_scene(eventful_scene());
  ASSERT_EQ(run("simulate " + path("scene.json") + " --seed 5 --out " + path("one")).status, 0);
  const auto before = results("one");
  const Answer answer = run("simulate --continue " + path("one"));
  EXPECT_EQ(answer.status, 2);
  EXPECT_NE(answer.out.find("the run has come to its end, after 400 steps"), std::string::npos) << answer.out;
  EXPECT_EQ(results("one"), before);
}

TEST_F(Continue, RefusesAChangedSceneADamagedCheckpointAndNoFolder) {
  leave_scene(eventful_scene());
  ASSERT_EQ(run("simulate " + path("scene.json") + " --quick --out " + path("two")).status, 0);
  json other = eventful_scene();
  other["gravity"] = {0, 0, -1};
  leave_scene(other);
  const Answer changed = run("simulate --continue " + path("two"));
  EXPECT_EQ(changed.status, 2);
  EXPECT_NE(changed.out.find(path("scene.json") + ": has changed since"), std::string::npos) << changed.out;
  leave_scene(eventful_scene());
  fs::resize_file(folder_ / "two" / "checkpoint", 1000);
  const Answer damaged = run("simulate --continue " + path("two"));
  EXPECT_EQ(damaged.status, 3);
  EXPECT_NE(damaged.out.find(path("two/checkpoint") + ": is cut short"), std::string::npos) << damaged.out;
  const Answer nowhere = run("simulate --continue " + path("nowhere"));
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_NE(nowhere.out.find("there is no such folder"), std::string::npos) << nowhere.out;
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(Continue, TakesASceneOrAFolder) {
  leave_scene(eventful_scene());
  EXPECT_EQ(run("simulate").status, 2);
  EXPECT_EQ(run("simulate " + path("scene.json") + " --continue " + path("two")).status, 2);
  EXPECT_EQ(run("simulate --continue " + path("two") + " --out " + path("three")).status, 2);
}

}  // namespace
}  // namespace dartboard::continue_test
