#include "validation/drawn/relations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/recorded_run.h"
#include "core/time/integrators.h"
#include "validation/drawn/changed_scene.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

RelationFound breaks(std::string words) { return {RelationOutcome::breaks, std::move(words)}; }
RelationFound does_not_apply(std::string words) { return {RelationOutcome::does_not_apply, std::move(words)}; }
RelationFound unless(const std::optional<std::string>& difference) {
  return difference ? breaks(*difference) : RelationFound{};
}

DrawnMotion without(DrawnMotion motion, std::string_view name) {
  std::erase_if(motion.quantities, [name](const Quantity& q) { return q.name.starts_with(name); });
  return motion;
}

// ---- the same bits

RelationFound judge_repeated(const JudgedScene& s) { return unless(different_bits(s.motion(), s.run(s.json()))); }
RelationFound judge_lanes(const JudgedScene& s) {
  return unless(different_bits(s.motion(), s.run(s.json(), {.lanes = false})));
}
RelationFound judge_threads(const JudgedScene& s) {
  return unless(different_bits(s.motion(), s.run(s.json(), {.threads = 3})));
}
RelationFound judge_continued(const JudgedScene& s) {
  return unless(different_bits(s.motion(), s.run(s.json(), {.continued = true})));
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

RelationFound judge_files(const JudgedScene& s) {
  if (s.scratch().empty()) return does_not_apply("there is no folder for files");
  const fs::path whole = s.scratch() / "whole", parts = s.scratch() / "parts";
  fs::remove_all(whole);
  fs::remove_all(parts);
  Json scene = s.json();
  // states that it can go on from
  if (!scene.contains("output")) scene["output"] = Json::object();
  if (!scene["output"].contains("checkpoint")) scene["output"]["checkpoint"] = 3.0 * s.file().step;
  const auto read = [&] {
    SceneFile file = parse_scene(scene.dump(), "scene", s.folder());
    load_mesh(file);
    return file;
  };
  RecordedRun(read(), {.folder = whole}).run();
  const auto half = static_cast<std::uint64_t>(std::max(1.0, std::floor(0.5 * s.file().duration / s.file().step)));
  bool goes_on = false;
  {
    RecordedRun begun(read(), {.folder = parts, .most_steps = half});
    begun.run();
    goes_on = begun.continues_after().has_value();
  }
  if (goes_on) RecordedRun::continued(parts).run();
  std::set<std::string> names;
  for (const fs::path& folder : {whole, parts})
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().filename() != checkpoint_name)
        names.insert(entry.path().lexically_relative(folder).string());
  for (const std::string& name : names)
    if (bytes_of(whole / name) != bytes_of(parts / name)) return breaks(name + " has other bytes");
  return {};
}

/// Of a motion the quantities that another one has.
DrawnMotion like(DrawnMotion motion, const DrawnMotion& other) {
  std::erase_if(motion.quantities, [&other](const Quantity& q) {
    return std::ranges::find(other.quantities, q.name, &Quantity::name) == other.quantities.end();
  });
  return motion;
}

/// The scene in shorter steps, of a whole number to each of its own.
Json in_shorter_steps(const JudgedScene& s, int parts) {
  Json scene = s.json();
  const double steps = std::ceil(s.file().duration / s.file().step * (1.0 - 1e-12));
  scene["step"] = s.file().step / parts;
  scene["duration"] = steps * s.file().step;
  return scene;
}

/// Is the difference of two runs one of rounding? `own` are the quantities of the scene's motion that are expected in
/// another form. Where `order_counts`, as that of dampers or of contacts with losses, four times what halving the step
/// changes is allowed, too.
RelationFound unless_rounding(const JudgedScene& s, const DrawnMotion& own, const DrawnMotion& expected,
                              const DrawnMotion& found, bool order_counts) {
  constexpr double share = 0x1p-34;
  std::optional<DrawnMotion> halved;
  if (order_counts) {
    if (!s.file().events.empty()) return does_not_apply("an order counts, and an event");
    halved = like(s.run(in_shorter_steps(s, 2), {.parts = 2}), own);
    if (halved->end != own.end || halved->quantities.size() != own.quantities.size())
      return does_not_apply("an order counts, and the step");
  }
  for (const double sign : {1.0, -1.0}) {
    auto allowed =
        allowances(own, like(s.run(with_disturbance(s.json(), sign * share, s.scales().length)), own), s.scales());
    if (!allowed) return does_not_apply("rounding decides what happens to it");
    if (halved) add_differences(*allowed, own, *halved, 4.0);
    const auto difference = differs_by_more(expected, found, *allowed);
    if (!difference || sign < 0.0) return unless(difference);
  }
  return {};
}

RelationFound judge_units(const JudgedScene& s) {
  // even powers, so that square roots are exact, too
  const Dimensions powers{s.dimension() ? 2 : 0, -2, 4};
  const DrawnMotion found =
      in_units(s.run(in_units(s.json(), powers, s.dimension())), {-powers.length, -powers.time, -powers.mass});
  // rows of fixed vertices in a matrix have no unit
  if (s.is_implicit()) return unless_rounding(s, s.motion(), s.motion(), found, s.is_swept());
  return unless(different_bits(s.motion(), found));
}

RelationFound judge_idle_event(const JudgedScene& s) {
  if (s.file().is_chain()) return does_not_apply("nothing happens to chains");
  if (s.file().unstable_step != UnstableStep::warn && s.file().has_contact())
    return does_not_apply("an event counts in the forecast of contacts, by which steps are refused or divided");
  // corners of cells are listed from other ones on
  const DrawnMotion expected = without(s.motion(), "corners"),
                    found = without(s.run(with_idle_event(s.json())), "corners");
  if (std::ranges::any_of(s.file().forces, &SceneForce::follows))
    return unless_rounding(s, expected, expected, found, s.is_swept());
  return unless(different_bits(expected, found));
}

RelationFound judge_list(const JudgedScene& s) {
  if (!s.json().contains("body")) return does_not_apply("its bodies are a list");
  if (names_numbers(s.json()))
    return does_not_apply("it has numbers of points or cells, which scenes of bodies have not");
  return unless(different_bits(s.motion(), s.run(with_list_of_bodies(s.json()))));
}

/// Why bodies cannot be added or exchanged; empty where they can.
std::string counts_bodies_together(const JudgedScene& s) {
  const std::string text = s.json().dump();
  if (names_numbers(s.json())) return "it has numbers of points or cells, which scenes of bodies have not";
  if (text.find("\"random\"") != std::string::npos) return "cells are drawn from all bodies";
  if (text.find("\"most_per_step\"") != std::string::npos) return "tears are counted in all bodies";
  if (has<Refine>(s.file().events)) return "vertices of refinement have no body";
  if (has<Remove>(s.file().events)) return "parts of vertices change places where cells are removed";
  return "";
}

RelationFound judge_opposite_order(const JudgedScene& s) {
  const std::size_t count = s.file().bodies().size();
  if (count == 1) return does_not_apply("it is one body");
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (const std::string reason = counts_bodies_together(s); !reason.empty()) return does_not_apply(reason);
  // of each point of the bodies in the opposite order
  std::vector<std::size_t> number;
  for (std::size_t body = count; body-- > 0;)
    for (std::size_t p = s.first_points()[body]; p < s.first_points()[body + 1]; ++p) number.push_back(p);
  const DrawnMotion own = first_of(s.motion(), s.motion());
  return unless_rounding(s, own, own, like(in_order_of(s.run(with_opposite_order(s.json())), number), own),
                         s.is_swept() || s.has_losses());
}

/// [m] The root mean square of the difference of positions, at the time at which it is largest.
double distance(const DrawnMotion& a, const DrawnMotion& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(a.quantities.size(), b.quantities.size()); ++k) {
    const std::vector<double>&x = a.quantities[k].values, &y = b.quantities[k].values;
    if (!a.quantities[k].name.starts_with("positions") || x.empty()) continue;
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(x[i] - y[i], 2);
    largest = std::max(largest, std::sqrt(3.0 * sum / static_cast<double>(x.size())));
  }
  return largest;
}

/// Does the integrator not iterate until its equations are solved? Then a tangent that is no derivative changes the
/// motion.
bool is_linear(const SceneFile& file) {
  static constexpr std::array linear{"local-global", "ros2", "baraff-witkin"};
  return std::ranges::find(linear, file.integrator) != linear.end();
}

RelationFound judge_moving_frame(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (!file.fixed.empty() || !file.driven.empty()) return does_not_apply("something holds it in space");
  if (std::ranges::any_of(file.attachments, [](const SceneAttachment& a) { return !a.to; }))
    return does_not_apply("it is attached to space");
  if (std::ranges::any_of(file.obstacles, &SceneObstacle::moves)) return does_not_apply("an obstacle moves");
  if (file.material.viscosity > 0.0) return does_not_apply("viscosity is that of surroundings at rest");
  if (file.sleep) return does_not_apply("what moves with the frame does not sleep");
  if (!file.events.empty()) return does_not_apply("events choose by place");
  if (file.duration == 0.0) return does_not_apply("it has no duration");
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (is_linear(file) && (!file.touches.empty() || std::ranges::any_of(file.forces, &SceneForce::follows)))
    return does_not_apply("its tangent of contacts, or of pressures along current normals, is no derivative");
  if (file.solver == "conjugate-gradients") return does_not_apply("its solver's tolerance is a share of velocities");
  if (file.unstable_step != UnstableStep::warn && file.has_contact())
    return does_not_apply("its speed counts in the forecast of contacts, by which steps are refused or divided");
  const Vector3d place = s.scales().length * Vector3d(0.37, -0.23, 0.31);
  const Vector3d velocity = s.scales().length / file.duration * Vector3d(0.19, 0.41, -0.29);
  const auto run = [&](int parts) {
    const Json moving = in_moving_frame(in_shorter_steps(s, parts), place, velocity);
    return out_of_moving_frame(s.run(moving, {.parts = static_cast<std::uint64_t>(parts)}), place, velocity);
  };
  if (file.obstacles.empty()) {
    const DrawnMotion own = first_of(s.motion(), s.motion());
    return unless_rounding(s, own, own, like(run(1), own), s.is_swept());
  }
  // an obstacle that moves stands still within a step
  const double before = distance(s.motion(), run(1));
  const double after = distance(s.run(in_shorter_steps(s, 4), {.parts = 4}), run(4));
  if (after <= 0.6 * before + 1e-6 * s.scales().length) return {};
  return breaks(
      fmt::format("in steps a quarter as long positions are {:.3g} m apart, and {:.3g} m in its own", after, before));
}

RelationFound judge_far_body(const JudgedScene& s) {
  if (const std::string reason = counts_bodies_together(s); !reason.empty()) return does_not_apply(reason);
  if (s.is_implicit() || s.is_adaptive()) return does_not_apply("its integrator has one tolerance for all bodies");
  if (s.is_swept()) return does_not_apply("the order of dampers counts, and it is that of all bodies");
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (s.file().bending.any()) return does_not_apply("the other body would resist bending, too");
  if (s.file().unstable_step != UnstableStep::warn) return does_not_apply("its steps depend on all bodies");
  const std::optional<Json> with =
      with_body_far_away(s.json(), s.scales().length, s.scales().mass, s.dimension().value_or(3));
  if (!with) return does_not_apply("its planes reach everywhere");
  const DrawnMotion found = s.run(*with), expected = first_of(s.motion(), found);
  return unless_rounding(s, expected, expected, first_of(found, expected), s.is_swept());
}

// ---- rounding

RelationFound judge_axes(const JudgedScene& s) {
  return unless_rounding(s, s.motion(), in_turned_axes(s.motion()), s.run(in_turned_axes(s.json())), s.is_swept());
}

// ---- physics

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

RelationFound judge_momentum(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (!file.fixed.empty() || !file.driven.empty()) return does_not_apply("something holds it");
  if (!file.obstacles.empty()) return does_not_apply("obstacles push it");
  if (file.material.viscosity > 0.0) return does_not_apply("viscosity brakes it");
  if (file.sleep) return does_not_apply("sleep takes momentum");
  if (!file.touches.empty() && is_linear(file))
    return does_not_apply("where bodies touch, the tangent has blocks of each alone, which changes momentum");
  if (std::ranges::any_of(file.attachments, [](const SceneAttachment& a) { return !a.to; }))
    return does_not_apply("it is attached to space");
  for (const SceneEvent& event : file.events)
    if (std::holds_alternative<Remove>(event.action)) return does_not_apply("cells are removed with their momentum");
  for (const SceneForce& force : file.forces)
    if (!force.force && !force.torque)
      return does_not_apply("the momentum of a pressure or an acceleration is not known");
  const auto of = [&](std::string_view name, bool last) -> const Quantity& {
    const Quantity* found = nullptr;
    for (const Quantity& q : s.motion().quantities)
      if (q.name.starts_with(name) && (found == nullptr || last)) found = &q;
    return *found;
  };
  const Quantity &first = of("momentum", false), &last = of("momentum", true);
  const double begin = of("time", false).values[0], end = of("time", true).values[0];
  const double mass = of("mass at", true).values[0];
  Vector3d expected = Vector3d::Map(first.values.data()) + mass * (end - begin) * file.gravity;
  for (const SceneForce& force : file.forces)
    if (force.force) expected += (acting_time(force, end) - acting_time(force, begin)) * *force.force;
  const Quantity &velocities = of("velocities at", true), &masses = of("masses", true);
  double moved = expected.norm();
  for (std::size_t k = 0; k < masses.values.size(); ++k)
    moved += masses.values[k] * Vector3d::Map(velocities.values.data() + 3 * k).norm();
  const double difference = (Vector3d::Map(last.values.data()) - expected).norm();
  const double bound = (s.is_implicit() ? 1e-5 : 1e-12) * moved;
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
  const auto run = [&](const char* integrator, int parts) {
    Json scene = in_shorter_steps(s, parts);
    if (integrator != nullptr) {
      scene["integrator"] = integrator;
      scene.erase("solver");
    }
    return s.run(scene, {.parts = static_cast<std::uint64_t>(parts)});
  };
  const DrawnMotion once = run(nullptr, 4), twice = run(nullptr, 8), best = run(nullptr, 16);
  const DrawnMotion other_once = run("rk4", 8), other = run("rk4", 16);
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
  if (std::ranges::any_of(file.tissues(), [](const SceneFile::Tissue& tissue) {
        return tissue.material.damping > 0.0 || tissue.material.damping_time > 0.0;
      }))
    return does_not_apply("damping takes energy that is not counted");
  if (!file.driven.empty()) return does_not_apply("drives supply energy that is not counted");
  if (std::ranges::any_of(file.forces, [](const SceneForce& f) { return f.from > 0.0 || f.until; }))
    return does_not_apply("a force that begins or ends has its potential only meanwhile");
  if (!file.events.empty()) return does_not_apply("an event takes energy");
  if (file.sleep) return does_not_apply("sleep takes energy");
  if (file.unstable_step == UnstableStep::substep) return does_not_apply("its steps are divided already");
  // of first order, for motions that they damp
  static constexpr std::array dissipative{"local-global", "backward-euler", "baraff-witkin"};
  if (std::ranges::find(dissipative, file.integrator) != dissipative.end())
    return does_not_apply("its method takes energy");
  const auto run = [&](int parts) {
    return s.run(in_shorter_steps(s, parts), {.parts = static_cast<std::uint64_t>(parts)});
  };
  const DrawnMotion coarse = run(4), fine = run(16);
  if (!coarse.end.empty() || !fine.end.empty()) return does_not_apply("a run ends early");
  double largest = 0.0;
  const auto drift_of = [&largest](const DrawnMotion& motion) {
    const std::vector<double> sums = accounts_of(motion, largest);
    const auto [least, most] = std::ranges::minmax(sums);
    return most - least;
  };
  const double before = drift_of(coarse), after = drift_of(fine);
  if (after <= 0.6 * before + 1e-4 * largest + 1e-12 * s.scales().of(dimensions_of("J"))) return {};
  return breaks(
      fmt::format("in steps a sixteenth as long the sum of all energies changes by {:.3g} J, of {:.3g}, and in "
                  "steps a quarter as long by {:.3g} J",
                  after, largest, before));
}

RelationFound judge_sleep(const JudgedScene& s) {
  constexpr int still = 8;
  if (s.is_implicit() || s.is_adaptive()) return does_not_apply("its integrator has one tolerance for all components");
  if (s.is_swept()) return does_not_apply("the order of dampers counts, and it is that of what is awake");
  if (s.file().duration == 0.0) return does_not_apply("it has no duration");
  Json scene = with_late_start(s.json(), still);
  scene.erase("sleep");
  scene.erase("unstable_step");
  const DrawnMotion awake = s.run(scene);
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
  if (!allowances(awake, s.run(with_disturbance(scene, 0x1p-34, s.scales().length)), s.scales()))
    return does_not_apply("rounding decides what happens to it");
  Allowances allowed;
  for (const Quantity& q : awake.quantities) {
    double largest = s.scales().of(q.unit);
    for (const Quantity& other : awake.quantities)
      if (other.unit == q.unit)
        for (const double x : other.values) largest = std::max(largest, std::abs(x));
    // what is removed at that speed, grown with the motion
    allowed.push_back(q.kind == Quantity::Kind::numbers ? 0.0 : 1e-5 * largest);
  }
  return unless(differs_by_more(awake, slept, allowed));
}

}  // namespace

JudgedScene::JudgedScene(Json json, fs::path folder, fs::path scratch)
    : json_(std::move(json)), folder_(std::move(folder)), scratch_(std::move(scratch)) {
  file_ = parse_scene(json_.dump(), "scene", folder_);
  if (file_.accuracy) file_.fail("/accuracy", "leaves the step to whole studies", "'step' in its place");
  load_mesh(file_);
  swept_ = make_integrator(file_.integrator)->scheme().sweeps &&
           std::ranges::any_of(file_.tissues(), [](const SceneFile::Tissue& tissue) {
             return tissue.material.damping > 0.0 || tissue.material.damping_time > 0.0;
           });
  implicit_ = make_integrator(file_.integrator)->scheme().implicit;
  const Problem problem = make_problem(file_);
  first_points_ = problem.bodies.point;
  std::set<int> dimensions;
  for (const CellKind kind : problem.mesh.kinds) dimensions.insert(dartboard::dimension(kind));
  if (!problem.mesh.links.empty()) dimensions.insert(1);
  if (dimensions.size() == 1) dimension_ = *dimensions.begin();
  Vector3d low = problem.mesh.points.at(0), high = low;
  for (const Vector3d& x : problem.mesh.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  motion_ = run(json_);
  double mass = 0.0;
  for (const Quantity& q : motion_.quantities)
    if (q.name.starts_with("mass at")) mass = std::max(mass, q.values[0]);
  // where events at the start leave nothing, nothing is compared
  scales_ = {(high - low).maxCoeff(), file_.step, mass > 0.0 ? mass : 1.0};
}

bool JudgedScene::has_losses() const {
  const auto is_lossy = [](const auto& one) { return one.law.friction > 0.0 || one.law.restitution < 1.0; };
  return std::ranges::any_of(file_.obstacles, is_lossy) || std::ranges::any_of(file_.touches, is_lossy);
}

DrawnMotion JudgedScene::run(const Json& json, const DrawnRunOptions& options) const {
  return run_drawn(json, folder_, options);
}

std::span<const Relation> relations() {
  static constexpr std::array all{
      Relation{"repeated", "run again", "same bits", judge_repeated},
      Relation{"lanes", "one number at a time in place of four", "same bits", judge_lanes},
      Relation{"threads", "three threads in place of one", "same bits", judge_threads},
      Relation{"continued", "its state is written halfway, and another simulation goes on from it", "same bits",
               judge_continued},
      Relation{"files", "stopped, and continued from its checkpoint: all files", "same bytes", judge_files},
      Relation{"units", "lengths, times and masses in other units, powers of two", "same bits but for exponents",
               judge_units},
      Relation{"idle-event", "with an event that changes nothing, which keeps the map",
               "same bits; where a pressure follows its faces, rounding", judge_idle_event},
      Relation{"list", "the body as the only one of a list", "same bits", judge_list},
      Relation{"opposite-order", "bodies listed in the opposite order", "rounding", judge_opposite_order},
      Relation{"moving-frame", "seen from a frame elsewhere that moves",
               "rounding; with obstacles, 0.6 of what differs in steps four times as long, and 1e-6 of the size",
               judge_moving_frame},
      Relation{"far-body", "with another body far away", "rounding", judge_far_body},
      Relation{"axes", "y, z and x called x, y and z", "rounding", judge_axes},
      Relation{"sleep", "at rest for eight steps before it starts, with and without sleep", "1e-5", judge_sleep},
      Relation{"momentum", "it changes by gravity and forces",
               "1e-12 of the momenta of all vertices; 1e-5 with an implicit integrator", judge_momentum},
      Relation{"energy", "energies and losses of contact add up to the same",
               "0.6 of what they change in steps four times as long, and 1e-4 of the largest", judge_energy},
      Relation{"limit", "short steps, and those of rk4, come to one place",
               "4 times what halving both steps once more changes, and 1e-7 of the size", judge_limit},
  };
  return all;
}

}  // namespace dartboard
