#pragma once
// Small bodies in columns of their own, that can be made hostile.

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/time/spring_system.h"

namespace dartboard {

/// Owns what a SpringSystem and a Motion show.
struct SpringColumns {
  std::vector<SpringEnds> ends;
  std::vector<Spring> springs;
  std::vector<double> mass, inverse_mass, viscosity;
  std::vector<std::uint8_t> fixed;
  Eigen::Vector3d gravity{0, 0, 0};
  std::vector<Eigen::Vector3d> x, v;

  SpringSystem system() const { return {ends, springs, mass, inverse_mass, viscosity, fixed, gravity}; }
  Motion motion() { return {x, v}; }
  void set_mass(std::size_t vertex, double value) {
    mass[vertex] = value;
    inverse_mass[vertex] = 1.0 / value;
  }
};

/// "oscillator": a mass on a spring at a wall. "chain": twelve masses between two walls. "box": 2 x 2 x 2 jittered
/// cubes of tetrahedra. "sheet": 4 x 4 squares of triangles. Edges of about 1 m, masses of 1 kg, springs of 100 N/m per
/// cell. At rest; oscillator and chain lie on the x axis.
///
/// throws  InputError for another name
SpringColumns extreme_body(std::string_view name);
inline constexpr std::string_view extreme_bodies[]{"oscillator", "chain", "box", "sheet"};

/// Displace and set going the free vertices, by up to `size` edge lengths and `size` times omega of them per second;
/// along the x axis only for bodies on it.
void set_moving(SpringColumns& body, double size, double omega);

}  // namespace dartboard
