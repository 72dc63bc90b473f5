// Lanczos' highest frequency compared with closed forms and all eigenvalues, and refusals of its proof.

#include "validation/stability/frequency_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/eigenvalues.h"
#include "reference/closed_form.h"

namespace dartboard::frequency_oracle_test {
namespace {

TEST(FrequencyOracle, IsThatOfTheChainInClosedForm) {
  const FastestMode mode = fastest_mode(extreme_body("chain"));
  EXPECT_TRUE(mode.proven);
  EXPECT_NEAR(mode.omega, reference::chain_omega_fixed(12, 100.0, 1.0, 12), mode.error + 1e-12);
  // neighbours move against each other
  for (std::size_t i = 1; i + 2 < mode.shape.size(); ++i)
    EXPECT_LT(mode.shape[i].x() * mode.shape[i + 1].x(), 0.0) << i;
}

TEST(FrequencyOracle, IsTheLargestOfAllEigenvalues) {
  for (const char* name : {"box", "sheet"}) {
    const SpringColumns body = extreme_body(name);
    const Eigen::SparseMatrix<double> a = scaled_stiffness(body);
    const LargestEigenvalue largest = largest_eigenvalue(a);
    const double all = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(a), Eigen::EigenvaluesOnly)
                           .eigenvalues()
                           .maxCoeff();
    EXPECT_TRUE(largest.proven) << name;
    EXPECT_NEAR(largest.value, all, largest.residual + 1e-12 * all) << name;
    EXPECT_LE(largest.residual, 1e-9 * all) << name;
  }
}

TEST(FrequencyOracle, ProvesNothingOfAMatrixWhoseLargestEigenvalueTheStartMisses) {
  // two equal blocks make every eigenvalue double, which is no problem for Lanczos; NaN is no proof
  Eigen::SparseMatrix<double> a(2, 2);
  a.insert(0, 0) = 1.0;
  a.insert(1, 1) = std::nan("");
  EXPECT_FALSE(largest_eigenvalue(a).proven);
}

// One eigenvalue far above 299 others: every step of Lanczos makes the residual a hundred times smaller.
TEST(FrequencyOracle, StopsWhereTheResidualIsSmallEnough) {
  Eigen::SparseMatrix<double> a(300, 300);
  for (int i = 0; i < 300; ++i) a.insert(i, i) = i == 0 ? 100.0 : 0.01 * i;
  const LargestEigenvalue largest = largest_eigenvalue(a);
  EXPECT_TRUE(largest.proven);
  EXPECT_NEAR(largest.value, 100.0, 1e-7);
  EXPECT_LE(largest.steps, 20);
}

TEST(FrequencyOracle, LeavesFixedVerticesOut) {
  SpringColumns body = extreme_body("oscillator");
  const FastestMode mode = fastest_mode(body);
  EXPECT_NEAR(mode.omega, 10.0, 1e-9);
  EXPECT_EQ(mode.shape[0], Eigen::Vector3d(0, 0, 0));
}

}  // namespace
}  // namespace dartboard::frequency_oracle_test
