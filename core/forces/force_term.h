#pragma once
// Forces between vertices other than springs: one interface for integrators, solvers and watchers.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/forces/compression.h"

namespace dartboard {

/// Positions x [m], or x + t w within a step. Differences are taken before sums, so that displacements that are small
/// against the coordinates keep their digits.
struct StagePlaces {
  std::span<const Eigen::Vector3d> x;
  std::span<const Eigen::Vector3d> w{};  // [m/s]; empty: t is not used
  double t = 0.0;                        // [s]

  Eigen::Vector3d place(std::uint32_t i) const { return w.empty() ? x[i] : Eigen::Vector3d(x[i] + t * w[i]); }
  /// From vertex i to vertex j.
  Eigen::Vector3d line(std::uint32_t i, std::uint32_t j) const {
    if (w.empty()) return x[j] - x[i];
    return (x[j] - x[i]) + t * (w[j] - w[i]);
  }
};

/// A change of energy [J], and the sum of the sizes of its terms, for its rounding: |e(a)| + |e(b)| for e(b) - e(a).
struct EnergyChange {
  double value = 0.0, sizes = 0.0;
};

/// The contribution of a piece to the stress at each of its vertices.
struct Virial {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();  // [J] symmetric, tension positive
  double growth = 0.0;  // [m^3] of its volume (of a surface [m^2] of its area) since rest; 0 of pieces without one
};

/// Pieces, or springs, from `first` to before `last`; `whole`: all of their vertices belong to one thread.
struct PieceRun {
  std::uint32_t first = 0, last = 0;
  bool whole = true;
};

/// The vertices from `first` to before `last`.
struct VertexRange {
  std::uint32_t first = 0, last = 0;
  bool contains(std::uint32_t vertex) const { return vertex >= first && vertex < last; }
};

/// Some of the vertices of a system, with numbers of their own.
struct VertexSubset {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::span<const std::uint32_t> number;  // of each vertex of the system in the part; `none` of those outside of it

  bool has(std::uint32_t vertex) const { return number[vertex] != none; }
};

class ForceTerm;
class TermDamping;

/// A term, and the columns that it reads.
struct TermOfPart {
  std::shared_ptr<const void> columns;
  std::unique_ptr<ForceTerm> term;
};

/// Forces that derive from an energy: a sum over pieces of a few vertices each.
///
/// Pieces are always visited in the order of their numbers, so that sums have the same bits for every caller. A term is
/// a view of columns that the body owns, as `SpringSystem` is.
/// cost    O(pieces) unless stated otherwise
class ForceTerm {
 public:
  using Nodes = std::span<const std::uint32_t>;
  /// Receives the vertices 0 ... n-1 of a piece and the blocks K_ab, b <= a, of its stiffness [N/m], that of a and b in
  /// place a (a + 1) / 2 + b.
  using VisitTangent = std::function<void(Nodes, std::span<const Eigen::Matrix3d>)>;

  virtual ~ForceTerm() = default;

  /// The name of its pieces: "tetrahedra".
  virtual std::string_view pieces_name() const = 0;
  virtual std::size_t size() const = 0;
  /// The vertices of a piece.
  virtual Nodes nodes(std::size_t piece) const = 0;
  /// Are the vertices of each piece connected by cells, and away from each other at rest? Those of an attachment are
  /// not.
  virtual bool is_within_cells() const { return true; }
  /// Do its forces derive from its energy? Otherwise that is zero, `energy_change` is the work along the step, and
  /// whatever watches energies sums `power`.
  virtual bool has_energy() const { return true; }

  /// force += f [N] at these places.
  virtual void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const = 0;
  /// Can several threads add its forces, each those of some pieces at some vertices?
  virtual bool adds_in_parts() const { return false; }
  /// Adds the forces of a run of pieces at the vertices within `own` alone.
  /// pre  it adds in parts; the vertices of a whole run are all within `own`
  virtual void add_forces_in_part(const StagePlaces&, PieceRun, VertexRange, std::span<Eigen::Vector3d>) const {}
  /// force += the discrete gradient between x and x + 2 t w, `at` being half way: its work is the energy's change.
  virtual void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const = 0;
  /// size[i] += a bound of the terms of the force at i [N]: eps times it bounds the rounding error of the force.
  virtual void add_force_sizes(const StagePlaces& at, std::span<double> size) const = 0;

  /// Energy [J] of the pieces first, first + stride, ...; zero at rest, and exact to a few roundings of their energies.
  virtual double energy(std::span<const Eigen::Vector3d> x, std::size_t first = 0, std::size_t stride = 1) const = 0;
  /// The change of the energy as every vertex moves on by `scale` times `step`, from differences that do not cancel.
  virtual EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step,
                                     double scale) const = 0;
  /// f . w [W], summed over some pieces.
  virtual double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
                       std::span<const Eigen::Vector3d> w) const = 0;

  /// The stiffness of every piece, exact or projected to be positive semidefinite.
  virtual void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const = 0;
  /// The stiffness of a constant matrix at least as stiff as the term near rest, each block a multiple of the identity.
  virtual void for_each_constant_tangent(const VisitTangent& visit) const = 0;

  /// The contribution of a piece at each of its vertices: its virial and the growth of its volume, over their number.
  virtual Virial virial(std::span<const Eigen::Vector3d> x, std::size_t piece) const = 0;

  /// The damping of its pieces (term_damping.h), which the forces above do not contain; null without damping.
  virtual const TermDamping* damping() const { return nullptr; }

  /// A term of the pieces at the vertices of a part, by their numbers there, in the same order. It reads copies of this
  /// term's columns; materials and pressures, which belong to the whole body, have to outlive it. Null of a term that
  /// cannot be taken in parts.
  /// pre  each piece has all of its vertices in the part, or none
  virtual TermOfPart of_part(const VertexSubset&) const { return {}; }
};

/// The force terms of a system in addition to its springs; in most systems this is empty.
using ForceTerms = std::span<const ForceTerm* const>;

}  // namespace dartboard
