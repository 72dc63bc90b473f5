// The bound for springs side by side. state_bound supposes one spring per edge of the rebuilt mesh, p around a point;
// the live body may have P >= p there, because an edge with m cells has come apart into parts with m_1 + m_2 + ... = m.
// The parts have the same length, and stiffness and damping in the proportion of their cells, so their forces point the
// same way and both |f| and the error E of one force (summation_bound.cpp) are at most those of the whole: E is
// linear in k and c with factors that grow with m. Only the additions are more: of the 2 n + p + 10 roundings of a
// point with n cells, p become P. Every error of the derivation is proportional to such a number, and the differences
// X, V are linear in the errors but for the tube, whose width enters through 1 / (l - 4 X) and the speed within it: as
// long as that changes a factor of growth by less than 1e-6, forty stages change by less than 4e-5. So
//
//     bound for P  <=  1.001 max over points of (2 n + P + 10) / (2 n + p + 10)  times  bound for p,
//
// and where 4 X exceeds 1e-7 of the shortest spring the bound is taken as infinite: nothing is claimed.

#include "validation/conservation/rebuild_oracle.h"

#include <algorithm>
#include <limits>

#include "core/operations/dissociate_all.h"
#include "core/plain/nan_maximum.h"
#include "core/walks/runge_kutta_4.h"
#include "reference/rebuild.h"

namespace dartboard {
namespace {

/// The vertices and edges of a body from scratch, in the order of the live body's arrays.
struct LiveOrder {
  struct Entry {
    std::uint32_t edge, a, b;
  };
  std::vector<std::uint32_t> vertices;
  std::vector<Entry> edges;

  template <class Body, class F>
  void for_each_vertex(const Body&, F&& f) const {
    for (const std::uint32_t k : vertices) f(k);
  }
  template <class Body, class F>
  void for_each_edge(const Body&, F&& f) const {
    for (const Entry& e : edges) f(e.edge, e.a, e.b);
  }
};

template <class Body, class Walk>
void move(Body& body, const Walk& walk, double h, int steps) {
  RungeKutta4 rk;
  for (int k = 0; k < steps; ++k) rk.step(walk, body, h);
}

double largest_difference(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (int i = 0; i < 3; ++i) largest = max_or_nan(largest, std::abs(a[k][i] - b[k][i]));
  return largest;
}

/// The factor by which the live body's roundings at a point exceed those that state_bound counts.
double more_roundings(const Problem& rest, const CellArrays& live, const std::vector<reference::Spring>& springs) {
  std::vector<std::size_t> cells(rest.mesh.points.size()), one(cells), several(cells);
  for (const std::uint32_t p : rest.mesh.nodes) ++cells[p];
  for (const auto& s : springs) ++one[s.a], ++one[s.b];
  for (const EdgeEntry& e : live.edges) ++several[e.ends[0]], ++several[e.ends[1]];
  double ratio = 1.0;
  for (std::size_t k = 0; k < cells.size(); ++k)
    ratio = std::max(
        ratio, static_cast<double>(2 * cells[k] + several[k] + 10) / static_cast<double>(2 * cells[k] + one[k] + 10));
  return 1.001 * ratio;
}

}  // namespace

template <class Map>
RebuiltMotion compare_rebuilt_motion(const Subject<Map>& at, int steps) {
  const auto& [start, body, views] = static_cast<const SubjectBody<Map>&>(at);
  const CellArrays& arrays = views.cells;
  RebuiltMotion motion;
  const Problem rest = rest_problem(body, *start, at.places);
  PointState now{body.vertices.position, body.vertices.velocity};

  LiveBody<Map> live = body;  // a copy: the run must not be affected by the comparison
  move(live, arrays, start->h, steps);

  auto scratch = build_body<Map, Held::by_every_dart>(rest);
  scratch.set_state(now);
  auto merged = scratch;
  CellArrays merged_arrays;
  merged_arrays.rebuild(merged);
  move(merged, merged_arrays, start->h, steps);
  const PointState end = merged.state();  // its points are the live body's vertices
  motion.position = largest_difference(end.x, live.vertices.position);
  motion.velocity = largest_difference(end.v, live.vertices.velocity);
  motion.springs_side_by_side = body.springs.size() - merged.springs.size();

  motion.bound = reference::state_bound(rest, now, steps);
  const auto springs = reference::rebuild(rest.mesh, rest.material).springs;
  const double ratio = more_roundings(rest, arrays, springs);
  motion.bound = {ratio * motion.bound.position, ratio * motion.bound.velocity};
  double shortest = std::numeric_limits<double>::infinity();
  for (const PointState& state : {now, end})
    for (const auto& s : springs) shortest = std::min(shortest, (state.x[s.b] - state.x[s.a]).norm());
  if (!(4.0 * motion.bound.position <= 1e-7 * shortest))
    motion.bound.position = motion.bound.velocity = std::numeric_limits<double>::infinity();

  // dissociate sides that only touch, all in one series
  const RemainingCells touching(rest.mesh);
  const MeshPlaces scratch_places(scratch, rest.mesh, touching);
  const auto in_order = cells_by_dart(body);
  std::vector<Dart> apart;
  for (std::uint32_t k = 0; k < in_order.size(); ++k) {
    const std::uint32_t c = at.cell(in_order[k]);
    for (std::uint32_t s = 0; s < touching.first_side(k + 1) - touching.first_side(k); ++s)
      if (!at.cells.is_joined(at.cells.first_side(c) + s))
        apart.push_back(scratch_places.side[touching.first_side(k) + s]);
  }
  adapt(scratch, dissociate_all(scratch.map, apart));
  motion.vertices = scratch.vertices.size();
  motion.springs = scratch.springs.size();
  motion.same_cells = motion.vertices == body.vertices.size() && motion.springs == body.springs.size();
  if (!motion.same_cells) return motion;

  LiveOrder order;
  order.vertices.resize(motion.vertices);
  order.edges.resize(motion.springs);
  for (std::uint32_t k = 0; k < in_order.size(); ++k) {
    const std::uint32_t c = at.cell(in_order[k]);
    for (std::size_t n = 0; n < rest.mesh.cell(k).size(); ++n)
      order.vertices[rest.mesh.cell(k)[n]] = scratch.vertex(scratch.map, scratch_places.corner[rest.mesh.first[k] + n]);
    for (std::uint32_t e = 0; e < touching.first_edge(k + 1) - touching.first_edge(k); ++e)
      order.edges[at.edge(at.cells.first_edge(c) + e)].edge =
          scratch.edge(scratch.map, scratch_places.edge[touching.first_edge(k) + e]);
  }
  for (std::size_t k = 0; k < order.edges.size(); ++k) {
    order.edges[k].a = order.vertices[arrays.edges[k].ends[0]];
    order.edges[k].b = order.vertices[arrays.edges[k].ends[1]];
  }
  move(scratch, order, start->h, steps);
  const PointState same = scratch.state();
  motion.same_bits = same.x == live.vertices.position && same.v == live.vertices.velocity;
  return motion;
}

template RebuiltMotion compare_rebuilt_motion(const Subject<Map2>&, int);
template RebuiltMotion compare_rebuilt_motion(const Subject<Map3>&, int);
template RebuiltMotion compare_rebuilt_motion(const Subject<TetMap>&, int);

}  // namespace dartboard
