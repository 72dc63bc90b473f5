#include "core/time/accelerations.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/mechanics/spring_forces.h"
#include "core/time/nan_proof.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// Pairing springs for SIMD gains nothing here: the sums at shared ends are what the loop waits for.
template <bool damped, class SomeSpring>
void add_spring_forces(const SpringSystem& system, std::span<const SomeSpring> springs, std::span<const Vector3d> x,
                       std::span<const Vector3d> v, std::span<Vector3d> force) {
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    const SomeSpring& spring = springs[s];
    const Vector3d dx = x[j] - x[i];
    Vector3d f;
    if constexpr (damped) {
      f = spring_force(spring, dx, v[j] - v[i]);
    } else {
      const double length = std::sqrt(dx.squaredNorm());
      if (length == 0.0) continue;
      f = (spring.stiffness * (length - spring.rest_length) * (1.0 / length)) * dx;
    }
    force[i] += f;
    force[j] -= f;
  }
}

template <bool viscous>
void divide_by_mass(const SpringSystem& system, std::span<const Vector3d> v, std::span<Vector3d> a) {
  const Vector3d gravity = system.gravity;
  [[maybe_unused]] const double* const viscosity = system.viscosity.data();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if constexpr (viscous)
      a[i] = (a[i] - viscosity[i] * v[i]) * system.inverse_mass[i] + gravity;
    else
      a[i] = a[i] * system.inverse_mass[i] + gravity;
  }
}

}  // namespace

Terms terms_of(const SpringSystem& system) {
  const auto any = [](const auto& column) { return std::ranges::any_of(column, [](auto x) { return x != 0; }); };
  const auto is_damped = [](const Spring& s) { return s.damping != 0.0; };
  return {std::ranges::any_of(system.springs.damped(), is_damped), any(system.viscosity), any(system.fixed)};
}

void accelerations(const SpringSystem& system, const Terms& terms, std::span<const Vector3d> x,
                   std::span<const Vector3d> v, std::span<Vector3d> a) {
  std::ranges::fill(a, Vector3d(0, 0, 0));
  const SpringSpan& springs = system.springs;
  if (springs.damped().empty())
    add_spring_forces<false>(system, springs.undamped(), x, v, a);
  else
    terms.damping ? add_spring_forces<true>(system, springs.damped(), x, v, a)
                  : add_spring_forces<false>(system, springs.damped(), x, v, a);
  terms.viscosity ? divide_by_mass<true>(system, v, a) : divide_by_mass<false>(system, v, a);
  if (!terms.fixed) return;
  const std::uint8_t* const fixed = system.fixed.data();
  for (std::size_t i = 0; i < a.size(); ++i)
    if (fixed[i]) a[i].setZero();
}

double frequency_bound(const SpringSystem& system) {
  std::vector<double> sum(system.vertex_count(), 0.0);
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    for (const auto i : system.ends[s]) sum[i] += system.springs[s].stiffness;
  double highest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!system.fixed[i]) highest = max_or_nan(highest, 2.0 * sum[i] * system.inverse_mass[i]);
  return std::sqrt(highest);
}

}  // namespace dartboard
