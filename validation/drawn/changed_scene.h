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

/// With another body, soft and so far away that no selection, obstacle or body is near it; none where a plane reaches
/// everywhere. `size` [m] and `mass` [kg] are those of all that is there, `dimension` that of the other body.
std::optional<nlohmann::ordered_json> with_body_far_away(nlohmann::ordered_json scene, double size, double mass,
                                                         int dimension);

/// With its bodies in the opposite order.
/// pre  it has a list of bodies
nlohmann::ordered_json with_opposite_order(nlohmann::ordered_json scene);

/// Seen from a frame in which its origin is at a place and moves at a velocity.
/// pre  nothing is held in space, and no obstacle moves
nlohmann::ordered_json in_moving_frame(nlohmann::ordered_json scene, const Eigen::Vector3d& place,
                                       const Eigen::Vector3d& velocity);

/// With nothing that moves for a number of steps, and then all that the scene has but gravity and velocities at the
/// start.
nlohmann::ordered_json with_late_start(nlohmann::ordered_json scene, int steps);

/// The shape of an object of the scene at a path has a key that names something by number?
bool names_numbers(const nlohmann::ordered_json& scene);

}  // namespace dartboard
