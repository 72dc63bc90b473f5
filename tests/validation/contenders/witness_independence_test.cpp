// Witnesses depend on their input and on nothing that happens to the core afterwards; and the core is not affected by
// the comparison.

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "validation/conservation/mesh_places.h"
#include "validation/conservation/rebuild_oracle.h"
#include "validation/contenders/contenders.h"
#include "validation/topology/topology_report.h"

namespace dartboard::witness_independence_test {
namespace {

constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

Problem moving_box() { return moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1); }

TEST(Witnesses, StayWhereTheyAreWhenABodyOfTheCoreMoves) {
  const Problem problem = moving_box();
  for (const Contender& c : contenders()) {
    if (c.carrier == Carrier::core_map) continue;
    const auto witness = c.make(problem), core = contender("arrays").make(problem);
    core->step(5);
    EXPECT_EQ(witness->state().x, problem.mesh.points) << c.id;
    EXPECT_NE(core->state().x, problem.mesh.points);
    witness->step(5);
    EXPECT_NE(witness->state().x, problem.mesh.points) << c.id;
    // it adds up in another order: the same bits in every number would show a copy
    EXPECT_NE(state_hash(witness->state()), state_hash(core->state())) << c.id;
  }
}

TEST(Witnesses, OfAMapKeepTheirsWhenOursComesApart) {
  const Mesh mesh = kuhn_box(1, 1, 1, 1.0);
  const auto ours = make_core_twin<Map3>(mesh), theirs = make_cgal_gmap_twin(alphas_of(mesh));
  Dart d{0};
  while (ours->alpha(3, d) == d) ++d.index;
  ours->unsew(3, d);
  EXPECT_EQ(ours->alpha(3, d), d);
  EXPECT_NE(theirs->alpha(3, d), d);
  EXPECT_FALSE(are_isomorphic(*theirs, ours->alphas()));
}

TEST(Witnesses, OfCellsDoNotFollowTheMap) {
  const Problem problem = moving_box();
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  const RemainingCells cells(problem.mesh);
  const MeshPlaces places(body, problem.mesh, cells);
  std::uint32_t side = 0;
  while (!cells.is_joined(side)) ++side;
  dissociate_face(body.map, places.side[side]);
  EXPECT_TRUE(body.map.is_free<3>(places.side[side]));
  EXPECT_TRUE(cells.is_joined(side));
}

TEST(RebuildOracle, LeavesTheBodyThatItComparesAsItIs) {
  const Problem problem = moving_box();
  const Subject<TetMap> at(problem);
  const std::uint64_t before = at.body.state_hash();
  EXPECT_TRUE(compare_rebuilt_motion(at, 5).same_bits);
  EXPECT_EQ(at.body.state_hash(), before);
}

}  // namespace
}  // namespace dartboard::witness_independence_test
