#pragma once
// Damping alone, at fixed positions: v' = -B v, where M B sums c u u^T over the springs, the damping of force terms and
// the viscosities.

#include <Eigen/Core>
#include <initializer_list>
#include <span>
#include <vector>

#include "core/base/bytes.h"
#include "core/base/padded_vector.h"
#include "core/forces/one_minus_exp.h"
#include "core/time/system/accelerations.h"

namespace dartboard {

/// The dissipative part of a splitting. Every spring acts along its line with opposite impulses on its ends, and
/// elements act by strains, so this damping conserves linear and angular momentum (viscosity, which is no inner force,
/// does not).
///
/// pre     the system and its terms are those of the last `freeze`; `forget` when masses, dampings or springs change
class FrozenDamping {
 public:
  void forget() { flow_step_ = 0.0; }
  std::size_t bytes() const { return bytes_of(along_, mobility_, impulse_, remains_, at_, padded_); }

  /// Take the directions of the springs from x, and keep x for force terms that are damped.
  void freeze(const SpringSystem& system, const Terms& terms, std::span<const Eigen::Vector3d> x);

  /// result = B v [m/s^2], zero where fixed, and along held axes.
  void apply(const SpringSystem& system, const Terms& terms, std::span<const Eigen::Vector3d> v,
             std::span<Eigen::Vector3d> result) const;

  /// Let v decay for h by a symmetric sweep, order 2: the springs one after the other for h/2, each by its exact flow
  /// as if it were alone, then the parts of force terms likewise, and then all in the opposite order for h/2.
  ///
  /// Each exact flow takes energy away, so the sweep is stable for all h > 0 and c >= 0.
  void decay_symmetric(const SpringSystem& system, const Terms& terms, double h, std::span<Eigen::Vector3d> v);

  /// Lets velocities decay by one sweep for h, order 1.
  void decay_once(const SpringSystem& system, const Terms& terms, double h, std::span<Eigen::Vector3d> v);

 private:
  void prepare_flow(const SpringSystem& system, const Terms& terms, double h);
  auto relaxation(const SpringSystem& system, std::span<Eigen::Vector3d> v) const;
  auto relaxation_along_axes(const SpringSystem& system, double h, std::span<Eigen::Vector3d> v) const;
  enum class Sweep { forwards, backwards };
  void relax_springs(const SpringSystem& system, double h, std::initializer_list<Sweep> sweeps,
                     std::span<Eigen::Vector3d> v);
  /// pre  the processor has AVX2, no vertex is held along axes
  void relax_in_padded_rows(const SpringSystem& system, Sweep sweep);
  void slow_down(std::span<Eigen::Vector3d> v) const;
  void relax_terms(const SpringSystem& system, double h, bool backwards, std::span<Eigen::Vector3d> v) const;

  std::vector<Eigen::Vector3d> along_;  // unit vectors; zero for zero length
  std::vector<Eigen::Vector3d> at_;     // positions by vertex; empty where no force term is damped
  double flow_step_ = 0.0;              // [s] the step that the factors below belong to
  std::vector<double> mobility_;        // inverse masses, zero where fixed
  std::vector<double> impulse_;         // of each spring per relative speed, (1 - exp(-c h / mu)) mu
  std::vector<double> remains_;         // of each vertex's velocity, exp(-viscosity h / m)
  std::vector<PaddedVector> padded_;    // velocities during sweeps over springs, or empty
};

}  // namespace dartboard
