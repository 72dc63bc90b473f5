#pragma once
// Questions on a clamped bar: where it bends to, its frequencies, and its motion once it is released.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "validation/elements/clamped_bar.h"

namespace dartboard {

/// Positions of the watched corners [m] relative to rest, at checkpoints: a column each, three rows a corner.
using WatchedMotion = Eigen::MatrixXd;

/// The checkpoints of one period: `count` of them, the last at its end.
struct Beats {
  double period = 0.0;  // [s]
  static constexpr int count = 16;
  double at(int k) const { return period * (k + 1) / count; }
};

/// Linear answers near rest.
struct BarAnswers {
  std::size_t nodes = 0;
  double work = 0.0;                  // [J] done by a shear traction of 1 Pa on the free end
  std::array<double, 6> frequency{};  // [1/s] the lowest
  double confined = 0.0;              // [Pa]
  Eigen::VectorXd bent;               // [m] displacements under that traction, by node
  WatchedMotion motion;               // released from there; at the beats of `truth`
};

/// By quadratic elements, whose lowest frequency defines the period; the modulus is that of the material.
BarAnswers true_answers(const ClampedBar& bar, int finer, double poisson, Beats& beats);
/// By a model, as it is simulated, but with exact integration in time.
BarAnswers model_answers(const ClampedBar& bar, const BarModel& model, int finer, const SimulatedBody& body,
                         const Beats& beats);

/// The errors of a model: shares of the true values, above 0.
struct BarErrors {
  double tip = 0.0, frequencies = 0.0, confined = 0.0, motion = 0.0;
  std::size_t worst_frequency = 0;  // which of the six is furthest off
};
BarErrors errors_of(const BarAnswers& answers, const BarAnswers& truth);

/// The distance of two motions: the root mean square over the corners, at the time when it is largest, as a share of
/// the largest of `truth`.
double motion_error(const WatchedMotion& motion, const WatchedMotion& truth);

}  // namespace dartboard
