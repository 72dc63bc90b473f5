#include "validation/contact/bouncing_bodies.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/plain/nan_maximum.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

using Json = nlohmann::json;

constexpr double speed = 0.2;              // [m/s]
constexpr double step = 1e-4;              // [s]: some 1/300 of the time in contact
constexpr double most = 0.4;               // [s] for a bounce
constexpr std::uint64_t until_away = 200;  // steps without contact: a body that vibrates may touch again

// The last column: young / height over the slope of the pressure at the depth of the law, 2 MPa/m.
constexpr double loose = std::numeric_limits<double>::infinity();
constexpr BouncingBody bodies[] = {{"square of two triangles, loose",
                                    R"({"body": {"generate": {"sheet": {"cells": [1, 1], "spacing": 0.1}}},
         "material": {"density": 10, "stiffness": 0, "viscosity": 0}})",
                                    loose},
                                   {"sheet of 32 triangles, loose",
                                    R"({"body": {"generate": {"sheet": {"cells": [4, 4], "spacing": 0.05}}},
         "material": {"density": 10, "stiffness": 0, "viscosity": 0}})",
                                    loose},
                                   {"box, 10 MPa",
                                    R"({"body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}},
         "material": {"density": 1000, "young": 1e7, "poisson": 0.3, "viscosity": 0}})",
                                    50.0},
                                   {"box, 2 MPa",
                                    R"({"body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}},
         "material": {"density": 1000, "young": 2e6, "poisson": 0.3, "viscosity": 0}})",
                                    10.0},
                                   {"box, 500 kPa",
                                    R"({"body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}},
         "material": {"density": 1000, "young": 5e5, "poisson": 0.3, "viscosity": 0}})",
                                    2.5},
                                   {"box, 100 kPa",
                                    R"({"body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}},
         "material": {"density": 1000, "young": 1e5, "poisson": 0.3, "viscosity": 0}})",
                                    0.5},
                                   {"box, 20 kPa",
                                    R"({"body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05}}},
         "material": {"density": 1000, "young": 2e4, "poisson": 0.3, "viscosity": 0}})",
                                    0.1},
                                   {"ball, 2 MPa",
                                    R"({"body": {"generate": {"ball": {"layers": 2, "radius": 0.05}}},
         "material": {"density": 1000, "young": 2e6, "poisson": 0.3, "viscosity": 0}})",
                                    10.0}};

SceneFile scene_of(const BouncingBody& body, std::string_view integrator, double restitution, bool leaves) {
  Json json = Json::parse(body.json);
  json["name"] = "bounce";
  json["integrator"] = integrator;
  json["gravity"] = {0, 0, 0};
  json["step"] = step;
  json["duration"] = leaves ? 0.02 : most;
  const double low = body.name.starts_with("ball") ? 0.05 : 0.0;
  json["body"]["translate"] = {0, 0, low + (leaves ? -0.001 : 0.0005)};
  if (!leaves) json["initial_velocity"] = {0, 0, -speed};
  json["contact"] = {{"pressure", 2000}, {"depth", 0.002}, {"restitution", restitution}};
  json["contact"]["obstacles"] = {{{"plane", {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}}}};
  if (leaves) json["contact"]["obstacles"][0]["velocity"] = {0, 0, -1};
  return parse_scene(json.dump(), "scene of a bounce", "");
}

double mean_speed(const Simulation& simulation) {
  const Diagnostics now = simulation.diagnostics();
  return now.momentum.z() / now.mass;
}

}  // namespace

std::span<const BouncingBody> bouncing_bodies() { return bodies; }

BounceFound bounce_body(const BouncingBody& body, std::string_view integrator, double restitution) {
  const Scheme& scheme = scheme_of(integrator);
  BounceFound found{
      .body = body.name, .integrator = integrator, .order = scheme.one_step ? scheme.order : 1, .asked = restitution};
  Simulation thrown(scene_of(body, integrator, restitution, false));
  std::uint64_t touched = 0;
  while (thrown.steps_done() < thrown.step_count() && !found.ended) {
    if (thrown.advance()) return found;
    const std::uint64_t now = thrown.steps_done();
    if (thrown.diagnostics().contact->contacts > 0) touched = now;
    found.ended = touched > 0 && now - touched == until_away;
  }
  found.found = mean_speed(thrown) / speed;
  Simulation left(scene_of(body, integrator, restitution, true));
  double before = 0.0;
  while (left.steps_done() < left.step_count()) {
    if (left.advance()) found.ended = false;
    if (!found.ended) return found;
    const double now = mean_speed(left);
    found.pulled = max_or_nan(found.pulled, before - now);
    before = now;
  }
  return found;
}

}  // namespace dartboard
