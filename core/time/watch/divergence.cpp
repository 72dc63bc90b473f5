#include "core/time/watch/divergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/forces/spring_force.h"
#include "core/forces/term_damping.h"
#include "core/plain/nan_maximum.h"
#include "core/time/method/trial_state.h"
#include "core/time/system/energy.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// Twice the energy of force terms whose vertices are displaced by rounding, each in a direction of its own: by the
// stiffness near rest, K <= trace of its blocks.
double energy_of_rounding(const SpringSystem& system, Motion motion, double place) {
  double sum = 0.0;
  for (const ForceTerm* term : system.terms)
    term->for_each_constant_tangent([&](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
      double moved = 0.0, stiffness = 0.0;
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        moved = std::max(moved, place * motion.x[nodes[a]].norm());
        stiffness += blocks[a * (a + 3) / 2](0, 0);
      }
      sum += stiffness * moved * moved;
    });
  return sum;
}

// Energy without a supply: positions rounded to 16 units in the last place move the ends of springs; a vertex that
// moves by less than half a unit in its last place in a step stands still, and has not fallen; gravity and pulls
// accelerate vertices before they have fallen; and a driven vertex passes on up to twice its speed. Dampers have no
// energy, but must be finite: zero times an infinite damping is NaN.
double small_energy(const SpringSystem& system, Motion motion, double h) {
  constexpr double place = 16 * std::numeric_limits<double>::epsilon();
  double elastic = 0.0, mass = 0.0, driven = 0.0, pulled = 0.0, standing = 0.0;
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    const double moved = place * (motion.x[i].norm() + motion.x[j].norm() + system.springs[s].rest_length);
    elastic += system.springs[s].stiffness * moved * moved + 0.0 * system.springs[s].damping;
  }
  if (!system.terms.empty()) elastic += energy_of_rounding(system, motion, place);
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    mass += system.mass[i] + 0.0 * system.viscosity[i];
    const double lost =
        std::numeric_limits<double>::epsilon() / 2 * motion.x[i].lpNorm<Eigen::Infinity>() / h;  // [m/s]
    standing += system.mass[i] * lost * lost;
    if (system.fixed[i]) driven = std::max(driven, motion.v[i].squaredNorm());
    if (!system.pull.empty()) pulled += system.mass[i] * system.pull[i].squaredNorm();
  }
  // |g + p|^2 <= 2 |g|^2 + 2 |p|^2
  const double falling = system.pull.empty() ? system.gravity.squaredNorm() : 2.0 * system.gravity.squaredNorm();
  return (elastic + standing) / 2 + mass * (h * h * falling + 2.0 * driven) + 2.0 * h * h * pulled;
}

}  // namespace

DivergenceDetector::Sums DivergenceDetector::sums(const SpringSystem& system, Motion motion) const {
  double twice = 0.0;
  Vector3d moment(0, 0, 0);
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    twice += system.mass[i] * motion.v[i].squaredNorm();
    moment += system.mass[i] * motion.x[i];
  }
  // a product with zero gravity is still NaN where the moment is not finite
  double gravity = -system.gravity.dot(moment);
  for (std::size_t i = 0; i < system.pull.size(); ++i) gravity -= system.mass[i] * system.pull[i].dot(motion.x[i]);
  return {twice / 2, gravity, std::isfinite(twice) && std::isfinite(gravity)};
}

double DivergenceDetector::available(const Sums& now) const { return supply() + std::abs(now.gravity - gravity_); }

void DivergenceDetector::find_driven(const SpringSystem& system, Motion motion) {
  driven_.clear();
  driven_springs_.clear();
  driven_pieces_.clear();
  const auto is_driven = [&](std::uint32_t i) { return system.fixed[i] && motion.v[i] != Vector3d(0, 0, 0); };
  for (std::uint32_t i = 0; i < motion.v.size(); ++i)
    if (is_driven(i)) driven_.push_back(i);
  if (driven_.empty()) return;
  for (std::uint32_t s = 0; s < system.springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    if (!is_driven(i) && !is_driven(j)) continue;
    const bool rigid = system.fixed[i] && system.fixed[j] && motion.v[i] == motion.v[j];
    if (!rigid) driven_springs_.push_back(s);
  }
  for (const ForceTerm* term : system.terms) {
    driven_pieces_.emplace_back();
    for (std::uint32_t piece = 0; piece < term->size(); ++piece)
      if (std::ranges::any_of(term->nodes(piece), is_driven)) driven_pieces_.back().push_back(piece);
  }
}

// The work per time of drives, against the springs and the weight at driven vertices, and of terms without an energy.
double DivergenceDetector::power(const SpringSystem& system, Motion motion) {
  double sum = 0.0;
  for (const ForceTerm* term : system.terms)
    if (!term->has_energy())
      for (std::uint32_t piece = 0; piece < term->size(); ++piece) sum += term->power({&piece, 1}, motion.x, motion.v);
  for (const std::uint32_t s : driven_springs_) {
    const auto [i, j] = system.ends[s];
    const Vector3d f = spring_force(system.springs[s], motion.x[j] - motion.x[i], motion.v[j] - motion.v[i]);
    if (system.fixed[i]) sum -= f.dot(motion.v[i]);
    if (system.fixed[j]) sum += f.dot(motion.v[j]);
  }
  if (!driven_pieces_.empty()) {
    driven_velocity_.assign(motion.v.size(), Vector3d(0, 0, 0));
    for (const std::uint32_t i : driven_) driven_velocity_[i] = motion.v[i];
    for (std::size_t k = 0; k < driven_pieces_.size(); ++k) {
      sum -= system.terms[k]->power(driven_pieces_[k], motion.x, driven_velocity_);
      if (const TermDamping* damping = system.terms[k]->damping(); damping != nullptr)
        sum -= damping->power(driven_pieces_[k], motion.x, motion.v, driven_velocity_);
    }
  }
  for (const std::uint32_t i : driven_) sum -= system.mass[i] * system.gravity.dot(motion.v[i]);
  if (!system.pull.empty())
    for (const std::uint32_t i : driven_) sum -= system.mass[i] * system.pull[i].dot(motion.v[i]);
  return sum;
}

double DivergenceDetector::energy_of_some(const SpringSystem& system, Motion motion) {
  const std::size_t count = system.springs.size(), stride = std::clamp<std::size_t>(count / 8, 1, spring_share);
  first_spring_ = first_spring_ + 1 < (system.terms.empty() ? stride : spring_share) ? first_spring_ + 1 : 0;
  double twice = 0.0;
  for (std::size_t s = first_spring_ % stride; s < count; s += stride) {
    const auto [i, j] = system.ends[s];
    const double stretch = (motion.x[j] - motion.x[i]).norm() - system.springs[s].rest_length;
    twice += system.springs[s].stiffness * stretch * stretch;
  }
  double sum = static_cast<double>(stride) * twice / 2;
  for (const ForceTerm* term : system.terms) {
    const std::size_t every = std::clamp<std::size_t>(term->size() / 8, 1, spring_share);
    sum += static_cast<double>(every) * term->energy(motion.x, first_spring_ % every, every);
  }
  return sum;
}

void DivergenceDetector::keep(Motion motion) {
  kept_x_.assign(motion.x.begin(), motion.x.end());
  kept_v_.assign(motion.v.begin(), motion.v.end());
  since_kept_ = 0;
}

StepResult DivergenceDetector::begin(const SpringSystem& system, Motion motion, double ceiling) {
  const Sums now = sums(system, motion);
  const double elastic = elastic_energy(system, motion.x);
  const double floor = small_energy(system, motion, step_);
  if (!now.finite || !std::isfinite(elastic) || !std::isfinite(floor)) return diagnose(system, motion);
  find_driven(system, motion);
  power_ = power(system, motion);
  work_ = most_work_ = 0.0;
  energy_ = std::min(now.kinetic + elastic, ceiling);
  small_ = floor;
  gravity_ = now.gravity;
  heaviest_ = 0.0;
  for (const double m : system.mass) heaviest_ = max_or_nan(heaviest_, m);
  since_start_ = 0;
  next_check_ = 1;
  since_all_ = all_steps;  // the first suspicion is checked at once
  keep(motion);
  return {};
}

StepResult DivergenceDetector::start(const SpringSystem& system, Motion motion, double h) {
  step_ = h;
  checks_ = 0;
  return begin(system, motion, std::numeric_limits<double>::infinity());
}

StepResult DivergenceDetector::system_changed(const SpringSystem& system, Motion motion) {
  return begin(system, motion, available(sums(system, motion)));
}

void DivergenceDetector::add_work(double work) {
  work_ += work;
  if (work_ > most_work_) most_work_ = work_;
}

StepResult DivergenceDetector::after_step(const SpringSystem& system, Motion motion) {
  ++since_kept_;
  ++since_all_;
  const auto has_energy = [](const ForceTerm* term) { return term->has_energy(); };
  if (!driven_.empty() || !std::ranges::all_of(system.terms, has_energy)) {
    const double power_now = power(system, motion);
    work_ += step_ / 2 * (power_ + power_now);
    power_ = power_now;
    if (work_ > most_work_) most_work_ = work_;  // a NaN here comes from a state with NaN, and is found in that state
  }
  if (++since_start_ < next_check_) return {};
  next_check_ += std::min(since_start_, check_steps);
  ++checks_;
  const double elastic = energy_of_some(system, motion);
  // A NaN fails these comparisons. Most checks end at the first, except with gravity, whose work has to be summed.
  if (since_kept_ < keep_steps && system.gravity.isZero(0.0) && system.pull.empty() &&
      heaviest_ / 2 * sum_of_squares(motion.v) + elastic <= suspicion * supply())
    return {};
  const Sums now = sums(system, motion);
  const double energy = available(now);
  if (!now.finite || !(now.kinetic <= gain * energy)) return diagnose(system, motion);
  // a few springs may hold much of the energy, or little: what they suggest is checked
  const double seen = now.kinetic + elastic;
  if (!(seen <= gain * energy) || (seen > suspicion * energy && since_all_ >= all_steps))
    if (const StepResult result = check_all(system, motion); !result.ok()) return result;
  if (since_kept_ >= keep_steps && now.kinetic <= 2.0 * energy) keep(motion);
  return {};
}

StepResult DivergenceDetector::check_all(const SpringSystem& system, Motion motion) {
  ++checks_;
  since_all_ = 0;
  const Sums now = sums(system, motion);
  if (now.finite && now.kinetic + elastic_energy(system, motion.x) <= gain * available(now)) return {};
  return diagnose(system, motion);
}

StepResult DivergenceDetector::diagnose(const SpringSystem& system, Motion motion) const {
  if (const StepResult state = check_finite(motion.x, motion.v); !state.ok()) return state;
  for (std::size_t i = 0; i < system.mass.size(); ++i)
    for (const auto& [quantity, value] : {std::pair{"mass", system.mass[i]}, {"viscosity", system.viscosity[i]}})
      if (!std::isfinite(value))
        return {StepCode::nonfinite, Witness::vertex, static_cast<std::uint32_t>(i), quantity, value};
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    for (const double value : {system.springs[s].stiffness, system.springs[s].rest_length, system.springs[s].damping})
      if (!std::isfinite(value))
        return {StepCode::nonfinite, Witness::edge, static_cast<std::uint32_t>(s), "spring", value};
  std::size_t most = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < motion.v.size(); ++i) {
    // speeds whose squares overflow are compared too
    const double size = std::sqrt(system.mass[i]) * motion.v[i].stableNorm();
    if (size > largest) {
      largest = size;
      most = i;
    }
  }
  return {StepCode::unstable_step, Witness::vertex, static_cast<std::uint32_t>(most), "speed",
          motion.v.empty() ? 0.0 : motion.v[most].stableNorm()};
}

StepResult DivergenceDetector::with_witness(const StepResult& result, const SpringSystem& system, Motion motion) const {
  if (result.code != StepCode::nonfinite || result.witness != Witness::none) return result;
  const StepResult found = diagnose(system, motion);
  return found.code == StepCode::nonfinite ? found : result;
}

std::uint64_t DivergenceDetector::restore(Motion motion) const {
  if (kept_x_.size() != motion.x.size()) return 0;
  std::ranges::copy(kept_x_, motion.x.begin());
  std::ranges::copy(kept_v_, motion.v.begin());
  return since_kept_;
}

}  // namespace dartboard
