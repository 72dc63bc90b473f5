// The comparison of a part that is split off with the body that it came from.

#include "validation/conservation/split_comparison.h"

#include <gtest/gtest.h>

#include <array>

#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "tests/support/conservation_rows_for_tests.h"

namespace dartboard::split_comparison_test {
namespace {

constexpr std::array checks{Check::split_cells, Check::split_sums, Check::split_bits};
constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

/// A moving box, one cell of which has come loose.
template <class Map>
struct LooseCell {
  Problem start = moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1);
  Subject<Map> at{start};
  ConservationResult result;
  ConservationLedger ledger{result, 1, checks};

  LooseCell() {
    std::vector<Dart> sides;
    at.for_each_side_of(4, [&](std::uint32_t side) {
      sides.push_back(at.places.side[side]);
      at.cells.dissociate(side);
    });
    follow(at.body, at.views, dissociate_all(at.body.map, sides));
  }
  void split(std::vector<std::uint32_t> leaving) { split_off_and_compare(at, leaving, ledger); }
};

template <class Map>
struct SplitComparison : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SplitComparison, Solids);

TYPED_TEST(SplitComparison, PassesAPartThatTakesAlongWhatIsItsOwn) {
  LooseCell<TypeParam> loose;
  ASSERT_EQ(loose.at.cells.count_components(), 2u);
  EXPECT_EQ(loose.at.cells.component(4), std::vector<std::uint32_t>{4});
  loose.split({4});
  EXPECT_FALSE(loose.result.violation);
  for (const ConservedRow& row : loose.result.rows) EXPECT_GT(row.checks, 0u) << row.what;
  EXPECT_EQ(loose.at.body.cell_dart.size(), 11u);
  Views rebuilt;
  rebuilt.rebuild(loose.at.body);
  EXPECT_EQ(loose.at.views, rebuilt);
}

TYPED_TEST(SplitComparison, FailsWhenAnotherCellWasToLeave) {
  LooseCell<TypeParam> loose;
  loose.split({4, 5});
  ASSERT_TRUE(loose.result.violation);
  EXPECT_NE(loose.result.violation->what.find("cells of a part"), std::string::npos) << loose.result.violation->what;
}

TYPED_TEST(SplitComparison, FailsWhenASpringOfThePartHasOtherEnds) {
  LooseCell<TypeParam> loose;
  // in the arrays of the body, a spring of the part goes to the vertex that is farthest from its first end
  auto& edge = loose.at.views.cells
                   .edges[loose.at.body.edge(loose.at.body.map, loose.at.places.corner[loose.start.mesh.first[4]])];
  const auto& x = loose.at.body.vertices.position;
  const auto distance = [&](std::size_t k) { return (x[k] - x[edge.ends[0]]).norm(); };
  std::uint32_t farthest = 0;
  for (std::uint32_t k = 1; k < x.size(); ++k)
    if (distance(k) > distance(farthest)) farthest = k;
  edge.ends[1] = farthest;
  loose.split({4});
  ASSERT_TRUE(loose.result.violation);
  // its elongation and its motion differ
  for (const char* what : {"sums of part and rest", "motion as within the body"})
    EXPECT_FALSE(row(loose.result, what).holds) << what;
}

}  // namespace
}  // namespace dartboard::split_comparison_test
