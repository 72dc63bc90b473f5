#pragma once
// The damping of a force term: the energy that its pieces lose by deformation, independent of rigid motion.

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/forces/force_term.h"
#include "core/forces/mobility.h"

namespace dartboard {

/// Forces - C v, with C a function of the positions: symmetric, positive semidefinite, and but for viscosities zero for
/// every rigid motion, so that linear and angular momentum stay.
///
/// The C of a piece is `time` times a stiffness, that of its material without stress; or it is a viscosity.
/// cost    O(pieces) unless stated otherwise
class TermDamping {
 public:
  using Nodes = ForceTerm::Nodes;
  using VisitTangent = ForceTerm::VisitTangent;

  virtual ~TermDamping() = default;

  /// The damping time of a piece [s]; 0 where it is not damped.
  virtual double time(std::size_t piece) const = 0;
  /// Is C no multiple of a stiffness, but a viscosity, which damps rigid motions too? Then `time` is 1 s.
  virtual bool is_viscous() const { return false; }

  /// force -= C v [N] at these places.
  virtual void add_forces(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                          std::span<Eigen::Vector3d> force) const = 0;
  /// size[i] += a bound of the terms of the force at i [N]: eps times it bounds the rounding error of the force.
  virtual void add_force_sizes(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                               std::span<double> size) const = 0;
  /// - w' C v [W], summed over some pieces.
  virtual double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
                       std::span<const Eigen::Vector3d> v, std::span<const Eigen::Vector3d> w) const = 0;
  /// The change of v' C v / 2 [W] as v changes by `scale` times `step`, with C at these places.
  virtual EnergyChange rate_change(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                                   std::span<const Eigen::Vector3d> step, double scale) const = 0;

  /// The stiffness of every piece, damped or not, that `time` is multiplied by.
  virtual void for_each_tangent(const StagePlaces& at, const VisitTangent& visit) const = 0;
  /// Of a viscosity: a constant matrix at least as large near rest, each block a multiple of the identity. Of other
  /// damping it is that of the term.
  virtual void for_each_constant_tangent(const VisitTangent&) const {}

  /// Let v decay for h at fixed positions: part after part of each piece, in the order of their numbers or backwards,
  /// each as if it were alone; no part adds energy, whatever h > 0.
  ///
  virtual void decay(std::span<const Eigen::Vector3d> x, double h, const Mobility& mobility, bool backwards,
                     std::span<Eigen::Vector3d> v) const = 0;
};

}  // namespace dartboard
