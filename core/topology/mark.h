#pragma once
// Marks: "all darts of the cell are marked" (section 4.2), without the paper's second coverage to unmark them.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/topology/storage/dart.h"

namespace dartboard {

/// The marks of one map; any number may be in use at once. Their memory is used again, so taking a mark does not
/// allocate once the pool is warm.
///
/// A mark is a bit per dart slot and a list of the words that have one: only these are cleared, so a walk around a
/// vertex costs what it visits. In bodies of 50,000 tetrahedra and more a walk takes two thirds of the time that it
/// takes with an epoch of four bytes for each dart, since the bits stay in the cache; in small ones a fifth more.
class MarkPool {
 public:
  struct Bits {
    // Of 16 dart slots: steps of a walk that set bits of one word wait for each other. 0 where no mark is in use.
    std::vector<std::uint16_t> words;
    std::vector<std::uint32_t> used;  // room for the words that a mark sets; where it is too little, all are cleared
    std::vector<Dart> stack;          // scratch of the walk that uses this mark
    bool in_use = false;

    void make_room(std::size_t count);
  };

  Bits& take(std::size_t dart_slots);
  /// A slot is about to hold a new dart: it is unmarked everywhere.
  void forget(Dart d);
  std::size_t in_use() const;

 private:
  std::vector<std::unique_ptr<Bits>> all_;
};

/// One mark on the darts of a map, released when it goes out of scope.
///
/// cost    set and test O(1), clear and release O(darts set); O(darts of the map) / 16 where an eighth of all
/// words was set
class Mark {
 public:
  template <class Map>
  explicit Mark(const Map& map) : bits_(&map.marks().take(map.capacity())) {
    look();
  }
  ~Mark() {
    if (bits_ == nullptr) return;
    clear();
    bits_->in_use = false;
  }
  Mark(Mark&& other) noexcept
      : bits_(std::exchange(other.bits_, nullptr)),
        words_(other.words_),
        used_(other.used_),
        word_count_(other.word_count_),
        room_(other.room_),
        used_count_(other.used_count_),
        is_list_whole_(other.is_list_whole_) {}
  Mark(const Mark&) = delete;
  Mark& operator=(const Mark&) = delete;
  Mark& operator=(Mark&&) = delete;

  bool operator()(Dart d) const {
    const std::size_t at = d.index / 16;
    return at < word_count_ && (words_[at] >> d.index % 16 & 1u) != 0;
  }
  void set(Dart d) { set_if_new(d); }
  /// Set it; true if the dart was unmarked before.
  bool set_if_new(Dart d) {
    const std::uint32_t at = d.index / 16;
    if (at >= word_count_) add_words(at);
    const unsigned before = words_[at], bit = 1u << d.index % 16;
    if ((before & bit) != 0) return false;
    words_[at] = static_cast<std::uint16_t>(before | bit);
    if (before == 0) {
      if (used_count_ == room_) start_list_anew();
      used_[used_count_++] = at;
    }
    return true;
  }
  void unset(Dart d) {
    if ((*this)(d)) words_[d.index / 16] &= static_cast<std::uint16_t>(~(1u << d.index % 16));
  }
  void clear() {
    if (!is_list_whole_) return clear_all();
    for (std::size_t k = 0; k < used_count_; ++k) words_[used_[k]] = 0;
    used_count_ = 0;
  }

  std::vector<Dart>& stack() { return bits_->stack; }

 private:
  void look() {
    words_ = bits_->words.data();
    used_ = bits_->used.data();
    word_count_ = bits_->words.size();
    room_ = bits_->used.size();
  }
  void add_words(std::uint32_t at);
  void clear_all();
  void start_list_anew() {
    is_list_whole_ = false;
    used_count_ = 0;
  }

  MarkPool::Bits* bits_;
  // of its bits, here since a walk then holds them in registers
  std::uint16_t* words_ = nullptr;
  std::uint32_t* used_ = nullptr;
  std::size_t word_count_ = 0, room_ = 0, used_count_ = 0;
  bool is_list_whole_ = true;
};

}  // namespace dartboard
