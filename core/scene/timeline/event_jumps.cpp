#include "core/scene/timeline/event_jumps.h"

#include <cmath>

#include "core/plain/nan_maximum.h"
#include "core/time/system/energy.h"

namespace dartboard {

KeptSums kept_sums(const SimulatedBody& body) {
  SpringSystem system = body.system();
  const VertexColumns& v = body.vertices();
  const ForceTerms others = body.terms_but_contact(system.terms);
  double contact = 0.0, size = 0.0;
  for (const ForceTerm* term : system.terms.subspan(others.size())) contact += term->energy(v.position);
  system.terms = others;
  // in extended precision: a missing share is to be found, and not the rounding by another order of summation
  long double mass = 0.0L, stiffness = 0.0L;
  for (std::size_t k = 0; k < v.size(); ++k) {
    size += v.mass[k] * v.velocity[k].norm();
    mass += v.mass[k];
  }
  for (const Spring spring : system.springs) stiffness += spring.stiffness;
  return {.mass = static_cast<double>(mass),
          .stiffness = static_cast<double>(stiffness),
          .energy = kinetic_energy(system, v.velocity) + elastic_energy(system, v.position),
          .contact = contact,
          .momentum = linear_momentum(system, v.velocity),
          .size_of_momentum = size};
}

void EventJumps::add(const KeptSums& before, const KeptSums& after) {
  const auto relative = [](double change, double scale) { return change == 0.0 ? 0.0 : std::abs(change) / scale; };
  ++events;
  mass = max_or_nan(mass, relative(after.mass - before.mass, before.mass));
  stiffness = max_or_nan(stiffness, relative(after.stiffness - before.stiffness, before.stiffness));
  momentum = max_or_nan(momentum, relative((after.momentum - before.momentum).norm(), before.size_of_momentum));
  energy = max_or_nan(energy, relative(after.energy - before.energy, before.energy));
  contact = max_or_nan(contact, relative(after.contact - before.contact, before.energy));
}

std::size_t apply_watched(ReadyEvent& event, const SimulatedBody& body, EventJumps& jumps) {
  const KeptSums before = kept_sums(body);
  const std::size_t made = event.apply();
  if (made > 0) jumps.add(before, kept_sums(body));
  return made;
}

}  // namespace dartboard
