#pragma once
// The longest stable step of explicit integrators, found by runs, beside the one that their schemes promise.

#include <string>
#include <vector>

namespace dartboard {

/// One limit, in units of 1 / omega_max.
struct StabilityLimit {
  std::string body, integrator;
  double zeta = 0.0;      // damping ratio at omega_max
  double theory = 0.0;    // for runs as long as these
  double measured = 0.0;  // 0 if there is none within 1 % below and 0.4 % above the theory
  double tolerance = 0.0;

  bool holds() const;
};

/// Oscillator, chain (frequencies in closed form) and two meshes (power iteration until it stands still), five damping
/// ratios, every explicit integrator. Of runs of N steps the limit is where the first oscillation grows by 1e3:
/// rho^N = 1e3, which tells even weak growth. Limits above 20 are left out, and those of damped networks by
/// symplectic Euler, whose scheme speaks of one damper only.
std::vector<StabilityLimit> measure_stability_limits(bool quick);

}  // namespace dartboard
