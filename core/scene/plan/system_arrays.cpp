#include "core/scene/plan/system_arrays.h"

#include <cmath>

namespace dartboard {

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
  for (std::size_t e = 0; e < tally.edges; ++e) {
    const double cells = tally.cells_of_edge[e];
    springs.push_back({.rest_length = (x[ends[e][1]] - x[ends[e][0]]).norm(),
                       .stiffness = cells * problem.material.stiffness,
                       .damping = cells * problem.material.damping});
  }
}

}  // namespace dartboard
