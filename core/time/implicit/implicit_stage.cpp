#include "core/time/implicit/implicit_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/forces/spring_force.h"
#include "core/forces/term_damping.h"
#include "core/time/solve/stop_request.h"
#include "core/time/system/nan_proof.h"
#include "core/time/system/power_of_two.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int patience = 10;  // iterations that may lower the potential alone, not the residual

// Force on the first end between the length vectors d0 and d1 of a spring: Gonzalez's discrete gradient, which for a
// spring is k (lm - L) along (d0 + d1) / (l0 + l1), lm the mean length; without cancellation. Damping acts along it.
template <bool damped, class SomeSpring>
Vector3d discrete_force(const SomeSpring& spring, const Vector3d& d0, const Vector3d& d1,
                        [[maybe_unused]] const Vector3d& dw) {
  const double sum = std::sqrt(d0.squaredNorm()) + std::sqrt(d1.squaredNorm());
  if (sum == 0.0) return Vector3d::Zero();
  const Vector3d along = (d0 + d1) / sum;
  double tension = spring.stiffness * (0.5 * sum - spring.rest_length);
  if constexpr (damped && std::is_same_v<SomeSpring, Spring>) tension += spring.damping * dw.dot(along);
  return tension * along;
}

// A spring with the same tension, of its damping too, as its elastic tension: both turn with it.
Spring with_damping_in_tension(Spring spring, const Vector3d& d, const Vector3d& dw) {
  const double length = std::sqrt(d.squaredNorm());
  if (length > 0.0 && spring.stiffness > 0.0)
    spring.rest_length -= spring.damping * (dw.dot(d) / length) / spring.stiffness;
  return spring;
}

SpringTangent discrete_tangent(const Spring& spring, const Vector3d& d0, const Vector3d& d1, Compression compression) {
  const double sum = std::sqrt(d0.squaredNorm()) + std::sqrt(d1.squaredNorm());
  Spring mean = spring;
  const double length = std::sqrt((d0 + d1).squaredNorm());
  if (sum > 0.0) mean.rest_length = spring.rest_length * (length / sum);  // same ratio of rest length to length
  return tangent_of(mean, 0.5 * (d0 + d1), compression);
}

}  // namespace

template <bool damped>
void ImplicitStage::subtract_forces(const Problem& p, std::span<const Vector3d> w) {
  const SpringSystem& s = p.system;
  const bool discrete = p.force == StageForce::discrete_gradient;
  s.springs.visit([&](const auto springs) {
    for (std::size_t e = 0; e < springs.size(); ++e) {
      const auto [a, b] = s.ends[e];
      const auto& spring = springs[e];
      const Vector3d dw = w[b] - w[a], d0 = p.xh[b] - p.xh[a];
      const auto at_end = [&] {
        if constexpr (damped)
          return spring_force(spring, d0 + p.tau * dw, dw);
        else
          return spring_force(UndampedSpring{spring.rest_length, spring.stiffness}, d0 + p.tau * dw, dw);
      };
      const Vector3d f = discrete ? discrete_force<damped>(spring, d0, d0 + (2.0 * p.tau) * dw, dw) : at_end();
      residual_[a] -= f;
      residual_[b] += f;
    }
  });
}

void ImplicitStage::set_residual(const Problem& p, std::span<const Vector3d> w, WorkCounters& work) {
  const SpringSystem& s = p.system;
  ++work.force_evaluations;
  residual_.assign(w.size(), Vector3d::Zero());
  terms_.of(s).damping ? subtract_forces<true>(p, w) : subtract_forces<false>(p, w);
  if (!s.terms.empty()) {
    forces_.assign(w.size(), Vector3d::Zero());
    for (const ForceTerm* term : s.terms)
      p.force == StageForce::discrete_gradient ? term->add_discrete_forces({p.xh, w, p.tau}, forces_)
                                               : term->add_forces({p.xh, w, p.tau}, forces_);
    if (terms_.of(s).damping)
      for (const ForceTerm* term : s.terms)
        if (term->damping() != nullptr) term->damping()->add_forces({p.xh, w, p.tau}, w, forces_);
    for (std::size_t i = 0; i < w.size(); ++i) residual_[i] -= forces_[i];
  }
  for (std::size_t i = 0; i < s.pull.size(); ++i) residual_[i] -= s.mass[i] * s.pull[i];
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (s.fixed[i]) {
      residual_[i].setZero();
    } else {
      const Vector3d inner = residual_[i] + s.viscosity[i] * w[i] - s.mass[i] * s.gravity;  // minus the force
      residual_[i] = s.mass[i] * (w[i] - p.vh[i]) + p.tau * inner;
    }
  }
  free_along_axes(s, residual_);
}

// The residual allowed at each vertex, by the tolerance and by rounding. A length vector is wrong by an ulp of itself
// and of its summands, d0 and tau dw; 8 covers that and the sums at a vertex. However far from the origin the body is,
// the error of d0 is no larger: a difference of two numbers is rounded once, relative to itself. The rounding of the
// numbers themselves is data here. To stop at that, eps D of the stiffness in place of eps L, would move the solution
// by (h omega)^2 times it in each step: up to 470 eps D after a hundred, where 30 can be reached.
void ImplicitStage::set_allowed(const Problem& p, std::span<const Vector3d> w) {
  const SpringSystem& s = p.system;
  double scale = 0.0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (s.fixed[i]) continue;
    const Vector3d inertia = s.mass[i] * (w[i] - p.vh[i]);
    const double kick = (residual_[i] - inertia).cwiseAbs().maxCoeff() / s.mass[i];
    scale = max_or_nan(scale, max_or_nan(p.vh[i].cwiseAbs().maxCoeff(), kick));
  }
  allowed_.assign(w.size(), 0.0);
  const double speed = max_abs_or_nan(w);
  for (std::size_t e = 0; e < s.springs.size(); ++e) {
    const auto [a, b] = s.ends[e];
    const Spring& spring = s.springs[e];
    const double length = (p.xh[b] - p.xh[a]).cwiseAbs().maxCoeff();
    const double force =
        spring.stiffness * (length + spring.rest_length + std::abs(p.tau) * speed) + spring.damping * speed;
    allowed_[a] += force;
    allowed_[b] += force;
  }
  for (const ForceTerm* term : s.terms) {
    term->add_force_sizes({p.xh, w, p.tau}, allowed_);
    if (term->damping() != nullptr) term->damping()->add_force_sizes({p.xh, w, p.tau}, w, allowed_);
  }
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double speeds = w[i].cwiseAbs().maxCoeff() + p.vh[i].cwiseAbs().maxCoeff();
    const double rounding = 8.0 * epsilon * (s.mass[i] * speeds + std::abs(p.tau) * allowed_[i]);
    allowed_[i] = std::max(options_.tolerance * scale * s.mass[i], rounding);
  }
}

double ImplicitStage::excess() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    const double size =
        max_or_nan(std::abs(residual_[i].x()), max_or_nan(std::abs(residual_[i].y()), std::abs(residual_[i].z())));
    largest = max_or_nan(largest, size == 0.0 ? 0.0 : size / allowed_[i]);
  }
  return largest;
}

// The first vertex whose residual is not finite; the residual allowed is then NaN at all vertices.
StepResult ImplicitStage::nonfinite_residual(double excess) const {
  for (std::uint32_t i = 0; i < residual_.size(); ++i)
    if (!residual_[i].allFinite()) return {StepCode::nonfinite, Witness::vertex, i, "residual", residual_[i].sum()};
  return {StepCode::nonfinite, Witness::none, 0, "residual", excess};
}

double ImplicitStage::residual_norm(const Problem& p) const {
  const double unit = residual_scale();
  double sum = 0.0;
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (!p.system.fixed[i]) sum += (unit * residual_[i]).squaredNorm() / p.system.mass[i];
  return std::sqrt(sum) / unit;
}

// The factor that brings the residual near 1, so that neither its squares nor energies are lost where masses and forces
// are very small or large; a power of two, which changes no digit.
double ImplicitStage::residual_scale() const { return scale_to_one(max_abs_or_nan(residual_)); }

// phi(w + alpha direction) - phi(w) times `unit`, and the sum of the terms' sizes times epsilon.
ImplicitStage::Change ImplicitStage::potential_change(const Problem& p, std::span<const Vector3d> w, double alpha,
                                                      double unit) const {
  const SpringSystem& s = p.system;
  double sum = 0.0, sizes = 0.0;
  const auto add = [&sum, &sizes](double term) {
    sum += term;
    sizes += std::abs(term);
  };
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (s.fixed[i]) continue;
    const Vector3d step = alpha * direction_[i];
    add(unit * s.mass[i] * (w[i] - p.vh[i] + 0.5 * step).dot(step));
    add(unit * p.tau * s.viscosity[i] * (w[i] + 0.5 * step).dot(step));
    add(-p.tau * (unit * s.mass[i]) * s.gravity.dot(step));
    if (!s.pull.empty()) add(-p.tau * (unit * s.mass[i]) * s.pull[i].dot(step));
  }
  s.springs.visit([&](const auto springs) {
    for (std::size_t e = 0; e < springs.size(); ++e) {
      const auto [a, b] = s.ends[e];
      const auto& spring = springs[e];
      const Vector3d dw = w[b] - w[a], step = alpha * (direction_[b] - direction_[a]);
      const Vector3d d0 = p.xh[b] - p.xh[a] + p.tau * dw, move = p.tau * step;
      const double l0 = std::sqrt(d0.squaredNorm()), l1 = std::sqrt((d0 + move).squaredNorm());
      if (l0 + l1 > 0.0) {
        const double stretch = (2.0 * d0 + move).dot(move) / (l0 + l1);  // l1 - l0
        add(unit * spring.stiffness * (0.5 * (l0 + l1) - spring.rest_length) * stretch);
      }
      if constexpr (std::is_same_v<decltype(springs), const std::span<const Spring>>)
        if (l0 > 0.0 && spring.damping != 0.0) {
          const double rate = dw.dot(d0) / l0, more = step.dot(d0) / l0;
          add(unit * p.tau * spring.damping * (rate + 0.5 * more) * more);
        }
    }
  });
  const auto add_change = [&sum, &sizes](const EnergyChange& change, double weight) {
    sum += weight * change.value;
    sizes += std::abs(weight) * change.sizes;
  };
  for (const ForceTerm* term : s.terms) {
    add_change(term->energy_change({p.xh, w, p.tau}, direction_, p.tau * alpha), unit);
    if (term->damping() != nullptr)
      add_change(term->damping()->rate_change({p.xh, w, p.tau}, w, direction_, alpha), unit * p.tau);
  }
  return {sum, 4.0 * epsilon * sizes};
}

// In a long step of a stiff body, vertices at rest may be a better start than vertices that keep their velocity.
void ImplicitStage::choose_start(const Problem& p, std::span<Vector3d> w, WorkCounters& work) {
  const std::vector<Vector3d> residual = residual_;
  const double norm = residual_norm(p);
  for (std::size_t i = 0; i < w.size(); ++i) direction_[i] = p.system.fixed[i] ? Vector3d(0, 0, 0) : Vector3d(-w[i]);
  const bool has_potential = p.force == StageForce::at_end;
  if (has_potential && !(potential_change(p, w, 1.0, residual_scale()).value < 0.0)) return;
  // Without a potential, a spring that these velocities would turn round may converge to a solution on the wrong side.
  const bool turned = !has_potential && std::ranges::any_of(p.system.ends, [&p, w](const SpringEnds& ends) {
    const Vector3d d0 = p.xh[ends[1]] - p.xh[ends[0]];
    return d0.dot(d0 + (2.0 * p.tau) * (w[ends[1]] - w[ends[0]])) < 0.0;
  });
  trial_.resize(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) trial_[i] = w[i] + direction_[i];
  set_residual(p, trial_, work);
  if (has_potential || turned || residual_norm(p) < norm)
    std::copy(trial_.begin(), trial_.end(), w.begin());
  else
    residual_ = residual;
}

// Move w along the direction as far as Armijo's condition allows; the residual follows. False if no step does.
bool ImplicitStage::search(const Problem& p, std::span<Vector3d> w, WorkCounters& work) {
  constexpr double armijo = 1e-4;
  const double unit = residual_scale();
  double slope = 0.0;
  for (std::size_t i = 0; i < w.size(); ++i) slope += (unit * residual_[i]).dot(direction_[i]);
  if (!(slope < 0.0)) return false;
  const bool has_potential = p.force == StageForce::at_end;
  const double norm = residual_norm(p);
  const std::vector<Vector3d> start = residual_;
  trial_.resize(w.size());
  double alpha = 1.0;
  for (int trial = 0; trial < 40; ++trial, alpha *= 0.5) {
    if (trial > 0) ++work.line_search_trials;
    for (std::size_t i = 0; i < w.size(); ++i) trial_[i] = w[i] + alpha * direction_[i];
    bool accepted = false;
    if (has_potential) {
      const Change change = potential_change(p, w, alpha, unit);
      accepted = change.value <= armijo * alpha * slope + change.rounding;
      if (accepted) set_residual(p, trial_, work);
    } else {
      set_residual(p, trial_, work);
      accepted = residual_norm(p) <= (1.0 - armijo * alpha) * norm || excess() <= 1.0;
    }
    if (accepted) {
      std::copy(trial_.begin(), trial_.end(), w.begin());
      return true;
    }
  }
  if (has_potential) {  // where the energy changes by rounding only, the residual decides
    for (std::size_t i = 0; i < w.size(); ++i) trial_[i] = w[i] + direction_[i];
    set_residual(p, trial_, work);
    if (residual_norm(p) <= (1.0 - armijo) * norm || excess() <= 1.0) {
      std::copy(trial_.begin(), trial_.end(), w.begin());
      return true;
    }
  }
  residual_ = start;
  return false;
}

StepResult ImplicitStage::solve(const SpringSystem& system, std::span<const Vector3d> xh, std::span<const Vector3d> vh,
                                double tau, StageForce force, std::span<Vector3d> w, WorkCounters& work) {
  const Problem p{system, xh, vh, tau, force};
  for (std::size_t i = 0; i < w.size(); ++i)
    if (system.fixed[i]) w[i] = vh[i];
  free_along_axes(system, w);
  direction_.resize(w.size());
  bool dampers_turn = false;
  const auto of_springs = [&](Compression compression, std::vector<SpringTangent>& result) {
    result.resize(p.system.springs.size());
    for (std::size_t e = 0; e < result.size(); ++e) {
      const auto [a, b] = p.system.ends[e];
      const Vector3d d0 = p.xh[b] - p.xh[a], dw = w[b] - w[a];
      Spring spring = p.system.springs[e];
      if (p.force == StageForce::discrete_gradient) {
        result[e] = discrete_tangent(spring, d0, d0 + (2.0 * p.tau) * dw, compression);
        continue;
      }
      const Vector3d d = d0 + p.tau * dw;
      if (dampers_turn) spring = with_damping_in_tension(spring, d, dw);
      result[e] = tangent_of(spring, d, compression);
    }
  };
  // the derivative of a term's discrete gradient is not symmetric; that of its forces half way is close to it
  const TangentsAt tangents{of_springs, {xh, w, tau}};

  set_residual(p, w, work);
  choose_start(p, w, work);
  set_allowed(p, w);
  double last = std::numeric_limits<double>::infinity(), least = last;
  int since_least = 0;
  for (int iteration = 0; iteration <= options_.max_iterations; ++iteration) {
    const double now = excess();
    if (!std::isfinite(now)) return nonfinite_residual(now);
    if (now <= 1.0 && (options_.tolerance > 0.0 || now >= 0.5 * last || now == 0.0)) return {};
    if (iteration == options_.max_iterations) break;
    throw_if_stopped();
    ++work.newton_iterations;
    last = now;
    // Each iteration has a potential of its own, with its own directions of dampers: where those turn fast, steps that
    // lower one after the other may go in a circle, or away from the solution.
    since_least = now < least ? 0 : since_least + 1;
    least = std::min(least, now);
    dampers_turn = dampers_turn || since_least == patience;

    for (;;) {
      SolveStatus status = solver_.prepare(system, tangents, tau, work);
      if (status == SolveStatus::ok) {
        trial_.resize(w.size());
        for (std::size_t i = 0; i < w.size(); ++i) trial_[i] = -residual_[i];
        status = solver_.solve(trial_, direction_, Accuracy::iteration, work);
        free_along_axes(system, direction_);  // a matrix for all coordinates has no held axes
      }
      if (status == SolveStatus::ok && search(p, w, work)) break;
      if (now <= 1.0) return {};
      const bool may_project = !solver_.is_projecting() && options_.solver != LinearSolver::laplacian;
      if (may_project && (status == SolveStatus::ok || status == SolveStatus::not_positive_definite)) {
        solver_.project(work);
      } else if (status == SolveStatus::ok) {
        return {StepCode::newton_stalled, Witness::none, 0, "residual", residual_norm(p)};
      } else {
        return diagnosis_of(status, solver_);
      }
    }
  }
  if (options_.iterate_once) return {};
  return {StepCode::newton_stalled, Witness::none, 0, "residual", residual_norm(p)};
}

}  // namespace dartboard
