// The search through tetrahedra for the one that a place may be inside of, four at a time and one at a time.

#include "core/contact/way_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/base/lanes.h"

namespace dartboard::way_out_test {
namespace {

using Eigen::Vector3d;

/// Tetrahedra between random vertices, half of them turned inside out, with faces on the boundary and within.
struct Heap {
  std::vector<Vector3d> x, w;
  std::vector<SkinTetrahedron> tetrahedra;
  std::vector<std::uint32_t> numbers;
  std::vector<Vector3d> places;

  Heap(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
    for (int i = 0; i < 12; ++i) {
      x.push_back(vector());
      w.push_back(vector());
    }
    for (std::uint32_t k = 0; k < 40; ++k) {
      SkinTetrahedron t;
      for (std::size_t a = 0; a < 4; ++a) t.nodes[a] = static_cast<std::uint32_t>((random() % 3) + 3 * a);
      t.cell = k;
      t.outer = static_cast<std::uint16_t>(random() % 16);
      tetrahedra.push_back(t);
    }
    for (std::size_t k = 0; k < count; ++k) numbers.push_back(static_cast<std::uint32_t>(random() % 40));
    for (int k = 0; k < 50; ++k) places.push_back(0.5 * vector());
    places.push_back(x[0]);
    places.push_back(0.5 * (x[0] + x[3]));
    places.push_back((x[0] + x[3] + x[6]) / 3.0);
    places.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  }
};

/// As a loop over all of them by `side_of` finds it.
std::size_t first_inside(const Heap& heap, std::size_t from, const StagePlaces& at, const Vector3d& y,
                         std::size_t& inverted) {
  for (std::size_t k = from; k < heap.numbers.size(); ++k) {
    std::array<double, 4> weights{};
    const Side side = side_of(
        heap.tetrahedra[heap.numbers[k]], y, [&at](std::uint32_t i) { return at.place(i); }, weights);
    if (side == Side::inside) return k;
    if (side == Side::inverted) ++inverted;
  }
  return heap.numbers.size();
}

/// The same, where those that are certainly not it are skipped first.
std::size_t first_inside_in_lanes(const Heap& heap, const StagePlaces& at, const Vector3d& y, std::size_t& inverted) {
  std::size_t k = 0;
  while (k < heap.numbers.size()) {
    k = skip_outside({heap.tetrahedra.data(), heap.numbers}, k, at, y, inverted);
    if (k == heap.numbers.size()) return k;
    Heap one = heap;
    one.numbers = {heap.numbers[k]};
    if (first_inside(one, 0, at, y, inverted) == 0) return k;
    ++k;
  }
  return k;
}

TEST(SideLanes, FindWhatOneAtATimeFinds) {
  if (!lanes_are_on()) GTEST_SKIP() << "this processor has no AVX2";
  std::size_t found = 0, turned = 0;
  for (std::size_t count = 0; count < 12; ++count)
    for (unsigned seed = 0; seed < 8; ++seed) {
      Heap heap(count, seed);
      if (seed == 7) heap.x[4].y() = std::numeric_limits<double>::infinity();
      for (const StagePlaces& at : {StagePlaces{heap.x}, StagePlaces{heap.x, heap.w, 0.1}})
        for (const Vector3d& y : heap.places) {
          std::size_t inverted = 0, inverted_in_lanes = 0;
          const std::size_t expected = first_inside(heap, 0, at, y, inverted);
          EXPECT_EQ(first_inside_in_lanes(heap, at, y, inverted_in_lanes), expected) << count << ", " << seed;
          EXPECT_EQ(inverted_in_lanes, inverted) << count << ", " << seed;
          found += expected < count ? 1 : 0;
          turned += inverted;
        }
    }
  EXPECT_GT(found, 200u);
  EXPECT_GT(turned, 2000u);
}

// All but the last are outside: the lanes of the last four go past none of them.
TEST(SideLanes, SkipThoseThatAreCertainlyOutside) {
  if (!lanes_are_on()) GTEST_SKIP() << "this processor has no AVX2";
  const std::vector<Vector3d> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}};
  const std::vector<SkinTetrahedron> two{{.nodes = {0, 1, 2, 3}}, {.nodes = {4, 5, 6, 7}}};
  for (std::size_t count = 1; count < 10; ++count) {
    std::vector<std::uint32_t> numbers(count, 0);
    numbers.back() = 1;
    std::size_t inverted = 0;
    EXPECT_EQ(skip_outside({two.data(), numbers}, 0, {x}, {5.2, 0.2, 0.2}, inverted), count - 1);
    EXPECT_EQ(skip_outside({two.data(), numbers}, 0, {x}, {3, 0, 0}, inverted), count);
    EXPECT_EQ(inverted, 0u);
  }
}

}  // namespace
}  // namespace dartboard::way_out_test
