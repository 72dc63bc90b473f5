#include "validation/conservation/reference_motion.h"

#include "core/walks/runge_kutta_4.h"
#include "reference/exact_measure.h"

namespace dartboard {

RemainingNetwork remaining_network(const Problem& start, const RemainingCells& cells) {
  const Mesh& mesh = start.mesh;
  const auto point_at = [&](std::uint32_t corner) { return mesh.nodes[corner]; };
  std::vector<double> share;  // exact measures, rounded once
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    share.push_back(start.material.density * reference::exact_measure(mesh, c) /
                    static_cast<double>(mesh.cell(c).size()));
  std::vector<std::uint8_t> fixed(mesh.points.size(), 0);
  for (const std::uint32_t p : start.fixed) fixed[p] = 1;

  RemainingNetwork left;
  left.network.viscosity = start.material.viscosity;
  left.network.gravity = start.surroundings.gravity;
  std::vector<std::uint32_t> number(mesh.nodes.size());  // by corner
  cells.for_each_vertex([&](std::uint32_t first, std::span<const std::uint32_t> corners) {
    long double mass = 0.0L;
    for (const std::uint32_t k : corners) {
      mass += share[cells.cell_of_corner(k)];
      number[k] = static_cast<std::uint32_t>(left.corner.size());
    }
    left.corner.push_back(first);
    left.network.mass.push_back(static_cast<double>(mass));
    left.network.fixed.push_back(fixed[point_at(first)]);
  });
  cells.for_each_edge([&](std::uint32_t first, std::span<const std::uint32_t> edges) {
    const auto [a, b] = cells.ends(first);
    const auto around = static_cast<double>(edges.size());
    left.network.springs.push_back({number[a], number[b], start.material.stiffness * around,
                                    start.material.damping * around,
                                    (mesh.points[point_at(b)] - mesh.points[point_at(a)]).norm()});
  });
  return left;
}

template <class Map>
ReferenceMotion compare_with_reference(const Subject<Map>& at, int steps) {
  const RemainingNetwork left = remaining_network(*at.start, at.cells);
  const auto state = [&](const LiveBody<Map>& of) {
    PointState s;
    for (const std::uint32_t corner : left.corner) {
      const std::uint32_t k = of.vertex(of.map, at.places.corner[corner]);
      s.x.push_back(of.vertices.position[k]);
      s.v.push_back(of.vertices.velocity[k]);
    }
    return s;
  };
  const double h = at.start->h;
  LiveBody<Map> live = at.body;  // a copy: the run must not be affected by the comparison
  RungeKutta4 integrator;
  for (int k = 0; k < steps; ++k) integrator.step(at.views.cells, live, h);
  const auto [end, spread] = reference::witnessed_motion(left.network, state(at.body), h, steps);
  return {reference::distance(reference::extended(state(live)), end), spread};
}

template ReferenceMotion compare_with_reference(const Subject<Map2>&, int);
template ReferenceMotion compare_with_reference(const Subject<Map3>&, int);
template ReferenceMotion compare_with_reference(const Subject<TetMap>&, int);

}  // namespace dartboard
