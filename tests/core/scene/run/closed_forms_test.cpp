// Scenes of regions, attachments and loads, compared with closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/moving_box.h"

namespace dartboard::closed_forms_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

// Stress is the same in all of the bar, so strains add up over the lengths: F / A (L1 / E1 + L2 / E2). Linear elements
// hold a uniform strain exactly, and nothing moves sideways at a Poisson's ratio of 0.
TEST(ClosedForms, ABarOfTwoMaterialsInSeriesIsAsLongAsBothStrainsMakeIt) {
  for (const char* kind : {"tetrahedra", "hexahedra"}) {
    Json scene = Json::parse(R"({
      "name": "series", "step": 0.02, "duration": 6, "gravity": [0, 0, 0], "integrator": "backward-euler",
      "body": {"generate": {"box": {"cells": [1, 1, 6], "spacing": 0.1, "pattern": "kuhn"}}},
      "material": {"density": 1000, "young": 1e5, "poisson": 0, "model": "corotational", "viscosity": 20},
      "regions": [{"cells": {"box": {"min": [0, 0, 0.4], "max": [0.1, 0.1, 0.6]}},
                   "material": {"density": 500, "young": 2e4, "poisson": 0, "model": "corotational"}}],
      "fixed": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}],
      "forces": [{"plane": {"point": [0, 0, 0.6], "normal": [0, 0, 1]}, "pressure": -800,
                  "over_time": [{"at": 0, "factor": 0}, {"at": 1, "factor": 1}]}]})");
    scene["body"]["generate"]["box"]["kind"] = kind;
    Simulation simulation(parse(scene));
    run(simulation);
    const VertexColumns& v = simulation.body().vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const double z = 0.1 * std::round(10 * v.position[k].z());
      const double expected = z + 800 * (std::min(z, 0.4) / 1e5 + std::max(z - 0.4, 0.0) / 2e4);
      EXPECT_NEAR(v.position[k].z(), expected, 1e-8) << kind;
    }
  }
}

// A cube that hangs from one of its corners and is let go a little beside where it would rest: a quarter of its period
// later it swings through there. The period is that of its masses as a rigid body, by sqrt(I / (m g d)) and the first
// term of the amplitude.
TEST(ClosedForms, ABodyHeldAtAPointSwingsAsAPendulumOfItsMomentOfInertia) {
  Json scene = Json::parse(R"({
    "name": "pendulum", "step": 1e-4, "duration": 1, "integrator": "verlet",
    "body": {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1, "pattern": "kuhn"}}},
    "material": {"density": 1000, "young": 1e7, "poisson": 0.3, "viscosity": 0},
    "attachments": [{"ids": [0], "stiffness": 1e6}]})");
  constexpr double g = 10.0, amplitude = 0.02;
  const Vector3d down = Vector3d(1, 1, 1).normalized(), across = Vector3d(1, -1, 0).normalized();
  const Vector3d axis = down.cross(across);
  const Vector3d gravity = g * (std::cos(amplitude) * down + std::sin(amplitude) * across);
  scene["gravity"] = {gravity.x(), gravity.y(), gravity.z()};

  const auto centre_of = [](const Simulation& simulation) {
    const VertexColumns& v = simulation.body().vertices();
    Vector3d sum(0, 0, 0);
    for (std::size_t k = 0; k < v.size(); ++k) sum += v.mass[k] * v.position[k];
    return Vector3d(sum / simulation.body().mass());
  };
  double inertia = 0.0, arm = 0.0, mass = 0.0;
  {
    const Simulation at_rest(parse(scene));
    const VertexColumns& v = at_rest.body().vertices();
    for (std::size_t k = 0; k < v.size(); ++k) inertia += v.mass[k] * axis.cross(v.position[k]).squaredNorm();
    arm = centre_of(at_rest).norm();
    mass = at_rest.body().mass();
  }
  const double period = 2 * std::numbers::pi * std::sqrt(inertia / (mass * g * arm)) * (1 + amplitude * amplitude / 16);
  scene["duration"] = period / 4;
  scene["step"] = period / 4 / 4000;
  Simulation simulation(parse(scene));
  const auto angle = [&] {
    const Vector3d x = centre_of(simulation), rest = gravity.normalized();
    return std::atan2(axis.dot(rest.cross(x)), rest.dot(x));
  };
  EXPECT_NEAR(angle(), -amplitude, 1e-3 * amplitude);
  run(simulation);
  // the attachment and the cube give way by some 1e-4 of its size
  EXPECT_NEAR(angle(), 0.0, 1e-3 * amplitude);
}

}  // namespace
}  // namespace dartboard::closed_forms_test
