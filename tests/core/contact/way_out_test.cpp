// The search through triangles for the way out of a tetrahedron that a place is inside of.

#include "core/contact/way_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/places/nearest_on_triangle.h"

namespace dartboard::way_out_test {
namespace {

using Eigen::Vector3d;

/// A tetrahedron, and triangles with one or more of its corners, in no order: some twice, with another face, some
/// without area, and one at a place that is not a number.
struct Ways {
  std::vector<Vector3d> x, w;
  std::vector<SkinSample> samples;  // a vertex each
  SkinSolids solids;

  explicit Ways(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    constexpr std::uint32_t nodes = 12, faces = 18;
    for (std::uint32_t i = 0; i < nodes; ++i) {
      x.emplace_back(number(random), number(random), number(random));
      w.emplace_back(number(random), number(random), number(random));
      samples.push_back({.nodes = {i}, .count = 1});
    }
    x[4] = x[5];
    w[4] = w[5];
    x[11].y() = std::numeric_limits<double>::quiet_NaN();
    solids.resize(nodes, faces, 3);
    for (std::uint32_t cell = 0; cell < 3; ++cell)  // the others: their nodes are watched
      solids.add(SkinTetrahedron{.nodes = {4 * cell, 4 * cell + 1, 4 * cell + 2, 4 * cell + 3}, .cell = cell});
    std::uint32_t face = faces;
    while (face > 0) {
      SkinTriangle t;
      t.nodes = {static_cast<std::uint32_t>(random() % 4), static_cast<std::uint32_t>(random() % 4),
                 static_cast<std::uint32_t>(4 + random() % 8)};
      if (t.nodes[0] == t.nodes[1]) t.nodes[1] = 4 + (t.nodes[2] + 1) % 8;
      for (int twice = random() % 3 == 0 ? 2 : 1; twice > 0 && face > 0; --twice) {
        t.face = --face;
        solids.add(t);
      }
    }
  }
  /// The number of the nearest, by comparing all of them.
  std::uint32_t nearest(const SkinSample& sample, const Vector3d& y, const StagePlaces& at) const {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t best = BodyTouch::none;
    for (std::uint32_t k = 0; k < solids.triangles().size(); ++k) {
      const SkinTriangle& t = solids.triangles()[k];
      bool of_sample = false;
      for (const std::uint32_t i : sample.corners())
        for (const std::uint32_t j : t.nodes) of_sample = of_sample || i == j;
      if (of_sample) continue;
      const auto to = [&](std::size_t corner) -> Vector3d { return at.place(t.nodes[corner]) - y; };
      const double square = nearest_on_triangle(to(0), to(1), to(2)).way.squaredNorm();
      if (!(square < least || (square == least && t.face < solids.triangles()[best].face))) continue;
      least = square;
      best = k;
    }
    return best;
  }
};

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same_bits(const BodyTouch& a, const BodyTouch& b) {
  return a.triangle == b.triangle && same_bits(a.depth, b.depth) && same_bits(a.normal.x(), b.normal.x()) &&
         same_bits(a.normal.y(), b.normal.y()) && same_bits(a.normal.z(), b.normal.z()) && a.nearest == b.nearest;
}

TEST(WayOut, IsThroughTheNearestTriangle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-0.7, 0.7);
  std::array<std::size_t, 18> times{};
  const ContactGroups groups;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Ways heap(seed);
    const CandidatePairs candidates(heap.samples, heap.solids, groups);
    WaysOut ways(heap.samples, heap.solids, candidates);
    for (const StagePlaces& at : {StagePlaces{heap.x}, StagePlaces{heap.x, heap.w, 0.1}})
      for (int k = 0; k < 30; ++k) {
        BodyTouch found{.sample = 4u + static_cast<std::uint32_t>(random() % 8)};
        const Vector3d y(number(random), number(random), number(random));
        const std::uint32_t expected = heap.nearest(heap.samples[found.sample], y, at);
        ways.search(y, at, found);
        EXPECT_EQ(found.triangle, expected) << seed << ", " << k;
        if (expected != BodyTouch::none) ++times[expected];
      }
  }
  for (const std::size_t each : times) EXPECT_GT(each, 20u);
}

// Step after step: all nodes move at random, some by leaps; or those of the tetrahedron alone; or these and the samples
// along an axis, against each other. Some of the steps are not followed.
TEST(WayOut, IsThatOfASearchWhereItIsFollowed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const ContactGroups groups;
  std::size_t found = 0, searched = 0, changed = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Ways heap(seed);
    heap.x[11].y() = 0.1;
    CandidatePairs candidates(heap.samples, heap.solids, groups);
    candidates.set_margin(seed % 2 == 0 ? 1e-3 : 4.0);  // few or many triangles are kept
    WaysOut followed(heap.samples, heap.solids, candidates), anew(heap.samples, heap.solids, candidates);
    std::array<std::uint32_t, 12> last{};
    for (int step = 0; step < 200; ++step) {
      const Vector3d along = 0.02 * number(random) * Vector3d::Unit(step % 3);
      for (std::size_t i = 0; i < (step % 4 == 1 ? 4 : 12); ++i)
        heap.x[i] += step % 4 == 3 ? Vector3d(i < 4 ? along : -along)
                                   : Vector3d((random() % 16 == 0 ? 0.05 : 0.005) *
                                              Vector3d(number(random), number(random), number(random)));
      const StagePlaces at{heap.x};
      candidates.make_sure(at, step % 9 < 6);
      for (std::uint32_t i = 4; i < 12; ++i) {
        BodyTouch touch{.sample = i}, expected{.sample = i};
        EXPECT_EQ(followed.find(heap.x[i], at, touch), anew.search(heap.x[i], at, expected));
        EXPECT_TRUE(same_bits(touch, expected)) << seed << ", " << step << ", " << i;
        changed += step > 0 && last[i] != expected.triangle ? 1 : 0;
        last[i] = expected.triangle;
      }
    }
    found += anew.searched();
    searched += followed.searched();
  }
  EXPECT_LT(searched, found * 2 / 3);
  EXPECT_GT(changed, found / 50);
}

// Nine triangles around the sample, of which eight are kept: the farthest comes up to it, step by step.
TEST(WayOut, IsThroughATriangleThatWasNotKeptOnceItHasComeNear) {
  for (const bool farthest_is_first : {false, true}) {
    std::vector<Vector3d> x{{0, 0, 100}, {0, 0, 101}, {1, 0, 100}, {0, 1, 100}, {0, 0, 0}};
    SkinSolids solids;
    solids.resize(5 + 2 * 9, 9, 6);
    solids.add(SkinTetrahedron{.nodes = {0, 1, 2, 3}});
    for (std::uint32_t k = 0; k < 9; ++k) {
      const double angle = 0.7 * k, far = 1.0 + 0.01 * k;
      for (const double z : {0.0, 1.0}) x.emplace_back(far * std::cos(angle), far * std::sin(angle), z);
    }
    for (std::uint32_t cell = 1; cell < 6; ++cell)  // so that all nodes are watched
      solids.add(
          SkinTetrahedron{.nodes = {4 * cell, 4 * cell + 1, 4 * cell + 2, std::min(4 * cell + 3, 22u)}, .cell = cell});
    for (std::uint32_t k = 0; k < 9; ++k) {
      const std::uint32_t face = farthest_is_first ? 8 - k : k;
      solids.add(SkinTriangle{.nodes = {0, 5 + 2 * face, 6 + 2 * face}, .face = face});
    }
    const std::vector<SkinSample> samples{{.nodes = {4}, .count = 1}};
    const ContactGroups groups;
    CandidatePairs candidates(samples, solids, groups);
    candidates.set_margin(1000.0);
    WaysOut ways(samples, solids, candidates);
    BodyTouch touch;
    for (int step = 0; step < 20; ++step) {
      candidates.make_sure({x}, true);
      ways.find(x[4], {x}, touch);
      if (step == 0) {
        EXPECT_EQ(solids.triangles()[touch.triangle].face, 0u);
      }
      for (const std::size_t node : {21u, 22u})
        for (int c : {0, 1}) x[node][c] *= 0.98;
    }
    EXPECT_EQ(solids.triangles()[touch.triangle].face, 8u) << farthest_is_first;
    EXPECT_LT(ways.searched(), 15u);
  }
}

}  // namespace
}  // namespace dartboard::way_out_test
