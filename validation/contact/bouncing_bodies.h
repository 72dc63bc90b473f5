#pragma once
// Bodies that bounce off a floor, or that a floor leaves: the restitution found, and what contact must not do.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// A body that falls flat, at 0.2 m/s and without gravity, on a floor whose law carries 2 kPa at 2 mm.
struct BouncingBody {
  std::string_view name;
  std::string_view json;  // members 'body' and 'material' of its scene
  double stiffness;       // of the body over its height, over the largest of the contact; infinite for loose vertices
};
std::span<const BouncingBody> bouncing_bodies();

struct BounceFound {
  std::string_view body, integrator;
  int order = 0;  // of the integrator; 1 if it keeps earlier steps, as it begins anew in each of a bounce
  double asked = 0.0, found = 0.0;  // restitution: of the mean speed before and after
  double pulled =
      0.0;  // the largest loss of mean speed upwards in a step in which a floor leaves, over the speed of leaving
  bool ended = false;  // regularly, and off the floor
};

/// One body by one integrator: thrown at the floor; and put 1 mm into a floor that leaves at 1 m/s.
///
/// cost  some 1000 steps of at most 30 vertices
BounceFound bounce_body(const BouncingBody& body, std::string_view integrator, double restitution);

}  // namespace dartboard
