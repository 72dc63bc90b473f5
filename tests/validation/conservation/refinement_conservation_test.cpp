// The validator of refinements: it passes right bodies and fails wrong ones.

#include "validation/conservation/refinement_conservation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/mechanics/refine.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "reference/rebuild.h"
#include "tests/support/conservation_rows_for_tests.h"
#include "tests/support/meshes_for_tests.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/conservation/refinement_effects.h"
#include "validation/conservation/subdivided_cells.h"

namespace dartboard::refinement_conservation_test {
namespace {

constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

ConservationPlan short_plan(std::uint64_t seed, std::size_t operations) {
  ConservationPlan plan;
  plan.seed = seed;
  plan.operations = operations;
  plan.everything_every = 1;
  return plan;
}

template <class Map>
struct RefinementConservation : testing::Test {
  // The first violation when `fault` is applied once the body has been refined a little.
  static std::string first_violation(const Tamper<Map>& fault) {
    std::size_t series = 0;
    const Tamper<Map> late = [&](LiveBody<Map>& body, Views& views) {
      if (++series > 4) fault(body, views);
    };
    return violation_of(
        validate_refinement<Map>(moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1), short_plan(4, 200), late));
  }
  // The result of a run in which `fault` is applied at every refinement of an edge without bracing.
  template <class Fault>
  static ConservationResult refined(Fault&& fault) {
    const FollowSubdivision<Map> faulty = [&](LiveBody<Map>& body, const Subdivision& subdivision, double bracing) {
      ChangedEmbeddings changed = follow_subdivision(body, subdivision, bracing);
      if (bracing == 0.0 && subdivision.children.size() == 2 * subdivision.parents.size()) fault(body);
      return changed;
    };
    return validate_refinement<Map>(moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1), short_plan(4, 200), {},
                                    faulty);
  }
};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(RefinementConservation, Solids);

TYPED_TEST(RefinementConservation, HoldsDownToTheEmptyBodyAndAgain) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto result = validate_refinement<TypeParam>(moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, seed), soft, seed),
                                                       short_plan(seed, 500));
    EXPECT_EQ(violation_of(result), "none");
    EXPECT_GT(result.refills, 0u);
    EXPECT_LE(12 * result.refills, result.removals);  // of twelve cells each
    EXPECT_GT(result.dissociations, result.tears);    // of a hundred operations 45 against 10
    EXPECT_GT(result.refinements, 50u);
    EXPECT_GT(result.tears, 10u);
    EXPECT_GT(result.removals, 50u);
    for (const ConservedRow& r : result.rows) {
      EXPECT_TRUE(r.holds) << r.what;
      EXPECT_GT(r.checks, 0u) << r.what;
    }
  }
}

TYPED_TEST(RefinementConservation, FailsWhenAVertexGetsHeavier) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (body.vertices.size() > 0) body.vertices.mass.back() *= 1.0 + 1e-9;
  });
  EXPECT_NE(what.find("mass"), std::string::npos) << what;
}

TYPED_TEST(RefinementConservation, FailsWhenANewSpringIsTooStiff) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (!body.springs.empty()) body.springs.change(body.springs.size() - 1, [](Spring& s) { s.stiffness += 1e-9; });
  });
  EXPECT_NE(what.find("stiffness"), std::string::npos) << what;
}

TYPED_TEST(RefinementConservation, FailsWhenARestLengthIsNotThatOfTheRestShape) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (!body.springs.empty())
      body.springs.change(body.springs.size() - 1, [](Spring& s) { s.rest_length *= 1.0 + 1e-9; });
  });
  EXPECT_NE(what.find("rest length"), std::string::npos) << what;
}

TYPED_TEST(RefinementConservation, FailsWhenACellHasNotItsShareOfTheMass) {
  const auto what = this->first_violation([](auto& body, auto&) {
    if (!body.cell_mass.empty()) body.cell_mass.back() *= 1.0 + 1e-9;
  });
  EXPECT_NE(what.find("mass of a refined cell"), std::string::npos) << what;
}

TYPED_TEST(RefinementConservation, FailsWhenAViewIsStale) {
  const auto what = this->first_violation([](auto&, auto& views) { views.boundary = {}; });
  EXPECT_NE(what.find("views"), std::string::npos) << what;
}

TYPED_TEST(RefinementConservation, FailsWhenTheNewVertexIsNotInTheMiddle) {
  const auto result = this->refined([](auto& body) { body.vertices.position.back().x() += 1e-9; });
  EXPECT_NE(violation_of(result).find("vertices put in"), std::string::npos) << violation_of(result);
}

TYPED_TEST(RefinementConservation, FailsWhenTheNewVertexDoesNotMoveAsTheOthersDo) {
  const auto result = this->refined([](auto& body) { body.vertices.velocity.back().y() += 1e-9; });
  EXPECT_NE(violation_of(result).find("vertices put in"), std::string::npos) << violation_of(result);
}

TYPED_TEST(RefinementConservation, FailsWhenARefinementMovesAnotherVertex) {
  const auto result = this->refined([](auto& body) { body.vertices.position.front().x() += 1e-9; });
  EXPECT_NE(violation_of(result).find("duplicated"), std::string::npos) << violation_of(result);
}

TYPED_TEST(RefinementConservation, FailsWhenANewVertexIsHeld) {
  const auto result = this->refined([](auto& body) { body.vertices.fixed.back() = !body.vertices.fixed.back(); });
  EXPECT_NE(violation_of(result).find("duplicated"), std::string::npos) << violation_of(result);
}

// A vertex that is off by a tenth of a micrometre feels 1e-8 N: forces, energy and spin are compared, too.
TYPED_TEST(RefinementConservation, LooksAtForcesEnergiesAndMomentaAroundARefinement) {
  const auto off = this->refined([](auto& body) { body.vertices.position.back().x() += 1e-7; });
  for (const char* what : {"forces around", "elastic energy", "angular momentum"})
    EXPECT_FALSE(row(off, what).holds) << what;
  const auto fast = this->refined([](auto& body) { body.vertices.velocity.back().x() += 1e-7; });
  for (const char* what : {"linear momentum", "kinetic energy"}) EXPECT_FALSE(row(fast, what).holds) << what;
}

// By the counts of two full comparisons, at the start and at the end, of a body too large for more: the parts changed
// by a series of dissociations and removals have been compared in addition. A removal makes four vertices and six edges
// lighter.
TYPED_TEST(RefinementConservation, LooksAtWhatASeriesChanged) {
  std::size_t seen = 0;
  std::set<std::size_t> operations;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Problem problem = moving_problem(kuhn_box(3, 2, 2, 0.125, 0.2, 3), soft, 1);
    ConservationPlan plan = short_plan(seed, 1);
    plan.everything_every = 1000;
    std::size_t vertices = 0, edges = 0;
    const auto result = validate_refinement<TypeParam>(problem, plan, [&](auto& body, auto&) {
      vertices = body.vertices.size();
      edges = body.springs.size();
    });
    EXPECT_EQ(violation_of(result), "none");
    if (result.refinements > 0) continue;
    operations.insert(result.operations());
    if (result.removals == 0) continue;
    ++seen;
    const reference::Rebuilt start = reference::rebuild(problem.mesh, soft);
    EXPECT_GT(row(result, "mass of a vertex").checks, start.mass.size() + vertices) << seed;
    EXPECT_GT(row(result, "stiffness, damping").checks, 3 * (start.springs.size() + edges)) << seed;
  }
  EXPECT_GT(seen, 3u);
  EXPECT_EQ(operations, (std::set<std::size_t>{1, 2, 3}));
}

// No force acts on the body from outside: its centre of mass moves on, and an operation that removes nothing leaves it
// in place. Gershgorin's bound by vertex, 2 k / m, where the problem's own step is longer.
TYPED_TEST(RefinementConservation, MovesInStepsOfTheProblemOrShorterOnesThatAreStable) {
  for (const double own : {1e-3, 10.0}) {
    Problem problem =
        moving_problem(kuhn_box(2, 2, 1, 0.125, 0.2, 3), {.density = 1000.0, .stiffness = 0.3, .damping = 0.0}, 1);
    problem.fixed.clear();
    problem.surroundings.gravity = {0, 0, 0};
    problem.material.viscosity = 0.0;
    problem.h = own;
    for (auto& v : problem.initial_velocity) v = {1.0, 0.0, 0.0};
    const auto centre = [](const VertexColumns& v) {
      double mass = 0.0, sum = 0.0;
      for (std::size_t k = 0; k < v.size(); ++k) {
        mass += v.mass[k];
        sum += v.mass[k] * v.position[k].x();
      }
      return sum / mass;
    };
    const auto body = build_body<TypeParam, Held::by_every_dart>(problem);
    Views views;
    views.rebuild(body);
    std::vector<double> stiffness(body.vertices.size(), 0.0);
    views.cells.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
      for (const std::uint32_t k : {a, b}) stiffness[k] += body.springs[e].stiffness;
    });
    double h = own;
    for (std::size_t k = 0; k < stiffness.size(); ++k)
      h = std::min(h, 0.5 / std::sqrt(2.0 * stiffness[k] / body.vertices.mass[k]));
    EXPECT_EQ(h == own, own < 1.0);
    std::size_t seen = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const double start = centre(body.vertices);
      double end = start;
      const auto result = validate_refinement<TypeParam>(problem, short_plan(seed, 1),
                                                         [&](auto& moved, auto&) { end = centre(moved.vertices); });
      if (result.removals > 0 || result.steps == 0) continue;
      ++seen;
      EXPECT_NEAR((end - start) / (static_cast<double>(result.steps) * h), 1.0, 1e-9) << seed;
    }
    EXPECT_GT(seen, 3u);
  }
}

// A vertex that may be off changes the forces on the other ends of its springs, and its own by all of them together.
TEST(SpringForceSums, MoveAVertexByAllOfItsSprings) {
  Problem problem = moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1);
  for (auto& x : problem.mesh.points) x *= 1.01;
  const auto body = build_body<TetMap, Held::by_every_dart>(problem);
  Views views;
  views.rebuild(body);
  const std::uint32_t corners[]{0, 1};
  const RefinementMeans means(body.vertices, corners);
  const SpringForceSums sums = spring_force_sums(body, views.cells, 4, &means);
  ASSERT_GT(sums.springs[4], 1u);
  double others = 0.0, terms = 0.0;
  std::size_t ends = 0;
  for (std::size_t k = 0; k < sums.moved.size(); ++k) {
    if (k != 4) others += sums.moved[k];
    terms += sums.terms[k];
    ends += sums.springs[k];
  }
  EXPECT_GT(others, 0.0);
  EXPECT_NEAR(sums.moved[4], others, 1e-12 * others);
  EXPECT_EQ(ends, 2 * body.springs.size());
  double expected = 0.0;
  views.cells.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
    const Spring& s = body.springs[e];
    expected += s.stiffness * ((body.vertices.position[b] - body.vertices.position[a]).norm() + s.rest_length) +
                s.damping * (body.vertices.velocity[b] - body.vertices.velocity[a]).norm();
  });
  EXPECT_NEAR(terms, 2.0 * expected, 1e-12 * terms);
}

// A refinement changes cells: their masses are compared, three numbers each.
TYPED_TEST(RefinementConservation, LooksAtTheCellsThatARefinementMade) {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Problem problem = moving_problem(kuhn_box(3, 2, 2, 0.125, 0.2, 3), soft, 1);
    ConservationPlan plan = short_plan(seed, 1);
    plan.everything_every = 1000;
    std::size_t cells = 0;
    const auto result =
        validate_refinement<TypeParam>(problem, plan, [&](auto& body, auto&) { cells = body.cell_dart.size(); });
    if (result.refinements == 0) continue;
    ++seen;
    // each parent becomes two or more
    const std::size_t before = problem.mesh.cell_count();
    EXPECT_GE(row(result, "mass of a refined cell").checks, 3 * (before + cells + 2 * (cells - before) / 3)) << seed;
  }
  EXPECT_GT(seen, 3u);
}

// An error of 1e-9 in a component is at most that in a length.
TYPED_TEST(RefinementConservation, TellsWhatItFoundBesideWhatItExpected) {
  for (const bool moved : {true, false}) {
    const auto result = this->refined(
        [moved](auto& body) { (moved ? body.vertices.position : body.vertices.velocity).back().y() += 1e-9; });
    ASSERT_TRUE(result.violation);
    const double actual = std::stod(result.violation->actual), expected = std::stod(result.violation->expected);
    EXPECT_NE(actual, expected);
    EXPECT_NEAR(actual, expected, 1.001e-9);
  }
}

TYPED_TEST(RefinementConservation, BoundsTheDriftByTheRootOfItsOperations) {
  const auto result =
      validate_refinement<TypeParam>(moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 1), soft, 1), short_plan(1, 200));
  const double target = drift_target(result.operations());
  for (const char* what : {"drift of total mass", "drift of total stiffness"}) {
    EXPECT_EQ(row(result, what).bound, target) << what;
    EXPECT_LE(row(result, what).deviation, target) << what;
  }
}

TEST(RefinementMeansOfCorners, AreOffByTheRoundingOfFourOperations) {
  VertexColumns columns;
  columns.position = {{1, 0, 0}, {3, 4, 0}};
  columns.velocity = {{0, 0, 2}, {0, 0, -4}};
  columns.fixed = {1, 0};
  const std::uint32_t corners[]{0, 1};
  const RefinementMeans means(columns, corners);
  EXPECT_EQ(means.x, Eigen::Vector3d(2, 2, 0));
  EXPECT_EQ(means.v, Eigen::Vector3d(0, 0, -1));
  EXPECT_FALSE(means.all_fixed);
  // two means of up to four terms: twice gamma_5 of the mean of the absolute values, (2, 2, 0) and (0, 0, 3)
  EXPECT_NEAR(means.off, 2 * 5 * 0x1p-53 * std::sqrt(8.0), 1e-20);
  EXPECT_NEAR(means.off_v, 2 * 5 * 0x1p-53 * 3.0, 1e-20);
}

TEST(RefinementConservationMeshes, MustBeOfTetrahedra) {
  EXPECT_THROW(validate_refinement<Map3>(moving_problem(hexahedron_box(1, 1, 1, 1.0), soft, 1), short_plan(1, 1)),
               InputError);
}

// A tetrahedron of 1/6 m^3, so 8 kg; its corner 0 moves at 1 m/s, the others rest. Into an edge at that corner a vertex
// is put: s = 2, v - mean = +-1/2, and M / (8 s) sum |v - mean|^2 = 8/16 * 1/2 J. Some ten roundings in all.
TEST(Refinements, LoseTheKineticEnergyOfMotionRelativeToTheMean) {
  Problem problem;
  problem.mesh = one_tetrahedron();
  problem.material = {.density = 48.0, .stiffness = 1.0, .damping = 0.0, .viscosity = 0.0};
  problem.initial_velocity.assign(4, Eigen::Vector3d(0, 0, 0));
  problem.initial_velocity[0] = {0, 0, 1};
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  Views views;
  views.rebuild(body);
  const ConservedSums before = sums_of(body, views.cells);
  EXPECT_NEAR(before[Conserved::kinetic].value(), 1.0, 0x1p-50);
  Dart d = no_dart;
  body.map.for_each_dart([&](Dart e) {
    if (body.vertices.point[body.vertex(body.map, e)] == 0) d = e;
  });
  const auto changed = refine(body, Edge{d}, 0.0);
  views.apply(body, TopologyChange{}, changed);
  const ConservedSums after = sums_of(body, views.cells);
  EXPECT_NEAR(after[Conserved::kinetic].value(), 0.75, 0x1p-50);
  EXPECT_NEAR(after[Conserved::momentum_z].value(), 2.0, 0x1p-50);
}

// For a regular tetrahedron with edges of L^2 = 8, each square known to gamma_12. The square of the length from the
// middle of s nodes to another one, j, is a sum of squares between them: 1/s of those to j, less 1/s^2 of those among
// the s; so in absolute values 8 (1 + (s - 1) / (2 s)); adding them up has gamma_24 of that.
TEST(SubdividedCells, KnowTheirLengthsToTheRoundingOfTheSquaresTheyAddUp) {
  for (const std::uint8_t nodes : {std::uint8_t{0b0011}, std::uint8_t{0b0111}}) {
    SubdividedCells cells(reference::regular_tetrahedron(), 1.0);
    const double s = nodes == 0b0011 ? 2.0 : 3.0;
    for (const auto& child : cells.subdivide(0, nodes, 1.0)) {
      const auto j = 3u, edge = SubdividedCells::edge_between(child.replaced, j);
      const double q = (gamma(24) + 1.001 * gamma(12)) * 8.0 * (1.0 + (s - 1.0) / (2.0 * s));
      EXPECT_NEAR(cells.cells()[child.cell].square_error[edge] / q, 1.0, 1e-9) << s;
      const auto [length, off] = cells.rest_length({child.cell, edge});
      EXPECT_NEAR(length * length, 8.0 - 8.0 * (s - 1.0) / (2.0 * s), 1e-14) << s;
      EXPECT_GE(off, q / length);
      const auto& t = cells.cells()[child.cell];
      const double of_points =
          2.0 * (cells.points()[t.points[child.replaced]].error + cells.points()[t.points[j]].error);
      EXPECT_LE(off, 1.01 * (q / length + gamma(6) * length + of_points));
    }
  }
}

// Kuhn's six tetrahedra of a unit cube, around its diagonal.
TEST(SubdividedCells, ShareMassAndStiffnessAndKeepTheirVolume) {
  SubdividedCells cells(kuhn_box(1, 1, 1, 1.0), 6.0);
  std::uint32_t diagonal = 0;
  const auto nodes = [](std::uint32_t e) {
    return static_cast<std::uint8_t>(1u << SubdividedCells::ends[e][0] | 1u << SubdividedCells::ends[e][1]);
  };
  while (cells.around(0, nodes(diagonal)).size() < 6) ++diagonal;
  const auto children = cells.subdivide(0, nodes(diagonal), 0.0);
  ASSERT_EQ(children.size(), 12u);
  EXPECT_EQ(cells.count(), 12u);
  EXPECT_EQ(cells.count_boundary(), 12u);  // the surface is unchanged
  for (const auto& child : children) {
    const auto& t = cells.cells()[child.cell];
    EXPECT_EQ(t.mass, cells.cells()[child.parent].mass / 2.0);
    EXPECT_NEAR(cells.volume(child.cell).first, 1.0 / 12.0, 0x1p-50);
    // one half, twice as stiff; two edges without bracing; opposite edge shared by two; the other two are whole
    double sum = 0.0;
    for (const double share : t.share) sum += share;
    EXPECT_EQ(sum, 2.0 + 2 * 0.0 + 0.5 + 2 * 1.0);
  }
}

}  // namespace
}  // namespace dartboard::refinement_conservation_test
