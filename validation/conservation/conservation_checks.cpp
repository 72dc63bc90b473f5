#include "validation/conservation/conservation_checks.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/topology/check.h"
#include "reference/exact_measure.h"
#include "reference/rebuild.h"

namespace dartboard {
namespace {

using enum Check;

constexpr std::array<Check, conserved_count> check_of{
    total_mass,       total_stiffness,  total_damping,    linear_momentum, linear_momentum, linear_momentum,
    angular_momentum, angular_momentum, angular_momentum, kinetic_energy,  elastic_energy,  boundary_area};

/// Whether sums of these terms are exact: whole multiples of a power of two q, together below 2^53 q.
bool sums_are_exact(const std::vector<double>& terms, double each_used) {
  double q = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (const double t : terms)
    if (t != 0.0) {
      q = std::min(q, quantum(t));
      sum += each_used * std::abs(t);
    }
  return sum == 0.0 || sum < 0x1p52 * q;  // 2^52: `sum` itself is rounded
}

long euler_of(const CountsByDimension& n) {
  return static_cast<long>(n[0]) - static_cast<long>(n[1]) + static_cast<long>(n[2]) - static_cast<long>(n[3]);
}

}  // namespace

// ---- for any body under operations

template <class AnySubject>
void OperationChecks<AnySubject>::begin() {
  most_cells_ = 1;
  std::vector<std::size_t> around(at_.body.vertices.size(), 0);
  at_.for_each_cell([&](std::uint32_t c) {
    at_.for_each_corner_of(c, [&](double, std::uint32_t k) { most_cells_ = std::max(most_cells_, ++around[k]); });
  });
}

template <class AnySubject>
CountsByDimension OperationChecks<AnySubject>::counts_of_body() const {
  const auto& body = at_.body;
  if constexpr (Map::dimension == 2)
    return {body.vertices.size(), body.springs.size(), body.cell_dart.size(), 0};
  else
    return {body.vertices.size(), body.springs.size(), body.face_dart.size(), body.cell_dart.size()};
}

template <class AnySubject>
long OperationChecks<AnySubject>::euler() const {
  return euler_of(counts_of_body());
}

template <class AnySubject>
ConservedSums OperationChecks<AnySubject>::all_sums() const {
  ConservedSums sums = sums_of(at_.body, at_.views.cells);
  for (const Dart d : Map::dimension == 3 ? at_.body.face_dart : at_.body.edge_dart)
    if (at_.body.map.template is_free<Map::dimension>(d)) sums[Conserved::boundary].add(at_.measure(at_.side(d)));
  return sums;
}

template <class AnySubject>
BeforeSeries<typename AnySubject::Map> OperationChecks<AnySubject>::before_series() const {
  return {all_sums(), at_.body.vertices, at_.body.vertex, counts_of_body()};
}

template <class AnySubject>
ConservedSums OperationChecks<AnySubject>::after_series(const BeforeSeries<Map>& before, const TopologyChange& change,
                                                        const ChangedEmbeddings& changed,
                                                        const ConservedSums& removed) {
  const auto& old = before.counts;
  const CountsByDimension predicted{old[0] + change.vertices.size() - change.removed_vertices.size(),
                                    old[1] + change.edges.size() - change.removed_edges.size(),
                                    old[2] + change.faces.size() - change.removed_faces.size(),
                                    old[3] - change.removed_volumes.size()};
  const auto n = counts_of_body();
  for (std::size_t i = 0; i < 4; ++i) ledger_.equal(counts, n[i], predicted[i], "dimension", i);
  ledger_.equal(Check::euler, euler_of(n), euler_of(predicted), "dimension", Map::dimension);
  columns_fit();
  if (!ledger_.broken()) columns_were_duplicated(before);
  if (!ledger_.broken()) changed_cells(changed);
  if (ledger_.broken()) return {};
  const ConservedSums after = all_sums();
  sums(before.sums, after, removed);
  return after;
}

template <class AnySubject>
void OperationChecks<AnySubject>::columns_fit() {
  const auto n = counts_of_body();
  ledger_.equal(counts, n[Map::dimension], at_.cells.count(), "dimension", Map::dimension);
  const auto& body = at_.body;
  const VertexColumns& v = body.vertices;
  for_each_column(v, VertexColumns::embedded(), [&](const auto& column, const auto& row) {
    ledger_.equal(counts, column.size(), row.name == "held axes" ? 0 : n[0], "column of dimension", 0);
  });
  ledger_.equal(counts, v.dart.size(), n[0], "column of dimension", 0);
  ledger_.equal(counts, body.edge_dart.size(), n[1], "column of dimension", 1);
  for_each_column(body, LiveBody<Map>::embedded_in_cells(), [&](const auto& column, const auto& row) {
    const bool is_left_out = (body.material.model == Model::springs && row.name.find("shape") != row.name.npos) ||
                             (body.materials.empty() && row.name == "material") || row.name == "springs within";
    ledger_.equal(counts, column.size(), is_left_out ? 0 : n[Map::dimension], "column of dimension", Map::dimension);
  });
  // the sums below read the arrays
  const CellArrays& arrays = at_.views.cells;
  const CountsByDimension seen{arrays.vertices.size(), arrays.edges.size(), arrays.faces.size(), arrays.volumes.size()};
  for (std::size_t i = 0; i < 4; ++i) ledger_.equal(counts, seen[i], n[i], "array of dimension", i);
}

template <class AnySubject>
void OperationChecks<AnySubject>::columns_were_duplicated(const BeforeSeries<Map>& before) {
  const VertexColumns &v = at_.body.vertices, &old = before.vertices;
  for (std::uint32_t k = 0; k < v.size(); ++k) {
    if (!at_.body.map.is_live(v.dart[k])) return ledger_.require(valid, false, "a live dart of vertex", k);
    const std::uint32_t was = before.number(at_.body.map, v.dart[k]);
    const bool same = v.position[k] == old.position[was] && v.velocity[k] == old.velocity[was] &&
                      v.fixed[k] == old.fixed[was] && v.point[k] == old.point[was] && v.rest[k] == old.rest[was] &&
                      v.pull[k] == old.pull[was] && v.force[k] == Eigen::Vector3d(0, 0, 0);
    ledger_.require(duplicated, same, "vertex", k);
  }
}

template <class AnySubject>
void OperationChecks<AnySubject>::changed_cells(const ChangedEmbeddings& changed) {
  const auto& body = at_.body;
  for (const std::uint32_t k : changed.vertices) {
    if (ledger_.broken()) return;
    vertex(k, at_.vertex_at(body.vertices.dart[k]));
  }
  for (const std::uint32_t k : changed.edges) {
    if (ledger_.broken()) return;
    const Dart d = body.edge_dart[k];
    if (!body.map.is_live(d)) return ledger_.require(valid, false, "a live dart of edge", k);
    edge(k, at_.edge_at(d));
  }
  for (const std::uint32_t k : changed.cells) {
    if (ledger_.broken()) return;
    cell(at_.cell(body.cell_dart[k]));
  }
}

template <class AnySubject>
void OperationChecks<AnySubject>::sums(const ConservedSums& before, const ConservedSums& after,
                                       const ConservedSums& removed, std::size_t more, double elastic) {
  for (std::size_t i = 0; i < conserved_count; ++i) {
    const auto c = static_cast<Conserved>(i);
    const TwofoldSum &b = before[c], &a = after[c], &r = removed[c];
    const double bound =
        change_bound(c, most_cells_, b, a, r, more_roundings() + more) + (c == Conserved::elastic ? elastic : 0.0);
    ledger_.within(check_of[i], std::abs((a.value() - b.value()) + r.value()), is_exact(c) ? 0.0 : bound, b.magnitude,
                   a.value(), b.value() - r.value());
  }
}

template <class AnySubject>
void OperationChecks<AnySubject>::ends(std::uint32_t k, std::uint32_t a, std::uint32_t b) {
  const auto expected = std::minmax({a, b});
  const auto named = [&](const std::array<std::uint32_t, 2>& seen) { return std::minmax({seen[0], seen[1]}); };
  const Views& now = at_.views;
  ledger_.require(Check::ends, k < now.ends.ends.size() && named(now.ends.ends[k]) == expected, "view, edge", k);
  ledger_.require(Check::ends, k < now.cells.edges.size() && named(now.cells.edges[k].ends) == expected, "arrays, edge",
                  k);
}

template <class AnySubject>
void OperationChecks<AnySubject>::everything() {
  ledger_.equal(valid, check(at_.body.map), std::string(), "violation in a map of dimension", Map::dimension);
  all_cells();
  if (ledger_.broken()) return;
  all_views();
  boundary();
  if (!ledger_.broken()) all_else();
}

// Numbers and the witness's cells must be in one-to-one correspondence: all places of a cell have one number (in
// `vertex` and `edge`), no two cells the same, and there are as many of both (in `all_counts`).
template <class AnySubject>
void OperationChecks<AnySubject>::all_cells() {
  std::vector<char> met;
  const auto meet = [&](std::uint32_t k, const char* of) {
    if (!ledger_.broken()) ledger_.require(valid, k < met.size() && !met[k], of, k);
    if (ledger_.broken()) return false;
    met[k] = 1;
    return true;
  };
  met.assign(at_.body.vertices.size(), 0);
  at_.for_each_vertex([&](std::uint32_t k, auto place) {
    if (meet(k, "one vertex with the number")) vertex(k, place);
  });
  met.assign(at_.body.springs.size(), 0);
  at_.for_each_edge([&](std::uint32_t k, auto place) {
    if (meet(k, "one edge with the number")) edge(k, place);
  });
  if (ledger_.broken()) return;
  at_.for_each_cell([&](std::uint32_t c) { cell(c); });
  if (!ledger_.broken()) all_counts();
}

template <class AnySubject>
void OperationChecks<AnySubject>::all_counts() {
  const auto& map = at_.body.map;
  CountsByDimension expected{}, orbits{count_cells<0>(map), count_cells<1>(map), count_cells<2>(map), 0};
  at_.for_each_vertex([&](std::uint32_t, auto) { ++expected[0]; });
  at_.for_each_edge([&](std::uint32_t, auto) { ++expected[1]; });
  expected[Map::dimension] = at_.cells.count();
  if constexpr (Map::dimension == 3) {
    expected[2] = at_.cells.count_sides();
    orbits[3] = count_cells<3>(map);
  } else {
    ledger_.equal(counts, at_.cells.count_sides(), expected[1], "sides, dimension", 1);
  }
  const auto n = counts_of_body();
  for (std::size_t i = 0; i < 4; ++i) {
    ledger_.equal(counts, n[i], expected[i], "dimension", i);
    ledger_.equal(counts, n[i], orbits[i], "orbits, dimension", i);
  }
  ledger_.equal(Check::euler, euler_of(n), euler_of(expected), "dimension", Map::dimension);
}

template <class AnySubject>
void OperationChecks<AnySubject>::all_views() {
  const Views& now = at_.views;
  Views rebuilt;
  rebuilt.rebuild(at_.body);
  const auto agree = [&](const char* name, bool same) {
    ledger_.require(views, same, fmt::format("{}, cells", name).c_str(), at_.body.cell_dart.size());
  };
  agree("cell arrays", now.cells == rebuilt.cells);
  agree("spring ends", now.ends == rebuilt.ends);
  agree("corners of tetrahedra", now.tetrahedra == rebuilt.tetrahedra);
  agree("corners of solid cells", now.solids == rebuilt.solids);
  agree("boundary surface", now.boundary == rebuilt.boundary);
  agree("component labels", now.components == rebuilt.components);
}

template <class AnySubject>
void OperationChecks<AnySubject>::boundary() {
  TwofoldSum measure;
  std::size_t sides = 0;
  at_.for_each_cell([&](std::uint32_t c) {
    at_.for_each_side_of(c, [&](auto side) {
      if (at_.cells.is_joined(side)) return;
      measure.add(at_.measure(side));
      ++sides;
    });
  });
  ledger_.equal(views, at_.views.boundary.facets().size(), sides, "boundary of cells", at_.cells.count());
  const TwofoldSum seen = all_sums()[Conserved::boundary];
  ledger_.within(boundary_area, std::abs(seen.value() - measure.value()),
                 change_bound(Conserved::boundary, most_cells_, measure, seen, {}), measure.magnitude, seen.value(),
                 measure.value());
}

// ---- for a body that is taken apart

template <class Map>
ConservationChecks<Map>::ConservationChecks(const Subject<Map>& subject, ConservationLedger& ledger)
    : Base(subject, ledger) {
  const auto remember = [&](Conserved c, bool exact) { this->exact_[static_cast<std::size_t>(c)] = exact; };
  const auto uses = static_cast<double>(at_.places.edge.size());
  remember(Conserved::mass, sums_are_exact(at_.body.node_share, 8.0));
  remember(Conserved::stiffness, sums_are_exact({at_.start->material.stiffness}, uses));
  remember(Conserved::damping, sums_are_exact({at_.start->material.damping}, uses));
}

// Shares are added in the order of the darts of the body's cells, so that the bits must agree; nothing else of the
// darts is used.
template <class Map>
double ConservationChecks<Map>::mass_from_cells(std::span<const std::uint32_t> corners) {
  const Mesh& mesh = at_.start->mesh;
  numbers_.clear();
  for (const std::uint32_t k : corners)
    numbers_.push_back(at_.body.cell_dart[at_.body.cell(at_.body.map, at_.places.corner[k])].index);
  std::sort(numbers_.begin(), numbers_.end());
  double mass = 0.0;
  for (const std::uint32_t dart : numbers_) {
    const std::uint32_t c = at_.places.cell_of[dart];
    mass += at_.start->material.density * std::abs(signed_measure(mesh, c)) / static_cast<double>(mesh.cell(c).size());
  }
  return mass;
}

template <class Map>
void ConservationChecks<Map>::vertex(std::uint32_t k, std::span<const std::uint32_t> corners) {
  for (const std::uint32_t corner : corners)
    ledger_.equal(valid, at_.vertex(corner), k, "number at a corner of vertex", k);
  if (ledger_.broken()) return;
  const VertexColumns& v = at_.body.vertices;
  ledger_.equal(mass_of_vertex, v.mass[k], mass_from_cells(corners), "vertex", k);
  ledger_.equal(mass_of_vertex, v.inverse_mass[k], 1.0 / v.mass[k], "inverse, vertex", k);
  ledger_.equal(mass_of_vertex, v.viscosity[k], at_.start->material.viscosity * v.mass[k], "viscosity, vertex", k);
}

template <class Map>
void ConservationChecks<Map>::edge(std::uint32_t k, std::span<const std::uint32_t> edges) {
  for (const std::uint32_t e : edges) ledger_.equal(valid, at_.edge(e), k, "number at an edge of spring", k);
  if (edges.empty()) return;
  const Mesh& mesh = at_.start->mesh;
  const auto [a, b] = at_.cells.ends(edges[0]);
  const Spring& s = at_.body.springs[k];
  const auto around = static_cast<double>(edges.size());
  ledger_.equal(spring_of_edge, s.stiffness, at_.start->material.stiffness * around, "stiffness, edge", k);
  ledger_.equal(spring_of_edge, s.damping, at_.start->material.damping * around, "damping, edge", k);
  ledger_.equal(spring_of_edge, s.rest_length, (mesh.points[mesh.nodes[b]] - mesh.points[mesh.nodes[a]]).norm(),
                "rest length, edge", k);
  this->ends(k, at_.vertex(a), at_.vertex(b));
}

// The soup's volumes are exact rationals by another formula: masses are compared within a rounding bound. Springs
// between the same two vertices are one for a soup: q of them, each a product, and their sum take q roundings, the
// soup's product one.
template <class Map>
void ConservationChecks<Map>::all_else() {
  ledger_.equal(views, at_.views.components.count(), at_.cells.count_components(), "components of cells",
                at_.body.cell_dart.size());
  if (ledger_.broken()) return;
  const LiveBody<Map>& body = at_.body;
  const Problem rest = rest_problem(body, *at_.start, at_.places);
  const auto soup = reference::rebuild(rest.mesh, rest.material);
  std::vector<double> rounding(body.vertices.size(), 0.0);  // of the volumes, which are exact in the soup
  std::vector<std::size_t> around(body.vertices.size(), 0);
  for (std::size_t c = 0; c < rest.mesh.cell_count(); ++c)
    for (const std::uint32_t k : rest.mesh.cell(c)) {
      rounding[k] += rest.material.density * reference::measure_rounding(rest.mesh, c) /
                     static_cast<double>(rest.mesh.cell(c).size());
      ++around[k];
    }
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
    ledger_.within(mass_of_cells, std::abs(body.vertices.mass[k] - soup.mass[k]),
                   1.001 * (rounding[k] + 2.0 * gamma(around[k] + 2) * soup.mass[k]), soup.mass[k],
                   body.vertices.mass[k], soup.mass[k]);

  std::vector<double> stiffness(soup.springs.size(), 0.0), damping(stiffness);
  std::vector<std::size_t> together(soup.springs.size(), 0);
  for (const EdgeEntry& e : at_.views.cells.edges) {
    const auto [low, high] = std::minmax(e.ends[0], e.ends[1]);
    const auto found = std::lower_bound(soup.springs.begin(), soup.springs.end(), std::pair(low, high),
                                        [](const auto& s, const auto& ends) { return std::pair(s.a, s.b) < ends; });
    const bool known = found != soup.springs.end() && found->a == low && found->b == high;
    ledger_.require(side_by_side, known, "in the soup, spring", e.embedding);
    if (!known) return;
    const auto k = static_cast<std::size_t>(found - soup.springs.begin());
    ++together[k];
    stiffness[k] += body.springs[e.embedding].stiffness;
    damping[k] += body.springs[e.embedding].damping;
    ledger_.equal(spring_of_edge, body.springs[e.embedding].rest_length, found->rest_length,
                  "rest length from the soup, edge", e.embedding);
  }
  for (std::size_t k = 0; k < soup.springs.size(); ++k) {
    const auto agree = [&](double sum, double expected) {
      const double bound = together[k] == 1 ? 0.0 : 1.001 * gamma(together[k] + 1) * expected;
      ledger_.within(side_by_side, std::abs(sum - expected), bound, expected, sum, expected);
    };
    agree(stiffness[k], soup.springs[k].stiffness);
    agree(damping[k], soup.springs[k].damping);
  }
}

template class OperationChecks<Subject<Map2>>;
template class OperationChecks<Subject<Map3>>;
template class OperationChecks<Subject<TetMap>>;
template class OperationChecks<RefinedSubject<Map3>>;
template class OperationChecks<RefinedSubject<TetMap>>;
template class ConservationChecks<Map2>;
template class ConservationChecks<Map3>;
template class ConservationChecks<TetMap>;

}  // namespace dartboard
