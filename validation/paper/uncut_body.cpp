#include "validation/paper/uncut_body.h"

#include <fmt/format.h>

#include <algorithm>

#include "reference/exact_measure.h"
#include "reference/rebuild.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/paper/worst_share.h"

namespace dartboard {

ClaimAnswer masses_are_of_cells(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const double density = problem.material.density;
  std::vector<reference::Rational> of_point(mesh.points.size());
  std::vector<double> rounding(mesh.points.size());
  std::vector<std::size_t> cells(mesh.points.size());
  WorstShare cell_share, vertex_share;
  double total = 0.0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const reference::Rational exact = abs(reference::exact_volume(mesh, c)) * reference::Rational(density);
    const double mass = reference::rounded(exact), off = reference::measure_rounding(mesh, c) * density;
    // the product, and the witness's own rounding
    cell_share.compare(body.cell_mass[c], mass, off + gamma(2) * mass);
    total += mass;
    for (const std::uint32_t p : mesh.cell(c)) {
      of_point[p] += exact / mesh.cell(c).size();
      rounding[p] += off / static_cast<double>(mesh.cell(c).size());
      ++cells[p];
    }
  }
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    const std::uint32_t p = body.vertices.point[k];
    const double mass = reference::rounded(of_point[p]);
    vertex_share.compare(body.vertices.mass[k], mass, rounding[p] + gamma(cells[p] + 2) * mass);
  }
  return {cell_share.within() && vertex_share.within() && body.vertices.size() == mesh.points.size(),
          fmt::format("{:.6g} kg; cells off by {:.2g} of the rounding bound, vertices by {:.2g}", total,
                      cell_share.share(), vertex_share.share())};
}

ClaimAnswer stiffnesses_are_of_cells(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem) {
  const reference::Rebuilt counted = reference::rebuild(problem.mesh, problem.material);
  const double k = problem.material.stiffness;
  std::size_t right = 0, contributions = 0;
  for (std::size_t e = 0; e < body.springs.size(); ++e) {
    const Dart d = body.edge_dart[e];
    const auto point = [&](Dart x) { return body.vertices.point[body.vertex(body.map, x)]; };
    const auto [a, b] = std::minmax({point(d), point(body.map.alpha<0>(d))});
    const auto found =
        std::ranges::find_if(counted.springs, [a = a, b = b](const auto& s) { return s.a == a && s.b == b; });
    if (found == counted.springs.end()) continue;
    const std::size_t around = counted.cells[static_cast<std::size_t>(found - counted.springs.begin())];
    right += body.springs[e].stiffness == static_cast<double>(around) * k ? 1 : 0;
    contributions += around;
  }
  return {right == body.springs.size() && right == counted.springs.size(),
          fmt::format("{} of {} edges, {} k of {} cells", right, body.springs.size(), contributions,
                      problem.mesh.cell_count())};
}

}  // namespace dartboard
