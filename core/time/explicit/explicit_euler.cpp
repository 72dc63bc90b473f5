#include "core/time/explicit/explicit_euler.h"

namespace dartboard {
namespace {

Eigen::MatrixXd amplification(double theta, double zeta) {
  return Eigen::Matrix2d::Identity() + test_oscillator(theta, zeta);
}

const Scheme explicit_euler{
    .name = "explicit-euler",
    .what = "explicit Euler; unstable without damping",
    .order = 1,
    .stages = 1,
    .imaginary_limit = 0.0,
    .amplification = amplification,
    .source = "Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section I.7",
};

}  // namespace

const Scheme& ExplicitEuler::scheme() const { return explicit_euler; }

StepResult ExplicitEuler::step(const SpringSystem& system, Motion motion, double h) {
  end_.resize(motion.x.size());
  accelerations(system, terms_.of(system), motion.x, motion.v, end_.v);
  ++work_.force_evaluations;
  for (std::size_t i = 0; i < end_.x.size(); ++i) {
    end_.x[i] = motion.x[i] + h * motion.v[i];
    end_.v[i] = motion.v[i] + h * end_.v[i];
  }
  return end_.commit(motion, work_);
}

}  // namespace dartboard
