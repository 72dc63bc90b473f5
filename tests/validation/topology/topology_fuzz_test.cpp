#include "validation/topology/topology_fuzz.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/plain/error.h"
#include "core/topology/orbit.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::topology_fuzz_test {
namespace {

FuzzPlan plan(ScriptStorage storage, ScriptOracles oracles, std::uint64_t seed, std::size_t operations) {
  FuzzPlan p;
  p.mesh_name = "test";
  p.storage = storage;
  p.oracles = oracles;
  p.seed = seed;
  p.operations = operations;
  p.everything_every = 500;
  return p;
}

void expect_agreement(const Mesh& mesh, const FuzzPlan& p) {
  const FuzzResult result = fuzz_topology(mesh, p);
  EXPECT_FALSE(result.disagreement) << "seed " << p.seed << ": " << to_string(*result.disagreement) << "\n"
                                    << to_string(result.script);
  EXPECT_EQ(result.applied + result.illegal + result.not_carried, p.operations);
  EXPECT_GT(result.applied, p.operations / 3);
}

// ---- ours against CGAL's

TEST(Fuzz, TetrahedraAgreeWithBothOraclesWhileTheyStayOriented) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    expect_agreement(kuhn_grid(2, 2, 1, 1.0), plan(ScriptStorage::tetrahedral, ScriptOracles::both, seed, 3000));
}

TEST(Fuzz, CellsOfAllKindsAgreeWithBothOracles) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    expect_agreement(mixed_cells(), plan(ScriptStorage::general, ScriptOracles::both, seed, 2000));
    expect_agreement(hexahedron_box(2, 2, 1, 1.0), plan(ScriptStorage::general, ScriptOracles::both, seed, 2000));
    expect_agreement(pinched_ring(), plan(ScriptStorage::tetrahedral, ScriptOracles::both, seed, 2000));
  }
}

// Flips, folds, faces of one cell sewn to each other, i-sews of every i: only generalized maps support them.
TEST(Fuzz, AnythingGoesWithTheGeneralizedMap) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    expect_agreement(kuhn_grid(1, 1, 1, 1.0), plan(ScriptStorage::tetrahedral, ScriptOracles::gmap, seed, 2000));
    expect_agreement(kuhn_grid(1, 1, 1, 1.0), plan(ScriptStorage::general, ScriptOracles::gmap, seed, 2000));
    expect_agreement(mixed_cells(), plan(ScriptStorage::general, ScriptOracles::gmap, seed, 2000));
  }
}

TEST(Fuzz, SurfacesAgreeOrientableOrNot) {
  for (const Mesh& mesh : {quadrilateral_grid(3, 3), torus_lattice(), moebius_lattice(), klein_lattice()})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      expect_agreement(mesh, plan(ScriptStorage::general, ScriptOracles::both, seed, 2000));
      expect_agreement(mesh, plan(ScriptStorage::general, ScriptOracles::gmap, seed, 2000));
    }
}

TEST(Fuzz, ABodyGrowsFromNothing) {
  expect_agreement(Mesh{}, plan(ScriptStorage::tetrahedral, ScriptOracles::both, 1, 2000));
  expect_agreement(Mesh{}, plan(ScriptStorage::general, ScriptOracles::both, 1, 2000));
}

TEST(Fuzz, BothStoragesOfOursAgreeWithoutCgal) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
    expect_agreement(kuhn_grid(2, 1, 1, 1.0), plan(ScriptStorage::tetrahedral, ScriptOracles::none, seed, 20000));
}

TEST(Fuzz, SaysThatAMoebiusStripHasNoCombinatorialMap) {
  const FuzzResult result = fuzz_topology(moebius_lattice(), plan(ScriptStorage::general, ScriptOracles::both, 1, 10));
  EXPECT_EQ(result.no_cmap.substr(0, 14), "not orientable");
}

TEST(Fuzz, TheSameSeedDoesTheSame) {
  const auto run = [](std::uint64_t seed) {
    const auto r =
        fuzz_topology(kuhn_grid(1, 1, 1, 1.0), plan(ScriptStorage::tetrahedral, ScriptOracles::both, seed, 1000));
    return std::array{r.applied, r.illegal, r.not_carried};
  };
  EXPECT_EQ(run(7), run(7));
  EXPECT_NE(run(7), run(8));
}

TEST(Fuzz, ASurfaceCannotBeStoredAsTetrahedra) {
  EXPECT_THROW(fuzz_topology(torus_lattice(), plan(ScriptStorage::tetrahedral, ScriptOracles::none, 1, 1)), InputError);
}

// ---- one operation at a time

class LockstepOfTwoTetrahedra : public testing::Test {
 protected:
  Lockstep::Outcome apply(const std::string& line) {
    auto script =
        parse_topology_script("dartboard-topology-script 1\nmesh m\nstorage general\noracles both\n" + line, "line");
    const auto found = lockstep_.apply(script.operations.at(0));
    EXPECT_FALSE(found) << to_string(*found);
    return lockstep_.outcome();
  }
  Lockstep lockstep_{unequal_tetrahedra(), ScriptStorage::tetrahedral, ScriptOracles::both};
};

TEST_F(LockstepOfTwoTetrahedra, SkipsWhatIsIllegalForAll) {
  EXPECT_EQ(apply("sew 3 d18 d1"), Lockstep::Outcome::illegal);         // one is sewn, the other is not
  EXPECT_EQ(apply("unsew 3 d0"), Lockstep::Outcome::illegal);           // not sewn
  EXPECT_EQ(apply("remove d48"), Lockstep::Outcome::illegal);           // no such dart
  EXPECT_EQ(apply("add tetrahedron d40"), Lockstep::Outcome::illegal);  // names in use
  EXPECT_FALSE(lockstep_.compare_everything());
}

TEST_F(LockstepOfTwoTetrahedra, SkipsWhatATwinCannotCarry) {
  EXPECT_EQ(apply("unsew 0 d0"), Lockstep::Outcome::not_carried);
  EXPECT_EQ(apply("add hexahedron"), Lockstep::Outcome::not_carried);
  EXPECT_EQ(apply("sew 3 d0 d2"), Lockstep::Outcome::not_carried);  // not oriented
}

TEST_F(LockstepOfTwoTetrahedra, KeepsNamesWhenSlotsAreUsedAgain) {
  EXPECT_EQ(apply("remove d5"), Lockstep::Outcome::applied);
  EXPECT_EQ(lockstep_.live().size(), 24u);
  EXPECT_EQ(apply("add tetrahedron"), Lockstep::Outcome::applied);
  EXPECT_FALSE(lockstep_.ours().is_live(Dart{5}));
  EXPECT_TRUE(lockstep_.ours().is_live(Dart{48}));  // not d0 .. d23, whose slots it took
  EXPECT_EQ(apply("remove d5"), Lockstep::Outcome::illegal);
  EXPECT_EQ(apply("sew 3 d48 d25"), Lockstep::Outcome::applied);
  EXPECT_FALSE(lockstep_.compare_everything());
}

// One tetrahedron's face folded onto itself: one edge opens, one vertex comes apart, the face stays one.
TEST(Folds, ComeApartAsCgalCountsIt) {
  const auto script = parse_topology_script(
      "dartboard-topology-script 1\nmesh one\nstorage tetrahedral\noracles gmap\nsew 3 d0 d5\ndissociate d0\n", "fold");
  const auto result = replay_topology(regular_tetrahedron(), script);
  EXPECT_FALSE(result.disagreement) << to_string(*result.disagreement);
  EXPECT_EQ(result.applied, 2u);
}

// ---- faults are found and shrunk

MakeTwins with(MapOperations<Map3> operations) {
  return [operations](const Mesh& mesh, ScriptStorage) {
    std::vector<std::unique_ptr<MapTwin>> twins;
    twins.push_back(make_core_twin<Map3>(mesh, operations));
    return twins;
  };
}

void expect_found(const MakeTwins& faulty, std::size_t most_lines, ScriptOracles oracles = ScriptOracles::both) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  FuzzPlan p = plan(ScriptStorage::general, oracles, 3, 5000);
  p.ours = faulty;
  const FuzzResult result = fuzz_topology(mesh, p);
  ASSERT_TRUE(result.disagreement);
  EXPECT_GE(result.script.operations.size(), 1u);
  EXPECT_LE(result.script.operations.size(), most_lines) << to_string(result.script);

  // it replays from its text, does not happen with core's own operations, and needs every line
  const auto script = parse_topology_script(to_string(result.script), "shrunk");
  const auto again = replay_topology(mesh, script, faulty);
  ASSERT_TRUE(again.disagreement) << to_string(script);
  EXPECT_EQ(to_string(*again.disagreement), to_string(*result.disagreement));
  EXPECT_FALSE(replay_topology(mesh, script).disagreement) << to_string(script);
  for (std::size_t k = 0; k < script.operations.size(); ++k) {
    auto shorter = script;
    shorter.operations.erase(shorter.operations.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_FALSE(replay_topology(mesh, shorter, faulty).disagreement) << to_string(shorter);
  }
}

TEST(Faults, AnUnsewThatForgetsOnePairIsFound) {
  const auto forgetful = [](Map3& map, int i, Dart d) {
    const auto line = orbit(map, sew_involutions(3, i), d);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const auto unlink = [&](Dart e) { i == 3 ? map.unlink<3>(e) : map.unlink<2>(e); };
      if (i >= 2) unlink(line[k]);
    }
  };
  for (const ScriptOracles oracles : {ScriptOracles::both, ScriptOracles::gmap, ScriptOracles::none})
    expect_found(with({{}, forgetful, {}}), 1, oracles);
}

TEST(Faults, ASewThatPairsTheOtherWayRoundIsFound) {
  const auto reversed = [](Map3& map, int i, Dart a, Dart b) {
    if (i == 3) sew<3>(map, a, map.alpha<0>(b));
    if (i == 2) sew<2>(map, a, map.alpha<0>(b));
  };
  expect_found(with({reversed, {}, {}}), 2);
}

TEST(Faults, ASewThatFailsForNewCellsOnlyIsFound) {
  const auto only_old = [](Map3& map, int i, Dart a, Dart b) {
    if (i == 3 && a.index < 144) sew<3>(map, a, b);
    if (i == 2) sew<2>(map, a, b);
  };
  expect_found(with({only_old, {}, {}}), 3);
}

TEST(Faults, AThrowingOperationIsFound) {
  const auto throws = [](Map3&, int, Dart, Dart) { throw TopologyError("no"); };
  expect_found(with({throws, {}, {}}), 2);
}

TEST(Faults, ADissociationThatMissesAVertexIsFoundEvenWithoutCgal) {
  const auto misses = [](Map3& map, Dart d) {
    const auto twin_counts = [&] {
      return std::array{count_orbits(map, cell_involutions(3, 0)), count_orbits(map, cell_involutions(3, 1)),
                        count_orbits(map, cell_involutions(3, 2))};
    };
    const auto before = twin_counts();
    unsew<3>(map, d);
    const auto after = twin_counts();
    SplitCounts split{};
    for (std::size_t i = 0; i < 3; ++i) split[i] = static_cast<long>(after[i] - before[i]);
    split[0] = 0;
    return split;
  };
  for (const ScriptOracles oracles : {ScriptOracles::both, ScriptOracles::none})
    expect_found(with({{}, {}, misses}), 5, oracles);
}

// ---- shrinking

TEST(Shrink, LeavesOutEveryLineThatCanBeLeftOut) {
  std::vector<Operation> operations;
  for (std::uint32_t k = 0; k < 100; ++k) operations.push_back({.kind = Operation::Kind::remove, .a = Dart{k}});
  const auto has = [](const std::vector<Operation>& list, std::uint32_t k) {
    return std::any_of(list.begin(), list.end(), [&](const Operation& op) { return op.a == Dart{k}; });
  };
  std::size_t asked = 0;
  const auto left = shrink(operations, [&](const std::vector<Operation>& list) {
    ++asked;
    return has(list, 7) && has(list, 50) && has(list, 93);
  });
  ASSERT_EQ(left.size(), 3u);
  EXPECT_EQ(left[0].a, Dart{7});
  EXPECT_EQ(left[1].a, Dart{50});
  EXPECT_EQ(left[2].a, Dart{93});
  EXPECT_LT(asked, 100u);
}

TEST(Shrink, KeepsASingleLine) {
  const std::vector<Operation> one(1);
  EXPECT_EQ(shrink(one, [](const auto& list) { return !list.empty(); }).size(), 1u);
}

}  // namespace
}  // namespace dartboard::topology_fuzz_test
