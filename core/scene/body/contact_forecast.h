#pragma once
// A forecast of the contacts of a scene before anything has moved: how deep they will be, and which step that
// allows.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/contact/contacts.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"
#include "core/time/method/step_limit.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// The forecast at one obstacle, for a column of the body as high as the body is towards the obstacle.
struct ContactForecast {
  double mass_behind = 0.0;      // [kg/m^2] of the column
  double depth_at_rest = 0.0;    // [m] where its weight presses it onto the obstacle
  double speed = 0.0;            // [m/s] of the fastest impact
  double depth_at_impact = 0.0;  // [m] without loss
  double share = 0.0;            // the larger of the two depths over that of the law
  // the stiffness of the column, Young's modulus over its height, over that of the contact at the larger of the two
  // depths; infinite for surfaces, and where materials have no modulus
  double stiffness_ratio = std::numeric_limits<double>::infinity();

  /// Is the restitution that of the body, to a tenth or so? A softer body vibrates after the bounce, or while it lasts.
  bool keeps_restitution(const ContactLaw& law) const { return law.restitution == 1.0 || stiffness_ratio >= 5.0; }
};

/// The forecast for the bodies that touch by one key of the scene: for the two that come deepest.
struct TouchForecast {
  std::string path;  // "/contact/bodies", "/contact/pairs/3"
  ContactLaw law;
  std::uint32_t first = 0, second = 0;  // bodies
  ContactForecast contact;
};

/// The contacts that are expected of a scene.
struct ExpectedContacts {
  std::vector<ContactForecast> obstacles;  // in the order of the scene
  std::vector<TouchForecast> bodies;       // in the order in which their keys first appear among the scene's touches

  /// The largest expected depth over that of its law.
  double share() const;
};

/// Forecast from the mesh, the materials and the speeds at the start.
///
/// At an obstacle, the speed is that of the fastest vertex, at first or driven, relative to the obstacle, plus the
/// speed gained in a fall of the body from its highest place onto the highest of the obstacle (of a half-space, along
/// gravity to its surface), or for the duration of the run. The mass behind each part of the surface is the largest
/// density times the height of the body: along the normal of a half-space, otherwise along gravity or, without gravity,
/// its longest side; of a surface it is the density, of a chain the density over the width. An edge or a corner that
/// touches first goes deeper.
///
/// Between bodies, the mass behind a surface is the largest density times the sum of the heights of all bodies less the
/// smaller of the two, or the height of the space that all bodies fill at first where that is less: the load of the
/// lowest of a stack. For a body with itself it is that of its own height. Heights are along gravity; without it, the
/// longest sides. The speed is the sum of the speeds of the two fastest vertices, plus the gain of a fall from the
/// highest place of the higher body to that of the other; for a body with itself, where events change its topology,
/// over its height.
/// cost    O(vertices) for each obstacle, and O(pairs that touch)
ExpectedContacts expect_contacts(const SceneFile& scene, const Problem& problem);

/// [1/s] The contribution of contacts that deep to the frequencies of the system, as a root of a sum of squares.
double contact_rate(const SpringSystem& system, const Contacts& contacts, double share_of_depth);

/// The limits of the step of a body while it has such contacts, whose stiffness nothing damps.
StableStep with_contact(StableStep limits, double rate);

}  // namespace dartboard
