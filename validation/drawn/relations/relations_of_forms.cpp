// The same scene written otherwise: the same motion, to the bits where the same sums are made.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "validation/drawn/changed_scene.h"
#include "validation/drawn/relations/comparison.h"
#include "validation/drawn/written_meshes.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

DrawnMotion without(DrawnMotion motion, std::string_view name) {
  std::erase_if(motion.quantities, [name](const Quantity& q) { return q.name.starts_with(name); });
  return motion;
}

DrawnMotion whole(const DrawnMotion& motion) { return motion; }
// corners of cells may be listed from other ones on
DrawnMotion without_corners(const DrawnMotion& motion) { return without(motion, "corners"); }
DrawnMotion of_vertices(const DrawnMotion& motion) { return first_of(motion, motion); }

/// What vertices have, by their numbers in the scene: `number` has that of each number of a run in which others are
/// used.
DrawnMotion by_number(const DrawnMotion& motion, const std::vector<std::size_t>& number) {
  DrawnMotion some = by_vertex(motion);
  if (!number.empty()) some = in_order_of(std::move(some), number);
  return first_of(some, some);
}
DrawnMotion by_number(const DrawnMotion& motion) { return by_number(motion, {}); }

constexpr std::string_view has_numbers = "it has numbers of points or cells";

/// Is a vertex held to the cells of a body? Of those that are equally near it is the first one.
bool is_held_to_cells(const JudgedScene& s) {
  return std::ranges::any_of(s.file().attachments, [](const SceneAttachment& a) { return a.to.has_value(); });
}
/// Does a step depend on a tangent that is no derivative, and so on how it is put together?
bool depends_on_tangent(const JudgedScene& s) {
  return s.scheme().linearized &&
         (!s.file().touches.empty() || std::ranges::any_of(s.file().forces, &SceneForce::follows));
}
constexpr std::string_view no_derivative =
    "its tangent of contacts, or of pressures along current normals, is no derivative";
constexpr std::string_view first_edge = "refinement takes the first of the edges that are equally long";
/// What of the scene the order of cells and corners decides; empty for nothing.
std::string decided_by_numbers(const JudgedScene& s) {
  const auto& events = s.file().events;
  if (is_held_to_cells(s)) return "an attachment takes the first of the nearest cells";
  if (has<Refine>(events)) return std::string(first_edge);
  if (has<Tear>(events) || has<TearWhereStressed>(events))
    return "a tear begins with the first of the faces that are equally near to its plane";
  return "";
}

RelationFound judge_units(const JudgedScene& s) {
  // even powers, so that square roots are exact, too
  const Dimensions powers{s.dimension() ? 2 : 0, -2, 4};
  const DrawnMotion found =
      in_units(s.run(in_units(s.json(), powers, s.dimension())), {-powers.length, -powers.time, -powers.mass});
  // rows of fixed vertices in a matrix have no unit
  if (s.scheme().implicit) return unless_rounding(s, whole, found, s.is_swept());
  return unless(different_bits(s.motion(), found));
}

RelationFound judge_idle_event(const JudgedScene& s) {
  if (s.file().is_chain()) return does_not_apply("nothing happens to chains");
  if (s.file().unstable_step != UnstableStep::warn && s.file().has_contact())
    return does_not_apply("an event counts in the forecast of contacts, by which steps are refused or divided");
  const DrawnMotion found = without_corners(s.run(with_idle_event(s.json())));
  if (std::ranges::any_of(s.file().forces, &SceneForce::follows))
    return unless_rounding(s, without_corners, found, s.is_swept());
  return unless(different_bits(without_corners(s.motion()), found));
}

RelationFound judge_event_times(const JudgedScene& s) {
  const Json events = s.json().value("events", Json::array());
  if (events.empty()) return does_not_apply("it has no events");
  if (!std::ranges::all_of(events, [](const Json& event) { return event.contains("at"); }))
    return does_not_apply("an event happens again and again");
  if (s.file().exact_events) return does_not_apply("events happen at their exact times");
  return unless(different_bits(s.motion(), s.run(with_events_at_steps(s.json()))));
}

RelationFound judge_list(const JudgedScene& s) {
  if (!s.json().contains("body")) return does_not_apply("its bodies are a list");
  if (names_numbers(s.json())) return does_not_apply(std::string(has_numbers));
  return unless(different_bits(s.motion(), s.run(with_list_of_bodies(s.json()))));
}

/// Why a scene has no mesh files; empty where it may have.
std::string without_mesh_files(const JudgedScene& s) {
  if (s.scratch().empty()) return "there is no folder for files";
  if (!s.mesh().links.empty()) return "no file of a mesh has chains";
  if (has_key(s.json(), "tag")) return "it has tags of a mesh file";
  return "";
}

RelationFound judge_mesh_files(const JudgedScene& s) {
  if (const std::string reason = without_mesh_files(s); !reason.empty()) return does_not_apply(reason);
  const WrittenScene other = with_written_meshes(s.json(), s.file(), s.scratch(), MeshChange::none);
  return unless(different_bits(s.motion(), s.run(other.json)));
}

RelationFound judge_numbers(const JudgedScene& s) {
  if (const std::string reason = without_mesh_files(s); !reason.empty()) return does_not_apply(reason);
  if (names_numbers(s.json())) return does_not_apply(std::string(has_numbers));
  if (s.chooses_from_all()) return does_not_apply("an event takes the cells of some numbers");
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (const std::string reason = decided_by_numbers(s); !reason.empty()) return does_not_apply(reason);
  if (depends_on_tangent(s)) return does_not_apply(std::string(no_derivative));
  const auto is_simplex = [](CellKind kind) { return kind == CellKind::tetrahedron || kind == CellKind::triangle; };
  if (!s.file().touches.empty() && !std::ranges::all_of(s.mesh().kinds, is_simplex))
    return does_not_apply("bodies touch, and quadrilaterals are split from the corner of the lowest number");
  const WrittenScene other = with_written_meshes(s.json(), s.file(), s.scratch(), MeshChange::renumbered);
  const DrawnMotion found = by_number(s.run(other.json), other.number);
  return unless_rounding(s, by_number, found, s.is_swept() || s.has_losses());
}

RelationFound judge_mirror(const JudgedScene& s) {
  if (const std::string reason = without_mesh_files(s); !reason.empty()) return does_not_apply(reason);
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (const std::string reason = decided_by_numbers(s); !reason.empty()) return does_not_apply(reason);
  if (depends_on_tangent(s)) return does_not_apply(std::string(no_derivative));
  const WrittenScene other = with_written_meshes(s.json(), s.file(), s.scratch(), MeshChange::mirrored);
  const DrawnMotion found = by_number(in_mirror(s.run(in_mirror(other.json))));
  return unless_rounding(s, by_number, found, s.is_swept() || s.has_losses());
}

RelationFound judge_opposite_order(const JudgedScene& s) {
  const std::size_t count = s.file().bodies().size();
  const Json changed = with_opposite_order(s.json());
  if (changed == s.json()) return does_not_apply("no list of it has two rows");
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (depends_on_tangent(s)) return does_not_apply(std::string(no_derivative));
  if (count > 1 && names_numbers(s.json())) return does_not_apply(std::string(has_numbers));
  if (count > 1 && s.chooses_from_all()) return does_not_apply("an event chooses from all bodies");
  if (count > 1 && has<Refine>(s.file().events)) return does_not_apply(std::string(first_edge));
  // of each point of the bodies in the opposite order
  std::vector<std::size_t> number;
  for (std::size_t body = count; body-- > 0;)
    for (std::size_t p = s.first_points()[body]; p < s.first_points()[body + 1]; ++p) number.push_back(p);
  return unless_rounding(s, by_number, by_number(s.run(changed), number), s.is_swept() || s.has_losses());
}

RelationFound judge_pieces(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (file.sleep) return does_not_apply("a load that begins wakes what sleeps");
  if (file.unstable_step == UnstableStep::substep) return does_not_apply("steps are divided anew where a load begins");
  if (!s.scheme().one_step) return does_not_apply("its integrator starts again where a load begins");
  if (depends_on_tangent(s)) return does_not_apply(std::string(no_derivative));
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  const double steps = std::floor(0.45 * file.duration / file.step);
  const auto changed = in_pieces(s.json(), (file.exact_events ? steps : steps + 0.37) * file.step);
  if (!changed) return does_not_apply("no load acts at that time");
  return unless_rounding(s, by_number, by_number(s.run(*changed)), s.is_swept());
}

RelationFound judge_resting_obstacles(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (std::ranges::all_of(file.obstacles, &SceneObstacle::moves)) return does_not_apply("no obstacle is at rest");
  if (file.sleep) return does_not_apply("an obstacle that moves wakes what sleeps");
  if (file.unstable_step != UnstableStep::warn)
    return does_not_apply("obstacles that move count in the forecast, by which steps are refused or divided");
  if (file.duration == 0.0) return does_not_apply("it has no duration");
  const Vector3d velocity = s.scales().length / file.duration * Vector3d(0.3, -0.2, 0.25);
  // within a step, where no velocity is looked at
  for (const double from : {0.3 * file.step, file.duration - 0.3 * file.step}) {
    const double until = from + 1e-10 * file.step;
    const Json moved = with_obstacles_that_move(s.json(), velocity, from, until);
    RelationFound found = unless_rounding(s, by_number, by_number(s.run(moved)), s.is_swept() || s.has_losses());
    if (found.outcome != RelationOutcome::holds) return found;
  }
  return {};
}

RelationFound judge_late(const JudgedScene& s) {
  constexpr int late = 8;
  const SceneFile& file = s.file();
  if (file.sleep) return does_not_apply("what is at rest sleeps");
  if (file.duration == 0.0) return does_not_apply("it has no duration");
  Json begun = s.json();
  begun.erase("unstable_step");
  begun = with_late_start(begun, 0);
  const DrawnMotion found = by_number(s.run(with_late_start(begun, late), {.late = late}));
  if (!found.end.empty()) return does_not_apply("it moves without loads, or ends early");
  const JudgedScene judged(begun, s.folder(), s.scratch());
  return unless_rounding(judged, by_number, found, false);
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
  if (depends_on_tangent(s)) return does_not_apply(std::string(no_derivative));
  if (s.scheme().linearized && s.is_damped()) return does_not_apply("its steps end before their equations hold");
  if (file.integrator == "local-global")
    return does_not_apply("its iterations may begin at rest, and end before its equations hold");
  if (file.solver == "conjugate-gradients") return does_not_apply("its solver's tolerance is a share of velocities");
  if (file.unstable_step != UnstableStep::warn && file.has_contact())
    return does_not_apply("its speed counts in the forecast of contacts, by which steps are refused or divided");
  const Vector3d place = s.scales().length * Vector3d(0.37, -0.23, 0.31);
  const Vector3d velocity = s.scales().length / file.duration * Vector3d(0.19, 0.41, -0.29);
  const auto run = [&](int parts) {
    const Json moving = in_moving_frame(in_shorter_steps(s.json(), parts), place, velocity);
    return out_of_moving_frame(s.run(moving, {.parts = static_cast<std::uint64_t>(parts)}), place, velocity);
  };
  if (file.obstacles.empty()) return unless_rounding(s, of_vertices, of_vertices(run(1)), s.is_swept());
  if (s.has_box_obstacle()) return does_not_apply("the normal of a box jumps where two of its faces are equally near");
  // an obstacle that moves stands still within a step; where a step is long for a contact, only shorter ones show it
  double before = 0.0, after = distance(s.motion(), run(1));
  for (const int parts : {4, 16, 64}) {
    before = after;
    after = distance(s.in_shorter_steps(parts), run(parts));
    if (after <= 0.6 * before + 1e-6 * s.scales().length) return {};
  }
  return breaks(
      fmt::format("in steps of 1/64 positions are {:.3g} m apart, and {:.3g} m in steps of 1/16", after, before));
}

RelationFound judge_far_body(const JudgedScene& s) {
  if (names_numbers(s.json())) return does_not_apply(std::string(has_numbers));
  if (s.chooses_from_all()) return does_not_apply("an event chooses from all bodies");
  if (has<Refine>(s.file().events)) return does_not_apply(std::string(first_edge));
  if (s.file().bending.any()) return does_not_apply("the other body would resist bending, too");
  if (s.file().unstable_step != UnstableStep::warn) return does_not_apply("its steps depend on all bodies");
  if (s.steps_all_as_one()) {
    const JudgedScene other(with_rk4(s.json()), s.folder(), s.scratch());
    return judge_far_body(other);
  }
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  if (s.file().air && last_named(s.motion(), "mass at").values[0] == 0.0)
    return does_not_apply("nothing is left of it, and air stops another body that is as light");
  const auto longer = with_body_far_away(s.json(), s.scales().length, s.scales().mass, s.dimension().value_or(3));
  if (!longer) return does_not_apply("its planes reach everywhere");
  // its own points are the first ones again
  std::vector<std::size_t> number(longer->first + s.mesh().points.size());
  for (std::size_t k = 0; k < number.size(); ++k)
    number[k] = k < longer->first ? s.mesh().points.size() + k : k - longer->first;
  const DrawnMotion found = first_of(by_number(s.run(longer->json), number), by_number(s.motion()));
  return unless_rounding(s, by_number, found, false);
}

RelationFound judge_axes(const JudgedScene& s) {
  // three turns are none
  const DrawnMotion found = in_turned_axes(in_turned_axes(s.run(in_turned_axes(s.json()))));
  return unless_rounding(s, whole, found, s.is_swept());
}

}  // namespace

std::vector<Relation> relations_of_forms() {
  return {
      {"units", "lengths, times and masses in other units, powers of two", "same bits but for exponents", judge_units},
      {"idle-event", "with an event that changes nothing, which keeps the map",
       "same bits; where a pressure follows its faces, rounding", judge_idle_event},
      {"event-times", "events at the ends of the steps in which they are due, several at once", "same bits",
       judge_event_times},
      {"list", "the body as the only one of a list", "same bits", judge_list},
      {"mesh-files", "bodies from files of their meshes", "same bits", judge_mesh_files},
      {"numbers", "points and cells in another order, from files", "rounding", judge_numbers},
      {"mirror", "seen in a mirror", "rounding", judge_mirror},
      {"opposite-order", "bodies, obstacles, loads, drives and events listed in the opposite order", "rounding",
       judge_opposite_order},
      {"pieces", "each load and drive as two, one after the other", "rounding", judge_pieces},
      {"resting-obstacles", "obstacles at rest that move in an instant of the first or last step", "rounding",
       judge_resting_obstacles},
      {"late", "all loads and events eight steps later", "rounding", judge_late},
      {"moving-frame", "seen from a frame elsewhere that moves",
       "rounding; with obstacles, 0.6 of what differs in steps four times as long, down to 1/64, and 1e-6 of the size",
       judge_moving_frame},
      {"far-body",
       "with another body and obstacle far away, listed first; by rk4 where the integrator does not step each vertex alone",
       "rounding", judge_far_body},
      {"axes", "y, z and x called x, y and z", "rounding", judge_axes},
  };
}

}  // namespace dartboard
