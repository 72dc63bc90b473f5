#include "core/time/system/accelerations.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/forces/term_damping.h"
#include "core/plain/nan_maximum.h"
#include "core/time/system/spring_sums.h"
#include "core/time/system/term_tangents.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

template <bool viscous>
void divide_by_mass(const SpringSystem& system, std::span<const Vector3d> v, std::span<Vector3d> a, std::size_t first,
                    std::size_t last) {
  const Vector3d gravity = system.gravity;
  const double *const inverse_mass = system.inverse_mass.data(), *const viscosity = system.viscosity.data();
  const Vector3d* const velocity = v.data();
  Vector3d* const sum = a.data();
  for (std::size_t i = first; i < last; ++i) {
    if constexpr (viscous)
      sum[i] = (sum[i] - viscosity[i] * velocity[i]) * inverse_mass[i] + gravity;
    else
      sum[i] = sum[i] * inverse_mass[i] + gravity;
  }
}

/// From the sum of forces to the acceleration, for the vertices from `first` to before `last`.
void finish(const SpringSystem& system, const Terms& terms, std::span<const Vector3d> v, std::span<Vector3d> a,
            std::size_t first, std::size_t last) {
  terms.viscosity ? divide_by_mass<true>(system, v, a, first, last) : divide_by_mass<false>(system, v, a, first, last);
  if (!system.pull.empty())
    for (std::size_t i = first; i < last; ++i) a[i] += system.pull[i];
  if (!system.held_axes.empty())
    for (std::size_t i = first; i < last; ++i)
      if (const HeldAxes held = system.held_axes[i]; held != 0) a[i] = free_part(held, a[i]);
  if (!terms.fixed) return;
  const std::uint8_t* const fixed = system.fixed.data();
  for (std::size_t i = first; i < last; ++i)
    if (fixed[i]) a[i].setZero();
}

/// What adds its forces in parts: by all threads, each in its share.
void add_in_shares(const ForceTerm& term, std::size_t number, const std::vector<ForceShare>& shares,
                   std::span<const Vector3d> x, std::span<Vector3d> a) {
  thread_team().run([&](unsigned thread) {
    for (const PieceRun run : shares[thread].pieces[number]) term.add_forces_in_part({x}, run, shares[thread].own, a);
  });
}

}  // namespace

Terms terms_of(const SpringSystem& system) {
  const auto any = [](const auto& column) { return std::ranges::any_of(column, [](auto x) { return x != 0; }); };
  const auto is_damped = [](const Spring& s) { return s.damping != 0.0; };
  return {std::ranges::any_of(system.springs.damped(), is_damped) || has_damped_terms(system), any(system.viscosity),
          any(system.fixed), [&]() -> std::shared_ptr<const std::vector<ForceShare>> {
            auto shares = share_forces(system);
            return shares.empty() ? nullptr : std::make_shared<const std::vector<ForceShare>>(std::move(shares));
          }()};
}

bool has_damped_terms(const SpringSystem& system) {
  return std::ranges::any_of(system.terms, [](const ForceTerm* term) { return term->damping() != nullptr; });
}

void accelerations(const SpringSystem& system, const Terms& terms, std::span<const Vector3d> x,
                   std::span<const Vector3d> v, std::span<Vector3d> a) {
  sum_spring_forces(system, terms, x, v, a);
  for (std::size_t k = 0; k < system.terms.size(); ++k) {
    const ForceTerm& term = *system.terms[k];
    if (terms.is_shared() && term.adds_in_parts())
      add_in_shares(term, k, *terms.shares, x, a);
    else
      term.add_forces({x}, a);
    if (terms.damping && term.damping() != nullptr) term.damping()->add_forces({x}, v, a);
  }
  terms.for_each_share(a.size(),
                       [&](std::size_t first, std::size_t last) { finish(system, terms, v, a, first, last); });
}

double frequency_bound(const SpringSystem& system) {
  std::vector<double> sum(system.vertex_count(), 0.0);
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    for (const auto i : system.ends[s]) sum[i] += system.springs[s].stiffness;
  for (const ForceTerm* term : system.terms)
    term->for_each_constant_tangent(add_row_sums(sum, 0.5));  // the sum is doubled below
  double highest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!system.fixed[i]) highest = max_or_nan(highest, 2.0 * sum[i] * system.inverse_mass[i]);
  return std::sqrt(highest);
}

}  // namespace dartboard
