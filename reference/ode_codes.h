#pragma once
// The motion of a spring network by general codes for ordinary differential equations: Boost.Odeint, and SUNDIALS.

#include <cstdint>
#include <string>
#include <vector>

#include "core/plain/problem.h"
#include "reference/spring_network.h"

namespace dartboard::reference {

/// At `time` the network becomes another one: point i of it was point from[i] before, and takes its position and
/// velocity. Points from which no new point comes are removed.
struct NetworkEvent {
  /// A point that moves at another velocity from then on.
  struct Drive {
    std::uint32_t point;
    Eigen::Vector3d velocity;  // [m/s]
  };
  double time;  // [s]
  SpringNetwork network;
  std::vector<std::uint32_t> from;
  std::vector<Drive> drives{};
};

/// An initial value problem with topological events, from time 0 to the last checkpoint.
///
/// A checkpoint at the time of an event shows the state before it.
struct NetworkMotion {
  SpringNetwork network;
  PointState start;
  std::vector<NetworkEvent> events;  // ascending in time, all positive
  std::vector<double> checkpoints;   // [s] ascending, all positive

  /// 0 for `network`, k for the network of events[k - 1].
  std::size_t interval_at(std::size_t checkpoint) const;
  const SpringNetwork& network_of(std::size_t interval) const {
    return interval == 0 ? network : events[interval - 1].network;
  }
};

/// throws  InputError, naming the first thing that is wrong
void check(const NetworkMotion& motion);

/// The result of a code: (x of all points, v of all points) at each checkpoint, three numbers each.
struct CodeRun {
  std::string code;  // "Odeint Fehlberg 7(8), long double, ..."
  std::vector<std::vector<long double>> states;
  std::uint64_t evaluations = 0;  // of the right-hand side
  double cpu_s = 0.0;             // of this thread
  std::string failure;            // the reason why there are no states; empty when there are
};

// All of them restart at the events, exactly there, and end a step at each checkpoint.   throws  as check(motion)

/// Boost.Odeint, Runge-Kutta-Fehlberg of order 8 in long double, in equal steps of at most step_times_rate over
/// `fastest_rate`.
CodeRun run_odeint_fehlberg(const NetworkMotion& motion, double step_times_rate);

/// Boost.Odeint, Bulirsch-Stoer extrapolation in long double, step and order by a local tolerance relative to the
/// distance from the centre and to the edges.
CodeRun run_odeint_bulirsch_stoer(const NetworkMotion& motion, double tolerance);

/// Were the two below compiled in?
bool have_sundials();
/// CVODE, Adams methods of orders 1 to 12 with fixed-point iteration, and ARKODE's ERKStep with the Fehlberg pair of
/// orders 8 and 7, in double. Positions are relative to the centre of the start. Absolute tolerances are `absolute`
/// edge lengths (times fastest_rate for velocities), by default 1e-4 of `relative`, with which points near the centre
/// are no less accurate.
CodeRun run_cvode_adams(const NetworkMotion& motion, double relative, double absolute);
CodeRun run_arkode_fehlberg(const NetworkMotion& motion, double relative, double absolute);
inline CodeRun run_cvode_adams(const NetworkMotion& motion, double relative) {
  return run_cvode_adams(motion, relative, 1e-4 * relative);
}
inline CodeRun run_arkode_fehlberg(const NetworkMotion& motion, double relative) {
  return run_arkode_fehlberg(motion, relative, 1e-4 * relative);
}

}  // namespace dartboard::reference
