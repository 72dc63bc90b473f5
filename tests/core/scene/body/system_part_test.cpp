// Some vertices of a body as a system of their own: the bits of their accelerations are those in the whole.

#include "core/time/system/system_part.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "core/plain/random.h"
#include "core/scene/body/needs.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_problem.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "tests/support/moving_box.h"

namespace dartboard::system_part_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

/// Two bodies alike, the second 1 m to the right of the first, and what acts in them.
Json two(const char* generate, const char* material, const char* more = "{}") {
  Json scene = Json::parse(R"({"name": "two", "step": 0.001, "duration": 1, "integrator": "rk4"})");
  scene["bodies"] = Json::array({{{"generate", Json::parse(generate)}}, {{"generate", Json::parse(generate)}}});
  scene["bodies"][1]["translate"] = {1, 0, 0};
  scene["material"] = Json::parse(material);
  scene.update(Json::parse(more));
  return scene;
}
struct Case {
  const char* name;
  Json scene;
};
std::vector<Case> all_cases() {
  const char* const tetrahedra = R"({"box": {"cells": [2, 2, 2], "spacing": 0.1, "jitter": 0.2}})";
  const char* const hexahedra = R"({"box": {"cells": [2, 2, 2], "spacing": 0.1, "kind": "hexahedra"}})";
  const char* const triangles = R"({"sheet": {"cells": [4, 3], "spacing": 0.1}})";
  const char* const squares = R"({"sheet": {"cells": [4, 3], "spacing": 0.1, "kind": "quadrilaterals"}})";
  const char* const springs = R"({"density": 1000, "stiffness": 60, "damping": 0.1, "viscosity": 0.2})";
  const char* const undamped = R"({"density": 1000, "stiffness": 60, "damping": 0})";
  const char* const elastic = R"({"density": 1000, "young": 2e4, "poisson": 0.3,
      "damping": {"ratio": 0.1, "frequency": 20}})";
  const char* const membrane = R"({"density": 1, "young": 200, "poisson": 0.3, "model": "stvk"})";
  return {
      {"damped springs", two(tetrahedra, springs)},
      {"undamped springs", two(tetrahedra, undamped)},
      {"springs within cells", two(hexahedra, undamped, R"({"diagonals": "faces"})")},
      {"tetrahedra", two(tetrahedra, elastic)},
      {"hexahedra", two(hexahedra, elastic)},
      {"tetrahedra of two materials",
       two(tetrahedra, elastic, R"({"regions": [{"cells": {"box": {"min": [0, 0, 0], "max": [0.15, 1, 1]}},
           "material": {"density": 500, "young": 1e5, "poisson": 0.2}},
           {"cells": {"box": {"min": [1, 0, 0], "max": [1.15, 1, 1]}},
           "material": {"density": 800, "young": 5e4, "poisson": 0.1}}]})")},
      {"triangles with bending", two(triangles, membrane, R"({"bending": {"rigidity": 0.01}})")},
      {"squares", two(squares, membrane)},
      {"second neighbours",
       two(squares, R"({"density": 0.2, "stiffness": 10})", R"({"bending": {"second_neighbours": 4}})")},
      {"attachments", two(tetrahedra, springs, R"({"attachments": [
           {"plane": {"point": [0, 0, 0.2], "normal": [0, 0, 1]}, "stiffness": 1500}]})")},
      {"pressures that follow", two(tetrahedra, elastic, R"({"forces": [
           {"plane": {"point": [0, 0, 0.2], "normal": [0, 0, 1]}, "pressure": 400, "normals": "current"}]})")},
      {"moving air", two(tetrahedra, elastic, R"({"air": {"drag": 0.5, "velocity": [1, -2, 0.5]}})")},
      {"held vertices and pulls", two(tetrahedra, springs, R"({"fixed": [
           {"plane": {"point": [0, 0, 0.2], "normal": [0, 0, 1]}},
           {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}, "axes": ["x", "z"]}],
           "forces": [{"plane": {"point": [0, 0, 0.1], "normal": [0, 0, 1]}, "force": [1, 0, 0]}]})")},
  };
}

struct Halves {
  std::unique_ptr<SimulatedBody> body;
  std::vector<std::uint32_t> second;  // the vertices of the second body

  explicit Halves(const Json& json) {
    const SceneFile scene = parse(json);
    const Problem problem = make_problem(scene);
    body = make_simulated_body(problem, needs_of(scene, problem).body);
    SplitMix64 random(7);
    VertexColumns& v = body->vertices();
    for (std::uint32_t i = 0; i < v.size(); ++i) {
      if (problem.mesh.points[v.point[i]].x() > 0.7) second.push_back(i);
      for (int c = 0; c < 3; ++c) {
        v.position[i][c] += 0.01 * random.next_signed();
        v.velocity[i][c] = random.next_signed();
      }
      if (!v.pull.empty()) v.pull[i] = {0.1 * i, 0, 1};
    }
    for (double& p : body->loads()) p = 300;
  }
};

TEST(SystemPart, HasTheAccelerationsOfItsVerticesInTheWhole) {
  for (const Case& one : all_cases()) {
    SCOPED_TRACE(one.name);
    Halves halves(one.scene);
    const SpringSystem whole = halves.body->system();
    SystemPart part(whole, whole.terms, halves.second);
    part.take(halves.body->motion(), halves.body->pull());
    const std::size_t n = whole.vertex_count(), few = halves.second.size();
    ASSERT_GT(few, 0u);
    ASSERT_LT(few, n);
    std::vector<Vector3d> a(n), own(few);
    accelerations(whole, terms_of(whole), halves.body->motion().x, halves.body->motion().v, a);
    accelerations(part.system(), terms_of(part.system()), part.motion().x, part.motion().v, own);
    for (std::size_t k = 0; k < few; ++k) EXPECT_EQ(own[k], a[halves.second[k]]) << k;
  }
}

TEST(SystemPart, HasTheEnergiesThatAddUpToThoseOfTheWhole) {
  for (const Case& one : all_cases()) {
    SCOPED_TRACE(one.name);
    Halves halves(one.scene);
    const SpringSystem whole = halves.body->system();
    std::vector<std::uint32_t> first;
    for (std::uint32_t i = 0; i < whole.vertex_count(); ++i)
      if (std::ranges::find(halves.second, i) == halves.second.end()) first.push_back(i);
    double sum = 0.0;
    for (const auto& vertices : {first, halves.second}) {
      SystemPart part(whole, whole.terms, vertices);
      part.take(halves.body->motion(), halves.body->pull());
      sum += total_energy(part.system(), part.motion().x, part.motion().v);
    }
    const double all = total_energy(whole, halves.body->motion().x, halves.body->motion().v);
    EXPECT_NEAR(sum, all, 1e-13 * std::abs(all));
  }
}

TEST(SystemPart, GivesBackWhatItTook) {
  Halves halves(all_cases()[0].scene);
  const SpringSystem whole = halves.body->system();
  SystemPart part(whole, whole.terms, halves.second);
  part.take(halves.body->motion(), halves.body->pull());
  const std::uint64_t hash = halves.body->state_hash();
  for (const std::uint32_t i : halves.second) halves.body->vertices().position[i].setZero();
  EXPECT_NE(halves.body->state_hash(), hash);
  part.give(halves.body->motion());
  EXPECT_EQ(halves.body->state_hash(), hash);
}

}  // namespace
}  // namespace dartboard::system_part_test
