#include "validation/conservation/refinement_conservation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plain/error.h"
#include "validation/conservation/operation_run.h"
#include "validation/conservation/refinement_checks.h"
#include "validation/conservation/refinement_effects.h"

namespace dartboard {
namespace {

constexpr std::array compared{Check::counts,
                              Check::euler,
                              Check::valid,
                              Check::mass_of_vertex,
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
                              Check::put_in_the_middle,
                              Check::mass_of_cell,
                              Check::forces_kept,
                              Check::mass_drift,
                              Check::stiffness_drift};

constexpr std::uint32_t deepest = 8;  // most refinements of a cell: each takes up to a factor of 8 from the square of h

template <class Map>
const Follow<Map> core_follow = follow<Map>;

template <class Map>
class Run : public OperationRun<RefinedSubject<Map>, RefinementChecks<Map>> {
  using Base = OperationRun<RefinedSubject<Map>, RefinementChecks<Map>>;
  using Base::at_, Base::checks_, Base::ledger_, Base::random_, Base::result_;

 public:
  Run(const Problem& start, const ConservationPlan& plan, const Tamper<Map>& tamper,
      const FollowSubdivision<Map>& followed)
      : Base(start, plan, {.longest_series = 3, .dissociations = 45, .seams = 45, .tears = 55, .tries = 0},
             core_follow<Map>, compared),
        tamper_(tamper),
        follow_(followed) {}

 private:
  void begin() override {
    is_growing_ = true;
    Base::begin();
  }

  void change() override {
    if (at_.cells.count() > 2 * this->fresh_.cells.count() + 24) is_growing_ = false;
    if (random_.below(100) < (is_growing_ ? 60u : 10u))
      refine_something();
    else
      this->series();
    if (tamper_) tamper_(at_.body, at_.views);
  }

  // Gershgorin, as in moving_problem: stiffer springs and lighter vertices need a shorter step.
  double step() const override {
    const LiveBody<Map>& body = at_.body;
    std::vector<double> stiffness(body.vertices.size(), 0.0), damping(stiffness);
    at_.views.cells.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
      for (const std::uint32_t k : {a, b}) {
        stiffness[k] += body.springs[e].stiffness;
        damping[k] += body.springs[e].damping;
      }
    });
    double fastest = 0.5 / at_.start->h;
    for (std::uint32_t k = 0; k < stiffness.size(); ++k) {
      const double mass = body.vertices.mass[k];
      fastest = std::max(
          {fastest, std::sqrt(2.0 * stiffness[k] / mass), 2.0 * damping[k] / mass + at_.start->material.viscosity});
    }
    return 0.5 / fastest;
  }

  void refine_something() {
    const Dart d = this->some_dart();
    const std::uint32_t dimension = 1 + random_.below(3);
    const double bracing = 0.5 * random_.below(3);
    if (dimension == 1) return refine_cell(Edge{d}, bracing);
    if (dimension == 2) return refine_cell(Face{d}, bracing);
    refine_cell(Volume{d}, bracing);
  }

  template <int i>
  void refine_cell(Cell<i> cell, double bracing) {
    const auto start_cell = at_.corner(cell.dart).cell;
    const std::uint8_t nodes = at_.template nodes<i>(cell.dart);
    const auto parents = at_.cells.around(start_cell, nodes);
    for (const auto& parent : parents)
      if (at_.cells.cells()[parent.first].depth >= deepest) return;

    ++result_.refinements;
    LiveBody<Map>& body = at_.body;
    const VertexColumns old = body.vertices;
    const long euler = checks_.euler();
    const ConservedSums before = checks_.all_sums();
    std::vector<std::uint32_t> corners;  // the numbers of S
    for (std::uint32_t n = 0; n < 4; ++n)
      if (nodes >> n & 1u) corners.push_back(at_.vertex({start_cell, n}));
    const Spring whole = body.springs[body.edge(body.map, cell.dart)];  // read for an edge only
    double mass = 0.0;
    for (const auto& parent : parents) mass += at_.cells.cells()[parent.first].mass;
    const SpringForceSums forces_before = spring_force_sums(body, at_.views.cells);

    const Subdivision subdivision = subdivide(body.map, cell);
    const ChangedEmbeddings changed = follow_(body, subdivision, bracing);
    at_.views.apply(body, TopologyChange{}, changed);
    const auto children = at_.cells.subdivide(start_cell, nodes, bracing);
    ledger_.equal(Check::counts, subdivision.children.size(), children.size(), "children, of parents", parents.size());
    if (ledger_.broken()) return;
    at_.put_children(subdivision, children);

    ledger_.equal(Check::counts, body.vertices.size(), old.size() + 1, "dimension", 0);
    ledger_.equal(Check::euler, checks_.euler(), euler, "dimension", 3);
    checks_.columns_fit();
    if (!ledger_.broken()) checks_.changed_cells(changed);
    if (ledger_.broken()) return;
    others_stay(old);
    const RefinementMeans means = put_in_the_middle(old, corners);

    // the sums that S gave away, less those of the new vertex; the new springs
    const auto vertex = static_cast<std::uint32_t>(old.size());
    ConservedSums removed = given_away(old, corners, means, mass);
    double slack = 0.0;
    const ConservedSums after = checks_.all_sums();
    at_.views.cells.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
      if (a != vertex && b != vertex) return;
      const Spring& s = body.springs[e];
      const double e_now = elongation(s.rest_length, body.vertices.position[a], body.vertices.position[b]);
      const bool is_half = i == 1 && std::count(corners.begin(), corners.end(), a + b - vertex) != 0;
      if (is_half) slack += s.stiffness * means.off * (std::abs(e_now) + means.off);
      // a half has twice the stiffness of the whole; both lose the share of one cell
      const double added = is_half ? s.stiffness - whole.stiffness / 2.0 : s.stiffness;
      const double damped = is_half ? s.damping - whole.damping / 2.0 : s.damping;
      removed[Conserved::stiffness].add(-added);
      removed[Conserved::damping].add(-damped);
      this->stiffness_.remove(-added);
      if (!is_half) removed[Conserved::elastic].add(-0.5 * (s.stiffness * (e_now * e_now)));
    });
    checks_.sums(before, after, removed, 24, 1.001 * slack);
    this->compare_totals(after);
    if (bracing == 0.0) forces_are_kept(forces_before, vertex, means);
  }

  void others_stay(const VertexColumns& old) {
    const VertexColumns& v = at_.body.vertices;
    for (std::uint32_t k = 0; k < old.size(); ++k)
      ledger_.require(Check::duplicated,
                      v.position[k] == old.position[k] && v.velocity[k] == old.velocity[k] &&
                          v.fixed[k] == old.fixed[k] && v.point[k] == old.point[k] &&
                          v.force[k] == Eigen::Vector3d(0, 0, 0),
                      "vertex", k);
  }

  RefinementMeans put_in_the_middle(const VertexColumns& old, const std::vector<std::uint32_t>& corners) {
    RefinementMeans m(old, corners);
    const VertexColumns& v = at_.body.vertices;
    ledger_.within(Check::put_in_the_middle, (v.position.back() - m.x).norm(), m.off, m.absolute_x.norm(),
                   v.position.back().norm(), m.x.norm());
    ledger_.within(Check::put_in_the_middle, (v.velocity.back() - m.v).norm(), m.off_v, m.absolute_v.norm(),
                   v.velocity.back().norm(), m.v.norm());
    ledger_.equal(Check::duplicated, v.fixed.back() != 0, m.all_fixed, "fixed, vertex", old.size());
    ledger_.equal(Check::duplicated, v.point.back(), no_point, "point, vertex", old.size());
    return m;
  }

  // At most as many cells around an edge as springs at its ends, so that every term has fewer roundings than this.
  void forces_are_kept(const SpringForceSums& before, std::uint32_t vertex, const RefinementMeans& means) {
    const SpringForceSums after = spring_force_sums(at_.body, at_.views.cells, vertex, &means);
    for (std::uint32_t k = 0; k < after.force.size(); ++k) {
      const bool is_new = k == vertex;
      const Eigen::Vector3d expected = is_new ? Eigen::Vector3d(0, 0, 0) : before.force[k];
      const std::size_t springs = after.springs[k] + (is_new ? 0 : before.springs[k]);
      const double terms = after.terms[k] + (is_new ? 0.0 : before.terms[k]);
      ledger_.within(Check::forces_kept, (after.force[k] - expected).norm(),
                     1.001 * (gamma(2 * springs + 40) * terms + after.moved[k]), terms, after.force[k].norm(),
                     expected.norm());
    }
  }

  const Tamper<Map>& tamper_;
  const FollowSubdivision<Map>& follow_;
  bool is_growing_ = true;
};

}  // namespace

template <class Map>
ConservationResult validate_refinement(const Problem& start, const ConservationPlan& plan, const Tamper<Map>& tamper,
                                       const FollowSubdivision<Map>& followed) {
  for (const CellKind kind : start.mesh.kinds)
    if (kind != CellKind::tetrahedron) throw InputError("expected a mesh of tetrahedra");
  return Run<Map>(start, plan, tamper, followed).run();
}

template ConservationResult validate_refinement(const Problem&, const ConservationPlan&, const Tamper<Map3>&,
                                                const FollowSubdivision<Map3>&);
template ConservationResult validate_refinement(const Problem&, const ConservationPlan&, const Tamper<TetMap>&,
                                                const FollowSubdivision<TetMap>&);

}  // namespace dartboard
