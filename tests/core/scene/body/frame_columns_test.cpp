// Columns of frames in addition to motion and masses, for bodies with known answers; with a map and without.

#include "core/scene/body/frame_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/mechanics/fracture/stress.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_problem.h"
#include "tests/support/moving_box.h"

namespace dartboard::frame_columns_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr double u = 0x1p-53;  // unit roundoff
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr FrameFields all{.held = true, .stress = true, .displacement = true, .springs = true};

std::unique_ptr<SimulatedBody> body_of(Mesh mesh, bool on_map) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 8.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  BodyNeeds needs = body_needs(problem, on_map);
  needs.rest = true;
  return make_simulated_body(problem, needs);
}

/// Moves every vertex to `stretch` times its place, axis by axis.
void stretch_by(SimulatedBody& body, const Vector3d& stretch) {
  for (Vector3d& x : body.motion().x) x = x.cwiseProduct(stretch);
}

/// A scene that outputs these fields.
SceneFile showing(Json scene, const char* fields) {
  scene["output"]["fields"] = Json::parse(fields);
  return parse(scene);
}

Json chain(int links) {
  Json scene = moving_box();
  scene["body"]["generate"] = {{"chain", {{"links", links}, {"spacing", 0.5}}}};
  return scene;
}

TEST(FrameColumns, AreThoseThatTheSceneAsksForAndNoOthers) {
  for (const bool on_map : {false, true}) {
    const Json scene = on_map ? with_events(moving_box(), R"([{"at": 0.005, "remove": {"ids": [0]}}])") : moving_box();
    const auto filled = [&scene](const char* fields) {
      const Frame f = Simulation(showing(scene, fields)).frame();
      EXPECT_TRUE(f.tension.empty());
      return std::vector<std::size_t>{f.held.size(), f.stress.size(), f.displacement.size(), f.springs.size(),
                                      f.strain.size()};
    };
    // 27 vertices; of 2^3 cubes 54 edges, 36 face diagonals and 8 within
    EXPECT_EQ(filled("[]"), (std::vector<std::size_t>{0, 0, 0, 0, 0}));
    EXPECT_EQ(filled(R"(["held"])"), (std::vector<std::size_t>{27, 0, 0, 0, 0}));
    EXPECT_EQ(filled(R"(["stress"])"), (std::vector<std::size_t>{0, 27, 0, 0, 0}));
    EXPECT_EQ(filled(R"(["displacement"])"), (std::vector<std::size_t>{0, 0, 27, 0, 0}));
    EXPECT_EQ(filled(R"(["springs"])"), (std::vector<std::size_t>{0, 0, 0, 98, 98}));
  }
}

TEST(FrameColumns, OfAChainHaveTensionsForStressesAndStrainsOfItsLinks) {
  const Frame f = Simulation(showing(chain(3), R"(["stress", "springs"])")).frame();
  EXPECT_EQ(f.tension.size(), 3u);
  EXPECT_EQ(f.strain.size(), 3u);
  EXPECT_TRUE(f.springs.empty());  // its links are there already
  EXPECT_TRUE(f.stress.empty());
}

TEST(FrameColumns, ChangeNoBitOfTheMotion) {
  for (const char* events : {"[]", R"([{"at": 0.003, "refine": {"cells": {"ids": [0, 5]}}},
                                       {"at": 0.005, "remove": {"ids": [7]}}])"}) {
    Simulation plain(showing(with_events(moving_box(), events), "[]")),
        shown(showing(with_events(moving_box(), events), R"(["held", "stress", "displacement", "springs"])"));
    while (plain.steps_done() < plain.step_count()) {
      ASSERT_FALSE(plain.advance());
      ASSERT_FALSE(shown.advance());
      shown.frame();
    }
    EXPECT_EQ(shown.body().state_hash(), plain.body().state_hash());
  }
}

// ---- held vertices

TEST(HeldVertices, AreToldApartWithAllPartsOfOneThatIsCut) {
  for (const bool cut : {false, true}) {
    Json scene = moving_box();
    scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
    // held still before it starts, and after
    scene["driven"] = Json::parse(R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "velocity": [1, 0, 0],
                                       "from": 0.002, "until": 0.004}])");
    if (cut)
      scene =
          with_events(scene, R"([{"at": 0, "dissociate": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}}])");
    Simulation simulation(showing(scene, R"(["held", "displacement"])"));
    for (int n = 0; n < 6; ++n) {
      const Frame f = simulation.frame();
      ASSERT_EQ(f.held.size(), cut ? 27u + 9u : 27u);  // a plane of nine vertices comes apart
      for (std::size_t k = 0; k < f.held.size(); ++k) {
        const double x = f.mesh.points[k].x() - f.displacement[k].x();
        const bool at_start = std::abs(x) < 0.01, at_end = std::abs(x - 0.25) < 0.01;
        EXPECT_EQ(f.held[k], at_start ? 1 : at_end ? 2 : 0) << x;
      }
      ASSERT_FALSE(simulation.advance());
    }
  }
}

TEST(HeldVertices, AreFreeOnceTheyAreLetGo) {
  Json scene = with_events(moving_box(),
                           R"([{"at": 0.002, "release": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}}])");
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  Simulation simulation(showing(scene, R"(["held", "displacement"])"));
  for (int n = 0; n < 4; ++n) {
    const Frame f = simulation.frame();
    for (std::size_t k = 0; k < f.held.size(); ++k) {
      const Vector3d rest = f.mesh.points[k] - f.displacement[k];
      const bool is_held = std::abs(rest.x()) < 0.01 && (n < 2 || rest.y() < 0.1);
      EXPECT_EQ(f.held[k], is_held ? 1 : 0) << n << ": " << rest.transpose();
    }
    ASSERT_FALSE(simulation.advance());
  }
}

TEST(HeldVertices, AreNoneOfABodyThatIsFree) {
  const Frame f = Simulation(showing(moving_box(), R"(["held"])")).frame();
  EXPECT_EQ(f.held, std::vector<std::uint8_t>(27, 0));
}

// ---- numbers and order

TEST(FramePoints, AreThoseOfTheMeshInItsOrderUntilSomethingComesApart) {
  const SceneFile scene = parse(with_events(
      moving_box(), R"([{"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])"));
  const Mesh mesh = make_mesh(scene);
  Simulation simulation(scene);
  EXPECT_EQ(simulation.frame().mesh.points, mesh.points);
  for (int n = 0; n < 2; ++n) ASSERT_FALSE(simulation.advance());
  const Frame f = simulation.frame();
  ASSERT_EQ(f.mesh_point.size(), 27u + 9u);
  EXPECT_TRUE(std::ranges::is_sorted(f.mesh_point));
  for (std::size_t k = 0; k < f.mesh_point.size(); ++k) {
    const double x = mesh.points[static_cast<std::size_t>(f.mesh_point[k])].x();
    EXPECT_EQ(std::ranges::count(f.mesh_point, f.mesh_point[k]), x == 0.125 ? 2 : 1) << k;
  }
}

// All data with a row for each point are reordered, and cells and lines refer to the points by their new numbers.
TEST(FramePoints, AreNumberedByTheirFileAndOrderedByThat) {
  Frame f;
  f.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  f.mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 3});
  f.mesh_point = {1, -1, 0, 1};  // the second was made by refinement, the first and the last are parts of one
  f.links = {{0, 2}};
  f.springs = {{3, 1}};
  f.refined_facets = {{.points = {0, 1, 2}, .lies_in = {0, 1, 1}}};
  f.contact_pairs = {{.sample = {1, 2, 3, -1}, .face = {0, 1, 3}}, {.sample = {3, -1, -1, -1}, .obstacle = 2}};
  for (std::vector<double>* column : {&f.mass, &f.contact_depth}) *column = {0, 1, 2, 3};
  for (const double k : f.mass) f.stress.push_back(k * Eigen::Matrix3d::Identity());
  f.held = {0, 1, 2, 3};
  for (auto* column : {&f.velocity, &f.displacement, &f.contact_force}) *column = f.mesh.points;
  const std::vector<std::uint32_t> number{7, 5};
  put_in_order(f, number);
  EXPECT_EQ(f.mesh_point, (std::vector<std::int64_t>{5, 5, 7, -1}));
  EXPECT_EQ(f.refined_facets.at(0).points, (std::array<std::uint32_t, 3>{0, 3, 2}));
  EXPECT_EQ(f.refined_facets.at(0).lies_in, (std::array<std::int64_t, 3>{7, 5, 5}));
  const std::vector<double> order{0, 3, 2, 1};
  EXPECT_EQ(f.held, (std::vector<std::uint8_t>{0, 3, 2, 1}));
  for (const std::vector<double>* column : {&f.mass, &f.contact_depth}) EXPECT_EQ(*column, order);
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(f.stress.at(k)(2, 2), order[k]);
  for (const auto* column : {&f.mesh.points, &f.velocity, &f.displacement, &f.contact_force})
    for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ((*column)[k].x(), order[k]);
  EXPECT_EQ(f.mesh.nodes, (std::vector<std::uint32_t>{0, 3, 1}));
  EXPECT_EQ(f.links[0], (std::array<std::uint32_t, 2>{0, 2}));
  EXPECT_EQ(f.springs[0], (std::array<std::uint32_t, 2>{1, 3}));
  EXPECT_EQ(f.contact_pairs[0].sample, (std::array<std::int64_t, 4>{3, 2, 1, -1}));
  EXPECT_EQ(f.contact_pairs[0].face, (std::array<std::int64_t, 3>{0, 3, 1}));
  EXPECT_EQ(f.contact_pairs[1].sample, (std::array<std::int64_t, 4>{1, -1, -1, -1}));
  EXPECT_EQ(f.contact_pairs[1].face, (std::array<std::int64_t, 3>{-1, -1, -1}));
  EXPECT_EQ(f.contact_pairs[1].obstacle, 2);
}

// ---- stress

// Around a vertex inside a lattice of cubes of side a, and alike on its surface (stress_test.cpp), springs of 4 k along
// each axis: a stretch by s along one gives the stress 4 k (s - 1) / a there and none across, so that all measures of
// it are known. Lengths are exact; masses and stresses sum fewer than 64 terms.
TEST(FrameStress, OfAUniaxialStretchHasTheVonMisesStressOfItsPull) {
  for (const bool on_map : {false, true})
    for (const double s : {1.5, 0.5}) {
      const auto body = body_of(hexahedron_box(3, 2, 2, 0.5), on_map);
      stretch_by(*body, {1, 1, s});
      const double pull = 4 * 4.0 * (s - 1) / 0.5, off = 64 * u * std::abs(pull);
      const Frame f = body->frame(all);
      ASSERT_EQ(f.stress.size(), 4u * 3 * 3);
      for (const Eigen::Matrix3d& stress : f.stress) {
        const StressMeasures measures = measures_of(stress);
        EXPECT_NEAR(measures.largest_principal, std::max(pull, 0.0), off);
        EXPECT_NEAR(measures.largest_magnitude, std::abs(pull), off);
        EXPECT_NEAR(measures.von_mises, std::abs(pull), off);
      }
    }
}

TEST(FrameStress, IsThatOfTheDiagnostics) {
  for (const bool on_map : {false, true}) {
    const auto body = body_of(kuhn_box(3, 2, 2, 0.5, 0.2, 7), on_map);
    stretch_by(*body, {1.25, 0.875, 1.5});
    const Frame f = body->frame(all);
    EXPECT_EQ(f.largest_stress, body->largest_stress());
    // each vertex has its own: the stress with its number
    std::vector<Eigen::Matrix3d> stress;
    const SpringSystem system = body->system();
    std::vector<double> now(system.mass.size());
    find_volumes_now(f.mesh, f.mesh.points, now);
    vertex_stresses(system.ends, system.springs, {system.mass, 8.0, {}, now}, body->vertices().position, stress);
    EXPECT_EQ(f.stress, stress);
  }
}

TEST(FrameStress, OfAFrameServesItsDiagnostics) {
  const Simulation simulation(showing(moving_box(), R"(["stress"])"));
  EXPECT_EQ(simulation.diagnostics(simulation.frame().largest_stress).largest_stress,
            simulation.diagnostics().largest_stress);
  EXPECT_EQ(simulation.diagnostics(7.0).largest_stress, 7.0);
}

TEST(FrameStress, IsInfiniteWhereItIsNotFiniteAndNowhereElse) {
  for (const bool on_map : {false, true}) {
    const auto body = body_of(hexahedron_box(4, 1, 1, 0.5), on_map);
    for (Vector3d& x : body->motion().x)
      if (x.x() == 2.0) x.x() = infinity;
    const Frame f = body->frame(all);
    EXPECT_EQ(f.largest_stress, infinity);
    for (std::size_t k = 0; k < f.mesh.points.size(); ++k) {
      const bool near = f.mesh.points[k].x() >= 1.5;  // at the end, or a spring from there
      EXPECT_EQ(measures_of(f.stress[k]).largest_principal, near ? infinity : 0.0) << f.mesh.points[k].x();
    }
  }
}

TEST(FrameTension, IsThatOfEachLink) {
  Mesh points;
  for (int k = 0; k < 5; ++k) points.points.emplace_back(0.5 * k, 0, 0);
  points.links = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  const auto body = body_of(std::move(points), false);
  auto x = body->motion().x;
  for (std::size_t k = 2; k < 5; ++k) x[k].y() += 0.25;  // from now on all of these are higher
  x[1].x() -= 0.25;
  x[4].x() = infinity;
  const Frame f = body->frame(all);
  const double aslant = std::sqrt(0.75 * 0.75 + 0.25 * 0.25);
  EXPECT_EQ(f.tension[0], 4.0 * -0.25);
  EXPECT_NEAR(f.tension[1], 4.0 * (aslant - 0.5), 8 * u * 4.0);
  EXPECT_EQ(f.tension[2], 0.0);
  EXPECT_EQ(f.tension[3], infinity);
  EXPECT_EQ(f.strain[0], -0.5);
  EXPECT_NEAR(f.strain[1], (aslant - 0.5) / 0.5, 8 * u * 2.0);
  EXPECT_EQ(f.strain[2], 0.0);
  EXPECT_EQ(f.strain[3], infinity);
}

// ---- displacement

// No force acts on the vertices, so that each flies on a straight line: after t it is at X + t A (X - c), X being its
// place at rest. That holds for vertices made by refinement, which have the mean of their neighbours' places and
// velocities, only if their place at rest is the mean of those at rest.
TEST(Displacement, IsFromWhereAVertexWasAtRestAfterCutsAndRefinementsToo) {
  Json scene = with_events(moving_box(), R"([
      {"at": 0.002, "refine": {"cells": {"ids": [0, 9, 31]}}},
      {"at": 0.004, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
      {"at": 0.006, "refine": {"cells": {"ids": [5, 40]}, "at": "centre"}},
      {"at": 0.008, "remove": {"ids": [17, 3]}}])");
  scene["material"]["stiffness"] = scene["material"]["damping"] = scene["material"]["viscosity"] = 0;
  scene["gravity"] = {0, 0, 0};
  Simulation simulation(showing(scene, R"(["displacement"])"));
  run(simulation);
  const Frame f = simulation.frame();
  const VertexColumns& v = simulation.body().vertices();
  Eigen::Matrix3d linear;
  linear << 1, -2, 0, 2, 0.5, 0, 0, 0, -1;  // moving_box.h
  const std::size_t put_in = static_cast<std::size_t>(std::ranges::count(v.point, no_point));
  EXPECT_GE(put_in, 5u);
  EXPECT_GT(f.displacement.size() - put_in, 27u);  // some came apart
  for (std::size_t k = 0; k < f.displacement.size(); ++k) {
    const Vector3d rest = f.mesh.points[k] - f.displacement[k];
    const Vector3d expected = 0.01 * linear * (rest - Vector3d(0.125, 0.125, 0.125));
    // ten steps, each some 20 roundings of places and velocities below 1
    EXPECT_LE((f.displacement[k] - expected).norm(), 256 * u) << k;
    EXPECT_GT(f.displacement[k].norm(),
              f.mesh_point[k] == 13 ? -1.0 : 1e-5);  // all have moved except the one in the middle
  }
}

TEST(Displacement, OfAMovedBodyIsItsMoveToTheBit) {
  for (const bool on_map : {false, true})
    for (Mesh mesh : {kuhn_box(2, 2, 1, 0.5), triangle_sheet(3, 2, 0.5)}) {
      const auto body = body_of(std::move(mesh), on_map);
      EXPECT_EQ(body->frame(all).displacement, std::vector<Vector3d>(body->vertices().size(), Vector3d(0, 0, 0)));
      for (Vector3d& x : body->motion().x) x += Vector3d(1, -0.5, 0.25);
      for (const Vector3d& d : body->frame(all).displacement) EXPECT_EQ(d, Vector3d(1, -0.5, 0.25));
    }
}

TEST(Displacement, IsHeldOnlyWhereItIsAskedFor) {
  for (const char* events : {"[]", R"([{"at": 0.003, "refine": {"cells": {"ids": [0]}}},
                                       {"at": 0.005, "remove": {"ids": [7]}}])"}) {
    Simulation without(showing(with_events(moving_box(), events), R"(["held", "stress", "springs"])"));
    run(without);
    EXPECT_TRUE(without.body().vertices().rest.empty());
    Simulation with(showing(with_events(moving_box(), events), R"(["displacement"])"));
    run(with);
    EXPECT_EQ(with.body().vertices().rest.size(), with.body().vertices().size());
  }
}

// ---- springs

TEST(FrameSprings, HaveTheStrainOfAUniformStretch) {
  for (const bool on_map : {false, true}) {
    const auto body = body_of(hexahedron_box(3, 2, 1, 0.5), on_map);
    stretch_by(*body, {1.25, 0.5, 1});
    const Frame f = body->frame(all);
    ASSERT_EQ(f.springs.size(), 3u * 3 * 2 + 4u * 2 * 2 + 4u * 3 * 1);
    for (std::size_t k = 0; k < f.springs.size(); ++k) {
      const Vector3d along = f.mesh.points[f.springs[k][1]] - f.mesh.points[f.springs[k][0]];
      EXPECT_EQ(f.strain[k], along.x() != 0 ? 0.25 : along.y() != 0 ? -0.5 : 0.0);
    }
  }
}

TEST(FrameSprings, AreThoseOfTheBodyAfterACutToo) {
  Simulation simulation(
      showing(with_events(moving_box(),
                          R"([{"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])"),
              R"(["springs"])"));
  const Frame f = simulation.frame();
  EXPECT_EQ(f.springs.size(), simulation.body().counts().edges);
  // in the cut, four squares: 12 sides and 4 diagonals are there twice
  EXPECT_EQ(f.springs.size(), 98u + 16u);
  const std::set<std::array<std::uint32_t, 2>> once(f.springs.begin(), f.springs.end());
  EXPECT_EQ(once.size(), f.springs.size());
}

// A hexahedron with two corners in one place has a volume, and an edge without length.
TEST(FrameSprings, WithoutLengthAtRestHaveAnInfiniteStrain) {
  for (const bool on_map : {false, true}) {
    Mesh mesh = hexahedron_box(1, 1, 1, 1.0);
    const std::uint32_t corner = mesh.cell(0)[0];
    mesh.points[mesh.cell(0)[1]] = mesh.points[corner];
    const auto body = body_of(std::move(mesh), on_map);
    for (const bool apart : {false, true}) {
      for (std::size_t k = 0; apart && k < 8; ++k)
        if (body->vertices().point[k] == corner) body->motion().x[k].z() += 0.5;
      const Frame f = body->frame(all);
      EXPECT_EQ(std::ranges::count(f.strain, infinity), 1);
      EXPECT_TRUE(std::ranges::none_of(f.strain, [](double x) { return std::isnan(x); }));
    }
  }
}

}  // namespace
}  // namespace dartboard::frame_columns_test
