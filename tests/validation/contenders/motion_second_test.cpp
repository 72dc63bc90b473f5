#include "validation/contenders/motion_second.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "reference/adjacency_graph.h"

namespace dartboard::motion_second_test {
namespace {

Problem swinging_box() {
  Problem problem;
  problem.mesh = kuhn_box(3, 2, 2, 0.1);
  problem.material = {.density = 1000.0, .stiffness = 50.0, .damping = 0.01, .viscosity = 0.5};
  problem.fixed = {0, 1};
  return problem;
}

/// The arrays of the core in a problem that differs slightly from the one judged.
Contender in(const std::function<void(Problem&)>& change) {
  Contender other = contender("arrays");
  other.make = [change](const Problem& problem) {
    Problem changed = problem;
    change(changed);
    return contender("arrays").make(changed);
  };
  return other;
}

bool agrees(const Contender& c) { return compare_second(swinging_box(), 1.0, std::span(&c, 1)).at(0).agrees; }

TEST(SecondOfMotion, IsThatOfExtendedPrecisionForAllKindsOfBody) {
  const auto all = contenders_for_a_second();
  const auto compared = compare_second(swinging_box(), 1.0, all);
  ASSERT_EQ(compared.size(), 3u);
  for (const SecondOfMotion& s : compared) {
    EXPECT_TRUE(s.agrees) << s.id;
    EXPECT_EQ(s.steps, 1000);
    EXPECT_GT(s.travelled, 0.01);
    // the bound is no more than a hundred times too wide
    EXPECT_GE(s.position, 0.01 * s.position_bound) << s.id;
    EXPECT_GE(s.velocity, 0.01 * s.velocity_bound) << s.id;
  }
}

TEST(SecondOfMotion, HasOneOfEachCarrier) {
  std::vector<Carrier> carriers;
  for (const Contender& c : contenders_for_a_second()) carriers.push_back(c.carrier);
  EXPECT_EQ(carriers, (std::vector{Carrier::core_map, Carrier::adjacency_graph, Carrier::cgal_map}));
}

TEST(SecondOfMotion, IsNotThatOfABodyThatIsOffInTheTwelfthDigit) {
  EXPECT_TRUE(agrees(in([](Problem&) {})));
  EXPECT_FALSE(agrees(in([](Problem& p) { p.material.stiffness *= 1.0 + 1e-12; })));
  EXPECT_FALSE(agrees(in([](Problem& p) { p.material.density *= 1.0 + 1e-12; })));
  EXPECT_FALSE(agrees(in([](Problem& p) { p.h *= 1.0 + 1e-12; })));
}

// Ten steps of a millisecond do not show this.
TEST(SecondOfMotion, IsNotThatOfABodyThatForgetsItsDamping) {
  EXPECT_FALSE(agrees(in([](Problem& p) { p.material.damping = 0.0; })));
  EXPECT_FALSE(agrees(in([](Problem& p) { p.material.viscosity = 0.0; })));
}

TEST(SecondOfMotion, StopsWhoStandsStillAndWhoHasNoNumbers) {
  EXPECT_FALSE(agrees(in([](Problem& p) {
    p.fixed.clear();
    for (std::uint32_t k = 0; k < p.mesh.points.size(); ++k) p.fixed.push_back(k);
  })));
  EXPECT_FALSE(agrees(in([](Problem& p) { p.h = 1.0; })));  // far beyond the stable step
}

}  // namespace
}  // namespace dartboard::motion_second_test
