#pragma once
// The changes of a map by operations, one primitive write at a time, so that they can be taken back.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dartboard {

/// One primitive change of a storage: a link written, or a slot born (at the end, or from the free slots) or dead.
struct Change {
  enum class Kind : std::uint32_t { link, append, reuse, remove };
  Kind kind;
  std::uint32_t where;   // index of the link, or number of the slot
  std::uint32_t before;  // the link's value, or the slot's generation
  std::uint32_t after;
};

/// The changes of a map since the journal was attached to it, with a position that moves back and forth.
///
/// cost    16 bytes and one push per primitive change while recording; nothing when no journal is attached
class Journal {
 public:
  /// A place to come back to.
  using Position = std::size_t;

  void record(const Change& change) {
    changes_.resize(position_);  // a new change forgets what could have been redone
    changes_.push_back(change);
    ++position_;
  }
  Position position() const { return position_; }
  Position end() const { return changes_.size(); }

  /// Take back, newest first, all changes after `to`.
  template <class Map>
  void undo(Map& map, Position to) {
    while (position_ > to) map.undo(changes_[--position_]);
  }
  /// Make again, oldest first, the undone changes up to `to`.
  template <class Map>
  void redo(Map& map, Position to) {
    while (position_ < to && position_ < changes_.size()) map.redo(changes_[position_++]);
  }
  void clear() {
    changes_.clear();
    position_ = 0;
  }
  std::size_t bytes() const { return changes_.capacity() * sizeof(Change); }

 private:
  std::vector<Change> changes_;
  Position position_ = 0;
};

}  // namespace dartboard
