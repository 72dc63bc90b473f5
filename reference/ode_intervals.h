#pragma once
// The common part of all codes of the ODE oracle: the walk from checkpoint to checkpoint and from event to event.

#include <ctime>
#include <optional>
#include <utility>
#include <vector>

#include "reference/ode_codes.h"

namespace dartboard::reference {

/// Processor time of this thread [s].
inline double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Mean of the positions at the start.
inline Eigen::Vector3d centre_of(const PointState& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& x : state.x) sum += x;
  return state.x.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(state.x.size()));
}

/// The state as one vector, positions relative to `centre`.
template <class Real>
std::vector<Real> flat(const PointState& state, const Eigen::Vector3d& centre) {
  std::vector<Real> y;
  y.reserve(6 * state.x.size());
  for (const auto& x : state.x)
    for (int k = 0; k < 3; ++k) y.push_back(Real(x[k]) - Real(centre[k]));
  for (const auto& v : state.v)
    for (int k = 0; k < 3; ++k) y.push_back(Real(v[k]));
  return y;
}

/// The state after an event.
template <class Real>
std::vector<Real> taken_over(const std::vector<Real>& y, const NetworkEvent& event) {
  const std::size_t half = y.size() / 2;
  std::vector<Real> next;
  next.reserve(6 * event.from.size());
  for (const std::size_t part : {std::size_t{0}, half})
    for (const std::uint32_t i : event.from)
      for (std::size_t k = 0; k < 3; ++k) next.push_back(y[part + 3 * i + k]);
  for (const NetworkEvent::Drive& drive : event.drives)
    for (std::size_t k = 0; k < 3; ++k)
      next[3 * (event.from.size() + drive.point) + k] = Real(drive.velocity[static_cast<Eigen::Index>(k)]);
  return next;
}

/// Run a code through all intervals. make_solver(network, y, t) starts one; solver.advance(y, t_end) moves y there.
///
/// A code that gives up throws SolverError, which ends in `failure`.
template <class Real, class MakeSolver>
void run_intervals(const NetworkMotion& motion, const Eigen::Vector3d& centre, CodeRun& run, MakeSolver&& make_solver) {
  const double start = thread_cpu_seconds();
  std::vector<Real> y = flat<Real>(motion.start, centre);
  std::size_t next = 0;
  double t = 0.0;
  const auto record = [&] {
    std::vector<long double>& state = run.states.emplace_back(y.begin(), y.end());
    for (std::size_t i = 0; i < state.size() / 2; ++i)
      state[i] += static_cast<long double>(centre[static_cast<Eigen::Index>(i % 3)]);
  };
  for (std::size_t interval = 0; interval <= motion.events.size() && next < motion.checkpoints.size(); ++interval) {
    if (interval > 0) y = taken_over(y, motion.events[interval - 1]);
    // a network without points is no system to solve
    using Solver = decltype(make_solver(motion.network, y, t));
    std::optional<Solver> solver;
    if (!y.empty()) solver.emplace(make_solver(motion.network_of(interval), y, t));
    const bool last = interval == motion.events.size();
    const double end = last ? motion.checkpoints.back() : motion.events[interval].time;
    const auto go_to = [&](double stop) {
      if (stop > t && solver) solver->advance(y, t, stop);
      t = stop;
    };
    for (; next < motion.checkpoints.size() && motion.checkpoints[next] <= end; ++next) {
      go_to(motion.checkpoints[next]);
      record();
    }
    go_to(end);
    if (solver) run.evaluations += solver->evaluations();
  }
  run.cpu_s = thread_cpu_seconds() - start;
}

}  // namespace dartboard::reference
