#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dartboard {

/// Items 0, 1, ..., each in a set of its own until they are joined; a set is known by its lowest item.
///
/// source  Tarjan: Efficiency of a good but not linear set union algorithm, 1975; paths are halved
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t items) : above_(items), count_(items) {
    std::iota(above_.begin(), above_.end(), std::uint32_t{0});
  }
  std::uint32_t set_of(std::uint32_t item) {
    while (above_[item] != item) item = above_[item] = above_[above_[item]];
    return item;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = set_of(a);
    b = set_of(b);
    count_ -= a != b;
    above_[std::max(a, b)] = std::min(a, b);
  }
  /// The number of sets.
  std::size_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> above_;
  std::size_t count_;
};

}  // namespace dartboard
