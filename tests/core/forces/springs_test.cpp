#include "core/forces/springs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/mechanics/refine.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/topology/cells.h"

namespace dartboard::springs_test {
namespace {

bool same(const Spring& a, const Spring& b) {
  return a.rest_length == b.rest_length && a.stiffness == b.stiffness && a.damping == b.damping;
}

TEST(Springs, HoldNoDampingUntilOneIsDamped) {
  Springs springs;
  springs.push_back({1.0, 2.0, 0.0});
  springs.push_back({3.0, 4.0, 0.0});
  EXPECT_EQ(springs.bytes(), 2 * 2 * sizeof(double));
  EXPECT_EQ(springs.damping_bytes(), 0u);
  EXPECT_EQ(SpringSpan(springs).undamped().size(), 2u);
  springs.push_back({5.0, 6.0, 7.0});
  EXPECT_EQ(springs.bytes(), 3 * 3 * sizeof(double));
  EXPECT_EQ(springs.damping_bytes(), 3 * sizeof(double));
  EXPECT_EQ(SpringSpan(springs).damped().size(), 3u);
  EXPECT_TRUE(SpringSpan(springs).undamped().empty());
  const std::vector<Spring> expected{{1.0, 2.0, 0.0}, {3.0, 4.0, 0.0}, {5.0, 6.0, 7.0}};
  ASSERT_EQ(springs.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_TRUE(same(springs[k], expected[k])) << k;
}

TEST(Springs, HoldDampingThatIsNotANumber) {
  Springs springs;
  springs.push_back({1.0, 2.0, 0.0});
  springs.change(0, [](Spring& s) { s.damping = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_TRUE(std::isnan(springs[0].damping));
}

TEST(Springs, ChangeAndGoAwayInEitherForm) {
  for (const double damping : {0.0, 0.5}) {
    Springs springs;
    for (int k = 0; k < 4; ++k) springs.push_back({1.0 + k, 10.0, damping});
    springs.change(1, [](Spring& s) { s.stiffness *= 2.0; });
    springs.set(2, springs.back());
    springs.pop_back();
    ASSERT_EQ(springs.size(), 3u);
    EXPECT_TRUE(same(springs[1], {2.0, 20.0, damping}));
    EXPECT_TRUE(same(springs.back(), {4.0, 10.0, damping}));
    double sum = 0.0;
    for (const Spring& s : springs) sum += s.rest_length + s.damping;
    EXPECT_EQ(sum, 7.0 + 3 * damping);
  }
}

Problem box_with(double damping) {
  Problem problem;
  problem.mesh = kuhn_box(2, 2, 2, 0.25);
  problem.material = {.density = 1000.0, .stiffness = 4.0, .damping = damping, .viscosity = 0.0};
  return problem;
}

// Damping follows changes of edges: in the body that has it, it is the sum over the cells around, and the body without
// it goes through the same changes with not a byte for it, and has the same springs except for damping.
TEST(Springs, FollowCutsRemovalsAndRefinementWithAndWithoutDamping) {
  auto damped = build_body<TetMap, Held::by_every_dart>(box_with(0.25));
  auto undamped = build_body<TetMap, Held::by_every_dart>(box_with(0.0));
  const auto compare = [&](const char* after) {
    ASSERT_EQ(damped.springs.size(), undamped.springs.size()) << after;
    EXPECT_EQ(undamped.springs.damping_bytes(), 0u) << after;
    EXPECT_EQ(damped.springs.damping_bytes(), damped.springs.size() * sizeof(double)) << after;
    for (std::uint32_t k = 0; k < damped.springs.size(); ++k) {
      const Spring d = damped.springs[k], u = undamped.springs[k];
      EXPECT_TRUE(same(u, {d.rest_length, d.stiffness, 0.0})) << after << ", edge " << k;
      EXPECT_EQ(d.damping, d.stiffness / 16.0) << after << ", edge " << k;  // 0.25 for 4, powers of two
    }
  };
  const auto both = [&](auto&& change) {
    change(damped);
    change(undamped);
  };
  compare("building");
  for (std::uint32_t face = 0; face < 12; ++face)
    both([face](auto& body) { adapt(body, dissociate_face(body.map, body.face_dart[face * 5])); });
  compare("dissociations");
  both([](auto& body) { adapt(body, remove_volume(body.map, body.cell_dart[7])); });
  compare("a removal");
  both([](auto& body) { refine(body, Volume{body.cell_dart[3]}, 1.0); });
  compare("a refinement");
}

}  // namespace
}  // namespace dartboard::springs_test
