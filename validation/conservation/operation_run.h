#pragma once
// The loop of a conservation run: a body moves, operations drawn at random change it, and all of it is compared.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/operations/dissociate_all.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/random.h"
#include "core/walks/runge_kutta_4.h"
#include "validation/conservation/conservation_checks.h"

namespace dartboard {

/// Shares of the operations drawn: of a hundred, those below each number; the rest are removals.
struct OperationMix {
  std::uint32_t longest_series;
  std::uint32_t dissociations, seams, tears;
  int tries;  // to find a side that holds something together, before another will do
};

/// Kinds of run override the virtual functions. AnySubject is one of subjects.h, Checks its OperationChecks.
template <class AnySubject, class Checks>
class OperationRun {
 public:
  using Map = typename AnySubject::Map;

  OperationRun(const Problem& start, const ConservationPlan& plan, const OperationMix& mix, const Follow<Map>& followed,
               std::span<const Check> compared)
      : plan_(plan),
        random_(plan.seed),
        ledger_(result_, plan.seed, compared),
        fresh_(start),
        at_(fresh_),
        checks_(at_, ledger_),
        mix_(mix),
        follow_(followed) {}
  virtual ~OperationRun() = default;

  ConservationResult run() {
    begin();
    std::size_t next_everything = plan_.everything_every, next_motion = plan_.oracle_every, next_progress = 1000;
    while (!ledger_.broken() && done() < plan_.operations) {
      if (at_.cells.count() == 0) {
        compare_everything();  // now the body is empty
        if (ledger_.broken() || fresh_.cells.count() == 0) break;
        at_ = fresh_;
        begin();
        ++result_.refills;
      }
      move();
      change();
      ++result_.series;
      if (!ledger_.broken() && (at_.cells.count() <= small || done() >= next_everything)) {
        compare_everything();
        next_everything = done() + plan_.everything_every;
      }
      if (!ledger_.broken() && done() >= next_motion) {
        compare_motion();
        next_motion = done() + plan_.oracle_every;
      }
      if (done() >= next_progress) {
        if (plan_.progress) plan_.progress(done());
        next_progress += 1000;
      }
    }
    if (!ledger_.broken()) compare_everything();
    if (!ledger_.broken()) compare_motion();
    if (!ledger_.broken()) compare_drift();
    return std::move(result_);
  }

 protected:
  /// Starts with a fresh body.
  virtual void begin() {
    checks_.begin();
    const ConservedSums sums = checks_.all_sums();
    mass_.begin(sums[Conserved::mass].value());
    stiffness_.begin(sums[Conserved::stiffness].value());
    compare_everything();
  }
  virtual double step() const { return at_.start->h; }
  virtual void change() { series(); }
  virtual void after_series(const Followed&) {}
  virtual void compare_motion() {}

  std::size_t done() const { return result_.operations(); }

  /// Makes several operations, which the body then follows together.
  void series() {
    const BeforeSeries<Map> before = checks_.before_series();
    removed_ = {};
    TopologyChange change;
    for (std::uint32_t k = 1 + random_.below(mix_.longest_series); k > 0 && at_.cells.count() > 0; --k) operate(change);
    const Followed followed = follow_(at_.body, at_.views, change);
    compare_totals(checks_.after_series(before, change, followed.embeddings, removed_));
    if (!ledger_.broken()) after_series(followed);
  }

  void compare_totals(const ConservedSums& sums) {
    if (ledger_.broken()) return;
    mass_.compare(sums[Conserved::mass].value());
    stiffness_.compare(sums[Conserved::stiffness].value());
  }

  // A dart of a remaining cell; in the middle of a series the body still numbers those that are gone.
  Dart some_dart() {
    for (;;) {
      const Dart d = at_.body.cell_dart[random_.below(at_.body.cell_dart.size())];
      if (!at_.body.map.is_live(d)) continue;
      const auto& darts = at_.darts_of(at_.cell(d));
      return darts[random_.below(darts.size())];
    }
  }

  const ConservationPlan& plan_;
  SplitMix64 random_;
  ConservationResult result_;
  ConservationLedger ledger_;
  const AnySubject fresh_;
  AnySubject at_;
  Checks checks_;
  Drift mass_, stiffness_;

 private:
  /// A body with at most so many cells is compared in everything after each series.
  static constexpr std::size_t small = 24;

  void compare_everything() {
    ++result_.whole_comparisons;
    checks_.everything();
  }

  void move() {
    const std::uint32_t steps = random_.below(3);
    const double h = steps > 0 ? step() : 0.0;
    for (std::uint32_t k = 0; k < steps; ++k) rk4_.step(at_.views.cells, at_.body, h);
    result_.steps += steps;
  }

  void operate(TopologyChange& change) {
    const std::uint32_t which = random_.below(100);
    Dart d = some_dart();
    Map& map = at_.body.map;
    if (which < mix_.dissociations) {
      for (int tries = 0; tries < mix_.tries && !at_.cells.is_joined(at_.side(d)); ++tries) d = some_dart();
      dissociate(at_.side(d));
      if constexpr (Map::dimension == 2)
        change.append(dissociate_edge(map, d));
      else
        change.append(dissociate_face(map, d));
      ++result_.dissociations;
    } else if (which < mix_.seams) {
      const std::array<Dart, 3> seam{d, some_dart(), some_dart()};
      for (const Dart side : seam) dissociate(at_.side(side));
      change.append(dissociate_all(map, seam));
      ++result_.dissociations;
    } else if (which < mix_.tears) {
      tear(change, d);
    } else {
      take_away(at_.cell(d));
      if constexpr (Map::dimension == 2)
        change.append(remove_face(map, d));
      else
        change.append(remove_volume(map, d));
      ++result_.removals;
    }
  }

  // A fan of faces; in a surface, the two edges of a corner.
  void tear(TopologyChange& change, Dart d) {
    Map& map = at_.body.map;
    std::vector<Dart> torn;
    if constexpr (Map::dimension == 2)
      torn = {d, map.template alpha<1>(d)};
    else
      torn = fan(map, d);
    for (const Dart side : torn) dissociate(at_.side(side));
    if constexpr (Map::dimension == 2)
      change.append(dissociate_all(map, torn));
    else
      change.append(tear_fan(map, d));
    ++result_.tears;
  }

  void dissociate(typename AnySubject::Side side) {
    if (!at_.cells.is_joined(side)) return;
    for (const auto s : {side, at_.opposite(side)}) removed_[Conserved::boundary].add(-at_.measure(s));
    at_.cells.dissociate(side);
  }

  // The share of the cell in everything is found by the numbers that the darts had before the series: corners and edges
  // have not moved since.
  void take_away(std::uint32_t c) {
    const LiveBody<Map>& body = at_.body;
    at_.for_each_corner_of(c, [&](double mass, std::uint32_t k) {
      removed_.add_node(mass, body.vertices.position[k], body.vertices.velocity[k]);
      mass_.remove(mass);
    });
    at_.for_each_edge_of(c, [&](double stiffness, double damping, std::uint32_t e, std::uint32_t a, std::uint32_t b) {
      removed_.add_spring(
          stiffness, damping,
          elongation(body.springs[e].rest_length, body.vertices.position[a], body.vertices.position[b]));
      stiffness_.remove(stiffness);
    });
    at_.for_each_side_of(c, [&](auto side) {
      dissociate(side);
      removed_[Conserved::boundary].add(at_.measure(side));
    });
    at_.cells.remove(c);
  }

  void compare_drift() {
    const double target = drift_target(done());
    const auto compare = [&](Check check, const Drift& drift, Conserved c) {
      ledger_.within(check, drift.largest(), checks_.is_exact(c) ? 0.0 : target, 1.0, drift.largest(), 0.0);
    };
    compare(Check::mass_drift, mass_, Conserved::mass);
    compare(Check::stiffness_drift, stiffness_, Conserved::stiffness);
  }

  const OperationMix mix_;
  const Follow<Map>& follow_;
  RungeKutta4 rk4_;
  ConservedSums removed_;  // by the series
};

}  // namespace dartboard
