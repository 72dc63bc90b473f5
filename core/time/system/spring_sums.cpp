#include "core/time/system/spring_sums.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "core/time/system/spring_lanes.h"

namespace dartboard {
namespace {

template <bool damped, class Row, class SomeSpring>
void add_spring_forces(const SpringColumnsAt<Row>& at, std::span<const SomeSpring> springs) {
  const std::size_t done = add_forces_in_lanes<damped>(at, springs);
  add_forces_one_by_one<damped>(at, springs.data(), done, springs.size());
}

/// Adds the forces of the springs of a run, at the vertices within `own` alone.
template <bool damped, class Row, class SomeSpring>
void add_spring_forces(const SpringColumnsAt<Row>& at, std::span<const SomeSpring> springs, PieceRun run,
                       VertexRange own) {
  if (run.whole) {
    const SpringColumnsAt<Row> from_first{at.ends + run.first, at.x, at.v, at.force};
    return add_spring_forces<damped>(from_first, springs.subspan(run.first, run.last - run.first));
  }
  for (std::uint32_t s = run.first; s < run.last; ++s) {
    const auto [i, j] = at.ends[s];
    // the two ends as columns of their own, so that the operations are those of the other loops
    const SpringEnds ends{0, 1};
    const Row none(Eigen::Vector3d(0, 0, 0));
    const std::array<Row, 2> x{at.x[i], at.x[j]};
    std::array<Row, 2> v, force{own.contains(i) ? at.force[i] : none, own.contains(j) ? at.force[j] : none};
    if constexpr (damped) v = {at.v[i], at.v[j]};
    add_forces_one_by_one<damped>(SpringColumnsAt<Row>{&ends, x, v.data(), force.data()}, &springs[s], 0, 1);
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

}  // namespace

template <class Row>
void sum_spring_forces(const SpringSystem& system, const Terms& terms, std::span<const Row> x, std::span<const Row> v,
                       std::span<Row> force, bool are_zero) {
  const SpringColumnsAt<Row> at{system.ends.data(), x, v.data(), force.data()};
  const auto clear = [=](std::size_t first, std::size_t last) {
    if (!are_zero) std::fill(force.begin() + first, force.begin() + last, Row(Eigen::Vector3d(0, 0, 0)));
  };
  if (!terms.is_shared()) {
    clear(0, force.size());
    with_springs(system, terms,
                 [&]<class Damped>(Damped, auto springs) { add_spring_forces<Damped::value>(at, springs); });
    return;
  }
  thread_team().run([&](unsigned thread) {
    const ForceShare& share = (*terms.shares)[thread];
    clear(share.own.first, share.own.last);
    with_springs(system, terms, [&]<class Damped>(Damped, auto springs) {
      for (const PieceRun run : share.springs) add_spring_forces<Damped::value>(at, springs, run, share.own);
    });
  });
}

template void sum_spring_forces(const SpringSystem&, const Terms&, std::span<const Eigen::Vector3d>,
                                std::span<const Eigen::Vector3d>, std::span<Eigen::Vector3d>, bool);
template void sum_spring_forces(const SpringSystem&, const Terms&, std::span<const PaddedVector>,
                                std::span<const PaddedVector>, std::span<PaddedVector>, bool);

}  // namespace dartboard
