#pragma once
// The same map in several carriers, ours and CGAL's: operations applied to all of them, and their answers compared.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plain/mesh.h"
#include "validation/cgal/cgal_twin.h"
#include "validation/topology/topology_report.h"
#include "validation/topology/topology_script.h"

namespace dartboard {

/// A difference between the answers of two carriers of the same map.
struct Disagreement {
  std::size_t operation = 0;  // number of operations before the one after which it was seen
  std::string line;           // that operation; empty when it was seen before any
  std::string what;           // "alpha3(d17)"
  std::string ours, theirs;   // with the names of the carriers
};
std::string to_string(const Disagreement& disagreement);

/// The maps under test, for a mesh: core's, or a faulty stand-in. The first one is asked for legality and for the cells
/// that an operation can have changed; all are compared.
using MakeTwins = std::function<std::vector<std::unique_ptr<MapTwin>>(const Mesh&, ScriptStorage)>;
/// Map2 or Map3, and TetMap too for tetrahedral storage.
std::vector<std::unique_ptr<MapTwin>> core_twins(const Mesh& mesh, ScriptStorage storage);

/// One map in several carriers, to which operations are applied one after the other.
///
/// After each operation: legality verdicts; alphas of all touched darts; cells of all touched darts, as sets; cells per
/// dimension that came or went, against what one operation can change; validity around the touched darts of our maps.
class Lockstep {
 public:
  enum class Outcome { applied, illegal, not_carried };

  Lockstep(const Mesh& mesh, ScriptStorage storage, ScriptOracles oracles, const MakeTwins& ours = core_twins);

  /// Applies the operation, unless it is illegal or one of the twins cannot carry it: no twin applies it then. The
  /// first name of an added cell is filled in when it is missing. Any exception of a twin is a disagreement.
  std::optional<Disagreement> apply(Operation& operation);
  Outcome outcome() const { return outcome_; }  // of the last operation

  /// Everything of compare_twins, the cells counted so far, and CGAL's isomorphism test against fresh maps of our
  /// alphas.
  std::optional<Disagreement> compare_everything() const;

  const MapTwin& ours() const { return *twins_[0]; }
  std::span<const Dart> live() const { return live_; }  // in an order that depends only on the operations done
  bool carries_sew(int i, Dart a, Dart b) const;
  bool carries_unsew(int i) const;
  bool carries(CellKind kind) const;
  /// The reason why there is no combinatorial map although one was requested; empty otherwise.
  const std::string& no_cmap() const { return no_cmap_; }

 private:
  std::optional<Disagreement> apply_checked(Operation& operation);
  std::optional<Disagreement> do_sew(const Operation& operation);
  std::optional<Disagreement> do_unsew(const Operation& operation, int i);
  std::optional<Disagreement> do_remove(Dart d);
  std::optional<Disagreement> do_add(Operation& operation);
  std::optional<Disagreement> compare_around(std::span<const Dart> touched, int changed);
  std::optional<Disagreement> compare_cell(int i, Dart d);
  std::optional<Disagreement> count_change(std::span<const Dart> touched, const std::vector<long>& before,
                                           std::span<const Dart> unsewn);
  Disagreement differ(std::string what, std::string ours, const MapTwin& twin, std::string theirs) const;
  void appear(Dart d);
  void vanish(Dart d);

  std::vector<std::unique_ptr<MapTwin>> twins_;
  std::size_t core_count_ = 0;  // the first ones are ours
  std::string no_cmap_;
  int n_ = 3;
  Outcome outcome_ = Outcome::applied;
  std::vector<long> cells_;  // running totals, updated by the change of each operation
  std::vector<Dart> live_;
  std::vector<std::uint32_t> place_;  // in live_, by name
  std::uint32_t next_name_ = 0;
  std::vector<std::uint32_t> stamp_, covered_;  // by name, for comparing orbits as sets
  std::uint32_t epoch_ = 0, covered_epoch_ = 0;
  std::vector<Dart> orbit_, other_;
};

}  // namespace dartboard
