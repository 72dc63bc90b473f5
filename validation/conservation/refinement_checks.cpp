#include "validation/conservation/refinement_checks.h"

#include <algorithm>
#include <cmath>

namespace dartboard {

using enum Check;

// The shares have the same bits, but are summed in another order: n terms, n - 1 roundings on either side.
template <class Map>
void RefinementChecks<Map>::vertex(std::uint32_t k, SubdividedCells::Corner first) {
  const auto around = at_.cells.around(first.cell, static_cast<std::uint8_t>(1u << first.node));
  most_cells_ = std::max(most_cells_, around.size());
  double mass = 0.0;
  for (const auto& [c, nodes] : around) {
    std::uint32_t n = 0;
    while (nodes >> n != 1) ++n;
    ledger_.equal(valid, at_.vertex({c, n}), k, "number at a corner of vertex", k);
    mass += at_.cells.cells()[c].mass / 4.0;
  }
  const VertexColumns& v = at_.body.vertices;
  if (ledger_.broken()) return;
  ledger_.within(mass_of_vertex, std::abs(v.mass[k] - mass), 2.002 * gamma(around.size()) * mass, mass, v.mass[k],
                 mass);
  ledger_.equal(valid, v.inverse_mass[k], 1.0 / v.mass[k], "inverse mass, vertex", k);
  ledger_.equal(valid, v.viscosity[k], at_.start->material.viscosity * v.mass[k], "viscosity, vertex", k);
  // both are means of means, each with an error within the witness's bound
  const SubdividedCells::Point& point = at_.cells.points()[at_.cells.cells()[first.cell].points[first.node]];
  const bool is_new = v.point[k] == no_point;
  ledger_.require(Check::put_in_the_middle,
                  v.pull[k] == (is_new ? Eigen::Vector3d(0, 0, 0) : at_.start->mesh.points[v.point[k]]),
                  "pull at vertex", k);
  ledger_.within(Check::put_in_the_middle, (v.rest[k] - point.rest).template lpNorm<Eigen::Infinity>(),
                 2.0 * point.error, point.rest.norm(), v.rest[k].norm(), point.rest.norm());
}

template <class Map>
void RefinementChecks<Map>::edge(std::uint32_t k, SubdividedCells::EdgeOfCell first) {
  const auto [a, b] = SubdividedCells::ends[first.edge];
  const auto around = at_.cells.around(first.cell, static_cast<std::uint8_t>(1u << a | 1u << b));
  double share = 0.0;
  for (const auto& [c, nodes] : around) {
    std::uint32_t e = 0;
    while ((1u << SubdividedCells::ends[e][0] | 1u << SubdividedCells::ends[e][1]) != nodes) ++e;
    ledger_.equal(valid, at_.edge({c, e}), k, "number at an edge of spring", k);
    share += at_.cells.cells()[c].share[e];
  }
  if (ledger_.broken()) return;
  const Spring& s = at_.body.springs[k];
  const auto agree = [&](double actual, double of_material) {
    const double expected = of_material * share;
    ledger_.within(spring_of_edge, std::abs(actual - expected), 2.002 * gamma(around.size() + 1) * expected, expected,
                   actual, expected);
  };
  agree(s.stiffness, at_.start->material.stiffness);
  agree(s.damping, at_.start->material.damping);
  const auto [length, length_error] = at_.cells.rest_length(first);
  ledger_.within(spring_of_edge, std::abs(s.rest_length - length), length_error, length, s.rest_length, length);
  this->ends(k, at_.vertex({first.cell, a}), at_.vertex({first.cell, b}));
}

template <class Map>
void RefinementChecks<Map>::cell(std::uint32_t c) {
  const auto& t = at_.cells.cells()[c];
  const std::uint32_t k = at_.body.cell(at_.body.map, at_.darts_of(c).front());
  ledger_.equal(mass_of_cell, at_.body.cell_mass[k], t.mass, "cell", k);
  ledger_.equal(mass_of_cell, at_.body.node_share[k], t.mass / 4.0, "share of a node, cell", k);
  const auto [volume, error] = at_.cells.volume(c);
  const double density = at_.start->material.density;
  ledger_.within(mass_of_cell, std::abs(t.mass - density * volume),
                 1.001 * (density * error + gamma(t.depth + 12u) * t.mass), t.mass, t.mass, density * volume);
}

template class RefinementChecks<Map3>;
template class RefinementChecks<TetMap>;

}  // namespace dartboard
