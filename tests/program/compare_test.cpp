// Two runs compared by the program.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/folder_for_tests.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::compare_test {
namespace {

using nlohmann::json;

/// A box that falls freely: by Verlet exactly, by symplectic Euler by g h t / 2 further.
class CompareScenes : public FolderTest {
 protected:
  void simulate(const std::string& name, const std::string& integrator, json more = json::object()) const {
    json scene = json::parse(R"({"name": "falling", "step": 0.01, "duration": 0.1, "gravity": [0, 0, -10],
      "material": {"density": 1000, "stiffness": 20, "damping": 0, "viscosity": 0},
      "body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.5}}},
      "output": {"frames_every": 0.02, "diagnostics_every": 0.02}})");
    scene["integrator"] = integrator;
    scene.update(more);
    std::ofstream(folder_ / (name + ".json")) << scene.dump();
    ASSERT_EQ(run("simulate '" + path(name + ".json") + "' --out '" + path(name) + "'", "2>&1").status, 0);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Answer compare(const std::string& more = "") const {
    return run("compare '" + path("a") + "' '" + path("b") + "' " + more, "2>/dev/null");
  }
};

TEST_F(CompareScenes, FindTheSameBitsInTwoRunsOfOneScene) {
  simulate("a", "verlet");
  simulate("b", "verlet");
  const Answer same = compare();
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_NE(same.out.find("bit for bit, at 6 times"), std::string::npos) << same.out;
}

// g h t / 2 is 5 mm after 0.1 s, where an edge is 0.5 m long: 0.01 edges.
TEST_F(CompareScenes, SayWhenAndHowFarTwoIntegratorsPartAndWhichKeyDiffers) {
  simulate("a", "verlet");
  simulate("b", "symplectic-euler");
  const Answer apart = compare("--json");
  EXPECT_EQ(apart.status, 1);
  const json found = json::parse(apart.out);
  ASSERT_EQ(found["distances"].size(), 6U);
  EXPECT_NEAR(found["edge"].get<double>(), 0.5, 0.21) << "edges of a cube cut in tetrahedra, or its diagonals";
  const double edge = found["edge"].get<double>();
  for (const json& d : found["distances"])
    EXPECT_NEAR(d["largest"].get<double>() * edge, 0.05 * d["time"].get<double>(), 1e-13);
  bool named = false;
  for (const json& s : found["settings"])
    named = named ||
            (s["path"] == "/scene/integrator" && s["first"] == "\"verlet\"" && s["second"] == "\"symplectic-euler\"");
  EXPECT_TRUE(named) << found["settings"].dump(1);
  EXPECT_EQ(compare("--within 0.02").status, 0);
}

// They are quoted in the header of their file.
TEST_F(CompareScenes, TakeProbesWithCommasAndQuotesInTheirNames) {
  const json probes = json::parse(R"json({"output": {"frames_every": 0.05,
    "probes": [{"name": "tip, \"left\"", "near": [0, 0, 0]}]}})json");
  simulate("a", "verlet", probes);
  simulate("b", "symplectic-euler", probes);
  const Answer apart = compare();
  EXPECT_EQ(apart.status, 1) << apart.out;
  EXPECT_NE(apart.out.find("tip, "), std::string::npos) << apart.out;
}

TEST_F(CompareScenes, SayFromWhenOnCellsAreOthers) {
  simulate("a", "verlet");
  simulate("b", "verlet", {{"events", json::parse(R"([{"at": 0.03, "remove": {"random": {"count": 1}}}])")}});
  const json found = json::parse(compare("--json").out);
  EXPECT_EQ(found["cells_part"], 0.04);
  EXPECT_EQ(found["distances"].size(), 2U);
}

TEST_F(CompareScenes, RefuseFoldersOfTwoKindsAndDamagedOnes) {
  simulate("a", "verlet");
  simulate("b", "verlet");
  std::ofstream(folder_ / "b" / "diagnostics.csv", std::ios::app) << "0.12,3\n";
  Answer refused = run("compare '" + path("a") + "' '" + path("b") + "'", "2>&1");
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.out.find("diagnostics.csv:8: has 2 numbers"), std::string::npos) << refused.out;
  refused = run("compare '" + path("a") + "' '" + path("none") + "'", "2>&1");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.out.find("is none; expected two of one kind"), std::string::npos) << refused.out;
}

class CompareStudies : public FolderTest {};

TEST_F(CompareStudies, FindNothingInOneRunAndAClaimThatIsAnsweredOtherwise) {
  const std::string a = (folder_ / "a").string(), b = (folder_ / "b").string();
  ASSERT_EQ(run("reproduce --quick --part larger --out '" + a + "'", "2>/dev/null").status, 0);
  std::filesystem::copy(a, b, std::filesystem::copy_options::recursive);
  Answer answer = run("compare '" + a + "' '" + b + "'", "2>&1");
  EXPECT_EQ(answer.status, 0) << answer.out;
  std::string findings = text("b/findings.json");
  const std::size_t at = findings.find("\"verdict\": \"");
  ASSERT_NE(at, std::string::npos);
  findings.replace(at, findings.find('"', at + 12) + 1 - at, "\"verdict\": \"falls short\"");
  std::ofstream(folder_ / "b" / "findings.json") << findings;
  answer = run("compare '" + a + "' '" + b + "' --json", "2>/dev/null");
  EXPECT_EQ(json::parse(answer.out)["claims"].size(), 1U) << answer.out;
}

}  // namespace
}  // namespace dartboard::compare_test
