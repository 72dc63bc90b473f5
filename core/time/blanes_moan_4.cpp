#include "core/time/blanes_moan_4.h"

#include <array>
#include <utility>

namespace dartboard {
namespace {

// Drifts a1 b1 a2 b2 a3 b3 a4 b3 a3 b2 a2 b1 a1, in units of h; each column sums to 1.
constexpr double a1 = 0.0792036964311957, a2 = 0.353172906049774, a3 = -0.0420650803577195;
constexpr double a4 = 1.0 - 2.0 * (a1 + a2 + a3);
constexpr double b1 = 0.209515106613362, b2 = -0.143851773179818;
constexpr double b3 = 0.5 - (b1 + b2);
constexpr std::array drifts{a1, a2, a3, a4, a3, a2};  // each before its kick; the last drift is a1
constexpr std::array kicks{b1, b2, b3, b3, b2, b1};

Eigen::MatrixXd amplification(double theta, double zeta) {
  Eigen::Matrix2d product = Eigen::Matrix2d::Identity();
  const auto drift = [&](double a) {
    Eigen::Matrix2d m;
    m << 1.0, a * theta, 0.0, 1.0;
    product = m * product;
  };
  for (std::size_t k = 0; k < kicks.size(); ++k) {
    drift(drifts[k]);
    const double t = kicks[k] * theta, z = 2.0 * zeta * t;
    const double reach = t * (1.0 - z / 2 + z * z / 6 - z * z * z / 24);
    Eigen::Matrix2d m;
    m << 1.0, 0.0, -reach, 1.0 - 2.0 * zeta * reach;
    product = m * product;
  }
  drift(a1);
  return product;
}

const Scheme blanes_moan_4{
    .name = "blanes-moan-4",
    .what = "six-stage symplectic splitting of order 4",
    .order = 4,
    .stages = 6,
    .symplectic = true,
    .symmetric = true,
    .keeps_angular = true,
    .imaginary_limit = 3.1329,
    .amplification = amplification,
    .source = "Blanes, Moan: Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom methods, 2002, S6",
};

void axpy(double t, const std::vector<Eigen::Vector3d>& direction, std::vector<Eigen::Vector3d>& y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += t * direction[i];
}

}  // namespace

const Scheme& BlanesMoan4::scheme() const { return blanes_moan_4; }

// v += t (1 - z/2 (1 - z/3 (1 - z/4))) (a - B v), the powers of B one after the other in a_ and product_.
void BlanesMoan4::damped_kick(const SpringSystem& system, const Terms& terms, double t) {
  damping_.apply(system, terms, end_.v, product_);
  axpy(-1.0, product_, a_);
  axpy(t, a_, end_.v);
  double weight = t;
  for (const double divisor : {2.0, 3.0, 4.0}) {
    damping_.apply(system, terms, a_, product_);
    std::swap(a_, product_);
    weight *= -t / divisor;
    axpy(weight, a_, end_.v);
  }
  work_.damping_sweeps += 4;
}

StepResult BlanesMoan4::step(const SpringSystem& system, Motion motion, double h) {
  const Terms terms = terms_.of(system);
  const bool damped = terms.damping || terms.viscosity;
  const std::size_t n = motion.x.size();
  end_.resize(n);
  a_.resize(n);
  if (damped) product_.resize(n);
  end_.x.assign(motion.x.begin(), motion.x.end());
  end_.v.assign(motion.v.begin(), motion.v.end());
  for (std::size_t k = 0; k < kicks.size(); ++k) {
    axpy(drifts[k] * h, end_.v, end_.x);
    accelerations(system, {.fixed = terms.fixed}, end_.x, end_.v, a_);
    ++work_.force_evaluations;
    if (damped) {
      damping_.freeze(system, terms, end_.x);
      damped_kick(system, terms, kicks[k] * h);
    } else {
      axpy(kicks[k] * h, a_, end_.v);
    }
  }
  axpy(a1 * h, end_.v, end_.x);
  return end_.commit(motion, work_);
}

}  // namespace dartboard
