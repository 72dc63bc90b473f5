#pragma once
// The longest stable step of explicit integrators, measured by runs, compared with that of their schemes.

#include <span>
#include <string>
#include <vector>

#include "core/plain/mesh.h"
#include "core/time/integrators.h"
#include "validation/scenes/extreme_bodies.h"

namespace dartboard {

/// One limit, in units of 1 / omega_max.
struct StabilityLimit {
  std::string body, integrator;
  double zeta = 0.0;      // damping ratio at omega_max
  double theory = 0.0;    // for runs as long as these
  double measured = 0.0;  // 0 if there is none within 1 % below and 0.6 % above the theory
  double tolerance = 0.0;

  bool holds() const;
};

/// Oscillator, chain (frequencies in closed form) and two small meshes (frequency_oracle.h), five damping ratios, every
/// explicit integrator. For runs of N steps the limit is where the first oscillation grows by 1e3: rho^N = 1e3, which
/// reveals even weak growth. Limits above 20 are left out, and those of damped networks by symplectic Euler, whose
/// scheme is defined for one damper only.
std::vector<StabilityLimit> measure_stability_limits(bool quick,
                                                     std::span<const IntegratorEntry> entries = integrators());

/// A body made from a mesh, with the knowledge of its highest frequency.
struct MeshBody {
  std::string name{};
  SpringColumns body{};
  double omega = 0.0, error = 0.0;  // [1/s] by Lanczos, and the error bound
  bool proven = false;
  double lower = 0.0, upper = 0.0;       // [1/s] StableStepEstimate's bracket of it
  double rise = 1.0;                     // omega over that before the operations
  std::vector<Eigen::Vector3d> shape{};  // of the fastest mode [m]
};

/// The body of a mesh, at rest and undamped, and the same after random dissociations of faces and removals of volumes,
/// one removal in ten operations.
std::vector<MeshBody> mesh_bodies(const std::string& name, const Mesh& mesh, int operations, std::uint64_t seed);

/// The limits on them, undamped and damped; quick ones are undamped and of shorter runs.
std::vector<StabilityLimit> measure_mesh_limits(std::span<const MeshBody> bodies, bool quick,
                                                std::span<const IntegratorEntry> entries = integrators());

}  // namespace dartboard
