#pragma once
// Pressures on faces that move: forces against their current area vectors.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/forces/force_term.h"

namespace dartboard {

/// A face under pressure. Its corners are counter-clockwise seen from where the pressure acts: points of the mesh, or
/// in the rows of a body its vertices.
struct PressedFace {
  std::uint32_t force = 0;  // of the scene
  std::uint32_t cell = 0;   // of the mesh, that the face bounds, or that it is
  std::uint32_t count = 0;  // of its corners, 3 or 4
  std::array<std::uint32_t, 4> corner{};
  double stiffness =
      0.0;  // [N/m] a bound of the tangent's eigenvalues near rest, under the pressure when it is largest

  std::span<const std::uint32_t> corners() const { return {corner.data(), count}; }
  template <class Archive>
  void state(Archive& archive) {
    archive(force, cell, count, corner, stiffness);
  }
  friend bool operator==(const PressedFace&, const PressedFace&) = default;
};

/// The forces [N] of a pressure [Pa] at the corners of a face: against its area vector, shared as linear shape
/// functions share it; on a quadrilateral, which need not be plane, as bilinear ones do: the mean of both ways to split
/// it. So the forces on faces all round a body have neither a sum nor a moment.
///
/// `x` are the places of its corners, of which there are 3 or 4.
std::array<Eigen::Vector3d, 4> forces_of_pressure(double pressure, std::uint32_t corners,
                                                  const std::array<Eigen::Vector3d, 4>& x);

/// The forces of pressures that follow their faces.
///
/// All round a body, or where the rim of the faces does not move, their work is the pressure times the lost volume.
/// Elsewhere it depends on the way: so they have no energy, the change of it along a line is the work along that, and
/// tangents are the symmetric part.
class FacePressureTerm final : public ForceTerm {
 public:
  /// The pressures [Pa] are by number of force; they and the rows outlive the term.
  FacePressureTerm(const std::vector<PressedFace>& rows, const std::vector<double>& pressure)
      : rows_(rows), pressure_(pressure) {}

  const std::vector<PressedFace>& rows() const { return rows_; }

  std::string_view pieces_name() const override { return "faces under pressure"; }
  std::size_t size() const override { return rows_.size(); }
  Nodes nodes(std::size_t piece) const override { return rows_[piece].corners(); }
  bool has_energy() const override { return false; }

  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  /// The mean of the forces along the step.
  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override;

  double energy(std::span<const Eigen::Vector3d>, std::size_t, std::size_t) const override { return 0.0; }
  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step, double scale) const override;
  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override;

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override;
  void for_each_constant_tangent(const VisitTangent& visit) const override;

  Virial virial(std::span<const Eigen::Vector3d>, std::size_t) const override { return {}; }
  TermOfPart of_part(const VertexSubset& part) const override;

  /// Remember the places of the corners now.
  void begin_step(std::span<const Eigen::Vector3d> x);
  /// The work [J] of the pressures since then, as if every corner had moved on a straight line.
  /// pre  the rows are those of `begin_step`
  double work(std::span<const Eigen::Vector3d> x) const;
  std::size_t bytes() const { return begin_.size() * sizeof(begin_[0]); }

 private:
  const std::vector<PressedFace>& rows_;
  const std::vector<double>& pressure_;
  std::vector<std::array<Eigen::Vector3d, 4>> begin_;  // by row: the places of its corners
};

}  // namespace dartboard
