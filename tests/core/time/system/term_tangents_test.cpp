#include "core/time/system/term_tangents.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/eigenvalues.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::term_tangents_test {
namespace {

using Eigen::Vector3d;

ElementBody box(Model model) { return ElementBody(kuhn_box(3, 2, 2, 0.1, 0.2, 7), model, 2e4, 0.3); }
std::vector<Vector3d> forces_of(const ElementBody& body) {
  std::vector<Vector3d> force(body.x.size(), Vector3d(0, 0, 0));
  body.term->add_forces({body.x}, force);
  return force;
}
BlockMatrix stiffness_of(const ElementBody& body, TermTangents::Kind kind) {
  BlockMatrix stiffness;
  stiffness.pattern = node_pattern_of(body.system());
  stiffness_of_terms(body.system(), {{body.x}, kind}, stiffness);
  return stiffness;
}
Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  const auto n = static_cast<Eigen::Index>(3 * matrix.node_count());
  Eigen::MatrixXd result(n, n);
  std::vector<Vector3d> unit(matrix.node_count(), Vector3d(0, 0, 0)), column(matrix.node_count());
  for (Eigen::Index k = 0; k < n; ++k) {
    unit[static_cast<std::size_t>(k / 3)][k % 3] = 1.0;
    matrix.multiply(unit, column);
    unit[static_cast<std::size_t>(k / 3)][k % 3] = 0.0;
    result.col(k) = Eigen::Map<const Eigen::VectorXd>(column[0].data(), n);
  }
  return result;
}

// Central differences of forces, a step of 1e-7 of them: errors of its square and of rounding over it.
TEST(TermTangents, AreWhatForcesGrowBy) {
  for (const Model model : element_models) {
    ElementBody body = box(model);
    body.shake(0.01, 5);
    body.fixed[0] = 1;
    const BlockMatrix stiffness = stiffness_of(body, TermTangents::Kind::exact);
    std::vector<Vector3d> direction(body.x.size()), product(body.x.size());
    SplitMix64 random(6);
    for (std::size_t i = 0; i < direction.size(); ++i)
      for (double& c : direction[i]) c = body.fixed[i] ? 0.0 : random.next_signed();
    stiffness.multiply(direction, product);
    const double d = 1e-7;
    ElementBody up = box(model), down = box(model);
    for (std::size_t i = 0; i < direction.size(); ++i) {
      up.x[i] = body.x[i] + d * direction[i];
      down.x[i] = body.x[i] - d * direction[i];
    }
    const auto f_up = forces_of(up), f_down = forces_of(down);
    double largest = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < direction.size(); ++i) {
      if (body.fixed[i]) continue;
      largest = std::max(largest, product[i].norm());
      worst = std::max(worst, ((f_down[i] - f_up[i]) / (2 * d) - product[i]).norm());
    }
    EXPECT_LE(worst, 1e-6 * largest) << name(model);
  }
}

// Of a state far from rest: exact tangents are indefinite there, projected ones are not.
TEST(TermTangents, AreSymmetricAndProjectedWithoutNegativeEigenvalues) {
  for (const Model model : element_models) {
    ElementBody body = box(model);
    body.shake(0.03, 9);
    for (Vector3d& x : body.x) x *= 0.6;
    body.fixed[3] = 1;
    const Eigen::MatrixXd exact = dense(stiffness_of(body, TermTangents::Kind::exact)),
                          projected = dense(stiffness_of(body, TermTangents::Kind::projected));
    EXPECT_LE((exact - exact.transpose()).norm(), 1e-12 * exact.norm()) << name(model);
    const auto least = [](const Eigen::MatrixXd& m) {
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly).eigenvalues()[0];
    };
    EXPECT_LT(least(exact), -1e-3 * exact.norm()) << name(model);
    EXPECT_GE(least(projected), -1e-12 * projected.norm()) << name(model);
    // fixed vertices are coupled with none
    EXPECT_EQ(projected.middleCols(9, 3).norm(), 0.0);
    EXPECT_EQ(projected.middleRows(9, 3).norm(), 0.0);
  }
}

// A local-global step relies on the constant matrix: it is no softer than the body at rest.
TEST(TermTangents, OfTheConstantKindAreAtLeastAsStiffAsABodyAtRest) {
  for (const Model model : element_models) {
    const ElementBody body = box(model);
    const Eigen::MatrixXd difference =
        dense(stiffness_of(body, TermTangents::Kind::constant)) - dense(stiffness_of(body, TermTangents::Kind::exact));
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(difference, Eigen::EigenvaluesOnly).eigenvalues()[0],
              -1e-12 * difference.norm())
        << name(model);
  }
}

TEST(TermTangents, HaveNoEigenvalueAboveTheirLargestRow) {
  for (const Model model : element_models) {
    ElementBody body = box(model);
    body.shake(0.01, 4);
    body.fixed[0] = 1;
    const BlockMatrix stiffness = stiffness_of(body, TermTangents::Kind::projected);
    Eigen::MatrixXd scaled = dense(stiffness);
    for (Eigen::Index i = 0; i < scaled.rows(); ++i)
      for (Eigen::Index j = 0; j < scaled.cols(); ++j)
        scaled(i, j) *= std::sqrt(body.inverse_mass[static_cast<std::size_t>(i / 3)] *
                                  body.inverse_mass[static_cast<std::size_t>(j / 3)]);
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    EXPECT_GE(largest_row_sum(body.system(), stiffness), largest);
    EXPECT_LE(largest_row_sum(body.system(), stiffness), 3.0 * largest);
  }
}

// A system of terms alone, of springs alone and of both: forces and energies add up.
TEST(TermsOfASystem, ActBesideItsSprings) {
  ElementBody body = box(Model::neo_hookean);
  body.shake(0.01, 5);
  std::vector<SpringEnds> ends{{0, 1}};
  std::vector<UndampedSpring> springs{{0.05, 300.0}};
  SpringSystem both = body.system(), alone = both, none = both;
  both.ends = alone.ends = ends;
  both.springs = alone.springs = springs;
  alone.terms = {};
  none.terms = {};
  std::vector<Vector3d> a(body.x.size()), b(body.x.size()), c(body.x.size());
  accelerations(both, {}, body.x, body.v, a);
  accelerations(alone, {}, body.x, body.v, b);
  accelerations(body.system(), {}, body.x, body.v, c);
  const std::vector<Vector3d> force = forces_of(body);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE((a[i] - b[i] - c[i]).norm(), 1e-13 * (1.0 + c[i].norm()));
    EXPECT_LE((body.mass[i] * c[i] - force[i]).norm(), 1e-13 * (1.0 + force[i].norm()));
  }
  EXPECT_EQ(elastic_energy(body.system(), body.x), body.term->energy(body.x));
  EXPECT_NEAR(elastic_energy(both, body.x), elastic_energy(alone, body.x) + elastic_energy(body.system(), body.x),
              1e-12);
  EXPECT_EQ(elastic_energy(none, body.x), 0.0);
  // nor is a pair that a spring and an element share two entries
  EXPECT_TRUE(node_pattern_of(both).same_entries(node_pattern_of(body.system())));
}

}  // namespace
}  // namespace dartboard::term_tangents_test
