#include "core/time/method/step_limit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr double unlimited = Scheme::unlimited;
// Limits are searched up to this [1 / omega_max] only: an overdamped frequency may have no limit where others do.
constexpr double ceiling = 20.0;

// The matrix of a sweep in one direction is not symmetric: where a step damps much, motions that damping couples can
// grow. On grids, chains, wheels and complete networks, with damping ratios up to 100, no growth was seen for h d
// below 4.4 unless h omega was above 2, and some was seen from 4.5 on.
constexpr double one_way_sweep = 3.0;

bool has_no_limit(const Scheme& scheme) {
  if (!scheme.implicit && scheme.amplification == nullptr)
    throw InputError("a stable step needs a scheme with an amplification");
  return scheme.implicit && (scheme.amplification == nullptr || scheme.imaginary_limit == unlimited);
}

/// The first step [s] that amplifies one damped oscillation.
double first_limit(const Scheme& scheme, double omega, double rate, const Horizon& horizon) {
  const double zeta = rate / (2 * omega);
  return (horizon.duration > 0.0 ? stable_limit_within(scheme, zeta, horizon.duration * omega, horizon.gain, ceiling)
                                 : stable_limit(scheme, zeta, horizon.steps, horizon.gain, ceiling)) /
         omega;
}

/// The first limit for a motion that decays and does not oscillate.
double first_limit_of_decay(const Scheme& scheme, double rate, const Horizon& horizon) {
  if (rate == 0.0) return unlimited;
  return (horizon.duration > 0.0 ? damping_limit_within(scheme, horizon.duration * rate, horizon.gain, ceiling)
                                 : damping_limit(scheme, horizon.steps, horizon.gain, ceiling)) /
         rate;
}

/// Does a step of h amplify this oscillation by less than the gain? No where the amplification is NaN.
bool is_stable_for(const Scheme& scheme, double h, double omega, double rate, const Horizon& horizon) {
  const double steps = horizon.duration > 0.0 ? std::max(1.0, horizon.duration / h) : horizon.steps;
  // where h is a limit itself, it is only as exact as the bisection for it
  return std::log(spectral_radius(scheme, h * omega * (1 - 1e-9), rate / (2 * omega))) < std::log(horizon.gain) / steps;
}

bool is_one(const Bounds& rates) { return rates.upper - rates.lower <= 1e-9 * rates.upper; }

/// The rates of damping to be examined for one omega.
std::vector<double> rates_to_try(const StableStep& system, const Scheme& scheme, double omega) {
  // a symmetric sweep between half kicks only takes energy: the stable step without damping is stable with any damping
  if (scheme.sweeps) return {0.0};
  const Bounds rates = system.damping_rates(omega);
  if (is_one(rates)) return {rates.upper};
  std::vector<double> all{rates.upper, rates.lower};
  constexpr int between = 4;
  const double from = std::max(rates.lower, 1e-2 * rates.upper);
  for (int k = 1; k < between; ++k)
    all.push_back(from * std::pow(rates.upper / from, static_cast<double>(k) / between));
  // where dampers and springs have different shapes a splitting is not that of one oscillator
  if (scheme.symplectic) all.push_back(0.0);
  return all;
}

}  // namespace

Horizon horizon_of(double duration) { return {.steps = 1.0, .gain = 2.0, .duration = duration}; }

Bounds StableStep::damping_ratio() const {
  if (upper == 0.0) return {};
  return {(damping_time.lower * lower + viscous_rate.lower / upper) / 2,
          (damping_time.upper * upper + viscous_rate.upper / std::max(lower, upper / 2)) / 2};
}

StableStep StableStep::undamped() const {
  StableStep same = *this;
  same.damping_time = same.viscous_rate = same.damping_rate = {};
  return same;
}

double StableStep::highest_omega() const {
  const double beta = damping_time.lower, room = damping_rate.upper - viscous_rate.lower;
  if (!(beta > 0.0) || !(room >= 0.0)) return upper;
  return std::max(lower, std::min(upper, std::sqrt(across * across + room / beta)));
}

Bounds StableStep::damping_rates(double omega) const {
  const double square = omega * omega;
  Bounds rates{viscous_rate.lower + damping_time.lower * std::max(0.0, square - across * across),
               std::min(damping_rate.upper, viscous_rate.upper + damping_time.upper * square)};
  rates.lower = std::min(rates.lower, rates.upper);
  return rates;
}

double StableStep::safe_step(const Scheme& scheme, double zeta, const Horizon& horizon) const {
  if (has_no_limit(scheme)) return unlimited;
  if (!std::isfinite(upper) || !std::isfinite(zeta)) return 0.0;
  if (upper == 0.0) return unlimited;
  return first_limit(scheme, upper, 2 * zeta * upper, horizon);
}

// Limits are not monotonic in the damping ratio, and lower frequencies have other ratios: the first limit of the
// highest frequency is shortened to that of every other that it amplifies.
double StableStep::stable_step(const Scheme& scheme, const Horizon& horizon) const {
  if (!std::isfinite(upper)) return 0.0;
  const double highest = highest_omega();
  const double slow = first_limit_of_decay(scheme, std::min(damping_rate.upper, viscous_rate.upper), horizon);
  if (highest == 0.0) return slow;
  double h = std::min(slow, ceiling / highest);
  if (scheme.sweeps && !scheme.symmetric) h = std::min(h, one_way_sweep / damping_rates(highest).upper);
  const auto shorten = [&](double omega) {
    for (const double rate : rates_to_try(*this, scheme, omega))
      if (!is_stable_for(scheme, h, omega, rate, horizon)) h = std::min(h, first_limit(scheme, omega, rate, horizon));
  };
  for (const double rate : rates_to_try(*this, scheme, highest))
    h = std::min(h, first_limit(scheme, highest, rate, horizon));
  constexpr int samples = 64, tries = 4;
  for (int k = 0; k < tries; ++k) {
    const double before = h;
    for (int i = samples; i >= 1; --i) shorten(highest * i / samples);
    // the lowest frequency that can have the largest rate of damping
    if (damping_time.upper > 0.0 && damping_rate.upper > viscous_rate.upper)
      shorten(std::min(highest, std::sqrt((damping_rate.upper - viscous_rate.upper) / damping_time.upper)));
    // Above its first limit a method may be stable again, and the gap between may be narrow (that of Blanes and Moan's
    // is 0.9 %): where the highest frequency is beyond it, others may be in it.
    constexpr double fine = 2e-3;
    const double from = scheme.imaginary_limit;
    for (int i = 0; from > 0.0 && from + i * fine < std::min(h * highest, ceiling); ++i) shorten((from + i * fine) / h);
    if (h == before) break;
  }
  return h;
}

// The frequency of the fastest oscillation certainly lies within the bracket. Its damping is known where it follows
// from the frequency; its effect on a step is known where damping is not swept, or has no effect: a symmetric sweep
// does not change a mode that the half kicks around it stop and turn into its opposite, at h omega = 2.
double StableStep::unstable_step(const Scheme& scheme, const Horizon& horizon) const {
  const bool damped = damping_time.upper > 0.0 || viscous_rate.upper > 0.0;
  const double highest = highest_omega();
  if (!std::isfinite(upper) || (scheme.sweeps && damped && !scheme.symmetric)) return unlimited;
  double h = unlimited;
  // s^2 - d s + omega^2 is below 0 for the motion that is slowed down most, so some motion decays at a rate above s
  const double slowed = damping_rate.lower, under_root = slowed * slowed - 4 * highest * highest;
  if (!scheme.sweeps && slowed > 0.0 && under_root >= 0.0)
    h = first_limit_of_decay(scheme, (slowed + std::sqrt(under_root)) / 2, horizon);
  if (lower == 0.0) return h;
  double longest = 0.0;
  constexpr int samples = 8;
  for (int i = 0; i <= samples; ++i) {
    const double omega = lower + (highest - lower) * i / samples;
    const Bounds rates = damping_rates(omega);
    if (!scheme.sweeps && !is_one(rates)) return h;
    longest = std::max(longest, first_limit(scheme, omega, scheme.sweeps ? 0.0 : rates.upper, horizon));
  }
  return std::min(h, longest);
}

StepLimit StableStep::limit(const Scheme& scheme, const Horizon& horizon) const {
  if (has_no_limit(scheme)) return {unlimited, unlimited};
  const double stable = stable_step(scheme, horizon);
  return {stable, std::max(stable, unstable_step(scheme, horizon))};
}

double StableStep::safe_step(const Scheme& scheme, const Horizon& horizon) const {
  return has_no_limit(scheme) ? unlimited : stable_step(scheme, horizon);
}

bool StableStep::is_stable(const Scheme& scheme, double h, const Horizon& horizon) const {
  if (has_no_limit(scheme)) return true;
  if (!std::isfinite(upper) || !std::isfinite(h)) return false;
  // in a corner where every method is stable, and so is every shorter step, there is no need for the limit
  const double fastest = std::min(damping_rate.upper, viscous_rate.upper + damping_time.upper * upper * upper);
  if (h * upper <= 0.9 * scheme.imaginary_limit && h * fastest <= 0.5) return true;
  return h <= stable_step(scheme, horizon);
}

}  // namespace dartboard
