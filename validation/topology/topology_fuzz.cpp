#include "validation/topology/topology_fuzz.h"

#include <algorithm>
#include <utility>

#include "core/plain/random.h"

namespace dartboard {
namespace {

/// Proposes operations that keep a body a body: most unsewn facets are sewn again later where they were, the size stays
/// within a factor of about two, and few facets at a time are sewn to others that they never touched. (Many such sews
/// would make one vertex of all the vertices, and then every operation walks the whole body.)
class Proposals {
 public:
  Proposals(std::uint64_t seed, const Lockstep& lockstep)
      : random_(seed), lockstep_(lockstep), n_(lockstep.ours().dimension()), start_size_(lockstep.live().size()) {
    for (const CellKind kind : {CellKind::triangle, CellKind::quadrilateral, CellKind::tetrahedron, CellKind::pyramid,
                                CellKind::prism, CellKind::hexahedron})
      if (lockstep.carries(kind)) kinds_.push_back(kind);
  }

  Operation next() {
    const std::size_t darts = lockstep_.live().size();
    if (darts == 0 || (darts < 2 * start_size_ + 96 && percent(5)))
      return {.kind = Operation::Kind::add, .cell = kinds_[below(kinds_.size())]};
    if (darts > start_size_ / 2 && percent(5)) return {.kind = Operation::Kind::remove, .a = any()};
    const std::uint32_t dice = below(100);
    if (dice < 36) return take_apart(n_);
    if (dice < 64 && !memory_.empty()) return sew_again();
    if (dice < 78) return sew_strangers();
    const auto i = static_cast<int>(below(static_cast<std::size_t>(n_) + 1));
    if (dice < 90 && i < n_ && lockstep_.carries_unsew(i)) return take_apart(i);
    const Dart a = any(), b = any();       // one after the other: the order of evaluation of arguments is unspecified
    return sew(dice < 94 ? n_ : i, a, b);  // mostly illegal
  }

 private:
  static Operation sew(int i, Dart a, Dart b) {
    return {.kind = Operation::Kind::sew, .i = static_cast<std::int8_t>(i), .a = a, .b = b};
  }
  // By the high bits, where SplitMix64::below takes the low ones: so a seed still draws the same operations as when it
  // was reported.
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>((random_.next() >> 32) * n >> 32); }
  bool percent(unsigned chance) { return below(100) < chance; }

  Dart any() { return lockstep_.live()[below(lockstep_.live().size())]; }

  Operation take_apart(int i) {
    Dart d = any();
    for (int attempt = 0; attempt < 8 && lockstep_.ours().alpha(i, d) == d; ++attempt) d = any();
    const Dart opposite = lockstep_.ours().alpha(i, d);
    if (opposite != d) memory_.push_back(sew(i, d, opposite));
    if (i == n_ && percent(50)) return {.kind = Operation::Kind::dissociate, .a = d};
    return {.kind = Operation::Kind::unsew, .i = static_cast<std::int8_t>(i), .a = d};
  }
  Operation sew_again() {
    const std::uint32_t k = below(memory_.size());
    const Operation again = memory_[k];
    memory_[k] = memory_.back();
    memory_.pop_back();
    return again;
  }
  Operation sew_strangers() {
    const MapTwin& map = lockstep_.ours();
    constexpr std::size_t most = 24;
    if (strangers_.size() >= most) {
      Operation& pair = strangers_[below(strangers_.size())];
      const Operation old = pair;
      const bool live = map.is_live(old.a) && map.is_live(old.b);
      if (live && map.alpha(n_, old.a) == old.b) return {.kind = Operation::Kind::dissociate, .a = old.a};
      pair = strangers_.back();
      strangers_.pop_back();
    }
    Dart a = any(), b = any();
    for (int attempt = 0; attempt < 8 && map.alpha(n_, a) != a; ++attempt) a = any();
    for (int attempt = 0; attempt < 8 && map.alpha(n_, b) != b; ++attempt) b = any();
    // the other way round when not every twin can carry this one
    if (!lockstep_.carries_sew(n_, a, b)) b = map.alpha(0, b);
    strangers_.push_back(sew(n_, a, b));
    return strangers_.back();
  }

  SplitMix64 random_;
  const Lockstep& lockstep_;
  int n_;
  std::size_t start_size_;
  std::vector<CellKind> kinds_;
  std::vector<Operation> memory_;     // sews that would undo earlier dissociations
  std::vector<Operation> strangers_;  // the latest sews of facets that never touched
};

void count(FuzzResult& result, Lockstep::Outcome outcome) {
  if (outcome == Lockstep::Outcome::applied) ++result.applied;
  if (outcome == Lockstep::Outcome::illegal) ++result.illegal;
  if (outcome == Lockstep::Outcome::not_carried) ++result.not_carried;
}

/// Applies the operations; returns the disagreement seen on the way, or by comparing everything at the end.
std::optional<Disagreement> run(Lockstep& lockstep, std::vector<Operation> operations, FuzzResult& result) {
  for (std::size_t k = 0; k < operations.size(); ++k) {
    auto found = lockstep.apply(operations[k]);
    count(result, lockstep.outcome());
    if (!found) continue;
    found->operation = k;
    return found;
  }
  auto found = lockstep.compare_everything();
  if (!found) return std::nullopt;
  found->operation = operations.size();
  if (!operations.empty()) found->line = to_string(operations.back());
  return found;
}

}  // namespace

std::vector<Operation> shrink(std::vector<Operation> operations,
                              const std::function<bool(const std::vector<Operation>&)>& disagrees) {
  // the end alone is often enough
  for (std::size_t length = 1; length < operations.size(); length *= 2) {
    std::vector<Operation> end(operations.end() - static_cast<std::ptrdiff_t>(length), operations.end());
    if (!disagrees(end)) continue;
    operations = std::move(end);
    break;
  }
  // leave out ever smaller chunks, until no single line can be left out
  for (std::size_t chunk = std::max<std::size_t>(operations.size() / 2, 1);;) {
    bool shorter = false;
    for (std::size_t from = 0; from < operations.size();) {
      auto without = operations;
      const auto begin = without.begin() + static_cast<std::ptrdiff_t>(from);
      without.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(chunk, operations.size() - from)));
      if (disagrees(without)) {
        operations = std::move(without);
        shorter = true;
      } else {
        from += chunk;
      }
    }
    if (chunk == 1 && !shorter) return operations;
    chunk = std::max<std::size_t>(chunk / 2, 1);
  }
}

FuzzResult replay_topology(const Mesh& mesh, const TopologyScript& script, const MakeTwins& ours) {
  FuzzResult result;
  Lockstep lockstep(mesh, script.storage, script.oracles, ours);
  result.no_cmap = lockstep.no_cmap();
  result.script = script;
  result.disagreement = lockstep.compare_everything();
  if (!result.disagreement) result.disagreement = run(lockstep, script.operations, result);
  return result;
}

FuzzResult fuzz_topology(const Mesh& mesh, const FuzzPlan& plan) {
  FuzzResult result;
  Lockstep lockstep(mesh, plan.storage, plan.oracles, plan.ours);
  result.no_cmap = lockstep.no_cmap();
  result.disagreement = lockstep.compare_everything();
  Proposals proposals(plan.seed, lockstep);
  std::vector<Operation> done;
  for (std::size_t k = 1; k <= plan.operations && !result.disagreement; ++k) {
    done.push_back(proposals.next());
    result.disagreement = lockstep.apply(done.back());
    count(result, lockstep.outcome());
    if (!result.disagreement && (k == plan.operations || k % plan.everything_every == 0))
      result.disagreement = lockstep.compare_everything();
    if (plan.progress && (k % 1000 == 0 || k == plan.operations)) plan.progress(k);
  }
  if (!result.disagreement) return result;

  result.script = {plan.mesh_name, plan.storage, plan.oracles, {}};
  const auto disagrees = [&](const std::vector<Operation>& operations) {
    FuzzResult ignored;
    Lockstep again(mesh, plan.storage, plan.oracles, plan.ours);
    return run(again, operations, ignored).has_value();
  };
  result.script.operations = disagrees({}) ? std::vector<Operation>{} : shrink(std::move(done), disagrees);
  if (auto shown = replay_topology(mesh, result.script, plan.ours).disagreement) result.disagreement = shown;
  return result;
}

}  // namespace dartboard
