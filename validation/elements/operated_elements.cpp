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
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "core/views/attachments_view.h"
#include "core/views/element_nodes_view.h"
#include "core/views/spring_ends.h"
#include "reference/elements/cell_energy.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

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

  Operated(const Mesh& mesh, const RegionMix& mix, std::uint64_t seed)
      : problem_(problem_of(mesh, mix)),
        body_(build_body<Map, Held::by_every_dart>(problem_)),
        random_(seed),
        attachments_(attachments_of(problem_, mix)),
        attached_(attachments_, [this](std::uint32_t c) { return mesh_cell_[c]; }) {
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) mesh_cell_.push_back(c);
    view_.rebuild(body_);
    ends_.rebuild(body_);
    attached_.rebuild(body_);
    if (has_elements(body_.elements)) terms_.push_back(term_of(body_, view_));
    terms_.push_back(make_attachments(attached_.rows, body_.vertices.mass));
    for (const auto& term : terms_) acting_.push_back(term.get());
    const double far = 0.1 * shortest_edge(mesh);
    for (Vector3d& x : body_.vertices.position)
      for (double& c : x) c += far * random_.next_signed();
    energy_ = energy();
    whole_ = body_.cell_dart.size();
  }

  Operated(const Operated&) = delete;
  Operated& operator=(const Operated&) = delete;

  bool is_half_gone() const { return 2 * body_.cell_dart.size() < whole_; }

  void operate(ElementOperations& found, const ElementOperationsPlan& plan) {
    const auto follow = [&](const TopologyChange& change) {
      const ChangedEmbeddings changed = adapt(body_, change);
      changed.move_cells(mesh_cell_);
      view_.apply(body_, changed);
      ends_.apply(body_, changed);
      attached_.apply(body_, changed);
      if (plan.meddles)
        plan.meddles(found.operations(),
                     {body_.vertices.position, body_.elements, body_.cell_material, attached_.rows});
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
      const double of_cell = energy_of_cell(body_.cell(body_.map, d)), attached = attached_energy();
      follow(remove_volume(body_.map, d));
      ++found.removed;
      const double now = energy(), taken = of_cell + (attached - attached_energy());
      found.removal = max_or_nan(found.removal, std::abs((energy_ - now) - taken) / energy_);
      energy_ = now;
    }
  }

  /// Compares with a body that is built from the corners of the remaining cells, each vertex a point.
  void compare(ElementOperations& found) const {
    Problem anew = problem_;
    anew.mesh = {};
    anew.cell_material.clear();
    for (std::uint32_t k = 0; k < body_.vertices.size(); ++k)
      anew.mesh.points.push_back(problem_.mesh.points[body_.vertices.point[k]]);
    for (std::uint32_t c = 0; c < view_.nodes.size(); ++c) {
      const auto nodes = nodes_of(view_.nodes[c]);
      anew.mesh.add_cell(problem_.mesh.kinds[mesh_cell_[c]], nodes);
      anew.cell_material.push_back(problem_.cell_materials().number(mesh_cell_[c]));
      found.strangers += !is_its_own(c);
    }
    const CellMaterials materials = anew.cell_materials();
    std::vector<double> mass(body_.vertices.size(), 0.0);
    for (std::size_t c = 0; c < anew.mesh.cell_count(); ++c)
      for (const std::uint32_t k : anew.mesh.cell(c))
        mass[k] += materials[c].density * std::abs(signed_measure(anew.mesh, c)) /
                   static_cast<double>(anew.mesh.cell(c).size());
    for (std::size_t k = 0; k < mass.size(); ++k)
      found.mass = max_or_nan(found.mass, std::abs(body_.vertices.mass[k] / mass[k] - 1.0));

    const Fresh fresh(anew, view_.nodes);
    const std::vector<AttachedVertex> rows = attached_anew();
    const auto attachments = make_attachments(rows, mass);
    const StagePlaces at{body_.vertices.position};
    std::vector<Vector3d> force(mass.size(), Vector3d::Zero()), expected = force;
    std::vector<double> size(mass.size(), 0.0);
    accelerations(system(), {}, at.x, at.x, force);
    for (const ForceTerm* term : {fresh.term.get(), attachments.get()}) {
      if (term == nullptr) continue;
      term->add_forces(at, expected);
      term->add_force_sizes(at, size);
    }
    const std::vector<reference::Spring> springs = springs_of(anew.mesh, materials);
    for (const reference::Spring& s : springs) {
      const Vector3d line = at.x[s.b] - at.x[s.a];
      const double length = line.norm();
      const Vector3d pull = s.stiffness * (length - s.rest_length) / length * line;
      expected[s.a] += pull;
      expected[s.b] -= pull;
      for (const std::uint32_t k : {s.a, s.b}) size[k] += s.stiffness * (length + s.rest_length);
    }
    for (std::size_t k = 0; k < force.size(); ++k)
      found.force = max_or_nan(found.force, (body_.vertices.mass[k] * force[k] - expected[k]).norm() / size[k]);

    long double sum = energy_of(springs, at.x) + static_cast<long double>(attachments->energy(at.x));
    for (std::uint32_t c = 0; tetrahedra && c < view_.nodes.size(); ++c)
      if (materials[c].model != Model::springs) sum += energy_of_cell(c);
    if (!tetrahedra && fresh.term) sum += fresh.term->energy(at.x);
    found.energy = max_or_nan(found.energy, std::abs(energy_ - static_cast<double>(sum)) / energy_);
    ++found.compared;
  }

 private:
  Dart some_dart() {
    for (;;)
      if (const Dart d{random_.below(body_.map.capacity())}; body_.map.is_live(d)) return d;
  }
  SpringSystem system() const {
    const VertexColumns& v = body_.vertices;
    SpringSystem all;
    all.mass = v.mass;
    all.inverse_mass = v.inverse_mass;
    all.terms = acting_;
    if (!body_.cell_materials().has_springs()) return all;
    all.ends = ends_.ends;
    all.springs = body_.springs;
    return all;
  }
  double energy() const { return elastic_energy(system(), body_.vertices.position); }

  /// Has cell c the corners and the material of its cell of the mesh?
  bool is_its_own(std::uint32_t c) const {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t k : nodes_of(view_.nodes[c])) points.push_back(body_.vertices.point[k]);
    return std::ranges::is_permutation(points, problem_.mesh.cell(mesh_cell_[c])) &&
           body_.cell_materials().number(c) == problem_.cell_materials().number(mesh_cell_[c]);
  }

  /// The rows of the attachments by going through all vertices and cells.
  std::vector<AttachedVertex> attached_anew() const {
    std::vector<AttachedVertex> rows;
    if (attachments_.empty()) return rows;
    std::vector<std::uint32_t> cell_of(problem_.mesh.cell_count(), Attachment::no_cell);
    for (std::uint32_t c = 0; c < mesh_cell_.size(); ++c) cell_of[mesh_cell_[c]] = c;
    const auto point_of = [this](std::uint32_t k) { return body_.vertices.point[k]; };
    for (std::uint32_t k = 0; k < body_.vertices.size(); ++k) {
      const auto one = std::ranges::lower_bound(attachments_, point_of(k), {}, &Attachment::point);
      if (one == attachments_.end() || one->point != point_of(k) || cell_of[one->cell] == Attachment::no_cell) continue;
      AttachedVertex& row = rows.emplace_back(attached(*one, k));
      const auto corners = nodes_of(view_.nodes[cell_of[one->cell]]);
      for (std::size_t a = 0; a < one->count; ++a)
        row.nodes[a + 1] = *std::ranges::find(corners, one->corners[a], point_of);
    }
    return rows;
  }
  double attached_energy() const {
    const std::vector<AttachedVertex> rows = attached_anew();
    return make_attachments(rows, body_.vertices.mass)->energy(body_.vertices.position);
  }

  static std::span<const std::uint32_t> nodes_of(const TetrahedronNodes& nodes) { return nodes; }
  static std::span<const std::uint32_t> nodes_of(const SolidNodes& nodes) { return {nodes.at.data(), nodes.count}; }

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
      const CellMaterials materials = anew.cell_materials();
      if (!materials.has_elements()) return;
      for (std::size_t c = 0; c < anew.mesh.cell_count(); ++c) {
        std::vector<Vector3d> x;
        for (const std::uint32_t k : anew.mesh.cell(c)) x.push_back(anew.mesh.points[k]);
        mass.push_back(materials[c].density * std::abs(signed_measure(anew.mesh, c)));
        if constexpr (tetrahedra)
          shape.push_back(rest_shape_of(x[0], x[1], x[2], x[3]));
        else
          solid.push_back(solid_shape_of(anew.mesh.kinds[c], x));
      }
      if constexpr (tetrahedra)
        term = make_tetrahedra(materials, {nodes, shape, mass});
      else
        term = make_solids(materials, {nodes, solid});
    }
  };

  /// The energy of one cell: of springs and of tetrahedra by the witnesses, of others by a term of that cell alone.
  double energy_of_cell(std::uint32_t c) const {
    const Material& material = problem_.cell_materials()[mesh_cell_[c]];
    const auto nodes = nodes_of(view_.nodes[c]);
    Mesh cell;
    std::vector<Vector3d> now;
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t k : nodes) {
      numbers.push_back(static_cast<std::uint32_t>(now.size()));
      cell.points.push_back(problem_.mesh.points[body_.vertices.point[k]]);
      now.push_back(body_.vertices.position[k]);
    }
    if (material.model == Model::springs) {
      cell.add_cell(problem_.mesh.kinds[mesh_cell_[c]], numbers);
      return static_cast<double>(energy_of(springs_of(cell, material), now));
    }
    if constexpr (tetrahedra) {
      const auto four = [](const std::vector<Vector3d>& p) { return std::array{p[0], p[1], p[2], p[3]}; };
      return static_cast<double>(reference::tetrahedron_energy(material, four(cell.points), four(now)));
    } else {
      const std::vector<Nodes> corners{view_.nodes[c]};
      const std::vector<SolidShape> shape{shapes_of<SolidShape>(body_.elements)[c]};
      return make_solids(material, {corners, shape})->energy(body_.vertices.position);
    }
  }

  Problem problem_;
  Body body_;
  SplitMix64 random_;
  ElementNodesView<Nodes> view_{true};
  SpringEndsView ends_;
  std::vector<std::uint32_t> mesh_cell_;  // by cell: its number in the mesh
  std::vector<Attachment> attachments_;   // ascending by point, of which each has one at most
  AttachmentsView attached_;
  std::vector<std::unique_ptr<ForceTerm>> terms_;
  std::vector<const ForceTerm*> acting_;
  double energy_ = 0.0;
  std::size_t whole_ = 0;
};

template <class Map, class Nodes>
ElementOperations operate(const Mesh& mesh, const RegionMix& mix, const ElementOperationsPlan& plan,
                          const std::function<void(std::size_t)>& tells) {
  ElementOperations found;
  found.model = mix.name;
  std::uint64_t seed = plan.seed;
  auto operated = std::make_unique<Operated<Map, Nodes>>(mesh, mix, seed);
  for (std::size_t k = 1; k <= plan.operations; ++k) {
    operated->operate(found, plan);
    if (k % plan.check_every == 0 || k == plan.operations) {
      operated->compare(found);
      if (tells) tells(k);
    }
    if (operated->is_half_gone()) operated = std::make_unique<Operated<Map, Nodes>>(mesh, mix, ++seed);
  }
  return found;
}

}  // namespace

ElementOperations operate_on_elements(const Mesh& mesh, const RegionMix& mix, const ElementOperationsPlan& plan,
                                      const std::function<void(std::size_t)>& tells) {
  const bool all_tetrahedra =
      std::ranges::all_of(mesh.kinds, [](CellKind kind) { return kind == CellKind::tetrahedron; });
  return all_tetrahedra ? operate<TetMap, TetrahedronNodes>(mesh, mix, plan, tells)
                        : operate<Map3, SolidNodes>(mesh, mix, plan, tells);
}

}  // namespace dartboard
