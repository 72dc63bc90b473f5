#include "core/time/method/splitting.h"

#include <array>

namespace dartboard {
namespace {

constexpr double a1 = 0.0792036964311957, a2 = 0.353172906049774, a3 = -0.0420650803577195;
constexpr double a4 = 1.0 - 2.0 * (a1 + a2 + a3);
constexpr double b1 = 0.209515106613362, b2 = -0.143851773179818;
constexpr double b3 = 0.5 - (b1 + b2);
constexpr std::array blanes_moan_drifts{a1, a2, a3, a4, a3, a2};
constexpr std::array blanes_moan_kicks{b1, b2, b3, b3, b2, b1};

constexpr std::array verlet_drifts{0.5};
constexpr std::array verlet_kicks{1.0};

}  // namespace

const Splitting& verlet_splitting() {
  static const Splitting splitting{verlet_drifts, verlet_kicks, 0.5};
  return splitting;
}

const Splitting& blanes_moan_4_splitting() {
  static const Splitting splitting{blanes_moan_drifts, blanes_moan_kicks, a1};
  return splitting;
}

Eigen::MatrixXd splitting_amplification(const Splitting& splitting, double theta, double zeta) {
  Eigen::Matrix2d product = Eigen::Matrix2d::Identity();
  const auto drift = [&](double a) {
    Eigen::Matrix2d m;
    m << 1.0, a * theta, 0.0, 1.0;
    product = m * product;
  };
  for (std::size_t k = 0; k < splitting.kicks.size(); ++k) {
    drift(splitting.drifts[k]);
    const double t = splitting.kicks[k] * theta, z = 2.0 * zeta * t;
    const double reach = t * (1.0 - z / 2 + z * z / 6 - z * z * z / 24);
    Eigen::Matrix2d m;
    m << 1.0, 0.0, -reach, 1.0 - 2.0 * zeta * reach;
    product = m * product;
  }
  drift(splitting.last_drift);
  return product;
}

}  // namespace dartboard
