#pragma once
// What can be said of the contacts of a scene before anything has moved: how deep they will be, and which step that
// allows.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/contact/obstacle_contact.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"
#include "core/time/method/step_limit.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// At one obstacle, of a column of the body as high as that is towards it.
struct ContactForecast {
  double mass_behind = 0.0;      // [kg/m^2] of the column; or what the law says
  double depth_at_rest = 0.0;    // [m] where its weight presses it onto the obstacle
  double speed = 0.0;            // [m/s] of the fastest impact
  double depth_at_impact = 0.0;  // [m] without loss
  double share = 0.0;            // the larger of the two depths over that of the law
};

/// In the order of the scene's obstacles.
///
/// The speed is that of the fastest vertex, at first or driven, relative to the obstacle, with what the body gains as
/// it falls from its highest place onto the highest of the obstacle (of a half-space, along gravity to its surface), or
/// for as long as the run lasts. The mass behind each part of the surface is the largest density times the height of
/// the body: along the normal of a half-space, else along gravity or, without any, its longest side; of a surface it is
/// the density. An edge or a corner that comes first comes deeper.
///
/// cost  O(vertices) for each obstacle
std::vector<ContactForecast> forecast_contacts(const SceneFile& scene, const Problem& problem);

/// What can be said of the bodies that touch by one key of the scene: of the two that come deepest.
struct TouchForecast {
  std::string path;  // "/contact/bodies", "/contact/pairs/3"
  ContactLaw law;
  std::uint32_t first = 0, second = 0;  // bodies
  ContactForecast contact;
};

/// In the order in which keys come first among the scene's touches.
///
/// The mass behind a surface is the largest density times the heights of all bodies, but for the lesser of the two, on
/// each other, or the height of what all of them fill at first where that is less: the load of the lowest of a stack.
/// Of a body with itself it is that of its own height. Heights are along gravity; without any, the longest sides. The
/// speed is the sum of the two fastest vertices' with what the higher one gains as it falls from its highest place to
/// that of the other; of a body with itself, where events change its topology, over its height.
/// cost    O(vertices, and pairs that touch)
std::vector<TouchForecast> forecast_touches(const SceneFile& scene, const Problem& problem);

/// The largest share.
double largest_share(std::span<const ContactForecast> contacts);
double largest_share(std::span<const TouchForecast> contacts);

/// [1/s] What contacts that deep add to the frequencies of the system, as a root of a sum of squares: of both terms
/// together, or of one; the other is null. ObstacleContact::frequency_squared, BodyContact::frequency_squared.
double contact_rate(const SpringSystem& system, const ObstacleContact* obstacles, const BodyContact* bodies,
                    double share_of_depth);

/// What limits the step of a body while it has such contacts, whose stiffness nothing damps.
StableStep with_contact(StableStep limits, double rate);

}  // namespace dartboard
