#include "reference/schemes/stage_equation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dartboard::reference {
namespace {

using Vector = Vector3<Extended>;
constexpr Extended epsilon = std::numeric_limits<double>::epsilon();
constexpr Extended smallest = std::numeric_limits<double>::denorm_min();

}  // namespace

StageForces StageEquation::forces(const std::vector<Vector>& w) const {
  const std::size_t n = network.point_count();
  StageForces result{std::vector<Vector>(n, Vector::Zero()), std::vector<Extended>(n, 0)};
  for (const Spring& s : network.springs) {
    const Vector d0 = xh[s.b] - xh[s.a], dw = w[s.b] - w[s.a];
    const Vector d1 = d0 + (discrete_gradient ? 2 : 1) * tau * dw;
    // the line along which it pulls, and its length: of the end, or mean ones of both ends of the step
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
  for (std::size_t i = 0; i < n; ++i) {
    const Extended mass = network.mass[i];
    result.sizes[i] =
        result.sizes[i] / mass + std::abs(network.viscosity) * top_speed + largest_of(network.gravity.cast<Extended>());
    if (network.fixed[i])
      result.acceleration[i].setZero();
    else
      result.acceleration[i] =
          result.acceleration[i] / mass - network.viscosity * w[i] + network.gravity.cast<Extended>();
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
  std::vector<Vector> w = guess.empty() ? vh : guess;
  if (rest_is_lower(w))
    for (std::size_t i = 0; i < w.size(); ++i)
      if (!network.fixed[i]) w[i].setZero();
  return w;
}

// phi(w) = |w - vh|_M^2 / 2 + U(xh + tau w) + tau/2 (sum of c (d.w)^2 + viscosity |w|_M^2), d the directions at the
// guess; at rest less at the guess.
bool StageEquation::rest_is_lower(const std::vector<Vector>& flight) const {
  Extended change = 0;
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    if (network.fixed[i]) continue;
    const Extended mass = network.mass[i];
    change += mass / 2 * (vh[i].squaredNorm() - (flight[i] - vh[i]).squaredNorm());
    change -= tau * network.viscosity * mass / 2 * flight[i].squaredNorm();
    change += tau * mass * network.gravity.cast<Extended>().dot(flight[i]);
  }
  const auto rest = [&](std::size_t i) { return network.fixed[i] ? flight[i] : Vector(Vector::Zero()); };
  for (const Spring& s : network.springs) {
    const Vector d = xh[s.b] - xh[s.a], flown = flight[s.b] - flight[s.a], stays = rest(s.b) - rest(s.a);
    const Extended l0 = (d + tau * flown).norm(), l1 = (d + tau * stays).norm();
    if (l0 + l1 > 0)
      change += s.stiffness * ((l0 + l1) / 2 - s.rest_length) *
                (tau * (2 * d + tau * (flown + stays)).dot(stays - flown) / (l0 + l1));
    if (l0 > 0) {
      const Vector along = (d + tau * flown) / l0;
      const Extended before = flown.dot(along), after = stays.dot(along);
      change += tau * s.damping / 2 * (after * after - before * before);
    }
  }
  return change < 0;
}

}  // namespace dartboard::reference
