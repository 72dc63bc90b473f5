#include "validation/tradeoff/rounding_floor.h"

#include <algorithm>
#include <cmath>

namespace dartboard {
namespace {

constexpr double walk = 1.5, compensated = 4.0;

/// The size of coordinates: root mean square over mass at the start, and how far the centre of mass goes from there.
double coordinate_size(const TradeoffScene& scene) {
  const reference::SpringNetwork& network = scene.motion.network;
  double mass = 0.0, sum = 0.0;
  bool held = false;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    mass += network.mass[i];
    sum += network.mass[i] * scene.motion.start.x[i].squaredNorm();
    if (network.fixed[i])
      held = true;
    else
      momentum += network.mass[i] * scene.motion.start.v[i];
  }
  const double t = scene.duration;
  const double flight = held ? 0.0 : t * momentum.norm() / mass + 0.5 * t * t * network.gravity.norm();
  return std::sqrt(sum / mass) + flight;
}

}  // namespace

double RoundingFloor::at(double h) const { return factor * std::pow(h, -power); }

RoundingFloor rounding_floor(const TradeoffScene& scene, const Scheme& scheme) {
  const double unit = 0x1p-53 * coordinate_size(scene) / scene.edge;
  if (scheme.compensated) return {.factor = compensated * unit, .power = 0.0};
  const double in_a_step = std::sqrt(scheme.symplectic && !scheme.implicit ? scheme.stages : 1.0);
  return {.factor = walk * unit * in_a_step * std::sqrt(scene.duration), .power = 0.5};
}

}  // namespace dartboard
