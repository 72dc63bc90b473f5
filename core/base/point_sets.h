#pragma once
// Edges, faces and cells, found again by their points.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace dartboard {

/// Sets of up to `most` points, each with a number that its user gives it: short chains by the lowest point, which
/// are near each other in memory if cells are, without sorting all sets.
///
/// cost  a set is compared with a quarter of those of the same lowest point, some three in a mesh; 4 (most + 1) bytes
///       for each, and 16 for each point
template <std::size_t most>
class PointSets {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// Ascending, filled up with `none`.
  using Set = std::array<std::uint32_t, most>;

  /// Memory for so many different sets is taken at once; more may come.
  PointSets(std::size_t points, std::size_t sets) : head_(chains * points, none) { met_.reserve(sets); }

  static Set set_of(std::span<const std::uint32_t> points) {
    Set set;
    set.fill(none);
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::size_t at = k;
      for (; at > 0 && set[at - 1] > points[k]; --at) set[at] = set[at - 1];
      set[at] = points[k];
    }
    return set;
  }

  /// The number of a set, `none` if it is met for the first time; the reference is valid until the next call.
  ///
  /// pre  two points or more, each less than the number of points given
  std::uint32_t& number_of(const Set& set) {
    std::uint32_t& head = head_[chains * std::size_t{set[0]} + set[1] % chains];
    for (std::uint32_t m = head; m != none; m = met_[m].next) {
      bool is_same = true;  // compared here: for so few numbers the library calls a function
      for (std::size_t k = 1; k < most; ++k) is_same = is_same && met_[m].others[k - 1] == set[k];
      if (is_same) return met_[m].number;
    }
    std::array<std::uint32_t, most - 1> others;
    std::copy(set.begin() + 1, set.end(), others.begin());
    met_.push_back({others, none, std::exchange(head, static_cast<std::uint32_t>(met_.size()))});
    return met_.back().number;
  }

  /// Call f(number) for each set, in the order in which they were met first.
  template <class F>
  void for_each(F&& f) const {
    for (const Met& met : met_) f(met.number);
  }

 private:
  struct Met {
    std::array<std::uint32_t, most - 1> others;
    std::uint32_t number;
    std::uint32_t next;  // of the same chain
  };
  static constexpr std::uint32_t chains = 4;  // per lowest point, by the next one

  std::vector<std::uint32_t> head_;
  std::vector<Met> met_;
};

}  // namespace dartboard
