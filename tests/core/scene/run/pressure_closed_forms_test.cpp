// Bodies under pressures that follow their faces, compared with closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/meshes/mesh_io.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::pressure_closed_forms_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

/// The stress [Pa] in a body of these constants that is `s` times as large as at rest in all directions.
double cauchy_stress(const std::string& model, double young, double poisson, double s) {
  const double mu = young / (2 * (1 + poisson)), lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  if (model == "corotational") return (2 * mu + 3 * lambda) * (s - 1) / (s * s);
  if (model == "stvk") return (2 * mu + 3 * lambda) * (s * s - 1) / (2 * s);
  const double m = 4.0 / 3.0 * mu, l = lambda + 5.0 / 6.0 * mu;
  return m * (1 - 1 / (3 * s * s + 1)) / s + l * (s * s * s - 1 - 0.75 * m / l);
}
/// The size at which that stress is - pressure, by bisection.
double size_under(double pressure, const std::string& model, double young, double poisson) {
  double low = 0.7, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double s = (low + high) / 2;
    (cauchy_stress(model, young, poisson, s) < -pressure ? low : high) = s;
  }
  return low;
}

// A strain that is the same everywhere is in the reach of every kind of cell, so the mesh makes no error.
TEST(PressureClosedForms, ABodyUnderPressureFromAllSidesIsAsMuchSmallerAsItsLawSays) {
  for (const char* model : {"neo-hookean", "corotational", "stvk"})
    for (const char* generate : {R"({"ball": {"layers": 2, "radius": 0.1}})",
                                 R"({"box": {"cells": [2, 2, 2], "spacing": 0.05, "kind": "mixed"}})"}) {
      Json scene = Json::parse(R"({
        "name": "squeezed", "step": 0.01, "duration": 0.6, "gravity": [0, 0, 0], "integrator": "backward-euler",
        "material": {"density": 100, "young": 1e5, "poisson": 0.3, "viscosity": 50},
        "forces": [{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "pressure": 2e4, "normals": "current"}]})");
      scene["body"]["generate"] = Json::parse(generate);
      scene["material"]["model"] = model;
      const double s = size_under(2e4, model, 1e5, 0.3);
      ASSERT_GT(s, 0.9);
      ASSERT_LT(s, 0.95);
      Simulation simulation(parse(scene));
      const std::vector<Vector3d> rest = simulation.body().vertices().position;
      run(simulation);
      const auto& x = simulation.body().vertices().position;
      for (std::size_t k = 1; k < x.size(); ++k)
        EXPECT_LE((x[k] - x[0] - s * (rest[k] - rest[0])).norm(), 1e-9) << model << " " << generate;
    }
}

/// A hollow ball of 6 n^2 layers of hexahedra: on each side of a cube n x n directions of equal angles.
Mesh hollow_ball(int n, int layers, double inner, double outer) {
  Mesh mesh;
  std::map<std::array<long, 3>, std::uint32_t> number;
  const auto point = [&](const Vector3d& x) {
    const std::array<long, 3> key{std::lround(1e6 * x[0]), std::lround(1e6 * x[1]), std::lround(1e6 * x[2])};
    const auto [found, is_new] = number.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) mesh.points.push_back(x);
    return found->second;
  };
  for (int side = 0; side < 6; ++side) {
    const auto place = [&](int i, int j, int k) {
      const double quarter = std::atan(1.0), u = std::tan(quarter * (2.0 * i / n - 1)),
                   v = std::tan(quarter * (2.0 * j / n - 1));
      // right-handed with the direction outwards
      Vector3d direction = side < 3 ? Vector3d(u, v, 1) : Vector3d(v, u, -1);
      for (int turn = 0; turn < side % 3; ++turn) direction = {direction[2], direction[0], direction[1]};
      return point((inner + (outer - inner) * k / layers) * direction.normalized());
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < layers; ++k)
          mesh.add_cell(CellKind::hexahedron, std::array{place(i, j, k), place(i + 1, j, k), place(i + 1, j + 1, k),
                                                         place(i, j + 1, k), place(i, j, k + 1), place(i + 1, j, k + 1),
                                                         place(i + 1, j + 1, k + 1), place(i, j + 1, k + 1)});
  }
  return mesh;
}

using PressureClosedFormsOfFiles = FolderTest;

// Lame's sphere: Timoshenko and Goodier, Theory of Elasticity, section 136. Steps are a thousand times the slowest
// period, so that a few of them end at rest.
TEST_F(PressureClosedFormsOfFiles, AHollowBallUnderPressureFromInsideGrowsAsLamesDoes) {
  constexpr double inner = 0.05, outer = 0.1, young = 1e5, poisson = 0.3, pressure = 10;
  const auto error = [&](int n) {
    const std::string file = (folder_ / ("ball" + std::to_string(n) + ".mesh")).string();
    const Mesh mesh = hollow_ball(n, n, inner, outer);
    write_medit(file, mesh);
    Json scene = Json::parse(R"({
      "name": "lame", "step": 3, "duration": 36, "gravity": [0, 0, 0], "integrator": "backward-euler",
      "material": {"density": 1, "young": 1e5, "poisson": 0.3, "model": "neo-hookean", "viscosity": 0},
      "forces": [{"sphere": {"centre": [0, 0, 0], "radius": 0.0501}, "pressure": 10, "normals": "current"}]})");
    scene["body"]["mesh"] = file;
    Simulation simulation(parse(scene));
    run(simulation);
    const VertexColumns& v = simulation.body().vertices();
    double squares = 0.0, of_all = 0.0;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vector3d& rest = mesh.points[v.point[k]];
      const double r = rest.norm(), a3 = inner * inner * inner, b3 = outer * outer * outer;
      const double growth =
          pressure * a3 / (b3 - a3) / young * ((1 - 2 * poisson) * r + (1 + poisson) * b3 / (2 * r * r));
      squares += (v.position[k] - rest - growth / r * rest).squaredNorm();
      of_all += growth * growth;
    }
    return std::sqrt(squares / of_all);
  };
  const double coarse = error(2), fine = error(4);
  EXPECT_LE(fine, 0.05);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.4);
}

}  // namespace
}  // namespace dartboard::pressure_closed_forms_test
