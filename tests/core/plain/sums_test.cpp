// The settings of Eigen that every source sees (core/cmake/DartboardOptions.cmake): sums are in the order of their
// terms.

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace dartboard::sums_test {
namespace {

// 1 and many numbers that it loses one by one, but not two at a time.
constexpr double small = 0x1p-53;
static_assert(1.0 + small == 1.0 && 1.0 + 2 * small > 1.0);

constexpr double root = 0x1.4p-27;  // its square is less than `small`, and twice that is more
static_assert(root * root < small && 2 * root * root > small);

template <int count>
Eigen::Matrix<double, count, 1> one_and(double others, int size = count) {
  auto terms = Eigen::Matrix<double, count, 1>::Constant(size, others).eval();
  terms[0] = 1.0;
  return terms;
}

template <int count>
void expect_order() {
  const auto terms = one_and<count>(small);
  EXPECT_EQ(terms.sum(), 1.0) << count;
  EXPECT_EQ(terms.dot(terms.Ones()), 1.0) << count;
  EXPECT_EQ(one_and<count>(root).squaredNorm(), 1.0) << count;
}

TEST(Sums, AreInTheOrderOfTheirTermsForEverySmallSize) {
  expect_order<3>();
  expect_order<4>();
  expect_order<6>();
  expect_order<8>();
  expect_order<9>();
  expect_order<24>();
}

TEST(Sums, AreInTheOrderOfTheirTermsForAnySizeInMemory) {
  for (const int size : {3, 4, 5, 8, 16, 101}) {
    const Eigen::VectorXd terms = one_and<Eigen::Dynamic>(small, size), ones = Eigen::VectorXd::Ones(size);
    EXPECT_EQ(terms.sum(), 1.0) << size;
    EXPECT_EQ(terms.dot(ones), 1.0) << size;
  }
}

TEST(Sums, OfProductsOfMatricesAreInTheOrderOfTheColumnsInEveryRow) {
  const Eigen::Vector3d terms = one_and<3>(small), ones = Eigen::Vector3d::Ones();
  const Eigen::Matrix3d rows = ones * terms.transpose();
  EXPECT_EQ(rows * ones, ones);
  EXPECT_EQ(rows.transpose().eval().transpose() * ones, ones);
  EXPECT_EQ(rows * Eigen::Matrix3d::Ones(), Eigen::Matrix3d::Ones());
  EXPECT_EQ(Eigen::Matrix3d(terms.asDiagonal()).trace(), 1.0);
}

TEST(Sums, OverAMatrixGoDownItsColumns) {
  Eigen::Matrix3d terms = Eigen::Matrix3d::Constant(small);
  terms(0, 0) = 1.0;
  EXPECT_EQ(terms.sum(), 1.0);
  EXPECT_EQ(terms.cwiseProduct(Eigen::Matrix3d::Ones()).sum(), 1.0);
  terms.setConstant(small);
  terms(1, 0) = 1.0;  // small + 1 is 1, too
  terms(2, 0) = -1.0;
  EXPECT_EQ(terms.sum(), 6 * small);
}

}  // namespace
}  // namespace dartboard::sums_test
