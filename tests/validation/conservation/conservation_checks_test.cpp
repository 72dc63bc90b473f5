// The occasional comparisons of conservation, on a body with one fault.

#include "validation/conservation/conservation_checks.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::conservation_checks_test {
namespace {

constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

/// The first violation found in twelve tetrahedra with a fault; "nothing" if there is none.
std::string found(const std::function<void(Subject<TetMap>&)>& spoil) {
  const Problem start = moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1);
  Subject<TetMap> subject(start);
  ConservationResult result;
  ConservationLedger ledger(
      result, 1,
      std::array{Check::counts, Check::euler, Check::valid, Check::mass_of_vertex, Check::mass_of_cells,
                 Check::spring_of_edge, Check::ends, Check::views, Check::boundary_area, Check::side_by_side});
  ConservationChecks<TetMap> checks(subject, ledger);
  spoil(subject);
  checks.everything();
  return result.violation ? result.violation->what : "nothing";
}

TEST(ConservationChecksOfABody, FindNothingWhereNothingIsWrong) {
  EXPECT_EQ(found([](auto&) {}), "nothing");
}

TEST(ConservationChecksOfABody, NameAVertexThatIsTooHeavy) {
  EXPECT_EQ(found([](auto& at) { at.body.set_mass(0, at.body.vertices.mass[0] * (1.0 + 1e-15)); }),
            "mass of a vertex, vertex 0");
}

TEST(ConservationChecksOfABody, NameASpringThatIsTooStiff) {
  EXPECT_EQ(found([](auto& at) { at.body.springs.change(0, [](Spring& s) { s.stiffness *= 1.0 + 1e-15; }); }),
            "stiffness, damping, rest length of an edge, stiffness, edge 0");
}

TEST(ConservationChecksOfABody, NameADamperAndARestLengthThatAreOff) {
  EXPECT_EQ(found([](auto& at) { at.body.springs.change(0, [](Spring& s) { s.damping *= 1.0 + 1e-15; }); }),
            "stiffness, damping, rest length of an edge, damping, edge 0");
  EXPECT_EQ(found([](auto& at) { at.body.springs.change(0, [](Spring& s) { s.rest_length *= 1.0 + 1e-15; }); }),
            "stiffness, damping, rest length of an edge, rest length, edge 0");
}

// For the soup's springs, which are the body's edges here: each is found for its edge, and compared in stiffness and in
// damping.
TEST(ConservationChecksOfABody, CompareEverySpringOfTheSoup) {
  const Problem start = moving_problem(kuhn_box(2, 1, 1, 0.125, 0.2, 3), soft, 1);
  Subject<TetMap> subject(start);
  ConservationResult result;
  ConservationLedger ledger(
      result, 1,
      std::array{Check::counts, Check::euler, Check::valid, Check::mass_of_vertex, Check::mass_of_cells,
                 Check::spring_of_edge, Check::ends, Check::views, Check::boundary_area, Check::side_by_side});
  ConservationChecks<TetMap>(subject, ledger).everything();
  ASSERT_FALSE(ledger.broken());
  EXPECT_EQ(result.rows.back().checks, 3 * subject.body.springs.size());
}

// By its own count, the body has one face too many.
TEST(ConservationChecksOfABody, NameANumberOfCellsThatIsOff) {
  EXPECT_EQ(found([](auto& at) { at.body.face_dart.push_back(at.body.face_dart.front()); }),
            "vertices, edges, faces, volumes, dimension 2");
}

TEST(ConservationChecksOfABody, NameEachViewThatIsStale) {
  const auto stale = [](const std::function<void(Views&)>& spoil) { return found([&](auto& at) { spoil(at.views); }); };
  const auto expect = [&](const char* name, const std::function<void(Views&)>& spoil) {
    EXPECT_EQ(stale(spoil).find(std::string("all views: apply = rebuild, ") + name), 0u) << stale(spoil);
  };
  expect("spring ends", [](Views& v) { std::swap(v.ends.ends[0][0], v.ends.ends[0][1]); });
  expect("boundary surface", [](Views& v) { v.boundary = {}; });
  expect("component labels", [](Views& v) { v.components = ComponentLabels(); });
  expect("cell arrays", [](Views& v) { std::swap(v.cells.edges[0].ends[0], v.cells.edges[0].ends[1]); });
}

// By the remaining cells, and not by core's own rebuild.
TEST(ConservationChecksOfABody, NameASpringThatEndsElsewhereInAView) {
  EXPECT_EQ(found([](auto& at) { std::swap(at.views.ends.ends[0], at.views.ends.ends[1]); }),
            "ends of springs in the views, from the cells left, view, edge 1");
  EXPECT_EQ(found([](auto& at) { std::swap(at.views.cells.edges[0].ends, at.views.cells.edges[1].ends); }),
            "ends of springs in the views, from the cells left, arrays, edge 1");
}

}  // namespace
}  // namespace dartboard::conservation_checks_test
