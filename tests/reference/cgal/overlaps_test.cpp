#include "reference/cgal/overlaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/plain/error.h"
#include "reference/least_translation.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::overlaps_test {
namespace {

using Eigen::Vector3d;

struct Tetrahedra {
  std::vector<Vector3d> x;
  std::vector<std::array<std::uint32_t, 4>> cells;

  void add(const TetrahedronCorners& corners) {
    const auto k = static_cast<std::uint32_t>(x.size());
    x.insert(x.end(), corners.begin(), corners.end());
    cells.push_back({k, k + 1, k + 2, k + 3});
  }
  void add(const Mesh& mesh, const Vector3d& by) {
    const auto k = static_cast<std::uint32_t>(x.size());
    for (const Vector3d& p : mesh.points) x.emplace_back(p + by);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto n = mesh.cell(c);
      cells.push_back({k + n[0], k + n[1], k + n[2], k + n[3]});
    }
  }
  TetrahedronCorners corners(std::size_t c) const {
    return {x[cells[c][0]], x[cells[c][1]], x[cells[c][2]], x[cells[c][3]]};
  }
  std::vector<Overlap> overlaps() const { return reference::overlaps(x, cells); }
};

const TetrahedronCorners corner{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)};
TetrahedronCorners moved(TetrahedronCorners t, const Vector3d& by) {
  for (Vector3d& x : t) x += by;
  return t;
}

TEST(Overlaps, OfTwoThatTouchInOnePointAreDecidedToTheLastBit) {
  // a corner on the slanted face, and one rounding off it
  const double third = 0.25, next = std::nextafter(0.5, 1.0);
  Tetrahedra touching, apart;
  touching.add(corner);
  touching.add(moved(corner, {third, third, 0.5}));
  apart.add(corner);
  apart.add(moved(corner, {third, third, next}));
  ASSERT_EQ(touching.overlaps().size(), 1U);
  EXPECT_NEAR(touching.overlaps()[0].depth, 0.0, 40 * std::numeric_limits<double>::epsilon());
  EXPECT_TRUE(apart.overlaps().empty());
}

TEST(Overlaps, AreAsDeepAsTheLeastTranslation) {
  Tetrahedra two;
  two.add(corner);
  two.add(moved(corner, {0.25, 0.25, -0.875}));
  const auto found = two.overlaps();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].second, 1U);
  EXPECT_NEAR(found[0].depth, 0.125, 40 * std::numeric_limits<double>::epsilon());
  EXPECT_LE((found[0].along + Vector3d::UnitZ()).norm(), 40 * std::numeric_limits<double>::epsilon());
}

TEST(Overlaps, AreSeenOfWhatIsInsideOut) {
  Tetrahedra two;
  two.add(corner);
  std::swap(two.x[0], two.x[1]);
  two.add(moved(corner, {0.1, 0.1, -0.5}));
  EXPECT_EQ(two.overlaps().size(), 1U);
}

TEST(Overlaps, AreSeenOfOneThatIsWhollyInsideAnother) {
  Tetrahedra two;
  TetrahedronCorners small = corner;
  for (Vector3d& x : small) x = 0.125 * x + Vector3d(0.125, 0.125, 0.125);
  two.add(small);
  two.add(corner);
  EXPECT_EQ(two.overlaps().size(), 1U);
}

TEST(Overlaps, AreNoneWithinABodyAtRestWhoseCellsShareCorners) {
  // for a box only tetrahedra without a common corner are tested, and these are apart
  Tetrahedra box;
  box.add(kuhn_grid(3, 2, 2, 0.5, 0.1, 5), {0, 0, 0});
  EXPECT_TRUE(box.overlaps().empty());
}

TEST(Overlaps, AreNoneOfPairsThatShareACornerHoweverDeepTheyAre) {
  Tetrahedra two;
  two.add(corner);
  two.x.insert(two.x.end(), {{1.1, 0.1, 0.1}, {0.1, 1.1, 0.1}, {0.1, 0.1, 1.1}});
  two.cells.push_back({0, 4, 5, 6});
  EXPECT_TRUE(two.overlaps().empty());
}

TEST(Overlaps, OfBoxesAreThoseOfAllPairsThatSeparatingAxesDoNotPart) {
  // random places: no two of these just touch, and where an axis parts them by more than its rounding they are apart
  Tetrahedra boxes;
  boxes.add(kuhn_grid(2, 2, 2, 0.5, 0.2, 5), {0, 0, 0});
  boxes.add(kuhn_grid(2, 2, 2, 0.5, 0.2, 6), {0.3, 0.4, 0.8});
  boxes.add(kuhn_grid(1, 1, 1, 0.1, 0.2, 7), {0.6, 0.4, 0.7});
  std::vector<Overlap> expected;
  for (std::uint32_t a = 0; a < boxes.cells.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.cells.size(); ++b) {
      bool shared = false;
      for (const std::uint32_t i : boxes.cells[a])
        for (const std::uint32_t j : boxes.cells[b]) shared = shared || i == j;
      if (shared) continue;
      const Translation t = least_translation(boxes.corners(a), boxes.corners(b));
      EXPECT_GT(std::abs(t.depth), 1e-12) << a << " " << b;
      if (t.depth > 0.0) expected.push_back({a, b, t.depth, t.along});
    }
  EXPECT_GT(expected.size(), 100U);
  EXPECT_EQ(boxes.overlaps(), expected);
}

TEST(Overlaps, EndJustAfterTheLeastTranslationAndNotJustBefore) {
  std::mt19937 bits(3);
  const auto number = [&bits] { return static_cast<double>(bits()) / 2147483648.0 - 1.0; };
  const auto place = [&number] {
    const double x = number(), y = number(), z = number();
    return Vector3d(x, y, z);
  };
  int tried = 0;
  for (int k = 0; k < 300; ++k) {
    TetrahedronCorners a{place(), place(), place(), place()}, b{place(), place(), place(), place()};
    const Translation t = least_translation(a, b);
    Tetrahedra here, before, after;
    here.add(a);
    here.add(b);
    before.add(a);
    before.add(moved(b, (t.depth - 1e-12) * t.along));
    after.add(a);
    after.add(moved(b, (t.depth + 1e-12) * t.along));
    EXPECT_EQ(here.overlaps().size(), t.depth > 0.0 ? 1U : 0U) << k;
    if (t.depth <= 0.0) continue;
    ++tried;
    EXPECT_EQ(before.overlaps().size(), 1U) << k;
    EXPECT_TRUE(after.overlaps().empty()) << k;
  }
  EXPECT_GT(tried, 50);
}

TEST(Overlaps, AreNoneOfWhatIsFlat) {
  Tetrahedra two;
  two.add(corner);
  two.add({Vector3d(0, 0, 0.25), Vector3d(1, 0, 0.25), Vector3d(0, 1, 0.25), Vector3d(1, 1, 0.25)});
  EXPECT_TRUE(two.overlaps().empty());
}

TEST(Overlaps, RefuseACornerThatIsNotThereAndAPlaceThatIsNotFinite) {
  Tetrahedra one;
  one.add(corner);
  one.cells[0][3] = 4;
  EXPECT_THROW(one.overlaps(), InputError);
  one.cells[0][3] = 3;
  one.x[3].z() = std::nan("");
  EXPECT_THROW(one.overlaps(), InputError);
}

}  // namespace
}  // namespace dartboard::reference::overlaps_test
