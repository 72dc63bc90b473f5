#include "reference/ode_oracle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "reference/ode_intervals.h"

namespace dartboard::reference {
namespace {

constexpr double disturbance = 1e-12;  // [mean edge lengths], mass-weighted

NetworkMotion disturbed(NetworkMotion motion, double edge) {
  SplitMix64 random(1);
  std::vector<Eigen::Vector3d> shift;
  double norm = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < motion.start.x.size(); ++i) {
    shift.push_back(motion.network.fixed[i] ? Eigen::Vector3d(0, 0, 0) : random.next_in_ball());
    norm += motion.network.mass[i] * shift.back().squaredNorm();
    mass += motion.network.mass[i];
  }
  if (norm == 0.0) return motion;
  for (std::size_t i = 0; i < shift.size(); ++i)
    motion.start.x[i] += disturbance * edge / std::sqrt(norm / mass) * shift[i];
  return motion;
}

// Growth is measured from the actual disturbance: the shift after rounding to the doubles around x.
std::vector<double> gains(const NetworkMotion& motion, const CodeRun& run, double edge, double step_times_rate) {
  const NetworkMotion twin = disturbed(motion, edge);
  const CodeRun other = run_odeint_fehlberg(twin, step_times_rate);
  double norm = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < motion.start.x.size(); ++i) {
    norm += motion.network.mass[i] * (twin.start.x[i] - motion.start.x[i]).squaredNorm();
    mass += motion.network.mass[i];
  }
  const double before = std::sqrt(norm / mass) / edge;
  std::vector<double> gain;
  for (std::size_t c = 0; c < motion.checkpoints.size(); ++c) {
    const double after =
        position_distance(motion.network_of(motion.interval_at(c)), run.states[c], other.states[c], edge);
    gain.push_back(before > 0.0 ? after / before : 0.0);
  }
  return gain;
}

}  // namespace

PointState to_points(const std::vector<long double>& y) {
  PointState state;
  const std::size_t n = y.size() / 6;
  for (std::size_t i = 0; i < 2 * n; ++i)
    (i < n ? state.x : state.v)
        .emplace_back(static_cast<double>(y[3 * i]), static_cast<double>(y[3 * i + 1]),
                      static_cast<double>(y[3 * i + 2]));
  return state;
}

double distance(const NetworkMotion& motion, const CodeRun& a, const CodeRun& b, double edge) {
  double largest = 0.0;
  for (std::size_t c = 0; c < motion.checkpoints.size(); ++c)
    largest = max_or_nan(largest,
                         position_distance(motion.network_of(motion.interval_at(c)), a.states[c], b.states[c], edge));
  return largest;
}

double position_distance(const SpringNetwork& network, const std::vector<long double>& a,
                         const std::vector<long double>& b, double edge) {
  long double sum = 0.0L, mass = 0.0L;
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    mass += network.mass[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) sum += network.mass[i] * (a[k] - b[k]) * (a[k] - b[k]);
  }
  return mass > 0.0L ? static_cast<double>(std::sqrt(sum / mass) / edge) : 0.0;
}

double CertifiedMotion::largest_gain() const {
  double largest = 0.0;
  for (const double g : gain) largest = max_or_nan(largest, g);
  return largest;
}

CertifiedMotion certify(const NetworkMotion& motion, const CertifyOptions& options) {
  CertifiedMotion certified;
  certified.edge = mean_rest_length(motion.network);
  constexpr double infinity = std::numeric_limits<double>::infinity();

  // refine until two runs agree
  double step = options.step_times_rate;
  std::vector<CodeRun> runs;
  runs.push_back(run_odeint_fehlberg(motion, step));
  const double twin_step = step;
  certified.self_difference = infinity;
  for (int k = 0; k <= options.refinements && !(certified.self_difference <= options.accepted); ++k) {
    step *= 0.7;
    runs.push_back(run_odeint_fehlberg(motion, step));
    certified.self_difference = distance(motion, runs[runs.size() - 2], runs.back(), certified.edge);
  }
  const CodeRun& reference = runs.back();
  for (const CodeRun& run : runs)
    certified.codes.push_back(
        {run.code, distance(motion, run, reference, certified.edge), run.evaluations, run.cpu_s, run.failure});
  for (std::size_t c = 0; c < motion.checkpoints.size(); ++c) {
    certified.states.push_back(to_points(reference.states[c]));
    certified.interval.push_back(motion.interval_at(c));
  }

  struct Other {
    std::function<CodeRun()> run;
    bool suffices;     // to be accepted
    bool independent;  // of Odeint, the library of the reference
  };
  std::vector<Other> others;
  if (have_sundials()) {
    others.push_back({[&] { return run_arkode_fehlberg(motion, options.relative); }, true, true});
    others.push_back({[&] { return run_cvode_adams(motion, options.relative); }, true, true});
  }
  if (options.extrapolation || !have_sundials())
    others.push_back(
        {[&] { return run_odeint_bulirsch_stoer(motion, 1e-4 * options.relative); }, !have_sundials(), false});
  certified.agreement = infinity;
  bool confirmed = false;
  for (const Other& other : others) {
    const CodeRun run = other.run();
    const double away = run.failure.empty() ? distance(motion, run, reference, certified.edge) : infinity;
    certified.codes.push_back({run.code, away, run.evaluations, run.cpu_s, run.failure});
    if (away < certified.agreement) certified.agreement = away;
    confirmed = confirmed || (other.suffices && away <= options.accepted);
    certified.independent = certified.independent || (other.independent && away <= options.accepted);
    if (!options.all_codes && confirmed) break;
  }
  certified.accepted = certified.self_difference <= options.accepted && confirmed;
  // h^8: of the difference of two runs with steps 1 and 0.7, the finer one has 0.7^8 / (1 - 0.7^8) = 0.061
  double known = max_or_nan(0.061 * certified.self_difference, certified.agreement);
  double rounding = 0.0;
  for (std::size_t c = 0; c < certified.states.size(); ++c)
    rounding = max_or_nan(
        rounding, position_distance(motion.network_of(certified.interval[c]), reference.states[c],
                                    flat<long double>(certified.states[c], Eigen::Vector3d::Zero()), certified.edge));
  certified.floor = max_or_nan(100.0 * known, 10.0 * rounding);
  if (options.gain) certified.gain = gains(motion, runs.front(), certified.edge, twin_step);
  return certified;
}

}  // namespace dartboard::reference
