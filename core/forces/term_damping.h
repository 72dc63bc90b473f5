#pragma once
// The damping of a force term: what its pieces lose by being deformed, however fast the body moves or turns.

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/forces/force_term.h"
#include "core/forces/mobility.h"

namespace dartboard {

/// Forces - C v, with C a function of the positions: symmetric, positive semidefinite, and zero for every rigid motion,
/// so that linear and angular momentum stay.
///
/// Of a piece C is `time` times a stiffness, that of its material where nothing stresses it.
/// cost    O(pieces) where nothing else is said
class TermDamping {
 public:
  using Nodes = ForceTerm::Nodes;
  using VisitTangent = ForceTerm::VisitTangent;

  virtual ~TermDamping() = default;

  /// [s] of a piece; 0 where it is not damped.
  virtual double time(std::size_t piece) const = 0;

  /// force -= C v [N] at these places.
  virtual void add_forces(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                          std::span<Eigen::Vector3d> force) const = 0;
  /// size[i] += a bound of what rounding acts on in the force at i [N]: with eps times it, forces are known.
  virtual void add_force_sizes(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                               std::span<double> size) const = 0;
  /// - w' C v [W], summed over some pieces.
  virtual double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
                       std::span<const Eigen::Vector3d> v, std::span<const Eigen::Vector3d> w) const = 0;
  /// What v' C v / 2 [W] changes by as v moves on by `scale` times `step`, C being that of these places.
  virtual EnergyChange rate_change(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                                   std::span<const Eigen::Vector3d> step, double scale) const = 0;

  /// The stiffness of every piece, damped or not, that `time` is multiplied by.
  virtual void for_each_tangent(const StagePlaces& at, const VisitTangent& visit) const = 0;

  /// Let v decay for h at positions that stand still: part after part of each piece, in the order of their numbers or
  /// backwards, each as if it were alone; none gains energy from that, whatever h > 0.
  ///
  virtual void decay(std::span<const Eigen::Vector3d> x, double h, const Mobility& mobility, bool backwards,
                     std::span<Eigen::Vector3d> v) const = 0;
};

}  // namespace dartboard
