// Bodies that are still, side by side: what touches both of them does not feel the sides where they meet.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/random.h"
#include "tests/support/bodies/term_checks_for_tests.h"
#include "tests/support/bodies/touching_bodies_for_tests.h"

namespace dartboard::covered_ways_test {
namespace {

using Eigen::Vector3d;

/// Some bodies below, which do not move, and what touches them.
struct Scene {
  Mesh mesh;
  std::size_t points_below = 0;
  MeshSkin skin;
  std::vector<Vector3d> x;
  std::unique_ptr<BodyContact> contact;

  Scene(const std::vector<Mesh>& below, const Mesh& above, int exponent) {
    std::vector<std::uint32_t> first_cell;
    for (const Mesh& part : below) {
      first_cell.push_back(static_cast<std::uint32_t>(mesh.cell_count()));
      mesh = first_cell.back() == 0 ? part : together(mesh, part);
    }
    first_cell.push_back(static_cast<std::uint32_t>(mesh.cell_count()));
    points_below = mesh.points.size();
    mesh = together(mesh, above);
    skin = skin_of_mesh<Map3>(mesh, first_cell);
    x = mesh.points;
    std::vector<ContactPair> pairs;
    const auto upper = static_cast<std::uint32_t>(below.size());
    for (std::uint32_t body = 0; body < upper; ++body)
      pairs.push_back({body, upper, law_between(exponent, 1000.0, 0.05)});
    std::vector<std::uint8_t> still(below.size(), 1);
    still.push_back(0);
    contact = std::make_unique<BodyContact>(skin.samples, skin.solids, pairs, still);
  }
  /// The places with what is above somewhere else.
  std::vector<Vector3d> with_upper_at(const Vector3d& by) const {
    std::vector<Vector3d> there = x;
    for (std::size_t i = points_below; i < there.size(); ++i) there[i] += by;
    return there;
  }
  /// By the places of what is above alone: those below have other areas where a box has an edge.
  Vector3d force_on_upper(const std::vector<Vector3d>& places) const {
    Vector3d sum(0, 0, 0);
    for (const BodyTouch& touch : contact->touching({places}))
      if (skin.samples[touch.sample].nodes[0] >= points_below)
        sum += contact->laws()[touch.law].force(touch.area, touch.depth) * touch.normal;
    return sum;
  }
};

Mesh box_from(double from, int cells, double top = 0.0) {
  return shifted(kuhn_box(cells, 4, 1, 0.25), {from, 0, top - 0.25});
}
/// 0.5 wide; its vertices are 0.125 apart.
Mesh slider(double depth) { return shifted(kuhn_box(4, 4, 1, 0.125), {0, 0.25, -depth}); }

// Vertices come to the seams and pass them, one after another, and are exactly on them at multiples of 0.125. Over one
// box only those on its rim are missing: the long one has no seam and the same rim.
TEST(CoveredWays, OverBoxesSideBySideTheForceIsThatOverOne) {
  for (const int exponent : {2, 3}) {
    const Scene one({box_from(-1, 12)}, slider(0.02), exponent);
    const Scene three({box_from(-1, 5), box_from(0.25, 1), box_from(0.5, 6)}, slider(0.02), exponent);
    for (int k = -40; k <= 40; ++k) {
      const Vector3d by(k / 64.0, 0, 0);
      const Vector3d whole = one.force_on_upper(one.with_upper_at(by)),
                     parts = three.force_on_upper(three.with_upper_at(by));
      EXPECT_GT(whole.z(), 1.0);
      EXPECT_LE((parts - whole).norm(), 1e-13 * whole.z()) << k;
    }
  }
}

// Overlaps of a fifth of the depth are where bodies are pressed together, gaps of a hundredth where a file has few
// digits.
TEST(CoveredWays, OverBoxesThatOverlapOrHardlyTouchTheForceIsThatOverOne) {
  const Scene one({box_from(-1, 12)}, slider(0.02), 3);
  for (const double apart : {-0.004, 1e-4}) {
    const Scene two({box_from(-1, 5), shifted(box_from(0.25, 7), {apart, 0, 0})}, slider(0.02), 3);
    for (int k = -100; k <= 100; ++k) {
      const Vector3d by(k / 256.0, 0, 0), whole = one.force_on_upper(one.with_upper_at(by)),
                                          parts = two.force_on_upper(two.with_upper_at(by));
      EXPECT_LE((parts - whole).norm(), 1e-12 * whole.z()) << k << ' ' << apart;
    }
  }
}

// A spike whose point alone is inside: a step stops what comes from below it, and on its way the energy changes by no
// more than the force allows.
TEST(CoveredWays, OverAStepTheEnergyIsContinuous) {
  Mesh spike;
  spike.points = {{0, 0.4, -0.01}, {0.02, 0.4, 0.5}, {-0.01, 0.42, 0.5}, {-0.01, 0.38, 0.5}};
  spike.add_cell(CellKind::tetrahedron, std::vector<std::uint32_t>{0, 1, 3, 2});
  for (const double height : {-0.05, -0.005, -0.001, 0.0, 0.001, 0.005, 0.05})
    for (const double overlap : {0.0, 0.0003, 0.001, 0.003}) {
      const Scene scene({box_from(-1, 4), shifted(box_from(0, 4, height), {-overlap, 0, 0})}, spike, 2);
      double area = 0.0;
      for (const SkinSample& sample : scene.skin.samples)
        if (sample.count == 1 && sample.nodes[0] == scene.points_below) area = 0.5 * sample.area;
      constexpr double step = 1e-5;
      double last = 0.0, most = 0.0, deepest = 0.0;
      for (int k = 0; k < 20000; ++k) {
        const std::vector<Vector3d> x = scene.with_upper_at({-0.1 + k * step, 0, 0});
        const double now = scene.contact->energy(x);
        if (k > 0) most = std::max(most, std::abs(now - last));
        last = now;
        for (const BodyTouch& touch : scene.contact->touching({x})) deepest = std::max(deepest, touch.depth);
      }
      EXPECT_GE(deepest, 0.01);
      EXPECT_LE(most, 1.001 * area * 1000.0 * deepest / 0.05 * step) << height << ' ' << overlap;
    }
}

TEST(CoveredWays, ListsFindWhatEveryPairAskedForFinds) {
  SplitMix64 random(3);
  std::size_t contacts = 0;
  for (int k = 0; k < 40; ++k) {
    Scene scene({box_from(-1, 5), box_from(0.25, 1), box_from(0.5, 6)}, slider(0.02), 3);
    std::vector<Vector3d> speed(scene.x.size(), Vector3d(0, 0, 0));
    const double way = k % 2 == 0 ? 1e-4 : 4e-3;
    for (int step = 0; step < 30; ++step) {
      for (std::size_t i = 0; i < speed.size(); ++i)
        for (int c = 0; c < 3; ++c) scene.x[i][c] += way * (speed[i][c] += 0.2 * random.next_signed());
      const auto found = scene.contact->touching({scene.x});
      const std::vector<BodyTouch> kept(found.begin(), found.end());
      contacts += kept.size();
      const std::vector<BodyTouch> expected = scene.contact->touching_by_brute_force({scene.x}, nullptr);
      ASSERT_EQ(kept.size(), expected.size());
      for (std::size_t t = 0; t < kept.size(); ++t) {
        EXPECT_EQ(kept[t].sample, expected[t].sample);
        EXPECT_EQ(kept[t].tetrahedron, expected[t].tetrahedron);
        EXPECT_EQ(kept[t].triangle, expected[t].triangle);
        EXPECT_EQ(kept[t].depth, expected[t].depth);
      }
    }
  }
  EXPECT_GT(contacts, 10000u);
}

// As long as the bodies below do not move relative to each other: a force on the line where two of them cross is on
// one.
TEST(CoveredWays, ForcesAreTheSlopeOfTheEnergy) {
  const Scene scene({box_from(-1, 5), shifted(box_from(0.25, 7, 0.005), {-0.004, 0, 0})}, slider(0.02), 3);
  SplitMix64 random(11);
  std::vector<Vector3d> w(scene.x.size());
  for (std::size_t i = 0; i < w.size(); ++i)
    for (int c = 0; c < 3; ++c)
      w[i][c] = i < scene.points_below ? scene.x[i].dot(Vector3d(0.3, -0.2 * c, 0.1 + 0.2 * c)) : random.next_signed();
  // a row of vertices is 0.003 beside the seam, or between the two sides
  for (const double shift : {-0.003, -0.002, 0.003}) {
    std::vector<Vector3d> x = scene.with_upper_at({shift, 0, 0});
    for (Vector3d& place : x)
      for (double& c : place) c += 1e-4 * random.next_signed();
    const auto force = forces_of(*scene.contact, x);
    const double size = size_of(force), d = 1e-7;
    Vector3d sum(0, 0, 0);
    for (const Vector3d& f : force) sum += f;
    EXPECT_LE(sum.norm(), 1e-14 * size);
    const double slope = (scene.contact->energy(moved(x, w, -d)) - scene.contact->energy(moved(x, w, d))) / (2 * d);
    EXPECT_NEAR(slope, dot(force, w), 1e-6 * size) << shift;
  }
}

}  // namespace
}  // namespace dartboard::covered_ways_test
