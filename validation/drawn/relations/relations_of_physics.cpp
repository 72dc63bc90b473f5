// What motions keep, and what they come to: laws of mechanics, limits of short steps, and the promise of sleep.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"
#include "core/scene/file/selections/selection.h"
#include "validation/drawn/changed_scene.h"
#include "validation/drawn/relations/comparison.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

/// [s] The time within a run in which a force acts, each moment by its factor.
double acting_time(const SceneForce& force, double duration) {
  const double begin = force.from, end = std::min(force.until.value_or(duration), duration);
  if (end <= begin) return 0.0;
  if (force.factor.empty()) return end - begin;
  const auto factor_at = [&](double t) {
    const auto &at = force.factor.at, &value = force.factor.value;
    if (t <= at.front()) return value.front();
    for (std::size_t k = 1; k < at.size(); ++k)
      if (t <= at[k]) return value[k - 1] + (value[k] - value[k - 1]) * (t - at[k - 1]) / (at[k] - at[k - 1]);
    return value.back();
  };
  std::vector<double> times{begin, end};
  for (const double t : force.factor.at)
    if (t > begin && t < end) times.push_back(t);
  std::ranges::sort(times);
  double sum = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k)
    sum += 0.5 * (factor_at(times[k - 1]) + factor_at(times[k])) * (times[k] - times[k - 1]);
  return sum;
}

/// [kg] Of the vertices that a force acts on, and all parts of them.
double mass_of(const JudgedScene& s, const VertexSelection& vertices, const std::string& path) {
  const std::vector<std::uint32_t> points = select_points(vertices, s.mesh().points, path);
  const Quantity &masses = last_named(s.motion(), "masses"), &numbers = last_named(s.motion(), "numbers of points");
  double sum = 0.0;
  for (std::size_t k = 0; k < masses.values.size(); ++k)
    if (std::ranges::find(points, numbers.values[k]) != points.end()) sum += masses.values[k];
  return sum;
}

RelationFound judge_momentum(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (!file.fixed.empty() || !file.driven.empty()) return does_not_apply("something holds it");
  if (!file.obstacles.empty()) return does_not_apply("obstacles push it");
  if (file.material.viscosity > 0.0) return does_not_apply("viscosity brakes it");
  if (file.air) return does_not_apply("air brakes and carries it");
  if (file.sleep) return does_not_apply("sleep takes momentum");
  if (!file.touches.empty() && s.scheme().linearized)
    return does_not_apply("where bodies touch, the tangent has blocks of each alone, which changes momentum");
  if (std::ranges::any_of(file.attachments, [](const SceneAttachment& a) { return !a.to; }))
    return does_not_apply("it is attached to space");
  for (const SceneEvent& event : file.events)
    if (std::holds_alternative<Remove>(event.action)) return does_not_apply("cells are removed with their momentum");
  for (const SceneForce& force : file.forces) {
    if (force.pressure || force.traction)
      return does_not_apply("the momentum of a pressure or a traction is not known");
    if (!s.scheme().one_step && !force.factor.empty())
      return does_not_apply("its integrator takes a load that changes from several steps");
  }
  const DrawnMotion& motion = s.motion();
  const Quantity &first = first_named(motion, "momentum"), &last = last_named(motion, "momentum");
  const double begin = first_named(motion, "time").values[0], end = last_named(motion, "time").values[0];
  const double mass = last_named(motion, "mass at").values[0];
  Vector3d expected = Vector3d::Map(first.values.data()) + mass * (end - begin) * file.gravity;
  for (const SceneForce& force : file.forces) {
    const double acts = acting_time(force, end) - acting_time(force, begin);
    if (force.force) expected += acts * *force.force;
    if (force.acceleration) expected += acts * mass_of(s, force.vertices, force.path) * *force.acceleration;
  }
  const Quantity &velocities = last_named(motion, "velocities at"), &masses = last_named(motion, "masses");
  double moved = expected.norm();
  for (std::size_t k = 0; k < masses.values.size(); ++k)
    moved += masses.values[k] * Vector3d::Map(velocities.values.data() + 3 * k).norm();
  const double difference = (Vector3d::Map(last.values.data()) - expected).norm();
  // an integrator that chooses its steps may take thousands, each with its rounding
  const double bound = (s.scheme().implicit ? 1e-5 : s.is_adaptive() ? 1e-11 : 1e-12) * moved;
  if (difference <= bound) return {};
  return breaks(fmt::format("the momentum is {:.3g} kg m/s off, of {:.3g} of all vertices, where {:.3g} is allowed",
                            difference, moved, bound));
}

RelationFound judge_limit(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (!file.events.empty()) return does_not_apply("an event may choose other cells in other steps");
  if (file.sleep) return does_not_apply("sleep changes the motion on purpose");
  if (file.unstable_step == UnstableStep::substep) return does_not_apply("its steps are divided already");
  if (file.integrator == "rk4") return does_not_apply("it is compared with itself");
  const auto rk4 = [&](int parts) {
    Json scene = with_rk4(in_shorter_steps(s.json(), parts));
    scene.erase("unstable_step");
    return s.run(scene, {.parts = static_cast<std::uint64_t>(parts)});
  };
  const DrawnMotion &once = s.in_shorter_steps(4), &twice = s.in_shorter_steps(8), &best = s.in_shorter_steps(16);
  const DrawnMotion other_once = rk4(8), other = rk4(16);
  for (const DrawnMotion* one : {&once, &twice, &best, &other_once, &other})
    if (!one->end.empty()) return does_not_apply("a run ends early");
  const double first = distance(once, twice), second = distance(twice, best), least = 1e-7 * s.scales().length;
  if (!(second <= 0.75 * first + least)) return does_not_apply("its steps are too long to come near to a limit");
  // a method of first order has still the last difference to go
  const double bound = 4.0 * (second + distance(other_once, other)) + least;
  const double found = distance(best, other);
  if (found <= bound) return {};
  return breaks(fmt::format(
      "a sixteenth of the step comes {:.3g} m from rk4, where the differences of halved steps allow {:.3g} m", found,
      bound));
}

/// [J] What no motion should change, at the times of a run: all energies, and what contact has taken from them.
std::vector<double> accounts_of(const DrawnMotion& motion, double& largest) {
  std::vector<double> sums;
  for (const Quantity& q : motion.quantities) {
    if (q.unit != dimensions_of("J") || q.name.starts_with("energy of sleepers")) continue;
    if (q.kind != Quantity::Kind::scalars) continue;
    if (q.name.starts_with("kinetic")) sums.push_back(0.0);
    // of contact: its energy, what restitution and friction took, and what obstacles have supplied
    const bool is_of_contact = q.name.starts_with("energies of contact");
    for (std::size_t k = 0; k < q.values.size(); ++k) {
      sums.back() += is_of_contact && k == 3 ? -q.values[k] : q.values[k];
      if (!q.name.starts_with("energy of gravity")) largest = std::max(largest, std::abs(q.values[k]));
    }
  }
  return sums;
}

RelationFound judge_energy(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (file.material.viscosity > 0.0) return does_not_apply("viscosity takes energy that is not counted");
  if (s.is_damped()) return does_not_apply("damping takes energy that is not counted");
  if (!file.driven.empty()) return does_not_apply("drives supply energy that is not counted");
  if (std::ranges::any_of(file.forces, [](const SceneForce& f) { return f.from > 0.0 || f.until; }))
    return does_not_apply("a force that begins or ends has its potential only meanwhile");
  if (!file.events.empty()) return does_not_apply("an event takes energy");
  if (file.sleep) return does_not_apply("sleep takes energy");
  if (file.unstable_step == UnstableStep::substep) return does_not_apply("its steps are divided already");
  if (s.scheme().implicit && !s.scheme().symmetric)
    return does_not_apply("its method takes the energy of motions that are fast for its step");
  const DrawnMotion &coarse = s.in_shorter_steps(4), &fine = s.in_shorter_steps(16);
  if (!coarse.end.empty() || !fine.end.empty()) return does_not_apply("a run ends early");
  double largest = 0.0;
  const auto drift_of = [&largest](const DrawnMotion& motion) {
    const std::vector<double> sums = accounts_of(motion, largest);
    const auto [least, most] = std::ranges::minmax(sums);
    return most - least;
  };
  const double before = drift_of(coarse), after = drift_of(fine);
  // where the nearest face becomes another one, the force jumps
  const double share = file.touches.empty() && !s.has_box_obstacle() ? 1e-4 : 3e-2;
  if (after <= 0.6 * before + share * largest + 1e-12 * s.scales().of(dimensions_of("J"))) return {};
  return breaks(
      fmt::format("in steps a sixteenth as long the sum of all energies changes by {:.3g} J, of {:.3g}, and in "
                  "steps a quarter as long by {:.3g} J",
                  after, largest, before));
}

constexpr int still = 8;  // steps at the start

/// The scene without motion for some steps, stepped so that each component has a motion of its own.
Json begun_at_rest(const JudgedScene& s) {
  Json scene = with_late_start(s.json(), still);
  scene.erase("sleep");
  scene.erase("unstable_step");
  return s.steps_all_as_one() ? with_rk4(scene) : scene;
}

/// Does a scene move alike where its components sleep as soon as they are at rest?
RelationFound unless_asleep(const JudgedScene& s, const Json& scene) {
  DrawnMotion awake;
  try {
    awake = s.run(scene);
  } catch (const InputError&) {
    return does_not_apply("an event is refused in this motion");
  }
  if (!awake.end.empty()) return does_not_apply("the run ends early");
  Json with_sleep = scene;
  with_sleep["sleep"] = {{"speed", 1e-9 * s.scales().length / s.file().duration}, {"time", 1.5 * s.file().step}};
  DrawnMotion slept = s.run(with_sleep);
  bool any = false;
  std::erase_if(slept.quantities, [&any](const Quantity& q) {
    any = any || (q.name.starts_with("components asleep") && q.values[1] > 0.0);
    return q.name.starts_with("components asleep") || q.name.starts_with("energy of sleepers");
  });
  if (!any) return does_not_apply("nothing of it is at rest without loads");
  // the disturbance is a sixteenth of what is taken from each velocity
  auto allowed = allowances(awake, s.run(with_disturbance(scene, 0x1p-34, s.scales().length)), s.scales(), 1024.0);
  if (!allowed) return does_not_apply("rounding decides what happens to it");
  for (std::size_t k = 0; k < allowed->size(); ++k) {
    const Quantity& q = awake.quantities[k];
    double largest = s.scales().of(q.unit);
    for (const Quantity& other : awake.quantities)
      if (other.unit == q.unit)
        for (const double x : other.values) largest = std::max(largest, std::abs(x));
    if (q.kind != Quantity::Kind::numbers) (*allowed)[k] = std::max((*allowed)[k], 1e-4 * largest);
  }
  const auto difference = differs_by_more(awake, slept, *allowed);
  if (difference && (has<Tear>(s.file().events) || has<TearWhereStressed>(s.file().events)))
    return does_not_apply("rounding decides where it tears");
  return unless(difference);
}

RelationFound judge_sleep(const JudgedScene& s) {
  if (s.file().duration == 0.0) return does_not_apply("it has no duration");
  Json scene = begun_at_rest(s);
  // one body runs into those that sleep
  if (scene.contains("bodies") && scene["bodies"].size() > 1)
    scene["bodies"][0]["initial_velocity"] = {0.3 * s.scales().length / s.file().duration, 0, 0};
  return unless_asleep(s, scene);
}

RelationFound judge_sleep_under_load(const JudgedScene& s) {
  if (s.file().duration == 0.0) return does_not_apply("it has no duration");
  if (s.file().gravity.isZero(0.0)) return does_not_apply("nothing has a weight");
  if (has<Refine>(s.file().events)) return does_not_apply("no force acts on what is refined");
  Json scene = begun_at_rest(s);
  const Vector3d& g = s.file().gravity;
  scene["gravity"] = {g.x(), g.y(), g.z()};
  const Json all{{"centre", {0, 0, 0}}, {"radius", 1e6 * (s.scales().length + s.mesh().points[0].norm())}};
  scene["forces"].push_back(
      {{"sphere", all}, {"acceleration", {-g.x(), -g.y(), -g.z()}}, {"until", still * s.file().step}});
  return unless_asleep(s, scene);
}

}  // namespace

std::vector<Relation> relations_of_physics() {
  return {
      {"sleep", "at rest before loads begin, but for a body that runs into others: with and without sleep", "1e-4",
       judge_sleep},
      {"sleep-under-load", "its weight carried by a load that ends, with and without sleep", "1e-4",
       judge_sleep_under_load},
      {"momentum", "it changes by gravity and forces",
       "1e-12 of the momenta of all vertices; 1e-11 in steps of its own choice, 1e-5 with an implicit integrator",
       judge_momentum},
      {"energy", "energies and losses of contact add up to the same",
       "0.6 of what they change in steps four times as long, and 1e-4 of the largest, 3e-2 where bodies touch or run into a box",
       judge_energy},
      {"limit", "short steps, and those of rk4, come to one place",
       "4 times what halving both steps once more changes, and 1e-7 of the size", judge_limit},
  };
}

}  // namespace dartboard
