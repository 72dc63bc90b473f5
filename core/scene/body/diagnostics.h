#pragma once
// What a run reports about itself at a moment: one row of diagnostics.csv.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>

namespace dartboard {

/// How many cells of each dimension there are; `cells` are the volumes of a solid, the faces of a surface.
struct CellCounts {
  std::size_t vertices = 0, edges = 0, faces = 0, cells = 0, components = 0;
  friend bool operator==(const CellCounts&, const CellCounts&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(vertices, edges, faces, cells, components);
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

  double energy() const { return kinetic + elastic + gravitational; }
  template <class Archive>
  void state(Archive& archive) {
    archive(time, kinetic, elastic, gravitational, momentum, angular_momentum, mass, counts, boundary, largest_stress,
            operations);
  }
};

bool is_finite(const Diagnostics& diagnostics);

/// What the largest stress of a body of cells of a dimension is: the "largest principal stress" of a vertex; of a chain
/// (0) the "largest tension" of a link.
std::string_view stress_name(int dimension);

/// What the boundary and the largest stress of a body of cells of a dimension are in: "m^2" and "Pa" of a solid, "m"
/// and "N/m" of a surface, "m" and "N" of a chain (0).
std::string_view boundary_unit(int dimension);
std::string_view stress_unit(int dimension);

/// The names of the columns, with units, and one row; real numbers with 17 digits, so that they can be read back
/// exactly, and an empty field for what is not finite. Both end with a line break.
std::string diagnostics_header(int dimension = 3);
std::string diagnostics_row(const Diagnostics& diagnostics);

}  // namespace dartboard
