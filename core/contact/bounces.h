#pragma once
// The speed that contacts lose in a bounce: their forces depend on the rate at which depths change.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "core/contact/contacts.h"

namespace dartboard {

/// Sums over a run [J]: every change of energy that is not of a conservative step is in one of these. The total energy
/// of a body, its contact energy included, changes by supplied - damped - rubbed.
struct ContactLosses {
  double damped = 0.0;    // by restitution below 1
  double rubbed = 0.0;    // by friction; a step in which the sliding turns back may return some of its own
  double supplied = 0.0;  // the work of obstacles that move, and of driven vertices against the impulses

  template <class Archive>
  void state(Archive& archive) {
    archive(damped, rubbed, supplied);
  }
};

/// The part of the forces of contacts that depends on rates of depth, ContactLaw::loss, as impulses before and after
/// each step. The step itself has the forces of the depths.
///
/// Each contact keeps its first rate: the speed of approach where the sample met the surface, between those at the
/// beginning and the end of that step; later the largest speed in this contact, if something else drives it. A sample
/// that is inside without having come in, at the start of a run or after an event, has the speed that its mass would
/// have needed to come so deep.
///
/// Half of it acts before the step and half after it, on one contact after the other and back in the opposite order, so
/// that both together are symmetric in time and of order 2. A speed of approach decays exactly at a constant depth. One
/// of separation decays likewise, at the depth half way through the step, and by no more than the least elastic force
/// within the step gives: what the contact does in a step never pulls, as long as a step's forces are those of depths
/// within it.
class Bounces {
 public:
  explicit Bounces(const Contacts& contacts);

  struct Step {
    double time = 0.0;  // [s] of its beginning or end, where obstacles have been put
    double h = 0.0;     // [s]
    Contacts near;      // those with losses; without a term of which no sample is inside anything
    std::span<const double> inverse_mass;
    const HeldVertices& held;
    std::span<const Eigen::Vector3d> x;
    std::span<Eigen::Vector3d> v;
  };
  /// True if any velocity has changed.
  /// cost  O(samples) where anything is near, otherwise a copy of the velocities; nothing where no law loses speed
  bool before(const Step& step, ContactLosses& losses);
  bool after(const Step& step, ContactLosses& losses);
  /// In place of `after`, if the step was not taken.
  void take_back() { starts_ = starts_before_; }

  /// The factor of the force of a contact at a rate of depth [m/s].
  double factor(const Touch& touch, double rate) const;

  /// Continue with the contact of another part of the body, whose vertices have these numbers in the whole; empty: the
  /// whole. Contacts outside of the part are forgotten.
  void change_part(const Contacts& contacts, std::span<const std::uint32_t> vertices);

  /// pre  between steps
  template <class Archive>
  void state(Archive& archive) {
    archive(starts_);
  }
  std::size_t bytes() const;

 private:
  /// A sample in contact, by the vertices of the whole body, whose numbers stay when samples get others.
  struct Start {
    std::array<std::uint32_t, 4> nodes{};
    std::uint32_t sample = 0, obstacle = 0;
    double rate = 0.0;   // [m/s] the first
    double depth = 0.0;  // [m] at the beginning of the step; 0: it came in during the step

    bool is_of_bodies() const { return obstacle == Touch::body; }
    std::tuple<bool, std::uint32_t, std::uint32_t> order() const { return {is_of_bodies(), sample, obstacle}; }
    template <class Archive>
    void state(Archive& archive) {
      archive(nodes, sample, obstacle, rate, depth);
    }
  };
  /// One with losses.
  struct LossyTouch : Touch {
    ContactSite site{};
    double loss = 0.0, mobility = 0.0;
    double carried = 0.0;  // [m/s] of the obstacle along the normal
    double rate(std::span<const Eigen::Vector3d> v) const { return carried - site.difference(v).dot(normal); }
  };
  enum class Side : std::uint8_t { before, after };

  double loss_of(const Touch& touch) const;
  void find_touches(const Step& step);
  double first_rate(const LossyTouch& touch, Side side, const Step& step) const;
  const Start* passed_on(const std::vector<Start>& among, std::uint32_t sample, std::uint32_t obstacle) const;
  void match_starts(Side side, const Step& step);
  bool damp(Side side, const Step& step, ContactLosses& losses);
  void find_samples();
  std::array<std::uint32_t, 4> whole_nodes(const SkinSample& sample) const;
  const SkinSample* sample_of(const Start& start) const;

  Contacts contacts_;
  std::span<const std::uint32_t> vertices_;
  std::vector<double> loss_;            // by obstacle
  std::vector<double> loss_of_bodies_;  // by law
  // One for each touch: first with obstacles, then with bodies, each in the order of samples.
  std::vector<LossyTouch> touches_;
  std::vector<Start> starts_, starts_before_, earlier_;
  std::vector<Eigen::Vector3d> v_before_;  // [m/s] as the step begins
};

}  // namespace dartboard
