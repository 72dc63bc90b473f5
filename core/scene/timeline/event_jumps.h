#pragma once
// The sums that an event which only dissociates must not change, measured before and after it.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "core/scene/body/simulated_body.h"

namespace dartboard {

/// Sums over a body that no dissociation changes, and the energy of its contacts.
struct KeptSums {
  double mass, stiffness;    // [kg] of all vertices, [N/m] of all springs: m = m1 + m2 and k = k1 + k2 at each split
  double energy;             // [J] kinetic and elastic
  double contact;            // [J] of contacts: a dissociation changes it where it makes new places of the boundary
  Eigen::Vector3d momentum;  // [kg m/s]
  double size_of_momentum;   // [kg m/s] the sum of m |v|
};
KeptSums kept_sums(const SimulatedBody& body);

/// The largest changes of these sums by events that only dissociate, over all such events.
struct EventJumps {
  std::uint64_t events = 0;  // that dissociated
  double mass = 0.0;         // relative to the mass before
  double stiffness = 0.0;    // relative to the stiffness before
  double momentum = 0.0;     // relative to the sum of m |v| before
  double energy = 0.0;       // kinetic and elastic, relative to their sum before
  double contact = 0.0;      // of contacts, relative to the same sum

  /// Add another event. A NaN stays.
  void add(const KeptSums& before, const KeptSums& after);
  template <class Archive>
  void state(Archive& archive) {
    archive(events, mass, stiffness, momentum, energy, contact);
  }
};

/// Apply an event to its body, and add the changes of the sums if it did anything.
///
/// returns  operations, as ReadyEvent::apply
std::size_t apply_watched(ReadyEvent& event, const SimulatedBody& body, EventJumps& jumps);

}  // namespace dartboard
