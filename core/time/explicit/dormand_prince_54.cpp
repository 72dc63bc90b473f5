#include "core/time/explicit/dormand_prince_54.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// Row s holds the weights of stages 0 .. s for the next state: that of stage s + 1, and in the last row the end.
constexpr double weights[6][6] = {
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
// The difference of the solutions of orders 5 and 4.
constexpr double error_weights[7] = {71.0 / 57600,      0.0,          -71.0 / 16695, 71.0 / 1920,
                                     -17253.0 / 339200, 22.0 / 525.0, -1.0 / 40};

Eigen::MatrixXd amplification(double theta, double zeta) {
  const Eigen::Matrix2d z = test_oscillator(theta, zeta), one = Eigen::Matrix2d::Identity();
  return one + z * (one + z / 2.0 * (one + z / 3.0 * (one + z / 4.0 * (one + z / 5.0 * (one + z / 5.0)))));
}

const Scheme dormand_prince_54{
    .name = "dormand-prince-54",
    .what = "Dormand-Prince 5(4), adaptive",
    .order = 5,
    .stages = 6,
    .imaginary_limit = 0.997189,
    .amplification = amplification,
    .source =
        "Dormand, Prince: A family of embedded Runge-Kutta formulae, 1980; controller: Hairer, Norsett, Wanner: "
        "Solving Ordinary Differential Equations II, section IV.2",
};

// out = base + h sum of w_j rate_j, the sum in the order of the stages
template <std::size_t count>
void combine(std::span<const Vector3d> base, double h, const double* w,
             const std::array<std::vector<Vector3d>, 7>& rate, std::vector<Vector3d>& out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    Vector3d sum = w[0] * rate[0][i];
    for (std::size_t j = 1; j < count; ++j) sum += w[j] * rate[j][i];
    out[i] = base[i] + h * sum;
  }
}

template <std::size_t... s, class F>
void for_each_stage(std::index_sequence<s...>, F&& f) {
  (f(std::integral_constant<std::size_t, s>{}), ...);
}

}  // namespace

const Scheme& DormandPrince54::scheme() const { return dormand_prince_54; }

void DormandPrince54::restart() {
  terms_.forget();
  next_step_ = 0.0;
  last_error_ = 1.0;
}

std::size_t DormandPrince54::bytes() const {
  std::size_t sum = end_.bytes() + bytes_of(stage_x_) + terms_.bytes();
  for (const auto* columns : {&stage_v_, &stage_a_})
    for (const Column& column : *columns) sum += bytes_of(column);
  return sum;
}

void DormandPrince54::resize(std::size_t n) {
  end_.resize(n);
  stage_x_.resize(n);
  for (auto& column : stage_v_) column.resize(n);
  for (auto& column : stage_a_) column.resize(n);
}

void DormandPrince54::evaluate_first(const SpringSystem& system, Motion motion) {
  std::ranges::copy(motion.v, stage_v_[0].begin());
  accelerations(system, terms_.of(system), motion.x, motion.v, stage_a_[0]);
  ++work_.force_evaluations;
}

void DormandPrince54::evaluate_others(const SpringSystem& system, Motion motion, double h) {
  for_each_stage(std::make_index_sequence<5>{}, [&](auto s) {
    combine<s + 1>(motion.x, h, weights[s], stage_v_, stage_x_);
    combine<s + 1>(motion.v, h, weights[s], stage_a_, stage_v_[s + 1]);
    accelerations(system, terms_.of(system), stage_x_, stage_v_[s + 1], stage_a_[s + 1]);
  });
  work_.force_evaluations += 5;
  combine<6>(motion.x, h, weights[5], stage_v_, end_.x);
  combine<6>(motion.v, h, weights[5], stage_a_, end_.v);
}

double DormandPrince54::evaluate_error(const SpringSystem& system, double h, const Tolerance& tolerance) {
  stage_v_[6] = end_.v;
  accelerations(system, terms_.of(system), end_.x, end_.v, stage_a_[6]);
  ++work_.force_evaluations;
  double position = 0.0, velocity = 0.0;
  for (std::size_t i = 0; i < end_.x.size(); ++i) {
    Vector3d ex(0, 0, 0), ev(0, 0, 0);
    for (std::size_t j = 0; j < 7; ++j) {
      ex += error_weights[j] * stage_v_[j][i];
      ev += error_weights[j] * stage_a_[j][i];
    }
    position += ex.squaredNorm();
    velocity += ev.squaredNorm();
  }
  const auto n = static_cast<double>(end_.x.size());
  return std::sqrt(
      h * h / n *
      (position / (tolerance.position * tolerance.position) + velocity / (tolerance.velocity * tolerance.velocity)) /
      2);
}

StepResult DormandPrince54::step(const SpringSystem& system, Motion motion, double h) {
  resize(motion.x.size());
  evaluate_first(system, motion);
  evaluate_others(system, motion, h);
  return end_.commit(motion, work_);
}

// The controller sets h (err)^-0.17 (previous err)^0.04 after a step with err <= 1: Gustafsson's PI control with the
// exponents of DOPRI5. It may grow fivefold and shrink tenfold, and does not grow after a rejection.
StepResult DormandPrince54::advance(const SpringSystem& system, Motion motion, double duration,
                                    const Tolerance& tolerance) {
  if (!(duration >= 0.0)) throw InputError("adaptive steps need a duration of zero or more");
  if (!(tolerance.position > 0.0) || !(tolerance.velocity > 0.0))
    throw InputError("adaptive steps need tolerances above zero");
  if (motion.x.empty() || duration == 0.0) return {};
  constexpr double exponent = 0.2 - 0.75 * 0.04, memory = 0.04, safety = 0.9;
  resize(motion.x.size());
  if (const StepResult start = check_finite(motion.x, motion.v); !start.ok()) {
    ++work_.failed_steps;
    return start;
  }
  evaluate_first(system, motion);
  if (next_step_ == 0.0) {
    // a twelfth of the shortest period is a sound first trial of a method of order 5
    const double frequency = frequency_bound(system);
    next_step_ = frequency > 0.0 ? 0.5 / frequency : duration;
  }
  bool rejected = false;
  for (double done = 0.0; done < duration;) {
    const double remains = duration - done;
    const bool last = next_step_ * 1.01 >= remains;
    const double h = last ? remains : next_step_;
    if (!last && done + h == done) {
      ++work_.failed_steps;
      return {StepCode::step_underflow, Witness::none, 0, "step", h};
    }
    evaluate_others(system, motion, h);
    const double error = evaluate_error(system, h, tolerance);
    const bool finite = std::isfinite(error) && check_finite(end_.x, end_.v).ok();
    if (!finite || error > 1.0) {
      ++work_.rejected_steps;
      rejected = true;
      next_step_ = h * (finite ? std::max(0.1, safety * std::pow(error, -exponent)) : 0.1);
      if (done + next_step_ == done || next_step_ < 1e-16 * duration) {
        ++work_.failed_steps;
        return {StepCode::step_underflow, Witness::none, 0, "step", next_step_};
      }
      continue;
    }
    if (const StepResult result = end_.commit(motion, work_); !result.ok()) return result;
    const double bounded = std::max(error, 1e-4);  // a vanishing error does not predict the next step
    double factor = safety * std::pow(bounded, -exponent) * std::pow(last_error_, memory);
    factor = std::clamp(factor, 0.1, rejected ? 1.0 : 5.0);
    // a last step cut short says little about how long the next may be
    if (!last || h * factor > next_step_) next_step_ = h * factor;
    last_error_ = bounded;
    rejected = false;
    std::swap(stage_v_[0], stage_v_[6]);
    std::swap(stage_a_[0], stage_a_[6]);
    done = last ? duration : done + h;
  }
  return {};
}

}  // namespace dartboard
