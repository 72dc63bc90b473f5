#include "validation/scenes/spring_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mechanics/adapt.h"
#include "core/mechanics/fracture/seam.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/tear_fan.h"
#include "core/plain/error.h"
#include "validation/conservation/mesh_places.h"

namespace dartboard {
namespace {

/// The vertex of every corner of the mesh's cells.
std::vector<std::uint32_t> vertex_of_corners(const TetBody& body, const MeshPlaces& places) {
  std::vector<std::uint32_t> vertex;
  for (const Dart d : places.corner) vertex.push_back(body.vertex(body.map, d));
  return vertex;
}

void require_same_vertices(const TetBody& body, const RemainingCells& cells, const std::vector<std::uint32_t>& vertex) {
  std::size_t classes = 0;
  cells.for_each_vertex([&](std::uint32_t corner, std::span<const std::uint32_t> corners) {
    ++classes;
    for (const std::uint32_t other : corners)
      if (vertex[other] != vertex[corner])
        throw InputError(
            fmt::format("corners {} and {} of the cells are one vertex, and vertices {} and {} of the body", corner,
                        other, vertex[corner], vertex[other]));
  });
  if (classes != body.vertices.size())
    throw InputError(fmt::format("the cells have {} vertices, the body {}", classes, body.vertices.size()));
}

}  // namespace

TimedCut plane_cut(double time, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return {time, [point, normal](const TetBody& body) { return faces_on_plane(body, point, normal); }};
}

TimedCut fan_tear(double time, std::uint32_t point) {
  return {time, [point](const TetBody& body) {
            for (std::size_t k = 0; k < body.vertices.size(); ++k)
              if (body.vertices.point[k] == point) return fan(body.map, body.vertices.dart[k]);
            throw InputError(fmt::format("there is no mesh point {}", point));
          }};
}

PreparedScene prepare(const SpringScene& scene) {
  const Problem& problem = scene.problem;
  const std::size_t points = problem.mesh.points.size();
  if (!scene.initial_position.empty() && scene.initial_position.size() != points)
    throw InputError(fmt::format("{} initial positions for {} points", scene.initial_position.size(), points));
  if (!(scene.duration > 0.0) || scene.checkpoints == 0) throw InputError("a scene needs a duration and a checkpoint");

  TetBody body = build_body<TetMap, Held::by_every_dart>(problem);
  PreparedScene prepared{scene.name, body, {}, {}, scene.duration, 0.0};
  RemainingCells cells(problem.mesh);
  const MeshPlaces places(body, problem.mesh, cells);

  const auto network_now = [&] {
    const Problem rest = rest_problem(body, problem, places);
    reference::SpringNetwork network = reference::spring_network(rest);
    prepared.fastest_rate = std::max(prepared.fastest_rate, reference::fastest_rate(network, rest.mesh.points));
    return network;
  };

  // the start, by vertex number
  auto& start = prepared.body.vertices;
  if (!scene.initial_position.empty())
    for (std::size_t k = 0; k < start.size(); ++k) start.position[k] = scene.initial_position[start.point[k]];
  prepared.motion.start = {start.position, start.velocity};
  prepared.motion.network = network_now();
  for (std::size_t c = 1; c <= scene.checkpoints; ++c)
    prepared.motion.checkpoints.push_back(scene.duration * static_cast<double>(c) /
                                          static_cast<double>(scene.checkpoints));

  for (const TimedCut& event : scene.events) {
    if (!(event.time >= 0.0 && event.time < scene.duration))
      throw InputError(fmt::format("an event at {} s of {} s", event.time, scene.duration));
    prepared.faces.push_back(event.faces(body));
  }
  std::vector<std::uint32_t> before = vertex_of_corners(body, places);
  for (std::size_t k = 0; k < scene.events.size(); ++k) {
    if (prepared.faces[k].empty()) throw InputError(fmt::format("event {} finds no face", k));
    for (const Dart d : prepared.faces[k]) {
      const std::uint32_t side = places.side_of[d.index];
      if (cells.is_joined(side)) cells.dissociate(side);
    }
    const std::span<const Dart> faces(prepared.faces[k]);
    adapt(body, dissociate_all(body.map, faces));
    const std::vector<std::uint32_t> after = vertex_of_corners(body, places);
    require_same_vertices(body, cells, after);
    if (scene.events[k].time == 0.0) {  // the motion starts after it
      adapt(prepared.body, dissociate_all(prepared.body.map, faces));
      prepared.motion.start = {start.position, start.velocity};
      prepared.fastest_rate = 0.0;
      prepared.motion.network = network_now();
      before = after;
      continue;
    }
    std::vector<std::uint32_t> from(body.vertices.size());
    for (std::size_t corner = 0; corner < after.size(); ++corner) from[after[corner]] = before[corner];
    prepared.motion.events.push_back({scene.events[k].time, network_now(), std::move(from)});
    before = after;
  }
  const auto at_start = std::ranges::count(scene.events, 0.0, &TimedCut::time);
  prepared.faces.erase(prepared.faces.begin(), prepared.faces.begin() + at_start);
  check(prepared.motion);
  return prepared;
}

SpringSystem system_of(const TetBody& body, const SpringEndsView& ends) {
  const VertexColumns& v = body.vertices;
  return {ends.ends, body.springs, v.mass, v.inverse_mass, v.viscosity, v.fixed, body.surroundings.gravity};
}

namespace {

// advance(system, motion, from, to) moves the motion between two times of the scene.
template <class Advance>
SceneRun run_through(const PreparedScene& scene, Integrator& integrator, Advance&& advance) {
  SceneRun run;
  const auto& checkpoints = scene.motion.checkpoints;
  const auto& events = scene.motion.events;
  TetBody body = scene.body;
  SpringEndsView ends;
  ends.rebuild(body);
  integrator.restart();
  integrator.reset_work();

  double t = 0.0;
  std::size_t next_event = 0;
  const auto go_to = [&](double end) {
    run.result = advance(system_of(body, ends), Motion{body.vertices.position, body.vertices.velocity}, t, end);
    t = end;
    return run.result.ok();
  };
  for (std::size_t c = 0; c < checkpoints.size() && run.result.ok(); ++c) {
    while (next_event < events.size() && events[next_event].time < checkpoints[c] && go_to(events[next_event].time)) {
      ends.apply(body, adapt(body, dissociate_all(body.map, std::span<const Dart>(scene.faces[next_event]))));
      integrator.restart();
      ++next_event;
    }
    if (run.result.ok() && go_to(checkpoints[c]))
      run.states.push_back({body.vertices.position, body.vertices.velocity});
  }
  run.work = integrator.work();
  return run;
}

}  // namespace

SceneRun run_scene(const PreparedScene& scene, Integrator& integrator, std::uint64_t steps, EventTiming timing) {
  if (steps == 0) throw InputError("a run needs a step");
  if (timing == EventTiming::end_of_step && steps % scene.motion.checkpoints.size() != 0)
    throw InputError(fmt::format("{} steps are no multiple of {} checkpoints", steps, scene.motion.checkpoints.size()));
  const double h = scene.duration / static_cast<double>(steps);
  const auto take = [&integrator](const SpringSystem& system, Motion motion, std::uint64_t count, double step) {
    StepResult result;
    for (std::uint64_t k = 0; k < count && result.ok(); ++k) result = integrator.step(system, motion, step);
    return result;
  };
  // the number of steps up to a time: an excess of 2^-30 of a step is rounding
  const auto steps_to = [h](double time) { return std::ceil(time / h - 0x1p-30); };

  std::uint64_t done = 0;  // steps, where they are not split
  SceneRun run = run_through(scene, integrator, [&](const SpringSystem& system, Motion motion, double from, double to) {
    if (timing == EventTiming::end_of_step) {
      const auto target = std::max(done, static_cast<std::uint64_t>(steps_to(to)));
      const std::uint64_t count = target - std::exchange(done, target);
      return take(system, motion, count, h);
    }
    if (to <= from) return StepResult{};
    const double count = std::max(1.0, steps_to(to - from)), step = (to - from) / count;
    // the same bits throughout a run, for methods that keep data for a step size
    return take(system, motion, static_cast<std::uint64_t>(count), std::abs(step - h) < 0x1p-40 * h ? h : step);
  });
  run.h = h;
  return run;
}

SceneRun run_scene(const PreparedScene& scene, AdaptiveIntegrator& integrator, const Tolerance& tolerance) {
  return run_through(scene, integrator, [&](const SpringSystem& system, Motion motion, double from, double to) {
    return to > from ? integrator.advance(system, motion, to - from, tolerance) : StepResult{};
  });
}

}  // namespace dartboard
