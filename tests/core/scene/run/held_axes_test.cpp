// Vertices that are held along some axes: symmetry planes, rails and rollers.

#include "core/plain/held_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "core/scene/file/scene_problem.h"
#include "core/time/integrators.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::held_axes_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr double spacing = 0.125;

/// A box that falls, is stretched along x and turns about x, its middle at x = 0; or its half for positive x, which the
/// middle plane holds along x. Cubes are cut alike in both, and each way of cutting has its mirror image. With `axis` 1
/// or 2, the same along y or z in place of x.
Json box(bool half, const char* material, std::size_t axis = 0) {
  const auto turned = [axis](const Json& vector) {
    Json result = vector;
    for (std::size_t k = 0; k < 3; ++k) result[(k + axis) % 3] = vector[k];
    return result;
  };
  Json scene = Json::parse(R"({"name": "box", "step": 0.0009765625, "duration": 0.0625,
    "body": {"generate": {"box": {"spacing": 0.125, "pattern": "mirrored"}}}})");
  scene["material"] = Json::parse(material);
  scene["gravity"] = turned({0, 0.5, -9.81});
  scene["initial_velocity"] = {{"linear", turned({turned({2, 0, 0}), turned({0, -0.5, 1}), turned({0, -1, 0.25})})},
                               {"centre", turned({0, 0.125, 0.125})}};
  scene["body"]["generate"]["box"]["cells"] = turned({half ? 2 : 4, 2, 2});
  scene["body"]["translate"] = turned({half ? 0.0 : -0.25, 0, 0});
  if (half)
    scene["fixed"] = Json::array({{{"plane", {{"point", {0, 0, 0}}, {"normal", turned({-1, 0, 0})}}},
                                   {"axes", Json::array({std::string(1, "xyz"[axis])})}}});
  return scene;
}

using ByPlace = std::map<std::array<long, 3>, VertexMotion>;
/// Final positions of the vertices of the half, by their places at rest in units of the spacing.
ByPlace of_half(const Json& scene, std::size_t axis) {
  const SceneFile file = parse(scene);
  const Mesh mesh = make_mesh(file);
  Simulation simulation(file);
  run(simulation);
  const VertexColumns& v = simulation.body().vertices();
  ByPlace found;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vector3d rest = mesh.points[v.point[k]] / spacing;
    if (rest[static_cast<int>(axis)] > -0.5)
      found[{std::lround(rest.x()), std::lround(rest.y()), std::lround(rest.z())}] = {v.position[k], v.velocity[k]};
  }
  return found;
}

/// The largest difference between a half of the whole and a half alone, in metres and metres a second.
double difference_from_whole(const char* material, const Json& changes, std::size_t axis = 0) {
  Json whole = box(false, material, axis), half = box(true, material, axis);
  whole.update(changes);
  half.update(changes);
  const ByPlace a = of_half(whole, axis), b = of_half(half, axis);
  EXPECT_EQ(a.size(), 27u);
  EXPECT_EQ(b.size(), 27u);
  double largest = 0.0;
  for (const auto& [place, motion] : a) {
    const VertexMotion& by_itself = b.at(place);
    largest = std::max(
        {largest, (motion.position - by_itself.position).norm(), (motion.velocity - by_itself.velocity).norm()});
  }
  return largest;
}

constexpr const char* springs = R"({"density": 768, "stiffness": 640, "damping": 0, "viscosity": 0.5})";
constexpr const char* elements = R"({"density": 768, "young": 2e4, "poisson": 0.3, "viscosity": 0.5})";

// To rounding, and for implicit methods to their tolerance of 1e-10 of the motion in 64 steps.
TEST(HeldAxes, MakeAHalfMoveAsTheWholeWithEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators())
    for (const char* material : {springs, elements})
      for (const std::size_t axis : {0u, 1u}) {
        const double allowed = entry.make()->scheme().implicit ? 1e-7 : 1e-11;
        EXPECT_LT(difference_from_whole(material, {{"integrator", entry.name}}, axis), allowed)
            << entry.name << ' ' << material << ' ' << axis;
      }
}

TEST(HeldAxes, MakeAHalfMoveAsTheWholeWithEverySolverOfLinearSystems) {
  for (const char* integrator : {"backward-euler", "baraff-witkin"})  // for the second a single solution is the step
    for (const char* solver : {"fresh-factor", "kept-factor", "conjugate-gradients"})
      for (const char* material : {springs, elements})
        EXPECT_LT(difference_from_whole(material, {{"integrator", integrator}, {"solver", solver}}), 1e-7)
            << integrator << ' ' << solver << ' ' << material;
}

// Dampers relax one after the other, in an order that the mirror image does not have: the difference goes with h^2.
TEST(HeldAxes, MakeAHalfMoveAsTheWholeWhereItIsDamped) {
  for (const char* material :
       {R"({"density": 768, "stiffness": 640, "damping": 2.0})",
        R"({"density": 768, "young": 2e4, "poisson": 0.3, "damping": {"ratio": 0.2, "frequency": 10}})"})
    for (const char* integrator : {"verlet", "blanes-moan-4", "rk4"}) {
      const auto with_step = [&](double h) {
        return difference_from_whole(material, {{"integrator", integrator}, {"step", h}});
      };
      const double coarse = with_step(0x1p-11), fine = with_step(0x1p-12);
      EXPECT_LT(coarse, 1e-3) << integrator << ' ' << material;
      EXPECT_LT(fine, 0.3 * coarse + 1e-11) << integrator << ' ' << material;
    }
}

// In a bar on three symmetry planes pulled at its end stress is uniform: it grows longer by F / (E A) and thinner by
// Poisson's ratio times that, to the second order of a strain of 1e-5.
TEST(HeldAxes, LetABarGrowThinnerAsItIsPulled) {
  for (const char* kind : {"tetrahedra", "hexahedra"})
    for (const char* model : {"corotational", "stvk", "neo-hookean"}) {
      Json scene = Json::parse(R"({"name": "bar", "step": 0.25, "duration": 10, "integrator": "backward-euler",
        "body": {"generate": {"box": {"cells": [4, 2, 2], "spacing": 0.125}}}, "gravity": [0, 0, 0],
        "material": {"density": 1000, "young": 1e5, "poisson": 0.25, "viscosity": 20},
        "fixed": [{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}, "axes": ["x"]},
                  {"plane": {"point": [0, 0, 0], "normal": [0, -1, 0]}, "axes": ["y"]},
                  {"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}, "axes": ["z"]}],
        "forces": [{"plane": {"point": [0.5, 0, 0], "normal": [1, 0, 0]}, "pressure": -1.0}]})");
      scene["body"]["generate"]["box"]["kind"] = kind;
      scene["material"]["model"] = model;
      const SceneFile file = parse(scene);
      const Mesh mesh = make_mesh(file);
      Simulation simulation(file);
      run(simulation);
      const VertexColumns& v = simulation.body().vertices();
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Vector3d rest = mesh.points[v.point[k]];
        const Vector3d moved = 1e-5 * rest.cwiseProduct(Vector3d(1, -0.25, -0.25));
        EXPECT_LT((v.position[k] - rest - moved).norm(), 1e-3 * 1e-5)
            << kind << ' ' << model << ' ' << rest.transpose();
        for (int c = 0; c < 3; ++c) {
          if (rest[c] == 0.0) {
            EXPECT_EQ(v.position[k][c], 0.0) << kind << ' ' << model;
          }
        }
      }
    }
}

// The parts of a vertex after an operation are held as it was, and a vertex that refinement puts between held ones
// along the axes common to all of them; a vertex of two selections is held along the axes of both.
TEST(HeldAxes, FollowOperations) {
  Json scene = with_events(box(true, springs), R"([
    {"refine": {"cells": {"box": {"min": [0, 0, 0], "max": [0.125, 0.125, 0.125]}}}, "at": 0.01},
    {"refine": {"cells": {"box": {"min": [0, 0, 0], "max": [0.125, 0.125, 0.125]}}}, "at": 0.015},
    {"dissociate": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}, "at": 0.02}])");
  scene["fixed"].push_back(Json::parse(R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}, "axes": ["z"]})"));
  Simulation simulation(parse(scene));
  const std::size_t before = simulation.body().vertices().size();
  run(simulation);
  const VertexColumns& v = simulation.body().vertices();
  ASSERT_EQ(v.held_axes.size(), v.size());
  EXPECT_GT(v.size(), before + 9);
  std::size_t made = 0, corner = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    EXPECT_EQ(holds(v.held_axes[k], 0), v.position[k].x() == 0.0) << k;
    EXPECT_EQ(holds(v.held_axes[k], 2), v.position[k].z() == 0.0) << k;
    EXPECT_FALSE(holds(v.held_axes[k], 1)) << k;
    made += v.point[k] == no_point && v.held_axes[k] != 0;
    corner += v.held_axes[k] == 5;
  }
  EXPECT_GT(made, 0u);
  EXPECT_GE(corner, 3u);
}

TEST(HeldAxes, AreLetGoByARelease) {
  Json scene = with_events(box(true, springs),
                           R"([{"release": {"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}, "at": 0.02}])");
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.operations(), 9u);
  const VertexColumns& v = simulation.body().vertices();
  for (std::size_t k = 0; k < v.size(); ++k) {
    EXPECT_EQ(v.held_axes[k], 0);
    EXPECT_NE(v.position[k].x(), 0.0);
  }
}

TEST(HeldAxes, AreSaidInSelectionsAndFrames) {
  Json scene = box(true, springs);
  scene["fixed"].push_back(Json::parse(R"({"ids": [0]})"));
  const SceneSurvey survey = survey_of(parse(scene));
  const Simulation simulation(parse(scene));
  EXPECT_EQ(to_string(survey.selections[0]), "/fixed/0: 9 of 27 vertices, along x");
  EXPECT_EQ(to_string(survey.selections[1]), "/fixed/1: 1 of 27 vertices");
  const Frame frame = simulation.frame({.held = true});
  EXPECT_EQ(std::ranges::count(frame.held, 3), 8);
  EXPECT_EQ(std::ranges::count(frame.held, 1), 1);
  EXPECT_EQ(std::ranges::count(frame.held, 0), 18);
}

// A ball comes along the held axis, and the box then slides off it: the bounce is one of the ball's speed, whether or
// not the normal was exactly along the axis at first.
TEST(HeldAxes, DoNotChangeTheSpeedThatABounceBeganWith) {
  const auto energy_with = [](double offset) {
    Json scene = Json::parse(R"({"name": "ball", "step": 0.0005, "duration": 0.05, "gravity": [0, 0, 0],
      "body": {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}},
      "material": {"density": 1000, "young": 1e7, "poisson": 0.3, "viscosity": 0},
      "forces": [{"sphere": {"centre": [0, 0, 0], "radius": 9}, "acceleration": [0, -20, 0], "from": 0.012}],
      "fixed": [{"sphere": {"centre": [0, 0, 0], "radius": 9}, "axes": ["x"]}],
      "contact": {"pressure": 1e5, "depth": 0.02, "restitution": 0.5,
                  "obstacles": [{"sphere": {"radius": 0.099}, "velocity": [1, 0, 0], "until": 0.01}]}})");
    scene["contact"]["obstacles"][0]["sphere"]["centre"] = {-0.1, offset, 0};
    Simulation simulation(parse(scene));
    run(simulation);
    return simulation.diagnostics().kinetic;
  };
  const double expected = energy_with(1e-12);
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(energy_with(0.0), expected, 1e-6 * expected);
}

}  // namespace
}  // namespace dartboard::held_axes_test
