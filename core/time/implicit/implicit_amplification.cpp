#include "core/time/implicit/implicit_amplification.h"

#include <Eigen/LU>
#include <cmath>

#include "core/time/method/scheme.h"

namespace dartboard {
namespace {

const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();

}  // namespace

Eigen::MatrixXd backward_euler_amplification(double theta, double zeta) {
  return Eigen::Matrix2d(I - test_oscillator(theta, zeta)).inverse();
}

Eigen::MatrixXd midpoint_amplification(double theta, double zeta) {
  const Eigen::Matrix2d half = 0.5 * test_oscillator(theta, zeta);
  return Eigen::Matrix2d(I - half).inverse() * (I + half);
}

Eigen::MatrixXd two_stage_amplification(double theta, double zeta) {
  const double gamma = 1.0 - 1.0 / std::sqrt(2.0);
  const Eigen::Matrix2d z = test_oscillator(theta, zeta);
  const Eigen::Matrix2d inverse = Eigen::Matrix2d(I - gamma * z).inverse();
  return (I + (1.0 - 2.0 * gamma) * z) * inverse * inverse;
}

Eigen::MatrixXd bdf2_amplification(double theta, double zeta) {
  const Eigen::Matrix2d inverse = Eigen::Matrix2d(I - (2.0 / 3.0) * test_oscillator(theta, zeta)).inverse();
  Eigen::Matrix4d result;
  result << (4.0 / 3.0) * inverse, (-1.0 / 3.0) * inverse, I, Eigen::Matrix2d::Zero();
  return result;
}

}  // namespace dartboard
