#pragma once
// A simulated body on a map of type Map: embeddings, views and columns that follow its events.

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/bytes.h"
#include "core/base/share_jobs.h"
#include "core/elements/cell_springs.h"
#include "core/mechanics/adapt.h"
#include "core/mechanics/add_cell_springs.h"
#include "core/mechanics/cell_nodes.h"
#include "core/mechanics/element_shapes.h"
#include "core/mechanics/fracture/cell_size.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/mechanics/numbering.h"
#include "core/mechanics/refine.h"
#include "core/scene/body/events/changing_body.h"
#include "core/scene/body/events/ready.h"
#include "core/scene/body/face_origins.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/body/make_contact.h"
#include "core/scene/body/simulated_body.h"
#include "core/topology/check.h"
#include "core/views/component_labels.h"
#include "core/views/element_nodes_view.h"
#include "core/views/followed_cells.h"
#include "core/views/skin.h"
#include "core/views/skin_solids_view.h"
#include "core/views/spring_ends.h"

namespace dartboard {

template <class Map>
class BodyOnMap final : public SimulatedBody, public ChangingBody<Map> {
 public:
  using typename ChangingBody<Map>::Body;
  static constexpr int n = Map::dimension;

  /// `mesh_cell` are the numbers of the cells in the mesh that `needs` refers to; empty: their own.
  BodyOnMap(const Problem& problem, const BodyNeeds& needs, std::vector<std::uint32_t> mesh_cell = {})
      : body_(build_body<Map, Held::by_every_dart>(problem)),
        numbering_(body_),
        has_skin_(needs.contact()),
        has_skin_solids_(!needs.touches.empty()),
        first_cell_(needs.first_cell),
        mesh_cell_(std::move(mesh_cell)) {
    add_cell_springs(body_, problem.mesh, needs.diagonals);
    for (auto c = static_cast<std::uint32_t>(mesh_cell_.size()); c < body_.cell_dart.size(); ++c)
      mesh_cell_.push_back(c);
    // only walks use the column of forces; integrators over arrays keep their own
    body_.vertices.force.clear();
    if (!needs.fixed) body_.vertices.fixed.clear();
    if (needs.rest || needs.rest_of_forces()) body_.vertices.keep_rest();
    if (needs.pull) body_.vertices.pull.assign(body_.vertices.size(), Eigen::Vector3d(0, 0, 0));
    rebuild_views();
    elements_ = make_elements(body_.cell_materials(), body_.elements, {nodes_.nodes, solids_.nodes, triangles_.nodes},
                              body_.cell_mass);
    forces_.add(elements_.get());
    if (!body_.cell_springs.empty()) cell_springs_ = make_cell_springs({solids_.nodes, body_.cell_springs});
    forces_.add(cell_springs_.get());
    forces_.make(needs.forces, {n, body_.vertices, [this](std::uint32_t cell) { return mesh_cell_[cell]; }});
    forces_.for_each([this](BodyForce& force) { force.rebuild(&body_); });
    forces_.touch_obstacles(needs.obstacles, skin_.samples());
    if (has_skin_solids_)
      forces_.touch_bodies(
          std::make_unique<BodyContact>(skin_.samples(), skin_solids_.solids(), needs.touches, needs.still));
    fit_columns();
  }

  // ---- ChangingBody

  Body& body() override { return body_; }
  const Body& body() const override { return body_; }
  std::span<const SpringEnds> ends() const override { return ends_.ends; }
  std::span<const std::uint32_t> mesh_cell() const override { return mesh_cell_; }
  CornerRows corners() const override { return {nodes_.nodes, solids_.nodes}; }
  ForceTerms terms() const override { return forces_.terms(); }

  void follow(const TopologyChange& change) override {
    const ChangedEmbeddings changed = adapt(body_, change);
    for (const auto [from, to] : changed.moved_vertices)
      for (std::uint32_t& vertex : tracked_) vertex = vertex == to ? no_vertex : vertex == from ? to : vertex;
    changed.move_cells(mesh_cell_);
    follow(change, changed);
    keep_in_order(changed);
  }
  void follow(const Subdivision& subdivision, double bracing) override {
    if constexpr (n == 3) {
      face_origins_.follow(body_, subdivision);
      const ChangedEmbeddings changed = adapt(body_, subdivision, bracing);
      mesh_cell_.resize(changed.cell_count);
      const auto cell_of = [this](const Subdivision::Child& child) { return body_.cell(body_.map, child.darts[0]); };
      for (const auto& child : subdivision.children) {  // the first child of a parent keeps its number
        const auto first = child.parent * static_cast<std::size_t>(subdivision.cell_vertices);
        mesh_cell_[cell_of(child)] = mesh_cell_[cell_of(subdivision.children[first])];
      }
      follow({}, changed);
      keep_in_order(changed);
    }
  }
  void count_removed(double mass) override { removed_mass_ += mass; }

  // ---- SimulatedBody

  std::string map_name() const override {
    return n == 2 ? "2-g-map" : Map::tetrahedral ? "tetrahedral 3-g-map" : "3-g-map";
  }
  VertexColumns& vertices() override { return body_.vertices; }
  using SimulatedBody::vertices;
  SpringSystem system() const override {
    const bool has_springs = body_.cell_materials().has_springs();
    return system_of(body_.vertices, has_springs ? ends_.ends : std::span<const SpringEnds>(),
                     has_springs ? SpringSpan(body_.springs) : SpringSpan(), body_.surroundings.gravity,
                     forces_.terms());
  }
  std::unique_ptr<ReadyEvent> make_ready(const SceneEvent& event) override {
    ChangingBody<Map>& on = *this;
    return std::visit([&](const auto& action) { return ready(on, action, event.action_path()); }, event.action);
  }

  std::vector<std::vector<CellCorner>> corners_of(std::span<const std::uint32_t> mesh_cells) const override {
    FollowedCells cells({mesh_cells.begin(), mesh_cells.end()},
                        [this](std::uint32_t cell) { return mesh_cell_[cell]; });
    cells.rebuild(body_);
    std::vector<std::vector<CellCorner>> corners(cells.size());
    for (std::uint32_t k = 0; k < corners.size(); ++k)
      if (cells.is_there(k)) cells.find_corners(body_, k, corners[k]);
    return corners;
  }

  double mass() const override {
    double sum = 0.0;
    for (const double m : body_.cell_mass) sum += m;
    return sum;
  }
  double removed_mass() const override { return removed_mass_; }

  CellCounts counts() const override {
    return {.vertices = body_.vertices.size(),
            .edges = body_.springs.size(),
            .faces = n == 3 ? body_.face_dart.size() : body_.cell_dart.size(),
            .cells = body_.cell_dart.size(),
            .components = components_.count()};
  }

  double boundary() const override {
    double sum = 0.0;
    const auto position = [this](Dart d) -> const Eigen::Vector3d& {
      return body_.vertices.position[body_.vertex(body_.map, d)];
    };
    for (const Dart d : n == 3 ? body_.face_dart : body_.edge_dart) {
      if (!body_.map.template is_free<n>(d)) continue;
      if constexpr (n == 2) {
        sum += (position(body_.map.template alpha<0>(d)) - position(d)).norm();
      } else {
        const auto next = [this](Dart at) { return body_.map.template alpha<0, 1>(at); };
        const Eigen::Vector3d& corner = position(d);
        Eigen::Vector3d twice(0, 0, 0);
        for (Dart a = next(d), b = next(a); b != d; a = b, b = next(b))
          twice += (position(a) - corner).cross(position(b) - corner);
        sum += 0.5 * twice.norm();
      }
    }
    return sum;
  }

  double largest_stress() const override {
    const VertexColumns& v = body_.vertices;
    std::vector<Eigen::Matrix3d> stress;
    VolumeRoom room;
    vertex_stresses(ends_.ends, body_.springs, vertex_volumes(body_, corners(), room), v.position, stress,
                    system().terms);
    return largest_principal_stress(stress);
  }

  Frame frame(const FrameFields& fields) const override {
    Frame frame;
    add_cells(frame.mesh);
    frame.mesh_cell = mesh_cell_;
    frame.component.reserve(mesh_cell_.size());
    for (std::uint32_t c = 0; c < mesh_cell_.size(); ++c) frame.component.push_back(components_.label(c));
    if constexpr (n == 3) add_refined_facets(frame);
    frame.material = body_.cell_material;
    VolumeRoom room;
    fill_columns(frame, fields, body_.vertices, system(),
                 fields.stress ? vertex_volumes(body_, corners(), room) : VertexVolumes{});
    if (fields.contact) fill_contact(frame, contacts());
    return frame;
  }

  std::string violation() const override { return check(body_.map); }
  void state(Archive& archive) override {
    SimulatedBody::state(archive);
    archive(body_, numbering_, mesh_cell_, removed_mass_, face_origins_);
    for_each_view([&archive](auto& view) { archive(view); });
  }

  MemoryReport memory() const override {
    const VertexColumns& v = body_.vertices;
    const Map& map = body_.map;
    // every live slot has its alphas and a generation, every dead slot has an entry in a list
    const std::size_t slots = Map::tetrahedral ? map.capacity() / 24 : map.capacity();
    const std::size_t dead = slots - (Map::tetrahedral ? map.dart_count() / 24 : map.dart_count());
    const std::size_t alphas = Map::tetrahedral ? map.template slot_count<2>() : slots * (n + 1);
    const bool of_elements = use_any_cells(body_.elements);
    std::size_t shapes = 0;
    with_shapes(body_.elements, [&shapes](const auto& rows) { shapes = bytes_of(rows); });
    MemoryReport report{
        {Part::map, sizeof(std::uint32_t) * (alphas + slots + dead)},
        {Part::marks, mark_bytes()},
        {Part::embeddings, body_.embedding_bytes()},
        {Part::cell_darts, bytes_of(v.dart, body_.edge_dart, body_.face_dart, body_.cell_dart)},
        {Part::cells, bytes_of(body_.cell_mass, body_.node_share, body_.cell_inside_out, mesh_cell_) +
                          bytes_of(body_.edge_share, body_.cell_material) + face_origins_.bytes() +
                          (elements_ ? 0 : bytes_of(nodes_.nodes)) +
                          (of_elements || cell_springs_ ? 0 : bytes_of(solids_.nodes))},
        {Part::components, sizeof(std::uint32_t) * components_.cell_count() +
                               (2 * sizeof(std::uint32_t) + sizeof(std::size_t)) * components_.count()},
        {Part::vertices, bytes_of_vertices(v)},
        {Part::viscosity, bytes_of(v.viscosity)},
        {Part::fixed, bytes_of(v.fixed, v.held_axes)},
        {Part::rest, bytes_of(v.rest)},
        {Part::pull, bytes_of(v.pull)},
        {Part::springs, body_.springs.bytes() - body_.springs.damping_bytes() + bytes_of(ends_.ends)},
        {Part::damping, body_.springs.damping_bytes()},
        {Part::elements, shapes + bytes_of(triangles_.nodes) + (elements_ ? bytes_of(nodes_.nodes) : 0) +
                             (of_elements ? bytes_of(solids_.nodes) : 0)}};
    if (cell_springs_)
      report.push_back(
          {Part::cell_springs, bytes_of(body_.cell_springs) + (of_elements ? 0 : bytes_of(solids_.nodes))});
    forces_.report(report);
    if (has_skin_)
      report.push_back({Part::contact, skin_.bytes() + contacts().bytes() +
                                           (has_skin_solids_ ? skin_solids_.bytes() + bytes_of(first_cell_) : 0)});
    return report;
  }

 private:
  /// Columns that grew by doubling give back unused memory.
  void fit_columns() {
    const auto fit = [](auto&... columns) { (columns.shrink_to_fit(), ...); };
    const auto fit_column = [](auto& column, const auto&) { column.shrink_to_fit(); };
    for_each_column(body_.vertices, VertexColumns::embedded(), fit_column);
    for_each_column(body_, Body::embedded_in_cells(), fit_column);
    fit(body_.vertices.dart, body_.springs, body_.edge_dart, body_.face_dart, body_.cell_dart, mesh_cell_, nodes_.nodes,
        solids_.nodes, triangles_.nodes, body_.cell_springs);
    forces_.for_each([](BodyForce& force) { force.shrink_to_fit(); });
  }

  /// The cells as add_cell_of has them, from the rows of a view where one has them all.
  void add_cells(Mesh& mesh) const {
    const std::size_t count = body_.cell_dart.size();
    mesh.kinds.reserve(count);
    mesh.first.reserve(count + 1);
    mesh.nodes.reserve(count * (n == 2 || Map::tetrahedral ? 4 : 8));
    for (std::uint32_t c = 0; c < count; ++c)
      if (nodes_.nodes.size() == count) {
        auto corners = nodes_.nodes[c];
        if (body_.cell_inside_out[c] == 0) std::swap(corners[0], corners[1]);
        mesh.add_cell(CellKind::tetrahedron, corners);
      } else if (solids_.nodes.size() == count) {
        const SolidNodes& corners = solids_.nodes[c];
        mesh.add_cell(kind_of_corners(n, corners.count), std::span(corners.at).first(corners.count));
      } else {
        add_cell_of(body_, c, mesh);
      }
  }

  void add_refined_facets(Frame& frame) const {
    for (const Dart d : body_.face_dart) {
      const FaceOrigins::Points* const origin = face_origins_.of(d);
      if (origin == nullptr || !body_.map.template is_free<n>(d)) continue;
      RefinedFacet facet{};
      const auto around = detail::around_face(body_.map, d);
      for (std::size_t k = 0; k < 3; ++k) {
        facet.points[k] = body_.vertex(body_.map, around[k]);
        facet.lies_in[k] = (*origin)[k];
      }
      frame.refined_facets.push_back(facet);
    }
  }

  /// Calls f(view) for each view that the body holds by itself.
  template <class F>
  void for_each_view(const F& f) {
    f(ends_);
    f(nodes_);
    f(solids_);
    f(triangles_);
    if (has_skin_) f(skin_);
    if (has_skin_solids_) f(skin_solids_);
    f(components_);
  }
  void follow(const TopologyChange& change, const ChangedEmbeddings& changed) {
    for_each_view([&](auto& view) {
      if constexpr (std::is_same_v<decltype(view), ComponentLabels&>)
        view.apply(body_, change, changed);
      else
        view.apply(body_, changed);
    });
    forces_.for_each([&](BodyForce& force) { force.apply(&body_, changed); });
  }
  /// Labels of components look at tetrahedra without marks, so another thread can find them meanwhile.
  void rebuild_views() {
    const auto rebuild = [this](bool labels) {
      for_each_view([this, labels](auto& view) {
        if (labels == std::is_same_v<decltype(view), ComponentLabels&>) view.rebuild(body_);
      });
    };
    const std::function<void()> jobs[]{[&] { rebuild(true); }, [&] { rebuild(false); }};
    share_jobs(Map::tetrahedral ? body_.cell_dart.size() : 0, jobs);
  }
  /// Bodies in contact keep their numbers: by those of its samples, contact remembers how they stick.
  void keep_in_order(const ChangedEmbeddings& changed) {
    if (has_skin_) return;
    const std::vector<std::uint32_t> number = numbering_.follow(body_, changed);
    if (number.empty()) return;
    for (std::uint32_t& vertex : tracked_)
      if (vertex != no_vertex) vertex = number[vertex];
    for_each_view([this](auto& view) {
      if constexpr (!std::is_same_v<decltype(view), ComponentLabels&>) view.rebuild(body_);  // those are of cells
    });
    forces_.for_each([this](BodyForce& force) { force.rebuild(&body_); });
  }

  /// All marks of the map are idle between operations; each is taken once to read its length. The last one taken is a
  /// new one, without a bit.
  std::size_t mark_bytes() const {
    std::size_t bytes = 0;
    std::vector<MarkPool::Bits*> taken;
    do {
      taken.push_back(&body_.map.marks().take(0));
      bytes += bytes_of(taken.back()->words, taken.back()->used);
    } while (!taken.back()->words.empty());
    for (MarkPool::Bits* bits : taken) bits->in_use = false;
    return bytes;
  }

  Body body_;
  Numbering numbering_;
  bool has_skin_, has_skin_solids_;  // views that contact needs
  SpringEndsView ends_;
  TetrahedronNodesView nodes_{Map::tetrahedral};  // of springs, or of elements that are all tetrahedra
  SolidNodesView solids_{!Map::tetrahedral};      // or of cells of any kind
  TriangleNodesView triangles_;                   // of a surface of elements, all triangles
  std::unique_ptr<ForceTerm> elements_;           // null where all are springs
  std::unique_ptr<ForceTerm> cell_springs_;       // null without diagonals
  Skin skin_;                                     // the samples of its boundary, where there is contact
  std::vector<std::size_t> first_cell_;           // of each body of the scene, in its mesh
  // what its parts can be inside of, where some touch
  SkinSolidsView skin_solids_{[this](std::uint32_t cell) { return body_of_cell(first_cell_, mesh_cell_[cell]); }};
  ComponentLabels components_;
  std::vector<std::uint32_t> mesh_cell_;  // by cell: its number in the mesh
  double removed_mass_ = 0.0;             // [kg]
  FaceOrigins face_origins_;              // of a refined solid
};

}  // namespace dartboard
