// Core's elements, and the beam with which all models are compared, against scikit-fem, whose numbers are committed.

#include "tests/support/reference_values_for_tests.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/body/simulated_body.h"
#include "validation/elements/cantilever.h"
#include "validation/statics/linearised.h"

namespace dartboard::reference_values_test {
namespace {

/// Matrices of a body of one cell as it is simulated, by the points of its mesh.
struct Simulated {
  Eigen::MatrixXd stiffness, mass;
  Simulated(const ElementValues& values, Model model) {
    Problem problem;
    problem.mesh = values.mesh;
    problem.material = values.material;
    problem.material.model = model;
    const auto body = make_simulated_body(problem, false);
    const reference::HeldSolid solid = linearised(body->system(), body->vertices().position);
    std::vector<Eigen::Index> at(static_cast<std::size_t>(values.stiffness.rows()));
    for (std::size_t k = 0; k < body->vertices().size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) at[3 * body->vertices().point[k] + c] = static_cast<Eigen::Index>(3 * k + c);
    stiffness = Eigen::MatrixXd(solid.stiffness)(at, at);
    mass = Eigen::MatrixXd(solid.mass)(at, at);
  }
};

// Near rest all laws are Hooke's.
TEST(CoresElements, HaveTheStiffnessThatAnotherCodeHas) {
  for (const auto& [what, kind] :
       {std::pair{"linear tetrahedron", CellKind::tetrahedron}, {"hexahedron", CellKind::hexahedron}}) {
    const ElementValues values = element_values(what, kind);
    for (const Model model : {Model::neo_hookean, Model::corotational, Model::stvk})
      expect_same_matrix(Simulated(values, model).stiffness, values.stiffness, what);
  }
}

// Core's masses are at the vertices, eq. (1): for a tetrahedron the sum of each row of the consistent mass, for a
// hexahedron the same in total.
TEST(CoresElements, HaveTheMassThatAnotherCodeHas) {
  const ElementValues tetrahedron = element_values("linear tetrahedron", CellKind::tetrahedron),
                      hexahedron = element_values("hexahedron", CellKind::hexahedron);
  const Eigen::MatrixXd ours = Simulated(tetrahedron, Model::neo_hookean).mass;
  expect_same_matrix(ours, tetrahedron.mass.rowwise().sum().asDiagonal().toDenseMatrix(), "tetrahedron");
  EXPECT_NEAR(Simulated(hexahedron, Model::neo_hookean).mass.sum() / hexahedron.mass.sum(), 1.0, 1e-12);
}

// The numbers printed in every report of `validate elements` are those of that code, to the printed digits.
TEST(PublishedCantilevers, AreThoseOfTheCommittedNumbers) {
  std::size_t found = 0;
  const nlohmann::json values = reference_values();
  for (const auto& beam : values.at("beam")) {
    if (beam.at("across") != 6) continue;
    for (const PublishedCantilever& published : published_cantilevers) {
      if (published.poisson != beam.at("poisson").get<double>()) continue;
      ++found;
      EXPECT_NEAR(published.work, beam.at("work"), 0.5e-9);
      const std::vector<double> omega = beam.at("frequencies");
      ASSERT_EQ(omega.size(), 6u);
      for (const auto& [ours, theirs] : {std::pair{published.first, omega[0]},
                                         {published.first, omega[1]},
                                         {published.torsion, omega[2]},
                                         {published.second, omega[3]},
                                         {published.second, omega[4]},
                                         {published.axial, omega[5]}})
        EXPECT_NEAR(ours, theirs, 0.5e-5);
    }
  }
  EXPECT_EQ(found, 3u);
}

// With quadratic tetrahedra twice as fine the beam is within a percent of that with 27-node hexahedra, six frequencies.
TEST(PublishedCantilevers, AreNearThoseOfQuadraticTetrahedra) {
  std::size_t found = 0;
  const nlohmann::json values = reference_values();
  for (const auto& beam : values.at("beam")) {
    if (beam.at("across") != 6 || beam.at("poisson") == 0.45) continue;
    ++found;
    const CantileverAnswers ours = quadratic_cantilever(3, beam.at("poisson"));
    EXPECT_NEAR(ours.work / beam.at("work").get<double>(), 1.0, 0.01);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(ours.frequency[k] / beam.at("frequencies").at(k).get<double>(), 1.0, 0.01) << k;
  }
  EXPECT_EQ(found, 2u);
}

}  // namespace
}  // namespace dartboard::reference_values_test
