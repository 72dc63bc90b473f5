#include "validation/scenes/scene_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/time/implicit/baraff_witkin.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double mass_weighted(const reference::SpringNetwork& network, std::span<const Eigen::Vector3d> column) {
  double sum = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    mass += network.mass[i];
    if (!network.fixed[i]) sum += network.mass[i] * column[i].squaredNorm();
  }
  return std::sqrt(sum / mass);
}

double gershgorin(const reference::SpringNetwork& network) {
  std::vector<double> sum(network.point_count(), 0.0);
  for (const reference::Spring& s : network.springs)
    for (const std::uint32_t i : {s.a, s.b}) sum[i] += s.stiffness;
  double largest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!network.fixed[i]) largest = std::max(largest, 2.0 * sum[i] / network.mass[i]);
  return std::sqrt(largest);
}

/// About sixteen of many events are examined, among them the last: each costs hundreds of force evaluations.
bool is_looked_at(std::size_t interval, std::size_t events) {
  constexpr std::size_t most = 16;
  return events <= most || interval % (events / most) == 0 || interval == events;
}

/// Frequencies and damping of springs alone, for each interval, with the points where they were at the start;
/// frequencies are those without damping, as rates of decay are not frequencies.
void look_at_networks(const TradeoffScene& scene, SceneFeatures& f) {
  const reference::SpringNetwork& start = scene.motion.network;
  std::vector<Eigen::Vector3d> x = scene.motion.start.x;
  for (std::size_t k = 0; k <= scene.motion.events.size(); ++k) {
    if (k > 0) {
      std::vector<Eigen::Vector3d> next;
      for (const std::uint32_t from : scene.motion.events[k - 1].from) next.push_back(x[from]);
      x = std::move(next);
    }
    if (!is_looked_at(k, scene.motion.events.size())) continue;
    reference::SpringNetwork network = scene.motion.network_of(k);
    network.viscosity = 0.0;
    for (reference::Spring& s : network.springs) s.damping = 0.0;
    f.omega_low = std::max(f.omega_low, reference::fastest_rate(network, x));
    f.omega_high = std::max(f.omega_high, gershgorin(network));
  }
  if (!(f.omega_low > 0.0)) f.omega_low = f.omega_high = 1.0 / scene.duration;
  for (const reference::Spring& s : start.springs)
    if (s.stiffness > 0.0) f.damping_ratio = std::max(f.damping_ratio, 0.5 * f.omega_low * s.damping / s.stiffness);
  f.damping_ratio += 0.5 * start.viscosity / f.omega_low;
}

/// The features of any body, from the limits of its step.
void look_at_limits(SceneFeatures& f) {
  for (const StableStep& limit : f.limits) {
    f.omega_low = std::max(f.omega_low, limit.lower);
    f.omega_high = std::max(f.omega_high, limit.upper);
    f.damping_ratio = std::max(f.damping_ratio, limit.damping_ratio().upper);
  }
}

/// The limits of the step at the start, and after each event that is examined.
std::vector<StableStep> limits_of(const TradeoffScene& scene) {
  SceneStage stage(scene);
  std::vector<StableStep> limits{stage.limits()};
  const std::size_t events = scene.motion.events.size();
  for (std::size_t k = 1; k <= events; ++k) {
    stage.pass_event();
    if (is_looked_at(k, events)) limits.push_back(stage.limits());
  }
  return limits;
}

}  // namespace

PieceCounts pieces_of(const SpringSystem& system) {
  PieceCounts pieces;
  for (const ForceTerm* term : system.terms) pieces[std::string(term->pieces_name())] += term->size();
  return pieces;
}

std::string sizes_in_words(std::size_t vertices, std::size_t springs, const PieceCounts& pieces) {
  std::string text = fmt::format("{} vertices", vertices);
  if (springs > 0 || pieces.empty()) text += fmt::format(", {} springs", springs);
  for (const auto& [name, count] : pieces) text += fmt::format(", {} {}", count, name);
  return text;
}

SceneFeatures features_of(const TradeoffScene& scene, const CpuClock& clock, std::int64_t timing_ns) {
  SceneFeatures f;
  const reference::SpringNetwork& start = scene.motion.network;
  f.vertices = start.point_count();
  f.events = scene.motion.events.size();
  f.limits = limits_of(scene);
  if (scene.beyond_references.empty() && start.elements.empty())
    look_at_networks(scene, f);
  else
    look_at_limits(f);
  // without springs and elements, the scale of time is that of the scene
  if (!(f.omega_low > 0.0)) f.omega_low = f.omega_high = 1.0 / scene.duration;
  f.phase = scene.duration * f.omega_low;

  SceneStage stage(scene);
  const SpringSystem system = stage.system();
  f.springs = system.springs.size();
  f.pieces = pieces_of(system);
  std::vector<Eigen::Vector3d> a(f.vertices);
  accelerations(system, terms_of(system), stage.motion().x, stage.motion().v, a);
  const double speed = mass_weighted(start, stage.motion().v), push = mass_weighted(start, a);
  f.motion_rate = speed > 0.0 ? std::min(push / speed, f.omega_low) : f.omega_low;
  if (f.motion_rate == 0.0) f.motion_rate = 1.0 / scene.duration;
  f.motion_size = speed / f.motion_rate / scene.edge;

  ForceTimer force(scene, clock, timing_ns);
  f.force_s = 1e-9 * std::min({force.measure(), force.measure(), force.measure()});
  return f;
}

double implicit_step_seconds(const TradeoffScene& scene, double h, const CpuClock& clock) {
  SceneStage stage(scene);
  BaraffWitkin integrator;
  std::vector<double> s;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t start = clock();
    if (!integrator.step(stage.system(), stage.motion(), h).ok()) return infinity;
    s.push_back(1e-9 * static_cast<double>(clock() - start));
  }
  return std::min(s[1], s[2]);
}

double stability_limit(const Scheme& scheme, const SceneFeatures& f, double duration) {
  double limit = infinity;
  for (const StableStep& step : f.limits) limit = std::min(limit, step.limit(scheme, horizon_of(duration)).stable);
  return limit;
}

}  // namespace dartboard
