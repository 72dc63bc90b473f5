#pragma once
// What is asked of a clamped bar: where it bends to, how it rings, and how it moves once it is let go of.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "validation/elements/clamped_bar.h"

namespace dartboard {

/// Places of the watched corners [m] from where they are at rest, at checkpoints: a column each, three rows a corner.
using WatchedMotion = Eigen::MatrixXd;

/// The beats of one period: it is looked at `count` times, last at its end.
struct Beats {
  double period = 0.0;  // [s]
  static constexpr int count = 16;
  double at(int k) const { return period * (k + 1) / count; }
};

/// Linear answers near rest.
struct BarAnswers {
  std::size_t nodes = 0;
  double work = 0.0;                  // [J] of a shear traction of 1 Pa on the free end, as its displacements do it
  std::array<double, 6> frequency{};  // [1/s] the lowest
  double confined = 0.0;              // [Pa]
  Eigen::VectorXd bent;               // [m] displacements under that traction, by node
  WatchedMotion motion;               // let go of from there; at the beats of `truth`
};

/// By quadratic elements, whose lowest frequency says how long a period is; its modulus is that of the material.
BarAnswers true_answers(const ClampedBar& bar, int finer, double poisson, Beats& beats);
/// By a model, as it is simulated, with time that takes no steps.
BarAnswers model_answers(const ClampedBar& bar, const BarModel& model, int finer, const SimulatedBody& body,
                         const Beats& beats);

/// How far a model is from the truth: shares of it, above 0.
struct BarErrors {
  double tip = 0.0, frequencies = 0.0, confined = 0.0, motion = 0.0;
  std::size_t worst_frequency = 0;  // which of the six is furthest off
};
BarErrors errors_of(const BarAnswers& answers, const BarAnswers& truth);

/// How far two motions are apart: the root mean square over the corners, where it is largest over time, as a share of
/// the largest of `truth`.
double motion_error(const WatchedMotion& motion, const WatchedMotion& truth);

}  // namespace dartboard
