#include "validation/conservation/reference_motion.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/plain/random.h"

namespace dartboard::reference_motion_test {
namespace {

/// A body of all kinds of cells that has lost some of them, and some faces.
struct CutBody {
  Problem start = moving_problem(mixed_box(3, 2, 2, 0.125), {.density = 1000.0, .stiffness = 0.3, .damping = 0.01}, 3);
  Subject<Map3> at{start};

  CutBody() {
    SplitMix64 random(7);
    for (int k = 0; k < 40; ++k) {
      const std::uint32_t side = random.below(at.places.side.size());
      const Dart d = at.places.side[side];
      const std::uint32_t c = at.cell(d);
      if (!at.cells.is_there(c)) continue;
      follow(at.body, at.views, k % 10 == 9 ? remove_volume(at.body.map, d) : dissociate_face(at.body.map, d));
      if (k % 10 == 9)
        at.cells.remove(c);
      else
        at.cells.dissociate(side);
    }
  }
  bool agrees() const {
    const auto [off, spread] = compare_with_reference(at, 100);
    return off.position <= spreads_of_cut_body * spread.position &&
           off.velocity <= spreads_of_cut_body * spread.velocity;
  }
};

TEST(ReferenceMotion, IsThatOfTheLiveBodyAfterCuts) {
  const CutBody cut;
  EXPECT_TRUE(cut.agrees());
  EXPECT_GT(cut.at.body.vertices.size(), cut.start.mesh.points.size());
  EXPECT_EQ(remaining_network(cut.start, cut.at.cells).network.springs.size(), cut.at.body.springs.size());
}

TEST(ReferenceMotion, IsNotThatOfABodyWhoseSpringsAreOff) {
  CutBody cut;
  for (std::size_t k = 0; k < cut.at.body.springs.size(); ++k)
    cut.at.body.springs.change(k, [](Spring& s) { s.stiffness *= 1.0 + 1e-9; });
  EXPECT_FALSE(cut.agrees());
  CutBody one;
  one.at.body.springs.change(11, [](Spring& s) { s.stiffness *= 1.5; });
  EXPECT_FALSE(one.agrees());
}

TEST(ReferenceMotion, IsNotThatOfABodyWithAVertexTooHeavyOrFree) {
  CutBody heavy;
  for (std::uint32_t k = 0; k < heavy.at.body.vertices.size(); ++k)
    heavy.at.body.set_mass(k, heavy.at.body.vertices.mass[k] * (1.0 + 1e-10));
  EXPECT_FALSE(heavy.agrees());
  CutBody loose;
  std::fill(loose.at.body.vertices.fixed.begin(), loose.at.body.vertices.fixed.end(), std::uint8_t{0});
  EXPECT_FALSE(loose.agrees());
}

}  // namespace
}  // namespace dartboard::reference_motion_test
