#pragma once
// A scene written otherwise, so that its motion is the same in other units, in other axes, or by other parts of the
// code.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "validation/drawn/scene_walk.h"

namespace dartboard {

/// The scene with lengths, times and masses 2^length, 2^time and 2^mass times as large: all bits but those of exponents
/// stay. `dimension` is that of the cells of all bodies: 1 for chains; without one, that of bodies differs.
///
/// pre  no length without a dimension: it decides what a density is per
nlohmann::ordered_json in_units(nlohmann::ordered_json scene, const Dimensions& powers, std::optional<int> dimension);

/// The scene in axes in which the old y, z and x are x, y and z.
nlohmann::ordered_json in_turned_axes(nlohmann::ordered_json scene);

/// The scene with bodies that are larger by a share, each about its own origin, lie elsewhere by about that share of a
/// length [m], and are stretched, sheared and turned by about that share until the end: far more than by rounding, for
/// a share of 1e-10.
nlohmann::ordered_json with_disturbance(nlohmann::ordered_json scene, double share, double length);

/// With an event that changes nothing, at a multiple of the step: cells are removed where there are none.
nlohmann::ordered_json with_idle_event(nlohmann::ordered_json scene);

/// With its body as the only one of a list.
nlohmann::ordered_json with_list_of_bodies(nlohmann::ordered_json scene);

/// A scene with more points before its own.
struct LongerScene {
  nlohmann::ordered_json json;
  std::size_t first = 0;  // of its own points
};
/// With another body before its own, soft and so far away that no selection, obstacle or body is near it: of another
/// material, where it touches itself by another law; and where there are obstacles, with another one before them, which
/// is as far away and has another law. None where a plane reaches everywhere. `size` [m] and `mass` [kg] are those of
/// all that is there, `dimension` that of the other body.
std::optional<LongerScene> with_body_far_away(nlohmann::ordered_json scene, double size, double mass, int dimension);

/// With its bodies, obstacles, pairs that touch, forces, drives, fixed vertices and attachments in the opposite order;
/// and its events, if each has a time and no two have the same.
nlohmann::ordered_json with_opposite_order(nlohmann::ordered_json scene);

/// With each force and drive that acts at a time [s] as two, until then and from then on; tables have an entry more
/// there. None where nothing acts then, or turns round again and again.
std::optional<nlohmann::ordered_json> in_pieces(nlohmann::ordered_json scene, double time);

/// With its events at the ends of the steps in which they are due: those of one step happen in the order of the list.
/// pre  each has a time `at`
nlohmann::ordered_json with_events_at_steps(nlohmann::ordered_json scene);

/// With obstacles that are at rest in places from which they move between two times [s], so that at the end of the run
/// they are in their own.
nlohmann::ordered_json with_obstacles_that_move(nlohmann::ordered_json scene, const Eigen::Vector3d& velocity,
                                                double from, double until);

/// In steps of which a whole number is one of its own; its duration is a whole number of its own.
nlohmann::ordered_json in_shorter_steps(nlohmann::ordered_json scene, int parts);

/// Stepped by rk4, which steps each vertex by the forces on it alone.
nlohmann::ordered_json with_rk4(nlohmann::ordered_json scene);

/// Seen in a mirror across x, but for the meshes of bodies.
nlohmann::ordered_json in_mirror(nlohmann::ordered_json scene);

/// Seen from a frame in which its origin is at a place and moves at a velocity.
/// pre  nothing is held in space, and no obstacle moves
nlohmann::ordered_json in_moving_frame(nlohmann::ordered_json scene, const Eigen::Vector3d& place,
                                       const Eigen::Vector3d& velocity);

/// With nothing that moves for a number of steps, and then all that the scene has but gravity and velocities at the
/// start.
nlohmann::ordered_json with_late_start(nlohmann::ordered_json scene, int steps);

/// Does a key name vertices or cells by their numbers?
bool names_numbers(const nlohmann::ordered_json& scene);

}  // namespace dartboard
