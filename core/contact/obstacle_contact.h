#pragma once
// Contact of a body's boundary with obstacles, as a force term.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/contact/box_around.h"
#include "core/contact/contact_law.h"
#include "core/contact/obstacle.h"
#include "core/contact/skin_samples.h"
#include "core/contact/touch.h"
#include "core/contact/way_inside.h"
#include "core/forces/force_term.h"

namespace dartboard {

/// A zero-thickness penalty: each sample that is inside an obstacle has the energy of the obstacle's law at its depth.
/// All obstacles act on a sample inside them, not the deepest alone, so that the energy is a sum of smooth ones and
/// has p - 1 continuous derivatives wherever the depths are smooth (half-spaces; balls except their centre).
///
/// Blocks that touch or overlap are one solid (JoinedBlocks), in which a sample is in contact with the one that has the
/// nearest part of the surface. A block that stands on a half-space, or in it, with the whole of a face reaches on
/// through that face without end, so that it pushes sideways alone, and next to it as the half-space does upwards; one
/// that is all inside a half-space has no contact. A half-space that covers a part of a face changes nothing there,
/// and balls cover nothing.
///
/// Pieces are the samples, whether they touch or not, so that patterns stay while contacts appear and vanish. The force
/// at a sample is shared equally by its nodes, because its place is their mean. Obstacles are at rest between two calls
/// of `place_at`. There is no virial: an external force is no inner tension (as for gravity and pulls), and tearing is
/// decided by the stress with which the body resists it.
///
/// The constant tangent is that of a contact at the depth of its law, with the obstacle of the stiffest law at each
/// sample, as if all were touching. Projected tangents leave out the curvature of balls, whose sign is negative.
/// pre     the samples live as long as the term and are read anew in each call
/// cost    while all is far from the obstacles: a box around the vertices. Otherwise, per sample that is outside of all
///         of them: its mean and, for each, a dot product (half-space), a squared distance (ball) or up to six
///         comparisons (block), no root; no allocation
class ObstacleContact final : public ForceTerm {
 public:
  /// One law for each obstacle.
  /// throws  InputError where a law or an obstacle is not valid
  ObstacleContact(std::vector<ContactLaw> laws, std::vector<Obstacle> obstacles,
                  const std::vector<SkinSample>& samples);

  const std::vector<SkinSample>& samples() const { return samples_; }
  std::span<const Obstacle> obstacles() const { return obstacles_; }
  std::span<const ContactLaw> laws() const { return laws_; }
  /// Whether any law has friction, or loses speed: then ContactImpulses are needed.
  bool has_friction() const { return friction_; }
  bool has_damping() const { return damping_; }

  /// Put the obstacles at their places at this time [s]; true if that moved any.
  bool place_at(double time);
  /// Put the obstacles where those of another are.
  /// pre  they are the same obstacles
  void place_as(const ObstacleContact& other) {
    moved_ = other.moved_;
    arrange();
  }
  /// [m] The way of each from its place at the start.
  std::span<const Eigen::Vector3d> moved() const { return moved_; }
  /// Is all of the box farther than `by` [m] from an obstacle at its present place?
  bool is_away(std::uint32_t obstacle, const BoxAround& box, double by) const;
  /// The change of energy if they are put there, which is the work of moving them, from differences that do not cancel.
  /// Its sizes are 0 if they pass no sample on the way.
  EnergyChange work_of_placing(double time, std::span<const Eigen::Vector3d> x) const;
  /// The place of a sample [m].
  static Eigen::Vector3d place_of(const SkinSample& sample, const StagePlaces& at);
  /// The penetration of the place y into an obstacle at its present place, or into the blocks that it is joined with.
  Penetration penetration_in(std::uint32_t obstacle, const Eigen::Vector3d& y) const;
  /// Finds it; false, and `found` is not set, if y is not in contact with it: a few comparisons.
  bool find_penetration(std::uint32_t obstacle, const Eigen::Vector3d& y, Penetration& found) const;
  /// Are both among the same joined blocks?
  bool are_joined(std::uint32_t a, std::uint32_t b) const {
    return now_.joined_in[a] == now_.joined_in[b] && now_.joined_in[a] < now_.joined.size();
  }

  /// Calls visit(obstacle, penetration) for each obstacle that the place y is in contact with, in their order.
  template <class F>
  void for_each_penetration(const Eigen::Vector3d& y, const F& visit) const {
    Penetration found, joint;
    if (!may_cover_) {
      for (std::uint32_t o = 0; o < obstacles_.size(); ++o)
        if (find_alone(o, y, found)) visit(o, found);
      return;
    }
    std::uint32_t joint_with = Arrangement::alone;  // y is in one of the joined solids at most
    for (std::uint32_t o = 0; o < obstacles_.size(); ++o) {
      const std::uint32_t j = now_.joined_in[o];
      if (j == Arrangement::alone) {
        if (find_alone(o, y, found)) visit(o, found);
      } else if (j < now_.joined.size()) {
        if (now_.joined[j].obstacle[0] == o) find_joined(j, y, joint, joint_with);
        if (joint_with == o) visit(o, joint);
      }
    }
  }

  /// Calls visit(sample, obstacle, penetration) for each sample inside an obstacle, in this order.
  template <class F>
  void for_each_touch(const StagePlaces& at, const F& visit) const {
    for (std::uint32_t k = 0; k < samples_.size(); ++k)
      for_each_penetration(place_of(samples_[k], at),
                           [&](std::uint32_t o, const Penetration& found) { visit(k, o, found); });
  }

  /// Is it certain that no sample is inside, with the vertices at x + t v? False if it is not known.
  /// cost  O(vertices), a tenth of asking the samples; once it is not certain, only some of the next calls find out
  bool is_clear(std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v = {}, double t = 0.0) const;
  /// The box around the vertices if it is certain that no sample is inside; and whether it still is with the vertices
  /// at x + t v, for those in the box.
  /// pre  not empty
  std::optional<BoxAround> clear_box(std::span<const Eigen::Vector3d> x) const;
  bool is_clear_after(const BoxAround& box, std::span<const Eigen::Vector3d> v, double t) const;

  /// An upper bound of the square of the frequencies [1/s^2] of contact alone, if every sample were at this share of
  /// the depth of its law in the stiffest of the obstacles: with K the sum of k w w' n n', rows of M^-1 K add up to
  /// 1/m_i sum of k_s / n_s over the samples at i. Together with a body whose highest frequency is omega, no frequency
  /// is above the root of the sum of omega^2 and this bound.
  /// units   inverse_mass [1/kg], 0 where fixed
  double frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const;

  /// The friction during a step, in all functions below.
  std::span<const ContactFriction> frozen_friction() const { return frozen_.rows; }
  std::vector<ContactFriction>& frozen_friction_to_set() { return frozen_.rows; }

  std::string_view pieces_name() const override { return "contact samples"; }
  std::size_t size() const override { return samples_.size(); }
  Nodes nodes(std::size_t piece) const override { return samples_[piece].corners(); }
  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  /// For half-spaces and balls the quotient of energy and depth along the mean normal, for blocks the mean force along
  /// the way, for joined ones a discrete gradient: in each the work is the energy's change, and forces have no
  /// component along the surface of a half-space.
  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override;
  double energy(std::span<const Eigen::Vector3d> x, std::size_t first = 0, std::size_t stride = 1) const override;
  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step, double scale) const override;
  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override;
  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override;
  void for_each_constant_tangent(const VisitTangent& visit) const override;
  Virial virial(std::span<const Eigen::Vector3d>, std::size_t) const override { return {}; }

  /// Writes or reads the places of the obstacles.
  template <class Archive>
  void state(Archive& archive) {
    archive(moved_);
    arrange();
  }
  std::size_t bytes() const;

 private:
  /// The effect of obstacles on each other at their places.
  struct Arrangement {
    static constexpr std::uint32_t alone = std::numeric_limits<std::uint32_t>::max(), hidden = alone - 1;

    std::vector<Eigen::Vector3d> moved;    // [m] by obstacle, the ways to these places
    std::vector<ObstacleShape> shape;      // by obstacle, with the faces that are in half-spaces at infinity
    std::vector<std::uint32_t> joined_in;  // by obstacle: the number of the joined blocks, or one of the above
    std::vector<JoinedBlocks> joined;

    std::size_t bytes() const;
  };

  /// Finds the arrangement at the present places, if obstacles have moved relative to each other.
  void arrange();
  Arrangement arranged(std::span<const Eigen::Vector3d> moved) const;
  /// Have two obstacles that may cover each other moved apart, or together, since `now_` was found?
  template <class F>
  bool differs(const F& moved) const;
  bool find_alone(std::uint32_t o, const Eigen::Vector3d& y, Penetration& found) const;
  void find_joined(std::uint32_t j, const Eigen::Vector3d& y, Penetration& found, std::uint32_t& obstacle) const;

  /// Calls f(law, penetration, obstacle) for each obstacle that contains the place y of a sample.
  template <class F>
  void for_each_contact(const Eigen::Vector3d& y, F&& f) const;
  bool passes_call() const;
  bool is_clear(const BoxAround& box, double size) const;
  /// The largest over the laws, each at this share of its depth [N/m].
  double largest_stiffness(double area, double share_of_depth) const;

  std::vector<ContactLaw> laws_;
  std::vector<Obstacle> obstacles_;
  const std::vector<SkinSample>& samples_;
  std::vector<Eigen::Vector3d> moved_;  // [m] by obstacle
  Arrangement now_;
  bool may_cover_ = false;  // there is a block, and another or a half-space
  FrozenFriction frozen_;
  bool friction_ = false, damping_ = false;
  mutable int calls_to_pass_ = 0;  // of `is_clear`
};

}  // namespace dartboard
