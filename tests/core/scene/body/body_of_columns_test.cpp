// A body without a map compared with the same body on one: leaving the map out of a scene without events has no effect.

#include "core/scene/body/body_of_columns.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"

namespace dartboard::body_of_columns_test {
namespace {

Problem moving(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 1000.0, .stiffness = 2.0e4, .damping = 3.0, .viscosity = 0.5};
  problem.fixed = {0};
  for (const auto& p : problem.mesh.points) problem.initial_velocity.emplace_back(p.y(), -p.x(), 0.25 * p.z());
  return problem;
}

struct Kind {
  const char* name;
  Mesh mesh;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

struct Bodies : testing::TestWithParam<Kind> {
  Problem problem = moving(GetParam().mesh);
  std::unique_ptr<SimulatedBody> with = make_simulated_body(problem, true),
                                 without = make_simulated_body(problem, false);
};

TEST_P(Bodies, MoveWithTheSameBits) {
  for (SimulatedBody* body : {with.get(), without.get()}) {
    const auto integrator = make_integrator("rk4");
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(integrator->step(body->system(), body->motion(), 1e-4).ok());
  }
  EXPECT_EQ(with->state_hash(), without->state_hash());
  EXPECT_EQ(with->mass(), without->mass());
  EXPECT_EQ(with->counts(), without->counts());
  EXPECT_EQ(with->largest_stress(), without->largest_stress());
  // the facets are summed in another order: n of them, each with a few roundings
  const double area = with->boundary();
  EXPECT_NEAR(without->boundary(), area, area * 1024 * 0x1p-52);
}

TEST_P(Bodies, ShowTheSameCellsInAFrame) {
  const Frame a = with->frame({}), b = without->frame({});
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.kinds, b.mesh.kinds);
  EXPECT_EQ(a.component, b.component);
  for (std::size_t c = 0; c < a.mesh.cell_count(); ++c) {
    const auto sorted = [c](const Mesh& mesh) {
      std::vector<std::uint32_t> nodes(mesh.cell(c).begin(), mesh.cell(c).end());
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    };
    EXPECT_EQ(sorted(a.mesh), sorted(b.mesh)) << "cell " << c;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, Bodies,
                         testing::Values(Kind{"tetrahedra", kuhn_box(2, 2, 2, 0.25, 0.2, 1)},
                                         Kind{"hexahedra", hexahedron_box(2, 2, 1, 0.25)},
                                         Kind{"mixed", mixed_box(2, 2, 2, 0.25)},
                                         Kind{"triangles", triangle_sheet(3, 2, 0.25)}));

TEST(BodyOfColumns, HoldsNoDart) {
  const BodyOfColumns body(moving(kuhn_box(2, 2, 2, 0.25)));
  EXPECT_EQ(body.vertices().dart.capacity(), 0u);
  EXPECT_EQ(body.map_name(), "no map");
}

TEST(BodyOfColumns, RefusesAnEvent) {
  BodyOfColumns body(moving(kuhn_box(1, 1, 1, 0.25)));
  EXPECT_THROW(body.make_ready({}), InputError);
}

}  // namespace
}  // namespace dartboard::body_of_columns_test
