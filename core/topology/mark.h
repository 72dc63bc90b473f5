#pragma once
// Marks: "all darts of the cell are marked" (section 4.2), without the paper's second coverage to unmark them.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/topology/storage/dart.h"

namespace dartboard {

/// The marks of one map; any number may be in use at once. Stamps are reused, so taking a mark does not allocate
/// once the pool is warm.
///
/// A dart is marked when its stamp equals the current epoch of the mark; clearing starts a new epoch. One-byte epochs
/// would need less memory but a full sweep every 255 clears, and walks of small orbits clear once each.
class MarkPool {
 public:
  struct Stamps {
    std::vector<std::uint32_t> stamp;  // per dart slot
    std::uint32_t epoch = 0;
    std::vector<Dart> stack;  // scratch of the walk that uses this mark
    bool in_use = false;
  };

  Stamps& take(std::size_t dart_slots);
  /// A slot is about to hold a new dart: it is unmarked everywhere.
  void forget(Dart d);
  std::size_t in_use() const;

 private:
  std::vector<std::unique_ptr<Stamps>> all_;
};

/// One mark on the darts of a map, released when it goes out of scope.
///
/// cost    set, test and clear O(1); one clear in 2^32 sweeps the stamps
class Mark {
 public:
  template <class Map>
  explicit Mark(const Map& map) : stamps_(&map.marks().take(map.capacity())) {}
  ~Mark() {
    if (stamps_) stamps_->in_use = false;
  }
  Mark(Mark&& other) noexcept : stamps_(std::exchange(other.stamps_, nullptr)) {}
  Mark(const Mark&) = delete;
  Mark& operator=(const Mark&) = delete;
  Mark& operator=(Mark&&) = delete;

  bool operator()(Dart d) const { return d.index < stamps_->stamp.size() && stamps_->stamp[d.index] == stamps_->epoch; }
  void set(Dart d) {
    if (d.index >= stamps_->stamp.size()) grow(d);
    stamps_->stamp[d.index] = stamps_->epoch;
  }
  /// Set it; true if the dart was unmarked before.
  bool set_if_new(Dart d) {
    if (d.index >= stamps_->stamp.size()) grow(d);
    auto& stamp = stamps_->stamp[d.index];
    if (stamp == stamps_->epoch) return false;
    stamp = stamps_->epoch;
    return true;
  }
  void unset(Dart d) {
    if ((*this)(d)) stamps_->stamp[d.index] = 0;
  }
  void clear();

  std::vector<Dart>& stack() { return stamps_->stack; }

 private:
  void grow(Dart d);
  MarkPool::Stamps* stamps_;
};

}  // namespace dartboard
