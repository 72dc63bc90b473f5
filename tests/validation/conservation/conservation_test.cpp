// The validator of conservation: it passes right bodies and fails wrong ones.

#include "validation/conservation/conservation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "tests/support/conservation_rows_for_tests.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/conservation/rebuild_oracle.h"

namespace dartboard::conservation_test {
namespace {

// no sum of these is exact
constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};
// 768 = 6 * 2^7: the tetrahedra of a box with a spacing of 2^-3 m weigh 2^-2 kg
constexpr Material powers_of_two{.density = 768.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};

ConservationPlan short_plan(std::uint64_t seed, std::size_t operations = 300) {
  ConservationPlan plan;
  plan.seed = seed;
  plan.operations = operations;
  plan.everything_every = 1;
  plan.oracle_every = 50;
  return plan;
}

template <class Map>
struct Conservation : testing::Test {
  // The first violation when `fault` is applied after each series but the first four.
  template <class Fault>
  static std::string first_violation(Fault&& fault, std::size_t everything_every = 1) {
    const Problem problem = moving_problem(kuhn_box(2, 2, 2, 0.125, 0.2, 3), soft, 1);
    ConservationPlan plan = short_plan(4);
    plan.everything_every = everything_every;
    std::size_t series = 0;
    const Follow<Map> faulty = [&](LiveBody<Map>& body, Views& views, const TopologyChange& change) {
      Followed followed = follow(body, views, change);
      if (++series > 4) fault(body, views);
      return followed;
    };
    const auto result = validate_conservation<Map>(problem, plan, faulty);
    return violation_of(result);
  }
};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Conservation, Solids);

TYPED_TEST(Conservation, HoldsDownToTheEmptyBodyAndAgain) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto result = validate_conservation<TypeParam>(
        moving_problem(kuhn_box(2, 2, 1, 0.125, 0.2, seed), soft, seed), short_plan(seed));
    EXPECT_EQ(violation_of(result), "none");
    EXPECT_GT(result.refills, 0u);
    EXPECT_GT(result.parts_split_off, 0u);
    EXPECT_GT(result.bodies_from_scratch, 3u);
    EXPECT_GE(result.operations(), 300u);
    for (const ConservedRow& r : result.rows) {
      EXPECT_TRUE(r.holds) << r.what;
      EXPECT_GT(r.checks, 0u) << r.what;
    }
  }
}

TYPED_TEST(Conservation, IsExactWhereMassesAndStiffnessesArePowersOfTwo) {
  const auto result =
      validate_conservation<TypeParam>(moving_problem(kuhn_box(2, 2, 2, 0.125), powers_of_two, 5), short_plan(5));
  EXPECT_EQ(violation_of(result), "none");
  for (const char* what :
       {"total mass (", "total stiffness (", "total damping", "drift of total mass", "drift of total stiffness"}) {
    EXPECT_EQ(row(result, what).largest, 0.0) << what;
    EXPECT_EQ(row(result, what).bound, 0.0) << what;
  }
}

TYPED_TEST(Conservation, FailsWhenAVertexGetsHeavier) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (body.vertices.size() > 0) body.vertices.mass[0] *= 1.0 + 1e-9;
  });
  EXPECT_NE(what.find("mass"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenAVertexGetsHeavierThoughOnlySumsAreSeen) {
  const auto what = this->first_violation(
      [](auto& body, auto&) {
        if (body.vertices.size() > 0) body.vertices.mass[0] *= 1.0 + 1e-9;
      },
      1000);
  EXPECT_NE(what.find("mass"), std::string::npos) << what;
}

// A wrong end in an array shows only in the elastic energy, as long as not everything is compared.
TYPED_TEST(Conservation, NoticesByItsSumsThatASpringHasAnotherEnd) {
  const auto what = this->first_violation(
      [](auto&, auto& views) {
        auto& edges = views.cells.edges;
        if (edges.size() > 8) edges[0].ends = edges[8].ends;
      },
      1000);
  EXPECT_NE(what.find("elastic energy"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenASpringCountsACellTooMany) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (!body.springs.empty()) body.springs.change(0, [&](Spring& s) { s.stiffness += body.material.stiffness; });
  });
  EXPECT_NE(what.find("stiffness"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenARestLengthIsThatOfTheDeformedBody) {
  const auto what = this->first_violation([](auto& body, auto& views) {
    if (views.cells.edges.empty()) return;
    const auto [a, b] = views.cells.edges[0].ends;
    const double length = (body.vertices.position[a] - body.vertices.position[b]).norm();
    body.springs.change(0, [length](Spring& s) { s.rest_length = length; });
  });
  EXPECT_TRUE(what.find("rest length") != std::string::npos || what.find("elastic") != std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenAnArrayIsStale) {
  const auto what = this->first_violation([](auto&, auto& views) {
    auto& edges = views.cells.edges;
    if (!edges.empty()) std::swap(edges[0].ends[0], edges[0].ends[1]);
  });
  EXPECT_NE(what.find("apply = rebuild"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenABoundaryIsStale) {
  const auto what = this->first_violation([](auto&, auto& views) { views.boundary = {}; });
  EXPECT_NE(what.find("boundary surface"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenComponentsAreStale) {
  const auto what = this->first_violation([](auto&, auto& views) {
    if (views.components.count() > 1) views.components = ComponentLabels();
  });
  EXPECT_NE(what.find("component"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenAPartOfAVertexIsLeftBehind) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (body.vertices.size() > 0) body.vertices.velocity.back().x() += 1e-9;
  });
  EXPECT_NE(what.find("duplicated"), std::string::npos) << what;
}

TYPED_TEST(Conservation, FailsWhenADampingIsForgotten) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (!body.springs.empty()) body.springs.change(body.springs.size() - 1, [](Spring& s) { s.damping = 0.0; });
  });
  EXPECT_NE(what.find("damping"), std::string::npos) << what;
}

TYPED_TEST(Conservation, NeitherMomentumNorEnergyChangesWithOneDissociation) {
  auto body = build_body<TypeParam, Held::by_every_dart>(moving_problem(kuhn_box(1, 1, 1, 0.125, 0.2, 3), soft, 7));
  for (auto& x : body.vertices.position) x += 0.01 * x.cwiseProduct(x);
  Views views;
  views.rebuild(body);
  const ConservedSums before = sums_of(body, views.cells);
  Dart d = no_dart;
  body.map.for_each_dart([&](Dart e) {
    if (!body.map.template is_free<3>(e)) d = e;
  });
  follow(body, views, dissociate_face(body.map, d));
  const ConservedSums after = sums_of(body, views.cells);
  EXPECT_GT(before[Conserved::elastic].value(), 0.0);
  for (std::size_t i = 0; i < conserved_count; ++i) {
    const auto c = static_cast<Conserved>(i);
    // the diagonal's ends have six cells
    EXPECT_LE(std::abs(after[c].value() - before[c].value()), change_bound(c, 6, before[c], after[c], {})) << i;
    EXPECT_LE(change_bound(c, 6, before[c], after[c], {}), before[c].magnitude * 0x1p-47) << i;
  }
}

TYPED_TEST(Conservation, ABodyFromScratchMovesLikeOneThatWasTakenApart) {
  const Problem start = moving_problem(kuhn_box(2, 2, 2, 0.125, 0.2, 3), soft, 3);
  Subject<TypeParam> at(start);
  auto& body = at.body;
  // two faces around an inner edge: it comes apart, its ends do not
  std::uint32_t edge = 0;
  while (at.cells.edge(edge).size() < 6) ++edge;
  const Dart d = at.places.edge[edge], opposite = body.map.template alpha<2, 3, 2, 3, 2>(d);
  TopologyChange change;
  for (const Dart face : {d, opposite}) {
    at.cells.dissociate(at.side(face));
    change.append(dissociate_face(body.map, face));
  }
  follow(body, at.views, change);
  ASSERT_GE(change.edges.size(), 1u);
  ASSERT_TRUE(change.vertices.empty());

  const auto motion = compare_rebuilt_motion(at, 10);
  EXPECT_EQ(motion.springs_side_by_side, change.edges.size());
  EXPECT_TRUE(motion.same_cells);
  EXPECT_TRUE(motion.same_bits);
  EXPECT_LE(motion.position, motion.bound.position);
  EXPECT_LE(motion.velocity, motion.bound.velocity);
  EXPECT_LT(motion.bound.position, 1e-9);

  body.springs.change(0, [](Spring& s) { s.stiffness *= 1.0 + 1e-9; });
  EXPECT_FALSE(compare_rebuilt_motion(at, 10).same_bits);
}

// Only the motion depends on gravity: only the bodies from scratch can show it.
TYPED_TEST(Conservation, FailsWhenTheBodyMovesOtherwiseThanOneFromScratch) {
  const Problem problem = moving_problem(kuhn_box(2, 2, 2, 0.125, 0.2, 3), soft, 1);
  const Follow<TypeParam> heavier = [](auto& body, Views& views, const TopologyChange& change) {
    body.surroundings.gravity = body.surroundings.gravity + Eigen::Vector3d(0, 0, -1e-3);
    return follow(body, views, change);
  };
  const auto result = validate_conservation<TypeParam>(problem, short_plan(4), heavier);
  EXPECT_NE(violation_of(result).find("its motion"), std::string::npos) << violation_of(result);
  for (const char* what : {"edges in the same order", "own order: position", "own order: velocity"})
    EXPECT_FALSE(row(result, what).holds) << what;
}

// Nothing is taken apart: the bound is that of the same body, except for its own slack of a thousandth.
TYPED_TEST(Conservation, MeasuresTheMotionByTheBoundOfTheBodyFromScratch) {
  const Problem start = moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 3);
  Subject<TypeParam> at(start);
  auto& body = at.body;
  const auto motion = compare_rebuilt_motion(at, 5);
  const reference::StateBound bound =
      reference::state_bound(rest_problem(body, start, at.places), {body.vertices.position, body.vertices.velocity}, 5);
  EXPECT_DOUBLE_EQ(motion.bound.position, 1.001 * bound.position);
  EXPECT_DOUBLE_EQ(motion.bound.velocity, 1.001 * bound.velocity);
  body.springs.change(0, [](Spring& s) { s.stiffness *= 1.01; });
  const auto wrong = compare_rebuilt_motion(at, 5);
  EXPECT_GT(wrong.position, wrong.bound.position);
  EXPECT_GT(wrong.velocity, wrong.bound.velocity);
}

TEST(ConservationMeshes, MayHaveCellsOfAllKinds) {
  const auto result = validate_conservation<Map3>(moving_problem(mixed_box(2, 2, 2, 0.25), soft, 8), short_plan(8));
  EXPECT_EQ(violation_of(result), "none");
}

TEST(ConservationMeshes, MayBeEmpty) {
  EXPECT_EQ(violation_of(validate_conservation<TetMap>(moving_problem(empty_mesh(), soft, 1), short_plan(1))), "none");
}

TEST(ConservationMeshes, MustHaveTheDimensionOfTheMap) {
  EXPECT_THROW(validate_conservation<Map3>(moving_problem(quad_sheet(2, 2, 1.0), soft, 1), short_plan(1)), InputError);
  EXPECT_THROW(validate_conservation<Map2>(moving_problem(kuhn_box(1, 1, 1, 1.0), soft, 1), short_plan(1)), InputError);
}

TEST(ConservationOfSurfaces, HoldsDownToTheEmptyBodyAndAgain) {
  std::uint64_t seed = 20;
  for (const Mesh& mesh : {triangle_sheet(4, 3, 0.125), quad_sheet(4, 4, 0.125), torus_surface(5, 4), moebius_strip(9),
                           klein_bottle(5, 4)}) {
    ++seed;
    const auto result = validate_conservation<Map2>(moving_problem(mesh, soft, seed), short_plan(seed));
    EXPECT_EQ(violation_of(result), "none");
    EXPECT_GT(result.refills, 0u);
    EXPECT_GT(result.parts_split_off, 0u);
    for (const ConservedRow& r : result.rows) EXPECT_GT(r.checks, 0u) << r.what;
  }
}

TEST(ConservationOfSurfaces, FailsWhenAnEdgeCountsAFaceTooMany) {
  const Follow<Map2> faulty = [](LiveBody<Map2>& body, Views& views, const TopologyChange& change) {
    Followed followed = follow(body, views, change);
    if (!body.springs.empty()) body.springs.change(0, [&](Spring& s) { s.stiffness += body.material.stiffness; });
    return followed;
  };
  const auto what = violation_of(
      validate_conservation<Map2>(moving_problem(quad_sheet(4, 4, 0.125), soft, 3), short_plan(3), faulty));
  EXPECT_NE(what.find("stiffness"), std::string::npos) << what;
}

TEST(TwofoldSums, KeepWhatAnAdditionLoses) {
  TwofoldSum sum;
  for (const double term : {1.0, 0x1p-80, -1.0}) sum.add(term);
  EXPECT_EQ(sum.value(), 0x1p-80);
  EXPECT_EQ(quantum(12.0), 4.0);
  EXPECT_EQ(quantum(0.625), 0.125);
}

}  // namespace
}  // namespace dartboard::conservation_test
