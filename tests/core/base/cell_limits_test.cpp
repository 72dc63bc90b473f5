// The ends of the 32-bit numbers, without a map that is as large.

#include "core/base/cell_limits.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/generalized_map.h"
#include "core/topology/storage/room.h"

namespace dartboard::cell_limits_test {
namespace {

constexpr std::uint64_t numbers = std::uint64_t{1} << 32;

TEST(CellLimits, OfTetrahedraAreWhereFaceAndTurnEnd) {
  // the last face slot of the last tetrahedron, and the largest turn; 7 is left for a dead one
  const auto packed = [](std::uint64_t t) { return 8 * (4 * t + 3) + 5; };
  EXPECT_LT(packed(most_tetrahedra - 1), numbers);
  EXPECT_GE(packed(most_tetrahedra), numbers);
  EXPECT_LT(24 * most_tetrahedra - 1, no_dart.index);
}

TEST(CellLimits, OfDartsAreWhereTheirAlphasEnd) {
  for (const std::uint64_t n : {2u, 3u}) {
    const std::uint64_t last = most_darts(static_cast<int>(n)) - 1;
    EXPECT_LT((n + 1) * last + n, numbers);
    EXPECT_GE((n + 1) * (last + 1) + n, numbers);
  }
}

TEST(CellLimits, CountTheDartsThatAMapHas) {
  for (const CellKind kind : {CellKind::tetrahedron, CellKind::pyramid, CellKind::prism, CellKind::hexahedron}) {
    GeneralizedMap<3> map;
    add_cell(map, kind);
    EXPECT_EQ(map.dart_count(), static_cast<std::size_t>(darts_of(kind))) << name(kind);
  }
  for (const CellKind kind : {CellKind::triangle, CellKind::quadrilateral}) {
    GeneralizedMap<2> map;
    add_cell(map, kind);
    EXPECT_EQ(map.dart_count(), static_cast<std::size_t>(darts_of(kind))) << name(kind);
  }
}

TEST(CellLimits, LetAMeshBeAsLargeAsAMapAndNoLarger) {
  const auto of = [](CellKind kind, double count) {
    CountsByKind cells{};
    cells[static_cast<std::size_t>(kind)] = count;
    return beyond_a_map(cells);
  };
  EXPECT_EQ(beyond_a_map({}), "");
  EXPECT_EQ(of(CellKind::tetrahedron, 134217728), "");
  EXPECT_EQ(of(CellKind::tetrahedron, 134217729), "134217729 tetrahedra, where a map numbers at most 134217728");
  EXPECT_EQ(of(CellKind::hexahedron, 22369621), "");
  EXPECT_EQ(of(CellKind::hexahedron, 22369622),
            "22369622 cells with 1073741856 darts, where a map numbers at most 1073741824");
  EXPECT_EQ(of(CellKind::triangle, 238609294), "");
  EXPECT_NE(of(CellKind::triangle, 238609295), "");
}

TEST(RequireRoom, LetsALastOneInAndRefusesTheNextWithItsNumberAndTheLimit) {
  EXPECT_NO_THROW(require_room(most_tetrahedra - 1, 1, most_tetrahedra, "tetrahedra"));
  try {
    require_room(most_tetrahedra, 1, most_tetrahedra, "tetrahedra");
    FAIL() << "accepted";
  } catch (const TopologyError& error) {
    EXPECT_STREQ(error.what(), "cannot add 1 to the 134217728 tetrahedra of a map: it numbers at most 134217728");
  }
  try {
    require_room(60, 48, 100, "darts");
    FAIL() << "accepted";
  } catch (const TopologyError& error) {
    EXPECT_STREQ(error.what(), "cannot add 48 to the 60 darts of a map: it numbers at most 100");
  }
  EXPECT_NO_THROW(require_room(most_darts(3) - 48, 48, most_darts(3), "darts"));
  EXPECT_THROW(require_room(most_darts(3) - 47, 48, most_darts(3), "darts"), TopologyError);
  EXPECT_THROW(require_room(0, std::numeric_limits<std::uint64_t>::max(), most_darts(3), "darts"), TopologyError);
}

}  // namespace
}  // namespace dartboard::cell_limits_test
