#include "core/mechanics/mass_spring_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "core/base/share_jobs.h"
#include "core/elements/membrane_law.h"
#include "core/mechanics/element_nodes.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells_with_places.h"
#include "core/topology/storage/hash.h"

namespace dartboard {

namespace {

void require(bool ok, const char* what, double value, const char* expected) {
  if (!ok) throw InputError(fmt::format("{} is {}, expected {}", what, value, expected));
}

void require_sane(const Material& m) {
  require(std::isfinite(m.density) && m.density > 0.0, "density", m.density, "a positive number of kg/m^3");
  require(std::isfinite(m.stiffness) && m.stiffness >= 0.0, "stiffness", m.stiffness, "at least 0 N/m");
  require(std::isfinite(m.young) && m.young >= 0.0, "young", m.young, "at least 0 Pa");
  if (m.model == Model::springs) {
    require(m.young == 0.0 || m.stiffness > 0.0, "stiffness", m.stiffness,
            "the mean of what 'young' makes of the edges");
    require(m.damping_time == 0.0, "damping time", m.damping_time, "0 s with springs");
  } else {
    require(m.young > 0.0, "young", m.young, "a positive number of Pa");
    require(m.poisson > -1.0 && m.poisson < 0.5, "poisson", m.poisson, "more than -1 and less than 0.5");
  }
  require(std::isfinite(m.damping) && m.damping >= 0.0, "damping", m.damping, "at least 0 N s/m");
  require(std::isfinite(m.damping_time) && m.damping_time >= 0.0, "damping time", m.damping_time, "at least 0 s");
  require(std::isfinite(m.viscosity) && m.viscosity >= 0.0, "viscosity", m.viscosity, "at least 0 1/s");
}

void require_a_material_for_every_cell(const Problem& problem) {
  if (problem.materials.size() > most_materials)
    throw InputError(fmt::format("{} materials, expected at most {}", problem.materials.size(), most_materials));
  const std::size_t cells = problem.materials.empty() ? 0 : problem.mesh.cell_count();
  if (problem.cell_material.size() != cells)
    throw InputError(fmt::format("{} numbers of materials for {} cells of a body of {}, expected {}",
                                 problem.cell_material.size(), problem.mesh.cell_count(),
                                 problem.materials.empty() ? "one" : "several", cells));
  for (std::size_t c = 0; c < cells; ++c)
    if (problem.cell_material[c] >= problem.materials.size())
      throw InputError(fmt::format("the material of cell {} is {}, expected less than {}", c, problem.cell_material[c],
                                   problem.materials.size()));
}

void require_sane(const Problem& problem) {
  require_a_material_for_every_cell(problem);
  const CellMaterials materials = problem.cell_materials();
  for (const Material& m : materials.all()) require_sane(m);
  for (std::size_t c = 0; materials.has_elements() && c < problem.mesh.cell_count(); ++c) {
    const Material& m = materials[c];
    const CellKind kind = problem.mesh.kinds[c];
    if (dimension(kind) != 2 || m.model == Model::springs) continue;
    if (!MembraneLaw::has(m.model))
      throw InputError(fmt::format(
          "cell {} is a {}, which the model '{}' has no element for; expected 'stvk' or 'corotational', or solid cells",
          c, name(kind), name(m.model)));
    require(m.damping_time == 0.0, "damping time", m.damping_time, "0 s in surfaces");
  }
  for (int k = 0; k < 3; ++k)
    require(std::isfinite(problem.surroundings.gravity[k]), "gravity", problem.surroundings.gravity[k], "finite");
  const std::size_t points = problem.mesh.points.size();
  for (std::size_t p = 0; p < points; ++p)
    if (!problem.mesh.points[p].allFinite()) throw InputError(fmt::format("point {} is not finite", p));
  const auto require_point = [points](std::uint32_t p) {
    if (p >= points) throw InputError(fmt::format("fixed point {} does not exist, expected less than {}", p, points));
  };
  for (const std::uint32_t p : problem.fixed) require_point(p);
  for (const HeldPoint& held : problem.held_axes) require_point(held.point);
  if (!problem.initial_velocity.empty() && problem.initial_velocity.size() != points)
    throw InputError(fmt::format("{} initial velocities for {} points", problem.initial_velocity.size(), points));
  for (const auto& v : problem.initial_velocity)
    if (!v.allFinite()) throw InputError("an initial velocity is not finite");
}

/// The material of elements, without the properties of springs, which have defaults.
Material without_springs(Material material) {
  if (material.model != Model::springs) material.stiffness = material.damping = 0.0;
  return material;
}

bool has_springs_of_young(const Material& material) { return material.model == Model::springs && material.young > 0.0; }

void require_one_vertex_per_point(const VertexColumns& vertices, std::size_t points) {
  std::vector<int> met(points, 0);
  for (const std::uint32_t p : vertices.point)
    if (++met[p] > 1)
      throw InputError(
          fmt::format("point {} is more than one vertex of the map: the cells around it are not joined by faces", p));
  for (std::size_t p = 0; p < points; ++p)
    if (met[p] == 0) throw InputError(fmt::format("point {} belongs to no cell", p));
}

/// The shapes of cells of any kind, in the order in which their corners will be found.
template <class Map>
void add_solids(MassSpringBody<Map, Held::by_every_dart>& body, const Mesh& mesh) {
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    SolidNodes nodes;
    find_nodes(body, c, nodes);
    std::vector<Eigen::Vector3d> x;
    for (std::size_t k = 0; k < nodes.count; ++k) x.push_back(body.vertices.position[nodes.at[k]]);
    const SolidShape shape = solid_shape_of(mesh.kinds[c], x);
    add_shape(body.elements, shape);
    for (std::size_t q = 0; q < gauss_points(shape.kind); ++q)
      if (!(shape.volume[q] > 0.0 && shape.inverse[q].allFinite()))
        throw InputError(
            fmt::format("cell {}, a {}, is flat or turned inside out at one of its corners", c, name(mesh.kinds[c])));
  }
}

/// The shapes of the cells of a surface, in the order in which their corners will be found.
void add_membranes(MassSpringBody<Map2, Held::by_every_dart>& body, const Mesh& mesh) {
  const bool all_triangles = std::ranges::all_of(mesh.kinds, [](CellKind kind) { return kind == CellKind::triangle; });
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    SolidNodes nodes;
    find_nodes(body, c, nodes);
    std::vector<Eigen::Vector3d> x;
    for (std::size_t k = 0; k < nodes.count; ++k) x.push_back(body.vertices.position[nodes.at[k]]);
    const MembraneShape shape = membrane_shape_of(x);
    for (std::size_t q = 0; q < membrane_points(nodes.count); ++q)
      if (const auto& [a, b, d] = shape[q]; !(std::isfinite(a + b + d) && d > 0.0))
        throw InputError(
            fmt::format("cell {}, a {}, is flat or turned over at one of its corners", c, name(mesh.kinds[c])));
    if (all_triangles)
      add_shape(body.elements, shape[0]);
    else
      add_shape(body.elements, shape);
  }
}

}  // namespace

template <class Map, Held held>
MassSpringBody<Map, held> build_body(const Problem& problem) {
  require_sane(problem);
  const Mesh& mesh = problem.mesh;
  const CellMaterials materials = problem.cell_materials();
  auto built = build_map<Map>(mesh);

  MassSpringBody<Map, held> body;
  body.material = without_springs(problem.material);
  for (const Material& material : problem.materials) body.materials.push_back(without_springs(material));
  body.cell_material = problem.cell_material;
  body.surroundings = problem.surroundings;
  body.map = std::move(built.map);
  const Map& map = body.map;
  const auto point_of = [&](Dart d) { return built.point[Map::template slot<0>(d)]; };
  const auto attach = [&map](auto& embedding, [[maybe_unused]] auto cell, [[maybe_unused]] std::span<const Dart> places,
                             std::size_t number) {
    if constexpr (held == Held::by_every_dart)
      embedding.attach_places(map, places, static_cast<std::uint32_t>(number));
    else
      embedding.attach(map, cell, static_cast<std::uint32_t>(number));
  };

  // volumes: mass, and the share of it that each of their nodes gets
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const double measure = signed_measure(mesh, c);
    body.cell_mass.push_back(materials[c].density * std::abs(measure));
    body.cell_inside_out.push_back(measure < 0.0);
    if (const double mass = body.cell_mass[c]; !(std::isfinite(mass) && mass > 0.0))
      require(false, fmt::format("the mass of cell {}", c).c_str(), mass, "more than 0 kg and finite");
    body.node_share.push_back(body.cell_mass[c] / static_cast<double>(mesh.cell(c).size()));
    body.cell_dart.push_back({built.first_dart[c]});
  }
  {
    std::size_t c = 0;  // the darts of the cells are in the order of the cells
    for_each_cell_with_places<Map::dimension>(
        map, [&](auto cell, std::span<const Dart> places) { attach(body.cell, cell, places, c++); });
  }
  if (std::ranges::any_of(materials.all(), has_springs_of_young)) {
    body.edge_share.resize(map.template slot_count<1>(), 1.0);
    map.for_each_dart([&](Dart d) {
      const std::uint32_t c = body.cell(map, d);
      const Material& material = materials[c];
      if (!has_springs_of_young(material)) return;
      const double square = (mesh.points[point_of(map.template alpha<0>(d))] - mesh.points[point_of(d)]).squaredNorm();
      body.edge_share[Map::template slot<1>(d)] =
          material.young * std::abs(signed_measure(mesh, c)) / square / material.stiffness;
    });
  }

  const auto add_vertices = [&](Mark& seen) {
    for_each_cell_with_places<0>(map, seen, [&](Vertex v, std::span<const Dart> places) {
      VertexColumns& columns = body.vertices;
      const std::uint32_t p = point_of(v.dart);
      attach(body.vertex, v, places, columns.size());
      add_element(columns, VertexColumns::embedded(), columns.size());
      body.set_mass(static_cast<std::uint32_t>(columns.size() - 1), body.mass_of(places));
      columns.position.back() = mesh.points[p];
      columns.velocity.back().setZero();
      if (!problem.initial_velocity.empty()) columns.velocity.back() = problem.initial_velocity[p];
      columns.force.back().setZero();
      columns.point.back() = p;
      columns.dart.push_back(v.dart);
    });
  };
  const auto add_springs = [&](Mark& seen) {
    for_each_cell_with_places<1>(map, seen, [&](Edge e, std::span<const Dart> places) {
      const double length =
          (mesh.points[point_of(map.template alpha<0>(e.dart))] - mesh.points[point_of(e.dart)]).norm();
      attach(body.edge, e, places, body.springs.size());
      body.springs.push_back(body.spring_of(places, length));
      body.edge_dart.push_back(e.dart);
    });
  };
  const auto add_faces = [&]([[maybe_unused]] Mark& seen) {
    if constexpr (Map::dimension == 3)
      for_each_cell_with_places<2>(map, seen, [&](Face f, std::span<const Dart> places) {
        attach(body.face, f, places, body.face_dart.size());
        body.face_dart.push_back(f.dart);
      });
  };
  {
    // operations take three marks at once: with their memory here the bytes of the body are those that it comes to
    Mark of_vertices(map), of_edges(map), of_faces(map);
    // where one dart holds an embedding, to attach it is a walk with a mark of its own
    const std::size_t shared_cells = held == Held::by_every_dart ? mesh.cell_count() : 0;
    const std::function<void()> jobs[]{[&] { add_springs(of_edges); }, [&] { add_vertices(of_vertices); },
                                       [&] { add_faces(of_faces); }};
    share_jobs(shared_cells, jobs);
  }
  const bool all_tetrahedra =
      std::ranges::all_of(mesh.kinds, [](CellKind kind) { return kind == CellKind::tetrahedron; });
  if constexpr (Map::dimension == 3 && held == Held::by_every_dart)
    if (materials.has_elements() && !all_tetrahedra) add_solids(body, mesh);
  if constexpr (Map::dimension == 2 && held == Held::by_every_dart)
    if (materials.has_elements()) add_membranes(body, mesh);
  if (materials.has_elements() && all_tetrahedra) {
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
      const auto corners = corners_from(map, body.cell_dart[c]);
      const auto place = [&](std::size_t k) { return mesh.points[point_of(corners[k])]; };
      const RestShape shape = rest_shape_of(place(0), place(1), place(2), place(3));
      add_shape(body.elements, shape);
      if (!shape.allFinite())
        throw InputError(fmt::format("cell {} is too flat: the gradients of its shape are not finite", c));
    }
  }
  body.vertices.rest = {};
  body.vertices.pull = {};
  require_one_vertex_per_point(body.vertices, mesh.points.size());
  std::vector<std::uint8_t> fixed(mesh.points.size(), 0);
  for (const std::uint32_t p : problem.fixed) fixed[p] = 1;
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    body.vertices.fixed[k] = fixed[body.vertices.point[k]];
    if (body.vertices.fixed[k]) body.vertices.velocity[k].setZero();
  }
  body.vertices.hold(problem.held_axes);

  return body;
}

namespace {

/// Add the contributions of the cells, each cell once, in the order of the cells' darts.
template <class Contribution>
double sum_over_cells(Contribution&& contribution, std::span<const Dart> darts) {
  boost::container::small_vector<std::pair<Dart, double>, 192> around;
  for (const Dart d : darts) around.push_back(contribution(d));
  std::sort(around.begin(), around.end());
  double sum = 0.0;
  for (std::size_t k = 0; k < around.size(); ++k)
    if (k == 0 || around[k].first != around[k - 1].first) sum += around[k].second;
  return sum;
}

/// The lowest dart of the cell of d. The darts of a tetrahedron follow each other, so there nothing is looked up.
template <class Map, Held held>
Dart lowest_of_cell(const MassSpringBody<Map, held>& body, Dart d) {
  if constexpr (Map::tetrahedral) return {d.index - d.index % 24};
  return body.cell_dart[body.cell(body.map, d)];
}

template <int i, class Map, int j>
auto darts_of_incident(const Map& map, Cell<j> cell) {
  boost::container::small_vector<Dart, 64> darts;
  for (const auto c : incident_cells<i>(map, cell)) darts.push_back(c.dart);
  return darts;
}

}  // namespace

template <class Map, Held held>
double MassSpringBody<Map, held>::mass_of(Vertex v) const {
  const auto darts = darts_of_incident<dimension>(map, v);
  return mass_of({darts.data(), darts.size()});
}

template <class Map, Held held>
double MassSpringBody<Map, held>::mass_of(std::span<const Dart> darts) const {
  const auto share = [this](Dart d) { return std::pair(lowest_of_cell(*this, d), node_share[cell(map, d)]); };
  return sum_over_cells(share, darts);
}

template <class Map, Held held>
double MassSpringBody<Map, held>::volume_of(Vertex v) const {
  const CellMaterials of = cell_materials();
  const auto share = [&](Dart d) {
    const std::uint32_t k = cell(map, d);
    return std::pair(lowest_of_cell(*this, d), node_share[k] / of[k].density);
  };
  const auto darts = darts_of_incident<dimension>(map, v);
  return sum_over_cells(share, {darts.data(), darts.size()});
}

template <class Map, Held held>
Spring MassSpringBody<Map, held>::spring_of(Edge e, double rest_length) const {
  const auto darts = darts_of_incident<dimension>(map, e);
  return spring_of({darts.data(), darts.size()}, rest_length);
}

template <class Map, Held held>
Spring MassSpringBody<Map, held>::spring_of(std::span<const Dart> darts, double rest_length) const {
  const auto share = [this](Dart d) {
    return std::pair(lowest_of_cell(*this, d), edge_share.empty() ? 1.0 : edge_share[Map::template slot<1>(d)]);
  };
  if (materials.empty()) {
    const double cells = sum_over_cells(share, darts);
    return {rest_length, cells * material.stiffness, cells * material.damping};
  }
  const auto sum_of = [&](double Material::*of_material) {
    return sum_over_cells(
        [&](Dart d) {
          auto [lowest, shared] = share(d);
          return std::pair(lowest, shared * (materials[cell_material[cell(map, d)]].*of_material));
        },
        darts);
  };
  return {rest_length, sum_of(&Material::stiffness), sum_of(&Material::damping)};
}

namespace {

// A state by point needs one vertex per point, which may not hold after a cut or a removal.
void require_vertex_per_point(const VertexColumns& vertices) {
  std::vector<bool> met(vertices.size(), false);
  for (const std::uint32_t p : vertices.point) {
    if (p >= met.size() || met[p])
      throw InputError("the body has changed: its vertices are no longer one for each point of the mesh");
    met[p] = true;
  }
}

}  // namespace

template <class Map, Held held>
PointState MassSpringBody<Map, held>::state() const {
  require_vertex_per_point(vertices);
  PointState s;
  s.x.resize(vertices.size());
  s.v.resize(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    s.x[vertices.point[k]] = vertices.position[k];
    s.v[vertices.point[k]] = vertices.velocity[k];
  }
  return s;
}

template <class Map, Held held>
void MassSpringBody<Map, held>::set_state(const PointState& s) {
  require_vertex_per_point(vertices);
  if (s.x.size() != vertices.size() || s.v.size() != vertices.size())
    throw InputError(fmt::format("a state of {} positions and {} velocities for {} vertices", s.x.size(), s.v.size(),
                                 vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    vertices.position[k] = s.x[vertices.point[k]];
    vertices.velocity[k] = vertices.fixed[k] ? Eigen::Vector3d(0, 0, 0) : s.v[vertices.point[k]];
    if (!vertices.held_axes.empty()) vertices.velocity[k] = free_part(vertices.held_axes[k], vertices.velocity[k]);
  }
}

template <class Map, Held held>
std::uint64_t MassSpringBody<Map, held>::state_hash() const {
  Hash h;
  h.add(vertices.position);
  h.add(vertices.velocity);
  return h.value();
}

DARTBOARD_BODIES()

}  // namespace dartboard
