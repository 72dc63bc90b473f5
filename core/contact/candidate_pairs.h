#pragma once
// Which samples are near which tetrahedra: a list with a margin, valid until two vertices have moved by it relative to
// each other.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/box_around.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"
#include "core/forces/force_term.h"

namespace dartboard {

/// Which groups may touch, and by which law: a table.
class ContactGroups {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// throws  InputError if the pair already has a law
  void set(std::uint32_t a, std::uint32_t b, std::uint32_t law);
  /// The number of their law; `none` if they do not touch.
  std::uint32_t law(std::uint32_t a, std::uint32_t b) const {
    return a < count_ && b < count_ ? table_[a * count_ + b] : none;
  }
  std::size_t count() const { return count_; }
  std::size_t bytes() const { return table_.size() * sizeof(std::uint32_t); }

 private:
  std::size_t count_ = 0;
  std::vector<std::uint32_t> table_;
};

/// Whether a sample may touch a tetrahedron, whatever their places: groups that may touch, and no vertex shared
/// with a cell at one of the sample's own nodes.
class MayTouch {
 public:
  MayTouch(const SkinSolids& solids, const ContactGroups& groups) : solids_(solids), groups_(groups) {}
  /// Sets the sample of the next calls.
  void look_at(const SkinSample& sample);
  bool operator()(const SkinTetrahedron& tetrahedron);
  std::size_t bytes() const { return near_.size() * sizeof(std::uint64_t); }

 private:
  void mark_near();

  const SkinSolids& solids_;
  const ContactGroups& groups_;
  const SkinSample* sample_ = nullptr;
  std::uint32_t group_ = 0;
  bool marked_ = false;
  std::vector<std::uint64_t> near_;  // by node: the last sample near which it was
  std::uint64_t current_ = 0;
};

/// All pairs whose sample is less than a margin beyond the bounding box of the tetrahedron, and may touch it: by
/// sample, for each the tetrahedra in the order of their cells and parts. Found with a hashed grid of the tetrahedra.
class CandidatePairs {
 public:
  /// The candidates of a sample: from `first` on in `tetrahedra()`.
  struct Row {
    std::uint32_t sample, first, count;
  };

  CandidatePairs(const std::vector<SkinSample>& samples, const SkinSolids& solids, const ContactGroups& groups);

  void set_margin(double share);
  double margin_share() const { return share_; }
  /// [m] That of the list.
  double margin() const { return margin_; }

  /// Make the list anew if two vertices may have moved by the margin relative to each other since, or the skin has
  /// changed. `follows`: the ways of the places since the last call are needed.
  /// cost  O(nodes of tetrahedra) where it holds
  void make_sure(const StagePlaces& at, bool follows = false);
  /// [m] How far two places can go from `at`, relative to each other, until a sample may be inside a tetrahedron; 0 if
  /// that is not known, as where the list does not hold.
  /// cost  O(nodes of tetrahedra)
  double room_at(const StagePlaces& at);
  /// The number of the last call. Where two calls of the same skin and nothing between them both follow, the second
  /// has the next number, and knows the ways from the one to the other; otherwise a number is left out.
  std::uint64_t call() const { return call_; }
  /// [m] An upper bound of the displacement of a node of a tetrahedron since the previous call that followed, up to one
  /// common translation; infinite if one of its positions was not a number.
  double way_of(std::uint32_t node) const { return ways_[node]; }
  std::span<const Row> rows() const { return rows_; }
  std::span<const std::uint32_t> tetrahedra() const { return tetrahedra_; }
  /// Whether the sample and the tetrahedron of a pair can have come together at the places of the last `make_sure`:
  /// they have not moved by as much as they were apart.
  bool can_have_met(std::size_t pair) const { return gaps_[pair] <= moved_together_; }
  /// [m] All tetrahedra that a sample may touch are listed if they are this near to it.
  double reach() const { return margin_ - moved_together_; }
  /// Was the list made for the places of the last call?
  bool is_fresh() const { return moved_together_ == 0.0; }
  /// Make the list anew, unless it is fresh. False if it is.
  bool make_fresh(const StagePlaces& at);
  bool none_can_have_met() const { return moved_together_ < least_gap_; }
  std::size_t pair_count() const { return tetrahedra_.size(); }
  /// The number of times a list has been made.
  std::uint64_t times_made() const { return made_; }
  std::size_t bytes() const;

 private:
  struct Box {
    Eigen::Vector3d low, high;
  };
  /// Vertices that follow each other.
  struct Run {
    std::uint32_t first, count, place;  // place: of the first, among all
  };
  BoxAround ways_from(const std::vector<Eigen::Vector3d>& from, const StagePlaces& to) const;
  bool holds(const StagePlaces& at);
  void copy_places(const StagePlaces& at, std::vector<Eigen::Vector3d>& to) const;
  void follow(const StagePlaces& at);
  void watch();
  void make();
  void put_into_grid();
  double rounding_of(const Box& box) const;
  double gap_between(const Eigen::Vector3d& y, const SkinTetrahedron& tetrahedron) const;
  std::size_t bucket_of(double x, double y, double z) const;

  const std::vector<SkinSample>& samples_;
  const SkinSolids& solids_;
  double share_ = 0.25;

  std::vector<Row> rows_;
  std::vector<std::uint32_t> tetrahedra_;
  // [m] by pair: at most the distance between the two when the list was made, 0 where it is not known
  std::vector<float> gaps_;
  double moved_together_ = 0.0;  // [m] at least the largest way of two vertices since, relative to each other
  double margin_ = 0.0;          // [m] that it may have
  double least_gap_ = 0.0;       // [m] the least of `gaps_`; the margin without a pair
  // nodes of tetrahedra, and a few between them; their places when the list was made
  std::vector<Run> watched_;
  std::vector<Eigen::Vector3d> where_;
  std::uint64_t changes_ = 0, made_ = 0;
  std::size_t sample_count_ = 0;
  // their places at the last call that followed, and their ways to it; empty if the last call did not
  std::vector<Eigen::Vector3d> last_;
  std::vector<double> ways_;  // [m] by node
  std::uint64_t last_changes_ = 0, call_ = 0;

  // scratch
  MayTouch may_touch_;
  std::vector<std::uint32_t> place_of_node_;  // in where_
  std::vector<Box> boxes_;                    // of tetrahedra, with the margin
  std::vector<std::uint32_t> bucket_first_, bucket_entry_, everywhere_, found_;
  double cell_size_ = 0.0;
  std::uint64_t stride_y_ = 0, stride_z_ = 0;  // from a cell of the grid to its neighbour
};

}  // namespace dartboard
