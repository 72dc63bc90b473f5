#include "validation/recommend/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/time/integrators.h"

namespace dartboard {
namespace {

/// The number of steps that run_timed takes when `steps` are requested: parts of those that events are within count.
double steps_taken(const reference::NetworkMotion& motion, std::uint64_t steps) {
  const double h = motion.checkpoints.back() / static_cast<double>(steps);
  double t = 0.0, count = 0.0;
  const auto go_to = [&](double end) {
    if (end > t) count += std::ceil(end / h - 0x1p-30) - std::floor(t / h + 0x1p-30);
    t = std::max(t, end);
  };
  std::size_t next = 0;
  for (const double checkpoint : motion.checkpoints) {
    for (; next < motion.events.size() && motion.events[next].time < checkpoint; ++next)
      go_to(motion.events[next].time);
    go_to(checkpoint);
  }
  return count;
}

/// Two pilots and the power law between them; beyond the coarsest, errors grow at least with the order.
struct Segment {
  Candidate::Seen from;
  double power, until;  // [s]
};

std::vector<Segment> segments_of(const Candidate& c) {
  std::vector<Segment> segments{{{c.pilot_h, c.error_at_pilot}, c.slope, std::numeric_limits<double>::infinity()}};
  for (const Candidate::Seen& next : c.coarser) {
    Segment& last = segments.back();
    last.power = std::log(next.error / last.from.error) / std::log(next.h / last.from.h);
    last.until = next.h;
    segments.push_back({next, std::max(last.power, static_cast<double>(c.order)), last.until});
    segments.back().until = std::numeric_limits<double>::infinity();
  }
  return segments;
}

/// The largest step whose error without rounding is at most `error`.
double step_for_truncation(const Candidate& c, double error) {
  if (!(error > c.error_at_pilot)) return c.pilot_h * std::pow(error / c.error_at_pilot, 1.0 / c.slope);
  double h = c.pilot_h;
  for (const Segment& s : segments_of(c)) {
    h = std::min(s.until, s.from.h * std::pow(error / s.from.error, 1.0 / std::max(s.power, 1e-3)));
    if (h < s.until) break;
  }
  return h;
}

/// The number of steps that an adaptive candidate takes.
double steps_within(const Candidate& c, double tolerance) {
  if (tolerance <= c.pilot_h) return c.pilot_steps * std::pow(tolerance / c.pilot_h, -c.steps_slope);
  Candidate::Seen from{c.pilot_h, c.error_at_pilot, c.pilot_steps};
  for (const Candidate::Seen& to : c.coarser) {
    if (tolerance <= to.h) {
      const double power = std::log(to.steps / from.steps) / std::log(to.h / from.h);
      return from.steps * std::pow(tolerance / from.h, power);
    }
    from = to;
  }
  return from.steps;
}

/// The rounding error over the whole duration; `step` is the tolerance of an adaptive candidate.
double rounding_at(const Candidate& c, double step) {
  if (!(c.rounding.factor > 0.0)) return 0.0;
  return c.rounding.at(c.adaptive ? c.duration / steps_within(c, step) : step);
}

/// The largest step whose error is at most `error`, or the best where there is none.
double step_for(const Candidate& c, double error) {
  double high = step_for_truncation(c, error), low = c.best_step();
  if (!(c.rounding.factor > 0.0)) return high;
  if (!(low < high)) return low;
  if (c.error_at(high) <= error) return high;
  // above the best step the sum of both errors grows with the step
  for (int k = 0; k < 60; ++k) {
    const double middle = std::sqrt(low * high);
    (c.error_at(middle) <= error ? low : high) = middle;
  }
  return low;
}

}  // namespace

double Candidate::error_at(double step) const {
  const double rounded = rounding_at(*this, step);
  if (step <= pilot_h) return error_at_pilot * std::pow(step / pilot_h, slope) + rounded;
  for (const Segment& s : segments_of(*this))
    if (step <= s.until) return s.from.error * std::pow(step / s.from.h, s.power) + rounded;
  return std::numeric_limits<double>::quiet_NaN();
}

double Candidate::best_step() const {
  // a h^s + r h^-p is least where s a h^s = p r h^-p; for an adaptive one h ~ tolerance^steps_slope; where rounding
  // does not grow, an error ten times below it is negligible
  const double p = adaptive ? rounding.power * steps_slope : rounding.power;
  const double falls = slope * error_at_pilot, grows = std::max(p, 0.1) * rounding_at(*this, pilot_h);
  if (!(falls > 0.0)) return pilot_h;
  return pilot_h * std::min(1.0, std::pow(grows / falls, 1.0 / (slope + p)));
}

std::string_view name(Confidence confidence) {
  switch (confidence) {
    case Confidence::asymptotic: return "asymptotic";
    case Confidence::pre_asymptotic: return "pre-asymptotic";
    case Confidence::sufficient: return "sufficient";
    case Confidence::none: return "none";
  }
  return "?";
}

std::unique_ptr<Integrator> Candidate::make() const {
  std::string_view name = contender;
  if (adaptive) name.remove_suffix(std::string_view("-adaptive").size());
  return make_integrator(name);
}

RealTime best_in_real_time(std::span<const Candidate> candidates, double force_s, double stability) {
  RealTime best;
  for (const Candidate& candidate : candidates) {
    if (!candidate.usable() || candidate.adaptive) continue;
    Candidate c = candidate;
    if (c.confidence == Confidence::sufficient) c.slope = c.order;  // no order was seen: that of the method
    // seconds of the run = duration / h * step_s (h / pilot_h)^step_slope <= duration
    const double step_s = c.step_cost * force_s;
    const double h = c.step_slope < 1.0
                         ? std::pow(step_s / std::pow(c.pilot_h, c.step_slope), 1.0 / (1.0 - c.step_slope))
                         : std::numeric_limits<double>::infinity();
    if (!(h < stability * c.limit_h)) continue;
    // shorter steps than the best lose more to rounding than they gain
    const double reached = c.error_at(std::max(h, std::min(c.best_step(), stability * c.limit_h)));
    if (!std::isfinite(reached) || reached >= best.error) continue;
    best = {reached, c.contender};
  }
  return best;
}

void solve_for_error(Candidate& c, double error, const reference::NetworkMotion& motion, double force_s,
                     const RecommendOptions& options) {
  // an order that is still rising errs on the safe side
  double aim = c.confidence == Confidence::asymptotic || c.confidence == Confidence::sufficient ? error
               : c.full_length                                                                  ? 0.8 * error
                                                                                                : 0.35 * error;
  // of a part of the motion, errors were seen to be predicted up to three times too small; of small parts `beyond` does
  // better
  if (!c.full_length && c.seen_part >= 0.1 && c.seen_part < 1.0) aim = std::min(aim, 0.4 * error);
  // where events and loads divide steps, errors do not fall evenly with the step: they were seen to be up to three
  // times what the law between two pilots gives
  if (!motion.events.empty()) aim = std::min(aim, 0.5 * error);
  const double duration = motion.checkpoints.back();
  c.duration = duration;
  c.least_error = 0.0;
  double count = 0.0;
  if (c.adaptive) {
    // the tolerance is a step to the power of the order
    const double safety = std::pow(options.safety, c.order);
    const double loosest = c.coarser.empty() ? c.pilot_h : c.coarser.back().h;
    c.tolerance = std::clamp(std::max(step_for(c, safety * aim), c.best_step()), 1e-15, loosest);
    c.predicted_error = c.error_at(c.tolerance);
    count = steps_within(c, c.tolerance);
    c.steps = static_cast<std::uint64_t>(count);
    c.h = duration / count;
    c.predicted_cost = count * c.step_cost;
  } else {
    const double largest = step_for(c, aim);
    const double for_error = std::max(options.safety * largest, std::min(largest, c.best_step()));
    const double for_stability = options.stability * c.limit_h;
    const auto checkpoints = motion.checkpoints.size();
    const double per_interval = duration / static_cast<double>(checkpoints);
    c.fewest_steps = per_interval <= std::min(for_error, for_stability);
    c.limited_by_stability = !c.fewest_steps && for_stability < for_error;
    const double h = std::min({for_error, for_stability, per_interval});
    const double steps = static_cast<double>(checkpoints) * std::ceil(per_interval / h);
    if (!(steps <= options.most_steps)) {
      c.pruned =
          fmt::format("it would take {:.1e} steps, and at most {:.0e} are considered", steps, options.most_steps);
      return;
    }
    c.steps = static_cast<std::uint64_t>(steps);
    c.h = duration / static_cast<double>(c.steps);
    c.predicted_error = c.error_at(c.h);
    count = steps_taken(motion, c.steps);
    c.predicted_cost = count * c.step_cost * std::pow(c.h / c.pilot_h, c.step_slope);
  }
  c.predicted_evaluations = count * c.step_evaluations;
  c.predicted_s = c.predicted_cost * force_s;
  // for an exact motion only rounding is left
  if (c.predicted_error <= error || !std::isfinite(c.predicted_error)) return;
  c.least_error = c.predicted_error;
  c.pruned = fmt::format("double precision leaves it {:.1e} edges at best", c.least_error);
}

}  // namespace dartboard
