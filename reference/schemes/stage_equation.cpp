#include "reference/schemes/stage_equation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/elements/elastic_law.h"
#include "reference/elements/elastic_point.h"
#include "reference/schemes/rounding.h"

namespace dartboard::reference {
namespace {

using Vector = Vector3<Extended>;
constexpr Extended smallest = std::numeric_limits<double>::denorm_min();

/// [m/s^2] Gravity, and what pulls at point i.
Vector fall_of(const SpringNetwork& network, std::size_t i) {
  const Vector gravity = network.gravity.cast<Extended>();
  return network.pull.empty() ? gravity : Vector(gravity + network.pull[i].cast<Extended>());
}

}  // namespace

void StageEquation::add_elements(const std::vector<Vector>& w, StageForces& result) const {
  if (network.elements.empty()) return;
  std::vector<Vector> far(w);
  for (std::size_t i = 0; i < w.size(); ++i) far[i] = xh[i] + (discrete_gradient ? 2 : 1) * tau * w[i];
  const std::vector<Extended> from = numbers_of(xh), to = numbers_of(far), speeds = numbers_of(w);
  std::vector<Vector> damped_at(w);
  for (std::size_t i = 0; i < w.size(); ++i) damped_at[i] = xh[i] + tau * w[i];
  const std::vector<Extended> half = numbers_of(damped_at);
  std::vector<Extended> pull(from.size(), 0);
  for (const ElasticPoint& point : network.elements) {
    const Matrix3<Extended> f0 = deformation(point, from.data()), f1 = deformation(point, to.data());
    // differences of velocities, not of places: a short move has few digits in these
    const Matrix3<Extended> move = 2 * tau * deformation(point, speeds.data());
    add_pull(point, discrete_gradient ? discrete_stress(point.law, f0, move) : stress(point.law, f1), pull.data());
    for_each_size(point, to.data(), 2 * std::abs(tau) * top_speed,
                  [&](std::uint32_t i, Extended size) { result.sizes[i] += size; });
    if (point.damping_time != 0)
      add_pull(point, damping_stress(point, deformation(point, half.data()), deformation(point, speeds.data())),
               pull.data());
    for_each_damping_size(point, half.data(), 2 * std::abs(tau) * top_speed, 2 * top_speed,
                          [&](std::uint32_t i, Extended size) { result.sizes[i] += size; });
    if (discrete_gradient)
      for (std::size_t a = 0; a < point.corner.size(); ++a)
        result.sizes[point.corner[a]] +=
            point.volume * point.gradient[a].norm() * discrete_stress_size(point.law, f0, move);
  }
  for (std::size_t i = 0; i < w.size(); ++i) result.acceleration[i] += three(pull, i);
}

StageForces StageEquation::forces(const std::vector<Vector>& w) const {
  const std::size_t n = network.point_count();
  StageForces result{std::vector<Vector>(n, Vector::Zero()), std::vector<Extended>(n, 0)};
  for (const Spring& s : network.springs) {
    const Vector d0 = xh[s.b] - xh[s.a], dw = w[s.b] - w[s.a];
    const Vector d1 = d0 + (discrete_gradient ? 2 : 1) * tau * dw;
    // the line along which it pulls, and its length: at the end of the step, or means over both ends of the step
    const Vector line = discrete_gradient ? Vector(d0 + d1) : d1;
    const Extended reach = discrete_gradient ? d0.norm() + d1.norm() : d1.norm();
    const Extended length = discrete_gradient ? reach / 2 : reach;
    const Extended size = s.stiffness * (d0.norm() + std::abs(Extended(s.rest_length)) + tau * 2 * top_speed) +
                          std::abs(Extended(s.damping)) * 2 * top_speed;
    for (const auto i : {s.a, s.b}) result.sizes[i] += std::abs(size);
    if (reach == 0) continue;
    const Vector along = line / reach;
    const Vector pull = (s.stiffness * (length - s.rest_length) + s.damping * dw.dot(along)) * along;
    result.acceleration[s.a] += pull;
    result.acceleration[s.b] -= pull;
  }
  add_elements(w, result);
  for (std::size_t i = 0; i < n; ++i) {
    const Extended mass = network.mass[i];
    const Vector fall = fall_of(network, i);
    result.sizes[i] = result.sizes[i] / mass + std::abs(network.viscosity) * top_speed + largest_of(fall);
    if (network.fixed[i])
      result.acceleration[i].setZero();
    else
      result.acceleration[i] = result.acceleration[i] / mass - network.viscosity * w[i] + fall;
  }
  return result;
}

std::vector<Extended> StageEquation::allowed(const std::vector<Vector>& w, const StageForces& at) const {
  // A factor of 4 over the 8 roundings of a length vector and of the sums at a point.
  const Extended roundings = 32 * epsilon;
  const std::size_t n = network.point_count();
  Extended scale = 0;
  if (tolerance > 0) {
    const StageForces at_start = forces(start());
    for (std::size_t i = 0; i < n; ++i)
      if (!network.fixed[i])
        scale = std::max({scale, largest_of(vh[i]), std::abs(tau) * largest_of(at_start.acceleration[i])});
  }
  const Extended t = std::abs(tau), speed_loss = 4 * speed_rounding, reach_loss = 4 * xh_rounding + t * speed_loss;
  std::vector<Extended> result(n, (1 + t * std::abs(network.viscosity)) * speed_loss);
  for (const Spring& s : network.springs)
    for (const auto i : {s.a, s.b})
      result[i] += t * (std::abs(Extended(s.stiffness)) * reach_loss + std::abs(Extended(s.damping)) * speed_loss) /
                   network.mass[i];
  for (const ElasticPoint& point : network.elements) {
    if (reach_loss == 0) break;
    Extended strain = 0;  // by the errors of the places; the stiffness is in the size
    for (const auto& gradient : point.gradient) strain += reach_loss * gradient.norm();
    for_each_size(point, numbers_of(xh).data(), 2 * t * top_speed,
                  [&](std::uint32_t i, Extended size) { result[i] += t * strain * size / network.mass[i]; });
    // the factor 2: the error enters both stretches of a pull
    for_each_damping_size(
        point, numbers_of(xh).data(), 2 * t * top_speed + reach_loss, 2 * top_speed,
        [&](std::uint32_t i, Extended size) { result[i] += 2 * t * strain * size / network.mass[i]; });
  }
  for (const ElasticPoint& point : network.elements)
    for_each_damping_size(point, numbers_of(xh).data(), 2 * t * top_speed, speed_loss,
                          [&](std::uint32_t i, Extended size) { result[i] += t * size / network.mass[i]; });
  for (std::size_t i = 0; i < n; ++i) {
    const Extended speeds = largest_of(w[i]) + largest_of(vh[i]);
    if (network.fixed[i])
      result[i] = roundings * speeds + smallest;
    else
      result[i] +=
          2 * tolerance * scale + roundings * (speeds + t * at.sizes[i]) + 64 * smallest * (1 + t / network.mass[i]);
  }
  return result;
}

Extended StageEquation::excess(const std::vector<Vector>& w) const {
  const StageForces at = forces(w);
  const std::vector<Extended> bound = allowed(w, at);
  Extended worst = 0;
  for (std::size_t i = 0; i < w.size(); ++i)
    worst = max_or_nan(worst, largest_of(w[i] - vh[i] - tau * at.acceleration[i]) / bound[i]);
  return worst;
}

std::vector<Vector> StageEquation::start() const {
  std::vector<Vector> flight = guess.empty() ? vh : guess, rest = flight;
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (!network.fixed[i]) rest[i].setZero();
  return potential_change(flight, rest).value < 0 ? rest : flight;
}

// phi(w) = |w - vh|_M^2 / 2 + U(xh + tau w) + tau/2 (sum of c (d.w)^2 + viscosity |w|_M^2), d the directions at `from`,
// and for elements their damping with F from there.
StageEquation::Change StageEquation::potential_change(const std::vector<Vector>& from,
                                                      const std::vector<Vector>& to) const {
  Change change;
  const auto add = [&change](Extended summand) {
    change.value += summand;
    change.sizes += std::abs(summand);
  };
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    if (network.fixed[i]) continue;
    const Vector move = to[i] - from[i], sum = to[i] + from[i];
    const Vector fall = tau * fall_of(network, i);
    const Vector slope = sum / 2 - vh[i] - fall + tau * network.viscosity / 2 * sum;
    add(network.mass[i] * slope.dot(move));
  }
  for (const Spring& s : network.springs) {
    const Vector d = xh[s.b] - xh[s.a], w0 = from[s.b] - from[s.a], w1 = to[s.b] - to[s.a];
    const Extended l0 = (d + tau * w0).norm(), l1 = (d + tau * w1).norm();
    if (l0 + l1 > 0) {
      const Extended longer = tau * (2 * d + tau * (w0 + w1)).dot(w1 - w0) / (l0 + l1);
      add(s.stiffness * ((l0 + l1) / 2 - s.rest_length) * longer);
    }
    if (l0 > 0) {
      const Vector along = (d + tau * w0) / l0;
      const Extended before = w0.dot(along), after = w1.dot(along);
      add(tau * s.damping / 2 * (after * after - before * before));
    }
  }
  if (network.elements.empty()) return change;
  const auto places = [&](const std::vector<Vector>& w) {
    std::vector<Vector> at(xh);
    for (std::size_t i = 0; i < xh.size(); ++i) at[i] += tau * w[i];
    return numbers_of(at);
  };
  const std::vector<Extended> before = places(from), after = places(to);
  for (const ElasticPoint& point : network.elements) {
    add(point.volume * energy_density(point.law, deformation(point, after.data())));
    add(-point.volume * energy_density(point.law, deformation(point, before.data())));
    if (point.damping_time == 0) continue;
    const Matrix3<Extended> f = deformation(point, before.data());
    for (const auto& [w, sign] : {std::pair(&to, 1), std::pair(&from, -1)}) {
      const Matrix3<Extended> rate = deformation(point, numbers_of(*w).data());
      add(sign * tau * point.volume / 2 * damping_stress(point, f, rate).cwiseProduct(rate).sum());
    }
  }
  return change;
}

}  // namespace dartboard::reference
