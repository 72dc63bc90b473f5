#include "validation/elements/region_mix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::region_mix_test {
namespace {

RegionMix mix_named(std::string_view name) {
  for (const RegionMix& mix : region_mixes())
    if (mix.name == name) return mix;
  ADD_FAILURE() << name;
  return {};
}
constexpr std::string_view two_springs = "springs, a part 1000 times as stiff";

TEST(RegionMix, HasOneMaterialOnEachSideOfTheMiddle) {
  const Mesh mesh = hexahedron_box(4, 1, 1, 1.0);
  for (const RegionMix& mix : region_mixes()) {
    const Problem problem = problem_of(mesh, mix);
    if (mix.materials.size() == 1) {
      EXPECT_TRUE(problem.cell_material.empty()) << mix.name;
      continue;
    }
    ASSERT_EQ(problem.cell_material.size(), 4u) << mix.name;
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_EQ(problem.cell_material[c],
                mesh.points[mesh.cell(c)[0]].x() >= 2.0 || mesh.points[mesh.cell(c)[1]].x() > 2.0)
          << mix.name << " " << c;
  }
}

TEST(RegionMix, CoversStiffnessLawsSpringsAndAttachments) {
  std::set<std::string> models;
  std::size_t attached = 0;
  for (const RegionMix& mix : region_mixes()) {
    attached += mix.is_attached;
    if (mix.materials.size() == 1) continue;
    const Material &one = mix.materials[0], &other = mix.materials[1];
    models.insert(std::string(name(one.model)) + " " + std::string(name(other.model)));
    EXPECT_DOUBLE_EQ(other.young, one.model == other.model ? 1e3 * one.young : one.young);
    EXPECT_NE(one.density, other.density);
  }
  EXPECT_EQ(models, (std::set<std::string>{"neo-hookean neo-hookean", "springs springs", "corotational stvk",
                                           "springs neo-hookean"}));
  EXPECT_EQ(attached, 1u);
}

// Two cubes: 12 edges each, four of them both have.
TEST(RegionMix, HasSpringsOfEachRegionByTheReferences) {
  const Mesh mesh = hexahedron_box(2, 1, 1, 2.0);
  const Problem problem = problem_of(mesh, mix_named(two_springs));
  const auto springs = springs_of(mesh, problem.cell_materials());
  ASSERT_EQ(springs.size(), 24u);
  // E V / l^2 of a cube of edge 2 m
  for (std::size_t k = 0; k < 24; ++k) EXPECT_DOUBLE_EQ(springs[k].stiffness, k < 12 ? 3e4 * 2 : 3e7 * 2) << k;
  const Problem half = problem_of(mesh, mix_named("springs and neo-hookean, attached"));
  EXPECT_EQ(springs_of(mesh, half.cell_materials()).size(), 12u);
}

// The four edges along x of 1 m lengthen by a hundredth, all others stay: each holds k 0.01^2 / 2.
TEST(RegionMix, SumsTheEnergyOfSprings) {
  const Mesh mesh = hexahedron_box(1, 1, 1, 1.0);
  const Material springs{.stiffness = 8.0};
  std::vector<Eigen::Vector3d> x = mesh.points;
  for (auto& p : x) p.x() *= 1.01;
  const double energy = static_cast<double>(energy_of(springs_of(mesh, springs), x));
  EXPECT_NEAR(energy / (4 * 8.0 * 0.01 * 0.01 / 2), 1.0, 1e-12);  // a rounding of x over 0.01, twice
}

TEST(RegionMix, AttachesPointsOfOneSideToCellsOfTheOther) {
  const Mesh mesh = kuhn_box(4, 2, 2, 1.0);
  for (const RegionMix& mix : region_mixes()) {
    const Problem problem = problem_of(mesh, mix);
    const auto attachments = attachments_of(problem, mix);
    EXPECT_EQ(attachments.empty(), !mix.is_attached) << mix.name;
    EXPECT_TRUE(std::ranges::is_sorted(attachments, std::ranges::less{}, &Attachment::point));
    for (const Attachment& one : attachments) {
      EXPECT_LT(mesh.points[one.point].x(), 2.0);
      EXPECT_EQ(problem.cell_material[one.cell], 1);
      EXPECT_TRUE(std::ranges::equal(one.corners, mesh.cell(one.cell)));
      EXPECT_GT(one.per_mass, 0.0);
    }
  }
}

}  // namespace
}  // namespace dartboard::region_mix_test
