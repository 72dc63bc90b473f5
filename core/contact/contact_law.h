#pragma once
// The law of one pair that touches: the load at each depth, and the losses.

namespace dartboard {

/// A pressure that grows with the depth d [m] to the power exponent - 1, from zero where the surfaces just touch:
/// P = P0 (d / delta)^(p-1). A user needs to know which pressure the contact has to carry at which depth.
///
/// It uses no libm except sqrt, so that motions have the same bits on every platform; numbers only printed use cbrt.
/// units   area [m^2] of the boundary at rest that a sample stands for
/// pre     pressure, depth > 0; exponent 2, 3 or 4; 0 < restitution <= 1; friction, mass_behind >= 0
struct ContactLaw {
  double pressure = 0.0;     // P0 [Pa], at ...
  double depth = 0.0;        // delta [m]
  int exponent = 3;          // p of the energy; integrators are of no higher order than p through a contact
  double restitution = 1.0;  // e: the share of the normal speed left after a bounce, at any speed
  double friction = 0.0;     // mu of Coulomb
  // [kg/m^2] behind the surface that the contact has to stop, rho H of a column of height H: a body that is stiff
  // against its contact, with that much mass behind each part that touches, has exactly that restitution.
  // 0: the vertices of each sample alone, which is exact for free vertices.
  double mass_behind = 0.0;

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

  /// zeta of e = exp(- pi zeta / sqrt(1 - zeta^2)); 0 for e = 1. Exact to a few roundings, without libm.
  double damping_ratio() const;
  /// c(d) [kg/s] of force c times speed, with `mass` [kg] behind: zeta sqrt(2 p m kappa) d^(p/2-1), where
  /// a P0 delta / p (d / delta)^p = kappa / p d^p. A mass that bounces alone then has the same restitution at any
  /// speed.
  ///
  /// source  Feng, arXiv 2604.02533
  double damping(double area, double mass, double d) const { return damping(damping_ratio(), area, mass, d); }
  /// The same with zeta known.
  double damping(double ratio, double area, double mass, double d) const;
};

}  // namespace dartboard
