#pragma once
// Twins: the same map in another carrier, addressed by the names of its darts.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/storage/dart.h"
#include "core/topology/storage/involutions.h"

namespace dartboard {

/// The darts of one cell: node and alphas by position in the cell, face by face and edge by edge as `faces_of` lists
/// them, two darts per edge. alpha_n, n the dimension of the kind, is free. Derived here once more, not taken from
/// core.
struct CellShape {
  int dimension = 0;
  std::vector<std::uint8_t> node;                  // local node
  std::vector<std::array<std::uint8_t, 3>> alpha;  // position of alpha_0, alpha_1, alpha_2; itself where free
};
const CellShape& shape_of(CellKind kind);

/// A map written out: names of its darts, ascending, and their alphas.
struct AlphaList {
  int dimension = 0;
  std::vector<Dart> darts;
  std::vector<std::array<Dart, 4>> alphas;  // parallel to darts
};

/// The map that a mesh should have, without core: cells numbered in order, their darts named from 0 by position, and
/// facets of equal nodes n-linked. A mesh without cells counts as a solid.
/// throws  InputError if three cells share a facet
AlphaList alphas_of(const Mesh& mesh);

/// The numbers of vertices, edges and faces added by a dissociation.
using SplitCounts = std::array<long, 3>;

/// A map whose darts have names: the numbers of a script. A name is never used for a second dart.
class MapTwin {
 public:
  virtual ~MapTwin() = default;
  virtual std::string library() const = 0;  // "CGAL g-map"
  virtual int dimension() const = 0;

  // ---- darts and walks
  virtual std::size_t dart_count() const = 0;
  virtual bool is_live(Dart d) const = 0;
  virtual std::vector<Dart> darts() const = 0;  // ascending
  virtual Dart alpha(int i, Dart d) const = 0;
  /// Whether the carrier has a walk for this kind of orbit at all.
  virtual bool can_walk(Involutions) const { return true; }
  /// The darts of the orbit, replacing what `darts` held, in the order of the carrier's own walk.
  /// pre  can_walk(set)
  virtual void orbit(Involutions set, Dart d, std::vector<Dart>& darts) const = 0;

  // ---- the carrier's answers on the whole map
  virtual std::vector<std::size_t> count_cells() const = 0;  // i-cells for i = 0 .. n, then components
  virtual std::optional<bool> is_orientable() const = 0;     // nothing: the carrier has no notion of it
  virtual std::string violation() const = 0;                 // empty for a valid map
  virtual std::string violation_near(std::span<const Dart>) const { return {}; }

  // ---- operations; if a carrier cannot represent one, which is asked beforehand, all twins skip it
  virtual bool can_carry_sew(int i, Dart a, Dart b) const = 0;
  virtual bool can_carry_unsew(int i) const = 0;
  virtual bool can_carry(CellKind kind) const = 0;
  virtual bool can_sew(int i, Dart a, Dart b) const = 0;
  /// Whether the carrier refuses, on purpose, to sew a cell to itself.
  virtual bool refuses_folds() const = 0;
  virtual void sew(int i, Dart a, Dart b) = 0;
  virtual void unsew(int i, Dart d) = 0;
  /// n-unsews, and returns what came apart; here by counting the cells around before and after.
  virtual SplitCounts dissociate(Dart d);
  /// A new isolated cell, its darts named from `first` by position.
  virtual void add(CellKind kind, Dart first) = 0;
  /// n-unsews the n-cell of d all around, then takes its darts away.
  virtual void remove(Dart d) = 0;

  /// Writes the map out, dart by dart.
  AlphaList alphas() const;
  /// The smallest name in the orbit of each dart, in the order of darts(): equal partitions, equal labels.
  std::vector<Dart> labels(Involutions set) const;
};

/// The darts of both lines that an i-unsew of d touches, or an i-sew of d and e.
std::vector<Dart> darts_touched(const MapTwin& map, int i, Dart d, Dart e);

/// The number of i-cells that contain the darts, i = 0 .. n; no more than n + 1 entries.
std::vector<long> count_cells_around(const MapTwin& map, std::span<const Dart> darts);

}  // namespace dartboard
