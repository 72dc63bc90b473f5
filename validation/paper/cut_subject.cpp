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
  const auto follow = [&](std::uint32_t a, std::uint32_t b) {
    const auto at = std::ranges::find(corners, a) - corners.begin(),
               to = std::ranges::find(corners, b) - corners.begin();
    const auto n = static_cast<std::ptrdiff_t>(corners.size());
    return (at + 1) % n == to || (to + 1) % n == at;
  };
  std::vector<std::uint32_t> edges;
  for (std::uint32_t e = cells.first_edge(c); e < cells.first_edge(c + 1); ++e) {
    const auto [a, b] = cells.ends(e);
    if (has(a) && has(b) && follow(a, b)) edges.push_back(e);
  }
  return edges;
}

std::uint32_t CutSubject::same_corner(std::uint32_t corner, std::uint32_t cell) const {
  std::uint32_t k = start->mesh.first[cell];
  while (start->mesh.nodes[k] != start->mesh.nodes[corner]) ++k;
  return k;
}

std::uint32_t CutSubject::same_edge(std::uint32_t edge, std::uint32_t cell) const {
  const std::uint32_t a = same_corner(cells.ends(edge).a, cell), b = same_corner(cells.ends(edge).b, cell);
  std::uint32_t e = cells.first_edge(cell);
  while (!(cells.ends(e).a == a && cells.ends(e).b == b) && !(cells.ends(e).a == b && cells.ends(e).b == a)) ++e;
  return e;
}

std::optional<std::uint32_t> CutSubject::joined_side(SplitMix64& random) const {
  const auto sides = static_cast<std::uint32_t>(places.side.size());
  const std::uint32_t from = random.below(sides);
  for (std::uint32_t k = 0; k < sides; ++k)
    if (const std::uint32_t side = (from + k) % sides; cells.is_joined(side)) return side;
  return std::nullopt;
}

void CutSubject::deform() {
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    Eigen::Vector3d& x = body.vertices.position[k];
    x = {1.5 * x[0] + 0.2 * x[2], 0.9 * x[1], x[2] + 0.3 * x[0]};
    body.vertices.velocity[k] = {x[1], -x[0], 0.5 * x[2]};
  }
}

}  // namespace dartboard
