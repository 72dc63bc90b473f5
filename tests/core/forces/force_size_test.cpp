#include "core/forces/force_size.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::force_size_test {
namespace {

/// The largest bound [N] in a cube of edge 1 m that is as thin as this, at rest.
double largest_size(const Mesh& cube, double thickness) {
  Mesh mesh = cube;
  for (Eigen::Vector3d& p : mesh.points) p.z() *= thickness;
  const Material material{.density = 1.0, .young = 100.0, .poisson = 0.3, .model = Model::neo_hookean};
  std::vector<TetrahedronNodes> tetrahedra;
  std::vector<RestShape> shapes;
  std::vector<double> mass;
  std::vector<SolidNodes> solids;
  std::vector<SolidShape> solid_shapes;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    std::vector<Eigen::Vector3d> x;
    for (const std::uint32_t k : nodes) x.push_back(mesh.points[k]);
    if (nodes.size() == 4) {
      tetrahedra.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
      shapes.push_back(rest_shape_of(x[0], x[1], x[2], x[3]));
      mass.push_back(signed_measure(mesh, c));
    } else {
      SolidNodes& solid = solids.emplace_back();
      solid.count = static_cast<std::uint32_t>(nodes.size());
      std::ranges::copy(nodes, solid.at.begin());
      solid_shapes.push_back(solid_shape_of(mesh.kinds[c], x));
    }
  }
  const auto term = tetrahedra.empty() ? make_solids(material, {solids, solid_shapes})
                                       : make_tetrahedra(material, {tetrahedra, shapes, mass});
  std::vector<double> size(mesh.points.size(), 0.0);
  term->add_force_sizes({mesh.points}, size);
  return *std::ranges::max_element(size);
}

// A corner's area stays, and its lines of 1 m times gradients of 1 over the thickness are summed to a gradient of 1.
TEST(ForceSizes, GrowAsTheGradientsOfThinElementsAndNotAsTheirCubes) {
  for (const Mesh& cube : {kuhn_box(1, 1, 1, 1.0), hexahedron_box(1, 1, 1, 1.0)}) {
    const double ratio = largest_size(cube, 1e-6) / largest_size(cube, 1e-3);
    EXPECT_NEAR(ratio, 1e3, 10.0) << cube.cell_count();
  }
}

TEST(ForceSizes, GrowWithTheSquareOfFourTimesTheGradientUpToThatOfItsSummands) {
  EXPECT_DOUBLE_EQ(stress_size(7.0, 100.0, 2.0) / stress_size(7.0, 100.0, 1.0), 65.0 / 17.0);
  EXPECT_DOUBLE_EQ(stress_size(7.0, 2.0, 1.0), 7.0 * 3.0 * 5.0);
  EXPECT_DOUBLE_EQ(stress_size(7.0, 2.0, 10.0), 7.0 * 3.0 * 5.0);
}

}  // namespace
}  // namespace dartboard::force_size_test
