#include "validation/conservation/reference_motion.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/plain/random.h"

namespace dartboard {
namespace {

/// A body of all kinds of cells that has lost some of them, and some faces.
struct CutBody {
  Problem start = moving_problem(mixed_box(3, 2, 2, 0.125), {.density = 1000.0, .stiffness = 0.3, .damping = 0.01}, 3);
  LiveBody<Map3> body = build_body<Map3, Held::by_every_dart>(start);
  RemainingCells cells{start.mesh};
  MeshPlaces places{body, start.mesh, cells};
  Views views;

  CutBody() {
    views.rebuild(body);
    SplitMix64 random(7);
    for (int k = 0; k < 40; ++k) {
      const std::uint32_t side = random.below(places.side.size()), c = places.cell_of[places.side[side].index];
      if (!cells.is_there(c)) continue;
      follow(body, views,
             k % 10 == 9 ? remove_volume(body.map, places.side[side]) : dissociate_face(body.map, places.side[side]));
      if (k % 10 == 9)
        cells.remove(c);
      else
        cells.dissociate(side);
    }
  }
  bool agrees() const {
    const auto [off, spread] = compare_with_reference(body, views.cells, start, places, cells, 100);
    return off.position <= spreads_of_cut_body * spread.position &&
           off.velocity <= spreads_of_cut_body * spread.velocity;
  }
};

TEST(ReferenceMotion, IsThatOfTheLiveBodyAfterCuts) {
  const CutBody cut;
  EXPECT_TRUE(cut.agrees());
  EXPECT_GT(cut.body.vertices.size(), cut.start.mesh.points.size());
  EXPECT_EQ(remaining_network(cut.start, cut.cells).network.springs.size(), cut.body.springs.size());
}

TEST(ReferenceMotion, IsNotThatOfABodyWhoseSpringsAreOff) {
  CutBody cut;
  for (std::size_t k = 0; k < cut.body.springs.size(); ++k)
    cut.body.springs.change(k, [](Spring& s) { s.stiffness *= 1.0 + 1e-9; });
  EXPECT_FALSE(cut.agrees());
  CutBody one;
  one.body.springs.change(11, [](Spring& s) { s.stiffness *= 1.5; });
  EXPECT_FALSE(one.agrees());
}

TEST(ReferenceMotion, IsNotThatOfABodyWithAVertexTooHeavyOrFree) {
  CutBody heavy;
  for (std::uint32_t k = 0; k < heavy.body.vertices.size(); ++k)
    heavy.body.set_mass(k, heavy.body.vertices.mass[k] * (1.0 + 1e-10));
  EXPECT_FALSE(heavy.agrees());
  CutBody loose;
  std::fill(loose.body.vertices.fixed.begin(), loose.body.vertices.fixed.end(), std::uint8_t{0});
  EXPECT_FALSE(loose.agrees());
}

}  // namespace
}  // namespace dartboard
