#include "core/time/stable_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/plain/error.h"
#include "core/time/accelerations.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double unlimited = Scheme::unlimited;
constexpr std::size_t dense_coordinates = 60;
// What rounding may do to a Ritz value, relative: far above k unit roundoffs, far below what the bracket leaves open.
constexpr double rounding = 1e-12;

double dot(std::span<const Vector3d> a, std::span<const Vector3d> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

double scale_to_unit(std::span<Vector3d> a) {
  const double size = std::sqrt(dot(a, a));
  if (size > 0.0)
    for (Vector3d& p : a) p /= size;
  return size;
}

double largest_ritz_value(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

// A damper without a spring, or as good as that: it has no damping time.
bool only_damps(const Spring& s) { return s.stiffness == 0.0 || std::isinf(s.damping / s.stiffness); }

Bounds damping_times(const SpringSystem& system) {
  Bounds b{unlimited, 0.0};
  for (const Spring& s : system.springs) {
    if (only_damps(s)) continue;
    const double time = s.damping == 0.0 ? 0.0 : s.damping / s.stiffness;
    b.lower = std::min(b.lower, time);
    b.upper = std::max(b.upper, time);
  }
  if (b.lower > b.upper) b.lower = b.upper;
  return b;
}

// Dampers without a spring belong here: between nothing and Gershgorin's bound of their matrix over the masses.
Bounds viscous_rates(const SpringSystem& system) {
  std::vector<double> dampers;
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const Spring& spring = system.springs[s];
    if (spring.damping == 0.0 || !only_damps(spring)) continue;
    dampers.resize(system.vertex_count(), 0.0);
    for (const auto i : system.ends[s]) dampers[i] += 2.0 * spring.damping;
  }
  Bounds b{unlimited, 0.0};
  for (std::size_t i = 0; i < system.vertex_count(); ++i) {
    if (system.fixed[i]) continue;
    const double own = system.viscosity[i] * system.inverse_mass[i];
    b.lower = std::min(b.lower, own);
    b.upper = std::max(b.upper, dampers.empty() ? own : own + dampers[i] * system.inverse_mass[i]);
  }
  if (b.lower > b.upper) b.lower = b.upper;
  return b;
}

// The longest step where no spring oscillates: what damps may limit it still.
double damped_step(const StableStep& step, const Scheme& scheme, const Horizon& horizon) {
  const double rate = step.viscous_rate.upper;
  return rate == 0.0 ? unlimited : damping_limit(scheme, horizon.steps, horizon.gain) / rate;
}

bool has_no_limit(const Scheme& scheme) {
  if (!scheme.implicit && scheme.amplification == nullptr)
    throw InputError("a stable step needs a scheme with an amplification");
  return scheme.implicit && (scheme.amplification == nullptr || scheme.imaginary_limit == unlimited);
}

}  // namespace

Bounds StableStep::damping_ratio() const {
  if (upper == 0.0) return {};
  return {(damping_time.lower * lower + viscous_rate.lower / upper) / 2,
          (damping_time.upper * upper + viscous_rate.upper / std::max(lower, upper / 2)) / 2};
}

double StableStep::safe_step(const Scheme& scheme, double zeta, const Horizon& horizon) const {
  if (has_no_limit(scheme)) return unlimited;
  if (!std::isfinite(upper) || !std::isfinite(zeta)) return 0.0;
  if (upper == 0.0) return unlimited;
  return stable_limit(scheme, zeta, horizon.steps, horizon.gain) / upper;
}

bool StableStep::is_stable(const Scheme& scheme, double h, const Horizon& horizon) const {
  if (has_no_limit(scheme)) return true;
  if (!std::isfinite(upper) || !std::isfinite(h)) return false;
  if (upper == 0.0) return h <= damped_step(*this, scheme, horizon);
  const double allowed = std::log(horizon.gain) / horizon.steps;
  const auto stable = [&](double omega, double beta, double alpha) {
    // of `upper` itself the limit is as exact as the bisection for it
    const double radius = spectral_radius(scheme, h * omega * (1 - 1e-9), beta * omega / 2 + alpha / (2 * omega));
    return std::log(radius) < allowed;  // not where it is not a number
  };
  // A splitting method damps spring by spring, which damps a network less than the test oscillator: no damping must do.
  const bool splits = scheme.symplectic && !scheme.implicit;
  constexpr int samples = 64;
  const bool uniform = damping_time.lower == damping_time.upper && viscous_rate.lower == viscous_rate.upper;
  for (int i = samples; i >= 1; --i) {
    const double omega = upper * i / samples;
    if (!stable(omega, damping_time.upper, viscous_rate.upper)) return false;
    if (splits && !stable(omega, 0.0, 0.0)) return false;
    if (uniform) continue;
    if (!stable(omega, damping_time.lower, viscous_rate.lower) ||
        !stable(omega, damping_time.upper, viscous_rate.lower) ||
        !stable(omega, damping_time.lower, viscous_rate.upper))
      return false;
  }
  // Above its first limit a method may be stable again, and the gap between may be narrow (that of Blanes and Moan's is
  // 0.9 %): where the highest frequency is beyond it, others may be in it.
  constexpr double fine = 2e-3, ceiling = 20.0;
  const double from = scheme.imaginary_limit, to = std::min(h * upper, ceiling);
  if (from == 0.0) return true;
  for (int i = 0; from + i * fine < to; ++i) {
    const double omega = (from + i * fine) / h;
    if (!stable(omega, damping_time.upper, viscous_rate.upper)) return false;
    if (splits && !stable(omega, 0.0, 0.0)) return false;
  }
  return true;
}

// Limits are not monotonic in the damping ratio, and lower frequencies have other ratios: what the ratios at the
// highest frequency allow is shortened until all are stable.
double StableStep::safe_step(const Scheme& scheme, const Horizon& horizon) const {
  if (upper == 0.0 && !has_no_limit(scheme)) return damped_step(*this, scheme, horizon);
  const Bounds ratio = damping_ratio();
  double h = std::min(safe_step(scheme, ratio.lower, horizon), safe_step(scheme, ratio.upper, horizon));
  if (scheme.symplectic) h = std::min(h, safe_step(scheme, 0.0, horizon));
  if (h == 0.0 || has_no_limit(scheme)) return h;
  // an overdamped frequency may have no limit, where those below it have one
  constexpr double ceiling = 20.0;
  h = std::min(h, ceiling / upper);
  for (int tries = 0; tries < 1000 && !is_stable(scheme, h, horizon); ++tries) h *= 0.97;
  return is_stable(scheme, h, horizon) ? h : 0.0;
}

StableStep quick_stable_step(const SpringSystem& system) {
  StableStep step;
  step.any_state = step.upper = frequency_bound(system);
  step.damping_time = damping_times(system);
  step.viscous_rate = viscous_rates(system);
  // the bound knows nothing of damping, and the extremes of the rates pass over what is not a number
  double finite = 0.0;  // 0 times what is finite, else not a number
  for (const Spring& s : system.springs) finite += 0.0 * (s.stiffness + s.damping);
  for (std::size_t i = 0; i < system.vertex_count(); ++i)
    if (!system.fixed[i]) finite += 0.0 * (system.inverse_mass[i] + system.viscosity[i]);
  if (finite != 0.0) step.any_state = step.upper = unlimited;
  return step;
}

bool StableStepEstimate::prepare(const SpringSystem& system, std::span<const Vector3d> x) {
  const std::size_t n = system.vertex_count();
  latest_.any_state = frequency_bound(system);
  unit_ = latest_.any_state * latest_.any_state;
  springs_ = system.springs.size();
  scale_.resize(n);
  double finite = 0.0;  // 0 times what is finite, else not a number
  for (std::size_t i = 0; i < n; ++i) {
    scale_[i] = system.fixed[i] ? 0.0 : std::sqrt(system.inverse_mass[i]);
    finite += 0.0 * (scale_[i] + x[i].sum());
    if (!system.fixed[i]) finite += 0.0 * system.viscosity[i];
  }
  for (const Spring& s : system.springs) finite += 0.0 * (s.stiffness + s.rest_length + s.damping);
  scaled_.resize(n);
  w_.resize(n);
  return finite == 0.0 && std::isfinite(unit_);
}

// out = M^-1/2 K M^-1/2 in, divided by Gershgorin's bound so that no system is too stiff or too soft for the numbers
void StableStepEstimate::multiply(const SpringSystem& system, std::span<const Vector3d> in, std::span<Vector3d> out) {
  for (std::size_t i = 0; i < in.size(); ++i) scaled_[i] = scale_[i] * in[i];
  multiply_stiffness(system, tangents_, scaled_, out);
  for (std::size_t i = 0; i < in.size(); ++i) out[i] *= scale_[i] / unit_;
  ++multiplications_;
}

double StableStepEstimate::power_iteration(const SpringSystem& system) {
  const std::size_t before = std::min(shape_.size(), system.vertex_count());
  shape_.resize(system.vertex_count());
  for (std::size_t i = 0; i < shape_.size(); ++i) {
    if (i >= before)
      for (double& c : shape_[i]) c = random_.next_signed();
    if (scale_[i] == 0.0) shape_[i].setZero();
  }
  if (scale_to_unit(shape_) == 0.0) {  // what was kept has no part in what is left
    for (std::size_t i = 0; i < shape_.size(); ++i)
      if (scale_[i] != 0.0)
        for (double& c : shape_[i]) c = random_.next_signed();
    if (scale_to_unit(shape_) == 0.0) return 0.0;
  }
  multiply(system, shape_, w_);
  const double quotient = dot(shape_, w_);
  if (quotient > 0.0) {
    std::ranges::copy(w_, shape_.begin());
    scale_to_unit(shape_);
  } else {
    shape_.clear();
  }
  return quotient;
}

double StableStepEstimate::dense_largest(const SpringSystem& system) {
  const auto n = static_cast<Eigen::Index>(3 * system.vertex_count());
  Eigen::MatrixXd matrix(n, n);
  q_.assign(system.vertex_count(), Vector3d::Zero());
  for (Eigen::Index k = 0; k < n; ++k) {
    double& coordinate = q_[static_cast<std::size_t>(k / 3)][k % 3];
    coordinate = 1.0;
    multiply(system, q_, w_);
    coordinate = 0.0;
    matrix.col(k) = Eigen::Map<const Eigen::VectorXd>(w_.data()->data(), n);
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

Bounds StableStepEstimate::lanczos(const SpringSystem& system, std::size_t coordinates) {
  const double slope = std::asinh(std::sqrt(2.0 * static_cast<double>(coordinates)) / failure);
  const auto steps = static_cast<std::size_t>(std::ceil((slope / std::acosh(excess) + 1.0) / 2.0));
  const std::size_t n = system.vertex_count();
  q_.resize(n);
  previous_.assign(n, Vector3d::Zero());
  for (std::size_t i = 0; i < n; ++i)
    for (double& c : q_[i]) c = scale_[i] == 0.0 ? 0.0 : random_.next_signed();
  scale_to_unit(q_);
  std::vector<double> diagonal, beside;
  double remains = 0.0;
  while (diagonal.size() < steps) {
    multiply(system, q_, w_);
    const double a = dot(q_, w_);
    for (std::size_t i = 0; i < n; ++i) w_[i] -= a * q_[i] + remains * previous_[i];
    diagonal.push_back(a);
    remains = scale_to_unit(w_);
    // the space is exhausted: eigenvalues are off by no more than what remains
    if (remains < rounding)
      return {largest_ritz_value(diagonal, beside), largest_ritz_value(diagonal, beside) + remains};
    beside.push_back(remains);
    std::swap(previous_, q_);
    std::swap(q_, w_);
  }
  const double ritz = largest_ritz_value(diagonal, beside);
  const double factor = std::cosh(slope / static_cast<double>(2 * steps - 1));
  return {ritz, ritz * factor * factor};
}

const StableStep& StableStepEstimate::refresh(const SpringSystem& system, std::span<const Vector3d> x) {
  const bool finite = prepare(system, x);
  latest_.damping_time = damping_times(system);
  latest_.viscous_rate = viscous_rates(system);
  latest_.lower = 0.0;
  latest_.upper = finite ? 0.0 : unlimited;
  if (!finite || unit_ == 0.0) return latest_;
  evaluate_tangents(system, x, Compression::projected, tangents_);
  const auto free = static_cast<std::size_t>(std::ranges::count_if(scale_, [](double s) { return s != 0.0; }));
  Bounds squared;
  if (3 * system.vertex_count() <= dense_coordinates) {
    squared.lower = squared.upper = dense_largest(system);
  } else {
    squared = lanczos(system, 3 * free);
  }
  squared.lower = std::max(squared.lower, power_iteration(system));
  latest_.lower = latest_.any_state * std::sqrt(std::max(0.0, squared.lower * (1.0 - rounding)));
  latest_.upper = std::min(latest_.any_state, latest_.any_state * std::sqrt(std::max(0.0, squared.upper + rounding)));
  return latest_;
}

const StableStep& StableStepEstimate::follow(const SpringSystem& system, std::span<const Vector3d> x) {
  if (scale_.size() != system.vertex_count() || springs_ != system.springs.size()) return refresh(system, x);
  if (!prepare(system, x)) return refresh(system, x);
  if (unit_ == 0.0) return latest_;
  evaluate_tangents(system, x, Compression::projected, tangents_);
  const double lower = latest_.any_state * std::sqrt(std::max(0.0, power_iteration(system)));
  if (lower > latest_.upper) return refresh(system, x);
  latest_.lower = std::max(latest_.lower, lower);
  return latest_;
}

}  // namespace dartboard
