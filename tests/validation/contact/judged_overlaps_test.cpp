#include "validation/contact/judged_overlaps.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "core/meshes/generators/mesh_generators.h"
#include "core/scene/body/simulated_body.h"

namespace dartboard::judged_overlaps_test {
namespace {

using Eigen::Vector3d;

/// Two boxes of 2 x 2 x 2 cubes of 0.5 m, or of another kind, that may touch or not.
struct TwoBoxes {
  explicit TwoBoxes(const std::vector<ContactPair>& touches, const Mesh& box = kuhn_box(2, 2, 2, 0.5, 0.0, 1)) {
    Problem problem;
    problem.mesh = box;
    first = static_cast<std::uint32_t>(problem.mesh.cell_count());
    append(problem.mesh, box);
    BodyNeeds needs = body_needs(problem, false);
    needs.touches = touches;
    needs.first_cell = {0, first};
    body = make_simulated_body(problem, needs);
    const Mesh mesh = body->frame({}).mesh;
    x = mesh.points;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto k = mesh.cell(c);
      cells.push_back({k[0], k[1], k[2], k[3]});
    }
  }
  void move_second(const Vector3d& by) {
    std::vector<bool> is_second(x.size());
    for (std::size_t c = first; c < cells.size(); ++c)
      for (const std::uint32_t k : cells[c]) is_second[k] = true;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (is_second[k]) x[k] += by;
  }
  std::vector<JudgedOverlap> judged(bool within = false) const {
    return judged_overlaps(*body->contacts().bodies, x, cells,
                           [&](std::uint32_t a, std::uint32_t b) { return within || (a < first) != (b < first); });
  }

  std::uint32_t first = 0;
  std::unique_ptr<SimulatedBody> body;
  std::vector<Vector3d> x;
  std::vector<CellCorners> cells;
};
const ContactLaw law{.pressure = 1.0, .depth = 1.0};

TEST(JudgedOverlaps, AreFeltWhereAVertexIsInside) {
  TwoBoxes boxes({{0, 1, law}});
  boxes.move_second({0.13, 0.17, 0.95});
  const auto judged = boxes.judged();
  EXPECT_GT(judged.size(), 20u);
  for (const JudgedOverlap& one : judged) {
    EXPECT_TRUE(one.felt) << one.overlap.first << " " << one.overlap.second;
    EXPECT_LE(one.overlap.depth, 0.05 + 1e-12);
  }
}

TEST(JudgedOverlaps, AreNotFeltWhereBodiesAreNotToTouch) {
  TwoBoxes boxes({{0, 0, law}});
  boxes.move_second({0.13, 0.17, 0.95});
  const auto judged = boxes.judged();
  EXPECT_GT(judged.size(), 20u);
  for (const JudgedOverlap& one : judged) EXPECT_FALSE(one.felt);
}

// A third box of other cells, where the first is: it overlaps as much, and has no sample and no cell in the contact.
TEST(JudgedOverlaps, AreNotFeltByAContactOfOthers) {
  TwoBoxes boxes({{0, 1, law}});
  boxes.move_second({0.13, 0.17, 0.95});
  const auto without = boxes.judged();
  const auto points = static_cast<std::uint32_t>(boxes.x.size());
  const std::vector<Vector3d> places = boxes.x;
  boxes.x.insert(boxes.x.end(), places.begin(), places.end());
  for (std::uint32_t c = 0; c < boxes.first; ++c) {
    const CellCorners k = boxes.cells[c];
    boxes.cells.push_back({k[0] + points, k[1] + points, k[2] + points, k[3] + points});
  }
  const auto last = static_cast<std::uint32_t>(boxes.cells.size()) - boxes.first;
  std::size_t felt = 0, unfelt = 0;
  for (const JudgedOverlap& one :
       judged_overlaps(*boxes.body->contacts().bodies, boxes.x, boxes.cells, [&](std::uint32_t a, std::uint32_t b) {
         return (a < boxes.first || a >= last) != (b < boxes.first || b >= last);
       })) {
    const bool is_third = one.overlap.second >= last;
    EXPECT_EQ(one.felt, !is_third);
    (is_third ? unfelt : felt) += 1;
  }
  EXPECT_EQ(felt, without.size());
  EXPECT_EQ(unfelt, without.size());
}

// A bar of five cubes along x, one end of which is folded into it.
TEST(JudgedOverlaps, LeaveOutNeighboursHoweverDeepTheyAre) {
  const auto folded_to = [](double end) {
    TwoBoxes bars({{0, 0, law}, {1, 1, law}}, kuhn_box(5, 1, 1, 1.0, 0.0, 1));
    bars.move_second({0, 0, 9});
    for (Vector3d& x : bars.x)
      if (x.x() < 0.5 && x.z() < 5) x.x() = end;
    return bars;
  };
  // into the next cube: cells there share no corner with those of the first, but have a cell between them
  const TwoBoxes near = folded_to(1.3);
  EXPECT_FALSE(reference::overlaps(near.x, near.cells).empty());
  EXPECT_TRUE(near.judged(true).empty());
  // into the fourth
  const auto far = folded_to(3.5).judged(true);
  EXPECT_FALSE(far.empty());
}

TEST(OverlapTally, CountsByDepthAndKeepsTheDeepest) {
  OverlapTally tally, other;
  tally.add(0.0, true);
  tally.add(0.19, false);
  tally.add(0.21, true);
  other.add(7.0, true);
  other.add(1.5, false);
  tally.add(other);
  EXPECT_EQ(tally.overlaps, (std::array<std::size_t, 10>{2, 1, 0, 0, 0, 0, 0, 1, 0, 1}));
  EXPECT_EQ(tally.missed, (std::array<std::size_t, 10>{1, 0, 0, 0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(tally.count(), 5u);
  EXPECT_EQ(tally.count_missed(), 2u);
  EXPECT_EQ(tally.deepest, 7.0);
  EXPECT_EQ(tally.deepest_missed, 1.5);
}

}  // namespace
}  // namespace dartboard::judged_overlaps_test
