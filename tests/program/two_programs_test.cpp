// The program of scenes and meshes, which becomes the one that has every verb where it needs to.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "benchmarks/checkout/source_folder.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::two_programs_test {
namespace {

namespace fs = std::filesystem;

class TwoPrograms : public FolderTest {
 protected:
  static Answer harness(const std::string& arguments) { return run_at(program_path() + "-harness", arguments); }
  /// The program of scenes and meshes in a folder where the other one is missing.
  Answer alone(const std::string& arguments) const {
    fs::copy_file(program_path(), folder_ / "dartboard", fs::copy_options::skip_existing);
    return run_at((folder_ / "dartboard").string(), arguments);
  }
  /// A scene that asks for an accuracy.
  std::string scene(const std::string& name) const {
    fs::copy_file(source_folder() / "benchmarks" / "scenes" / "beam_to_accuracy.json", folder_ / name);
    return (folder_ / name).string();
  }
};

TEST_F(TwoPrograms, HaveTheSameHelp) {
  for (const char* arguments : {"--help", "--version", "simulate --help", "mesh --help", "list --help"})
    EXPECT_EQ(run(arguments).out, harness(arguments).out) << arguments;
}

TEST_F(TwoPrograms, RunAVerbOfTheHarnessAlike) {
  const Answer answer = run("list integrators");
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.out, harness("list integrators").out);
  EXPECT_EQ(run("list nothing").status, 2);
}

TEST_F(TwoPrograms, RefuseAVerbThatNeitherHasAlike) {
  const Answer answer = run("simulat");
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.out, harness("simulat").out);
}

TEST_F(TwoPrograms, TheSmallerOneSaysWhereItExpectedTheOther) {
  const std::string file = scene("scene.json");
  for (const std::string& verb :
       {std::string("list"), "simulate " + file + " --out " + (folder_ / "out").string(), "explain " + file}) {
    const Answer answer = alone(verb);
    EXPECT_EQ(answer.status, 3) << verb;
    EXPECT_EQ(answer.out, "dartboard: " + (folder_ / "dartboard-harness").string() +
                              ": is not there; expected the program that has every verb, which ./dartboard build "
                              "builds\n")
        << verb;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(alone("scene --check " + file).status, 0);
}

TEST_F(TwoPrograms, TheScriptThatStartedTheSmallerOneIsAskedForTheOther) {
  std::ofstream(folder_ / "script") << "#!/bin/sh\nprintf '%s,' \"$@\"\n";
  fs::permissions(folder_ / "script", fs::perms::owner_exec, fs::perm_options::add);
  setenv("DARTBOARD_SCRIPT", (folder_ / "script").c_str(), 1);
  EXPECT_EQ(run("list claims").out, "--harness,list,claims,");
  const std::string file = scene("a scene.json");
  EXPECT_EQ(run("simulate '" + file + "' --steps 3").out, "--harness,simulate," + file + ",--steps,3,");
  unsetenv("DARTBOARD_SCRIPT");
}

}  // namespace
}  // namespace dartboard::two_programs_test
