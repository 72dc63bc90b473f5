// Choices of an event where a scene leaves something open: the cells drawn, the places of refinement, the direction of
// a fan.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/moving_box.h"

namespace dartboard::scene_event_choices_test {
namespace {

using namespace moving;

// Two of six cells are drawn from each of 3000 seeds: 15 pairs, 200 times each. The standard deviation of a count is
// sqrt(3000 * 1/15 * 14/15) = 13.7; 70 is five of them, which 15 counts exceed once in 10^5 sets of seeds.
TEST(SceneEvents, DrawEachSetOfCellsAsOften) {
  Problem problem;
  problem.mesh = kuhn_box(1, 1, 1, 1.0);
  std::map<std::vector<std::uint32_t>, int> drawn;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const auto body = make_simulated_body(problem, true);
    SceneEvent event;
    event.action = Remove{RandomSelection{4, seed}};
    EXPECT_EQ(body->make_ready(event)->apply(), 4u);
    std::vector<std::uint32_t> left = body->frame({}).mesh_cell;
    std::sort(left.begin(), left.end());
    ++drawn[left];
  }
  EXPECT_EQ(drawn.size(), 15u);
  for (const auto& [left, count] : drawn) EXPECT_NEAR(count, 200, 70) << left.at(0) << " " << left.at(1);
}

TEST(SceneEvents, DrawFurtherCellsEachTimeTheyRepeat) {
  // if the same places were drawn each time, twelve cells of 48 would be removed in the same pattern for every seed of
  // one count
  const auto left_after = [](const char* events) {
    Simulation simulation(parse(with_events(moving_box(), events)));
    run(simulation);
    auto cells = simulation.frame().mesh_cell;
    std::sort(cells.begin(), cells.end());
    return cells;
  };
  const auto repeated =
      left_after(R"([{"every": 0.001, "from": 0.001, "until": 0.002, "remove": {"random": {"count": 3, "seed": 5}}}])");
  const auto twice = left_after(R"([{"at": 0.001, "remove": {"random": {"count": 3, "seed": 5}}},
                                    {"at": 0.002, "remove": {"random": {"count": 3, "seed": 5}}}])");
  EXPECT_EQ(repeated.size(), twice.size());
  EXPECT_NE(repeated, twice);
}

// ---- refinement of one of the six tetrahedra around the diagonal of a cube

// All cells of a ball have edges of one length at rest, but for rounding.
TEST(SceneEvents, RefineTheSameEdgesOfABodyThatIsTurned) {
  const auto corners_after = [](double degrees) {
    Json scene = with_events(moving_box(),
                             R"([{"at": 0, "refine": {"cells": {"sphere": {"centre": [0, 0, 0], "radius": 9}}}}])");
    scene["body"] = {{"generate", {{"ball", {{"layers", 2}, {"radius", 0.1}}}}},
                     {"rotate", {{"axis", {1, 1, 1}}, {"degrees", degrees}}}};
    return Simulation(parse(scene)).frame().mesh.nodes;
  };
  const std::vector<std::uint32_t> expected = corners_after(0.0);
  for (const double degrees : {17.0, 120.0, 240.0}) EXPECT_EQ(corners_after(degrees), expected) << degrees;
}

Simulation refined(const char* how) {
  Json scene = with_events(moving_box(), how);
  scene["body"]["generate"]["box"] = {{"cells", {1, 1, 1}}, {"spacing", 1}};
  return Simulation(parse(scene));
}
/// The vertex that came in; there is one.
std::size_t new_vertex(const Simulation& simulation) {
  const auto& points = simulation.body().vertices().point;
  EXPECT_EQ(std::count(points.begin(), points.end(), no_point), 1);
  return static_cast<std::size_t>(std::find(points.begin(), points.end(), no_point) - points.begin());
}

TEST(SceneEvents, RefineACellInTheMiddleOfItsLongestEdgeAndSoAllCellsAroundThat) {
  const Simulation simulation = refined(R"([{"at": 0, "refine": {"cells": {"ids": [3]}}}])");
  EXPECT_EQ(cells(simulation), 12u);
  EXPECT_EQ(simulation.body().vertices().position[new_vertex(simulation)], Eigen::Vector3d(0.5, 0.5, 0.5));
}

TEST(SceneEvents, RefineACellAtItsCentreAlone) {
  const Simulation simulation = refined(R"([{"at": 0, "refine": {"cells": {"ids": [3]}, "at": "centre"}}])");
  EXPECT_EQ(cells(simulation), 5u + 4u);
  const Mesh mesh = kuhn_box(1, 1, 1, 1.0);
  Eigen::Vector3d middle(0, 0, 0);
  for (const std::uint32_t p : mesh.cell(3)) middle += mesh.points[p] / 4;
  EXPECT_LT((simulation.body().vertices().position[new_vertex(simulation)] - middle).norm(), 8 * 0x1p-53);
}

TEST(SceneEvents, BraceTheNewVertexAsMuchAsTheSceneSays) {
  const auto stiffness = [](const char* how) {
    const Simulation simulation = refined(how);
    const std::size_t k = new_vertex(simulation);
    const SpringSystem system = simulation.body().system();
    double sum = 0.0;
    for (std::size_t s = 0; s < system.springs.size(); ++s)
      if (system.ends[s][0] == k || system.ends[s][1] == k) sum += system.springs[s].stiffness;
    return sum;
  };
  const double once = stiffness(R"([{"at": 0, "refine": {"cells": {"ids": [3]}, "at": "centre", "bracing": 1}}])");
  EXPECT_GT(once, 0.0);
  EXPECT_EQ(stiffness(R"([{"at": 0, "refine": {"cells": {"ids": [3]}, "at": "centre", "bracing": 4}}])"), 4 * once);
  EXPECT_EQ(stiffness(R"([{"at": 0, "refine": {"cells": {"ids": [3]}, "at": "centre", "bracing": 0}}])"), 0.0);
  EXPECT_EQ(stiffness(R"([{"at": 0, "refine": {"cells": {"ids": [3]}, "at": "centre"}}])"), once / 2);  // the default
}

// ---- tears

// Four cubes around an edge along y: the fan that starts with a face goes on across that edge, in the face's own plane,
// and parts the body there.
TEST(SceneEvents, TearAFanThatStartsAcrossTheDirectionTheyAreGiven) {
  for (const int axis : {0, 2}) {
    Json scene = with_events(moving_box(), R"([{"at": 0, "tear": {"vertex": 7, "direction": [0, 0, 0]}}])");
    scene["events"][0]["tear"]["direction"][static_cast<std::size_t>(axis)] = 1;
    scene["body"]["generate"]["box"] = {{"cells", {2, 1, 2}}, {"spacing", 1}, {"kind", "hexahedra"}};
    const Simulation simulation(parse(scene));  // point 7 is at (1, 0, 1), the middle
    EXPECT_EQ(simulation.operations(), 2u);
    EXPECT_EQ(simulation.body().counts().components, 2u);
    const Frame frame = simulation.frame();
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t other = 0; other < c; ++other) {
        const auto lowest = [&](std::size_t cell) {
          double x = 2.0;
          for (const std::uint32_t p : frame.mesh.cell(cell)) x = std::min(x, frame.mesh.points[p][axis]);
          return x;
        };
        EXPECT_EQ(frame.component[c] == frame.component[other], lowest(c) == lowest(other)) << axis;
      }
  }
}

TEST(SceneEvents, TearNoMoreVerticesAtATimeThanTheSceneAllows) {
  const auto first_tear = [](const char* limit) {
    Json scene = moving_box();
    scene["gravity"] = {0, 0, 0};
    scene["initial_velocity"] = Json::parse(R"({"linear": [[100, 0, 0], [0, 0, 0], [0, 0, 0]]})");
    scene["events"] = Json::parse(R"([{"tear_where_stressed": {"threshold": 1}}])");
    if (*limit != 0) scene["events"][0]["tear_where_stressed"]["most_per_step"] = Json::parse(limit);
    Simulation simulation(parse(scene));
    while (simulation.operations() == 0 && simulation.steps_done() < 10) simulation.advance();
    return simulation.body().vertices().size() - 27;
  };
  const std::size_t unlimited = first_tear(""), one = first_tear("1"), two = first_tear("2");
  EXPECT_GT(one, 0u);
  EXPECT_GT(two, one);
  EXPECT_GT(unlimited, two);
}

}  // namespace
}  // namespace dartboard::scene_event_choices_test
