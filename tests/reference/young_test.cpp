// Springs of a Young's modulus, by the soup of cells and by a body on a map.

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "core/base/young.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/walks/cell_arrays.h"
#include "reference/cgal/cgal_body.h"
#include "reference/rebuild.h"
#include "reference/summation_bound.h"

namespace dartboard::young_test {
namespace {

Problem elastic(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 900.0, .damping = 0.25, .young = 5e4};
  problem.material.stiffness = mean_stiffness(problem.mesh, 5e4);
  return problem;
}

template <class Map>
void expect_agreement(const Problem& problem) {
  const auto body = build_body<Map, Held::by_every_dart>(problem);
  CellArrays arrays;
  arrays.rebuild(body);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Spring> by_points;
  for (const EdgeEntry& e : arrays.edges)
    by_points[std::minmax(body.vertices.point[e.ends[0]], body.vertices.point[e.ends[1]])] = body.springs[e.embedding];
  const auto rebuilt = reference::rebuild(problem.mesh, problem.material);
  ASSERT_EQ(rebuilt.springs.size(), by_points.size());
  for (std::size_t e = 0; e < rebuilt.springs.size(); ++e) {
    const reference::Spring& s = rebuilt.springs[e];
    const Spring other = by_points.at({s.a, s.b});
    // a sum over as many cells on either side, each with a volume of some 20 roundings and five more
    const double rounding = 2.0 * (rebuilt.cells[e] + 32.0) * 0x1p-53;
    EXPECT_NEAR(other.stiffness, s.stiffness, rounding * s.stiffness);
    EXPECT_NEAR(other.damping, s.damping, rounding * s.damping);
  }
}

TEST(YoungsModulus, GivesTheSameSpringsByASoupOfCells) {
  expect_agreement<TetMap>(elastic(kuhn_box(3, 2, 2, 0.1, 0.3, 5)));
  expect_agreement<Map3>(elastic(kuhn_box(2, 2, 1, 0.1, 0.3, 6)));
  expect_agreement<TetMap>(elastic(tetrahedron_ball(2, 0.5)));
  expect_agreement<Map2>(elastic(triangle_sheet(4, 3, 0.1)));
}

TEST(YoungsModulus, IsRefusedByWitnessesThatKnowOneStiffnessForAll) {
  const Problem problem = elastic(kuhn_box(1, 1, 1, 0.1));
  const PointState start{problem.mesh.points, problem.mesh.points};
  EXPECT_THROW(reference::state_bound(problem, start, 1), InputError);
  EXPECT_THROW(reference::CgalBody{problem}, InputError);
}

}  // namespace
}  // namespace dartboard::young_test
