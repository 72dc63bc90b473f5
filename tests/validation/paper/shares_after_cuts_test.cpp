#include "validation/paper/shares_after_cuts.h"

#include <gtest/gtest.h>

#include "tests/support/meshes_for_tests.h"
#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::shares_after_cuts_test {
namespace {

using Body = LiveBody<Map3>;

/// The answers for wrong bodies: each is adapted, and then changed where a vertex or an edge came apart.
SharesAfterCuts with(const std::function<void(Body&, const TopologyChange&)>& spoil) {
  return try_dissociations(small_tetrahedral_problem(), 200, 3, [&](Body& body, const TopologyChange& change) {
    core_adapt(body, change);
    spoil(body, change);
  });
}
SharesAfterCuts with_vertex(const std::function<void(Body&, std::uint32_t kept, std::uint32_t split)>& spoil) {
  return with([&](Body& body, const TopologyChange& change) {
    for (const auto& [kept, split] : change.vertices)
      spoil(body, body.vertex(body.map, kept), body.vertex(body.map, split));
  });
}

TEST(SharesAfterCuts, AreThoseOfThePaper) {
  const SharesAfterCuts answers = try_dissociations(small_tetrahedral_problem(), 200, 3);
  for (const ClaimAnswer& a : {answers.mass, answers.stiffness, answers.viscosity, answers.rest_shape, answers.state})
    expect_yes(a);
}

TEST(SharesAfterCuts, FallShortWhereAPartKeepsAllOfTheMass) {
  const auto answers = with_vertex(
      [](Body& body, std::uint32_t kept, std::uint32_t split) { body.set_mass(split, body.vertices.mass[kept]); });
  expect_no(answers.mass);
  expect_no(answers.rest_shape);
  expect_no(answers.viscosity);
  expect_yes(answers.stiffness);
}

/// Two tetrahedra of 1/6 and 1/3 m^3 that part at their one face.
SharesAfterCuts of_two(const std::function<void(Body&, const TopologyChange&)>& spoil) {
  Problem problem = small_tetrahedral_problem();
  problem.mesh = unequal_tetrahedra();
  return try_dissociations(problem, 1, 3, [&](Body& body, const TopologyChange& change) {
    core_adapt(body, change);
    spoil(body, change);
  });
}

// m = m1 + m2, by halves and not by the cells around each part.
TEST(SharesAfterCuts, FallShortWhereMassIsSharedByHalves) {
  expect_yes(of_two([](Body&, const TopologyChange&) {}).mass);
  expect_no(of_two([](Body& body, const TopologyChange& change) {
              for (const auto& [kept, split] : change.vertices) {
                const std::uint32_t k = body.vertex(body.map, kept), l = body.vertex(body.map, split);
                const double half = 0.5 * (body.vertices.mass[k] + body.vertices.mass[l]);
                body.set_mass(k, half);
                body.set_mass(l, half);
              }
            }).mass);
}

TEST(SharesAfterCuts, FallShortWhereOnePartIsOffInTheTwelfthDigit) {
  expect_no(with_vertex([](Body& body, std::uint32_t, std::uint32_t split) {
              body.vertices.mass[split] *= 1.0 + 1e-12;
            }).mass);
}

TEST(SharesAfterCuts, FallShortWhereStiffnessIsOffByAnything) {
  for (const double factor : {0.5, 1.0 + 1e-15, 2.0}) {
    const auto answers = with([&](Body& body, const TopologyChange& change) {
      for (const auto& [kept, split] : change.edges)
        body.springs.change(body.edge(body.map, split), [&](Spring& s) { s.stiffness *= factor; });
    });
    expect_no(answers.stiffness);
    expect_yes(answers.mass);
  }
}

// The sum of both is right.
TEST(SharesAfterCuts, FallShortWhereAPartHasNoDamping) {
  expect_yes(of_two([](Body&, const TopologyChange&) {}).stiffness);
  expect_no(of_two([](Body& body, const TopologyChange& change) {
              for (const auto& [kept, split] : change.edges) {
                body.springs.change(body.edge(body.map, kept), [](Spring& s) { s.damping *= 2.0; });
                body.springs.change(body.edge(body.map, split), [](Spring& s) { s.damping = 0.0; });
              }
            }).stiffness);
}

TEST(SharesAfterCuts, FallShortWhereViscosityStaysThatOfTheWhole) {
  const auto answers = with_vertex([](Body& body, std::uint32_t kept, std::uint32_t split) {
    body.vertices.viscosity[kept] += body.vertices.viscosity[split];
  });
  expect_no(answers.viscosity);
  expect_yes(answers.mass);
}

TEST(SharesAfterCuts, FallShortWhereMassesAreOfTheDeformedShape) {
  const auto answers = with_vertex([](Body& body, std::uint32_t kept, std::uint32_t split) {
    for (const std::uint32_t k : {kept, split}) body.set_mass(k, 1.3 * body.vertices.mass[k]);
  });
  expect_no(answers.rest_shape);
}

TEST(SharesAfterCuts, FallShortWhereAPartIsMovedOrStopped) {
  expect_no(with_vertex([](Body& body, std::uint32_t, std::uint32_t split) {
              body.vertices.position[split][0] += 1e-12;
            }).state);
  expect_no(with_vertex([](Body& body, std::uint32_t, std::uint32_t split) {
              body.vertices.velocity[split].setZero();
            }).state);
}

// "we must prevent unsewed darts to share the same embeddings"
TEST(SharesAfterCuts, FallShortWhereThePartsShareAnEmbedding) {
  expect_no(with_vertex([](Body& body, std::uint32_t kept, std::uint32_t split) {
              if (split + 1 != body.vertices.size()) return;
              body.vertex.attach(body.map, Vertex{body.vertices.dart[split]}, kept);
            }).state);
}

TEST(SharesAfterCuts, AreNotAnsweredWhereNothingCameApart) {
  const SharesAfterCuts answers = try_dissociations(small_tetrahedral_problem(), 0, 3);
  for (const ClaimAnswer& a : {answers.mass, answers.stiffness, answers.viscosity, answers.rest_shape, answers.state})
    expect_no(a);
}

}  // namespace
}  // namespace dartboard::shares_after_cuts_test
