#include "core/scene/run/probes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/plain/error.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/run/scene_run.h"
#include "tests/support/moving_box.h"

namespace dartboard::probes_test {
namespace {

using namespace moving;

Json probed(const char* probes) {
  Json scene = moving_box();
  scene["output"]["probes"] = Json::parse(probes);
  return scene;
}

struct Rows : RunWatcher {
  std::vector<ProbeRow> rows;
  std::vector<double> diagnosed;
  void probes(const ProbeRow& row) override { rows.push_back(row); }
  void diagnostics(const Diagnostics& d) override { diagnosed.push_back(d.time); }
  std::vector<double> times() const {
    std::vector<double> all;
    for (const ProbeRow& row : rows) all.push_back(row.time);
    return all;
  }
};

Rows rows_of(const Json& json) {
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  Rows rows;
  run_scene(simulation, scene.output, rows);
  return rows;
}

TEST(Probes, ReadPointsOfTheMeshOrTheNearestToAPlace) {
  const Rows rows = rows_of(probed(R"([{"name": "a", "vertex": 26}, {"name": "b", "near": [0.01, 0.02, 0.2]}])"));
  EXPECT_EQ(rows.rows.front().probes.at(0)->position, Eigen::Vector3d(0.25, 0.25, 0.25));
  EXPECT_EQ(rows.rows.front().probes.at(1)->position, Eigen::Vector3d(0, 0, 0.25));
  // v = linear (x - centre), moving_box.h
  EXPECT_EQ(rows.rows.front().probes.at(1)->velocity, Eigen::Vector3d(0.125, -0.3125, -0.125));
}

TEST(SceneRun, EndsAfterTheStepInWhichItIsInterruptedAndHandsThatStateOut) {
  struct Impatient : Rows {
    int asked = 0;
    bool interrupts() override { return ++asked == 3; }
  };
  const SceneFile scene = parse(probed(R"([{"name": "a", "vertex": 0}])"));
  Simulation simulation(scene);
  Impatient rows;
  const RunResult result = run_scene(simulation, scene.output, rows);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(simulation.steps_done(), 3u);
  EXPECT_EQ(rows.diagnosed, (std::vector<double>{0, 0.003}));
  EXPECT_EQ(rows.times(), (std::vector<double>{0, 0.003}));
}

TEST(Probes, TakeTheLowestOfTwoPointsThatAreAsNear) {
  // half-way between neighbours along x: points are numbered x + 3 y + 9 z, the vertices of the body in another order
  Json scene = probed("[]");
  std::vector<Eigen::Vector3d> lowest;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 2; ++x) {
        lowest.emplace_back(0.125 * x, 0.125 * y, 0.125 * z);
        scene["output"]["probes"].push_back(
            {{"name", std::to_string(lowest.size())}, {"near", {0.125 * x + 0.0625, 0.125 * y, 0.125 * z}}});
      }
  const ProbeRow row = Simulation(parse(scene)).probes();
  for (std::size_t k = 0; k < lowest.size(); ++k) EXPECT_EQ(row.probes[k]->position, lowest[k]) << k;
}

TEST(Probes, AreRecordedWithTheDiagnosticsOrAtTimesOfTheirOwn) {
  Json scene = probed(R"([{"name": "a", "vertex": 0}])");
  scene["output"]["diagnostics_every"] = 0.004;
  const Rows together = rows_of(scene);
  EXPECT_EQ(together.times(), (std::vector<double>{0, 0.004, 0.008, 0.01}));
  scene["output"]["probes_every"]["steps"] = 5;
  const Rows apart = rows_of(scene);
  EXPECT_EQ(apart.times(), (std::vector<double>{0, 0.005, 0.01}));
  EXPECT_EQ(apart.diagnosed, together.diagnosed);
}

TEST(Probes, FollowTheirVertexWhenNumbersMove) {
  // Cells disappear until few are left. A probe is a vertex of its mesh point, and moves by at most its velocity times
  // the step, a hundredth of the distance between points.
  Json scene = probed("[]");
  for (int p = 0; p < 27; ++p) scene["output"]["probes"].push_back({{"name", std::to_string(p)}, {"vertex", p}});
  scene["events"] = Json::parse(R"([{"every": 0.001, "remove": {"random": {"count": 4, "seed": 3}}}])");
  Simulation simulation(parse(scene));
  ProbeRow before = simulation.probes();
  std::size_t renumbered = 0, gone = 0;
  std::vector<std::uint32_t> first(simulation.body().tracked().begin(), simulation.body().tracked().end());
  for (int n = 0; n < 10; ++n) {
    simulation.advance();
    const VertexColumns& v = simulation.body().vertices();
    const ProbeRow row = simulation.probes();
    gone = renumbered = 0;
    for (std::uint32_t p = 0; p < 27; ++p) {
      const std::uint32_t k = simulation.body().tracked()[p];
      if (k == SimulatedBody::no_vertex) {
        ++gone;
        EXPECT_FALSE(row.probes[p]);
        continue;
      }
      ASSERT_LT(k, v.size());
      EXPECT_EQ(v.point[k], p);
      ASSERT_TRUE(before.probes[p]) << "what is removed does not come back";
      EXPECT_LT((row.probes[p]->position - before.probes[p]->position).norm(), 0.00125);
      renumbered += k != first[p];
    }
    before = row;
  }
  EXPECT_GT(gone, 3u);
  EXPECT_LT(gone, 27u);
  EXPECT_GT(renumbered, 3u);
}

TEST(Probes, DoNotChangeABitOfTheTrajectory) {
  const char* events = R"([{"at": 0.002, "tear": {"vertex": 13, "direction": [1, 0, 0]}},
                           {"every": 0.002, "remove": {"random": {"count": 3}}}])";
  Simulation bare(parse(with_events(moving_box(), events)));
  run(bare);
  const SceneFile scene =
      parse(with_events(probed(R"([{"name": "a", "vertex": 13}, {"name": "b", "near": [0, 0, 0]}])"), events));
  Simulation watched(scene);
  Rows rows;
  OutputPlan plan;
  plan.probe_steps = 1;
  run_scene(watched, plan, rows);
  EXPECT_EQ(rows.rows.size(), 11u);
  EXPECT_EQ(watched.body().state_hash(), bare.body().state_hash());
}

TEST(Probes, LeaveTheFieldsOfARemovedVertexEmpty) {
  const ProbeRow row{0.5, {VertexMotion{{1, 2, 3}, {0, -1, 0.25}}, std::nullopt}};
  EXPECT_EQ(probes_row(row), "0.5,1,2,3,0,-1,0.25,,,,,,\n");
}

TEST(Probes, HeadTheirColumnsWithNamesThatAnyReaderOfTablesUnderstands) {
  const std::vector<Probe> probes{{"tip, left \"a\"", 0u, ""}};
  EXPECT_EQ(probes_header(probes).rfind(R"(time [s],"tip, left ""a"" x [m]","tip, left ""a"" y [m]",)", 0), 0u);
}

TEST(Probes, AreWrittenWhereThereAreAny) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(::testing::TempDir()) / "dartboard_probes_test";
  fs::remove_all(folder);
  const SceneFile scene = parse(probed(R"([{"name": "a", "vertex": 0}])"));
  {
    SceneOutput with(folder / "with", scene.probes), without(folder / "without");
    with.write(ProbeRow{0.0, {std::nullopt}});
  }
  std::ifstream file(folder / "with" / "probes.csv");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), "time [s],a x [m],a y [m],a z [m],a vx [m/s],a vy [m/s],a vz [m/s]\n0,,,,,,\n");
  EXPECT_FALSE(fs::exists(folder / "without" / "probes.csv"));
  fs::remove_all(folder);
}

TEST(Probes, RefuseAPointThatTheMeshDoesNotHave) {
  try {
    const Simulation simulation(parse(probed(R"([{"name": "a", "vertex": 27}])")));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "file: /output/probes/0/vertex: is 27; expected a point of the mesh, less than 27");
  }
}

}  // namespace
}  // namespace dartboard::probes_test
