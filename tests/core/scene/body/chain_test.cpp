// Chains of point masses and springs, which have no cells, against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/meshes/text/base64.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/output/write_vtu.h"
#include "core/scene/run/scene_run.h"
#include "core/time/integrators.h"
#include "reference/closed_form.h"
#include "tests/support/moving_box.h"

namespace dartboard::chain_test {
namespace {

using namespace moving;

Json chain(int links) {
  Json scene = Json::parse(R"({"name": "chain", "step": 0.001, "duration": 0.01, "gravity": [0, 0, 0],
                               "material": {"density": 2, "stiffness": 1000, "damping": 0, "viscosity": 0}})");
  scene["body"]["generate"]["chain"] = {{"links", links}, {"spacing", 0.25}};
  return scene;
}

TEST(Chain, IsLinksBetweenPointMassesWithHalfOfEachLinkAtEitherEnd) {
  const Simulation simulation(parse(chain(4)));
  EXPECT_EQ(simulation.body().map_name(), "no map");
  EXPECT_EQ(simulation.body().counts(), (CellCounts{.vertices = 5, .edges = 4, .components = 1}));
  EXPECT_EQ(simulation.body().mass(), 2.0);
  EXPECT_EQ(simulation.body().vertices().mass, (std::vector<double>{0.25, 0.5, 0.5, 0.5, 0.25}));
  for (const Spring& spring : simulation.body().system().springs) {
    EXPECT_EQ(spring.rest_length, 0.25);
    EXPECT_EQ(spring.stiffness, 1000.0);
  }
}

TEST(Chain, ThatHangsStretchesByTheWeightBelowEachLink) {
  Json scene = chain(6);
  scene["gravity"] = {8, 0, 0};
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  // the slowest mode has omega = 2 sqrt(1000/0.5) sin(pi/24) = 11.7/s at least: all decay like exp(-10 t), and after 4
  // s by 4e-18
  scene["material"]["viscosity"] = 20;
  scene["step"] = 0.005;
  scene["duration"] = 4;
  Simulation simulation(parse(scene));
  run(simulation);
  const auto& x = simulation.body().vertices().position;
  // stretches are rounded like the positions, below 2: by 2^-53, a few times; the forces too, transmitted by 6 links
  for (std::size_t i = 1; i <= 6; ++i) {
    const double below = 0.5 * (6.5 - static_cast<double>(i));
    EXPECT_NEAR(x[i].x() - x[i - 1].x() - 0.25, 8.0 / 1000 * below, 64 * 0x1p-53) << i;
  }
  EXPECT_NEAR(simulation.body().largest_stress(), 8.0 * 0.5 * 5.5, 1000 * 64 * 0x1p-53);  // the tension at the top
}

TEST(Chain, OscillatesInItsFirstModeAtTheFrequencyOfTheClosedForm) {
  constexpr int n = 7;  // masses between two fixed ends
  Json json = chain(n + 1);
  json["fixed"] = Json::parse("[{\"ids\": [0, 8]}]");
  const SceneFile scene = parse(json);
  const auto body = make_simulated_body(make_problem(scene), false);
  const double omega = reference::chain_omega_fixed(n, 1000.0, 0.5, 1);
  const Motion motion = body->motion();
  const auto shape = [](int i) { return reference::chain_shape_fixed(n, 1, i); };
  for (int i = 1; i <= n; ++i) motion.v[static_cast<std::size_t>(i)] = {0.1 * shape(i), 0, 0};
  const auto integrator = make_integrator("rk4");
  const double h = std::numbers::pi / (2 * omega) / 50;
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(integrator->step(body->system(), motion, h).ok());
  // A quarter of a period later all pass their largest displacement. The phase of rk4 is wrong by (h omega)^4 / 120 per
  // radian, 1.3e-8 here; amplitudes by less.
  for (int i = 1; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(motion.v[k].x(), 0, 2e-8 * 0.1);
    EXPECT_NEAR(motion.x[k].x() - 0.25 * i, 0.1 / omega * shape(i), 2e-8 * 0.1 / omega);
    EXPECT_EQ(motion.x[k].y(), 0.0);
  }
}

TEST(Chain, IsWrittenAsLines) {
  const Simulation simulation(parse(chain(2)));
  const Frame frame = simulation.frame();
  EXPECT_EQ(frame.links, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}}));
  const std::string vtu = to_vtu(frame);
  EXPECT_NE(vtu.find("NumberOfPoints=\"3\" NumberOfCells=\"2\""), std::string::npos);
  // the types, 3 and 3, after their length of 2
  EXPECT_NE(vtu.find(encode_base64(std::string("\2\0\0\0\0\0\0\0\3\3", 10))), std::string::npos);
}

TEST(Chain, WorksWithEveryIntegratorAndDrivenEnds) {
  for (const IntegratorEntry& entry : integrators()) {
    Json scene = chain(5);
    scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
    scene["driven"] = Json::parse(R"([{"ids": [5], "velocity": [1, 0.5, 0]}])");
    scene["integrator"] = entry.name;
    Simulation simulation(parse(scene));
    run(simulation);
    const Eigen::Vector3d end = simulation.body().vertices().position[5];
    EXPECT_LT((end - Eigen::Vector3d(1.26, 0.005, 0)).norm(), 200 * 0x1p-52) << entry.name;  // ten steps
  }
}

}  // namespace
}  // namespace dartboard::chain_test
