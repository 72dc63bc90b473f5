#pragma once
// The diagnostics of a run at one moment: one row of diagnostics.csv.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dartboard {

/// The numbers of cells of each dimension; `cells` are the volumes of a solid, the faces of a surface.
struct CellCounts {
  std::size_t vertices = 0, edges = 0, faces = 0, cells = 0, components = 0;
  friend bool operator==(const CellCounts&, const CellCounts&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(vertices, edges, faces, cells, components);
  }
};

/// The part of a row about contact, with obstacles and between bodies.
struct ContactDiagnostics {
  double energy = 0;    // [J] of the contacts, no part of the elastic energy
  double damped = 0;    // [J] lost by restitution so far
  double rubbed = 0;    // [J] by friction
  double supplied = 0;  // [J] the work of moving obstacles, and of driven vertices against damping and friction
  std::size_t contacts = 0;
  double deepest = 0;  // [m]
  template <class Archive>
  void state(Archive& archive) {
    archive(energy, damped, rubbed, supplied, contacts, deepest);
  }
};

/// The part of a row about components that are not stepped.
struct SleepDiagnostics {
  std::size_t asleep = 0;            // components
  std::size_t slept = 0, woken = 0;  // so far, each component as often as it fell asleep or was woken
  double removed = 0;                // [J] kinetic energy of those that fell asleep, so far
  template <class Archive>
  void state(Archive& archive) {
    archive(asleep, slept, woken, removed);
  }
};

struct Diagnostics {
  double time = 0;                                     // [s]
  double kinetic = 0, elastic = 0, gravitational = 0;  // [J]
  Eigen::Vector3d momentum{0, 0, 0};                   // [kg m/s]
  Eigen::Vector3d angular_momentum{0, 0, 0};           // [kg m^2/s], about the origin
  double mass = 0;                                     // [kg]
  CellCounts counts;
  double boundary = 0;         // [m^2] area of the boundary surface; of a surface [m] length of its border
  double largest_stress = 0;   // [Pa] as stress_name says; of a surface [N/m], of a chain [N]
  std::size_t operations = 0;  // so far: faces dissociated, cells removed, vertices put in by refinement
  // [J] potential of the forces applied, - sum of f . x, if a scene has some; if some change in time, that of the start
  // less the work of all of them since
  std::optional<double> applied{};
  std::optional<ContactDiagnostics> contact{};  // where a scene has contact
  std::optional<SleepDiagnostics> sleep{};      // where components of a scene fall asleep

  double energy() const {
    return kinetic + elastic + gravitational + applied.value_or(0.0) + (contact ? contact->energy : 0.0);
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(time, kinetic, elastic, gravitational, momentum, angular_momentum, mass, counts, boundary, largest_stress,
            operations, applied, contact, sleep);
  }
};

bool is_finite(const Diagnostics& diagnostics);

/// The name of the largest stress of a body with cells of this dimension: "largest principal stress" (of a vertex); of
/// a chain (0) "largest tension" (of a link).
std::string_view stress_name(int dimension);

/// The units of the boundary and of the largest stress of a body with cells of this dimension: "m^2" and "Pa" of a
/// solid, "m" and "N/m" of a surface, "m" and "N" of a chain (0).
std::string_view boundary_unit(int dimension);
std::string_view stress_unit(int dimension);

/// The names of the columns, with units, and one row, with forces applied, contact and sleep or without; real numbers
/// with 17 digits, so that they can be read back exactly, and an empty field for a number that is not finite. Both end
/// with a line break.
std::string diagnostics_header(int dimension = 3, bool with_applied = false, bool with_contact = false,
                               bool with_sleep = false);
std::string diagnostics_row(const Diagnostics& diagnostics);

}  // namespace dartboard
