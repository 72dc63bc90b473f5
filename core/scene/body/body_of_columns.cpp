#include "core/scene/body/body_of_columns.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mechanics/fracture/stress.h"
#include "core/plain/bytes.h"
#include "core/plain/error.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/body/release.h"
#include "core/topology/storage/hash.h"
#include "core/views/boundary_surface.h"
#include "core/views/component_labels.h"

namespace dartboard {

BodyOfColumns::BodyOfColumns(const Problem& problem, const BodyNeeds& needs) {
  switch (needs.storage) {
    case Storage::links: link(problem, needs); break;
    case Storage::surface: take(build_body<Map2, Held::by_every_dart>(problem), problem.mesh, needs); break;
    case Storage::tetrahedra: take(build_body<TetMap, Held::by_every_dart>(problem), problem.mesh, needs); break;
    case Storage::any_cells: take(build_body<Map3, Held::by_every_dart>(problem), problem.mesh, needs); break;
  }
}

void BodyOfColumns::link(const Problem& problem, const BodyNeeds& needs) {
  const auto& points = problem.mesh.points;
  const Material& material = problem.material;
  gravity_ = problem.surroundings.gravity;
  density_ = material.density;
  counts_ = {.vertices = points.size(), .edges = points.size() - 1, .components = 1};
  vertices_.position = points;
  vertices_.mass.assign(points.size(), 0.0);
  for (std::uint32_t k = 0; k + 1 < points.size(); ++k) {
    const double length = (points[k + 1] - points[k]).norm(), mass = material.density * length;
    if (!(std::min(length, mass) > 0.0 && std::isfinite(length) && std::isfinite(mass)))
      throw InputError(
          fmt::format("link {} has a length of {} m and a mass of {} kg; expected numbers > 0", k, length, mass));
    ends_.push_back({k, k + 1});
    const double share = material.young > 0.0 ? material.young / length / material.stiffness : 1.0;
    springs_.push_back({length, share * material.stiffness, share * material.damping});
    cell_mass_.push_back(mass);
    for (const std::uint32_t end : ends_.back()) vertices_.mass[end] += mass / 2;
  }
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
    if (needs.viscosity) vertices_.viscosity.push_back(material.viscosity * vertices_.mass[p]);
    vertices_.point.push_back(p);
  }
}

template <class Map>
void BodyOfColumns::take(MassSpringBody<Map, Held::by_every_dart> body, const Mesh& mesh, const BodyNeeds& needs) {
  SpringEndsView ends;
  ends.rebuild(body);
  ComponentLabels components;
  components.rebuild(body);
  BoundarySurface boundary;
  boundary.rebuild(body);
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

  vertices_ = std::move(body.vertices);
  vertices_.dart.clear();
  vertices_.force.clear();
  if (!needs.viscosity) vertices_.viscosity.clear();
  if (!needs.fixed) vertices_.fixed.clear();
  if (needs.rest) vertices_.keep_rest();
  const auto nodes_of = [&body](auto view) {
    view.rebuild(body);
    return std::move(view.nodes);
  };
  nodes_ = nodes_of(TetrahedronNodesView());
  solid_nodes_ = nodes_of(SolidNodesView());
  shape_ = std::move(body.cell_shape);
  solid_shape_ = std::move(body.cell_solid);
  if (shape_.empty() && solid_shape_.empty()) {
    springs_ = std::move(body.springs);
    ends_ = std::move(ends.ends);
  }
  cell_mass_ = std::move(body.cell_mass);
  gravity_ = body.surroundings.gravity;
  density_ = body.material.density;
  if (!shape_.empty()) elements_ = make_tetrahedra(body.material, {nodes_, shape_, cell_mass_});
  if (!solid_shape_.empty()) elements_ = make_solids(body.material, {solid_nodes_, solid_shape_});
  terms_ = elements_.get();
  // columns that grew by doubling give back what they do not use
  for_each_column(vertices_, VertexColumns::embedded(), [](auto& column, const auto&) { column.shrink_to_fit(); });
  const auto fit = [](auto&... columns) { (columns.shrink_to_fit(), ...); };
  fit(vertices_.dart, springs_, ends_, nodes_, shape_, solid_nodes_, solid_shape_);
  fit(cells_.kinds, cells_.first, cells_.nodes, cell_mass_, component_, facet_first_, facet_node_);
}

MemoryReport BodyOfColumns::memory() const {
  return {{Part::vertices, bytes_of_vertices(vertices_) + bytes_of(vertices_.dart)},
          {Part::viscosity, bytes_of(vertices_.viscosity)},
          {Part::fixed, bytes_of(vertices_.fixed)},
          {Part::rest, bytes_of(vertices_.rest)},
          {Part::springs, springs_.bytes() - springs_.damping_bytes() + bytes_of(ends_)},
          {Part::damping, springs_.damping_bytes()},
          {Part::elements, bytes_of(nodes_, shape_, solid_nodes_, solid_shape_)},
          {Part::output_cells,
           bytes_of(cells_.kinds, cells_.first, cells_.nodes, cell_mass_, component_, facet_first_, facet_node_)}};
}

SpringSystem BodyOfColumns::system() const {
  return {.ends = ends_,
          .springs = springs_,
          .mass = vertices_.mass,
          .inverse_mass = vertices_.inverse_mass,
          .viscosity = vertices_.viscosity,
          .fixed = vertices_.fixed,
          .gravity = gravity_,
          .terms = ForceTerms(&terms_, elements_ ? 1 : 0)};
}

std::unique_ptr<ReadyEvent> BodyOfColumns::make_ready(const SceneEvent& event) {
  if (const auto* release = std::get_if<Release>(&event.action))
    return std::make_unique<ReadyRelease>(vertices_, *release, event.path + "/release");
  throw InputError(event.path + ": the body was built for a scene whose events leave the topology as it is");
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

double BodyOfColumns::largest_stress() const {
  if (counts_.cells == 0) return largest_tension();
  std::vector<Eigen::Matrix3d> stress;
  vertex_stresses(ends_, springs_, vertices_.mass, density_, vertices_.position, stress, system().terms);
  return largest_principal_stress(stress);
}

Frame BodyOfColumns::frame(const FrameFields& fields) const {
  Frame frame;
  frame.mesh = cells_;
  for (std::uint32_t c = 0; c < counts_.cells; ++c) frame.mesh_cell.push_back(c);
  frame.component = component_;
  if (counts_.cells == 0) frame.links = ends_;
  fill_columns(frame, fields, vertices_, system(), density_);
  return frame;
}

std::uint64_t BodyOfColumns::state_hash() const {
  Hash h;
  h.add(vertices_.position);
  h.add(vertices_.velocity);
  return h.value();
}

}  // namespace dartboard
