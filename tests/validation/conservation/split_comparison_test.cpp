// The comparison of a part that is split off with the body it came from.

#include "validation/conservation/split_comparison.h"

#include <gtest/gtest.h>

#include <array>

#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "tests/support/conservation_rows_for_tests.h"

namespace dartboard {
namespace {

constexpr std::array checks{Check::split_cells, Check::split_sums, Check::split_bits};
constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

/// A box that moves, of which one cell has come loose.
template <class Map>
struct LooseCell {
  Problem start = moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1);
  LiveBody<Map> body = build_body<Map, Held::by_every_dart>(start);
  RemainingCells cells{start.mesh};
  MeshPlaces places{body, start.mesh, cells};
  Views views;
  ConservationResult result;
  ConservationLedger ledger{result, 1, checks};

  LooseCell() {
    views.rebuild(body);
    std::vector<Dart> sides;
    for (std::uint32_t s = cells.first_side(4); s < cells.first_side(5); ++s) {
      sides.push_back(places.side[s]);
      cells.dissociate(s);
    }
    follow(body, views, dissociate_all(body.map, sides));
  }
  void split(std::vector<std::uint32_t> leaving) {
    split_off_and_compare(body, views, places, cells, leaving, start.h, ledger);
  }
};

template <class Map>
struct SplitComparison : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SplitComparison, Solids);

TYPED_TEST(SplitComparison, PassesAPartThatTakesAlongWhatIsItsOwn) {
  LooseCell<TypeParam> loose;
  ASSERT_EQ(loose.cells.count_components(), 2u);
  EXPECT_EQ(loose.cells.component(4), std::vector<std::uint32_t>{4});
  loose.split({4});
  EXPECT_FALSE(loose.result.violation);
  for (const ConservedRow& row : loose.result.rows) EXPECT_GT(row.checks, 0u) << row.what;
  EXPECT_EQ(loose.body.cell_dart.size(), 11u);
  Views rebuilt;
  rebuilt.rebuild(loose.body);
  EXPECT_EQ(loose.views, rebuilt);
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
  auto& edge = loose.views.cells.edges[loose.body.edge(loose.body.map, loose.places.corner[loose.start.mesh.first[4]])];
  const auto& x = loose.body.vertices.position;
  const auto distance = [&](std::size_t k) { return (x[k] - x[edge.ends[0]]).norm(); };
  std::uint32_t farthest = 0;
  for (std::uint32_t k = 1; k < x.size(); ++k)
    if (distance(k) > distance(farthest)) farthest = k;
  edge.ends[1] = farthest;
  loose.split({4});
  ASSERT_TRUE(loose.result.violation);
  // its elongation and its motion are others
  for (const char* what : {"sums of part and rest", "motion as within the body"})
    EXPECT_FALSE(row(loose.result, what).holds) << what;
}

}  // namespace
}  // namespace dartboard
