#pragma once
// The materials of bodies and what acts on them; shared by core and reference, SI units.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace dartboard {

/// The model by which a body resists deformation.
enum class Model : std::uint8_t { springs, neo_hookean, corotational, stvk };
/// "springs", "neo-hookean", "corotational", "stvk"
inline constexpr std::array<std::string_view, 4> model_names{"springs", "neo-hookean", "corotational", "stvk"};
constexpr std::string_view name(Model model) { return model_names[static_cast<std::size_t>(model)]; }

/// A homogeneous mass/spring material (section 4.1). Every cell contributes `stiffness` and `damping` to each of its
/// edges, so springs of shared edges add up like springs in parallel. With a Young's modulus, a cell of volume V (area,
/// length) contributes young V / l^2 to its edge of rest length l instead; `stiffness` is then the mean of that over
/// the edges of all cells (core/base/young.h), and damping is in proportion.
///
/// With a model other than springs the cells are elements of an elastic solid of this Young's modulus and Poisson's
/// ratio (core/elements/elastic_laws.h): there are no springs, and damping is by viscosity and by `damping_time`
/// (core/elements/strain_damping.h).
struct Material {
  double density = 1000.0;  // kg/m^3 (kg/m^2 for a surface)
  double stiffness = 50.0;  // N/m, per incident cell
  double damping = 0.01;    // N s/m along the spring, per incident cell
  double viscosity = 0.1;   // 1/s: the ambient drag on a vertex is viscosity * mass * velocity
  double young = 0.0;       // Pa (N/m for a surface, N for a chain); 0: edges have `stiffness`
  double poisson = 0.25;    // of elements
  Model model = Model::springs;
  double damping_time = 0.0;  // s, of elements: their stress is that of the strain plus this times its rate
  double width = 0.0;         // m, of a chain: its links touch obstacles as strips of this width
};

/// The damping time [s] that gives elements this damping ratio at this frequency [Hz]. An oscillation of omega [1/s]
/// has a damping ratio of omega times half of it: in proportion to the frequency.
inline double damping_time_of(double ratio, double frequency) { return ratio / (std::numbers::pi * frequency); }

/// The effects on the whole body.
struct Surroundings {
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};  // m/s^2
};

}  // namespace dartboard
