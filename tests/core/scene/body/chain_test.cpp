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

// ---- contact with obstacles

/// A chain that lies along x above a floor, which carries 2000 Pa at 2 mm: 0.2 kg/m on a width of 1 cm.
Json above_floor(int links, double height) {
  Json scene = chain(links);
  scene["gravity"] = {0, 0, -8};
  scene["material"] = {{"density", 0.2}, {"stiffness", 1000}, {"damping", 0}, {"viscosity", 0}, {"width", 0.01}};
  scene["body"]["translate"] = {0, 0, height};
  scene["contact"] = {{"pressure", 2000}, {"depth", 0.002}, {"exponent", 2}};
  scene["contact"]["obstacles"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}])");
  return scene;
}
// pressures grow with depth: 0.2 * 8 N/m on 1 cm are 160 Pa
constexpr double depth_at_rest = 0.002 * 160 / 2000;

TEST(Chain, StaysOnAFloorAsDeepAsItsWeightPressesAStrip) {
  Simulation simulation(parse(above_floor(5, -depth_at_rest)));
  run(simulation);
  const ContactDiagnostics contact = *simulation.diagnostics().contact;
  EXPECT_EQ(contact.contacts, 6u + 5u);
  // weights and forces are equal to their rounding, 2^-53 of 8 m/s^2 a few times, over ten steps of 1 ms
  for (const Eigen::Vector3d& v : simulation.body().vertices().velocity) EXPECT_LT(v.norm(), 0.01 * 8 * 8 * 0x1p-53);
}

TEST(Chain, BouncesFromAFloorWithItsRestitution) {
  Json scene = above_floor(4, 0.0001);
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = {0, 0, -0.5};
  scene["contact"]["restitution"] = 0.5;
  // half a period is pi sqrt(0.2 / (0.01 * 1e6)) = 14 ms; the error is of second order in omega h, which is 0.011
  scene["step"] = 5e-5;
  scene["duration"] = 0.05;
  Simulation simulation(parse(scene));
  run(simulation);
  for (const Eigen::Vector3d& v : simulation.body().vertices().velocity) EXPECT_NEAR(v.z(), 0.25, 0.25 * 1e-4);
}

TEST(Chain, SlidesAsFarAsItsFrictionLets) {
  Json scene = above_floor(4, -depth_at_rest);
  scene["initial_velocity"] = {0, 0.1, 0};
  scene["contact"]["friction"] = 0.25;
  scene["duration"] = 0.06;
  Simulation simulation(parse(scene));
  run(simulation);
  const auto& v = simulation.body().vertices();
  // 0.1 / (0.25 * 8) = 50 ms, 2.5 mm; where it stops within a step is not resolved
  for (std::size_t k = 0; k < v.size(); ++k) {
    EXPECT_NEAR(v.position[k].y(), 0.1 * 0.1 / (2 * 0.25 * 8), 0.25 * 8 * 0.001 * 0.001) << k;
    EXPECT_LT(std::abs(v.velocity[k].y()), 1e-12) << k;
  }
}

TEST(Chain, FeelsAnObstacleUnderTheMiddleOfALink) {
  Json scene = above_floor(1, 0.0);
  scene["contact"]["obstacles"] = Json::parse(R"([{"sphere": {"centre": [0.125, 0, -0.049], "radius": 0.05}}])");
  const Simulation simulation(parse(scene));
  const ContactDiagnostics contact = *simulation.diagnostics().contact;
  EXPECT_EQ(contact.contacts, 1u);
  EXPECT_NEAR(contact.deepest, 0.001, 0x1p-53);
  // two thirds of 0.25 m by 1 cm, on which 1000 Pa have done half of their work by 1 mm
  EXPECT_NEAR(contact.energy, 0.25 * 0.01 / 1.5 * 0.5 * 1000 * 0.001, 1e-15);
}

TEST(Chain, IsMetByAMovingFloorWhateverTheIntegrator) {
  for (const IntegratorEntry& entry : integrators()) {
    Json scene = above_floor(3, 0.0);
    scene["gravity"] = {0, 0, 0};
    scene["contact"]["obstacles"][0]["velocity"] = {0, 0, 0.1};
    scene["integrator"] = entry.name;
    scene["duration"] = 0.004;
    Simulation simulation(parse(scene));
    run(simulation);
    const auto& v = simulation.body().vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      EXPECT_GT(v.velocity[k].z(), 0.0) << entry.name;
      EXPECT_NEAR(v.velocity[k].z(), v.velocity[0].z(), 1e-9) << entry.name << k;
    }
  }
}

}  // namespace
}  // namespace dartboard::chain_test
