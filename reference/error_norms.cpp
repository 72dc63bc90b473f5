#include "reference/error_norms.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"

namespace dartboard::reference {
namespace {

using Vector = Eigen::Matrix<long double, 3, 1>;

void raise(long double& largest, long double value) { largest = max_or_nan(largest, value); }
void raise(double& largest, long double value) { largest = max_or_nan(largest, static_cast<double>(value)); }

double in_units_of(long double scale, long double error) {
  if (scale == 0.0L && error == 0.0L) return 0.0;
  return static_cast<double>(error / scale);
}

void check_points(const SpringNetwork& network, const PointState& state) {
  if (state.x.size() != network.point_count() || state.v.size() != network.point_count())
    throw InputError(fmt::format("a state of {} positions and {} velocities for {} points", state.x.size(),
                                 state.v.size(), network.point_count()));
}

// The smallest of the numbers that 95 % of them do not exceed.
double percentile95(std::vector<double> numbers) {
  if (numbers.empty()) return 0.0;
  if (std::any_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); }))
    return std::numeric_limits<double>::quiet_NaN();
  const std::size_t rank = (95 * numbers.size() + 99) / 100;  // rounded up
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(numbers.begin(), at, numbers.end());
  return *at;
}

}  // namespace

Vector centre_of_mass(const SpringNetwork& network, const PointState& state) {
  check_points(network, state);
  Vector sum(0, 0, 0);
  long double mass = 0.0L;
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    sum += static_cast<long double>(network.mass[i]) * state.x[i].cast<long double>();
    mass += network.mass[i];
  }
  if (mass > 0.0L) sum /= mass;
  return sum;
}

NetworkSums sums_of(const SpringNetwork& network, const PointState& state, const Vector& centre) {
  check_points(network, state);
  NetworkSums sums;
  const Vector g = network.gravity.cast<long double>();
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    const long double m = network.mass[i];
    const Vector x = state.x[i].cast<long double>(), v = state.v[i].cast<long double>(), arm = x - centre;
    sums.kinetic += m * v.squaredNorm() / 2;
    sums.gravity -= m * g.dot(x);
    sums.momentum += m * v;
    sums.angular += m * arm.cross(v);
    sums.momentum_size += m * v.norm();
    sums.angular_size += m * arm.norm() * v.norm();
  }
  for (const Spring& s : network.springs) {
    const long double longer =
        (state.x[s.b].cast<long double>() - state.x[s.a].cast<long double>()).norm() - s.rest_length;
    sums.elastic += static_cast<long double>(s.stiffness) * longer * longer / 2;
  }
  std::vector<long double> places;
  if (!network.elements.empty())
    for (const Eigen::Vector3d& p : state.x)
      for (const double coordinate : p) places.push_back(coordinate);
  for (const ElasticPoint& point : network.elements)
    if (point.is_elastic) sums.elastic += point.volume * energy_density(point.law, deformation(point, places.data()));
  return sums;
}

MotionErrors motion_errors(const NetworkMotion& motion, std::span<const PointState> states,
                           std::span<const PointState> reference) {
  const std::size_t n = motion.checkpoints.size();
  if (states.size() != n || reference.size() != n)
    throw InputError(
        fmt::format("{} states and {} of the reference at {} checkpoints", states.size(), reference.size(), n));
  const double edge = mean_rest_length(motion.network);
  MotionErrors errors;
  long double v = 0, v_scale = 0, energy = 0, kinetic = 0, elastic = 0, momentum = 0, momentum_scale = 0, angular = 0,
              angular_scale = 0;
  for (std::size_t c = 0; c < n; ++c) {
    const SpringNetwork& network = motion.network_of(motion.interval_at(c));
    check_points(network, states[c]);
    check_points(network, reference[c]);
    long double mass = 0, x2 = 0, v2 = 0, scale2 = 0;
    std::vector<double> distances;
    for (std::size_t i = 0; i < network.point_count(); ++i) {
      const long double m = network.mass[i];
      const Vector dx = states[c].x[i].cast<long double>() - reference[c].x[i].cast<long double>();
      const Vector dv = states[c].v[i].cast<long double>() - reference[c].v[i].cast<long double>();
      mass += m;
      x2 += m * dx.squaredNorm();
      v2 += m * dv.squaredNorm();
      scale2 += m * reference[c].v[i].cast<long double>().squaredNorm();
      distances.push_back(static_cast<double>(dx.norm() / edge));
      raise(errors.x_largest, distances.back());
    }
    if (mass > 0.0L) raise(errors.x, std::sqrt(x2 / mass) / edge);
    raise(errors.x_p95, percentile95(std::move(distances)));
    raise(v, std::sqrt(v2));
    raise(v_scale, std::sqrt(scale2));

    const Vector centre = centre_of_mass(network, reference[c]);
    const NetworkSums is = sums_of(network, states[c], centre), should = sums_of(network, reference[c], centre);
    raise(energy, std::abs(is.energy() - should.energy()));
    raise(kinetic, should.kinetic);
    raise(elastic, should.elastic);
    raise(momentum, (is.momentum - should.momentum).norm());
    raise(momentum_scale, should.momentum_size);
    raise(angular, (is.angular - should.angular).norm());
    raise(angular_scale, should.angular_size);
  }
  errors.v = in_units_of(v_scale, v);
  errors.energy = in_units_of(kinetic + elastic, energy);
  errors.momentum = in_units_of(momentum_scale, momentum);
  errors.angular = in_units_of(angular_scale, angular);
  return errors;
}

}  // namespace dartboard::reference
