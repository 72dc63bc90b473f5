#pragma once
// Contact between bodies, and of a body with itself, as a force term.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/candidate_pairs.h"
#include "core/contact/contact_law.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"
#include "core/contact/touch.h"
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
  std::uint32_t tetrahedron = 0;  // place among the tetrahedra: the one that it is inside of
  std::uint32_t triangle = none;  // place among the triangles: the way out; `none`: out of reach
  std::uint32_t law = 0;
  double area = 0.0;                // [m^2] half of the area of the sample: the other side has the other half
  double depth = 0.0;               // [m], above 0 if there is a triangle
  Eigen::Vector3d normal{0, 0, 0};  // outwards, of length 1: the force on the sample is along it
  std::array<double, 3> nearest{};  // weights of the nearest point over the triangle's corners
  std::array<double, 4> inside{};   // weights of the sample's own place over the tetrahedron's
};

class WaysOut;

/// A zero-thickness penalty between solids: each sample of the skin that is inside a tetrahedron along the boundary of
/// a body it may touch has the energy of a law at its depth, on half of its area. The samples of the other side have
/// the other half, so that a pressure is P0 (d / delta)^(p-1) where two surfaces overlap by d, as on an obstacle.
///
/// **Inside** means in a tetrahedron of positive present volume with all weights of the place above 0 at faces on the
/// boundary, and above -2^-40 at faces within the body, so that a place between two cells is in one of them; of several
/// the one of the lowest cell counts. Left out are tetrahedra that share a vertex with a cell at one of the sample's
/// own nodes, and pairs within a body that may not touch itself. **Depth** is the distance to the nearest boundary
/// triangle among those at the tetrahedron's corners, except triangles that have a node of the sample; its derivative
/// by the places is that of the line to the nearest point (envelope theorem), so that forces along that line, on the
/// sample's nodes and on the triangle's by the weights of the point, are the gradient of the energy, without sum and
/// torque. It has kinks where another triangle becomes the nearest. Depths below 2^-46 of the coordinates count as 0: a
/// body just cut has no contact. A sample without a triangle in reach has no contact, and is counted.
///
/// Pieces are the samples, then the triangles, then the tetrahedra, whether they touch or not: a sample has the energy
/// of its contact. A tangent is twice the stiffness along the normal on each side by itself, which is at least the true
/// one, whose blocks between the bodies appear and vanish; exact and projected tangents are both this one.
///
/// Candidates come from a list with a margin (candidate_pairs.h) that every evaluation checks: contacts, their order,
/// and bits do not depend on when lists are made. After a change of the skin the list is made anew. It must not be used
/// by two threads at once: lists and contacts found are kept, and found again only at other places.
///
/// pre     samples and solids live as long as the term, are those of one body, and change together
/// cost    O(nodes of skin tetrahedra) to check whether the list holds, O(candidates); no allocation once there have
///         been as many candidates and contacts before
class BodyContact final : public ForceTerm {
 public:
  /// `still` has a 1 for each group that does not move. Where two of them touch, what slides over both does not feel
  /// their sides (way_out.h); among groups that move it does.
  /// throws  InputError where a law is not valid, or a pair is named twice
  BodyContact(const std::vector<SkinSample>& samples, const SkinSolids& solids, const std::vector<ContactPair>& pairs,
              std::span<const std::uint8_t> still = {});
  /// The laws and the margin of another, between other samples and solids.
  BodyContact(const std::vector<SkinSample>& samples, const SkinSolids& solids, const BodyContact& other);
  ~BodyContact() override;
  BodyContact(const BodyContact&) = delete;  // lists refer to the groups in place
  BodyContact& operator=(const BodyContact&) = delete;

  const std::vector<SkinSample>& samples() const { return samples_; }
  const SkinSolids& solids() const { return solids_; }
  std::span<const ContactLaw> laws() const { return laws_; }
  bool may_touch(std::uint32_t group, std::uint32_t other) const {
    return groups_.law(group, other) != ContactGroups::none;
  }
  bool has_friction() const { return friction_; }
  bool has_damping() const { return damping_; }

  /// The distance beyond a tetrahedron up to which candidates are listed, over the mean size of tetrahedra [1/4].
  /// pre  > 0 and finite
  void set_margin(double share) {
    candidates_.set_margin(share);
    searched_.clear();
  }
  /// The list and the number of times it was made.
  const CandidatePairs& candidates() const { return candidates_; }
  /// The number of ways out that were searched among all triangles in reach; the others were known to be the nearest.
  std::uint64_t ways_searched() const;

  /// The contacts in the order of samples, without those out of reach; valid until the next call of any function.
  std::span<const BodyTouch> touching(const StagePlaces& at) const;
  /// [m] How far two places can go from x, relative to each other, until a sample may be inside a body; 0: not known.
  /// cost  O(nodes of skin tetrahedra): less than to search
  double room_at(std::span<const Eigen::Vector3d> x) const { return follows_ ? 0.0 : candidates_.room_at({x}); }
  /// The samples out of reach at the same places, without triangle and depth.
  std::span<const BodyTouch> out_of_reach() const { return lost_; }
  /// The number of candidates there that were ignored because they are turned inside out.
  std::size_t inverted() const { return inverted_; }
  /// Contacts and samples out of reach by testing every sample with every tetrahedron: the oracle of lists.
  /// cost  O(samples times tetrahedra)
  std::vector<BodyTouch> touching_by_brute_force(const StagePlaces& at, std::vector<BodyTouch>* out_of_reach) const;

  /// The site of the force along the normal: the sample, less the nearest point.
  ContactSite normal_site(const BodyTouch& touch) const;
  /// The site of forces across the normal: the sample, less its own place in the other body.
  ContactSite tangential_site(const BodyTouch& touch) const;

  /// The group of a sample, and that of the body that it is inside of.
  std::uint32_t group_of(std::uint32_t sample) const { return solids_.group_at(samples_[sample].nodes[0]); }
  std::uint32_t group_entered(const BodyTouch& touch) const { return solids_.tetrahedra()[touch.tetrahedron].group; }

  /// The samples that have moved inwards beyond all candidates since the last call, or are out of reach, with the last
  /// known depth, which is less than the present one. After a change of the skin only samples out of reach are found.
  std::span<const BodyTouch> find_lost(std::span<const Eigen::Vector3d> x);
  /// Has the last call seen nothing that a later one can find lost?
  bool has_none_to_lose() const { return before_.empty(); }

  /// [m] The least altitude of a tetrahedron at these places; infinite without tetrahedra. A place that moves further
  /// than half of it in a step may pass through.
  double least_altitude(std::span<const Eigen::Vector3d> x) const;

  /// As ObstacleContact::frequency_squared, with both sides: if every sample were at this share of the depth of its
  /// law, in a surface whose samples have the same area as its own, or the largest sample of all were on one vertex.
  double frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const;
  /// An upper bound of the present contribution of the contacts at x.
  double frequency_squared_at(std::span<const Eigen::Vector3d> x, std::span<const double> inverse_mass) const;

  /// The friction during a step, in all functions below.
  std::span<const ContactFriction> frozen_friction() const { return frozen_.rows; }
  std::vector<ContactFriction>& frozen_friction_to_set() { return frozen_.rows; }

  std::string_view pieces_name() const override { return "samples, triangles and tetrahedra along boundaries"; }
  std::size_t size() const override {
    return samples_.size() + solids_.triangles().size() + solids_.tetrahedra().size();
  }
  Nodes nodes(std::size_t piece) const override;
  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  /// throws  SolverError: there is no discrete gradient through kinks
  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override;
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override;
  double energy(std::span<const Eigen::Vector3d> x, std::size_t first = 0, std::size_t stride = 1) const override;
  /// Computed from the depths before and after: exact to eps times force and coordinates.
  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step, double scale) const override;
  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override;
  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override;
  /// For samples at the depth of their laws, in the stiffest law that they may have; the same for the other side.
  void for_each_constant_tangent(const VisitTangent& visit) const override;
  Virial virial(std::span<const Eigen::Vector3d>, std::size_t) const override { return {}; }

  std::size_t bytes() const;

 private:
  enum class Ways { followed, searched };
  /// Those that may cover ways: all that the sample may touch within the reach [m].
  struct Nearby {
    Ways ways;
    std::span<const std::uint32_t> tetrahedra;
    double reach = std::numeric_limits<double>::infinity();
  };
  template <class Tetrahedra, class F>
  void look_at(std::uint32_t sample, const Tetrahedra& tetrahedra, const Nearby& nearby, const StagePlaces& at,
               const F& found) const;
  void find_among_candidates(const StagePlaces& at) const;
  void find_partners(std::uint32_t sample) const;
  void find_touching(const StagePlaces& at) const;
  void find_touching_now(const StagePlaces& at) const;
  void exchange_with_aside() const;
  bool is_deep_inside(const BodyTouch& earlier, const StagePlaces& at) const;
  /// The largest over the laws that the sample may have, each at this share of its depth [N/m].
  double largest_stiffness(std::uint32_t sample, double share_of_depth) const;

  const std::vector<SkinSample>& samples_;
  const SkinSolids& solids_;
  std::vector<ContactLaw> laws_;
  ContactGroups groups_;
  bool friction_ = false, damping_ = false;
  FrozenFriction frozen_;

  mutable CandidatePairs candidates_;
  mutable std::vector<BodyTouch> touching_, lost_, earlier_;
  // The places that were searched last, with `changes()` then; empty if there are none. What was found there is put
  // aside while places within a step are searched.
  mutable std::vector<Eigen::Vector3d> searched_;
  mutable std::vector<Eigen::Vector3d> after_;  // the places after a step whose change of energy is taken
  mutable std::uint64_t searched_changes_ = 0;
  mutable bool put_aside_ = false;
  mutable std::vector<BodyTouch> touching_aside_, lost_aside_;
  mutable std::size_t inverted_aside_ = 0;
  mutable std::vector<std::uint32_t> near_, partners_;  // tetrahedra
  mutable bool short_of_reach_ = false;
  std::unique_ptr<WaysOut> ways_;            // which follow the candidates
  mutable bool follows_ = false;             // something has touched at the last places
  mutable std::vector<std::uint8_t> asked_;  // by piece
  mutable std::vector<std::pair<std::uint32_t, std::uint32_t>> by_triangle_;  // place of a touch
  mutable std::size_t inverted_ = 0;
  // for find_lost
  std::vector<BodyTouch> before_, gone_;
  std::uint64_t before_changes_ = 0;
};

}  // namespace dartboard
