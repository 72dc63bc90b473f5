#pragma once
// The forces of a spring system on arrays; effects that a system does not have cost nothing in the loops.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/thread_team.h"
#include "core/time/system/force_shares.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Which parts of the mechanics act in a system.
struct Terms {
  bool damping = false;                                     // of some spring or some force term
  bool viscosity = false;                                   // on some vertex
  bool fixed = false;                                       // some vertex
  std::shared_ptr<const std::vector<ForceShare>> shares{};  // of threads; null for one

  /// Calls f(first, last) for ranges of the n vertices that are all of them together, by several threads at once if
  /// these have shares.
  template <class F>
  void for_each_share(std::size_t n, const F& f) const {
    if (is_shared()) {
      thread_team().run([&](unsigned thread) {
        const F own = f;
        own((*shares)[thread].own.first, (*shares)[thread].own.last);
      });
    } else {
      const F own = f;  // its captures stay in registers
      own(std::size_t{0}, n);
    }
  }
  /// What acts without damping and viscosity.
  Terms undamped() const { return {.fixed = fixed, .shares = shares}; }
  bool is_shared() const { return shares && shares->size() == threads_in_use(); }
  friend bool operator==(const Terms&, const Terms&) = default;
};
/// cost    O(springs + vertices); to be called once, not in every step
Terms terms_of(const SpringSystem& system);
/// Is any of its force terms damped?
bool has_damped_terms(const SpringSystem& system);

/// Accelerations [m/s^2] of all vertices at x, v, by as many threads as have shares: springs, force terms, gravity and
/// what `terms` says; zero where fixed, and along held axes.
///
/// Leaving damping and viscosity out of the terms gives the conservative part. Springs are added in the order of their
/// numbers with the operations of `spring_force` and `acceleration` (core/walks/spring_forces.h): the same bits.
/// pre     a.size() is the number of vertices; a aliases neither x nor v; v is read only for damping and viscosity
void accelerations(const SpringSystem& system, const Terms& terms, std::span<const Eigen::Vector3d> x,
                   std::span<const Eigen::Vector3d> v, std::span<Eigen::Vector3d> a);

/// An upper bound of the highest angular frequency [1/s] of the undamped system in any state where no spring is
/// compressed: Gershgorin's, max over i of sqrt(2 sum_j k_ij / m_i). 0 without springs. With force terms it is an
/// estimate, not a bound: their stiffness is that near rest.
double frequency_bound(const SpringSystem& system);

}  // namespace dartboard
