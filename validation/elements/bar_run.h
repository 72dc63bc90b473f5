#pragma once
// A clamped bar simulated as users do: bent, released, and followed for one period; and the cheapest method for that.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/time/method/integrator.h"
#include "validation/elements/bar_answers.h"

namespace dartboard {

/// A bar that a traction has bent by a ten thousandth of its length: nonlinear terms of the laws are as small.
class BentBar {
 public:
  static constexpr double bend = 1e-4;  // [lengths]

  /// `bent`: the displacements [m] under a traction of 1 Pa; the tip is where they are largest.
  BentBar(const ClampedBar& bar, std::unique_ptr<SimulatedBody> body, const Eigen::VectorXd& bent);
  /// Bent about as much, along a parabola: where only times are needed.
  BentBar(const ClampedBar& bar, std::unique_ptr<SimulatedBody> body);

  /// Back to the bent state, at rest.
  void restore();
  StepResult step(Integrator& integrator, double h) { return integrator.step(body_->system(), body_->motion(), h); }
  SimulatedBody& body() { return *body_; }

  /// A run over one period in so many steps, a multiple of the beats.
  struct Run {
    StepResult result;
    WatchedMotion motion;  // scaled to 1 Pa; empty if a step failed
  };
  Run follow(Integrator& integrator, std::uint64_t steps, const Beats& beats, std::span<const std::uint32_t> watched);

 private:
  std::unique_ptr<SimulatedBody> body_;
  std::vector<Eigen::Vector3d> rest_, start_;
  double scale_ = 1.0;  // [Pa] of the traction that bends it
};

/// An integrator that takes part, and the fewest steps per period to start from.
struct BarMethod {
  std::string integrator;
  std::uint64_t fewest_steps = Beats::count;
};
/// Symplectic Euler, Verlet, Blanes and Moan's and classical Runge-Kutta from their longest stable steps on; implicit
/// midpoint and ros2 from one step per beat. For bodies of springs and of elements alike.
std::vector<BarMethod> bar_methods(BentBar& bar, const Beats& beats);

/// The cheapest method and step of those whose error is small compared with the model's.
struct BestMethod {
  std::string integrator;      // empty where none was found
  std::uint64_t steps = 0;     // of a period
  double error = 0.0;          // of the steps alone: compared with the motion of the same model in steps of no length
  double total_error = 0.0;    // compared with the truth
  double step_ns = 0.0;        // roughly, of one step: from the few that gave the price
  std::uint64_t followed = 0;  // runs over a period that the search took
};

/// The algorithm is best first: each method has a price for its next number of steps, from a few timed steps; the
/// cheapest of all is followed over the whole period. If its error is at most `allowed`, no other method can be
/// cheaper; else it is entered again with half as many steps more, or a third more, in turn (16, 24, 32, 48 ...).
///
/// `clock` in ns; `exact` the motion of the model in steps of no length.
BestMethod best_method(BentBar& bar, const Beats& beats, std::span<const std::uint32_t> watched,
                       const WatchedMotion& exact, const WatchedMotion& truth, double allowed,
                       std::span<const BarMethod> methods, const std::function<std::int64_t()>& clock);

}  // namespace dartboard
