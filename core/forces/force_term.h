#pragma once
// What acts between vertices beside springs: one interface for integrators, solvers and watchers.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/forces/compression.h"

namespace dartboard {

/// Positions x [m], or x + t w where a step is on its way there. Differences are taken before sums: what is small
/// against the coordinates keeps its digits.
struct StagePlaces {
  std::span<const Eigen::Vector3d> x;
  std::span<const Eigen::Vector3d> w{};  // [m/s]; empty: t counts for nothing
  double t = 0.0;                        // [s]

  /// From vertex i to vertex j.
  Eigen::Vector3d line(std::uint32_t i, std::uint32_t j) const {
    if (w.empty()) return x[j] - x[i];
    return (x[j] - x[i]) + t * (w[j] - w[i]);
  }
};

/// A change of energy [J], and the sum of the sizes of what it is rounded from: |e(a)| + |e(b)| for e(b) - e(a).
struct EnergyChange {
  double value = 0.0, sizes = 0.0;
};

/// What a piece adds to the stress at each of its vertices.
struct Virial {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();  // [J] symmetric, tension positive
  double growth = 0.0;  // [m^3] of its volume (of a surface [m^2] of its area) since rest; 0 of pieces without one
};

class TermDamping;

/// Forces that derive from an energy: a sum over pieces of a few vertices each.
///
/// Pieces are visited in the order of their numbers, always, so that sums have the same bits whoever asks. A term is
/// a view of columns that somebody else owns, as `SpringSystem` is.
/// cost    O(pieces) where nothing else is said
class ForceTerm {
 public:
  using Nodes = std::span<const std::uint32_t>;
  /// Of a piece with vertices 0 ... n-1: the blocks K_ab, b <= a, of its stiffness [N/m], that of a and b in place
  /// a (a + 1) / 2 + b.
  using VisitTangent = std::function<void(Nodes, std::span<const Eigen::Matrix3d>)>;

  virtual ~ForceTerm() = default;

  /// What its pieces are called: "tetrahedra".
  virtual std::string_view pieces_name() const = 0;
  virtual std::size_t size() const = 0;
  /// The vertices of a piece.
  virtual Nodes nodes(std::size_t piece) const = 0;

  /// force += f [N] at these places.
  virtual void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const = 0;
  /// force += the discrete gradient between x and x + 2 t w, `at` being half way: its work is the energy's change.
  virtual void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const = 0;
  /// size[i] += a bound of what rounding acts on in the force at i [N]: with eps times it, forces are known.
  virtual void add_force_sizes(const StagePlaces& at, std::span<double> size) const = 0;

  /// Energy [J] of the pieces first, first + stride, ...; zero at rest, and to a few roundings of what they have.
  virtual double energy(std::span<const Eigen::Vector3d> x, std::size_t first = 0, std::size_t stride = 1) const = 0;
  /// What the energy changes by as every vertex moves on by `scale` times `step`, from differences that do not cancel.
  virtual EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step,
                                     double scale) const = 0;
  /// f . w [W], summed over some pieces.
  virtual double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
                       std::span<const Eigen::Vector3d> w) const = 0;

  /// The stiffness of every piece, exact or projected to be positive semidefinite.
  virtual void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const = 0;
  /// The same of a constant matrix at least as stiff as the term near rest, each block a multiple of the identity.
  virtual void for_each_constant_tangent(const VisitTangent& visit) const = 0;

  /// What a piece adds at each of its vertices: its virial and the growth of its volume, over the number of them.
  virtual Virial virial(std::span<const Eigen::Vector3d> x, std::size_t piece) const = 0;

  /// What damps its pieces (term_damping.h), beside all of the above; null where nothing does.
  virtual const TermDamping* damping() const { return nullptr; }
};

/// The terms of a system beside its springs; most systems have none.
using ForceTerms = std::span<const ForceTerm* const>;

}  // namespace dartboard
