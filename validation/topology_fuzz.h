#pragma once
// Operations in lockstep on our maps and on CGAL's: random ones until something differs, then the shortest script of
// it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plain/mesh.h"
#include "validation/cgal_twin.h"
#include "validation/topology_report.h"
#include "validation/topology_script.h"

namespace dartboard {

/// What two carriers of the same map say differently.
struct Disagreement {
  std::size_t operation = 0;  // how many operations went before the one after which it was seen
  std::string line;           // that operation; empty when it was seen before any
  std::string what;           // "alpha3(d17)"
  std::string ours, theirs;   // with the name of who says it
};
std::string to_string(const Disagreement& disagreement);

/// The maps under test, for a mesh: core's, or a faulty stand-in. The first one is asked for legality and for the cells
/// that an operation can have changed; all are compared.
using MakeTwins = std::function<std::vector<std::unique_ptr<MapTwin>>(const Mesh&, ScriptStorage)>;
/// Map2 or Map3, and TetMap too for tetrahedral storage.
std::vector<std::unique_ptr<MapTwin>> core_twins(const Mesh& mesh, ScriptStorage storage);

/// The same map in several hands, to which one operation after the other is done.
///
/// After each operation: legality verdicts; alphas of all touched darts; cells of all touched darts, as sets; cells per
/// dimension that came or went, against what one operation can change; validity around the touched darts of our maps.
class Lockstep {
 public:
  enum class Outcome { applied, illegal, not_carried };

  Lockstep(const Mesh& mesh, ScriptStorage storage, ScriptOracles oracles, const MakeTwins& ours = core_twins);

  /// Do it, unless it is illegal or one of the twins cannot carry it: then nobody does. The first name of an added cell
  /// is filled in when it is missing. Whatever a twin throws is a disagreement.
  std::optional<Disagreement> apply(Operation& operation);
  Outcome outcome() const { return outcome_; }  // of the last operation

  /// Everything of compare_twins, the cells counted so far, and CGAL's isomorphism test against fresh maps of our
  /// alphas.
  std::optional<Disagreement> compare_everything() const;

  const MapTwin& ours() const { return *twins_[0]; }
  std::span<const Dart> live() const { return live_; }  // in an order that depends on the operations done alone
  bool carries_sew(int i, Dart a, Dart b) const;
  bool carries_unsew(int i) const;
  bool carries(CellKind kind) const;
  /// Why there is no combinatorial map although it was asked for; empty otherwise.
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
  std::vector<long> cells_;  // running totals, from what each operation changed
  std::vector<Dart> live_;
  std::vector<std::uint32_t> place_;  // in live_, by name
  std::uint32_t next_name_ = 0;
  std::vector<std::uint32_t> stamp_, covered_;  // by name, for comparing orbits as sets
  std::uint32_t epoch_ = 0, covered_epoch_ = 0;
  std::vector<Dart> orbit_, other_;
};

struct FuzzPlan {
  std::string mesh_name;
  ScriptStorage storage = ScriptStorage::general;
  ScriptOracles oracles = ScriptOracles::both;
  std::uint64_t seed = 1;
  std::size_t operations = 1000;
  std::size_t everything_every = 2000;  // operations between two full comparisons; one at the start and the end too
  MakeTwins ours = core_twins;
  std::function<void(std::size_t done)> progress;  // called every 1000 operations or so
};

struct FuzzResult {
  std::size_t applied = 0, illegal = 0, not_carried = 0;
  std::string no_cmap;
  std::optional<Disagreement> disagreement;  // as the script shows it
  TopologyScript script;                     // shrunk, when there is a disagreement; empty otherwise
};

/// Random operations. On a disagreement the script is shrunk by delta debugging: no line of it can be left out.
FuzzResult fuzz_topology(const Mesh& mesh, const FuzzPlan& plan);

/// Do what a script says, and compare everything at the end.
FuzzResult replay_topology(const Mesh& mesh, const TopologyScript& script, const MakeTwins& ours = core_twins);

/// The least number of operations that still disagrees, as far as leaving out chunks and then single lines finds it.
/// pre  `disagrees(operations)`
std::vector<Operation> shrink(std::vector<Operation> operations,
                              const std::function<bool(const std::vector<Operation>&)>& disagrees);

}  // namespace dartboard
