// A box hung from its top goes down and, by symmetry, not sideways; a mesh with a direction breaks this symmetry.

#include <gtest/gtest.h>

#include "tests/support/moving_box.h"

namespace dartboard::hung_box_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

Json hung(const char* pattern, const char* material) {
  Json scene = Json::parse(R"({"name": "hung", "step": 0.05, "duration": 10, "integrator": "backward-euler",
    "gravity": [0, 0, -9.81], "body": {"generate": {"box": {"cells": [2, 2, 6], "spacing": 0.05}}},
    "fixed": [{"plane": {"point": [0, 0, 0.3], "normal": [0, 0, 1]}}]})");
  scene["body"]["generate"]["box"]["pattern"] = pattern;
  scene["material"] = Json::parse(material);
  return scene;
}

/// The displacement of the mean of the foot until it is at rest [m].
Vector3d moved(const Json& scene) {
  Simulation simulation(parse(scene));
  const auto foot = [&simulation] {
    const auto& x = simulation.body().vertices().position;
    const auto& point = simulation.body().vertices().point;
    Vector3d sum(0, 0, 0);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (point[k] < 9) sum += x[k] / 9.0;
    return sum;
  };
  const Vector3d before = foot();
  run(simulation);
  return foot() - before;
}

constexpr const char* springs = R"({"density": 1000, "stiffness": 3000, "damping": 0, "viscosity": 10})";
constexpr const char* elements = R"({"density": 1000, "young": 1e5, "poisson": 0.3, "viscosity": 10})";

TEST(HungBox, CutInMirrorImagesGoesStraightDown) {
  for (const char* material : {springs, elements}) {
    const Vector3d way = moved(hung("mirrored", material));
    EXPECT_LT(way.z(), -1e-4) << material;
    EXPECT_LT(way.head<2>().norm(), 1e-9 * std::abs(way.z())) << material;
  }
}

TEST(HungBox, CutAlikeGoesSidewaysAsItsMeshSays) {
  const Vector3d of_springs = moved(hung("kuhn", springs));
  EXPECT_GT(of_springs.head<2>().norm(), 0.5 * std::abs(of_springs.z()));
  const Vector3d of_elements = moved(hung("kuhn", elements));
  EXPECT_GT(of_elements.head<2>().norm(), 0.01 * std::abs(of_elements.z()));
  EXPECT_LT(of_elements.head<2>().norm(), 0.1 * std::abs(of_elements.z()));
}

}  // namespace
}  // namespace dartboard::hung_box_test
