// Meshes that are cut finer: the same body, conforming, of cells that are not turned inside out.

#include "benchmarks/studies/step/finer_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"

namespace dartboard::finer_mesh_test {
namespace {

double volume_of(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) sum += signed_measure(mesh, c);
  return sum;
}

std::size_t edge_count(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const std::uint32_t a : mesh.cell(c))
      for (const std::uint32_t b : mesh.cell(c))
        if (a < b) edges.emplace(a, b);
  return edges.size();
}

/// The faces of one cell only.
std::size_t boundary_face_count(const Mesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, int> cells;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto n = mesh.cell(c);
      std::array<std::uint32_t, 3> face{n[(k + 1) % 4], n[(k + 2) % 4], n[(k + 3) % 4]};
      std::ranges::sort(face);
      ++cells[face];
    }
  EXPECT_TRUE(std::ranges::all_of(cells, [](const auto& face) { return face.second <= 2; }));
  return static_cast<std::size_t>(std::ranges::count(cells, 1, [](const auto& face) { return face.second; }));
}

TEST(FinerMesh, IsTheSameBodyInEightTimesAsManyCells) {
  for (const Mesh& mesh : {kuhn_box(1, 2, 2, 0.5), tetrahedron_ball(2, 0.5)}) {
    const Mesh finer = finer_mesh(mesh);
    EXPECT_EQ(finer.cell_count(), 8 * mesh.cell_count());
    EXPECT_EQ(finer.points.size(), mesh.points.size() + edge_count(mesh));
    EXPECT_EQ(boundary_face_count(finer), 4 * boundary_face_count(mesh));
    EXPECT_NEAR(volume_of(finer), volume_of(mesh), 1e-14 * volume_of(mesh));
    for (std::size_t c = 0; c < finer.cell_count(); ++c)
      EXPECT_NEAR(signed_measure(finer, c), signed_measure(mesh, c / 8) / 8, 1e-15 * volume_of(mesh)) << c;
    EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), finer.points.begin()));
  }
}

TEST(FinerMesh, IsCutUntilItHasSoManyCells) {
  const Mesh mesh = kuhn_box(1, 1, 1, 1.0);
  EXPECT_EQ(finer_mesh_of(mesh, 6).cell_count(), 6u);
  EXPECT_EQ(finer_mesh_of(mesh, 7).cell_count(), 48u);
  EXPECT_EQ(finer_mesh_of(mesh, 49).cell_count(), 384u);
}

TEST(FinerMesh, IsOfTetrahedraAlone) {
  const Mesh hexahedra = hexahedron_box(1, 1, 1, 1.0);
  EXPECT_THROW(finer_mesh(hexahedra), InputError);
}

}  // namespace
}  // namespace dartboard::finer_mesh_test
