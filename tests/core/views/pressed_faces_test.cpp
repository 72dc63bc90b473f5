// Faces under pressure: the forces at their corners, and the vertices that those are whatever happens to the map.

#include "core/views/pressed_faces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/archive.h"
#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/random_operations.h"

namespace dartboard::pressed_faces_test {
namespace {

using Eigen::Vector3d;

template <class Map>
Mesh mesh_of() {
  if constexpr (Map::dimension == 2) return quadrilateral_grid(5, 4);
  if constexpr (std::is_same_v<Map, Map3>) return mixed_box(3, 2, 2, 0.5);
  return kuhn_grid(3, 2, 2, 0.25, 0.1, 3);
}

Mesh displaced(Mesh mesh, std::uint64_t seed) {
  SplitMix64 random(seed);
  for (Vector3d& x : mesh.points)
    for (double& c : x) c += 0.2 * random.next_signed();
  return mesh;
}

// x = sum N_a x_a over the unit square: 2 x 2 Gauss points are exact for the shape function times the normal.
TEST(PressedFaces, OfFourCornersShareAPressureAsBilinearShapeFunctionsDo) {
  const std::array<Vector3d, 4> x{Vector3d(0, 0, 0), Vector3d(2, 0.5, -1), Vector3d(1.5, 3, 0.5), Vector3d(-1, 1, 2)};
  std::array<Vector3d, 4> expected;
  expected.fill(Vector3d(0, 0, 0));
  for (const double u : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)})
    for (const double v : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
      const Vector3d along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
      const Vector3d along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
      const double shape[] = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
      for (std::size_t a = 0; a < 4; ++a) expected[a] -= 7.0 / 4 * shape[a] * along_u.cross(along_v);
    }
  const auto force = forces_of_pressure(7.0, 4, x);
  for (std::size_t a = 0; a < 4; ++a) EXPECT_LE((force[a] - expected[a]).norm(), 1e-14) << a;
}

TEST(PressedFaces, AllRoundABodyHaveNeitherASumNorAMoment) {
  for (const Mesh& mesh : {displaced(mixed_box(3, 2, 2, 0.5), 1), displaced(kuhn_grid(2, 2, 2, 0.5), 2)}) {
    Vector3d sum(0, 0, 0), moment(0, 0, 0);
    double sizes = 0.0;
    for (const PressedFace& face : outer_faces(mesh)) {
      std::array<Vector3d, 4> x;
      for (std::uint32_t k = 0; k < face.count; ++k) x[k] = mesh.points[face.corner[k]];
      const auto force = forces_of_pressure(3.0, face.count, x);
      for (std::uint32_t k = 0; k < face.count; ++k) {
        sum += force[k];
        moment += x[k].cross(force[k]);
        sizes += force[k].norm();
      }
    }
    EXPECT_GT(sizes, 10.0);
    EXPECT_LE(sum.norm(), 1e-15 * sizes);
    EXPECT_LE(moment.norm(), 3e-15 * sizes);
  }
}

template <class Map>
struct PressedBody {
  AdaptedBody<Map> body;
  std::vector<PressedFace> faces;
  std::vector<std::uint32_t> mesh_cell;
  PressedFacesView view;

  explicit PressedBody(const Mesh& mesh) : body(body_of<Map>(mesh)) {
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) mesh_cell.push_back(c);
    // two thirds of all faces, not in the order of their cells
    const auto all = outer_faces(mesh);
    for (std::size_t k = all.size(); k-- > 0;)
      if (k % 3 != 0) faces.push_back(all[k]);
    view = rebuilt();
  }
  PressedBody(const PressedBody&) = delete;

  PressedFacesView rebuilt() const {
    PressedFacesView made(faces, [this](std::uint32_t c) { return mesh_cell[c]; });
    made.rebuild(body);
    return made;
  }
  void follow(const ChangedEmbeddings& changed) {
    changed.move_cells(mesh_cell);
    view.apply(body, changed);
  }
  /// All faces by the cells that are left, with their vertices by the points of the mesh.
  std::size_t expect_rows() const {
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> vertex_of;  // by cell of the mesh, by point
    for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c)
      for_each_dart_of(body.map, Cell<Map::dimension>{body.cell_dart[c]}, [&](Dart d) {
        const std::uint32_t k = body.vertex(body.map, d);
        vertex_of[mesh_cell[c]][body.vertices.point[k]] = k;
      });
    std::vector<std::vector<std::uint32_t>> expected, found;  // of each face its cell and its vertices
    for (const PressedFace& face : faces) {
      if (!vertex_of.contains(face.cell)) continue;
      expected.push_back({face.cell});
      for (const std::uint32_t p : face.corners()) expected.back().push_back(vertex_of.at(face.cell).at(p));
    }
    for (const PressedFace& row : view.rows) {
      found.push_back({row.cell});
      found.back().insert(found.back().end(), row.corners().begin(), row.corners().end());
    }
    std::ranges::sort(expected);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
    return found.size();
  }
};

template <class Map>
struct PressedFacesOf : testing::Test {};
using Maps = testing::Types<Map2, Map3, TetMap>;
TYPED_TEST_SUITE(PressedFacesOf, Maps);

TYPED_TEST(PressedFacesOf, ABodyStayAtTheirCellsThroughRandomOperationsUntilNothingIsLeft) {
  PressedBody<TypeParam> pressed(mesh_of<TypeParam>());
  ASSERT_EQ(pressed.expect_rows(), pressed.faces.size());
  int operations = 0;
  operate_at_random(pressed.body, 1, 40, [&](const auto&, const TopologyChange&, const ChangedEmbeddings& changed) {
    pressed.follow(changed);
    ASSERT_EQ(pressed.view, pressed.rebuilt()) << operations;
    pressed.expect_rows();
    ++operations;
  });
  EXPECT_GT(operations, 60);
  EXPECT_EQ(pressed.expect_rows(), 0u);
}

TYPED_TEST(PressedFacesOf, ABodyAreKeptInACheckpoint) {
  PressedBody<TypeParam> a(mesh_of<TypeParam>()), b(mesh_of<TypeParam>());
  SplitMix64 random(2);
  for (int k = 0; k < 8; ++k) a.follow(adapt(a.body, do_something(a.body.map, random)));
  ASSERT_NE(a.view, b.view);
  Archive written;
  a.view.state(written);
  Archive read(written.written(), "file");
  b.view.state(read);
  read.require_end();
  EXPECT_EQ(b.view, a.view);
}

}  // namespace
}  // namespace dartboard::pressed_faces_test
