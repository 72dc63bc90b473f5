#include "core/topology/check.h"

#include <gtest/gtest.h>

#include "core/topology/build.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::check_test {
namespace {

template <class Map>
Map loose_darts(int n) {
  Map map;
  for (int k = 0; k < n; ++k) map.add_dart();
  return map;
}

// Write one alpha and not its partner, as no call of the map would.
template <class Map>
void corrupt(Map& map, int i, Dart d, std::uint32_t value) {
  map.redo({Change::Kind::link, d.index * (Map::dimension + 1) + static_cast<std::uint32_t>(i), 0, value});
}

TEST(Check, FindsNothingInAnEmptyMap) {
  EXPECT_EQ(check(Map2()), "");
  EXPECT_EQ(check(Map3()), "");
  EXPECT_EQ(check(TetMap()), "");
}

TEST(Check, FindsNothingInLooseDarts) { EXPECT_EQ(check(loose_darts<Map3>(3)), ""); }

TEST(Check, FindsNothingInBuiltMaps) {
  EXPECT_EQ(check(build_map<Map3>(mixed_cells()).map), "");
  EXPECT_EQ(check(build_map<Map3>(pinched_ring()).map), "");
  EXPECT_EQ(check(build_map<TetMap>(kuhn_grid(2, 2, 1, 1.0)).map), "");
  EXPECT_EQ(check(build_map<Map2>(klein_lattice()).map), "");
}

TEST(Check, NamesAlpha0Alpha2OfASurface) {
  auto map = loose_darts<Map2>(3);
  map.link<0>({0}, {1});
  map.link<2>({1}, {2});  // 0 and the dart across from 2 should be linked too
  EXPECT_EQ(check(map), "alpha0 alpha2 takes d0 to d2 and d2 to d1: it is not an involution");
}

TEST(Check, NamesAlpha0Alpha2OfASolid) {
  auto map = loose_darts<Map3>(4);
  map.link<0>({0}, {1});
  map.link<0>({2}, {3});
  map.link<2>({0}, {2});
  EXPECT_EQ(check(map), "alpha0 alpha2 takes d0 to d1 and d1 to d2: it is not an involution");
  map.link<2>({1}, {3});
  EXPECT_EQ(check(map), "");
}

TEST(Check, NamesAlpha0Alpha3) {
  auto map = loose_darts<Map3>(4);
  map.link<0>({0}, {1});
  map.link<0>({2}, {3});
  map.link<3>({0}, {2});
  EXPECT_EQ(check(map), "alpha0 alpha3 takes d0 to d1 and d1 to d2: it is not an involution");
}

TEST(Check, NamesAlpha1Alpha3) {
  auto map = loose_darts<Map3>(4);
  map.link<1>({0}, {1});
  map.link<1>({2}, {3});
  map.link<3>({1}, {3});
  EXPECT_EQ(check(map), "alpha1 alpha3 takes d0 to d3 and d3 to d2: it is not an involution");
}

TEST(Check, NamesAFaceSewnByOneDartOnly) {
  Map3 map;
  const Dart a = add_cell(map, CellKind::tetrahedron), b = add_cell(map, CellKind::tetrahedron);
  map.link<3>(a, b);
  EXPECT_EQ(check(map), "alpha0 alpha3 takes d0 to d1 and d1 to d24: it is not an involution");
}

TEST(Check, NamesAFaceUnlinkedAtOneDart) {
  auto map = build_map<Map3>(unequal_tetrahedra()).map;
  Dart sewn{0};
  while (map.is_free<3>(sewn)) ++sewn.index;
  map.unlink<3>(sewn);
  EXPECT_NE(check(map).find("alpha0 alpha3 takes " + to_string(sewn)), std::string::npos) << check(map);
}

TEST(Check, NamesAnAlphaThatIsNotAnInvolution) {
  auto map = loose_darts<Map2>(3);
  corrupt(map, 1, {0}, 2);
  EXPECT_EQ(check(map), "alpha1(d0) = d2 but alpha1(d2) = d2: alpha1 is not an involution");
}

TEST(Check, NamesAnAlphaThatIsDead) {
  auto map = loose_darts<Map2>(3);
  map.remove_dart({1});
  corrupt(map, 0, {2}, 1);
  EXPECT_EQ(check(map), "alpha0(d2) = d1, which is dead");
}

TEST(Check, NamesAnAlphaBeyondTheSlots) {
  auto map = loose_darts<Map2>(1);
  corrupt(map, 2, {0}, 4000000000u);
  EXPECT_EQ(check(map), "alpha2(d0) = d4000000000, which is dead");
}

// The dart two steps away has not been checked itself when the composition passes it.
TEST(Check, SurvivesADeadAlphaInTheMiddleOfAComposition) {
  auto map = loose_darts<Map2>(2);
  map.link<2>({0}, {1});
  corrupt(map, 0, {1}, 4000000000u);
  EXPECT_EQ(check(map), "alpha0 alpha2 takes d0 to d1 and d1 to no dart: it is not an involution");
}

TEST(CheckDart, LooksAtOneDartOnly) {
  auto map = loose_darts<Map2>(4);
  corrupt(map, 1, {3}, 2);
  EXPECT_EQ(check_dart(map, Dart{0}), "");
  EXPECT_NE(check_dart(map, Dart{3}), "");
  EXPECT_EQ(check_dart(map, Dart{9}), "d9 is dead");
}

// In tetrahedral storage one word holds a whole face; it is written here, and not its partner.
TEST(CheckOfTetrahedra, NamesAFaceThatDoesNotLeadBack) {
  auto map = build_map<TetMap>(unequal_tetrahedra()).map;
  Dart inner = no_dart;
  map.for_each_dart([&](Dart d) {
    if (!map.is_free<3>(d)) inner = d;
  });
  const std::uint32_t face = inner.index / 6;
  map.redo({Change::Kind::link, face, 0, 8 * face});  // 3-free, and yet sewn to
  EXPECT_NE(check(map).find("alpha3 is not an involution"), std::string::npos) << check(map);
}

// The opposite face is right and the turn between them is wrong, as stored on one side.
TEST(CheckOfTetrahedra, NamesAFaceThatLeadsBackTurned) {
  for (std::uint32_t more = 1; more < 6; ++more) {
    auto map = build_map<TetMap>(unequal_tetrahedra()).map;
    std::uint32_t face = 0;
    while (map.is_free<3>({6 * face})) ++face;
    const std::uint32_t opposite = map.storage().opposite(face);
    map.redo({Change::Kind::link, face, opposite, opposite - opposite % 8 + (opposite % 8 + more) % 6});
    EXPECT_NE(check(map).find("is not an involution"), std::string::npos) << more << ": " << check(map);
  }
}

TEST(CheckOfTetrahedra, NamesAFaceSewnToATetrahedronBeyondTheSlots) {
  TetMap map;
  map.add_tetrahedron();
  map.redo({Change::Kind::link, 0, 0, 8 * 500000000u});
  EXPECT_EQ(check(map), "alpha3(d0) = d3000000000, which is dead");
}

// Each face of each tetrahedron in turn is made 3-free, and its partner is not: any dart of the partner shows it, and
// no dart of the face itself.
TEST(CheckOfTetrahedra, NamesAFaceByAnyOfItsDarts) {
  const auto good = build_map<TetMap>(kuhn_grid(1, 1, 1, 1.0)).map;
  std::size_t broken = 0;
  for (std::uint32_t face = 0; face < good.capacity() / 6; ++face) {
    if (good.is_free<3>({6 * face})) continue;
    ++broken;
    auto map = good;
    map.redo({Change::Kind::link, face, 0, 8 * face});
    const std::uint32_t partner = good.storage().opposite(face) / 8;
    for (std::uint32_t k = 0; k < 6; ++k) {
      EXPECT_EQ(check_dart(good, Dart{6 * partner + k}), "");
      EXPECT_EQ(check_dart(map, Dart{6 * face + k}), "");
      EXPECT_NE(check_dart(map, Dart{6 * partner + k}), "") << 6 * partner + k;
    }
  }
  EXPECT_EQ(broken, 12u);  // six faces between six tetrahedra, from both sides
}

}  // namespace
}  // namespace dartboard::check_test
