#include "core/mechanics/fracture/stress.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>
#include <limits>

#include "core/elements/cell_springs.h"
#include "core/elements/membranes.h"
#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/mechanics/element_nodes.h"
#include "core/mechanics/fracture/cell_size.h"
#include "core/plain/error.h"
#include "core/topology/cells.h"

namespace dartboard {
namespace {

// The iterative solver: the closed form loses half the digits where two eigenvalues are close.
using EigenSolver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
constexpr const char* unsolved = "the eigenvalues of a stress were not found";

// The lower triangle suffices until the sum is complete; the growth of the volume is summed in the upper corner.
void add_lower(Eigen::Matrix3d& sum, const Eigen::Matrix3d& term) {
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i) sum(i, j) += term(i, j);
}
void add_lower(Eigen::Matrix3d& sum, const Virial& virial) {
  add_lower(sum, virial.tensor);
  sum(0, 2) += virial.growth;
}

using CellNumbers = boost::container::small_vector<std::uint32_t, 64>;

/// The cells around vertex k in the order of their numbers, as the passes over all cells have them.
template <class Map>
CellNumbers cells_around(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k) {
  CellNumbers cells;
  for (const auto c : incident_cells<Map::dimension>(body.map, Vertex{body.vertices.dart[k]}))
    cells.push_back(body.cell(body.map, c.dart));
  std::sort(cells.begin(), cells.end());
  return cells;
}

template <class Map>
void add_cell_springs(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k, Eigen::Matrix3d& sum) {
  for (const std::uint32_t c : cells_around(body, k)) {
    if (diagonals_of(body.cell_springs[c].kind, body.cell_springs[c].which).empty()) continue;
    SolidNodes nodes;
    find_nodes(body, c, nodes);
    boost::container::small_vector<Eigen::Vector3d, 8> x;
    for (std::size_t a = 0; a < nodes.count; ++a) x.push_back(body.vertices.position[nodes.at[a]]);
    add_lower(sum, cell_springs_virial(body.cell_springs[c], {x.data(), x.size()}));
  }
}

void add_membranes(const MassSpringBody<Map2, Held::by_every_dart>& body, std::uint32_t k, Eigen::Matrix3d& sum) {
  for (const std::uint32_t c : cells_around(body, k)) {
    SolidNodes nodes;
    find_nodes(body, c, nodes);
    boost::container::small_vector<Eigen::Vector3d, 4> x;
    for (std::size_t a = 0; a < nodes.count; ++a) x.push_back(body.vertices.position[nodes.at[a]]);
    const PlaneInverse* const shape = is_of<PlaneInverse>(body.elements)
                                          ? &shapes_of<PlaneInverse>(body.elements)[c]
                                          : shapes_of<MembraneShape>(body.elements)[c].data();
    add_lower(sum,
              membrane_virial(body.cell_materials()[c], {shape, membrane_points(nodes.count)}, {x.data(), x.size()}));
  }
}

template <class Map>
void add_elements(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k, Eigen::Matrix3d& sum) {
  for (const std::uint32_t c : cells_around(body, k)) {
    const auto& position = body.vertices.position;
    if (is_of<RestShape>(body.elements)) {
      TetrahedronNodes nodes;
      find_nodes(body, c, nodes);
      add_lower(sum,
                tetrahedron_virial(body.cell_materials()[c], body.cell_mass[c], shapes_of<RestShape>(body.elements)[c],
                                   {position[nodes[0]], position[nodes[1]], position[nodes[2]], position[nodes[3]]}));
    } else {
      SolidNodes nodes;
      find_nodes(body, c, nodes);
      boost::container::small_vector<Eigen::Vector3d, 8> x;
      for (std::size_t a = 0; a < nodes.count; ++a) x.push_back(position[nodes.at[a]]);
      add_lower(sum,
                solid_virial(body.cell_materials()[c], shapes_of<SolidShape>(body.elements)[c], {x.data(), x.size()}));
    }
  }
}

void finish(Eigen::Matrix3d& sum, double now, double at_rest) {
  const double least = least_volume * at_rest;
  const double volume = now > least ? now : least;
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i) sum(j, i) = sum(i, j) = sum(i, j) / volume;
}

/// The share of its size that a cell gives to each of its vertices.
template <class Corners>
double share_of_size(CellKind kind, const Corners& corners, std::span<const Eigen::Vector3d> position) {
  boost::container::static_vector<Eigen::Vector3d, 8> x;
  for (const std::uint32_t k : corners) x.push_back(position[k]);
  return cell_size(kind, {x.data(), x.size()}) / static_cast<double>(x.size());
}

template <class Corners>
void add_cell(CellKind kind, const Corners& corners, std::span<const Eigen::Vector3d> position, std::span<double> now) {
  const double share = share_of_size(kind, corners, position);
  for (const std::uint32_t k : corners) now[k] += share;
}

template <class Map>
bool is_of_springs(const MassSpringBody<Map, Held::by_every_dart>& body) {
  return !body.cell_materials().has_elements();
}

/// f(kind, corners) of a cell.
template <class Map, class F>
void with_corners(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t c, F&& f) {
  if constexpr (Map::tetrahedral) {
    TetrahedronNodes nodes;
    find_nodes(body, c, nodes);
    f(CellKind::tetrahedron, nodes);
  } else {
    SolidNodes nodes;
    find_nodes(body, c, nodes);
    f(kind_of_corners(Map::dimension, nodes.count), std::span(nodes.at).first(nodes.count));
  }
}

}  // namespace

template <class Map>
VertexVolumes vertex_volumes(const MassSpringBody<Map, Held::by_every_dart>& body, const CornerRows& corners,
                             VolumeRoom& room) {
  const auto& position = body.vertices.position;
  VertexVolumes volumes{body.vertices.mass, body.material.density};
  if (!body.materials.empty()) {
    room.at_rest.clear();
    for (const Dart d : body.vertices.dart) room.at_rest.push_back(body.volume_of(Vertex{d}));
    volumes.rest_of_vertex = room.at_rest;
  }
  if (!is_of_springs(body)) return volumes;
  room.now.assign(position.size(), 0.0);
  if (!corners.tetrahedra.empty())
    for (const TetrahedronNodes& nodes : corners.tetrahedra) add_cell(CellKind::tetrahedron, nodes, position, room.now);
  else if (!corners.solids.empty())
    for (const SolidNodes& nodes : corners.solids)
      add_cell(kind_of_corners(Map::dimension, nodes.count), std::span(nodes.at).first(nodes.count), position,
               room.now);
  else
    for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c)
      with_corners(body, c, [&](CellKind kind, const auto& nodes) { add_cell(kind, nodes, position, room.now); });
  volumes.now = room.now;
  return volumes;
}

void find_volumes_now(const Mesh& cells, std::span<const Eigen::Vector3d> position, std::span<double> now) {
  std::ranges::fill(now, 0.0);
  for (std::size_t c = 0; c < cells.cell_count(); ++c) add_cell(cells.kinds[c], cells.cell(c), position, now);
}

template <class Map>
Eigen::Matrix3d vertex_stress(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k) {
  const VertexColumns& v = body.vertices;
  struct Incident {
    std::uint32_t edge, other_end;
  };
  boost::container::small_vector<Incident, 64> around;
  for (const Edge e : incident_cells<1>(body.map, Vertex{v.dart[k]}))
    around.push_back({body.edge(body.map, e.dart), body.vertex(body.map, body.map.template alpha<0>(e.dart))});
  std::sort(around.begin(), around.end(), [](const Incident& a, const Incident& b) { return a.edge < b.edge; });
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& [edge, other_end] : around)
    add_lower(sum, spring_virial(body.springs[edge], v.position[other_end] - v.position[k]));
  if (has_elements(body.elements)) {
    if constexpr (Map::dimension == 3)
      add_elements(body, k, sum);
    else
      add_membranes(body, k, sum);
  }
  if (!body.cell_springs.empty()) add_cell_springs(body, k, sum);
  const double at_rest = body.materials.empty() ? v.mass[k] / body.material.density : body.volume_of(Vertex{v.dart[k]});
  double now = at_rest + sum(0, 2);
  if (is_of_springs(body)) {
    now = 0.0;
    for (const std::uint32_t c : cells_around(body, k))
      with_corners(body, c, [&](CellKind kind, const auto& nodes) { now += share_of_size(kind, nodes, v.position); });
  }
  finish(sum, now, at_rest);
  return sum;
}

void vertex_stresses(std::span<const std::array<std::uint32_t, 2>> ends, SpringSpan springs,
                     const VertexVolumes& volumes, std::span<const Eigen::Vector3d> position,
                     std::vector<Eigen::Matrix3d>& stress, ForceTerms terms) {
  stress.assign(volumes.mass.size(), Eigen::Matrix3d::Zero());
  for (std::size_t e = 0; e < springs.size(); ++e) {
    const auto [a, b] = ends[e];
    const Eigen::Vector3d dx = position[b] - position[a], pull = half_pull(springs[e], dx);
    for (const std::uint32_t end : {a, b}) {  // spring_virial, of which no matrix is made
      stress[end].col(0) += dx[0] * pull;
      stress[end].col(1).tail<2>() += dx[1] * pull.tail<2>();
      stress[end](2, 2) += dx[2] * pull[2];
    }
  }
  for (const ForceTerm* term : terms)
    for (std::size_t piece = 0; piece < term->size(); ++piece) {
      const Virial virial = term->virial(position, piece);
      for (const std::uint32_t i : term->nodes(piece)) add_lower(stress[i], virial);
    }
  for (std::size_t k = 0; k < stress.size(); ++k) {
    const double at_rest = volumes.at_rest(k);
    finish(stress[k], volumes.now.empty() ? at_rest + stress[k](0, 2) : volumes.now[k], at_rest);
  }
}

StressError::StressError(std::uint32_t which)
    : SolverError(fmt::format("the stress of vertex {} is not finite", which)), vertex(which) {}

PrincipalStress principal_stress(const Eigen::Matrix3d& stress) {
  if (!stress.allFinite()) throw SolverError("the principal directions of a stress that is not finite");
  const EigenSolver solver(stress);
  if (solver.info() != Eigen::Success) throw SolverError(unsolved);
  Eigen::Vector3d direction = solver.eigenvectors().col(2).normalized();
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction[largest] < 0.0) direction = -direction;
  return {solver.eigenvalues()[2], direction};
}

StressMeasures measures_of(const Eigen::Matrix3d& stress) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!stress.allFinite()) return {infinity, infinity, infinity};
  const EigenSolver solver(stress, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) return {infinity, infinity, infinity};
  const Eigen::Vector3d& s = solver.eigenvalues();  // ascending
  const double magnitude = std::max(-s[0], s[2]);
  if (magnitude == 0.0) return {0.0, 0.0, 0.0};
  const Eigen::Vector3d part = s / magnitude;  // squares neither overflow nor vanish
  const double differences = (part[2] - part[1]) * (part[2] - part[1]) + (part[1] - part[0]) * (part[1] - part[0]) +
                             (part[2] - part[0]) * (part[2] - part[0]);
  return {s[2], magnitude, magnitude * std::sqrt(differences / 2.0)};
}

double principal_bound(const Eigen::Matrix3d& stress) {
  double bound = stress(0, 0), norm = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double off_diagonal = std::abs(stress(i, (i + 1) % 3)) + std::abs(stress(i, (i + 2) % 3));
    bound = std::max(bound, stress(i, i) + off_diagonal);
    norm = std::max(norm, std::abs(stress(i, i)) + off_diagonal);
  }
  // the maxima ignore NaN, a sum keeps it
  return bound + 0x1p-40 * norm + 0.0 * stress.sum();
}

double largest_principal_stress(std::span<const Eigen::Matrix3d> stresses) {
  double largest = stresses.empty() ? 0.0 : -std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& sigma : stresses) {
    // Eigenvalues are needed of the few vertices only that can have the largest.
    if (principal_bound(sigma) <= largest) continue;
    largest = std::max(largest, measures_of(sigma).largest_principal);
  }
  return largest;
}

DARTBOARD_STRESS(, Map2)
DARTBOARD_STRESS(, Map3)
DARTBOARD_STRESS(, TetMap)

}  // namespace dartboard
