#include "validation/conservation/conservation.h"

#include <algorithm>
#include <cmath>

#include "core/operations/dissociate_all.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/walks/runge_kutta_4.h"
#include "validation/conservation/conservation_checks.h"
#include "validation/conservation/rebuild_oracle.h"
#include "validation/conservation/reference_motion.h"
#include "validation/conservation/split_comparison.h"

namespace dartboard {
namespace {

constexpr std::array compared{Check::counts,
                              Check::euler,
                              Check::valid,
                              Check::mass_of_vertex,
                              Check::mass_of_cells,
                              Check::spring_of_edge,
                              Check::ends,
                              Check::duplicated,
                              Check::views,
                              Check::total_mass,
                              Check::total_stiffness,
                              Check::total_damping,
                              Check::linear_momentum,
                              Check::angular_momentum,
                              Check::kinetic_energy,
                              Check::elastic_energy,
                              Check::boundary_area,
                              Check::side_by_side,
                              Check::same_cells,
                              Check::same_bits,
                              Check::oracle_position,
                              Check::oracle_velocity,
                              Check::reference_position,
                              Check::reference_velocity,
                              Check::split_cells,
                              Check::split_sums,
                              Check::split_bits,
                              Check::mass_drift,
                              Check::stiffness_drift};

/// A body of no more cells is compared in everything after each series.
constexpr std::size_t small = 24;

template <class Map>
class Run {
 public:
  Run(const Problem& start, const ConservationPlan& plan, const Follow<Map>& followed)
      : plan_(plan),
        follow_(followed),
        random_(plan.seed),
        ledger_(result_, plan.seed, compared),
        at_(start),
        checks_(at_, ledger_) {}

  ConservationResult run() {
    begin();
    std::size_t next_everything = plan_.everything_every, next_oracle = plan_.oracle_every, next_progress = 1000;
    while (!ledger_.broken() && done() < plan_.operations) {
      if (at_.cells.count() == 0) {
        compare_everything();  // of the empty body
        if (ledger_.broken() || at_.fresh.cell_dart.empty()) break;
        begin();
        ++result_.refills;
      }
      move();
      series();
      if (!ledger_.broken() && (at_.cells.count() <= small || done() >= next_everything)) {
        compare_everything();
        next_everything = done() + plan_.everything_every;
      }
      if (!ledger_.broken() && done() >= next_oracle) {
        compare_motion();
        next_oracle = done() + plan_.oracle_every;
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

 private:
  std::size_t done() const { return result_.operations(); }

  void begin() {
    at_.body = at_.fresh;
    at_.cells = at_.whole;
    at_.views = {};
    at_.views.rebuild(at_.body);
    const ConservedSums sums = sums_of(at_.body, at_.views.cells);
    mass_.begin(sums[Conserved::mass].value());
    stiffness_.begin(sums[Conserved::stiffness].value());
    compare_everything();
  }

  void compare_everything() {
    ++result_.whole_comparisons;
    checks_.everything();
  }

  void move() {
    for (std::uint32_t k = random_.below(3); k > 0; --k) {
      rk4_.step(at_.views.cells, at_.body, at_.start.h);
      ++result_.steps;
    }
  }

  void series() {
    const BeforeSeries<Map> before = checks_.before_series();
    removed_ = {};
    TopologyChange change;
    for (std::uint32_t k = 1 + random_.below(4); k > 0 && at_.cells.count() > 0; --k) operate(change);
    ++result_.series;
    const Followed followed = follow_(at_.body, at_.views, change);
    const ConservedSums sums = checks_.after_series(before, change, followed.embeddings, removed_);
    if (ledger_.broken()) return;
    mass_.compare(sums[Conserved::mass].value());
    stiffness_.compare(sums[Conserved::stiffness].value());
    if (!followed.components.separated.empty() && random_.below(4) == 0)
      split_off_part(followed.components.separated.front());
  }

  void split_off_part(std::uint32_t label) {
    std::uint32_t cell = 0;
    const ComponentLabels& components = at_.views.components;
    while (cell < components.cell_count() && components.label(cell) != label) ++cell;
    ledger_.require(Check::split_cells, cell < components.cell_count(), "a cell in component", label);
    if (ledger_.broken()) return;
    const auto leaving = at_.cells.component(at_.places.cell_of[at_.body.cell_dart[cell].index]);
    ledger_.equal(Check::split_cells, components.size(label), leaving.size(), "cells in component", label);
    for (const std::uint32_t c : leaving) {
      const Mesh& mesh = at_.start.mesh;
      const double share = at_.body.node_share[at_.body.cell(at_.body.map, at_.places.corner[mesh.first[c]])];
      for (std::size_t k = 0; k < mesh.cell(c).size(); ++k) mass_.remove(share);
      for (std::uint32_t e = at_.whole.first_edge(c); e < at_.whole.first_edge(c + 1); ++e)
        stiffness_.remove(at_.start.material.stiffness);
    }
    split_off_and_compare(at_.body, at_.views, at_.places, at_.cells, leaving, at_.start.h, ledger_);
    for (const std::uint32_t c : leaving) at_.cells.remove(c);
    ++result_.parts_split_off;
  }

  void operate(TopologyChange& change) {
    const std::uint32_t which = random_.below(100);
    Dart d = some_dart();
    Map& map = at_.body.map;
    if (which < 45) {
      // mostly a side that holds something together
      for (int tries = 0; tries < 8 && !at_.cells.is_joined(at_.places.side_of[d.index]); ++tries) d = some_dart();
      dissociate(at_.places.side_of[d.index]);
      change.append(dissociate_one(map, d));
      ++result_.dissociations;
    } else if (which < 50) {
      const std::array<Dart, 3> seam{d, some_dart(), some_dart()};
      for (const Dart side : seam) dissociate(at_.places.side_of[side.index]);
      change.append(dissociate_all(map, seam));
      ++result_.dissociations;
    } else if (which < 65) {
      tear(change, d);
    } else {
      take_away(at_.places.cell_of[d.index]);
      change.append(remove_one(map, d));
      ++result_.removals;
    }
  }

  static TopologyChange dissociate_one(Map& map, Dart d) {
    if constexpr (Map::dimension == 2)
      return dissociate_edge(map, d);
    else
      return dissociate_face(map, d);
  }
  static TopologyChange remove_one(Map& map, Dart d) {
    if constexpr (Map::dimension == 2)
      return remove_face(map, d);
    else
      return remove_volume(map, d);
  }
  // A fan of faces; in a surface, the two edges of a corner.
  void tear(TopologyChange& change, Dart d) {
    Map& map = at_.body.map;
    std::vector<Dart> torn;
    if constexpr (Map::dimension == 2)
      torn = {d, map.template alpha<1>(d)};
    else
      torn = fan(map, d);
    for (const Dart side : torn) dissociate(at_.places.side_of[side.index]);
    if constexpr (Map::dimension == 2)
      change.append(dissociate_all(map, torn));
    else
      change.append(tear_fan(map, d));
    ++result_.tears;
  }

  // A dart of a cell that is left; in the middle of a series the body still numbers those that are not.
  Dart some_dart() {
    for (;;) {
      const Dart d = at_.body.cell_dart[random_.below(at_.body.cell_dart.size())];
      const std::uint32_t c = at_.places.cell_of[d.index];
      if (!at_.cells.is_there(c)) continue;
      const auto& darts = at_.places.darts_of[c];
      return darts[random_.below(darts.size())];
    }
  }

  void dissociate(std::uint32_t side) {
    if (!at_.cells.is_joined(side)) return;
    removed_[Conserved::boundary].add(-2.0 * at_.cells.measure(side));
    at_.cells.dissociate(side);
  }

  // What the cell has of everything is told by the numbers that the darts had before the series: corners and edges
  // moved nowhere since.
  void take_away(std::uint32_t c) {
    const LiveBody<Map>& body = at_.body;
    const Mesh& mesh = at_.start.mesh;
    const Material& material = at_.start.material;
    const auto number = [&](std::uint32_t corner) { return body.vertex(body.map, at_.places.corner[corner]); };
    const double share = body.node_share[body.cell(body.map, at_.places.corner[mesh.first[c]])];
    for (std::uint32_t k = mesh.first[c]; k < mesh.first[c + 1]; ++k) {
      removed_.add_node(share, body.vertices.position[number(k)], body.vertices.velocity[number(k)]);
      mass_.remove(share);
    }
    for (std::uint32_t e = at_.whole.first_edge(c); e < at_.whole.first_edge(c + 1); ++e) {
      const double rest_length = body.springs[body.edge(body.map, at_.places.edge[e])].rest_length;
      const auto [a, b] = at_.whole.ends(e);
      removed_.add_spring(
          material.stiffness, material.damping,
          elongation(rest_length, body.vertices.position[number(a)], body.vertices.position[number(b)]));
      stiffness_.remove(material.stiffness);
    }
    for (std::uint32_t side = at_.whole.first_side(c); side < at_.whole.first_side(c + 1); ++side) {
      dissociate(side);
      removed_[Conserved::boundary].add(at_.cells.measure(side));
    }
    at_.cells.remove(c);
  }

  void compare_motion() {
    if (at_.cells.count() == 0) return;
    const auto motion =
        compare_rebuilt_motion(at_.body, at_.views.cells, at_.start, at_.places, at_.cells, plan_.oracle_steps);
    const std::size_t which = ++result_.bodies_from_scratch;
    ledger_.equal(Check::same_cells, at_.body.vertices.size(), motion.vertices, "vertices of body", which);
    ledger_.equal(Check::same_cells, at_.body.springs.size(), motion.springs, "springs of body", which);
    if (ledger_.broken()) return;
    ledger_.require(Check::same_bits, motion.same_bits, "state of body", which);
    const auto [off, spread] =
        compare_with_reference(at_.body, at_.views.cells, at_.start, at_.places, at_.cells, plan_.reference_steps);
    ledger_.within(Check::reference_position, off.position, spreads_of_cut_body * spread.position, 1.0, off.position,
                   0.0);
    ledger_.within(Check::reference_velocity, off.velocity, spreads_of_cut_body * spread.velocity, 1.0, off.velocity,
                   0.0);
    if (!std::isfinite(motion.bound.position)) {
      ++result_.bodies_without_bound;
      return;
    }
    ledger_.within(Check::oracle_position, motion.position, motion.bound.position, 1.0, motion.position, 0.0);
    ledger_.within(Check::oracle_velocity, motion.velocity, motion.bound.velocity, 1.0, motion.velocity, 0.0);
  }

  void compare_drift() {
    const double target = drift_target(done());
    const auto compare = [&](Check check, const Drift& drift, Conserved c) {
      ledger_.within(check, drift.largest(), checks_.is_exact(c) ? 0.0 : target, 1.0, drift.largest(), 0.0);
    };
    compare(Check::mass_drift, mass_, Conserved::mass);
    compare(Check::stiffness_drift, stiffness_, Conserved::stiffness);
  }

  const ConservationPlan& plan_;
  const Follow<Map>& follow_;
  SplitMix64 random_;
  ConservationResult result_;
  ConservationLedger ledger_;
  Subject<Map> at_;
  ConservationChecks<Map> checks_;
  RungeKutta4 rk4_;
  ConservedSums removed_;  // by the series
  Drift mass_, stiffness_;
};

}  // namespace

template <class Map>
ConservationResult validate_conservation(const Problem& start, const ConservationPlan& plan,
                                         const Follow<Map>& followed) {
  if (start.mesh.cell_count() > 0 && start.mesh.dimension() != Map::dimension)
    throw InputError(Map::dimension == 3 ? "expected a mesh of volumes" : "expected a mesh of polygons");
  return Run<Map>(start, plan, followed).run();
}

template ConservationResult validate_conservation(const Problem&, const ConservationPlan&, const Follow<Map2>&);
template ConservationResult validate_conservation(const Problem&, const ConservationPlan&, const Follow<Map3>&);
template ConservationResult validate_conservation(const Problem&, const ConservationPlan&, const Follow<TetMap>&);

// Gershgorin: omega^2 <= max over vertices of 2 sum k / m, and the damping rate <= max of 2 sum c / m. A vertex is made
// of corners, so neither exceeds the largest of a corner alone, and dissociation does not raise it.
Problem moving_problem(Mesh mesh, const Material& material, std::uint64_t seed) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = material;
  SplitMix64 random(seed);

  double stiffest = 0.0, most_damped = material.viscosity;
  const RemainingCells cells(problem.mesh);
  for (std::uint32_t c = 0; c < problem.mesh.cell_count(); ++c) {
    const auto edges = static_cast<double>(cells.first_edge(c + 1) - cells.first_edge(c));
    const double share =
        material.density * std::abs(signed_measure(problem.mesh, c)) / static_cast<double>(problem.mesh.cell(c).size());
    stiffest = std::max(stiffest, 2.0 * edges * material.stiffness / share);
    most_damped = std::max(most_damped, 2.0 * edges * material.damping / share);
  }
  const double omega = std::sqrt(stiffest);
  if (omega > 0.0) problem.h = std::min(problem.h, 0.5 / std::max(omega, most_damped));

  Eigen::Matrix3d field;
  for (int k = 0; k < 9; ++k) field(k / 3, k % 3) = 0.01 * omega * random.next_signed();
  Eigen::Vector3d centre(0, 0, 0);
  for (const auto& p : problem.mesh.points) centre += p / static_cast<double>(problem.mesh.points.size());
  for (const auto& p : problem.mesh.points) problem.initial_velocity.emplace_back(field * (p - centre));
  for (std::uint32_t p = 0; p < problem.mesh.points.size(); ++p)
    if (random.below(16) == 0) problem.fixed.push_back(p);
  return problem;
}

}  // namespace dartboard
