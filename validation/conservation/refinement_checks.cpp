#include "validation/conservation/refinement_checks.h"

#include <algorithm>
#include <cmath>

#include "core/topology/check.h"

namespace dartboard {

using enum Check;

template <class Map>
void RefinementChecks<Map>::begin() {
  most_cells_ = 1;
  at_.cells.for_each_vertex([this](auto corners) { most_cells_ = std::max(most_cells_, corners.size()); });
}

template <class Map>
ConservedSums RefinementChecks<Map>::all_sums() const {
  ConservedSums sums = sums_of(at_.body, at_.views.cells);
  for (const Dart d : at_.body.face_dart)
    if (at_.body.map.template is_free<3>(d)) {
      const auto side = at_.side(d);
      sums[Conserved::boundary].add(at_.cells.cells()[side.cell].side_area[side.node]);
    }
  return sums;
}

template <class Map>
long RefinementChecks<Map>::euler() const {
  const LiveBody<Map>& body = at_.body;
  return static_cast<long>(body.vertices.size()) - static_cast<long>(body.springs.size()) +
         static_cast<long>(body.face_dart.size()) - static_cast<long>(body.cell_dart.size());
}

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
  ledger_.equal(valid, v.viscosity[k], at_.start().material.viscosity * v.mass[k], "viscosity, vertex", k);
  // both are means of means, each off by no more than the witness says
  const SubdividedCells::Point& point = at_.cells.points()[at_.cells.cells()[first.cell].points[first.node]];
  const bool is_new = v.point[k] == no_point;
  ledger_.require(Check::put_in_the_middle,
                  v.pull[k] == (is_new ? Eigen::Vector3d(0, 0, 0) : at_.start().mesh.points[v.point[k]]),
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
  agree(s.stiffness, at_.start().material.stiffness);
  agree(s.damping, at_.start().material.damping);
  const auto [length, length_error] = at_.cells.rest_length(first);
  ledger_.within(spring_of_edge, std::abs(s.rest_length - length), length_error, length, s.rest_length, length);
}

template <class Map>
void RefinementChecks<Map>::cell(std::uint32_t c) {
  const auto& t = at_.cells.cells()[c];
  const std::uint32_t k = at_.cell_number(c);
  ledger_.equal(mass_of_cell, at_.body.cell_mass[k], t.mass, "cell", k);
  ledger_.equal(mass_of_cell, at_.body.node_share[k], t.mass / 4.0, "share of a node, cell", k);
  const auto [volume, error] = at_.cells.volume(c);
  const double density = at_.start().material.density;
  ledger_.within(mass_of_cell, std::abs(t.mass - density * volume),
                 1.001 * (density * error + gamma(t.depth + 12u) * t.mass), t.mass, t.mass, density * volume);
}

template <class Map>
void RefinementChecks<Map>::changed_cells(const ChangedEmbeddings& changed) {
  const LiveBody<Map>& body = at_.body;
  const VertexColumns& v = body.vertices;
  for_each_column(v, VertexColumns::embedded(), [&](const auto& column, const auto& row) {
    ledger_.equal(counts, column.size(), row.name == "held axes" ? 0 : v.size(), "column of dimension", 0);
  });
  ledger_.equal(counts, v.dart.size(), v.size(), "column of dimension", 0);
  ledger_.equal(counts, body.edge_dart.size(), body.springs.size(), "column of dimension", 1);
  ledger_.equal(counts, body.cell_dart.size(), at_.cells.count(), "dimension", 3);
  for (const std::uint32_t k : changed.vertices) {
    if (ledger_.broken()) return;
    vertex(k, at_.corner(v.dart[k]));
  }
  for (const std::uint32_t k : changed.edges) {
    if (ledger_.broken()) return;
    const Dart d = body.edge_dart[k];
    const auto here = at_.corner(d), along = at_.corner(body.map.template alpha<0>(d));
    edge(k, {here.cell, SubdividedCells::edge_between(here.node, along.node)});
  }
  for (const std::uint32_t k : changed.cells) {
    if (ledger_.broken()) return;
    cell(at_.corner(body.cell_dart[k]).cell);
  }
}

// As in conserved_sums.h, but stiffness is a sum over cells, not a product: as many roundings more as there are cells.
template <class Map>
void RefinementChecks<Map>::sums(const ConservedSums& before, const ConservedSums& after, const ConservedSums& removed,
                                 std::size_t more, double elastic) {
  constexpr std::array<Check, conserved_count> check_of{
      total_mass,       total_stiffness,  total_damping,    linear_momentum, linear_momentum, linear_momentum,
      angular_momentum, angular_momentum, angular_momentum, kinetic_energy,  elastic_energy,  boundary_area};
  for (std::size_t i = 0; i < conserved_count; ++i) {
    const auto c = static_cast<Conserved>(i);
    const TwofoldSum &b = before[c], &a = after[c], &r = removed[c];
    const double bound =
        change_bound(c, most_cells_, b, a, r, most_cells_ + more) + (c == Conserved::elastic ? elastic : 0.0);
    ledger_.within(check_of[i], std::abs((a.value() - b.value()) + r.value()), bound, b.magnitude, a.value(),
                   b.value() - r.value());
  }
}

template <class Map>
void RefinementChecks<Map>::everything() {
  const LiveBody<Map>& body = at_.body;
  ledger_.equal(valid, check(body.map), std::string(), "violation in a map of dimension", 3);
  std::vector<char> met(body.vertices.size(), 0);
  std::size_t vertices = 0, edges = 0;
  const auto meet = [&](std::uint32_t k) {
    ledger_.require(valid, k < met.size() && !met[k], "one cell with the number", k);
    if (k < met.size()) met[k] = 1;
    return !ledger_.broken();
  };
  at_.cells.for_each_vertex([&](auto corners) {
    const SubdividedCells::Corner first{corners[0].cell, corners[0].edge};
    ++vertices;
    if (const std::uint32_t k = at_.vertex(first); !ledger_.broken() && meet(k)) vertex(k, first);
  });
  met.assign(body.springs.size(), 0);
  at_.cells.for_each_edge([&](auto members) {
    ++edges;
    if (const std::uint32_t k = at_.edge(members[0]); !ledger_.broken() && meet(k)) edge(k, members[0]);
  });
  if (ledger_.broken()) return;
  for (std::uint32_t c = 0; c < at_.cells.cells().size(); ++c)
    if (at_.cells.cells()[c].is_there) cell(c);
  const std::array<std::size_t, 4> seen{body.vertices.size(), body.springs.size(), body.face_dart.size(),
                                        body.cell_dart.size()};
  const std::array<std::size_t, 4> expected{vertices, edges, at_.cells.count_sides(), at_.cells.count()};
  const std::array<std::size_t, 4> orbits{count_cells<0>(body.map), count_cells<1>(body.map), count_cells<2>(body.map),
                                          count_cells<3>(body.map)};
  for (std::size_t i = 0; i < 4; ++i) {
    ledger_.equal(counts, seen[i], expected[i], "dimension", i);
    ledger_.equal(counts, orbits[i], expected[i], "orbits, dimension", i);
  }
  Views rebuilt;
  rebuilt.rebuild(body);
  ledger_.require(views, at_.views == rebuilt, "all of them, cells", at_.cells.count());
  ledger_.equal(views, at_.views.boundary.facets().size(), at_.cells.count_boundary(), "boundary, cells",
                at_.cells.count());
}

template class RefinementChecks<Map3>;
template class RefinementChecks<TetMap>;

}  // namespace dartboard
