#pragma once
// The gains by two implicit methods: energy that does not drift at large steps, and factors that are kept.

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/time/method/integrator.h"

namespace dartboard {

/// The energy-momentum scheme on a body that moves freely, undamped, and is cut along a plane half way.
struct ConservedDrift {
  std::uint64_t steps = 0;
  double h_omega = 0.0;
  std::size_t vertices_before = 0, vertices_after = 0;  // the cut
  double drift = 0.0;     // the largest |H - H0| / H0 after any step; H is kinetic and elastic
  std::string diagnosis;  // of the step that failed
};
ConservedDrift measure_energy_drift(std::uint64_t steps, double h_omega);
/// The drift of another method.
ConservedDrift measure_energy_drift(std::uint64_t steps, double h_omega, Integrator& integrator);

/// Backward Euler on the paper's body with a tenth of its tetrahedra 10^4 times stiffer, damped: a matrix factored for
/// every linear system, and one factor kept as long as it serves.
struct KeptFactor {
  std::uint64_t steps = 0;
  std::uint64_t fresh = 0, kept = 0;  // factorisations
  double difference = 0.0;            // [edges] between the two motions (reference/error_norms.h, x)
  double step_error = 0.0;            // [edges] between steps of h and of h/2: the error of the method itself
  std::string diagnosis;              // of a step that failed
};
/// `meshes` is the folder of liver564.mesh.
///
/// throws  IoError if the mesh cannot be read
KeptFactor compare_kept_factor(std::uint64_t steps, const std::filesystem::path& meshes);

}  // namespace dartboard
