#pragma once
// Small bodies that can be made hostile.

#include <string_view>

#include "core/plain/material.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// "oscillator": a mass on a spring at a wall. "chain": twelve masses between two walls. "box": 2 x 2 x 2 jittered
/// cubes of tetrahedra. "sheet": 4 x 4 squares of triangles. Edges of about 1 m, masses of 1 kg, springs of 100 N/m per
/// cell. At rest; oscillator and chain lie on the x axis.
///
/// throws  InputError for another name
SpringColumns extreme_body(std::string_view name);
inline constexpr std::string_view extreme_bodies[]{"oscillator", "chain", "box", "sheet"};

/// A material of density 1 kg/m^3, undamped; springs share the modulus `young` [Pa] as elements have it.
Material elastic_material(Model model, double poisson = 0.3, double young = 100.0);

/// A jittered box of 2 x 1 x 1 cubes of edge 1 m: twelve tetrahedra, or two hexahedra; each cell's mass in equal parts
/// at its corners. The second half of the cells is of `other`, and of this thickness along x [m] at rest. Cells are
/// elements of their material or, where its model is springs, have springs along their edges. At rest.
///
/// throws  InputError for another name
SpringColumns elastic_body(std::string_view name, const Material& material, const Material& other,
                           double thickness = 1.0);
inline SpringColumns elastic_body(std::string_view name, const Material& material) {
  return elastic_body(name, material, material);
}
inline constexpr std::string_view elastic_bodies[]{"tetrahedra", "hexahedra"};

/// Displace the free vertices by up to `size` edge lengths and set them moving at up to `size` times omega edge lengths
/// per second; along the x axis only for bodies on it.
void set_moving(SpringColumns& body, double size, double omega);

}  // namespace dartboard
