#include "reference/ode_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint/integrate/null_observer.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>

#include "core/plain/error.h"
#include "reference/ode_intervals.h"

namespace dartboard::reference {
namespace {

using State = std::vector<long double>;
static_assert(std::numeric_limits<long double>::digits >= 64, "the oracle needs more precision than double");

// Odeint copies its right-hand side for every step, so this is two pointers only.
struct CountedRates {
  const NetworkRates<long double>* rates;
  std::uint64_t* count;
  void operator()(const State& y, State& rate, long double) const {
    ++*count;
    (*rates)(y.data(), rate.data());
  }
};

double rate_at(const SpringNetwork& network, const State& y) {
  std::vector<Eigen::Vector3d> x(network.point_count());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) x[i][static_cast<Eigen::Index>(k)] = static_cast<double>(y[3 * i + k]);
  const double rate = fastest_rate(network, x);
  return rate > 0.0 ? rate : 1.0;  // without springs the motion is a polynomial, and any step will do
}

class FehlbergSolver {
 public:
  FehlbergSolver(const SpringNetwork& network, double step) : rates_(network), step_(step) {}

  void advance(State& y, double t, double end) {
    const auto steps = std::max(1.0, std::ceil((end - t) / step_));
    const long double h =
        (static_cast<long double>(end) - static_cast<long double>(t)) / static_cast<long double>(steps);
    const CountedRates rates{&rates_, &count_};
    for (double k = 0; k < steps; ++k) stepper_.do_step(rates, y, 0.0L, h);  // the system is autonomous
  }
  std::uint64_t evaluations() const { return count_; }

 private:
  NetworkRates<long double> rates_;
  double step_;
  std::uint64_t count_ = 0;
  boost::numeric::odeint::runge_kutta_fehlberg78<State, long double, State, long double> stepper_;
};

class BulirschStoerSolver {
 public:
  BulirschStoerSolver(const SpringNetwork& network, double tolerance, double edge, double rate)
      : rates_(network),
        step_(1.0L / static_cast<long double>(rate)),
        stepper_(tolerance * edge, tolerance, 1.0L, 0.0L) {}

  void advance(State& y, double start, double end) {
    const CountedRates rates{&rates_, &count_};
    long double t = start;
    int failures = 0;
    while (t < static_cast<long double>(end)) {
      long double h = std::min(step_, static_cast<long double>(end) - t);
      const bool whole = h == step_;
      if (stepper_.try_step(rates, y, t, h) == boost::numeric::odeint::success) {
        failures = 0;
        if (whole || h < step_) step_ = h;
        // the last step ends there up to a rounding, which must not become a step of its own
        if (static_cast<long double>(end) - t < 1e-18L * static_cast<long double>(end)) break;
      } else {
        step_ = h;
        if (++failures > 100) throw SolverError(fmt::format("no step is accepted at t = {} s", static_cast<double>(t)));
      }
    }
  }
  std::uint64_t evaluations() const { return count_; }

 private:
  NetworkRates<long double> rates_;
  std::uint64_t count_ = 0;
  long double step_;
  boost::numeric::odeint::bulirsch_stoer<State, long double, State, long double> stepper_;
};

}  // namespace

std::size_t NetworkMotion::interval_at(std::size_t checkpoint) const {
  std::size_t interval = 0;
  while (interval < events.size() && events[interval].time < checkpoints[checkpoint]) ++interval;
  return interval;
}

void check(const NetworkMotion& motion) {
  check(motion.network);
  if (motion.start.x.size() != motion.network.point_count() || motion.start.v.size() != motion.network.point_count())
    throw InputError(fmt::format("the start has {} positions and {} velocities for {} points", motion.start.x.size(),
                                 motion.start.v.size(), motion.network.point_count()));
  for (const auto* column : {&motion.start.x, &motion.start.v})
    for (const auto& p : *column)
      if (!p.allFinite()) throw InputError("the start is not finite");
  if (motion.checkpoints.empty()) throw InputError("there is no checkpoint");
  double t = 0.0;
  for (const double next : motion.checkpoints) {
    if (!(next > t) || !std::isfinite(next)) throw InputError(fmt::format("checkpoint {} s after {} s", next, t));
    t = next;
  }
  t = 0.0;
  std::size_t points = motion.network.point_count();
  for (const NetworkEvent& event : motion.events) {
    if (!(event.time > 0.0) || !(event.time >= t))
      throw InputError(fmt::format("event at {} s after {} s", event.time, t));
    t = event.time;
    check(event.network);
    if (event.from.size() != event.network.point_count())
      throw InputError(fmt::format("event at {} s gives the origin of {} points of {}", t, event.from.size(),
                                   event.network.point_count()));
    for (const std::uint32_t i : event.from)
      if (i >= points) throw InputError(fmt::format("event at {} s: a point comes from point {} of {}", t, i, points));
    points = event.network.point_count();
    for (const NetworkEvent::Drive& drive : event.drives)
      if (drive.point >= points || !drive.velocity.allFinite())
        throw InputError(fmt::format("event at {} s: drives point {} of {} at {} m/s", t, drive.point, points,
                                     drive.velocity.norm()));
  }
}

CodeRun run_odeint_fehlberg(const NetworkMotion& motion, double step_times_rate) {
  check(motion);
  if (!(step_times_rate > 0.0)) throw InputError("the step must be positive");
  CodeRun run{fmt::format("Odeint Fehlberg 7(8), long double, h omega = {:.3g}", step_times_rate), {}, 0, 0.0, ""};
  run_intervals<long double>(motion, Eigen::Vector3d::Zero(), run,
                             [&](const SpringNetwork& network, const State& y, double) {
                               return FehlbergSolver(network, step_times_rate / rate_at(network, y));
                             });
  return run;
}

CodeRun run_odeint_bulirsch_stoer(const NetworkMotion& motion, double tolerance) {
  check(motion);
  if (!(tolerance > 0.0)) throw InputError("the tolerance must be positive");
  CodeRun run{fmt::format("Odeint Bulirsch-Stoer, long double, tolerance {:.0e}", tolerance), {}, 0, 0.0, ""};
  try {
    run_intervals<long double>(
        motion, centre_of(motion.start), run, [&](const SpringNetwork& network, const State& y, double) {
          return BulirschStoerSolver(network, tolerance, mean_rest_length(network), rate_at(network, y));
        });
  } catch (const SolverError& error) {
    run.states.clear();
    run.failure = error.what();
  }
  return run;
}

}  // namespace dartboard::reference
