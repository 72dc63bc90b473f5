// CGAL's tasks in `bench topology`: numbers that theory predicts for its maps, found again after each restoring.

#include "validation/cgal/cgal_topology_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/meshes_for_tests.h"
#include "validation/cgal/map_twin.h"

namespace dartboard::cgal_topology_tasks_test {
namespace {

using reference::kuhn_grid;
using reference::regular_tetrahedron;
using reference::unequal_tetrahedra;

std::uint32_t point_of(const Mesh& mesh, std::uint32_t d) {
  return mesh.cell(d / 24)[shape_of(CellKind::tetrahedron).node[d % 24]];
}

/// A dart of each vertex of the mesh; the faces are given by their points.
TopologyWork work_on(const Mesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& cut) {
  TopologyWork work{mesh, {}, {}, {}};
  std::vector<bool> met(mesh.points.size(), false);
  const auto darts = static_cast<std::uint32_t>(24 * mesh.cell_count());
  for (std::uint32_t d = 0; d < darts; ++d) {
    if (met[point_of(mesh, d)]) continue;
    met[point_of(mesh, d)] = true;
    work.vertices.push_back({d});
  }
  for (auto points : cut) {
    std::sort(points.begin(), points.end());
    for (std::uint32_t first = 0; first < darts; first += 6) {
      std::array found{point_of(mesh, first), point_of(mesh, first + 2), point_of(mesh, first + 4)};
      std::sort(found.begin(), found.end());
      if (found != points) continue;
      work.cut.push_back({first});
      break;
    }
  }
  work.scattered = work.cut;
  return work;
}

/// The result of each figure, twice with a restoring in between.
std::map<std::string, std::uint64_t> found_by(std::vector<TopologyTask> tasks) {
  std::map<std::string, std::uint64_t> found;
  for (const TopologyTask& task : tasks) {
    found[task.figure] = task.run();
    task.restore();
    EXPECT_EQ(task.run(), found[task.figure]) << task.figure;
    task.restore();
  }
  return found;
}

using Figures = std::map<std::string, std::uint64_t>;

// Darts: 24 a tetrahedron, all of them at some vertex; incidences: 4 a tetrahedron.
TEST(CgalTopologyTasks, CountTheCellsOfAKuhnCube) {
  const TopologyWork work = work_on(kuhn_grid(1, 1, 1, 1.0), {});
  const Figures reads{{"vertex-orbit", 144},
                      {"vertex-to-tetrahedra", 24},
                      {"full-check", 1},
                      {"count-cells", 8 + 19 + 18 + 6},
                      {"build", 144}};
  EXPECT_EQ(found_by(cgal_bare_topology_tasks(work)), reads);
  Figures all = reads;
  all["unsew-cut"] = all["unsew-scattered"] = 0;  // no face is given
  EXPECT_EQ(found_by(cgal_topology_tasks(work)), all);
}

// Two tetrahedra that lose their common face come apart at its three vertices and three edges.
TEST(CgalTopologyTasks, CountWhatComesApartWithAFace) {
  TopologyWork work = work_on(unequal_tetrahedra(), {{0, 1, 2}});
  ASSERT_EQ(work.cut.size(), 1u);
  Figures expected{{"vertex-orbit", 48},  {"vertex-to-tetrahedra", 8},
                   {"full-check", 1},     {"count-cells", 5 + 9 + 7 + 2},
                   {"build", 48},         {"unsew-cut", 6},
                   {"unsew-scattered", 6}};
  EXPECT_EQ(found_by(cgal_topology_tasks(work)), expected);
  // a face listed twice, from either side, counts once; a face of the boundary does not count
  work.cut.push_back(work.cut[0]);
  for (std::uint32_t d = 0; d < 48; ++d) work.scattered = {{d}};
  EXPECT_EQ(found_by(cgal_topology_tasks(work))["unsew-cut"], 6u);
}

// Three tetrahedra around an edge: one face gone splits nothing but that face; with two gone the wedge between is no
// longer joined at the edge's ends. Kuhn's cube has six around its diagonal.
TEST(CgalTopologyTasks, SplitTheEdgeOnlyWithTheSecondFaceAroundIt) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  std::vector<std::array<std::uint32_t, 3>> around;  // the faces at the diagonal 0 7
  for (const std::uint32_t p : {1u, 2u, 3u, 4u, 5u, 6u}) around.push_back({0, p, 7});
  const TopologyWork one = work_on(mesh, {around[0]}), all = work_on(mesh, around);
  ASSERT_EQ(all.cut.size(), 6u);
  // a face inside: its two other edges lie on the surface of the cube and come apart, and so does the vertex between
  EXPECT_EQ(found_by(cgal_topology_tasks(one))["unsew-cut"], 3u);
  // six tetrahedra alone have 24 vertices and 36 edges: 24 - 8 and 36 - 19 more than before
  EXPECT_EQ(found_by(cgal_topology_tasks(all))["unsew-cut"], 16u + 17u);
}

TEST(CgalTopologyTasks, AreForTetrahedra) {
  TopologyWork work;
  work.mesh = hexahedron_box(1, 1, 1, 1.0);
  EXPECT_THROW(cgal_topology_tasks(work), InputError);
  EXPECT_THROW(cgal_bare_topology_tasks(work), InputError);
}

// At least four links of a pointer each per dart.
TEST(CgalMapBytes, GrowWithTheMesh) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the C library counts nothing of AddressSanitizer's heap";
#endif
  const std::size_t few = cgal_map_bytes(kuhn_grid(4, 4, 4, 1.0)), many = cgal_map_bytes(kuhn_grid(8, 8, 8, 1.0));
  EXPECT_GT(few, 384u * 24 * 4 * sizeof(void*));
  EXPECT_GT(many, 7 * few);
  EXPECT_LT(many, 9 * few);
}

}  // namespace
}  // namespace dartboard::cgal_topology_tasks_test
