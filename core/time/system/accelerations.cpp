#include "core/time/system/accelerations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/forces/term_damping.h"
#include "core/plain/nan_maximum.h"
#include "core/time/system/spring_lanes.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

using Columns = SpringColumnsAt;

template <bool damped, class SomeSpring>
void add_spring_forces(const Columns& at, std::span<const SomeSpring> springs) {
  const std::size_t done = add_forces_in_lanes<damped>(at, springs);
  add_forces_one_by_one<damped>(at, springs.data(), done, springs.size());
}

/// The same of the springs of a run, at the vertices within `own` alone.
template <bool damped, class SomeSpring>
void add_spring_forces(const Columns& at, std::span<const SomeSpring> springs, PieceRun run, VertexRange own) {
  if (run.whole) {
    const Columns from_first{at.ends + run.first, at.x, at.v, at.force};
    return add_spring_forces<damped>(from_first, springs.subspan(run.first, run.last - run.first));
  }
  for (std::uint32_t s = run.first; s < run.last; ++s) {
    const auto [i, j] = at.ends[s];
    // the two ends as columns of their own, so that the operations are those of the other loops
    const SpringEnds ends{0, 1};
    const std::array<Vector3d, 2> x{at.x[i], at.x[j]};
    std::array<Vector3d, 2> v,
        force{own.contains(i) ? at.force[i] : Vector3d(0, 0, 0), own.contains(j) ? at.force[j] : Vector3d(0, 0, 0)};
    if constexpr (damped) v = {at.v[i], at.v[j]};
    add_forces_one_by_one<damped>({&ends, x, v.data(), force.data()}, &springs[s], 0, 1);
    if (own.contains(i)) at.force[i] = force[0];
    if (own.contains(j)) at.force[j] = force[1];
  }
}

/// Calls f with a boolean constant, whether damping counts, and the springs.
template <class F>
void with_springs(const SpringSystem& system, const Terms& terms, const F& f) {
  const SpringSpan& springs = system.springs;
  if (springs.damped().empty())
    f(std::false_type(), springs.undamped());
  else if (terms.damping)
    f(std::true_type(), springs.damped());
  else
    f(std::false_type(), springs.damped());
}

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

/// By all threads that have shares: what adds in parts by each in its share, and the rest by one, in the same order.
void add_forces_in_shares(const SpringSystem& system, const Terms& terms, std::span<const Vector3d> x,
                          std::span<const Vector3d> v, std::span<Vector3d> a) {
  const std::vector<ForceShare>& shares = *terms.shares;
  const auto add_in_parts = [&](std::size_t term) {
    thread_team().run([&](unsigned thread) {
      for (const PieceRun run : shares[thread].pieces[term])
        system.terms[term]->add_forces_in_part({x}, run, shares[thread].own, a);
    });
  };
  thread_team().run([&](unsigned thread) {
    const ForceShare& share = shares[thread];
    std::fill(a.begin() + share.own.first, a.begin() + share.own.last, Vector3d(0, 0, 0));
    with_springs(system, terms, [&]<class Damped>(Damped, auto springs) {
      const Columns at{system.ends.data(), x, v.data(), a.data()};
      for (const PieceRun run : share.springs) add_spring_forces<Damped::value>(at, springs, run, share.own);
    });
  });
  for (std::size_t k = 0; k < system.terms.size(); ++k) {
    const ForceTerm* term = system.terms[k];
    term->adds_in_parts() ? add_in_parts(k) : term->add_forces({x}, a);
    if (terms.damping && term->damping() != nullptr) term->damping()->add_forces({x}, v, a);
  }
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
  if (terms.is_shared()) {
    add_forces_in_shares(system, terms, x, v, a);
  } else {
    std::ranges::fill(a, Vector3d(0, 0, 0));
    with_springs(system, terms, [&]<class Damped>(Damped, auto springs) {
      add_spring_forces<Damped::value>({system.ends.data(), x, v.data(), a.data()}, springs);
    });
    for (const ForceTerm* term : system.terms) {
      term->add_forces({x}, a);
      if (terms.damping && term->damping() != nullptr) term->damping()->add_forces({x}, v, a);
    }
  }
  terms.for_each_share(a.size(),
                       [&](std::size_t first, std::size_t last) { finish(system, terms, v, a, first, last); });
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
