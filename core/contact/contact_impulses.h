#pragma once
// The losses by contact around each step: speed lost in a bounce, and friction.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/bounces.h"
#include "core/contact/box_around.h"
#include "core/contact/contacts.h"
#include "core/contact/touch.h"

namespace dartboard {

/// The work around each step of any integrator, whose step has the contact terms among its forces:
///
///     restart if begin(t, h, ...)      half of the losses of bounces; obstacles to t + h/2; friction is set
///     step                             conservative, with constant obstacles and friction forces
///     restart if end(t + h, ...)       friction is taken away; obstacles to t + h; half of the losses of bounces
///
/// **Losses of bounces** are those of Bounces, which it has for both terms.
///
/// **Friction** is a constant force during the step. It is chosen so that the tangential speed relative to the
/// obstacle, predicted for the end of the step by the accelerations at its beginning, is zero: - m (v_t / h + a_t); or
/// as much of that as mu times the normal force allows. The normal force is that of the contact and its damping at the
/// depth that the sample will have half way, but at most the force that holds the sample and reverses its normal speed.
/// A sample that sticks has no tangential acceleration left: it stays to the last bit with any integrator, where
/// impulses at the ends of a step would let it creep by g h / 2. If samples share vertices, the forces are relaxed one
/// after the other in a few sweeps, from those of the step before: the forces of samples that stick for some steps
/// converge, and that of a single vertex is found at once.
///
/// **Between bodies** both act on the nodes of both sides, after those with obstacles: losses along the line from the
/// sample to the nearest way out, friction at the sample's own place in the other body, with both places half way
/// through the step. Linear momentum is conserved to rounding. So is angular momentum with losses; with friction it is
/// for methods that take their forces half way, as Verlet does, and for contacts that stick; for others the two places
/// slide apart before and after, along the force, and an error of h^3 is left.
///
/// cost    O(samples); with friction, and only if something touches, one evaluation of the accelerations and the
///         sweeps over the contacts. No allocation once there have been as many contacts before.
class ContactImpulses {
 public:
  /// Fills `a` with the accelerations [m/s^2] by all that acts at these places and velocities, contact and gravity
  /// included; zero where fixed.
  using Accelerations = std::function<void(std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v,
                                           std::span<Eigen::Vector3d> a)>;

  explicit ContactImpulses(const Contacts& contacts) : contacts_(contacts), bounces_(contacts) {}

  /// To be called before a step from `time` [s] of length h [s]. True if the integrator has to be restarted:
  /// velocities, obstacles or friction forces have changed. `end` or `take_back` comes next.
  /// units   inverse_mass [1/kg] by vertex
  bool begin(double time, double h, std::span<const double> inverse_mass, const HeldVertices& fixed,
             std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> v, const Accelerations& accelerations);
  /// To be called after the step, at `time` + h.
  bool end(double time, double h, std::span<const double> inverse_mass, const HeldVertices& fixed,
           std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> v);

  /// The places have changed since the last `end`, other than by a step. Until the next step they are known from there.
  void forget_places() {
    clear_.reset();
    room_.reset();
  }
  /// Is it certain that no sample is inside an obstacle at x, the places of the last `end`?
  bool is_clear(std::span<const Eigen::Vector3d> x);
  /// Is it certain that no sample is inside a body there?
  bool are_apart(std::span<const Eigen::Vector3d> x) { return room_at(x) > 0.0; }

  /// To be called in place of `end` if the step was not taken: restores the sums and the start values of friction from
  /// before `begin`. The caller restores the velocities; obstacles are not moved.
  void take_back();

  /// By sample, with obstacles and between bodies: its number after a change, VertexSubset::none of those left out.
  using MovedSamples = std::array<std::vector<std::uint32_t>, 2>;
  /// Continue with the contact of another part of the body, or of the whole; `vertices` are the numbers of the part's
  /// vertices in the whole, or nothing for the whole. The starts of friction and of bounces are kept.
  /// pre  between steps; the laws are the same; `vertices` stays as it is until the next call
  void change_part(const Contacts& contacts, const MovedSamples& moved_to, std::span<const std::uint32_t> vertices);

  const ContactLosses& losses() const { return losses_; }
  /// Go back to sums of an earlier state.
  /// pre  between steps
  void restore(const ContactLosses& losses) { losses_ = losses; }
  /// pre  between steps
  template <class Archive>
  void state(Archive& archive) {
    archive(losses_, bounces_, friction_);
  }
  std::size_t bytes() const;

 private:
  /// What friction acts against at a contact.
  struct Sliding {
    Eigen::Vector3d normal;
    Eigen::Vector3d carried;  // [m] the way of the obstacle in the step
    double most;              // [N] the largest friction allowed
  };

  Bounces::Step bounce_step(double time, double h, std::span<const double> inverse_mass, const HeldVertices& fixed,
                            std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> v);
  Contacts rubbing_after(double t, std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v);
  void find_rubbing(double time, double h, std::span<const double> inverse_mass, const HeldVertices& fixed,
                    std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v);
  Eigen::Vector3d force_before(const Touch& touch) const;
  double depth_at_beginning(const Touch& touch, std::span<const Eigen::Vector3d> x) const;
  bool set_friction(double time, double h, std::span<const double> inverse_mass, const HeldVertices& fixed,
                    std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v,
                    const Accelerations& accelerations);
  void clear_friction();
  bool place_at(double time, std::span<const Eigen::Vector3d> x);

  double room_at(std::span<const Eigen::Vector3d> x);

  std::optional<BoxAround> clear_;  // around the present places, if no sample is inside an obstacle
  std::optional<double> room_;      // [m] between bodies, at the present places
  Contacts contacts_;
  Bounces bounces_;
  ContactLosses losses_, losses_at_begin_;
  // Friction of this step, or of the last one, where the sweeps of the next begin: a guess, no worse than zero even
  // after the samples have changed. First with obstacles, then between bodies, each in the order of samples.
  std::vector<ContactFriction> friction_, earlier_;
  std::vector<Sliding> sliding_;  // of each
  std::vector<Eigen::Vector3d> acceleration_;
  std::vector<std::pair<std::uint32_t, double>> depth_;  // [m] of samples in bodies, at the beginning of the step
};

}  // namespace dartboard
