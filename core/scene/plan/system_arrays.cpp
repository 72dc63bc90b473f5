#include "core/scene/plan/system_arrays.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dartboard {
namespace {

/// By edge: what its cells contribute to its stiffness, over that of the material; the number of cells, where the
/// material has no Young's modulus.
std::vector<double> shares_of_edges(const Problem& problem, const MeshTally& tally) {
  std::vector<double> shares(tally.cells_of_edge.begin(), tally.cells_of_edge.end());
  if (problem.material.young == 0.0) return shares;
  const Mesh& mesh = problem.mesh;
  std::vector<std::pair<SpringEnds, std::size_t>> edge_of;  // by the points at its ends, ascending
  for (std::size_t e = 0; e < tally.edges; ++e) {
    const std::uint32_t a = tally.point[tally.ends[e][0]], b = tally.point[tally.ends[e][1]];
    edge_of.push_back({{std::min(a, b), std::max(a, b)}, e});
  }
  std::ranges::sort(edge_of);
  shares.assign(tally.edges, 0.0);
  const auto add = [&](std::uint32_t a, std::uint32_t b, double measure) {
    const SpringEnds ends{std::min(a, b), std::max(a, b)};
    const double square = (mesh.points[b] - mesh.points[a]).squaredNorm();
    shares[std::ranges::lower_bound(edge_of, std::pair(ends, std::size_t{0}))->second] +=
        problem.material.young * measure / square / problem.material.stiffness;
  };
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {  // simplices: any two points are an edge
    const auto nodes = mesh.cell(c);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) add(nodes[i], nodes[j], std::abs(signed_measure(mesh, c)));
  }
  if (mesh.cell_count() == 0)
    for (const auto& [ends, e] : edge_of) add(ends[0], ends[1], (mesh.points[ends[1]] - mesh.points[ends[0]]).norm());
  return shares;
}

}  // namespace

SystemArrays::SystemArrays(const Problem& problem, const MeshTally& tally)
    : ends(tally.ends), gravity(problem.surroundings.gravity) {
  const Mesh& mesh = problem.mesh;
  std::vector<double> mass_at(mesh.points.size(), 0.0);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    const double share =
        problem.material.density * std::abs(signed_measure(mesh, c)) / static_cast<double>(nodes.size());
    for (const std::uint32_t p : nodes) mass_at[p] += share;
  }
  if (mesh.cell_count() == 0)  // a chain: each link gives half its mass to each end
    for (const SpringEnds& link : ends)
      for (const std::uint32_t p : link)
        mass_at[p] += 0.5 * problem.material.density * (mesh.points[link[1]] - mesh.points[link[0]]).norm();
  std::vector<std::uint8_t> held(mesh.points.size(), 0);
  for (const std::uint32_t p : problem.fixed) held[p] = 1;
  for (const std::uint32_t p : tally.point) {
    mass.push_back(mass_at[p]);
    inverse_mass.push_back(1.0 / mass_at[p]);
    if (problem.material.viscosity != 0.0) viscosity.push_back(problem.material.viscosity * mass_at[p]);
    if (!problem.fixed.empty()) fixed.push_back(held[p]);
    x.push_back(mesh.points[p]);
    v.push_back(problem.initial_velocity.empty() || held[p] ? Eigen::Vector3d(0, 0, 0) : problem.initial_velocity[p]);
  }
  const std::vector<double> shares = shares_of_edges(problem, tally);
  for (std::size_t e = 0; e < tally.edges; ++e) {
    const double cells = shares[e];
    springs.push_back({.rest_length = (x[ends[e][1]] - x[ends[e][0]]).norm(),
                       .stiffness = cells * problem.material.stiffness,
                       .damping = cells * problem.material.damping});
  }
}

}  // namespace dartboard
