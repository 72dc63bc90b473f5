// The bound. For one spring with elongation e = l - L: V = k e^2 / 2, and with s the cosine between the spring and the
// axis, l' = s, l'' = (1 - s^2) / l, l''' = -3 s (1 - s^2) / l^2, so
//
//     V''' = k (3 l' l'' + e l''') = 3 k s (1 - s^2) L / l^2,   |V'''| <= 1.155 k L / l^2  (s = 1 / sqrt 3).
//
// A central difference with step d is off by d^2 / 6 of the largest V''' within d, where l is at least l - d.
//
// Rounding of the energies, w = 2^-64: coordinates and their differences are exact or off by w l; l is off by 4 w l, so
// e too, V by 4 w l k |e| + 3 w V; adding p springs loses p w sum V. Two of them over 2 d: once that sum over d. With
// gravity, m g (x +- d) / (2 d) loses 3 w m |g x| / d.
//
// Rounding of the forces, u = 2^-53: differences lose u, l 3 u, e 3 u l + u |e|; k e / l times a difference loses
// 3 u k l + 8 u k |e| in all; adding p springs p u sum k |e|; times 1/m, plus g, times m again 4 u of what is there.
// The mass itself is common data; the stiffnesses are within u (a count times a constant), 2 u k |e|.

#include "validation/order/force_gradient.h"

#include <cmath>
#include <span>
#include <vector>

#include "core/time/system/accelerations.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {
namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

constexpr Real u = 0x1p-53L, w = 0x1p-64L;

}  // namespace

ForceGradient compare_forces_with_energy(const TradeoffScene& scene) {
  const reference::SpringNetwork& network = scene.motion.network;
  const std::size_t n = network.point_count();
  SceneStage stage(scene);
  const SpringSystem system = stage.system();
  const std::span<const Eigen::Vector3d> x = stage.motion().x;
  std::vector<Eigen::Vector3d> a(n);
  accelerations(system, Terms{}, x, stage.motion().v, a);

  std::vector<std::vector<const reference::Spring*>> around(n);
  for (const reference::Spring& s : network.springs) {
    around[s.a].push_back(&s);
    around[s.b].push_back(&s);
  }
  const Real edge = reference::mean_rest_length(network);
  const Real d = 0x1p-21L * edge;
  const Vector g = network.gravity.cast<Real>();

  ForceGradient result;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Real m = network.mass[i];
    const auto springs_to = [&](const Vector& at, auto&& f) {
      for (const reference::Spring* s : around[i]) {
        const Vector other = x[s->a == i ? s->b : s->a].cast<Real>();
        f(static_cast<Real>(s->stiffness), (other - at).norm(), static_cast<Real>(s->rest_length));
      }
    };
    const auto energy = [&](const Vector& at) {
      Real sum = -m * g.dot(at);
      springs_to(at, [&](Real k, Real l, Real rest) { sum += k * (l - rest) * (l - rest) / 2; });
      return sum;
    };
    const Vector here = x[i].cast<Real>();
    const auto p = static_cast<Real>(around[i].size());
    const Real weight = m * g.norm();
    Real bound = 3 * w * weight * here.norm() / d + 4 * u * weight;
    springs_to(here, [&](Real k, Real l, Real rest) {
      const Real e = std::abs(l - rest), shortest = l - d;
      bound += d * d / 6 * Real(1.155L) * k * rest / (shortest * shortest);
      bound += (4 * w * l * k * e + (p + 3) * w * k * e * e / 2) / d;
      bound += 3 * u * k * l + (p + 14) * u * k * e;
    });
    result.largest_force = std::max(result.largest_force, network.mass[i] * a[i].norm());
    for (int axis = 0; axis < 3; ++axis) {
      Vector ahead = here, behind = here;
      ahead[axis] += d;
      behind[axis] -= d;
      const Real gradient = (energy(ahead) - energy(behind)) / (ahead[axis] - behind[axis]);
      const Real deviation = std::abs(m * static_cast<Real>(a[i][axis]) + gradient);
      const auto ratio = static_cast<double>(deviation / bound);
      if (ratio <= result.ratio || std::isnan(result.ratio)) continue;  // NaN is kept
      result.ratio = ratio;
      result.deviation = static_cast<double>(deviation);
      result.bound = static_cast<double>(bound);
      result.vertex = i;
      result.axis = axis;
    }
  }
  return result;
}

}  // namespace dartboard
