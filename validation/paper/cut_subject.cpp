#include "validation/paper/cut_subject.h"

#include <algorithm>

#include "validation/conservation/conserved_sums.h"

namespace dartboard {

CutSubject::CutSubject(const Problem& problem) : Subject<Map3>(problem) {
  const Mesh& mesh = problem.mesh;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const reference::Rational nodes = mesh.cell(c).size();
    share.push_back(abs(reference::exact_volume(mesh, c)) * reference::Rational(problem.material.density) / nodes);
    rounding.push_back(reference::measure_rounding(mesh, c) * problem.material.density /
                       static_cast<double>(mesh.cell(c).size()));
  }
}

CutSubject::Mass CutSubject::mass_of(std::span<const std::uint32_t> corners) const {
  reference::Rational sum;
  double bound = 0.0;
  for (const std::uint32_t k : corners) {
    const std::uint32_t c = cells.cell_of_corner(k);
    sum += share[c];
    bound += rounding[c];
  }
  const double exact = reference::rounded(sum);
  // two products, the sum of the shares, and the witness's own rounding
  return {exact, 1.001 * (bound + gamma(corners.size() + 2) * exact)};
}

std::vector<std::uint32_t> CutSubject::corners_of(std::uint32_t side) const {
  const std::uint32_t c = cell_of_side(side);
  std::vector<std::uint32_t> corners;
  for (const int k : sides_of(start->mesh.kinds[c])[side - cells.first_side(c)])
    corners.push_back(start->mesh.first[c] + static_cast<std::uint32_t>(k));
  return corners;
}

std::vector<std::uint32_t> CutSubject::edges_of(std::uint32_t side) const {
  const std::uint32_t c = cell_of_side(side);
  const auto corners = corners_of(side);
  const auto has = [&](std::uint32_t k) { return std::ranges::find(corners, k) != corners.end(); };
  std::vector<std::uint32_t> edges;  // of a cell between two corners of a side: its diagonals are no edges
  for (std::uint32_t e = cells.first_edge(c); e < cells.first_edge(c + 1); ++e)
    if (has(cells.ends(e).a) && has(cells.ends(e).b)) edges.push_back(e);
  return edges;
}

void CutSubject::deform() {
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    Eigen::Vector3d& x = body.vertices.position[k];
    x = {1.5 * x[0] + 0.2 * x[2], 0.9 * x[1], x[2] + 0.3 * x[0]};
    body.vertices.velocity[k] = {x[1], -x[0], 0.5 * x[2]};
  }
}

}  // namespace dartboard
