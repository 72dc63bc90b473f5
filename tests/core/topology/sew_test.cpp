#include "core/topology/sew.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"

namespace dartboard::sew_test {
namespace {

// An independent answer to "can a and b be i-sewn": follow the commuting involutions from the pair (a, b) and ask for a
// one-to-one pairing of i-free darts that is an involution without fixed points where it meets itself.
template <int i, class Map>
bool sewable_by_definition(const Map& map, Dart a, Dart b) {
  const Involutions set = sew_involutions(Map::dimension, i);
  std::map<Dart, Dart> there, back;
  std::vector<std::pair<Dart, Dart>> open{{a, b}};
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    if (x == y || !map.template is_free<i>(x) || !map.template is_free<i>(y)) return false;
    const bool new_x = there.emplace(x, y).second, new_y = back.emplace(y, x).second;
    if (there[x] != y || back[y] != x || new_x != new_y) return false;
    if (!new_x) continue;
    for (int j = 0; j <= Map::dimension; ++j)
      if (set.contains(j)) open.push_back({map.alpha(j, x), map.alpha(j, y)});
  }
  for (const auto& [x, y] : there)
    if (there.contains(y) && there[y] != x) return false;
  return true;
}

// Try to sew two darts: it must happen exactly when the definition allows it, keep the map valid, be undone by unsew
// from any of its darts, and change nothing when refused.
template <int i, class Map>
void try_to_sew(Map& map, Dart a, Dart b) {
  const auto before = map.hash();
  if (!sewable_by_definition<i>(map, a, b)) {
    EXPECT_THROW(sew<i>(map, a, b), TopologyError);
    ASSERT_EQ(map.hash(), before);
    return;
  }
  ASSERT_EQ(why_not_sewable<i>(map, a, b), std::nullopt);
  sew<i>(map, a, b);
  ASSERT_EQ(map.template alpha<i>(a), b);
  ASSERT_EQ(check(map), "") << i << "-sewing " << to_string(a) << " and " << to_string(b);
  const auto after = map.hash();
  for (const Dart d : orbit(map, sew_involutions(Map::dimension, i), b)) {
    const Dart other = map.template alpha<i>(d);
    unsew<i>(map, d);
    ASSERT_EQ(map.hash(), before) << i << "-unsewing " << to_string(d);
    sew<i>(map, d, other);
    ASSERT_EQ(map.hash(), after) << i << "-sewing again " << to_string(d);
  }
}

template <class Map>
class Sew : public testing::Test {};
using Maps = testing::Types<Map2, Map3>;
TYPED_TEST_SUITE(Sew, Maps);

// From loose darts, so that open faces, folded cells and lines of every length occur.
TYPED_TEST(Sew, AgreesWithTheDefinitionForEveryIInRandomMaps) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 bits(seed);
    const auto n = static_cast<std::uint32_t>(4 + bits() % 21);
    TypeParam map;
    for (std::uint32_t k = 0; k < n; ++k) map.add_dart();
    for (int step = 0; step < 120 && !this->HasFatalFailure(); ++step) {
      const Dart a{static_cast<std::uint32_t>(bits() % n)}, b{static_cast<std::uint32_t>(bits() % n)};
      const auto i = bits() % (TypeParam::dimension + 1);
      if (bits() % 4 == 0) {
        if (i == 0) unsew<0>(map, a);
        if (i == 1) unsew<1>(map, a);
        if (i == 2) unsew<2>(map, a);
        if constexpr (TypeParam::dimension == 3)
          if (i == 3) unsew<3>(map, a);
        ASSERT_EQ(check(map), "") << i << "-unsewing " << to_string(a) << ", seed " << seed << ", step " << step;
        ASSERT_TRUE(map.is_free(static_cast<int>(i), a));
      } else {
        if (i == 0) try_to_sew<0>(map, a, b);
        if (i == 1) try_to_sew<1>(map, a, b);
        if (i == 2) try_to_sew<2>(map, a, b);
        if constexpr (TypeParam::dimension == 3)
          if (i == 3) try_to_sew<3>(map, a, b);
      }
    }
  }
}

TEST(Unsew, FreesAnEdgeThatHasAnotherVolumeButNoOtherFace) {
  Map3 map;
  for (int k = 0; k < 4; ++k) map.add_dart();
  sew<0>(map, {0}, {1});
  sew<0>(map, {2}, {3});
  sew<3>(map, {0}, {2});  // 2-free, but not 3-free
  unsew<0>(map, {0});
  for (std::uint32_t d = 0; d < 4; ++d) EXPECT_TRUE(map.is_free<0>({d})) << d;
  EXPECT_EQ(check(map), "");
}

TEST(Unsew, OfAFreeDartDoesNothing) {
  Map3 map;
  add_cell(map, CellKind::prism);
  const auto before = map.hash();
  unsew<3>(map, {5});
  EXPECT_EQ(map.hash(), before);
}

TEST(Unsew, OfADeadDartIsRefused) {
  Map3 map;
  EXPECT_THROW(unsew<1>(map, Dart{3}), TopologyError);
}

std::string why(const std::function<void()>& action) {
  try {
    action();
  } catch (const TopologyError& error) {
    return error.what();
  }
  return "sewn";
}

TEST(SewOnCells, RefusesATriangleOnAQuadrilateral) {
  Map3 map;
  const Dart prism = add_cell(map, CellKind::prism), cube = add_cell(map, CellKind::hexahedron);
  const auto before = map.hash();
  EXPECT_EQ(why([&] { sew<3>(map, prism, cube); }),
            "cannot 3-sew d0 and d36: the cells do not have the same number of darts");
  EXPECT_EQ(why([&] { sew<3>(map, cube, prism); }),
            "cannot 3-sew d36 and d0: the cells do not have the same number of darts");
  EXPECT_EQ(map.hash(), before);
}

TEST(SewOnCells, RefusesAnOpenFaceOnAClosedOne) {
  Map3 map;
  const Dart prism = add_cell(map, CellKind::prism);
  const Dart a = map.add_dart(), b = map.add_dart();
  map.link<0>(a, b);
  const auto before = map.hash();
  EXPECT_NE(why([&] { sew<3>(map, a, prism); }).find("do not have the same structure"), std::string::npos);
  EXPECT_NE(why([&] { sew<3>(map, prism, b); }).find("do not have the same structure"), std::string::npos);
  EXPECT_EQ(map.hash(), before);
}

TEST(SewOnCells, NamesTheDartThatIsNotFree) {
  Map2 map;
  const Dart a = add_cell(map, CellKind::triangle), b = add_cell(map, CellKind::triangle),
             c = add_cell(map, CellKind::triangle);
  sew<2>(map, a, b);
  EXPECT_EQ(why([&] { sew<2>(map, a, c); }), "cannot 2-sew d0 and d12: alpha2(d0) = d6, expected free");
  EXPECT_EQ(why([&] { sew<2>(map, c, b); }), "cannot 2-sew d12 and d6: alpha2(d6) = d0, expected free");
}

TEST(SewOnCells, RefusesADartWithItselfAndDeadDarts) {
  Map2 map;
  const Dart a = add_cell(map, CellKind::triangle);
  EXPECT_EQ(why([&] { sew<2>(map, a, a); }), "cannot 2-sew d0 and d0: a dart cannot be sewn to itself");
  EXPECT_EQ(why([&] { sew<2>(map, a, Dart{6}); }), "cannot 2-sew d0 and d6: d6 is dead");
  EXPECT_EQ(why([&] { sew<2>(map, Dart{6}, a); }), "cannot 2-sew d6 and d0: d6 is dead");
}

TEST(SewOnCells, FoldsATriangleByAReflectionAndNotByATurn) {
  Map3 map;
  const Dart d = add_cell(map, CellKind::tetrahedron);
  EXPECT_NE(why([&] { sew<3>(map, d, {2}); }).find("lie on one cell"), std::string::npos);
  EXPECT_NE(why([&] { sew<3>(map, d, {4}); }).find("lie on one cell"), std::string::npos);
  for (const std::uint32_t there : {1u, 3u, 5u}) {
    sew<3>(map, d, {there});
    EXPECT_EQ(check(map), "");
    unsew<3>(map, {2});
  }
}

TEST(SewOnCells, FoldsAQuadrilateralByAHalfTurnAndNotByAQuarter) {
  Map3 map;
  const Dart d = add_cell(map, CellKind::hexahedron);
  EXPECT_NE(why([&] { sew<3>(map, d, {2}); }).find("lie on one cell"), std::string::npos);
  sew<3>(map, d, {4});
  EXPECT_EQ(check(map), "");
}

TEST(SewOnCells, LinksAllDartsOfAFace) {
  Map3 map;
  const Dart a = add_cell(map, CellKind::hexahedron), b = add_cell(map, CellKind::hexahedron);
  sew<3>(map, a, b);
  for (std::uint32_t k = 0; k < 8; ++k) EXPECT_EQ(map.alpha<3>({a.index + k}), Dart{b.index + k});
  EXPECT_TRUE(map.is_free<3>({a.index + 8}));
}

// Both storages number the darts of tetrahedra alike, so the same sequence must do the same, refusals included.
TEST(SewOnTetMap, DoesAsOnMap3DartByDart) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 bits(seed);
    Map3 general;
    TetMap tetrahedral;
    const auto tetrahedra = static_cast<std::uint32_t>(1 + bits() % 4);
    for (std::uint32_t t = 0; t < tetrahedra; ++t)
      ASSERT_EQ(add_cell(general, CellKind::tetrahedron), add_cell(tetrahedral, CellKind::tetrahedron));
    for (int step = 0; step < 200; ++step) {
      const Dart a{static_cast<std::uint32_t>(bits() % (24 * tetrahedra))};
      const Dart b{static_cast<std::uint32_t>(bits() % (24 * tetrahedra))};
      if (bits() % 3 == 0) {
        unsew<3>(general, a);
        unsew<3>(tetrahedral, a);
      } else {
        const auto before = tetrahedral.hash();
        const std::string said = why([&] { sew<3>(tetrahedral, a, b); });
        ASSERT_EQ(why([&] { sew<3>(general, a, b); }), said);
        ASSERT_TRUE(said == "sewn" || tetrahedral.hash() == before);
      }
      for (std::uint32_t d = 0; d < 24 * tetrahedra; ++d)
        ASSERT_EQ(general.alpha<3>({d}), tetrahedral.alpha<3>({d})) << "seed " << seed << ", step " << step;
      ASSERT_EQ(check(tetrahedral), "");
    }
  }
}

}  // namespace
}  // namespace dartboard::sew_test
