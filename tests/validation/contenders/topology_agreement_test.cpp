// The gate of topology: CGAL's counts are compared with ours, number by number.

#include "validation/contenders/topology_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/plain/error.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::topology_agreement_test {
namespace {

// The unit cube of six tetrahedra around its diagonal.
MapSummary cube_by_us() {
  MapSummary cube;
  cube.dimension = 3;
  cube.darts = 144;
  cube.cells = {8, 19, 18, 6};
  cube.components = 1;
  return cube;
}
constexpr reference::CgalCounts cube_by_cgal{144, 8, 19, 18, 6, 1};

std::vector<std::string> differ(const std::vector<CountAgreement>& all) {
  std::vector<std::string> names;
  for (const CountAgreement& a : all)
    if (!a.agrees()) names.push_back(a.what);
  return names;
}

TEST(CompareCounts, AgreeOnTheCube) {
  const auto all = set_side_by_side(cube_by_us(), cube_by_cgal);
  EXPECT_EQ(all.size(), 6u);
  EXPECT_TRUE(differ(all).empty());
}

TEST(CompareCounts, StartFromNothingOnEitherSide) {
  const CountAgreement none;
  EXPECT_EQ(none.ours, 0u);
  EXPECT_EQ(none.cgal, 0u);
  EXPECT_TRUE(none.agrees());
}

TEST(CompareCounts, NameWhatCgalCountsOneMoreOf) {
  const std::pair<const char*, std::size_t reference::CgalCounts::*> columns[]{
      {"darts", &reference::CgalCounts::darts},     {"vertices", &reference::CgalCounts::vertices},
      {"edges", &reference::CgalCounts::edges},     {"faces", &reference::CgalCounts::faces},
      {"volumes", &reference::CgalCounts::volumes}, {"components", &reference::CgalCounts::components}};
  for (const auto& [name, column] : columns) {
    reference::CgalCounts more = cube_by_cgal;
    ++(more.*column);
    EXPECT_EQ(differ(set_side_by_side(cube_by_us(), more)), std::vector<std::string>{name});
  }
}

TEST(CompareCounts, NameWhatWeCountOneMoreOf) {
  const char* names[]{"vertices", "edges", "faces", "volumes"};
  for (std::size_t i = 0; i < 4; ++i) {
    MapSummary more = cube_by_us();
    ++more.cells[i];
    EXPECT_EQ(differ(set_side_by_side(more, cube_by_cgal)), std::vector<std::string>{names[i]});
  }
}

TEST(CompareCounts, CountBothMapsOfAMesh) {
  Problem problem;
  problem.mesh = kuhn_grid(1, 1, 1, 1.0);
  const auto all = compare_counts(problem);
  EXPECT_TRUE(differ(all).empty());
  const std::size_t known[]{144, 8, 19, 18, 6, 1};
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].ours, known[k]) << all[k].what;
    EXPECT_EQ(all[k].cgal, known[k]) << all[k].what;
  }
}

// Only CGAL's body refuses two tetrahedra that touch in a point: so it was used.
TEST(CompareCounts, AskCgal) {
  Problem problem;
  problem.mesh = regular_tetrahedron();
  for (std::size_t k = 1; k < 4; ++k) problem.mesh.points.push_back(-problem.mesh.points[k]);
  problem.mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 4, 6, 5});
  EXPECT_THROW(compare_counts(problem), InputError);
}

}  // namespace
}  // namespace dartboard::topology_agreement_test
