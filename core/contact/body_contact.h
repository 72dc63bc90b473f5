#pragma once
// Contact between bodies, and of a body with itself, as a force term.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/candidate_pairs.h"
#include "core/contact/contact_law.h"
#include "core/contact/contact_site.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"
#include "core/forces/force_term.h"

namespace dartboard {

/// Two groups that may touch, or one that may touch itself, and their law.
struct ContactPair {
  std::uint32_t a = 0, b = 0;
  ContactLaw law;
};

/// A sample inside a body, and the nearest way out.
struct BodyTouch {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t sample = 0;       // place among the samples
  std::uint32_t tetrahedron = 0;  // place among the tetrahedra: what it is inside of
  std::uint32_t triangle = none;  // place among the triangles: where it would come out; none: out of reach
  std::uint32_t law = 0;
  double area = 0.0;                // [m^2] half of what the sample stands for: the other side has the other half
  double depth = 0.0;               // [m], above 0 where there is a triangle
  Eigen::Vector3d normal{0, 0, 0};  // outwards, of length 1: the force on the sample is along it
  std::array<double, 3> nearest{};  // weights of the nearest point over the triangle's corners
  std::array<double, 4> inside{};   // weights of the sample's own place over the tetrahedron's
};

/// A force that friction has between two places that met half way through the step, during that step.
struct BodyFriction {
  std::uint32_t sample = 0, tetrahedron = 0;
  ContactSite site;                // sample, less its place in the tetrahedron
  Eigen::Vector3d force{0, 0, 0};  // [N] on the sample
  Eigen::Vector3d from{0, 0, 0};   // [m] the difference of the two places before the step

  /// Between steps, where it is what the next begins from.
  template <class Archive>
  void state(Archive& archive) {
    archive(sample, tetrahedron, force);
  }
};

/// What a run tells of the contacts between its bodies.
struct BodyContactState {
  static constexpr std::uint32_t none = BodyTouch::none;

  std::size_t contacts = 0;          // samples inside a body
  double area = 0.0;                 // [m^2] that these stand for, each half of its own
  double energy = 0.0;               // [J]
  double deepest = 0.0;              // [m]; 0 without a contact
  std::uint32_t sample = none;       // of the deepest, the first of equals
  std::uint32_t from = 0, into = 0;  // its group, and that of what it is inside of
  double deepest_share = 0.0;        // the largest depth over the `depth` of its law
  std::size_t out_of_reach = 0;      // inside, and no way out in reach: these feel nothing
  std::uint32_t lost = none;         // the first of them
  std::size_t inverted = 0;          // candidates that were not looked at as they are turned inside out
};

/// A zero-thickness penalty between solids: each sample of the skin that is inside a tetrahedron along the boundary of
/// what it may touch has the energy of a law at its depth, on half of its area. The samples of the other side feel the
/// other half, so that a pressure is P0 (d / delta)^(p-1) where two surfaces overlap by d, as on an obstacle.
///
/// **Inside** is a tetrahedron of positive volume now with all weights of the place above 0 at faces on the boundary,
/// and above -2^-40 at those within the body, so that what lies between two cells is in one of them: of several the one
/// of the lowest cell. Left out are tetrahedra that share a vertex with a cell at one of the sample's own nodes, and
/// bodies with themselves where they may not touch. **Depth** is the distance to the nearest boundary triangle among
/// those at the tetrahedron's corners, but for triangles that have a node of the sample; its change with the places is
/// that of the line to the nearest point (envelope theorem), so that forces along that line, on the sample's nodes and
/// on the triangle's by the weights of the point, are the slope of the energy, and have no sum and no torque. It has
/// kinks where another triangle becomes the nearest. Depths below 2^-46 of the coordinates are none: a body just cut
/// has no contact. A sample that has no triangle in reach feels nothing, and is counted.
///
/// Pieces are the samples, then the triangles, then the tetrahedra, whether they touch or not: a sample has the energy
/// of its contact. A tangent is twice the stiffness along the normal on each side by itself, which is no less than the
/// true one, whose blocks between the bodies come and go; both kinds are this one.
///
/// Candidates come from a list with a margin (candidate_pairs.h) that every evaluation makes sure of: contacts, their
/// order, and bits do not depend on when lists are made. After a change of the skin one is made anew. Not for two
/// threads at once: lists and contacts found are kept.
///
/// pre     samples and solids live as long as the term, are those of one body, and change together
/// cost    O(nodes of skin tetrahedra) to see whether the list holds, O(candidates); no allocation once there have been
///         as many candidates and contacts before
class BodyContact final : public ForceTerm {
 public:
  /// throws  InputError where a law is not valid, or a pair is named twice
  BodyContact(const std::vector<SkinSample>& samples, const SkinSolids& solids, const std::vector<ContactPair>& pairs);
  BodyContact(const BodyContact&) = delete;  // lists look at the groups where they are
  BodyContact& operator=(const BodyContact&) = delete;

  const std::vector<SkinSample>& samples() const { return samples_; }
  const SkinSolids& solids() const { return solids_; }
  std::span<const ContactLaw> laws() const { return laws_; }
  bool has_friction() const { return friction_; }
  bool has_damping() const { return damping_; }

  /// How far beyond a tetrahedron candidates are listed, over the mean size of tetrahedra [1/4].
  /// pre  > 0 and finite
  void set_margin(double share) { candidates_.set_margin(share); }
  /// The list and how often it was made.
  const CandidatePairs& candidates() const { return candidates_; }

  /// What touches, in the order of samples; valid until the next call of anything. Without those out of reach.
  std::span<const BodyTouch> touching(const StagePlaces& at) const;
  /// Of the same places, beside these: those out of reach, without triangle and depth.
  std::span<const BodyTouch> out_of_reach() const { return lost_; }
  /// The same two by asking every sample and every tetrahedron: the oracle of lists.
  /// cost  O(samples times tetrahedra)
  std::vector<BodyTouch> touching_by_brute_force(const StagePlaces& at, std::vector<BodyTouch>* out_of_reach) const;

  /// Where the force along the normal acts: the sample, less the nearest point.
  ContactSite normal_site(const BodyTouch& touch) const;
  /// Where forces across it act: the sample, less the place in the other body that it is at.
  ContactSite tangential_site(const BodyTouch& touch) const;

  BodyContactState state_at(std::span<const Eigen::Vector3d> x) const;
  /// By vertex: the largest depth [m] of a sample of its own; those outside are left as they are.
  void raise_vertex_depths(std::span<const Eigen::Vector3d> x, std::span<double> depth) const;
  /// The samples that have gone on inwards beyond what is asked for since the call before, or are out of reach: last
  /// depth known, which is less than theirs now. Empty where the samples have changed since.
  std::span<const BodyTouch> find_lost(std::span<const Eigen::Vector3d> x);
  /// What `touching` or `find_lost` has found, if nothing else was asked since.
  std::span<const BodyTouch> found_touching() const { return touching_; }

  /// [m] the least altitude of a tetrahedron at these places; infinite without any. What comes further in a step than
  /// half of it may pass through.
  double least_altitude(std::span<const Eigen::Vector3d> x) const;

  /// As ObstacleContact::frequency_squared, with both sides: were every sample at this share of the depth of its law,
  /// in a surface with as much area to its samples as its own, or the largest sample of all on one vertex.
  double frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const;
  /// The same of the contacts that there are at x: an upper bound of what they add now.
  double frequency_squared_at(std::span<const Eigen::Vector3d> x, std::span<const double> inverse_mass) const;

  /// Forces that friction has during a step, as ObstacleContact has them: constant, with the energy - F . (difference -
  /// from). ContactImpulses sets them, in the order of samples.
  std::span<const BodyFriction> frozen_friction() const { return frozen_; }
  std::vector<BodyFriction>& frozen_friction_to_set() { return frozen_; }

  std::string_view pieces_name() const override { return "contact samples"; }
  std::size_t size() const override {
    return samples_.size() + solids_.triangles().size() + solids_.tetrahedra().size();
  }
  Nodes nodes(std::size_t piece) const override;
  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  /// throws  SolverError: there is no discrete gradient through kinks
  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override;
  double energy(std::span<const Eigen::Vector3d> x, std::size_t first = 0, std::size_t stride = 1) const override;
  /// From the depths before and after: to eps times force and coordinates.
  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step, double scale) const override;
  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override;
  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override;
  /// Of samples as deep as their laws allow, in the stiffest law that they may have; of the other side as much.
  void for_each_constant_tangent(const VisitTangent& visit) const override;
  Virial virial(std::span<const Eigen::Vector3d>, std::size_t) const override { return {}; }

  std::size_t bytes() const;

 private:
  template <class Place, class Tetrahedra, class F>
  void look_at(std::uint32_t sample, const Tetrahedra& tetrahedra, const Place& place, const F& found) const;
  template <class Place>
  void find_touching(const Place& place) const;
  /// Over the laws that the sample may have, each at this share of its depth [N/m].
  double largest_stiffness(std::uint32_t sample, double share_of_depth) const;

  const std::vector<SkinSample>& samples_;
  const SkinSolids& solids_;
  std::vector<ContactLaw> laws_;
  ContactGroups groups_;
  bool friction_ = false, damping_ = false;
  std::vector<BodyFriction> frozen_;

  mutable CandidatePairs candidates_;
  mutable std::vector<BodyTouch> touching_, lost_, earlier_;
  mutable std::vector<std::uint8_t> asked_;                                   // by piece
  mutable std::vector<std::pair<std::uint32_t, std::uint32_t>> by_triangle_;  // place of a touch
  mutable std::size_t inverted_ = 0;
  // of find_lost
  std::vector<BodyTouch> before_, gone_;
  std::uint64_t before_changes_ = 0;
};

}  // namespace dartboard
