#pragma once
// Tetrahedral storage: alpha_0, alpha_1, alpha_2 are a constant table, alpha_3 costs four bytes per face of a cell.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/topology/storage/dart.h"
#include "core/topology/storage/journal.h"
#include "core/topology/storage/tet_darts.h"

namespace dartboard {

/// alpha_3 of a 3-g-map of tetrahedra: 16 bytes per tetrahedron and 4 for its generation.
class TetTable {
 public:
  static constexpr int dimension = 3;
  static constexpr bool tetrahedral = true;

  Dart alpha(int i, Dart d) const {
    if (i == 3) return alpha3(d.index / 6, d.index % 6);
    const std::uint32_t t = d.index / 24, p = d.index % 24;
    return {24 * t + tet_darts.alpha[static_cast<std::size_t>(i)][p]};
  }

  std::size_t capacity() const { return 24 * generation_.size(); }
  std::size_t dart_count() const { return 24 * (generation_.size() - free_.size()); }
  bool is_live(Dart d) const { return is_live_tetrahedron(d.index / 24); }
  bool is_live_tetrahedron(std::uint32_t t) const { return t < generation_.size() && generation_[t] != 0; }
  std::uint32_t generation(Dart d) const { return is_live(d) ? generation_[d.index / 24] : 0; }

  /// The place of the label of the i-cell of `d`: tetrahedron by tetrahedron, 4 nodes, 6 edges, 4 faces, 1 volume.
  template <int i>
  static std::uint32_t slot(Dart d) {
    const std::uint32_t t = d.index / 24, p = d.index % 24;
    if constexpr (i == 0) return 4 * t + tet_darts.node[p];
    if constexpr (i == 1) return 6 * t + tet_darts.edge[p];
    if constexpr (i == 2) return 4 * t + p / 6;
    if constexpr (i == 3) return t;
  }
  template <int i>
  std::size_t slot_count() const {
    return generation_.size() * (i == 0 || i == 2 ? 4u : i == 1 ? 6u : 1u);
  }

  /// A new tetrahedron, all its faces 3-free; the first of its 24 darts.
  Dart add_tetrahedron();
  /// pre  the tetrahedron of d is live and its faces are 3-free
  void remove_tetrahedron(Dart d);
  /// alpha_3(a) = b for the whole face: its other five darts follow, because alpha_0 alpha_3 and alpha_1 alpha_3 are
  /// involutions. a == b makes the face 3-free.
  /// pre  i == 3
  void link(int i, Dart a, Dart b);

  /// Face slot and turn that face slot s is sewn to, packed as 8 * slot + turn: dart r of s is opposite dart
  /// tet_darts.turned[r][turn] of that slot. For walks that go face by face.
  std::uint32_t opposite(std::uint32_t s) const { return opposite_[s]; }

  void attach(Journal* journal) { journal_ = journal; }
  void undo(const Change& change);
  void redo(const Change& change);

  std::size_t bytes() const { return 4 * (opposite_.capacity() + generation_.capacity() + free_.capacity()); }
  std::uint64_t hash() const;
  /// Writes or reads what a checkpoint holds (core/base/archive.h).
  template <class Archive>
  void state(Archive& archive) {
    archive(opposite_, generation_, free_, births_);
  }

 private:
  Dart alpha3(std::uint32_t s, std::uint32_t r) const {
    const std::uint32_t o = opposite_[s];
    return {(o >> 3) * 6 + tet_darts.turned[r][o & 7]};
  }
  void write(std::uint32_t where, std::uint32_t value) {
    if (journal_) journal_->record({Change::Kind::link, where, opposite_[where], value});
    opposite_[where] = value;
  }
  void appear(std::uint32_t slot, std::uint32_t generation);
  void vanish(std::uint32_t slot);

  std::vector<std::uint32_t> opposite_;    // per face slot 4 t + f
  std::vector<std::uint32_t> generation_;  // per tetrahedron; 0 for a dead one
  std::vector<std::uint32_t> free_;
  std::uint32_t births_ = 0;
  Journal* journal_ = nullptr;
};

}  // namespace dartboard
