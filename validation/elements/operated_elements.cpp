#include "validation/elements/operated_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "core/views/element_nodes_view.h"
#include "reference/elements/cell_energy.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

Problem problem_of(const Mesh& mesh, Model model) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1000.0,
                      .stiffness = 0.0,
                      .damping = 0.0,
                      .viscosity = 0.5,
                      .young = 3e4,
                      .poisson = 0.3,
                      .model = model};
  return problem;
}

double shortest_edge(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& face : faces_of(mesh.kinds[c]))
      for (std::size_t k = 0; k < face.size(); ++k) {
        const auto place = [&](std::size_t j) -> const Vector3d& {
          return mesh.points[mesh.cell(c)[static_cast<std::size_t>(face[j % face.size()])]];
        };
        shortest = std::min(shortest, (place(k) - place(k + 1)).norm());
      }
  return shortest;
}

/// Nodes is TetrahedronNodes on a tetrahedral map, SolidNodes else.
template <class Map, class Nodes>
class Operated {
 public:
  using Body = MassSpringBody<Map, Held::by_every_dart>;
  static constexpr bool tetrahedra = std::is_same_v<Nodes, TetrahedronNodes>;

  Operated(const Mesh& mesh, Model model, std::uint64_t seed)
      : problem_(problem_of(mesh, model)), body_(build_body<Map, Held::by_every_dart>(problem_)), random_(seed) {
    view_.rebuild(body_);
    term_ = term_of(body_, view_);
    const double far = 0.1 * shortest_edge(mesh);
    for (Vector3d& x : body_.vertices.position)
      for (double& c : x) c += far * random_.next_signed();
    energy_ = energy();
    whole_ = body_.cell_dart.size();
  }

  bool is_half_gone() const { return 2 * body_.cell_dart.size() < whole_; }

  void operate(ElementOperations& found, const ElementOperationsPlan& plan) {
    const auto follow = [&](const TopologyChange& change) {
      view_.apply(body_, adapt(body_, change));
      if (plan.meddles)
        plan.meddles(found.operations(), body_.vertices.position, std::get<std::vector<RestShape>>(body_.elements));
    };
    const std::uint32_t what = random_.below(8);
    if (what < 7) {
      follow(what < 6 ? dissociate_face(body_.map, some_dart()) : tear_fan(body_.map, some_dart()));
      ++found.dissociated;
      const double now = energy();
      found.dissociation = max_or_nan(found.dissociation, std::abs(now - energy_) / energy_);
      energy_ = now;
    } else {
      const Dart d = some_dart();
      const double of_cell = energy_of(body_.cell(body_.map, d));
      follow(remove_volume(body_.map, d));
      ++found.removed;
      const double now = energy();
      found.removal = max_or_nan(found.removal, std::abs((energy_ - now) - of_cell) / energy_);
      energy_ = now;
    }
  }

  /// Compares with a body that is built from the corners of the remaining cells, each vertex a point.
  void compare(ElementOperations& found) const {
    Problem anew = problem_;
    anew.mesh = {};
    for (std::uint32_t k = 0; k < body_.vertices.size(); ++k)
      anew.mesh.points.push_back(problem_.mesh.points[body_.vertices.point[k]]);
    for (std::uint32_t c = 0; c < view_.nodes.size(); ++c) {
      const auto nodes = nodes_of(view_.nodes[c]);
      anew.mesh.add_cell(kind_of(c), nodes);
    }
    std::vector<double> mass(body_.vertices.size(), 0.0);
    for (std::size_t c = 0; c < anew.mesh.cell_count(); ++c)
      for (const std::uint32_t k : anew.mesh.cell(c))
        mass[k] += anew.material.density * std::abs(signed_measure(anew.mesh, c)) /
                   static_cast<double>(anew.mesh.cell(c).size());
    for (std::size_t k = 0; k < mass.size(); ++k)
      found.mass = max_or_nan(found.mass, std::abs(body_.vertices.mass[k] / mass[k] - 1.0));

    const Fresh fresh(anew, view_.nodes);
    const StagePlaces at{body_.vertices.position};
    std::vector<Vector3d> force(mass.size(), Vector3d::Zero()), expected = force;
    std::vector<double> size(mass.size(), 0.0);
    term_->add_forces(at, force);
    fresh.term->add_forces(at, expected);
    fresh.term->add_force_sizes(at, size);
    for (std::size_t k = 0; k < force.size(); ++k)
      found.force = max_or_nan(found.force, (force[k] - expected[k]).norm() / size[k]);

    long double sum = 0.0L;
    for (std::uint32_t c = 0; c < view_.nodes.size(); ++c) sum += energy_of(c);
    if constexpr (!tetrahedra) sum = fresh.term->energy(body_.vertices.position);
    found.energy = max_or_nan(found.energy, std::abs(energy_ - static_cast<double>(sum)) / energy_);
    ++found.compared;
  }

 private:
  Dart some_dart() {
    for (;;)
      if (const Dart d{random_.below(body_.map.capacity())}; body_.map.is_live(d)) return d;
  }
  double energy() const { return term_->energy(body_.vertices.position); }

  static std::span<const std::uint32_t> nodes_of(const TetrahedronNodes& nodes) { return nodes; }
  static std::span<const std::uint32_t> nodes_of(const SolidNodes& nodes) { return {nodes.at.data(), nodes.count}; }
  CellKind kind_of(std::uint32_t c) const {
    if constexpr (tetrahedra)
      return CellKind::tetrahedron;
    else
      return shapes_of<SolidShape>(body_.elements)[c].kind;
  }

  static std::unique_ptr<ForceTerm> term_of(const Body& body, const ElementNodesView<Nodes>& view) {
    if constexpr (tetrahedra)
      return make_tetrahedra(body.cell_materials(),
                             {view.nodes, std::get<std::vector<RestShape>>(body.elements), body.cell_mass});
    else
      return make_solids(body.cell_materials(), {view.nodes, std::get<std::vector<SolidShape>>(body.elements)});
  }

  /// The elements of a body whose shapes at rest are computed here, from places at rest.
  struct Fresh {
    std::vector<Nodes> nodes;
    std::vector<double> mass;
    std::vector<RestShape> shape;
    std::vector<SolidShape> solid;
    std::unique_ptr<ForceTerm> term;

    Fresh(const Problem& anew, const std::vector<Nodes>& corners) : nodes(corners) {
      for (std::size_t c = 0; c < anew.mesh.cell_count(); ++c) {
        std::vector<Vector3d> x;
        for (const std::uint32_t k : anew.mesh.cell(c)) x.push_back(anew.mesh.points[k]);
        mass.push_back(anew.material.density * std::abs(signed_measure(anew.mesh, c)));
        if constexpr (tetrahedra)
          shape.push_back(rest_shape_of(x[0], x[1], x[2], x[3]));
        else
          solid.push_back(solid_shape_of(anew.mesh.kinds[c], x));
      }
      if constexpr (tetrahedra)
        term = make_tetrahedra(anew.material, {nodes, shape, mass});
      else
        term = make_solids(anew.material, {nodes, solid});
    }
  };

  /// The energy of one cell, for tetrahedra by the witness, for others by a term of that cell alone.
  double energy_of(std::uint32_t c) const {
    if constexpr (tetrahedra) {
      std::array<Vector3d, 4> rest, now;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t v = view_.nodes[c][k];
        rest[k] = problem_.mesh.points[body_.vertices.point[v]];
        now[k] = body_.vertices.position[v];
      }
      return static_cast<double>(reference::tetrahedron_energy(problem_.material, rest, now));
    } else {
      const std::vector<Nodes> nodes{view_.nodes[c]};
      const std::vector<SolidShape> shape{shapes_of<SolidShape>(body_.elements)[c]};
      return make_solids(problem_.material, {nodes, shape})->energy(body_.vertices.position);
    }
  }

  Problem problem_;
  Body body_;
  SplitMix64 random_;
  ElementNodesView<Nodes> view_;
  std::unique_ptr<ForceTerm> term_;
  double energy_ = 0.0;
  std::size_t whole_ = 0;
};

template <class Map, class Nodes>
ElementOperations operate(const Mesh& mesh, Model model, const ElementOperationsPlan& plan,
                          const std::function<void(std::size_t)>& tells) {
  ElementOperations found;
  found.model = model;
  std::uint64_t seed = plan.seed;
  auto operated = std::make_unique<Operated<Map, Nodes>>(mesh, model, seed);
  for (std::size_t k = 1; k <= plan.operations; ++k) {
    operated->operate(found, plan);
    if (k % plan.check_every == 0 || k == plan.operations) {
      operated->compare(found);
      if (tells) tells(k);
    }
    if (operated->is_half_gone()) operated = std::make_unique<Operated<Map, Nodes>>(mesh, model, ++seed);
  }
  return found;
}

}  // namespace

ElementOperations operate_on_elements(const Mesh& mesh, Model model, const ElementOperationsPlan& plan,
                                      const std::function<void(std::size_t)>& tells) {
  const bool all_tetrahedra =
      std::ranges::all_of(mesh.kinds, [](CellKind kind) { return kind == CellKind::tetrahedron; });
  return all_tetrahedra ? operate<TetMap, TetrahedronNodes>(mesh, model, plan, tells)
                        : operate<Map3, SolidNodes>(mesh, model, plan, tells);
}

}  // namespace dartboard
