#pragma once
// General storage: every alpha_i of every dart, in one flat array.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/topology/storage/dart.h"
#include "core/topology/storage/involutions.h"
#include "core/topology/storage/journal.h"

namespace dartboard {

/// The alphas of an n-g-map of any cells: 4 (N + 1) bytes per dart and 4 for its generation.
///
/// Dead slots are kept in a stack and used again, last out first in, so undoing a series of births and deaths
/// restores the very same slots.
template <int N>
class AlphaTable {
 public:
  static constexpr int dimension = N;
  static constexpr bool tetrahedral = false;

  Dart alpha(int i, Dart d) const { return {alphas_[at(i, d)]}; }

  std::size_t capacity() const { return generation_.size(); }
  std::size_t dart_count() const { return capacity() - free_.size(); }
  bool is_live(Dart d) const { return d.index < capacity() && generation_[d.index] != 0; }
  std::uint32_t generation(Dart d) const { return is_live(d) ? generation_[d.index] : 0; }

  /// The place of the label of the i-cell of `d`, when every dart holds one; here each dart has its own place.
  template <int i>
  static std::uint32_t slot(Dart d) {
    return d.index;
  }
  /// The number of such places.
  template <int i>
  std::size_t slot_count() const {
    return capacity();
  }

  /// A new dart, i-free for all i.
  Dart add_dart();
  /// pre  d is live and i-free for all i
  void remove_dart(Dart d);
  /// alpha_i(a) = b and alpha_i(b) = a; a == b makes it i-free. Touches these two darts and no other.
  void link(int i, Dart a, Dart b) {
    write(at(i, a), b.index);
    write(at(i, b), a.index);
  }

  void attach(Journal* journal) { journal_ = journal; }
  void undo(const Change& change);
  void redo(const Change& change);

  std::size_t bytes() const { return 4 * (alphas_.capacity() + generation_.capacity() + free_.capacity()); }
  /// Equal for equal tables, dead slots and their order included.
  std::uint64_t hash() const;
  /// Writes or reads what a checkpoint holds (core/base/archive.h).
  template <class Archive>
  void state(Archive& archive) {
    archive(alphas_, generation_, free_, births_);
  }

 private:
  static std::size_t at(int i, Dart d) {
    return static_cast<std::size_t>(d.index) * (N + 1) + static_cast<std::size_t>(i);
  }
  void write(std::size_t where, std::uint32_t value) {
    if (journal_) journal_->record({Change::Kind::link, static_cast<std::uint32_t>(where), alphas_[where], value});
    alphas_[where] = value;
  }
  void appear(std::uint32_t slot, std::uint32_t generation);
  void vanish(std::uint32_t slot);

  std::vector<std::uint32_t> alphas_;      // alphas_[(N + 1) d + i]
  std::vector<std::uint32_t> generation_;  // 0 for a dead slot
  std::vector<std::uint32_t> free_;
  std::uint32_t births_ = 0;  // never decreases: a generation is not given out twice
  Journal* journal_ = nullptr;
};

extern template class AlphaTable<2>;
extern template class AlphaTable<3>;

}  // namespace dartboard
