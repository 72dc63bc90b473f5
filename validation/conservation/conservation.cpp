#include "validation/conservation/conservation.h"

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"
#include "core/plain/random.h"
#include "validation/conservation/operation_run.h"
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

template <class Map>
class Run : public OperationRun<Subject<Map>, ConservationChecks<Map>> {
  using Base = OperationRun<Subject<Map>, ConservationChecks<Map>>;
  using Base::at_, Base::ledger_, Base::plan_, Base::random_, Base::result_;

 public:
  Run(const Problem& start, const ConservationPlan& plan, const Follow<Map>& followed)
      : Base(start, plan, {.longest_series = 4, .dissociations = 45, .seams = 50, .tears = 65, .tries = 8}, followed,
             compared) {}

 private:
  void after_series(const Followed& followed) override {
    if (!followed.components.separated.empty() && random_.below(4) == 0)
      split_off_part(followed.components.separated.front());
  }

  void split_off_part(std::uint32_t label) {
    std::uint32_t cell = 0;
    const ComponentLabels& components = at_.views.components;
    while (cell < components.cell_count() && components.label(cell) != label) ++cell;
    ledger_.require(Check::split_cells, cell < components.cell_count(), "a cell in component", label);
    if (ledger_.broken()) return;
    const auto leaving = at_.cells.component(at_.cell(at_.body.cell_dart[cell]));
    ledger_.equal(Check::split_cells, components.size(label), leaving.size(), "cells in component", label);
    for (const std::uint32_t c : leaving) {
      at_.for_each_corner_of(c, [&](double mass, auto) { this->mass_.remove(mass); });
      at_.for_each_edge_of(c, [&](double stiffness, auto...) { this->stiffness_.remove(stiffness); });
    }
    split_off_and_compare(at_, leaving, ledger_);
    for (const std::uint32_t c : leaving) at_.cells.remove(c);
    ++result_.parts_split_off;
  }

  void compare_motion() override {
    if (at_.cells.count() == 0) return;
    const auto motion = compare_rebuilt_motion(at_, plan_.oracle_steps);
    const std::size_t which = ++result_.bodies_from_scratch;
    ledger_.equal(Check::same_cells, at_.body.vertices.size(), motion.vertices, "vertices of body", which);
    ledger_.equal(Check::same_cells, at_.body.springs.size(), motion.springs, "springs of body", which);
    if (ledger_.broken()) return;
    ledger_.require(Check::same_bits, motion.same_bits, "state of body", which);
    const auto [off, spread] = compare_with_reference(at_, plan_.reference_steps);
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

// Gershgorin: omega^2 <= max over vertices of 2 sum k / m, and the damping rate <= max of 2 sum c / m. A vertex
// consists of corners, so neither exceeds the largest of a corner alone, and dissociation does not raise it.
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
