#pragma once
// Some of the vertices of a spring system as a system of their own.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/time/system/spring_system.h"

namespace dartboard {

/// Copies of the columns of some vertices, of the springs between them, and of the force terms at them. Springs and
/// pieces keep their order, so the forces have the bits that they have in the whole system.
class SystemPart {
 public:
  /// The vertices in the order that they have here; `terms` are those of the whole that are taken.
  ///
  /// pre     each spring and piece has all of its vertices among them, or none
  /// throws  InputError for a term that cannot be taken in parts
  /// cost    O(vertices + springs + pieces) of the whole
  SystemPart(const SpringSystem& whole, ForceTerms terms, std::vector<std::uint32_t> vertices);
  SystemPart(const SystemPart&) = delete;  // terms refer to columns in place
  SystemPart& operator=(const SystemPart&) = delete;

  /// Their numbers in the whole.
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  VertexSubset subset() const { return {number_}; }
  /// One more term, by the numbers here; it outlives this.
  void add(const ForceTerm& term) { terms_.push_back(&term); }

  SpringSystem system() const;
  Motion motion() { return {x_, v_}; }
  /// Take places, velocities and pulls from columns of the whole.
  void take(Motion whole, std::span<const Eigen::Vector3d> pull);
  /// Put places and velocities into columns of the whole.
  void give(Motion whole) const;

  std::size_t bytes() const;

 private:
  /// Vertices that follow each other here and in the whole.
  struct Run {
    std::uint32_t first, whole, count;
  };

  std::vector<std::uint32_t> vertices_, number_;
  std::vector<Run> runs_;
  std::vector<SpringEnds> ends_;
  // Of the two that the whole has, as the loop over damped springs rounds otherwise even without a damped one.
  std::vector<Spring> springs_;
  std::vector<UndampedSpring> undamped_;
  std::vector<double> mass_, inverse_mass_, viscosity_;
  std::vector<std::uint8_t> fixed_;
  std::vector<HeldAxes> held_axes_;
  std::vector<Eigen::Vector3d> pull_, x_, v_;
  Eigen::Vector3d gravity_;
  std::vector<TermOfPart> own_;
  std::vector<const ForceTerm*> terms_;
};

}  // namespace dartboard
