#pragma once
// Work and precision: the cost and the error of every integrator on a scene at every step size.

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reference/error_norms.h"
#include "validation/scenes/scene_features.h"
#include "validation/scenes/scene_reference.h"

namespace dartboard {

/// A method as it takes part: an integrator with fixed steps, or one that chooses them.
struct TradeoffContender {
  std::string name;
  std::function<std::unique_ptr<Integrator>()> make;
  bool adaptive = false;  // run with tolerances
  bool peer = false;      // another project's code, for comparison only: users cannot choose it
};

/// All of `integrators()` with fixed steps; those that can with tolerances too; and CVODE where it was compiled in.
/// With `solvers`, the implicit methods of order 1 and 2 again with a fresh factor in every iteration and with
/// conjugate gradients.
std::vector<TradeoffContender> tradeoff_contenders(bool solvers = false);

/// The standing of a point among those of its diagram.
enum class Standing : std::uint8_t {
  front,      // nothing is both cheaper and no less accurate
  undecided,  // something is, by medians, but the times overlap
  dominated,  // something is, beyond the scatter of the times
  useless,    // no better than a body that stands still, or NaN
  failed      // ended with a diagnosis
};
std::string_view name(Standing standing);

/// One run of a method on a scene, repeated.
struct WorkPoint {
  std::string contender;
  bool peer = false;
  RunSetting setting;
  double h = 0.0, h_omega = 0.0;  // [s]; times the fastest rate
  reference::MotionErrors errors;
  WorkCounters work;
  std::string code, diagnosis;  // why it failed, "UNSTABLE_DT" and a sentence; empty when it did not
  // For each repetition: the run over the mean of the force evaluations timed before and after it.
  std::vector<double> costs;
  double cost = std::numeric_limits<double>::quiet_NaN();  // their median, in the time of a force evaluation
  double cpu_s = 0.0;                                      // median
  double force_s = 0.0;                                    // of one evaluation, median
  bool under_floor = false;                                // the reference cannot resolve the error
  Standing standing = Standing::failed;

  bool failed() const { return !code.empty(); }
  double cost_low() const;
  double cost_high() const;
};

struct WorkPrecision {
  std::string scene, what;
  SceneReference reference;  // without its states
  double fastest_rate = 0.0, duration = 0.0, edge = 0.0;
  double useless_from = 1.0;  // [edges] the error of a body that stands still, at most 1
  std::size_t vertices = 0, springs = 0;
  PieceCounts pieces{};
  std::vector<WorkPoint> points;  // by contender, steps descending in size
  std::vector<std::string> omissions;
};

struct WorkPrecisionOptions {
  double most_s = 8.0;         // processor time of one run; longer runs are left out and reported
  int fewest_repetitions = 3;  // of a run
  int most_repetitions = 20;   // as long as all of them together take less than
  double repetitions_s = 0.5;  // this
  double enough_error = 0.0;   // [edges] a method that reaches this is not run with shorter steps
  // [edges] a method that does not reach this within most_s is abandoned as soon as that is plain: its error falls by a
  // power of its cost that is hardly more than its order
  double useful_error = std::numeric_limits<double>::infinity();
  double largest_implicit = 1e4;  // h omega_max that implicit methods start with, or the distance of checkpoints
  std::uint64_t seed = 1;         // of the order of the contenders
};

/// Measure. `each` is called with every point once it is complete except for its standing.
WorkPrecision work_precision(const TradeoffScene& scene, const SceneReference& reference,
                             std::span<const TradeoffContender> contenders, const CpuClock& clock,
                             const WorkPrecisionOptions& options = {},
                             const std::function<void(const WorkPoint&)>& each = {});

/// Error of a body that stays where it starts [edges]; a run that is not better has not followed the motion.
double error_of_rest(const TradeoffScene& scene, const SceneReference& reference);

/// Find the standing of all points. Errors below the floor count as the floor.
void classify(std::span<WorkPoint> points, double floor, double useless_from = 1.0);

/// The cost of a method for an error of at most `error` edges, in the time of a force evaluation: of its points that
/// are as good the cheapest, or, where two successive steps enclose the error, interpolated between them on a log-log
/// scale. Infinite when it was not seen to reach the error.
double cost_at(std::span<const WorkPoint> points, std::string_view contender, double error);

/// The cheapest method for an error.
struct Winner {
  double error = 0.0;
  std::string contender{};  // empty when no method reaches it
  double cost = 0.0;
  std::string runner_up{};  // empty when there is none
  double runner_up_cost = 0.0;
  double evaluations = 0.0;  // of the forces, counted; between two steps interpolated as the cost is
  double h = 0.0;            // [s] the step, interpolated likewise; the mean of those that were chosen
};

/// For each error; peers do not take part.
std::vector<Winner> winners(std::span<const WorkPoint> points, std::span<const double> errors);

/// The cost of a fixed choice over that of the best choice, for each error; infinite where it does not reach it.
struct Regret {
  std::string contender;
  bool peer = false;
  std::vector<double> of_error;
  double worst = 0.0;  // infinite as soon as one is
};
std::vector<Regret> regrets(std::span<const WorkPoint> points, std::span<const double> errors);

}  // namespace dartboard
