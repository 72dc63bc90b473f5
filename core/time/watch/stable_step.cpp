#include "core/time/watch/stable_step.h"

#include <algorithm>
#include <cmath>

#include "core/forces/term_damping.h"
#include "core/plain/eigenvalues.h"
#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "core/time/system/accelerations.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double unlimited = Scheme::unlimited;
constexpr std::size_t dense_coordinates = 60;
// The relative error of a Ritz value by rounding: far above k unit roundoffs, far below the width of the bracket.
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

// A damper without a spring, or with one too soft to count: it has no damping time.
bool only_damps(const Spring& s) { return s.stiffness == 0.0 || std::isinf(s.damping / s.stiffness); }

Bounds damping_times(const SpringSystem& system) {
  Bounds b{unlimited, 0.0};
  for (const Spring& s : system.springs) {
    if (only_damps(s)) continue;
    const double time = s.damping == 0.0 ? 0.0 : s.damping / s.stiffness;
    b.lower = std::min(b.lower, time);
    b.upper = std::max(b.upper, time);
  }
  for (const ForceTerm* term : system.terms) {
    const TermDamping* damping = term->damping();
    if (damping != nullptr && damping->is_viscous()) continue;
    for (std::size_t piece = 0; piece < (damping == nullptr ? 0 : term->size()); ++piece) {
      b.lower = std::min(b.lower, damping->time(piece));
      b.upper = std::max(b.upper, damping->time(piece));
    }
    if (damping == nullptr && term->size() > 0) b.lower = 0.0;
  }
  if (b.lower > b.upper) b.lower = b.upper;
  return b;
}

// Dampers without a spring and viscous terms belong here: their rates are between 0 and Gershgorin's bound of their
// matrix per mass, of terms near rest.
Bounds viscous_rates(const SpringSystem& system) {
  std::vector<double> dampers;
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const Spring& spring = system.springs[s];
    if (spring.damping == 0.0 || !only_damps(spring)) continue;
    dampers.resize(system.vertex_count(), 0.0);
    for (const auto i : system.ends[s]) dampers[i] += 2.0 * spring.damping;
  }
  for (const ForceTerm* term : system.terms)
    if (const TermDamping* damping = term->damping(); damping != nullptr && damping->is_viscous()) {
      dampers.resize(system.vertex_count(), 0.0);
      damping->for_each_constant_tangent(add_row_sums(dampers, 1.0));
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

std::size_t pieces_of(const SpringSystem& system) {
  std::size_t sum = 0;
  for (const ForceTerm* term : system.terms) sum += term->size();
  return sum;
}

/// Gershgorin's bound for all damping over the masses, whatever the directions.
double damping_bound(const SpringSystem& system) {
  std::vector<double> sum(system.vertex_count(), 0.0);
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    for (const auto i : system.ends[s]) sum[i] += 2.0 * system.springs[s].damping;
  double highest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!system.fixed[i]) highest = max_or_nan(highest, (sum[i] + system.viscosity[i]) * system.inverse_mass[i]);
  return highest;
}

/// A bound for the stiffness of the springs across their directions, as a frequency.
double across_bound(const SpringSystem& system, std::span<const SpringTangent> tangents) {
  std::vector<double> sum(system.vertex_count(), 0.0);
  for (std::size_t s = 0; s < tangents.size(); ++s)
    for (const auto i : system.ends[s]) sum[i] += 2.0 * tangents[s].across;
  double highest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!system.fixed[i]) highest = max_or_nan(highest, sum[i] * system.inverse_mass[i]);
  return std::sqrt(highest);
}

}  // namespace

StableStep quick_stable_step(const SpringSystem& system) {
  StableStep step;
  step.damping_rate.upper = damping_bound(system);
  step.any_state = step.upper = step.across = frequency_bound(system);
  step.damping_time = damping_times(system);
  step.viscous_rate = viscous_rates(system);
  // the bound does not depend on damping, and the extremes of the rates ignore NaN
  double finite = 0.0;  // 0 if all are finite, otherwise NaN
  for (const Spring& s : system.springs) finite += 0.0 * (s.stiffness + s.damping);
  for (std::size_t i = 0; i < system.vertex_count(); ++i)
    if (!system.fixed[i]) finite += 0.0 * (system.inverse_mass[i] + system.viscosity[i]);
  if (finite != 0.0 || !system.terms.empty()) step.any_state = step.upper = unlimited;
  if (has_damped_terms(system)) step.damping_rate.upper = unlimited;
  return step;
}

bool StableStepEstimate::prepare(const SpringSystem& system, std::span<const Vector3d> x) {
  const std::size_t n = system.vertex_count();
  latest_.any_state = scale_frequency_ = frequency_bound(system);
  if (!system.terms.empty()) {
    if (terms_.pattern.node_count() != n || springs_ != system.springs.size() || pieces_of(system) != pieces_)
      terms_.pattern = node_pattern_of(system);
    stiffness_of_terms(system, {{x}, TermTangents::Kind::projected}, terms_);
    SpringSystem springs = system;
    springs.terms = {};
    const double of_springs = frequency_bound(springs);
    scale_frequency_ = std::sqrt(of_springs * of_springs + largest_row_sum(system, terms_));
    latest_.any_state = unlimited;
  }
  pieces_ = pieces_of(system);
  unit_ = scale_frequency_ * scale_frequency_;
  springs_ = system.springs.size();
  scale_.resize(n);
  double finite = 0.0;  // 0 if all are finite, otherwise NaN
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

/// M^-1/2 K M^-1/2 or M^-1/2 C M^-1/2, divided by Gershgorin's bound so that no system is too stiff or too soft for the
/// numbers.
struct StableStepEstimate::Operator {
  const SpringSystem& system;
  std::span<const SpringTangent> tangents;
  double unit;
  bool viscous;              // C has viscosities too
  const BlockMatrix* terms;  // the stiffness of force terms, or null
};

void StableStepEstimate::multiply(const Operator& m, std::span<const Vector3d> in, std::span<Vector3d> out) {
  for (std::size_t i = 0; i < in.size(); ++i) scaled_[i] = scale_[i] * in[i];
  free_along_axes(m.system, scaled_);
  multiply_stiffness(m.system, m.tangents, scaled_, out);
  if (m.terms) m.terms->add_product(scaled_, out);
  if (m.viscous)
    for (std::size_t i = 0; i < in.size(); ++i) out[i] += m.system.viscosity[i] * scaled_[i];
  free_along_axes(m.system, out);
  for (std::size_t i = 0; i < in.size(); ++i) out[i] *= scale_[i] / m.unit;
  ++multiplications_;
}

double StableStepEstimate::power_iteration(const Operator& matrix) {
  const std::size_t n = matrix.system.vertex_count(), before = std::min(shape_.size(), n);
  shape_.resize(n);
  for (std::size_t i = 0; i < shape_.size(); ++i) {
    if (i >= before)
      for (double& c : shape_[i]) c = random_.next_signed();
    if (scale_[i] == 0.0) shape_[i].setZero();
  }
  if (scale_to_unit(shape_) == 0.0) {  // the kept shape has no component in the present system
    for (std::size_t i = 0; i < shape_.size(); ++i)
      if (scale_[i] != 0.0)
        for (double& c : shape_[i]) c = random_.next_signed();
    if (scale_to_unit(shape_) == 0.0) return 0.0;
  }
  multiply(matrix, shape_, w_);
  const double quotient = dot(shape_, w_);
  if (quotient > 0.0) {
    std::ranges::copy(w_, shape_.begin());
    scale_to_unit(shape_);
  } else {
    shape_.clear();
  }
  return quotient;
}

double StableStepEstimate::dense_largest(const Operator& matrix) {
  const auto n = static_cast<Eigen::Index>(3 * matrix.system.vertex_count());
  Eigen::MatrixXd dense(n, n);
  q_.assign(matrix.system.vertex_count(), Vector3d::Zero());
  for (Eigen::Index k = 0; k < n; ++k) {
    double& coordinate = q_[static_cast<std::size_t>(k / 3)][k % 3];
    coordinate = 1.0;
    multiply(matrix, q_, w_);
    coordinate = 0.0;
    dense.col(k) = Eigen::Map<const Eigen::VectorXd>(w_.data()->data(), n);
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

Bounds StableStepEstimate::lanczos(const Operator& matrix, SplitMix64& random, double wanted) {
  const auto free = static_cast<std::size_t>(std::ranges::count_if(scale_, [](double s) { return s != 0.0; }));
  const double slope = std::asinh(std::sqrt(6.0 * static_cast<double>(free)) / failure);
  const auto steps = static_cast<std::size_t>(std::ceil((slope / std::acosh(wanted) + 1.0) / 2.0));
  const std::size_t n = matrix.system.vertex_count();
  q_.resize(n);
  previous_.assign(n, Vector3d::Zero());
  for (std::size_t i = 0; i < n; ++i)
    for (double& c : q_[i]) c = scale_[i] == 0.0 ? 0.0 : random.next_signed();
  scale_to_unit(q_);
  std::vector<double> diagonal, beside;
  double remains = 0.0;
  while (diagonal.size() < steps) {
    multiply(matrix, q_, w_);
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

// Bounds of the largest eigenvalue, the upper one at most `factor` squared above it.
Bounds StableStepEstimate::largest_eigenvalue(const Operator& matrix, SplitMix64& random, double factor) {
  if (3 * matrix.system.vertex_count() > dense_coordinates) return lanczos(matrix, random, factor);
  const double largest = dense_largest(matrix);
  return {largest, largest};
}

// It draws its own random numbers, so that damping changes no bit of the frequencies.
Bounds StableStepEstimate::largest_damping_rate(const SpringSystem& system, std::span<const Vector3d> x,
                                                double factor) {
  const bool damped = has_damped_terms(system);
  if (damped) damping_of_terms(system, {{x}, TermTangents::Kind::projected}, terms_);
  const double bound = damping_bound(system) + (damped ? largest_row_sum(system, terms_) : 0.0);
  if (bound == 0.0) return {};
  dampers_ = tangents_;
  for (SpringTangent& t : dampers_) {
    t.along = t.damping;
    t.across = 0.0;
  }
  SplitMix64 random(2);
  const Bounds found = largest_eigenvalue({system, dampers_, bound, true, damped ? &terms_ : nullptr}, random, factor);
  return {bound * std::max(0.0, found.lower * (1.0 - rounding)), std::min(bound, bound * (found.upper + rounding))};
}

// Damped force terms have x'Kx = x'Nx + x'Dx, with N the stiffness that their damping is proportional to and D the
// difference, which vanishes near rest; Gershgorin bounds x'Dx by r x'Mx. So a rate of damping lies between
// time (omega^2 - across^2 - r) and time (omega^2 + r), besides viscosity. Terms that are not damped have no damping
// time; a bound from below would not cover them.
void StableStepEstimate::allow_for_stress(const SpringSystem& system, std::span<const Vector3d> x) {
  stiffness_of_stress(system, {{x}, TermTangents::Kind::projected}, terms_);
  const double missing = largest_row_sum(system, terms_);
  latest_.across = std::sqrt(latest_.across * latest_.across + missing);
  latest_.viscous_rate.upper += latest_.damping_time.upper * missing;
}

const StableStep& StableStepEstimate::refresh(const SpringSystem& system, std::span<const Vector3d> x) {
  const bool finite = prepare(system, x);
  latest_.damping_time = damping_times(system);
  latest_.viscous_rate = viscous_rates(system);
  latest_.damping_rate = {0.0, unlimited};
  latest_.lower = latest_.across = 0.0;
  latest_.upper = finite ? 0.0 : unlimited;
  if (!finite) return latest_;
  evaluate_tangents(system, x, Compression::projected, tangents_);
  if (unit_ == 0.0) {
    latest_.damping_rate = largest_damping_rate(system, x, std::sqrt(excess));
    return latest_;
  }
  const Operator stiffness{system, tangents_, unit_, false, system.terms.empty() ? nullptr : &terms_};
  Bounds squared = largest_eigenvalue(stiffness, random_, excess);
  squared.lower = std::max(squared.lower, power_iteration(stiffness));
  latest_.across = across_bound(system, tangents_);
  const auto is_undamped = [](const ForceTerm* term) { return term->damping() == nullptr; };
  const auto is_damped_by_strain = [](const ForceTerm* term) {
    return term->damping() != nullptr && !term->damping()->is_viscous();
  };
  if (std::ranges::any_of(system.terms, is_damped_by_strain))
    allow_for_stress(system, x);
  else if (std::ranges::any_of(system.terms, is_undamped))
    latest_.across = unlimited;  // elements have no direction as springs have
  latest_.lower = scale_frequency_ * std::sqrt(std::max(0.0, squared.lower * (1.0 - rounding)));
  latest_.upper = std::min(scale_frequency_, scale_frequency_ * std::sqrt(std::max(0.0, squared.upper + rounding)));
  // just above a ratio of 1 the rate of decay grows with the root of the excess: 10 % are 0.9 % of a rate
  const Bounds ratio = latest_.damping_ratio();
  const bool is_critical = ratio.upper > 0.95 && ratio.lower < 1.25;
  latest_.damping_rate = largest_damping_rate(system, x, is_critical ? critical_excess : std::sqrt(excess));
  return latest_;
}

const StableStep& StableStepEstimate::follow(const SpringSystem& system, std::span<const Vector3d> x) {
  if (scale_.size() != system.vertex_count() || springs_ != system.springs.size() || pieces_ != pieces_of(system))
    return refresh(system, x);
  if (!prepare(system, x)) return refresh(system, x);
  if (unit_ == 0.0) return latest_;
  evaluate_tangents(system, x, Compression::projected, tangents_);
  const Operator stiffness{system, tangents_, unit_, false, system.terms.empty() ? nullptr : &terms_};
  const double lower = scale_frequency_ * std::sqrt(std::max(0.0, power_iteration(stiffness)));
  if (lower > latest_.upper) return refresh(system, x);
  latest_.lower = std::max(latest_.lower, lower);
  return latest_;
}

}  // namespace dartboard
