// Scenes of regions, attachments and loads, compared with closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/plain/eigenvalues.h"
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

/// A bar of a soft and a stiff half, one after the other along z, held at z = 0.
Json two_halves(int cells, double spacing) {
  Json scene = Json::parse(R"({
    "name": "halves", "gravity": [0, 0, 0], "integrator": "verlet", "duration": 1, "step": 1,
    "material": {"density": 1000, "young": 1e5, "poisson": 0, "model": "corotational", "viscosity": 0},
    "fixed": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}]})");
  scene["body"]["generate"]["box"] = {{"cells", {1, 1, cells}}, {"spacing", spacing}, {"pattern", "kuhn"}};
  Json half{{"cells", {{"box", {{"min", {-1, -1, spacing * cells / 2}}, {"max", {1, 1, spacing * cells}}}}}}};
  half["material"] = Json::parse(R"({"density": 500, "young": 4e5, "poisson": 0, "model": "corotational"})");
  scene["regions"] = Json::array({half});
  return scene;
}

// Its lowest frequency solves tan(w L1 / c1) tan(w L2 / c2) = Z1 / Z2, with c = sqrt(E / rho) and Z = sqrt(E rho). The
// motion is projected on that mode, which the other ones are orthogonal to.
TEST(ClosedForms, ABarOfTwoMaterialsInSeriesVibratesAtTheFrequencyOfBoth) {
  constexpr double length = 0.6, c1 = 10, z1 = 1e4;
  const double c2 = std::sqrt(4e5 / 500), z2 = std::sqrt(4e5 * 500);
  double low = 0.0, high = std::numbers::pi / 2 * c1 / (length / 2);
  for (int k = 0; k < 60; ++k) {
    const double w = (low + high) / 2;
    (std::tan(w * length / 2 / c1) * std::tan(w * length / 2 / c2) < z1 / z2 ? low : high) = w;
  }
  const double omega = low;
  const auto mode = [&](double z) {
    const double half = length / 2;
    if (z <= half) return std::sin(omega * z / c1);
    return std::sin(omega * half / c1) / std::cos(omega * half / c2) * std::cos(omega * (length - z) / c2);
  };
  const auto error = [&](int cells) {
    Json scene = two_halves(cells, length / cells);
    scene["duration"] = std::numbers::pi / omega;
    scene["step"] = std::numbers::pi / omega / (40 * cells);
    scene["initial_velocity"] = Json::parse(R"({"linear": [[0, 0, 0], [0, 0, 0], [0, 0, 0.01]], "centre": [0, 0, 0]})");
    Simulation simulation(parse(scene));
    const VertexColumns& v = simulation.body().vertices();
    const std::vector<Vector3d> rest = v.position;
    const auto projected = [&] {
      double sum = 0.0;
      for (std::size_t k = 0; k < v.size(); ++k) sum += v.mass[k] * mode(rest[k].z()) * (v.position[k] - rest[k]).z();
      return sum;
    };
    // up from 0, and down through 0 after half a period: the last step's place, or the first one's beyond
    double last = 0.0;
    for (std::uint64_t n = 1;; ++n) {
      EXPECT_FALSE(simulation.advance());
      const double now = projected();
      if (now <= 0.0 || n == simulation.step_count()) {
        const double step = scene["step"].get<double>();
        const double crossing = (static_cast<double>(n) - now / (now - last)) * step;
        return crossing / scene["duration"].get<double>() - 1;
      }
      last = now;
    }
  };
  const double coarse = error(8), fine = error(16);
  EXPECT_LE(std::abs(fine), 2e-3);
  EXPECT_NEAR(fine / coarse, 0.25, 0.08);
}

// A clamped beam of a stiff and a soft layer under a load at its end: F L^3 / 3 over the bending stiffness about its
// neutral axis, and the shear of Jourawski's stresses. Hexahedra of length a shear as they bend, which no load asks of
// them: they are stiffer in bending by sum(G A) a^2 / 12 (Hughes, The Finite Element Method, section 4.4).
TEST(ClosedForms, ABeamOfTwoLayersBendsAboutItsNeutralAxis) {
  constexpr double length = 0.8, height = 0.1, stiff = 1e6, soft = 2e5, force = 1e-3;
  const auto share = [&](int layers) {
    const double a = height / layers, width = a;
    Json scene = Json::parse(R"({
      "name": "layers", "gravity": [0, 0, 0], "integrator": "backward-euler", "step": 20, "duration": 160,
      "material": {"density": 1, "young": 1e6, "poisson": 0, "model": "corotational", "viscosity": 0},
      "regions": [{"cells": {"box": {"min": [0, 0, 0.05], "max": [1, 1, 0.1]}},
                   "material": {"density": 1, "young": 2e5, "poisson": 0, "model": "corotational"}}],
      "fixed": [{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}],
      "forces": [{"plane": {"point": [0.8, 0, 0], "normal": [1, 0, 0]}, "force": [0, 0, -1e-3]}]})");
    scene["body"]["generate"]["box"] = {{"cells", {8 * layers, 1, layers}}, {"spacing", a}, {"kind", "hexahedra"}};
    Simulation simulation(parse(scene));
    run(simulation);
    const VertexColumns& v = simulation.body().vertices();
    double tip = 0.0, mass = 0.0;
    for (std::size_t k = 0; k < v.size(); ++k)
      if (v.pull[k].z() != 0.0) {
        tip -= v.mass[k] * (v.position[k].z() - a * std::round(v.position[k].z() / a));
        mass += v.mass[k];
      }
    tip /= mass;

    const double half = height / 2, axis = (stiff * 0.5 * half + soft * 1.5 * half) / (stiff + soft);
    const auto about_axis = [&](double z) { return std::pow(z - axis, 3) / 3; };
    const double bending =
        width * (stiff * (about_axis(half) - about_axis(0)) + soft * (about_axis(height) - about_axis(half)));
    const double parasitic = (stiff + soft) / 2 * half * width * a * a / 12;
    double shear = 0.0;  // [1/N] the square of the stress over G, for a force of 1 N
    constexpr int parts = 1000;
    for (int k = 0; k < parts; ++k) {
      const double z = (k + 0.5) * height / parts;
      const auto moment = [&](double from, double to) {
        return ((to - axis) * (to - axis) - (from - axis) * (from - axis)) / 2;
      };
      const double beyond = z > half ? soft * moment(z, height) : soft * moment(half, height) + stiff * moment(z, half);
      const double stress = beyond / bending;
      shear += stress * stress / ((z > half ? soft : stiff) / 2) * width * height / parts;
    }
    return tip / (force * (length * length * length / (3 * (bending + parasitic)) + length * shear));
  };
  EXPECT_NEAR(share(4), 1.0, 0.01);
  EXPECT_NEAR(share(8), 1.0, 0.005);
}

// Two rods, one below the other, each held at the middle of its upper end: a double pendulum. Gravity begins at an
// angle, so both lean by it; small swings are a sum of the two modes.
TEST(ClosedForms, TwoBodiesHeldAtEachOtherSwingAsADoublePendulum) {
  constexpr double g = 10.0, amplitude = 0.01;
  Json scene = Json::parse(R"({
    "name": "double pendulum", "duration": 0.6, "integrator": "verlet", "step": 5e-5,
    "bodies": [
      {"generate": {"box": {"cells": [2, 2, 3], "spacing": 0.05, "kind": "hexahedra"}}, "translate": [-0.05, -0.05, -0.15]},
      {"generate": {"box": {"cells": [2, 2, 4], "spacing": 0.05, "kind": "hexahedra"}}, "translate": [-0.05, -0.05, -0.35]}],
    "material": {"density": 1000, "young": 1e7, "poisson": 0.3, "viscosity": 0},
    "attachments": [{"sphere": {"centre": [0, 0, 0], "radius": 0.01}, "stiffness": 1e6},
                    {"sphere": {"centre": [0, 0, -0.15], "radius": 0.01}, "to": 0, "stiffness": 1e6}]})");
  scene["gravity"] = {g * std::sin(amplitude), 0, -g * std::cos(amplitude)};
  Simulation simulation(parse(scene));
  const VertexColumns& v = simulation.body().vertices();
  std::array<double, 2> mass{}, arm{}, inertia{};  // inertia about the upper end
  const std::vector<Vector3d> rest = v.position;
  const auto body_of = [&](std::size_t k) { return v.point[k] < 36 ? 0u : 1u; };
  for (std::size_t k = 0; k < v.size(); ++k) {
    const std::size_t b = body_of(k);
    const Vector3d r = rest[k] - Vector3d(0, 0, b == 0 ? 0.0 : -0.15);
    mass[b] += v.mass[k];
    arm[b] -= v.mass[k] * r.z();
    inertia[b] += v.mass[k] * (r.x() * r.x() + r.z() * r.z());
  }
  // angles against gravity: M a'' = - K a
  Eigen::Matrix2d m, k;
  constexpr double upper = 0.15;
  m << inertia[0] + mass[1] * upper * upper, upper * arm[1], upper * arm[1], inertia[1];
  k << g * (arm[0] + mass[1] * upper), 0, 0, g * arm[1];
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, m);
  run(simulation);
  const Eigen::Vector2d start = modes.eigenvectors().transpose() * m * Eigen::Vector2d(amplitude, amplitude);
  Eigen::Vector2d phase = (modes.eigenvalues().cwiseSqrt() * simulation.time()).array().cos();
  const Eigen::Vector2d angle = modes.eigenvectors() * Eigen::Vector2d(phase.cwiseProduct(start));
  ASSERT_LE(std::abs(angle[0]) + std::abs(angle[1]), 3 * amplitude);
  // the angle that a body has turned by, about its centre
  for (const std::size_t b : {0u, 1u}) {
    double cross = 0.0, dot = 0.0;
    for (std::size_t n = 0; n < v.size(); ++n) {
      if (body_of(n) != b) continue;
      const Vector3d r = rest[n] - Vector3d(0, 0, b == 0 ? -0.075 : -0.25), &x = v.position[n];
      cross += v.mass[n] * (r.z() * x.x() - r.x() * x.z());
      dot += v.mass[n] * (r.z() * x.z() + r.x() * x.x());
    }
    // leaning by the angle of gravity at the start
    EXPECT_NEAR(amplitude + std::atan2(cross, dot), angle[static_cast<Eigen::Index>(b)], 0.01 * amplitude) << b;
  }
}

// A chain of 0.6 m between two blocks, one of which is moved until it is 0.4 m from the other: a catenary, to which a
// chain of n links is near to second order.
TEST(ClosedForms, AChainBetweenTwoBodiesHangsAsACatenary) {
  constexpr double span = 0.4, length = 0.6;
  double low = 0.01, high = 10.0;  // half of the span over the parameter: sinh(a) / a = length / span
  for (int k = 0; k < 100; ++k) {
    const double a = (low + high) / 2;
    (std::sinh(a) / a < length / span ? low : high) = a;
  }
  const double sag = span / (2 * low) * (std::cosh(low) - 1);
  std::array<double, 3> error{};
  for (std::size_t k = 0; k < error.size(); ++k) {
    const int links = 6 << k;
    Json scene = Json::parse(R"({
      "name": "catenary", "step": 0.01, "duration": 5, "integrator": "backward-euler",
      "bodies": [
        {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}, "translate": [-0.1, -0.05, -0.05]},
        {"generate": {"chain": {"links": 6, "spacing": 1}}, "material": {"density": 0.2, "young": 2e4}},
        {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}, "translate": [0.6, -0.05, -0.05]}],
      "material": {"viscosity": 8},
      "fixed": [{"box": {"min": [-0.1, -1, 0.01], "max": [0, 1, 1]}}, {"box": {"min": [-0.1, -1, -1], "max": [0, 1, -0.01]}}],
      "driven": [{"box": {"min": [0.6, -1, 0.01], "max": [1, 1, 1]}, "velocity": [-0.2, 0, 0], "until": 1},
                 {"box": {"min": [0.6, -1, -1], "max": [1, 1, -0.01]}, "velocity": [-0.2, 0, 0], "until": 1}],
      "attachments": [{"box": {"min": [0, 0, 0], "max": [0, 0, 0]}, "to": 0, "stiffness": 1e5},
                      {"box": {"min": [0.6, 0, 0], "max": [0.6, 0, 0]}, "to": 2, "stiffness": 1e5}]})");
    scene["bodies"][1]["generate"]["chain"] = {{"links", links}, {"spacing", length / links}};
    Simulation simulation(parse(scene));
    run(simulation);
    const auto& v = simulation.body().vertices();
    double lowest = 0.0;
    for (const Vector3d& x : v.position) lowest = std::min(lowest, x.z());
    error[k] = std::abs(-lowest - sag);
  }
  EXPECT_LT(error[2], 1e-3);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.3);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.3);
}

}  // namespace
}  // namespace dartboard::closed_forms_test
