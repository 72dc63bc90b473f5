#include "validation/scenes/tradeoff_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "reference/closed_form.h"
#include "validation/frozen/frozen_motion.h"
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

TableScene swing_scene(Mesh mesh) {
  TableScene scene{.name = "swing", .problem = {}};
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

}  // namespace

std::string_view TradeoffScene::equal_steps() const {
  if (has_contact()) return "contact requires equal steps";
  if (frozen && changes_in_every_step(frozen->file)) return "loads that change in time require equal steps";
  return {};
}

bool takes(const TradeoffScene& scene, std::string_view integrator) {
  return !scene.frozen || scene.frozen->file.touches.empty() || integrator != "energy-momentum";
}

std::span<const TradeoffEntry> tradeoff_scenes() { return table; }

TradeoffScene tradeoff_scene(FrozenScene frozen, std::size_t checkpoints) {
  const SceneFile& file = frozen.file;
  FrozenMotion motion = motion_of(frozen, checkpoints);
  TradeoffScene made{
      .name = file.name, .what = file.about.empty() ? file.name : file.about, .motion = std::move(motion.motion)};
  made.beyond_references = beyond_references(file, frozen.problem.mesh);
  made.duration = file.duration;
  made.fastest_rate = motion.fastest_rate;
  if (!(made.fastest_rate > 0.0)) made.fastest_rate = 1.0 / file.duration;  // free flight only
  made.edge = frozen.edge;
  made.omissions = frozen.omissions;
  made.frozen = std::make_shared<FrozenScene>(std::move(frozen));
  return made;
}

TradeoffScene tradeoff_scene(std::string what, const TableScene& scene) {
  SceneFile file{};
  file.file = file.name = scene.name;
  file.about = std::move(what);
  file.material = scene.problem.material;
  file.gravity = scene.problem.surroundings.gravity;
  file.duration = scene.duration;
  file.events = scene.events;
  return tradeoff_scene(freeze(file, scene.problem, scene.initial_position), scene.checkpoints);
}

TradeoffScene stiff_scene(std::string what, Mesh mesh, double factor, const StiffSceneOptions& options) {
  TableScene scene = smooth_scene(std::move(mesh), soft, options.phase);
  scene.checkpoints = options.checkpoints;
  add_inclusion(scene, mean(scene.problem.mesh.points), factor);
  // c = beta k, zeta = beta omega / 2
  if (options.damped) set_damping(scene.problem, 2.0 / tradeoff_scene({}, scene).fastest_rate);
  return tradeoff_scene(std::move(what), scene);
}

TradeoffScene chain_scene(int count, double phase, std::size_t checkpoints) {
  constexpr double stiffness = 50.0, mass = 0.01, spacing = 0.1;
  TradeoffScene made{.name = "chain", .what = "", .motion = {}};
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
  const auto liver = [&] { return read_mesh(meshes / "liver564.mesh"); };
  const auto made = [&]() -> TradeoffScene {
    if (name == "chain") return chain_scene(24, smooth_phase);
    if (name == "swing") return tradeoff_scene(what, swing_scene(liver()));
    if (name == "large") return tradeoff_scene(what, smooth_scene(kuhn_box(26, 26, 26, 0.01, 0.2, 1), soft, 64.0));
    if (name.starts_with("stiff"))
      return stiff_scene(what, liver(), name.starts_with("stiff-1e4") ? 1e4 : 1e6,
                         {.damped = name.ends_with("damped")});
    TableScene scene = smooth_scene(liver(), soft, smooth_phase);
    const double half = 0.5 * scene.duration;
    if (name == "cut") add_cut(scene, half, mean(scene.problem.mesh.points), Eigen::Vector3d(1, 0.25, 0));
    if (name == "tear")
      scene.events.push_back(
          {TearWhereStressed{std::numeric_limits<double>::min(), {}, 1}, half, half, {}, "/events/0"});
    return tradeoff_scene(what, scene);
  }();
  TradeoffScene scene = made;
  scene.name = name;
  scene.what = what;
  return scene;
}

}  // namespace dartboard
