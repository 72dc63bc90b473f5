// What `recommend` and `simulate --picture` say of scenes and options that cannot be what was meant.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/folder_for_tests.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::advice_test {
namespace {

class AdviceOfPrograms : public FolderTest {
 protected:
  std::string scene(const std::string& more) {
    std::ofstream(folder_ / "scene.json")
        << R"({"name": "box", "body": {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}},
               "material": {"density": 1000, "young": 20000}, "duration": 0.1, )"
        << more << "}";
    return (folder_ / "scene.json").string();
  }
};

TEST_F(AdviceOfPrograms, NamesTheKeyForWhichSimulateRefusesAScene) {
  const std::string file = scene(R"("gravity": [0, 0, -1e300], "step": 0.001)");
  for (const std::string& command : {"simulate " + file, "recommend " + file + " --error 1e-3"}) {
    const Answer answer = run(command);
    EXPECT_EQ(answer.status, 2) << command;
    EXPECT_NE(answer.out.find("/gravity: is 1e+300, and energies or forces at the start are not finite"),
              std::string::npos)
        << answer.out;
  }
}

TEST_F(AdviceOfPrograms, BeginsWithTheWarningsOfARunButForThoseOfTheStep) {
  const std::string file = scene(R"("contact": {"pressure": 100, "depth": 0.01, "obstacles":
      [{"plane": {"point": [0, 0, 0.001], "normal": [0, 0, 1]}}]}, "step": 0.1)");
  const Answer answer = run("recommend " + file + " --error 1");
  EXPECT_EQ(answer.out.rfind("warning: ", 0), 0u) << answer.out;
  EXPECT_NE(answer.out.find(" inside obstacles at the start, the deepest vertex "), std::string::npos) << answer.out;
  EXPECT_GT(answer.out.find("a step of"), answer.out.find("short runs")) << answer.out;  // an advice, further below
  EXPECT_NE(run("simulate " + file).out.find("a step of"), std::string::npos);
}

TEST_F(AdviceOfPrograms, RefusesColoursOfNoPictureAndColoursThatAreNoQuantity) {
  const std::string file = scene(R"("gravity": [0, 0, 0], "step": 0.001)"),
                    out = " --out " + (folder_ / "out").string();
  const Answer alone = run("simulate " + file + out + " --colour speed");
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.out.find("--colour requires --picture or --film"), std::string::npos) << alone.out;
  const Answer unknown = run("simulate " + file + out + " --picture --colour heat");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.out.find("heat"), std::string::npos) << unknown.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  EXPECT_EQ(run("simulate " + file + out + " --picture --colour speed").status, 0);
}

TEST_F(AdviceOfPrograms, DrawsTheTimesAskedForFromTheDirectionAskedFor) {
  const std::string simulate = "simulate " + scene(R"("gravity": [0, 0, 0], "step": 0.001)") + " --out " +
                               (folder_ / "out").string() + " --picture";
  for (const auto& [wrong, said] :
       {std::pair("--times 0.05,0.2", "--times 0.05,0.2: 0.2 is not a time of the run, from 0 to 0.1 s"),
        {"--times -1", "--times -1: -1 is not a time of the run"},
        {"--seen-from 0,0,0", "--seen-from: expected three finite numbers, not all 0"},
        {"--seen-from 1,2", "--seen-from"}}) {
    const Answer answer = run(simulate + " " + wrong);
    EXPECT_EQ(answer.status, 2) << wrong;
    EXPECT_NE(answer.out.find(said), std::string::npos) << answer.out;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  ASSERT_EQ(run(simulate + " --times 0.05,0.01 --seen-from -1,0,0").status, 0);
  const std::string script = text("out/picture.gnuplot");
  EXPECT_NE(script.find("t = 0.01 s"), std::string::npos) << script;
  EXPECT_NE(script.find("t = 0.05 s"), std::string::npos) << script;
  EXPECT_EQ(script.find("t = 0 s"), std::string::npos) << script;
}

}  // namespace
}  // namespace dartboard::advice_test
