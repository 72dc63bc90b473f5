#include "validation/extremes/motion_truth.h"

#include <vector>

#include "core/plain/nan_maximum.h"
#include "reference/ode_codes.h"
#include "validation/extremes/step_evidence.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

struct Truth {
  std::vector<Vector3d> x, v;  // of the start
  double duration = -1.0, rate = 0.0;
  std::vector<Spring> springs;
  std::vector<double> mass;
  std::shared_ptr<const ElasticSolid> solid;
  std::optional<std::vector<long double>> end;

  bool is_of(const SpringColumns& start, double time) const {
    const auto same = [](const Spring& a, const Spring& b) {
      return a.rest_length == b.rest_length && a.stiffness == b.stiffness && a.damping == b.damping;
    };
    const bool same_solid = !solid || !start.solid ? solid == start.solid : solid->is_like(*start.solid);
    return same_solid && time == duration && x == start.x && v == start.v && mass == start.mass &&
           std::ranges::equal(springs, start.springs, same);
  }
};

Truth find_truth(const SpringColumns& start, double duration) {
  Truth truth{start.x, start.v, duration, 0.0, start.springs, start.mass, start.solid, std::nullopt};
  const auto network = network_of(start.system(), elements_of(start));
  if (!network || !(duration > 0.0)) return truth;
  truth.rate = reference::fastest_rate(*network, start.x);
  if (!(duration * truth.rate / truth_step_times_rate <= most_truth_steps)) return truth;
  reference::NetworkMotion motion{*network, {start.x, start.v}, {}, {duration}};
  reference::CodeRun run = reference::run_odeint_fehlberg(motion, truth_step_times_rate);
  if (run.failure.empty() && !run.states.empty()) truth.end = std::move(run.states.front());
  return truth;
}

}  // namespace

MotionDistance distance_between(std::span<const long double> truth, const PointState& start, const PointState& end,
                                double slow) {
  const std::size_t n = start.x.size();
  const auto far = [&](std::size_t i, const PointState& from, double of_velocity) {
    long double x = 0, v = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto axis = static_cast<Eigen::Index>(c);
      const long double dx = truth[3 * i + c] - from.x[i][axis], dv = truth[3 * (n + i) + c] - from.v[i][axis];
      x += dx * dx;
      v += dv * dv;
    }
    return static_cast<double>(std::sqrt(x) + static_cast<long double>(of_velocity) * std::sqrt(v));
  };
  MotionDistance result;
  for (std::size_t i = 0; i < n; ++i) {
    result.positions = max_or_nan(result.positions, far(i, end, 0.0));
    result.distance = max_or_nan(result.distance, far(i, end, slow));
    result.moved = max_or_nan(result.moved, far(i, start, slow));
  }
  return result;
}

std::optional<MotionDistance> distance_from_truth(const SpringColumns& start, const SpringColumns& end,
                                                  double duration) {
  // all integrators of a row of the matrix run the same motion, one after the other
  thread_local Truth truth;
  if (!truth.is_of(start, duration)) truth = find_truth(start, duration);
  if (!truth.end) return {};
  return distance_between(*truth.end, {start.x, start.v}, {end.x, end.v},
                          truth.rate > 0.0 ? 1.0 / truth.rate : duration);
}

}  // namespace dartboard
