#include "core/scene/body/body_of_columns.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/base/bytes.h"
#include "core/base/disjoint_sets.h"
#include "core/base/share_jobs.h"
#include "core/mechanics/add_cell_springs.h"
#include "core/mechanics/fracture/stress.h"
#include "core/plain/error.h"
#include "core/scene/body/events/ready.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/body/make_contact.h"
#include "core/views/boundary_surface.h"
#include "core/views/component_labels.h"
#include "core/views/skin.h"
#include "core/views/skin_solids_view.h"

namespace dartboard {
namespace {

/// The ends and the middles of links, by the areas of strips of these widths [m]: a sixth of a strip at each of its
/// ends and the rest in its middle, which integrates cubic functions exactly.
std::vector<SkinSample> samples_of_links(const std::vector<SpringEnds>& ends, const Springs& springs,
                                         const CellMaterials& materials, std::size_t points) {
  std::vector<SkinSample> samples(points), middles;
  for (std::uint32_t p = 0; p < points; ++p) samples[p] = {{p}, 1, 0.0};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double area = materials[k].width * springs[k].rest_length;
    for (const std::uint32_t end : ends[k]) samples[end].area += area / 6.0;
    middles.push_back({{ends[k][0], ends[k][1]}, 2, area / 1.5});
  }
  samples.insert(samples.end(), middles.begin(), middles.end());
  return samples;
}

}  // namespace

BodyOfColumns::BodyOfColumns(const Problem& problem, const BodyNeeds& needs, std::vector<std::uint32_t> mesh_cell)
    : mesh_cell_(std::move(mesh_cell)) {
  switch (needs.storage) {
    case Storage::links: link(problem, needs); break;
    case Storage::surface: take(build_body<Map2, Held::by_every_dart>(problem), problem.mesh, needs); break;
    case Storage::tetrahedra: take(build_body<TetMap, Held::by_every_dart>(problem), problem.mesh, needs); break;
    case Storage::several:  // a body of its own kind (body_of_parts.h)
    case Storage::any_cells: take(build_body<Map3, Held::by_every_dart>(problem), problem.mesh, needs); break;
  }
}

void BodyOfColumns::link(const Problem& problem, const BodyNeeds& needs) {
  const auto& points = problem.mesh.points;
  const CellMaterials materials = problem.cell_materials();
  gravity_ = problem.surroundings.gravity;
  material_ = problem.material;
  materials_ = problem.materials;
  cell_material_ = problem.cell_material;
  counts_ = {.vertices = points.size(), .edges = problem.mesh.links.size()};
  vertices_.position = points;
  vertices_.mass.assign(points.size(), 0.0);
  DisjointSets chains(points.size());
  for (std::size_t k = 0; k < problem.mesh.links.size(); ++k) {
    const auto [a, b] = problem.mesh.links[k];
    const Material& material = materials[k];
    const double length = (points[b] - points[a]).norm(), mass = material.density * length;
    if (!(std::min(length, mass) > 0.0 && std::isfinite(length) && std::isfinite(mass)))
      throw InputError(
          fmt::format("link {} has a length of {} m and a mass of {} kg; expected numbers > 0", k, length, mass));
    ends_.push_back({a, b});
    chains.join(a, b);
    const double share = material.young > 0.0 ? material.young / length / material.stiffness : 1.0;
    springs_.push_back({length, share * material.stiffness, share * material.damping});
    cell_mass_.push_back(mass);
    for (const std::uint32_t end : ends_.back()) vertices_.mass[end] += mass / 2;
  }
  counts_.components = chains.count();
  std::vector<std::uint32_t> number(points.size(), 0);  // of chains, by their lowest points
  std::uint32_t next = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (!(vertices_.mass[p] > 0.0)) throw InputError(fmt::format("point {} belongs to no cell and to no link", p));
    if (chains.set_of(p) == p) number[p] = next++;
  }
  if (next > 1)
    for (const auto& [a, b] : ends_) component_.push_back(number[chains.set_of(a)]);
  if (needs.rest) vertices_.keep_rest();
  vertices_.velocity = problem.initial_velocity;
  vertices_.velocity.resize(points.size(), Eigen::Vector3d(0, 0, 0));
  if (needs.fixed) vertices_.fixed.assign(points.size(), 0);
  for (const std::uint32_t p : problem.fixed) {
    vertices_.fixed[p] = 1;
    vertices_.velocity[p].setZero();
  }
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (!vertices_.velocity[p].allFinite())
      throw InputError(fmt::format("the initial velocity of point {} is not finite", p));
    vertices_.inverse_mass.push_back(1.0 / vertices_.mass[p]);
    if (needs.viscosity) vertices_.viscosity.push_back(material_.viscosity * vertices_.mass[p]);
    vertices_.point.push_back(p);
  }
  vertices_.hold(problem.held_axes);
  if (needs.pull) vertices_.pull.assign(points.size(), Eigen::Vector3d(0, 0, 0));
  forces_.make(needs.forces, {1, vertices_, {}});
  forces_.for_each([this](BodyForce& force) {
    force.rebuild({vertices_, [](std::span<const std::uint32_t> cells) {
                     return std::vector<std::vector<CellCorner>>(cells.size());
                   }});
    force.leave_map();
  });
  if (!needs.obstacles.empty()) samples_ = samples_of_links(ends_, springs_, materials, points.size());
  forces_.touch_obstacles(needs.obstacles, samples_);
}

template <class Map>
void BodyOfColumns::take(MassSpringBody<Map, Held::by_every_dart> body, const Mesh& mesh, const BodyNeeds& needs) {
  add_cell_springs(body, mesh, needs.diagonals);
  SpringEndsView ends;
  ComponentLabels components;
  BoundarySurface boundary;
  VolumeRoom room;
  // labels of components look at tetrahedra without marks
  const std::function<void()> jobs[]{[&] { components.rebuild(body); },
                                     [&] {
                                       ends.rebuild(body);
                                       boundary.rebuild(body);
                                       vertex_volumes(body, {}, room);
                                     }};
  share_jobs(Map::tetrahedral ? body.cell_dart.size() : 0, jobs);
  counts_ = {.vertices = body.vertices.size(),
             .edges = body.springs.size(),
             .faces = Map::dimension == 3 ? body.face_dart.size() : body.cell_dart.size(),
             .cells = body.cell_dart.size(),
             .components = components.count()};
  for (std::uint32_t c = 0; c < counts_.cells; ++c) component_.push_back(components.label(c));
  for (const BoundaryFacet& facet : boundary.facets()) {
    for (const std::uint32_t k : BoundarySurface::corners(body, facet)) facet_node_.push_back(k);
    facet_first_.push_back(static_cast<std::uint32_t>(facet_node_.size()));
  }
  std::vector<std::uint32_t> vertex_of(mesh.points.size());
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) vertex_of[body.vertices.point[k]] = k;
  cells_.kinds = mesh.kinds;
  cells_.first = mesh.first;
  for (const std::uint32_t p : mesh.nodes) cells_.nodes.push_back(vertex_of[p]);
  if (needs.rest_of_forces()) body.vertices.keep_rest();
  forces_.make(needs.forces, {Map::dimension, vertices_, [this](std::uint32_t cell) { return mesh_cell(cell); }});
  forces_.for_each([&body](BodyForce& force) {
    force.rebuild(&body);
    force.leave_map();
  });
  if (needs.contact()) {
    Skin skin;
    skin.rebuild(body);
    samples_ = skin.samples();
  }
  if (!needs.touches.empty()) {
    SkinSolidsView solids(
        [this, &needs](std::uint32_t cell) { return body_of_cell(needs.first_cell, mesh_cell(cell)); });
    solids.rebuild(body);
    skin_solids_ = solids.solids();
  }
  body.vertices.rest = {};

  volume_ = std::move(room.at_rest);
  vertices_ = std::move(body.vertices);
  vertices_.dart.clear();
  vertices_.force.clear();
  if (!needs.viscosity) vertices_.viscosity.clear();
  if (!needs.fixed) vertices_.fixed.clear();
  if (needs.rest) vertices_.keep_rest();
  if (needs.pull) vertices_.pull.assign(vertices_.size(), Eigen::Vector3d(0, 0, 0));
  const auto nodes_of = [&body](auto view) {
    view.rebuild(body);
    return std::move(view.nodes);
  };
  nodes_ = nodes_of(TetrahedronNodesView());
  solid_nodes_ = nodes_of(SolidNodesView());
  triangle_nodes_ = nodes_of(TriangleNodesView());
  shapes_ = std::move(body.elements);
  if (body.cell_materials().has_springs()) {
    springs_ = std::move(body.springs);
    ends_ = std::move(ends.ends);
  }
  cell_mass_ = std::move(body.cell_mass);
  gravity_ = body.surroundings.gravity;
  material_ = body.material;
  materials_ = std::move(body.materials);
  cell_material_ = std::move(body.cell_material);
  const CellMaterials materials(material_, materials_, cell_material_);
  elements_ = make_elements(materials, shapes_, {nodes_, solid_nodes_, triangle_nodes_}, cell_mass_);
  springs_within_ = std::move(body.cell_springs);
  if (!springs_within_.empty()) cell_springs_ = make_cell_springs({solid_nodes_, springs_within_});
  forces_.add(elements_.get());
  forces_.add(cell_springs_.get());
  forces_.touch_obstacles(needs.obstacles, samples_);
  if (!needs.touches.empty())
    forces_.touch_bodies(std::make_unique<BodyContact>(samples_, skin_solids_, needs.touches, needs.still));
  // columns that grew by doubling give back unused memory
  for_each_column(vertices_, VertexColumns::embedded(), [](auto& column, const auto&) { column.shrink_to_fit(); });
  const auto fit = [](auto&... columns) { (columns.shrink_to_fit(), ...); };
  fit(vertices_.dart, springs_, ends_, nodes_, solid_nodes_, springs_within_, triangle_nodes_);
  with_shapes(shapes_, fit);
  fit(cells_.kinds, cells_.first, cells_.nodes, cell_mass_, component_, facet_first_, facet_node_);
  fit(cell_material_, volume_);
}

MemoryReport BodyOfColumns::memory() const {
  const bool of_elements = use_any_cells(shapes_);
  std::size_t shapes = 0;
  with_shapes(shapes_, [&shapes](const auto& rows) { shapes = bytes_of(rows); });
  MemoryReport report{
      {Part::vertices, bytes_of_vertices(vertices_) + bytes_of(vertices_.dart)},
      {Part::viscosity, bytes_of(vertices_.viscosity)},
      {Part::fixed, bytes_of(vertices_.fixed, vertices_.held_axes)},
      {Part::rest, bytes_of(vertices_.rest)},
      {Part::pull, bytes_of(vertices_.pull)},
      {Part::springs, springs_.bytes() - springs_.damping_bytes() + bytes_of(ends_)},
      {Part::damping, springs_.damping_bytes()},
      {Part::elements, shapes + bytes_of(nodes_, triangle_nodes_) + (of_elements ? bytes_of(solid_nodes_) : 0)},
      {Part::output_cells,
       bytes_of(cells_.kinds, cells_.first, cells_.nodes, cell_mass_, component_, facet_first_, facet_node_) +
           bytes_of(cell_material_, volume_, mesh_cell_)}};
  if (cell_springs_)
    report.push_back({Part::cell_springs, bytes_of(springs_within_) + (of_elements ? 0 : bytes_of(solid_nodes_))});
  forces_.report(report);
  if (const Contacts contacts = this->contacts(); contacts.any())
    report.push_back({Part::contact,
                      bytes_of(samples_) + contacts.bytes() + (contacts.bodies != nullptr ? skin_solids_.bytes() : 0)});
  return report;
}

std::unique_ptr<ReadyEvent> BodyOfColumns::make_ready(const SceneEvent& event) {
  return std::visit(
      [&]<class Kind>(const Kind& action) -> std::unique_ptr<ReadyEvent> {
        if constexpr (Kind::changes_topology)
          throw InputError(event.path + ": the body was built for a scene whose events leave the topology as it is");
        else
          return ready(vertices_, action, event.action_path());
      },
      event.action);
}

std::vector<std::vector<CellCorner>> BodyOfColumns::corners_of(std::span<const std::uint32_t> mesh_cells) const {
  std::vector<std::vector<CellCorner>> corners(mesh_cells.size());
  for (std::uint32_t c = 0; c < counts_.cells; ++c) {
    const auto found = std::ranges::lower_bound(mesh_cells, mesh_cell(c));
    if (found == mesh_cells.end() || *found != mesh_cell(c)) continue;
    for (const std::uint32_t vertex : cells_.cell(c))
      corners[static_cast<std::size_t>(found - mesh_cells.begin())].push_back({vertices_.point[vertex], vertex});
  }
  return corners;
}

double BodyOfColumns::mass() const {
  double sum = 0.0;
  for (const double m : cell_mass_) sum += m;
  return sum;
}

double BodyOfColumns::boundary() const {
  double sum = 0.0;
  const auto& x = vertices_.position;
  for (std::size_t f = 0; f + 1 < facet_first_.size(); ++f) {
    const std::uint32_t* node = facet_node_.data() + facet_first_[f];
    const std::size_t n = facet_first_[f + 1] - facet_first_[f];
    if (n == 2) {
      sum += (x[node[1]] - x[node[0]]).norm();
    } else {
      Eigen::Vector3d twice(0, 0, 0);
      for (std::size_t k = 1; k + 1 < n; ++k) twice += (x[node[k]] - x[node[0]]).cross(x[node[k + 1]] - x[node[0]]);
      sum += 0.5 * twice.norm();
    }
  }
  return sum;
}

double BodyOfColumns::largest_tension() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    const double length = (vertices_.position[ends_[k][1]] - vertices_.position[ends_[k][0]]).norm();
    const Spring spring = springs_[k];
    const double tension = spring.stiffness * (length - spring.rest_length);
    if (!std::isfinite(tension)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, tension);
  }
  return largest;
}

VertexVolumes BodyOfColumns::volumes(std::vector<double>& room) const {
  if (!elements_) {
    room.resize(vertices_.size());
    find_volumes_now(cells_, vertices_.position, room);
  }
  return {vertices_.mass, material_.density, volume_, room};
}

double BodyOfColumns::largest_stress() const {
  if (counts_.cells == 0) return largest_tension();
  std::vector<Eigen::Matrix3d> stress;
  std::vector<double> room;
  vertex_stresses(ends_, springs_, volumes(room), vertices_.position, stress, system().terms);
  return largest_principal_stress(stress);
}

Frame BodyOfColumns::frame(const FrameFields& fields) const {
  Frame frame;
  frame.mesh = cells_;
  if (counts_.cells == 0) frame.links = ends_;
  for (std::uint32_t c = 0; c < cell_mass_.size(); ++c) frame.mesh_cell.push_back(mesh_cell(c));
  frame.component = component_;
  frame.component.resize(cell_mass_.size(), 0);
  frame.material = cell_material_;
  std::vector<double> room;
  fill_columns(frame, fields, vertices_, system(), fields.stress ? volumes(room) : VertexVolumes{});
  if (fields.contact) fill_contact(frame, contacts());
  return frame;
}

}  // namespace dartboard
