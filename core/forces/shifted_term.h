#pragma once
// A force term of one of several bodies, by the vertex numbers of all of them.

#include <cstdint>
#include <span>
#include <vector>

#include "core/forces/force_term.h"
#include "core/forces/term_damping.h"

namespace dartboard {

/// A term whose vertices 0, 1, ... are first, first + 1, ... in the columns that it is called with.
///
/// pre  the term outlives it
class ShiftedTerm final : public ForceTerm {
 public:
  explicit ShiftedTerm(const ForceTerm& term) : term_(term), damping_(*this) {}
  ShiftedTerm(const ShiftedTerm&) = delete;
  ShiftedTerm& operator=(const ShiftedTerm&) = delete;

  /// Follow a change of the first vertex, or of the term's pieces.
  /// cost  O(pieces)
  void shift_to(std::uint32_t first);
  std::size_t bytes() const { return sizeof(std::uint32_t) * (nodes_.size() + first_node_.size()); }

  std::string_view pieces_name() const override { return term_.pieces_name(); }
  std::size_t size() const override { return term_.size(); }
  Nodes nodes(std::size_t piece) const override {
    return Nodes(nodes_).subspan(first_node_[piece], first_node_[piece + 1] - first_node_[piece]);
  }
  bool is_within_cells() const override { return term_.is_within_cells(); }
  bool has_energy() const override { return term_.has_energy(); }
  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  bool adds_in_parts() const override { return term_.adds_in_parts(); }
  void add_forces_in_part(const StagePlaces& at, PieceRun run, VertexRange own,
                          std::span<Eigen::Vector3d> force) const override;
  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override;
  double energy(std::span<const Eigen::Vector3d> x, std::size_t first, std::size_t stride) const override;
  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step, double scale) const override;
  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override;
  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override;
  void for_each_constant_tangent(const VisitTangent& visit) const override;
  Virial virial(std::span<const Eigen::Vector3d> x, std::size_t piece) const override;
  const TermDamping* damping() const override { return term_.damping() == nullptr ? nullptr : &damping_; }
  TermOfPart of_part(const VertexSubset& part) const override { return term_.of_part({part.number.subspan(first_)}); }

 private:
  class Damping final : public TermDamping {
   public:
    explicit Damping(const ShiftedTerm& of) : of_(of) {}

    double time(std::size_t piece) const override { return own().time(piece); }
    bool is_viscous() const override { return own().is_viscous(); }
    void add_forces(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                    std::span<Eigen::Vector3d> force) const override;
    void add_force_sizes(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                         std::span<double> size) const override;
    double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
                 std::span<const Eigen::Vector3d> v, std::span<const Eigen::Vector3d> w) const override;
    EnergyChange rate_change(const StagePlaces& at, std::span<const Eigen::Vector3d> v,
                             std::span<const Eigen::Vector3d> step, double scale) const override;
    void for_each_tangent(const StagePlaces& at, const VisitTangent& visit) const override;
    void for_each_constant_tangent(const VisitTangent& visit) const override;
    void decay(std::span<const Eigen::Vector3d> x, double h, const Mobility& mobility, bool backwards,
               std::span<Eigen::Vector3d> v) const override;

   private:
    const TermDamping& own() const { return *of_.term_.damping(); }
    const ShiftedTerm& of_;
  };

  const ForceTerm& term_;
  Damping damping_;
  std::uint32_t first_ = 0;
  std::vector<std::uint32_t> nodes_, first_node_;  // by piece
};

}  // namespace dartboard
