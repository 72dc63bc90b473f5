// Driven vertices are where the scene puts them, whatever the integrator, the springs and the events do.

#include "core/scene/timeline/driven_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"

namespace dartboard::driven_vertices_test {
namespace {

using namespace moving;

// A box held on one side, its opposite side moved along.
Json pulled_box(const char* driven) {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  scene["driven"] = Json::parse(driven);
  return scene;
}
constexpr const char* plate = R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "velocity": [3, 0.5, -1]}])";

// Each step adds h v, rounded, with a rounding of the sum: after n steps at most 2 n roundings of the largest place,
// and some more for the stages of a method, which has fewer than ten.
double rounding(std::uint64_t steps, double place) { return 20.0 * static_cast<double>(steps) * 0x1p-53 * place; }

TEST(DrivenVertices, AreWhereTheirVelocityTakesThemWithEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators()) {
    Json scene = pulled_box(plate);
    scene["duration"] = 0.1;
    scene["integrator"] = entry.name;
    const SceneFile file = parse(scene);
    const Mesh mesh = make_mesh(file);
    Simulation simulation(file);
    run(simulation);
    const VertexColumns& v = simulation.body().vertices();
    int driven = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Eigen::Vector3d rest = mesh.points[v.point[k]];
      Eigen::Vector3d expected = rest;
      if (rest.x() == 0.25) {
        expected += 0.1 * Eigen::Vector3d(3, 0.5, -1);
        EXPECT_EQ(v.velocity[k], Eigen::Vector3d(3, 0.5, -1)) << entry.name;
        ++driven;
      } else if (rest.x() != 0.0) {
        EXPECT_GT((v.position[k] - rest).norm(), 1e-3) << entry.name;  // the others follow
        continue;
      }
      EXPECT_LE((v.position[k] - expected).norm(), rounding(100, 1.0)) << entry.name;
    }
    EXPECT_EQ(driven, 9) << entry.name;
  }
}

TEST(DrivenVertices, MayMoveLinearlyInTheirPlaceAtRest) {
  const SceneFile file = parse(pulled_box(
      R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]},
           "velocity": {"linear": [[0, 0, 0], [0, 0, -2], [0, 2, 0]], "centre": [0.25, 0.125, 0.125]}}])"));
  const Mesh mesh = make_mesh(file);
  Simulation simulation(file);
  run(simulation);
  const VertexColumns& v = simulation.body().vertices();
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Eigen::Vector3d rest = mesh.points[v.point[k]];
    if (rest.x() != 0.25) continue;
    const Eigen::Vector3d velocity(0, -2 * (rest.z() - 0.125), 2 * (rest.y() - 0.125));
    EXPECT_LE((v.position[k] - rest - 0.01 * velocity).norm(), rounding(10, 1.0));
  }
}

/// The x coordinate of the driven point 26 after each step, in steps' lengths from its place at rest.
std::vector<double> path(const char* driven, std::string_view integrator = "rk4") {
  Json scene = pulled_box(driven);
  scene["integrator"] = integrator;
  Simulation simulation(parse(scene));
  const auto& v = simulation.body().vertices();
  const auto k = static_cast<std::size_t>(std::find(v.point.begin(), v.point.end(), 26u) - v.point.begin());
  std::vector<double> places;
  for (int n = 0; n < 10; ++n) {
    simulation.advance();
    places.push_back(std::round((v.position[k].x() - 0.25) * 1e6) / 1e3);
  }
  return places;
}

TEST(DrivenVertices, AreHeldStillBeforeTheyStartAndAfterTheyStop) {
  EXPECT_EQ(path(R"([{"ids": [26], "velocity": [1, 0, 0], "from": 0.003, "until": 0.006}])"),
            (std::vector<double>{0, 0, 0, 1, 2, 3, 3, 3, 3, 3}));
}

TEST(DrivenVertices, StartAndStopWithinStepsAtTheirTimes) {
  for (const char* driven : {R"([{"ids": [26], "velocity": [1, 0, 0], "from": 0.0021, "until": 0.0055}])",
                             R"([{"ids": [26], "velocity": [1, 0, 0], "from": 0.0021, "until": 0.0033},
            {"ids": [26], "velocity": [1, 0, 0], "from": 0.0033, "until": 0.0055}])"})
    EXPECT_EQ(path(driven), (std::vector<double>{0, 0, 0.9, 1.9, 2.9, 3.4, 3.4, 3.4, 3.4, 3.4})) << driven;
}

// at 0.0015, 0.003, 0.0045, ...: the third step ends with a turn, the others have one within them
TEST(DrivenVertices, TurnRoundWithinStepsWithEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators())
    EXPECT_EQ(path(R"([{"ids": [26], "velocity": [1, 0, 0], "reverse_every": 0.0015, "until": 0.0095}])", entry.name),
              (std::vector<double>{1, 1, 0, 1, 1, 0, 1, 1, 0, 0.5}))
        << entry.name;
}

// a pulse of a tenth of a step, and fifty turns in each step, which lead to and fro
TEST(DrivenVertices, MoveForTimesShorterThanAStep) {
  EXPECT_EQ(path(R"([{"ids": [26], "velocity": [1, 0, 0], "from": 0.0022, "until": 0.0023}])"),
            (std::vector<double>{0, 0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1}));
  EXPECT_EQ(path(R"([{"ids": [26], "velocity": [1, 0, 0], "reverse_every": 0.00002, "until": 0.00101}])"),
            (std::vector<double>{0, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01}));
}

TEST(DrivenVertices, TurnRoundAgainAndAgain) {
  EXPECT_EQ(path(R"([{"ids": [26], "velocity": [1, 0, 0], "from": 0.001, "until": 0.009, "reverse_every": 0.002}])"),
            (std::vector<double>{0, 1, 2, 1, 0, 1, 2, 1, 0, 0}));
}

// a method that continues from its last steps must be restarted: their velocity is not that of the next
TEST(DrivenVertices, TurnRoundWithEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators())
    EXPECT_EQ(path(R"([{"ids": [26], "velocity": [1, 0, 0], "from": 0.002, "reverse_every": 0.003}])", entry.name),
              (std::vector<double>{0, 0, 1, 2, 3, 2, 1, 0, 1, 2}))
        << entry.name;
}

TEST(DrivenVertices, MayBeMovedByOneDriveAfterAnother) {
  EXPECT_EQ(path(R"([{"ids": [26], "velocity": [-1, 0, 0], "from": 0.004},
                     {"ids": [26, 25], "velocity": [2, 0, 0], "until": 0.004}])"),
            (std::vector<double>{2, 4, 6, 8, 7, 6, 5, 4, 3, 2}));
}

TEST(DrivenVertices, CannotBeDrivenTwiceAtATimeNorBeFixed) {
  EXPECT_EQ(refusal(pulled_box(R"([{"ids": [26], "velocity": [1, 0, 0], "until": 0.005},
                                   {"ids": [23, 26], "velocity": [2, 0, 0], "from": 0.004}])")),
            "file: /driven/1: drives point 26 from 0.004 to 0.01 s, and /driven/0 from 0 to 0.005 s; expected one at a "
            "time");
  EXPECT_EQ(refusal(pulled_box(R"([{"ids": [0], "velocity": [1, 0, 0]}])")),
            "file: /driven/0: drives point 0, and /fixed holds it still; expected one of them");
  EXPECT_EQ(refusal(pulled_box(R"([{"ids": [27], "velocity": [1, 0, 0]}])")),
            "file: /driven/0/ids/0: is 27; expected a point of the mesh, less than 27");
  EXPECT_EQ(
      refusal(pulled_box(R"([{"sphere": {"centre": [9, 9, 9], "radius": 1}, "velocity": [1, 0, 0]}])")),
      "file: /driven/0: selects no vertex; expected at least one of the body, which is from [0, 0, 0] to [0.25, 0.25, "
      "0.25]");
}

// ---- events

TEST(DrivenVertices, AreDrivenInAllPartsThatTheyComeApartIn) {
  // The box is cut through the middle of the driven side, cells are removed so that numbers move, and the drive turns
  // afterwards: all vertices of driven points, however many and however numbered, are where the drive takes them.
  Json scene =
      pulled_box(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "velocity": [3, 0, 0], "until": 0.008}])");
  scene["events"] = Json::parse(R"([
    {"at": 0.002, "dissociate": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}},
    {"at": 0.003, "remove": {"random": {"count": 12}}},
    {"at": 0.005, "tear": {"vertex": 17, "direction": [0, 0, 1]}},
    {"at": 0.006, "remove": {"random": {"count": 6}}}])");
  const SceneFile file = parse(scene);
  const Mesh mesh = make_mesh(file);
  Simulation simulation(file);
  run(simulation);
  EXPECT_GT(simulation.operations(), 18u + 8u);
  const VertexColumns& v = simulation.body().vertices();
  std::vector<int> parts(mesh.points.size(), 0);
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Eigen::Vector3d rest = mesh.points[v.point[k]];
    const bool driven = rest.x() == 0.25;
    EXPECT_EQ(v.fixed[k] != 0, driven || rest.x() == 0.0);
    if (!driven) continue;
    ++parts[v.point[k]];
    EXPECT_LE((v.position[k] - rest - Eigen::Vector3d(0.024, 0, 0)).norm(), rounding(10, 1.0));
    EXPECT_EQ(v.velocity[k], Eigen::Vector3d(0, 0, 0));
  }
  EXPECT_GE(*std::max_element(parts.begin(), parts.end()), 2);
}

TEST(DrivenVertices, MoveABodyWithAndWithoutAMapAlike) {
  Json scene = pulled_box(plate);
  Simulation columns(parse(scene));
  scene["events"] = Json::parse(R"([{"at": 0.01, "remove": {"sphere": {"centre": [9, 9, 9], "radius": 1}}}])");
  Simulation map(parse(scene));
  run(columns);
  run(map);
  EXPECT_EQ(columns.body().map_name(), "no map");
  EXPECT_EQ(columns.body().state_hash(), map.body().state_hash());
}

// ---- divergence

TEST(DrivenVertices, MayStretchABodyThreefoldWithoutBeingTakenForADivergence) {
  for (const double speed : {0.25, 50.0}) {
    Json scene = pulled_box(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "velocity": [0, 0, 0]}])");
    scene["driven"][0]["velocity"] = {speed, 0, 0};
    scene["duration"] = 0.5 / speed;
    scene["material"] = Json::parse(R"({"stiffness": 50000})");
    scene["step"] = 0.0001;
    Simulation simulation(parse(scene));
    while (simulation.steps_done() < simulation.step_count()) {
      const auto divergence = divergence_of_step(simulation);
      ASSERT_FALSE(divergence) << speed << " m/s: " << to_string(*divergence);
    }
    EXPECT_GT(simulation.diagnostics().elastic, 1000.0) << speed;  // some 10 springs of 10^5 N/m by half a metre in two
  }
}

TEST(DrivenVertices, DoNotHideAnUnstableStep) {
  for (const double speed : {0.25, 50.0}) {
    Json scene = pulled_box(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "velocity": [0, 0, 0]}])");
    scene["driven"][0]["velocity"] = {speed, 0, 0};
    scene["material"] = Json::parse(R"({"stiffness": 6.4e7})");  // h omega about 2 for h = 1e-3 (simulation_test.cpp)
    scene["step"] = 0.003;
    scene["duration"] = 1.0;
    Simulation simulation(parse(scene));
    std::optional<Divergence> divergence;
    while (!divergence && simulation.steps_done() < 64) divergence = divergence_of_step(simulation);
    EXPECT_TRUE(divergence) << speed;
  }
}

}  // namespace
}  // namespace dartboard::driven_vertices_test
