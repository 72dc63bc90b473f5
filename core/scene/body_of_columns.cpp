#include "core/scene/body_of_columns.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mechanics/stress.h"
#include "core/plain/error.h"
#include "core/topology/hash.h"
#include "core/views/boundary_surface.h"
#include "core/views/component_labels.h"

namespace dartboard {

BodyOfColumns::BodyOfColumns(const Problem& problem) {
  const auto& kinds = problem.mesh.kinds;
  if (problem.mesh.dimension() == 2)
    take(build_body<Map2, Held::by_every_dart>(problem), problem.mesh);
  else if (std::all_of(kinds.begin(), kinds.end(), [](CellKind kind) { return kind == CellKind::tetrahedron; }))
    take(build_body<TetMap, Held::by_every_dart>(problem), problem.mesh);
  else
    take(build_body<Map3, Held::by_every_dart>(problem), problem.mesh);
}

BodyOfColumns::BodyOfColumns(const Problem& problem, std::span<const SpringEnds> links)
    : ends_(links.begin(), links.end()),
      gravity_(problem.surroundings.gravity),
      density_(problem.material.density),
      counts_{.vertices = problem.mesh.points.size(), .edges = links.size(), .components = 1} {
  const auto& points = problem.mesh.points;
  const Material& material = problem.material;
  vertices_.position = points;
  vertices_.mass.assign(points.size(), 0.0);
  for (std::size_t k = 0; k < links.size(); ++k) {
    const double length = (points[links[k][1]] - points[links[k][0]]).norm(), mass = material.density * length;
    if (!(std::min(length, mass) > 0.0 && std::isfinite(length) && std::isfinite(mass)))
      throw InputError(
          fmt::format("link {} has a length of {} m and a mass of {} kg; expected numbers > 0", k, length, mass));
    springs_.push_back({length, material.stiffness, material.damping});
    cell_mass_.push_back(mass);
    for (const std::uint32_t end : links[k]) vertices_.mass[end] += mass / 2;
  }
  vertices_.velocity = problem.initial_velocity;
  vertices_.velocity.resize(points.size(), Eigen::Vector3d(0, 0, 0));
  vertices_.force.assign(points.size(), Eigen::Vector3d(0, 0, 0));
  vertices_.fixed.assign(points.size(), 0);
  for (const std::uint32_t p : problem.fixed) {
    vertices_.fixed[p] = 1;
    vertices_.velocity[p].setZero();
  }
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (!vertices_.velocity[p].allFinite())
      throw InputError(fmt::format("the initial velocity of point {} is not finite", p));
    vertices_.inverse_mass.push_back(1.0 / vertices_.mass[p]);
    vertices_.viscosity.push_back(material.viscosity * vertices_.mass[p]);
    vertices_.point.push_back(p);
  }
}

template <class Map>
void BodyOfColumns::take(MassSpringBody<Map, Held::by_every_dart> body, const Mesh& mesh) {
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
  vertices_.dart = std::vector<Dart>();
  springs_ = std::move(body.springs);
  ends_ = std::move(ends.ends);
  cell_mass_ = std::move(body.cell_mass);
  gravity_ = body.surroundings.gravity;
  density_ = body.material.density;
}

SpringSystem BodyOfColumns::system() const {
  return {.ends = ends_,
          .springs = springs_,
          .mass = vertices_.mass,
          .inverse_mass = vertices_.inverse_mass,
          .viscosity = vertices_.viscosity,
          .fixed = vertices_.fixed,
          .gravity = gravity_};
}

std::unique_ptr<ReadyEvent> BodyOfColumns::make_ready(const SceneEvent& event) {
  throw InputError(event.path + ": the body was built for a scene without events");
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
    const double tension = springs_[k].stiffness * (length - springs_[k].rest_length);
    if (!std::isfinite(tension)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, tension);
  }
  return largest;
}

double BodyOfColumns::largest_stress() const {
  if (counts_.cells == 0) return largest_tension();
  std::vector<Eigen::Matrix3d> stress;
  vertex_stresses(ends_, springs_, vertices_.mass, density_, vertices_.position, stress);
  return largest_principal_stress(stress);
}

Frame BodyOfColumns::frame() const {
  Frame frame;
  frame.mesh = cells_;
  frame.mesh.points = vertices_.position;
  frame.velocity = vertices_.velocity;
  frame.mass = vertices_.mass;
  for (std::uint32_t c = 0; c < counts_.cells; ++c) frame.mesh_cell.push_back(c);
  frame.component = component_;
  if (counts_.cells == 0) frame.links = ends_;
  return frame;
}

std::uint64_t BodyOfColumns::state_hash() const {
  Hash h;
  h.add(vertices_.position);
  h.add(vertices_.velocity);
  return h.value();
}

}  // namespace dartboard
