#pragma once
// The law of one pair that touches: the load at each depth, and the losses.

namespace dartboard {

/// A pressure that grows with the depth d [m] to the power exponent - 1, from zero where the surfaces just touch:
/// P = P0 (d / delta)^(p-1). A user needs to know which pressure the contact has to carry at which depth.
///
/// It uses no libm except sqrt, so that motions have the same bits on every platform; numbers only printed use cbrt.
/// units   area [m^2] of the boundary at rest that a sample stands for
/// pre     pressure, depth > 0; exponent 2, 3 or 4; 0 < restitution <= 1; friction >= 0
struct ContactLaw {
  double pressure = 0.0;     // P0 [Pa], at ...
  double depth = 0.0;        // delta [m]
  int exponent = 3;          // p of the energy; integrators are of no higher order than p through a contact
  double restitution = 1.0;  // e: the share of the normal speed left after a bounce, at any speed and for any mass
  double friction = 0.0;     // mu of Coulomb

  /// throws  InputError naming the number, its value and what is expected
  void require_valid() const;

  /// a P0 delta / p (d / delta)^p [J]; 0 for d <= 0.
  double energy(double area, double d) const;
  /// a P0 (d / delta)^(p-1) [N].
  double force(double area, double d) const;
  /// (p - 1) a P0 / delta (d / delta)^(p-2) [N/m]; 0 for d <= 0, also for p = 2.
  double stiffness(double area, double d) const;
  /// The quotient of the changes of energy and depth [N], without cancellation and exact for equal depths: the force of
  /// a discrete gradient.
  double mean_force(double area, double d0, double d1) const;

  /// The depth at rest under this pressure [Pa], rho g H of a column: delta (P / P0)^(1/(p-1)) [m].
  double depth_at_rest(double load) const;
  /// The depth that a body reaches with this energy per area [J/m^2] without loss, rho H v^2 / 2 of a column at speed
  /// v: delta (p E / (P0 delta))^(1/p) [m].
  double depth_at_impact(double energy_per_area) const;

  /// s >= 0, the root of s - ln(1 + s) = - s e - ln(1 - s e), to some roundings, without libm. The force of a contact
  /// whose depth changes at the rate r, and first did at the rate r0, is that of its depth times max(0, 1 + s r / r0):
  /// it never pulls. A mass m in it moves by m r dr / (1 + s r / r0) = - force(d) dd; integrated on the way in and on
  /// the way out, the right side is the same energy, whatever m, r0 and the exponent are, and the left side is the
  /// equation.
  ///
  /// source  the form of the force: Hunt and Crossley, J. Appl. Mech. 42 (1975)
  double loss() const;
};

}  // namespace dartboard
