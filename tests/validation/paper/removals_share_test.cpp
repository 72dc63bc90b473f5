#include "validation/paper/removals_share.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::removals_share_test {
namespace {

using Body = LiveBody<Map3>;

RemovalAnswers with(const std::function<void(Body&, const TopologyChange&)>& spoil) {
  return try_removals(small_tetrahedral_problem(), 40, 5, [&](Body& body, const TopologyChange& change) {
    core_adapt(body, change);
    spoil(body, change);
  });
}

TEST(Removals, ShareMassAndStiffnessAndFreeTheFaces) {
  const RemovalAnswers answers = try_removals(small_tetrahedral_problem(), 40, 5);
  expect_yes(answers.shares);
  expect_yes(answers.free_faces);
}

TEST(Removals, DoNotShareWhereANeighbourKeepsTheVolumesMass) {
  expect_no(with([](Body& body, const TopologyChange& change) {
              for (const auto& [kept, split] : change.vertices)
                if (body.map.is_live(kept)) body.vertices.mass[body.vertex(body.map, kept)] *= 1.1;
            }).shares);
}

TEST(Removals, DoNotShareWhereAnEdgeIsOffByABit) {
  expect_no(with([](Body& body, const TopologyChange& change) {
              for (const auto& [kept, split] : change.edges)
                if (body.map.is_live(kept))
                  body.springs.change(body.edge(body.map, kept), [](Spring& s) { s.stiffness *= 1.0 + 0x1p-52; });
            }).shares);
}

// One removal, and a change at the vertex and the edge that are farthest from it: nothing there may change.
TEST(Removals, DoNotShareWhereSomeOtherVertexOrEdgeChanges) {
  const auto far_away = [](const std::function<void(Body&, std::uint32_t vertex, std::uint32_t edge)>& spoil) {
    return try_removals(small_tetrahedral_problem(), 1, 5, [&](Body& body, const TopologyChange& change) {
      core_adapt(body, change);
      Eigen::Vector3d there(0, 0, 0);
      for (const auto& [kept, split] : change.vertices)
        if (body.map.is_live(kept)) there = body.vertices.position[body.vertex(body.map, kept)];
      std::uint32_t vertex = 0;
      for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
        if ((body.vertices.position[k] - there).norm() > (body.vertices.position[vertex] - there).norm()) vertex = k;
      spoil(body, vertex, body.edge(body.map, body.vertices.dart[vertex]));
    });
  };
  expect_yes(far_away([](Body&, std::uint32_t, std::uint32_t) {}).shares);
  expect_no(far_away([](Body& body, std::uint32_t v, std::uint32_t) { body.vertices.mass[v] *= 1.0 + 1e-9; }).shares);
  expect_no(far_away([](Body& body, std::uint32_t, std::uint32_t e) {
              body.springs.change(e, [](Spring& s) { s.stiffness *= 1.0 + 1e-9; });
            }).shares);
}

TEST(Removals, AreNotAnsweredWhereThereAreNone) {
  const RemovalAnswers answers = try_removals(small_tetrahedral_problem(), 0, 5);
  expect_no(answers.shares);
  expect_no(answers.free_faces);
}

// The map is changed unknown to the body: another face is freed, too.
TEST(Removals, FreeNoOtherFace) {
  expect_no(with([](Body& body, const TopologyChange&) {
              Dart sewn = no_dart;
              body.map.for_each_dart([&](Dart d) { sewn = body.map.is_free<3>(d) ? sewn : d; });
              for (const Dart d : orbit<0, 1>(body.map, sewn)) body.map.unlink<3>(d);
            }).free_faces);
}

}  // namespace
}  // namespace dartboard::removals_share_test
