#pragma once
// The reasons for which a run ends before its time.

#include <cstdint>
#include <limits>
#include <string>
#include <variant>

namespace dartboard {

/// The motion is no longer valid. The body has gone back to the last state that was kept.
struct Divergence {
  std::uint64_t step = 0;    // the step that failed
  double time = 0.0;         // [s] at its end
  std::string quantity;      // "position", "speed", "stress", or what the integrator reports
  std::uint32_t vertex = 0;  // its number in the file of the mesh, or no_point
  double value = 0.0;
  std::uint64_t taken_back = 0;                             // number of steps that the body has gone back
  double stable = std::numeric_limits<double>::infinity();  // [s] the longest stable step of the state gone back to
};
/// "diverged at step 12, t = 0.012 s: speed of vertex 3 is 4.1e+08 m/s: faster than light"
std::string to_string(const Divergence& divergence);

/// The scene refuses the next step, which is too long to be stable, and it was not taken.
struct StepRefusal {
  std::uint64_t step = 0;  // the step refused
  double time = 0.0;       // [s] at its start
  std::string why;         // "a step of 0.01 s is too long for rk4"
  double stable = 0.0;     // [s] the longest stable step
};
/// "stopped before step 12, t = 0.011 s: a step of 0.01 s is too long for rk4; at most 0.0031 s is stable"
std::string to_string(const StepRefusal& refusal);

using EarlyEnd = std::variant<Divergence, StepRefusal>;
std::string to_string(const EarlyEnd& end);

}  // namespace dartboard
