// The witnesses of elements compared with scikit-fem, whose numbers are committed.

#include "tests/support/reference_values_for_tests.h"

#include <gtest/gtest.h>

#include "reference/elements/elastic_point.h"
#include "reference/elements/quadratic_solid.h"

namespace dartboard::reference::reference_values_test {
namespace {

Eigen::MatrixXd stiffness_of_points(const ElementValues& values, Model model) {
  Material material = values.material;
  material.model = model;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(values.stiffness.rows(), values.stiffness.cols());
  for (const ElasticPoint& point : elastic_points(values.mesh, 0, material)) {
    const StressSlope slope = stress_slope(point.law, Matrix3<long double>::Identity());
    for (std::size_t a = 0; a < point.corner.size(); ++a)
      for (std::size_t b = 0; b < point.corner.size(); ++b)
        k.block<3, 3>(3 * point.corner[a], 3 * point.corner[b]) += stiffness_block(point, slope, a, b).cast<double>();
  }
  return k;
}

TEST(WitnessElements, HaveTheStiffnessThatAnotherCodeHas) {
  const ElementValues tetrahedron = element_values("linear tetrahedron", CellKind::tetrahedron),
                      hexahedron = element_values("hexahedron", CellKind::hexahedron);
  for (const Model model : {Model::neo_hookean, Model::corotational, Model::stvk})
    for (const ElementValues* values : {&tetrahedron, &hexahedron})
      expect_same_matrix(stiffness_of_points(*values, model), values->stiffness, name(model));
}

TEST(WitnessElements, OfTenNodesHaveTheMatricesThatAnotherCodeHas) {
  const ElementValues values = element_values("quadratic tetrahedron", CellKind::tetrahedron);
  const QuadraticSolid solid(values.mesh, {values.material.young, values.material.poisson, values.material.density});
  ASSERT_EQ(solid.nodes().size(), values.nodes.size());
  // both have middles of edges, in orders of their own
  std::vector<Eigen::Index> theirs;
  for (const Eigen::Vector3d& node : solid.nodes())
    for (std::size_t i = 0; i < values.nodes.size(); ++i)
      if ((node - values.nodes[i]).norm() < 1e-12)
        for (Eigen::Index c = 0; c < 3; ++c) theirs.push_back(3 * static_cast<Eigen::Index>(i) + c);
  ASSERT_EQ(theirs.size(), 30u);
  expect_same_matrix(solid.stiffness(), values.stiffness(theirs, theirs), "stiffness");
  expect_same_matrix(solid.mass(), values.mass(theirs, theirs), "mass");
}

}  // namespace
}  // namespace dartboard::reference::reference_values_test
