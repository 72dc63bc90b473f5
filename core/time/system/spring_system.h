#pragma once
// The mechanics as the time loop uses them: contiguous columns, no map and no dart.

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <span>

#include "core/forces/force_term.h"
#include "core/forces/springs.h"
#include "core/plain/held_axes.h"

namespace dartboard {

/// A column that may be left out: it is zero everywhere then, and takes no memory.
template <class T>
class OptionalColumn {
 public:
  OptionalColumn() = default;
  template <class Column>
  requires std::convertible_to<const Column&, std::span<const T>> OptionalColumn(const Column& column)
      : column_(column) {}

  bool empty() const { return column_.empty(); }
  T operator[](std::size_t i) const { return column_.empty() ? T{} : column_[i]; }
  std::span<const T> span() const { return column_; }
  /// Null where it is left out.
  const T* data() const { return column_.data(); }
  auto begin() const { return column_.begin(); }
  auto end() const { return column_.end(); }

 private:
  std::span<const T> column_;
};

/// All effects on a set of vertices: springs between them, other force terms, ambient viscosity, gravity (the formulas:
/// core/plain/problem.h), and forces from outside, each as an acceleration of its vertex.
///
/// A view of columns that the body owns; valid until they change their size. Columns are by vertex number or by spring
/// number.
struct SpringSystem {
  std::span<const SpringEnds> ends;
  SpringSpan springs;
  std::span<const double> mass;             // [kg]
  std::span<const double> inverse_mass;     // [1/kg]
  OptionalColumn<double> viscosity;         // [kg/s]
  OptionalColumn<std::uint8_t> fixed;       // 1: held still
  Eigen::Vector3d gravity{0, 0, 0};         // [m/s^2]
  std::span<const Eigen::Vector3d> pull{};  // [m/s^2] of each vertex, besides gravity; empty where nothing pulls
  ForceTerms terms{};                       // the forces other than springs
  OptionalColumn<HeldAxes> held_axes{};     // of vertices that keep their velocity along some axes; 0 where fixed

  std::size_t vertex_count() const { return mass.size(); }
};

/// Set to zero the components along held axes in a column by vertex.
inline void free_along_axes(const SpringSystem& system, std::span<Eigen::Vector3d> column) {
  if (system.held_axes.empty()) return;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (const HeldAxes held = system.held_axes[i]; held != 0) column[i] = free_part(held, column[i]);
}

/// Positions [m] and velocities [m/s] by vertex number, which an integrator advances in place.
struct Motion {
  std::span<Eigen::Vector3d> x, v;
};

}  // namespace dartboard
