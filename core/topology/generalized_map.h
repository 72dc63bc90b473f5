#pragma once
// The generalized map: darts and involutions (section 2.1), and nothing else. Cells are orbits, everything is derived.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/topology/mark.h"
#include "core/topology/storage/alpha_table.h"
#include "core/topology/storage/dart.h"
#include "core/topology/storage/involutions.h"
#include "core/topology/storage/journal.h"
#include "core/topology/storage/tet_table.h"
#include "core/topology/topology_errors.h"

namespace dartboard {

/// An N-dimensional generalized map, N = 2 for a surface and 3 for a solid.
///
/// The storage decides how alphas are stored: `AlphaTable<N>` for any cells, `TetTable` for tetrahedra. A dart is
/// i-free when alpha_i(d) = d, so walks need no null checks. `link` and `unlink` touch two darts and may break the
/// map's conditions; `sew` and `unsew` (sew.h) treat whole orbits and keep them; `check` (check.h) reports a violation.
///
/// Handles are checked where a call changes the map; alpha() of a dead dart is undefined.
/// Not safe to share between threads, reading included: marks live in the map.
template <int N, class Storage = AlphaTable<N>>
class GeneralizedMap {
  static_assert(N == 2 || N == 3, "surfaces and solids");
  static_assert(Storage::dimension == N);

 public:
  static constexpr int dimension = N;
  static constexpr bool tetrahedral = Storage::tetrahedral;

  GeneralizedMap() : marks_(std::make_unique<MarkPool>()) {}
  GeneralizedMap(const GeneralizedMap& other) : storage_(other.storage_), marks_(std::make_unique<MarkPool>()) {
    storage_.attach(nullptr);
  }
  GeneralizedMap(GeneralizedMap&&) noexcept = default;
  GeneralizedMap& operator=(GeneralizedMap other) noexcept {
    std::swap(storage_, other.storage_);
    std::swap(marks_, other.marks_);
    return *this;
  }
  ~GeneralizedMap() = default;

  // ---- involutions

  Dart alpha(int i, Dart d) const { return storage_.alpha(i, d); }
  /// alpha<0, 1, 3>(d) is alpha_3(alpha_1(alpha_0(d))): applied from left to right, as the paper writes it.
  template <int i, int... more>
  Dart alpha(Dart d) const {
    static_assert(0 <= i && i <= N);
    const Dart next = storage_.alpha(i, d);
    if constexpr (sizeof...(more) == 0)
      return next;
    else
      return alpha<more...>(next);
  }
  template <int i>
  bool is_free(Dart d) const {
    return alpha<i>(d) == d;
  }
  bool is_free(int i, Dart d) const { return alpha(i, d) == d; }

  // ---- darts

  /// Live darts; their slots are among 0 .. capacity() - 1.
  std::size_t dart_count() const { return storage_.dart_count(); }
  std::size_t capacity() const { return storage_.capacity(); }
  bool is_live(Dart d) const { return storage_.is_live(d); }
  template <class F>
  void for_each_dart(F&& f) const {
    const auto end = static_cast<std::uint32_t>(capacity());
    for (std::uint32_t slot = 0; slot < end; ++slot)
      if (is_live({slot})) f(Dart{slot});
  }

  /// A handle that detects the death of the dart.
  /// throws  TopologyError if it is dead already
  DartId id(Dart d) const {
    require_live(d);
    return {d, storage_.generation(d)};
  }
  /// throws  TopologyError if the dart has died, even if its slot is in use again
  Dart resolve(DartId id) const {
    if (id.generation == 0 || storage_.generation(id.dart) != id.generation)
      throw_dead(id.dart, id.generation, storage_.generation(id.dart));
    return id.dart;
  }
  void require_live(Dart d) const {
    if (!is_live(d)) throw_dead(d, 0, 0);
  }

  // ---- mutation, two darts at a time

  /// alpha_i(a) = b. In a tetrahedral map i is 3, and the whole face follows.
  /// throws  TopologyError if a or b is dead or not i-free, or a == b; or if a face would be turned onto itself
  template <int i>
  void link(Dart a, Dart b) {
    static_assert(0 <= i && i <= N && (!tetrahedral || i == 3));
    require_live(a);
    require_live(b);
    if (a == b) throw_link_to_itself(i, a);
    if (!is_free<i>(a)) throw_not_free(i, a, b, a, alpha<i>(a));
    if (!is_free<i>(b)) throw_not_free(i, a, b, b, alpha<i>(b));
    if constexpr (tetrahedral)
      if (a.index / 6 == b.index / 6 && (a.index + b.index) % 2 == 0) throw_turned_face(a, b);
    storage_.link(i, a, b);
  }
  /// Make `a` and alpha_i(a) i-free.
  /// throws  TopologyError if a is dead
  template <int i>
  void unlink(Dart a) {
    static_assert(0 <= i && i <= N && (!tetrahedral || i == 3));
    require_live(a);
    const Dart b = alpha<i>(a);
    if (a == b) return;
    storage_.link(i, a, a);
    storage_.link(i, b, b);
  }

  /// A new dart, free for every i.
  Dart add_dart() requires(!tetrahedral) {
    const Dart d = storage_.add_dart();
    marks_->forget(d);
    return d;
  }
  /// throws  TopologyError if d is dead or not free for every i
  void remove_dart(Dart d) requires(!tetrahedral) {
    require_live(d);
    for (int i = 0; i <= N; ++i)
      if (!is_free(i, d)) throw_cannot_remove(i, d, alpha(i, d));
    storage_.remove_dart(d);
  }
  /// The 24 darts of a new tetrahedron (tet_darts.h), 3-free; returns the first.
  Dart add_tetrahedron() requires tetrahedral {
    const Dart d = storage_.add_tetrahedron();
    for (std::uint32_t p = 0; p < 24; ++p) marks_->forget({d.index + p});
    return d;
  }
  /// throws  TopologyError if d is dead or a face of its tetrahedron is sewn
  void remove_tetrahedron(Dart d) requires tetrahedral {
    require_live(d);
    const std::uint32_t first = d.index - d.index % 24;
    for (std::uint32_t p = first; p < first + 24; p += 6)
      if (!is_free<3>({p})) throw_cannot_remove(3, {p}, alpha<3>({p}));
    storage_.remove_tetrahedron(d);
  }

  // ---- places for labels, marks, undo

  /// A number for the i-cell of d within its volume: all darts of a volume that lie on one i-cell may share it.
  template <int i>
  static std::uint32_t slot(Dart d) {
    return Storage::template slot<i>(d);
  }
  template <int i>
  std::size_t slot_count() const {
    return storage_.template slot_count<i>();
  }

  MarkPool& marks() const { return *marks_; }

  /// Record every change from now on in `journal`, which must outlive the recording; null stops.
  void attach(Journal* journal) { storage_.attach(journal); }
  /// For Journal only.
  void undo(const Change& change) { storage_.undo(change); }
  void redo(const Change& change) { storage_.redo(change); }

  /// Equal for equal maps: same darts, same alphas, same free slots.
  std::uint64_t hash() const { return storage_.hash(); }
  /// Writes or reads what a checkpoint holds: darts, alphas and free slots. Marks are not part of a map.
  /// pre  when it is read: no mark is in use, and no journal attached
  template <class Archive>
  void state(Archive& archive) {
    archive(storage_);
  }
  std::size_t bytes() const { return storage_.bytes(); }
  /// For the walks of this folder; nothing above topology/ may depend on it.
  const Storage& storage() const { return storage_; }

 private:
  Storage storage_;
  std::unique_ptr<MarkPool> marks_;
};

using Map2 = GeneralizedMap<2>;
using Map3 = GeneralizedMap<3>;
using TetMap = GeneralizedMap<3, TetTable>;

}  // namespace dartboard
