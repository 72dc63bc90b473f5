#pragma once
// A rigid ball pressed into an elastic half-space: the force by core's contact, compared with Hertz's.

#include <cstddef>

#include "core/plain/mesh.h"

namespace dartboard {

struct HertzCase {
  CellKind cells = CellKind::hexahedron;  // or tetrahedra
  int across = 6;                         // faces from the middle of the contact to its edge
  int exponent = 3;                       // of the law of contact
  double growth = 1.6;                    // of cells away from the contact, from one to the next
};

struct HertzResult {
  double force = 0.0;        // [N]
  double closed_form = 0.0;  // [N] 4/3 E / (1 - nu^2) sqrt(R) d^(3/2) at the way d of the surface below the ball
  double depth = 0.0;        // of the contact, which the law needs, over the way of the ball
  double moved = 0.0;        // in the last step, over the way of the ball: 0 at rest
  std::size_t contacts = 0;  // samples
  bool ended = false;        // every step succeeded

  double error() const { return force / closed_form - 1.0; }
};

/// The contact is twenty times smaller than the ball. The half-space is a quarter of a block between two planes of
/// symmetry, sixty times as wide as the contact, of stable neo-Hookean elements, small around the contact and larger
/// and larger beyond; backward Euler brings it to rest. Its law carries Hertz's largest pressure at a hundredth of the
/// way of the ball.
///
/// pre     across >= 2, growth > 1
/// cost    some seconds: 9,261 vertices with six faces, 5,832 if cells double
/// source  Hertz 1882; Johnson, Contact Mechanics, section 4.2
HertzResult press_ball(const HertzCase& one);

}  // namespace dartboard
