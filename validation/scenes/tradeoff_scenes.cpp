#include "validation/scenes/tradeoff_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/mechanics/fracture/stress.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/time/explicit/blanes_moan_4.h"
#include "reference/closed_form.h"
#include "validation/scenes/order_scenes.h"

namespace dartboard {
namespace {

constexpr TradeoffEntry table[]{
    {"smooth", "liver564, free, soft motion, undamped"},
    {"swing", "liver564 clamped on one side, swinging under gravity, damped as the paper's"},
    {"stiff-1e4", "liver564 with a tenth of its tetrahedra 10^4 times stiffer, undamped"},
    {"stiff-1e4-damped", "the same with a damping ratio of 1 at omega_max"},
    {"stiff-1e6", "liver564 with a tenth of its tetrahedra 10^6 times stiffer, undamped"},
    {"stiff-1e6-damped", "the same with a damping ratio of 1 at omega_max"},
    {"cut", "the smooth scene, cut in two in mid-run"},
    {"tear", "the smooth scene, a fan torn in mid-run where the stress is largest then"},
    {"chain", "24 masses on a line between walls, in closed form"},
    {"large", "a box of 105,456 tetrahedra, free, soft motion, undamped"},
};

constexpr double smooth_phase = 173.0;  // duration times omega_max
const Material soft{.density = 1000.0, .stiffness = 5.0, .damping = 0.0, .viscosity = 0.0};

double rate_of(const Problem& problem) {
  return reference::fastest_rate(reference::spring_network(problem), problem.mesh.points);
}

Eigen::Vector3d mean(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum(0, 0, 0);
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

SpringScene swing_scene(Mesh mesh) {
  SpringScene scene{"swing", {}, {}, {}, 1.0, 8};
  Problem& problem = scene.problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};
  double low = problem.mesh.points[0].x(), high = low;
  for (const auto& p : problem.mesh.points) {
    low = std::min(low, p.x());
    high = std::max(high, p.x());
  }
  for (std::uint32_t i = 0; i < problem.mesh.points.size(); ++i)
    if (problem.mesh.points[i].x() < low + 0.1 * (high - low)) problem.fixed.push_back(i);
  const double rate = rate_of(problem);
  scene.duration = 256.0 / rate;
  set_off(scene, 0.02, rate / 16);
  return scene;
}

/// The vertex whose fan has faces and whose principal stress is largest after `t` seconds.
std::uint32_t most_stressed_point(const SpringScene& scene, double t) {
  PreparedScene prepared = prepare(scene);
  TetBody& body = prepared.body;
  SpringEndsView ends;
  ends.rebuild(body);
  BlanesMoan4 integrator;
  const auto steps = static_cast<int>(std::ceil(t * prepared.fastest_rate / 0.5));
  for (int k = 0; k < steps; ++k) {
    const StepResult result =
        integrator.step(system_of(body, ends), {body.vertices.position, body.vertices.velocity}, t / steps);
    if (!result.ok()) throw SolverError(to_string(result));
  }
  std::vector<Eigen::Matrix3d> stress;
  VolumeRoom room;
  vertex_stresses(ends.ends, body.springs, vertex_volumes(body, {}, room), body.vertices.position, stress);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t k = 0; k < stress.size(); ++k) order.emplace_back(-principal_stress(stress[k]).value, k);
  std::sort(order.begin(), order.end());
  for (const auto& [value, k] : order) {
    const std::uint32_t point = body.vertices.point[k];
    const auto tear = fan_tear(t, point);
    if (!tear.faces(prepared.body).empty()) return point;
  }
  throw InputError("no vertex of the body has a fan");
}

/// The tenth of the cells that lie nearest to the middle of the body.
std::vector<std::uint8_t> inclusion(const Mesh& mesh) {
  const Eigen::Vector3d centre = mean(mesh.points);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    Eigen::Vector3d sum(0, 0, 0);
    for (const std::uint32_t i : mesh.cell(c)) sum += mesh.points[i] / static_cast<double>(mesh.cell(c).size());
    order.emplace_back((sum - centre).squaredNorm(), c);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint8_t> stiff(mesh.cell_count(), 0);
  for (std::size_t k = 0; k < mesh.cell_count() / 10; ++k) stiff[order[k].second] = 1;
  return stiff;
}

}  // namespace

std::span<const TradeoffEntry> tradeoff_scenes() { return table; }

void stiffen(PreparedScene& scene, const Mesh& mesh, std::span<const std::uint8_t> stiff, double factor) {
  if (!scene.motion.events.empty()) throw InputError("a body is stiffened only where nothing happens to it");
  if (stiff.size() != mesh.cell_count())
    throw InputError(fmt::format("{} flags for {} cells", stiff.size(), mesh.cell_count()));
  TetBody& body = scene.body;
  body.edge_share.assign(body.map.slot_count<1>(), 1.0);
  body.map.for_each_dart([&](Dart d) {
    if (stiff[body.cell(body.map, d)]) body.edge_share[TetMap::slot<1>(d)] = factor;
  });
  for (std::size_t k = 0; k < body.springs.size(); ++k)
    body.springs.set(k, body.spring_of(Edge{body.edge_dart[k]}, body.springs[k].rest_length));

  std::vector<std::uint32_t> vertex(mesh.points.size());
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) vertex[body.vertices.point[k]] = k;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> cells;  // by edge: stiffness in units of the material's
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        cells[std::minmax(vertex[nodes[i]], vertex[nodes[j]])] += stiff[c] ? factor : 1.0;
  }
  for (reference::Spring& s : scene.motion.network.springs) {
    const double count = cells.at(std::minmax(s.a, s.b));
    s.stiffness = count * body.material.stiffness;
    s.damping = count * body.material.damping;
  }
  scene.fastest_rate = reference::fastest_rate(scene.motion.network, scene.motion.start.x);
}

TradeoffScene tradeoff_scene(std::string what, const SpringScene& scene) {
  TradeoffScene made{.name = scene.name, .what = std::move(what), .body = prepare(scene), .motion = {}};
  made.motion = made.body->motion;
  made.duration = scene.duration;
  made.fastest_rate = made.body->fastest_rate;
  made.edge = reference::mean_rest_length(made.motion.network);
  return made;
}

TradeoffScene stiff_scene(std::string what, Mesh mesh, double factor, const StiffSceneOptions& options) {
  const std::vector<std::uint8_t> stiff = inclusion(mesh);
  SpringScene scene = smooth_scene(std::move(mesh), soft, options.phase);
  scene.checkpoints = options.checkpoints;
  // the inclusion starts at rest: stretched like the other cells, it would hold almost all of the energy
  Problem& problem = scene.problem;
  for (std::uint32_t c = 0; c < stiff.size(); ++c)
    if (stiff[c])
      for (const std::uint32_t i : problem.mesh.cell(c)) {
        scene.initial_position[i] = problem.mesh.points[i];
        problem.initial_velocity[i].setZero();
      }
  const Mesh cells = problem.mesh;
  if (options.damped) {
    // c = beta k, zeta = beta omega / 2
    PreparedScene undamped = prepare(scene);
    stiffen(undamped, cells, stiff, factor);
    problem.material.damping = 2.0 / undamped.fastest_rate * problem.material.stiffness;
  }
  TradeoffScene made = tradeoff_scene(std::move(what), scene);
  stiffen(*made.body, cells, stiff, factor);
  made.motion = made.body->motion;
  made.fastest_rate = made.body->fastest_rate;
  return made;
}

TradeoffScene chain_scene(int count, double phase, std::size_t checkpoints) {
  constexpr double stiffness = 50.0, mass = 0.01, spacing = 0.1;
  TradeoffScene made{.name = "chain", .what = "", .body = {}, .motion = {}};
  reference::SpringNetwork& network = made.motion.network;
  const auto points = static_cast<std::size_t>(count) + 2;
  network.mass.assign(points, mass);
  for (std::size_t p = 0; p < points; ++p) network.fixed.push_back(p == 0 || p + 1 == points);
  for (std::uint32_t i = 0; i + 1 < points; ++i) network.springs.push_back({i, i + 1, stiffness, 0.0, spacing});
  made.fastest_rate = reference::chain_omega_fixed(count, stiffness, mass, count);
  made.edge = spacing;
  made.duration = phase / made.fastest_rate;
  for (std::size_t c = 1; c <= checkpoints; ++c)
    made.motion.checkpoints.push_back(made.duration * static_cast<double>(c) / static_cast<double>(checkpoints));

  // amplitude and phase of each mode that moves; all together stretch no spring by more than a third
  struct Mode {
    int j;
    double q, v;  // [m], [m/s]
  };
  std::vector<Mode> modes;
  for (const auto& [j, strain, turn] : {std::tuple(1, 0.05, 0.5), {3, 0.04, -1.0}, {7, 0.02, 0.7}, {count, 0.01, 1.0}})
    modes.push_back(
        {j, strain * spacing, turn * strain * spacing * reference::chain_omega_fixed(count, stiffness, mass, j)});
  const auto state_at = [=](double t) {
    PointState state;
    state.x.resize(points);
    state.v.assign(points, {0, 0, 0});
    for (std::size_t i = 0; i < points; ++i) state.x[i] = {spacing * static_cast<double>(i), 0, 0};
    for (const Mode& mode : modes) {
      const double omega = reference::chain_omega_fixed(count, stiffness, mass, mode.j);
      const reference::Swing now = reference::oscillate(omega * omega, 0.0, {mode.q, mode.v}, t);
      for (int i = 1; i <= count; ++i) {
        const double shape = reference::chain_shape_fixed(count, mode.j, i);
        state.x[static_cast<std::size_t>(i)].x() += shape * now.q;
        state.v[static_cast<std::size_t>(i)].x() += shape * now.v;
      }
    }
    return state;
  };
  made.motion.start = state_at(0.0);
  made.closed_form = [state_at, times = made.motion.checkpoints] {
    std::vector<PointState> states;
    for (const double t : times) states.push_back(state_at(t));
    return states;
  };
  made.omissions.emplace_back("A chain has no map: the integrators work on its springs directly.");
  check(made.motion);
  return made;
}

TradeoffScene make_tradeoff_scene(std::string_view name, const std::filesystem::path& meshes) {
  const auto entry = std::ranges::find(table, name, &TradeoffEntry::name);
  if (entry == std::end(table)) {
    std::string known;
    for (const TradeoffEntry& e : table) known += fmt::format("{}{}", known.empty() ? "" : ", ", e.name);
    throw InputError(fmt::format("there is no scene '{}' in the study; there are {}", name, known));
  }
  const std::string what(entry->what);
  const auto liver = [&] { return read_mesh(meshes / "liver564.mesh").mesh; };
  const auto made = [&]() -> TradeoffScene {
    if (name == "chain") return chain_scene(24, smooth_phase);
    if (name == "swing") return tradeoff_scene(what, swing_scene(liver()));
    if (name == "large") {
      TradeoffScene scene = tradeoff_scene(what, smooth_scene(kuhn_box(26, 26, 26, 0.01, 0.2, 1), soft, 64.0));
      return scene;
    }
    if (name.starts_with("stiff"))
      return stiff_scene(what, liver(), name.starts_with("stiff-1e4") ? 1e4 : 1e6,
                         {.damped = name.ends_with("damped")});
    SpringScene scene = smooth_scene(liver(), soft, smooth_phase);
    const double half = 0.5 * scene.duration;
    if (name == "cut")
      scene.events.push_back(plane_cut(half, mean(scene.problem.mesh.points), Eigen::Vector3d(1, 0.25, 0)));
    if (name == "tear") scene.events.push_back(fan_tear(half, most_stressed_point(scene, half)));
    TradeoffScene result = tradeoff_scene(what, scene);
    if (name == "tear")
      result.omissions.emplace_back(
          "The fan is torn at a given time, at the vertex whose stress is largest then: all runs tear alike, and the "
          "time of an event that depends on the state is not studied.");
    return result;
  }();
  TradeoffScene scene = made;
  scene.name = name;
  scene.what = what;
  return scene;
}

}  // namespace dartboard
