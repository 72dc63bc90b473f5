#include "reference/cgal/cgal_body.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Linear_cell_complex_for_generalized_map.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/centroid.h>
#include <CGAL/version.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "core/plain/error.h"
#include "reference/adjacency_graph.h"
#include "reference/cell_shape.h"

namespace dartboard::reference {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Vector = Kernel::Vector_3;
using Point = Kernel::Point_3;

// The data of a vertex in addition to its point, which is the position at the stage of the step.
struct VertexInfo {
  Point x0 = CGAL::ORIGIN;                                // at the start of the step
  Vector v0 = CGAL::NULL_VECTOR, v = CGAL::NULL_VECTOR;   // at the start of the step, at the stage
  Vector force = CGAL::NULL_VECTOR;                       // of the springs
  Vector dx = CGAL::NULL_VECTOR, dv = CGAL::NULL_VECTOR;  // the sums of the step
  double mass = 0.0, viscosity = 0.0;                     // kg, kg/s
  bool fixed = false;
  bool operator==(const VertexInfo&) const = default;
};

struct EdgeInfo {
  double stiffness = 0.0, damping = 0.0, rest_length = 0.0;
  bool operator==(const EdgeInfo&) const = default;
};

struct Items {
  template <class Map>
  struct Dart_wrapper {
    using Vertex = CGAL::Cell_attribute_with_point<Map, VertexInfo>;
    using Edge = CGAL::Cell_attribute<Map, EdgeInfo>;
    using Attributes = std::tuple<Vertex, Edge>;
  };
};

using Map = CGAL::Linear_cell_complex_for_generalized_map<3, 3, CGAL::Linear_cell_complex_traits<3, Kernel>, Items>;
using Dart = Map::Dart_handle;

// A dart, and the names of its cells by numbers of the mesh.
struct NamedDart {
  Dart dart;
  std::uint32_t from, to;             // its vertex, and the other end of its edge
  std::array<std::uint32_t, 4> face;  // the points of its face, ascending
  std::uint32_t cell;
};

// i-link the darts that have equal names.
template <unsigned int i, class Name>
void link_equal(Map& map, std::vector<NamedDart>& darts, Name name) {
  const auto before = [&](const NamedDart& a, const NamedDart& b) { return name(a) < name(b); };
  std::sort(darts.begin(), darts.end(), before);
  for (std::size_t first = 0, last = 0; first < darts.size(); first = last) {
    while (last < darts.size() && name(darts[last]) == name(darts[first])) ++last;
    if (last - first > 2)
      throw InputError(fmt::format("{} darts from point {} to {} would be {}-linked; a map has room for two",
                                   last - first, darts[first].from, darts[first].to, i));
    if (last - first == 2) map.basic_link_alpha<i>(darts[first].dart, darts[first + 1].dart);
  }
}

// Two darts per edge of every face of every cell, linked by the numbers of the mesh and never by coordinates.
std::vector<NamedDart> build_darts(Map& map, const Mesh& mesh) {
  std::vector<NamedDart> darts;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& cycle : own_faces(mesh.kinds[c])) {
      const std::size_t n = cycle.size(), base = darts.size();
      const auto point = [&](std::size_t k) { return mesh.cell(c)[static_cast<std::size_t>(cycle[k % n])]; };

      std::array<std::uint32_t, 4> face;
      face.fill(UINT32_MAX);
      for (std::size_t k = 0; k < n; ++k) face[k] = point(k);
      std::sort(face.begin(), face.end());

      for (std::size_t k = 0; k < n; ++k) {
        darts.push_back({map.create_dart(), point(k), point(k + 1), face, static_cast<std::uint32_t>(c)});
        darts.push_back({map.create_dart(), point(k + 1), point(k), face, static_cast<std::uint32_t>(c)});
        map.basic_link_alpha<0>(darts[base + 2 * k].dart, darts[base + 2 * k + 1].dart);
      }
      for (std::size_t k = 0; k < n; ++k)
        map.basic_link_alpha<1>(darts[base + 2 * k + 1].dart, darts[base + 2 * ((k + 1) % n)].dart);
    }

  if (mesh.dimension() == 3) {
    link_equal<2>(map, darts, [](const NamedDart& d) { return std::tuple(d.cell, d.from, d.to); });
    link_equal<3>(map, darts, [](const NamedDart& d) { return std::tuple(d.face, d.from, d.to); });
  } else {
    link_equal<2>(map, darts, [](const NamedDart& d) { return std::tuple(d.from, d.to); });
  }
  return darts;
}

// Masses of points, eq. (1), by the kernel's exact numbers.
using Number = CGAL::Exact_rational;
using ExactKernel = CGAL::Simple_cartesian<Number>;
using ExactPoint = ExactKernel::Point_3;
using ExactVector = ExactKernel::Vector_3;

// The cones over the faces of a cell, seen from the centroid of its corners, which is inside. A quadrilateral that is
// not plane is the mean of its two splits along a diagonal.
Number measure(const std::vector<ExactPoint>& x, CellKind kind) {
  if (dimension(kind) == 2) {
    ExactVector twice = CGAL::NULL_VECTOR;
    for (std::size_t k = 2; k < x.size(); ++k) twice += CGAL::cross_product(x[k - 1] - x[0], x[k] - x[0]);
    return Number(std::sqrt(CGAL::to_double(twice.squared_length())) / 2.0);
  }
  const ExactPoint centre = CGAL::centroid(x.begin(), x.end(), CGAL::Dimension_tag<0>());
  Number sum = 0;
  for (const auto& face : own_faces(kind)) {
    const auto corner = [&](std::size_t k) { return x[static_cast<std::size_t>(face[k])]; };
    const auto cone = [&](std::size_t a, std::size_t b, std::size_t c) {
      return CGAL::volume(corner(a), corner(b), corner(c), centre);
    };
    if (face.size() == 3)
      sum += CGAL::abs(cone(0, 1, 2));
    else
      sum += CGAL::abs(cone(0, 1, 2) + cone(0, 2, 3) + cone(0, 1, 3) + cone(1, 2, 3)) / 2;
  }
  return sum;
}

std::vector<double> masses_of_points(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  std::vector<Number> sums(mesh.points.size(), Number(0));
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    std::vector<ExactPoint> x;
    for (const std::uint32_t p : cell)
      x.emplace_back(Number(mesh.points[p][0]), Number(mesh.points[p][1]), Number(mesh.points[p][2]));
    const Number share =
        measure(x, mesh.kinds[c]) * Number(problem.material.density) / Number(static_cast<int>(cell.size()));
    for (const std::uint32_t p : cell) sums[p] += share;
  }
  std::vector<double> masses;
  for (const Number& sum : sums) masses.push_back(CGAL::to_double(sum));
  return masses;
}

template <class Range>
std::size_t length(Range&& range) {
  std::size_t n = 0;
  for (auto it = range.begin(), end = range.end(); it != end; ++it) ++n;
  return n;
}

Point to_point(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }
Vector to_vector(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }
template <class T>
Eigen::Vector3d to_eigen(const T& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

struct CgalBody::Complex {
  Map map;
  std::vector<Map::Vertex_attribute_handle> vertex_of_point;
  CgalWalk walk;
  double h;
  Vector gravity;

  Complex(const Problem& problem, CgalWalk how)
      : walk(how), h(problem.h), gravity(to_vector(problem.surroundings.gravity)) {
    if (problem.material.young > 0.0)
      throw InputError("a body on CGAL's map supports only one stiffness for all cells; expected no Young's modulus");
    const AdjacencyGraph graph(problem);  // refuses malformed problems
    const std::vector<NamedDart> darts = build_darts(map, problem.mesh);
    add_vertices(problem, darts, masses_of_points(problem));
    add_edges(problem, darts);
    if (!map.is_valid()) throw InputError("CGAL finds the map of this mesh invalid");
    set_state(graph.state());
  }

  void add_vertices(const Problem& problem, const std::vector<NamedDart>& darts, std::span<const double> masses) {
    vertex_of_point.assign(problem.mesh.points.size(), nullptr);
    for (const NamedDart& d : darts) {
      if (map.attribute<0>(d.dart) != nullptr) continue;
      if (vertex_of_point[d.from] != nullptr)
        throw InputError(fmt::format("point {} is pinched: it lies on two vertices of the map", d.from));
      VertexInfo info;
      info.mass = masses[d.from];
      info.viscosity = problem.material.viscosity * info.mass;
      info.fixed = std::binary_search(problem.fixed.begin(), problem.fixed.end(), d.from);
      vertex_of_point[d.from] = map.create_vertex_attribute(to_point(problem.mesh.points[d.from]), info);
      map.set_vertex_attribute(d.dart, vertex_of_point[d.from]);
    }
    for (std::size_t i = 0; i < vertex_of_point.size(); ++i)
      if (vertex_of_point[i] == nullptr) throw InputError(fmt::format("point {} belongs to no cell", i));
  }

  void add_edges(const Problem& problem, const std::vector<NamedDart>& darts) {
    const bool solid = problem.mesh.dimension() == 3;
    for (const NamedDart& d : darts) {
      if (map.attribute<1>(d.dart) != nullptr) continue;
      const auto cells = static_cast<double>(solid ? length(map.one_dart_per_incident_cell<3, 1>(d.dart))
                                                   : length(map.one_dart_per_incident_cell<2, 1>(d.dart)));
      const double rest = std::sqrt((map.point(map.alpha<0>(d.dart)) - map.point(d.dart)).squared_length());
      map.set_attribute<1>(d.dart, map.create_attribute<1>(EdgeInfo{problem.material.stiffness * cells,
                                                                    problem.material.damping * cells, rest}));
    }
  }

  // visit(point, info) for every vertex
  template <class Visit>
  void for_each_vertex(Visit visit) {
    if (walk == CgalWalk::coverage) {
      auto range = map.one_dart_per_cell<0>();
      for (auto it = range.begin(), end = range.end(); it != end; ++it) {
        const auto vertex = map.vertex_attribute(it);
        visit(vertex->point(), vertex->info());
      }
    } else {
      auto& range = map.attributes<0>();
      for (auto it = range.begin(), end = range.end(); it != end; ++it) visit(it->point(), it->info());
    }
  }

  // visit(spring, vertex, vertex) for every edge
  template <class Visit>
  void for_each_edge(Visit visit) {
    if (walk == CgalWalk::coverage) {
      auto range = map.one_dart_per_cell<1>();
      for (auto it = range.begin(), end = range.end(); it != end; ++it)
        visit(map.attribute<1>(it)->info(), *map.vertex_attribute(it), *map.vertex_attribute(map.alpha<0>(it)));
    } else {
      auto& range = map.attributes<1>();
      for (auto it = range.begin(), end = range.end(); it != end; ++it) {
        const Dart d = it->dart();
        visit(it->info(), *map.vertex_attribute(d), *map.vertex_attribute(map.alpha<0>(d)));
      }
    }
  }

  void pull_springs() {
    for_each_edge([](const EdgeInfo& spring, Map::Vertex_attribute& a, Map::Vertex_attribute& b) {
      const Vector d = b.point() - a.point();
      const double l = std::sqrt(d.squared_length());
      if (l == 0.0) return;
      const double inverse = 1.0 / l;
      const double rate = (b.info().v - a.info().v) * d * inverse;
      const Vector f = ((spring.stiffness * (l - spring.rest_length) + spring.damping * rate) * inverse) * d;
      a.info().force += f;
      b.info().force -= f;
    });
  }

  Vector acceleration(const VertexInfo& i) const { return (i.force - i.viscosity * i.v) / i.mass + gravity; }

  // Add a stage to the step with its weight, go `next` seconds from the start along it, and reset the forces.
  void advance(double weight, double next) {
    pull_springs();
    for_each_vertex([&](Point& x, VertexInfo& i) {
      if (!i.fixed) {
        const Vector a = acceleration(i);
        i.dx += weight * i.v;
        i.dv += weight * a;
        x = i.x0 + next * i.v;
        i.v = i.v0 + next * a;
      }
      i.force = CGAL::NULL_VECTOR;
    });
  }

  void finish(double weight) {
    pull_springs();
    for_each_vertex([&](Point& x, VertexInfo& i) {
      if (!i.fixed) {
        i.x0 = x = i.x0 + (i.dx + weight * i.v);
        i.v0 = i.v = i.v0 + (i.dv + weight * acceleration(i));
      }
      i.force = i.dx = i.dv = CGAL::NULL_VECTOR;
    });
  }

  void step() {
    advance(h / 6.0, h / 2.0);
    advance(h / 3.0, h / 2.0);
    advance(h / 3.0, h);
    finish(h / 6.0);
  }

  void set_state(const PointState& state) {
    const std::size_t n = vertex_of_point.size();
    if (state.x.size() != n || state.v.size() != n)
      throw InputError(
          fmt::format("a state of {} positions and {} velocities for {} points", state.x.size(), state.v.size(), n));
    for (std::size_t i = 0; i < n; ++i) {
      VertexInfo& info = vertex_of_point[i]->info();
      vertex_of_point[i]->point() = info.x0 = to_point(state.x[i]);
      info.v0 = info.v = info.fixed ? Vector(CGAL::NULL_VECTOR) : to_vector(state.v[i]);
    }
  }

  std::vector<Eigen::Vector3d> forces() {
    pull_springs();
    std::vector<Eigen::Vector3d> f;
    for (const auto& vertex : vertex_of_point) {
      VertexInfo& i = vertex->info();
      f.push_back(to_eigen(Vector(i.force - i.viscosity * i.v)));
      i.force = CGAL::NULL_VECTOR;
    }
    return f;
  }
};

CgalBody::CgalBody(const Problem& problem, CgalWalk walk) : complex_(std::make_unique<Complex>(problem, walk)) {}
CgalBody::~CgalBody() = default;
CgalBody::CgalBody(CgalBody&&) noexcept = default;
CgalBody& CgalBody::operator=(CgalBody&&) noexcept = default;

void CgalBody::step(int n) {
  for (; n > 0; --n) complex_->step();
}

PointState CgalBody::state() const {
  PointState out;
  for (const auto& vertex : complex_->vertex_of_point) {
    out.x.push_back(to_eigen(vertex->point()));
    out.v.push_back(to_eigen(vertex->info().v));
  }
  return out;
}

void CgalBody::set_state(const PointState& state) { complex_->set_state(state); }
std::vector<Eigen::Vector3d> CgalBody::spring_and_drag_forces() const { return complex_->forces(); }

CgalCounts CgalBody::counts() const {
  const auto n = complex_->map.count_cells({0, 1, 2, 3, 4});
  return {complex_->map.number_of_darts(), n[0], n[1], n[2], n[3], n[4]};
}

bool CgalBody::is_valid() const { return complex_->map.is_valid(); }

std::string cgal_version() { return CGAL_VERSION_STR; }

}  // namespace dartboard::reference
