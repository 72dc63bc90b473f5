#include "validation/candidate.h"

#include <algorithm>
#include <cmath>

#include "core/time/integrators.h"

namespace dartboard {
namespace {

/// How many steps run_timed takes when it is asked for `steps`: they end at events and checkpoints.
double steps_taken(const reference::NetworkMotion& motion, std::uint64_t steps) {
  const double h = motion.checkpoints.back() / static_cast<double>(steps);
  double t = 0.0, count = 0.0;
  const auto go_to = [&](double end) {
    if (end > t) count += std::max(1.0, std::ceil((end - t) / h - 0x1p-30));
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

}  // namespace

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
  return make_integrator(std::string_view(contender).substr(0, contender.find(',')));
}

void solve_for_error(Candidate& c, double error, const reference::NetworkMotion& motion, double force_s,
                     const RecommendOptions& options) {
  // an order that is still rising errs on the safe side
  const double aim = c.confidence == Confidence::asymptotic || c.confidence == Confidence::sufficient ? error
                     : c.full_length                                                                  ? 0.8 * error
                                                                                                      : 0.5 * error;
  const double duration = motion.checkpoints.back();
  double count = 0.0;
  if (c.adaptive) {
    // the tolerance is a step to the power of the order
    const double safety = std::pow(options.safety, c.order);
    const double ratio = std::pow(safety * aim / c.error_at_pilot, 1.0 / c.slope);
    c.tolerance = std::max(c.pilot_tolerance * ratio, 1e-15);
    const double scale = c.tolerance / c.pilot_tolerance;
    c.predicted_error = c.error_at_pilot * std::pow(scale, c.slope);
    count = std::max(1.0, c.pilot_steps * std::pow(scale, -c.steps_slope));
    c.steps = static_cast<std::uint64_t>(count);
    c.h = duration / count;
    c.predicted_cost = count * c.step_cost;
  } else {
    const double for_error = options.safety * c.pilot_h * std::pow(aim / c.error_at_pilot, 1.0 / c.slope);
    const double for_stability = options.stability * c.limit_h;
    const auto checkpoints = motion.checkpoints.size();
    const double per_interval = duration / static_cast<double>(checkpoints);
    c.limited_by_stability = for_stability < for_error;
    const double h = std::min({for_error, for_stability, per_interval});
    c.steps = checkpoints * static_cast<std::uint64_t>(std::ceil(per_interval / h));
    c.h = duration / static_cast<double>(c.steps);
    c.predicted_error = c.error_at_pilot * std::pow(c.h / c.pilot_h, c.slope);
    count = steps_taken(motion, c.steps);
    c.predicted_cost = count * c.step_cost * std::pow(c.h / c.pilot_h, c.step_slope);
  }
  c.predicted_evaluations = count * c.step_evaluations;
  c.predicted_s = c.predicted_cost * force_s;
}

}  // namespace dartboard
