#include "core/time/system/accelerations.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/forces/term_damping.h"
#include "core/plain/nan_maximum.h"
#include "core/time/system/spring_lanes.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

template <bool damped, class SomeSpring>
void add_spring_forces(const SpringSystem& system, std::span<const SomeSpring> springs, std::span<const Vector3d> x,
                       std::span<const Vector3d> v, std::span<Vector3d> force) {
  const SpringColumnsAt at{system.ends.data(), x, v.data(), force.data()};
  const std::size_t done = add_forces_in_lanes<damped>(at, springs);
  add_forces_one_by_one<damped>(at, springs.data(), done, springs.size());
}

template <bool viscous>
void divide_by_mass(const SpringSystem& system, std::span<const Vector3d> v, std::span<Vector3d> a) {
  const Vector3d gravity = system.gravity;
  const double *const inverse_mass = system.inverse_mass.data(), *const viscosity = system.viscosity.data();
  const Vector3d* const velocity = v.data();
  Vector3d* const sum = a.data();
  for (std::size_t i = 0, count = a.size(); i < count; ++i) {
    if constexpr (viscous)
      sum[i] = (sum[i] - viscosity[i] * velocity[i]) * inverse_mass[i] + gravity;
    else
      sum[i] = sum[i] * inverse_mass[i] + gravity;
  }
}

}  // namespace

Terms terms_of(const SpringSystem& system) {
  const auto any = [](const auto& column) { return std::ranges::any_of(column, [](auto x) { return x != 0; }); };
  const auto is_damped = [](const Spring& s) { return s.damping != 0.0; };
  return {std::ranges::any_of(system.springs.damped(), is_damped) || has_damped_terms(system), any(system.viscosity),
          any(system.fixed)};
}

bool has_damped_terms(const SpringSystem& system) {
  return std::ranges::any_of(system.terms, [](const ForceTerm* term) { return term->damping() != nullptr; });
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
  for (const ForceTerm* term : system.terms) {
    term->add_forces({x}, a);
    if (terms.damping && term->damping() != nullptr) term->damping()->add_forces({x}, v, a);
  }
  terms.viscosity ? divide_by_mass<true>(system, v, a) : divide_by_mass<false>(system, v, a);
  for (std::size_t i = 0; i < system.pull.size(); ++i) a[i] += system.pull[i];
  free_along_axes(system, a);
  if (!terms.fixed) return;
  const std::uint8_t* const fixed = system.fixed.data();
  for (std::size_t i = 0; i < a.size(); ++i)
    if (fixed[i]) a[i].setZero();
}

double frequency_bound(const SpringSystem& system) {
  std::vector<double> sum(system.vertex_count(), 0.0);
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    for (const auto i : system.ends[s]) sum[i] += system.springs[s].stiffness;
  for (const ForceTerm* term : system.terms)
    term->for_each_constant_tangent([&sum](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
      // half of the sum of all blocks in a row of the piece: the sum is doubled below
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b)
          sum[nodes[a]] += 0.5 * std::abs(blocks[a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b](0, 0));
    });
  double highest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!system.fixed[i]) highest = max_or_nan(highest, 2.0 * sum[i] * system.inverse_mass[i]);
  return std::sqrt(highest);
}

}  // namespace dartboard
