// Forces that faces and edges share by their sizes, in a given direction.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/moving_box.h"

namespace dartboard::tractions_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

/// A body of elements without weight, its end at `length` loaded.
Json loaded(const char* body, double length, const std::string& force) {
  Json scene = Json::parse(R"({"name": "bar", "step": 5, "duration": 500, "gravity": [0, 0, 0],
    "integrator": "backward-euler", "material": {"density": 1000, "young": 20000, "poisson": 0.3},
    "fixed": [{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}, "axes": ["x"]},
              {"box": {"min": [-1, -1e-9, -1], "max": [1, 1e-9, 1]}, "axes": ["y"]}]})");
  scene["body"] = Json::parse(body);
  scene["forces"] = Json::array({Json::parse("{" + force + "}")});
  scene["forces"][0]["plane"] = {{"point", {length, 0, 0}}, {"normal", {1, 0, 0}}};
  return scene;
}
Json loaded_bar(const char* kind, const std::string& force) {
  Json scene = loaded(R"({"generate": {"box": {"cells": [4, 2, 3], "spacing": 0.125}}})", 0.5, force);
  scene["body"]["generate"]["box"]["kind"] = kind;
  scene["fixed"].push_back(Json::parse(R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}, "axes": ["z"]})"));
  return scene;
}
Json loaded_sheet(const char* kind, const std::string& force) {
  Json scene = loaded(R"({"generate": {"sheet": {"cells": [4, 3], "spacing": 0.125}}})", 0.5, force);
  scene["body"]["generate"]["sheet"]["kind"] = kind;
  scene["fixed"].push_back(Json::parse(R"({"sphere": {"centre": [0, 0, 0], "radius": 9}, "axes": ["z"]})"));
  return scene;
}

std::vector<Vector3d> forces_at_start(const Simulation& simulation) {
  const VertexColumns& v = simulation.body().vertices();
  std::vector<Vector3d> force(v.size(), Vector3d(0, 0, 0));
  for (std::size_t k = 0; k < v.pull.size(); ++k) force[k] = v.mass[k] * v.pull[k];
  return force;
}
Vector3d sum(const std::vector<Vector3d>& forces) {
  Vector3d all(0, 0, 0);
  for (const Vector3d& f : forces) all += f;
  return all;
}

/// By how much stretches along x differ at rest: the largest over the smallest displacement per length, less 1.
double unevenness(const Json& scene) {
  Simulation simulation(parse(scene));
  const std::vector<Vector3d> start = simulation.body().vertices().position;
  run(simulation);
  double least = INFINITY, most = 0.0;
  for (std::size_t k = 0; k < start.size(); ++k) {
    if (start[k].x() == 0.0) continue;
    const double stretch = (simulation.body().vertices().position[k] - start[k]).x() / start[k].x();
    least = std::min(least, stretch);
    most = std::max(most, stretch);
  }
  EXPECT_GT(least, 1e-3);
  return most / least - 1.0;
}

TEST(Tractions, AreTheirProductWithTheAreaOfTheFaces) {
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"}) {
    const Simulation simulation(parse(loaded_bar(kind, R"("traction": [3, -1, 2])")));
    EXPECT_LE((sum(forces_at_start(simulation)) - 0.25 * 0.375 * Vector3d(3, -1, 2)).norm(), 1e-15) << kind;
  }
}

TEST(Tractions, AgainstTheNormalAreAPressure) {
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"}) {
    const auto pulled = forces_at_start(Simulation(parse(loaded_bar(kind, R"("traction": [-7, 0, 0])"))));
    const auto pressed = forces_at_start(Simulation(parse(loaded_bar(kind, R"("pressure": 7)"))));
    for (std::size_t k = 0; k < pulled.size(); ++k) EXPECT_LE((pulled[k] - pressed[k]).norm(), 1e-15) << kind;
  }
}

TEST(Tractions, AreTheForceThatFacesShareByTheirAreas) {
  const auto pulled = forces_at_start(Simulation(parse(loaded_bar("tetrahedra", R"("traction": [8, 16, 0])"))));
  const auto shared =
      forces_at_start(Simulation(parse(loaded_bar("tetrahedra", R"("force": [0.75, 1.5, 0], "on": "faces")"))));
  EXPECT_LE((sum(shared) - Vector3d(0.75, 1.5, 0)).norm(), 1e-15);
  for (std::size_t k = 0; k < pulled.size(); ++k) EXPECT_LE((pulled[k] - shared[k]).norm(), 1e-15);
}

// what a state of uniform stress is in equilibrium with: the strain is the same everywhere, and backward Euler's linear
// systems are solved to 1e-10
TEST(Tractions, StretchABarEvenlyWhateverItsCells) {
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"}) {
    EXPECT_LE(unevenness(loaded_bar(kind, R"("traction": [400, 0, 0])")), 1e-7) << kind;
    EXPECT_LE(unevenness(loaded_bar(kind, R"("force": [40, 0, 0], "on": "faces")")), 1e-7) << kind;
  }
  EXPECT_GT(unevenness(loaded_bar("tetrahedra", R"("force": [40, 0, 0])")), 0.02);
}

TEST(Tractions, OnTheEdgeOfASurfaceStretchItEvenly) {
  for (const char* kind : {"triangles", "quadrilaterals"}) {
    EXPECT_LE(unevenness(loaded_sheet(kind, R"("traction": [400, 0, 0], "on": "edges")")), 1e-7) << kind;
    EXPECT_LE(unevenness(loaded_sheet(kind, R"("force": [150, 0, 0], "on": "edges")")), 1e-7) << kind;
  }
  EXPECT_GT(unevenness(loaded_sheet("triangles", R"("force": [150, 0, 0])")), 0.02);
}

TEST(Tractions, OnEdgesAreTheirProductWithTheLengthOfTheBorder) {
  const Simulation simulation(parse(loaded_sheet("triangles", R"("traction": [0, 3, 0], "on": "edges")")));
  EXPECT_LE((sum(forces_at_start(simulation)) - Vector3d(0, 3 * 0.375, 0)).norm(), 1e-15);
}

TEST(Tractions, NeedFacesOrEdgesWithAllCornersSelected) {
  Json scene = loaded_bar("tetrahedra", R"("traction": [1, 0, 0], "on": "edges")");
  EXPECT_EQ(refusal(scene),
            "file: /forces/0/traction: both ends of no edge on the border of a surface are selected; expected one at "
            "least");
  scene = loaded_bar("tetrahedra", R"("force": [1, 0, 0], "on": "faces")");
  scene["forces"][0].erase("plane");
  scene["forces"][0]["ids"] = {1};
  EXPECT_EQ(refusal(scene),
            "file: /forces/0/force: all corners of no face of the boundary are selected; expected one at least");
}

}  // namespace
}  // namespace dartboard::tractions_test
