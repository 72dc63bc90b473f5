#include <fmt/format.h>

#include <array>

#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/read_parts.h"
#include "core/scene/file/step_times.h"

namespace dartboard {
namespace {

/// The end of what begins at `from`; no value if it is not before the end of the scene.
std::optional<double> read_until(const SceneValue& value, double from, const SceneFile& scene) {
  if (from >= scene.duration)
    value.fail_at("from", fmt::format("is {} s", from),
                  fmt::format("a time before the duration of {} s", scene.duration));
  const auto given = value.find<double>("until");
  const double until = given.value_or(scene.duration);
  const bool ends = given && until <= scene.duration;
  if (until <= from || (ends && !scene.accuracy && step_of_time(until, scene.step) == step_of_time(from, scene.step)))
    value.fail_at("until", fmt::format("leaves the time from {} to {} s", from, until), "at least one step");
  return ends ? std::optional(until) : std::nullopt;
}

}  // namespace

InitialVelocity read_velocity(const SceneValue& value) {
  if (value.json().is_array()) return {.constant = value.as<Eigen::Vector3d>()};
  InitialVelocity v{.constant = value.get<Eigen::Vector3d>("constant"), .centre = value.get<Eigen::Vector3d>("centre")};
  const auto rows = value.get<std::vector<Eigen::Vector3d>>("linear");
  for (int r = 0; r < 3; ++r) v.linear.row(r) = rows[static_cast<std::size_t>(r)];
  return v;
}

SceneDrive read_drive(const SceneValue& value, const SceneFile& scene) {
  SceneDrive drive{.vertices = read_vertices(value),
                   .velocity = read_velocity(value.at("velocity")),
                   .from = value.get<double>("from"),
                   .until = {},
                   .reverse_every = value.find<double>("reverse_every"),
                   .path = value.path()};
  drive.until = read_until(value, drive.from, scene);
  return drive;
}

SceneForce read_force(const SceneValue& value, const SceneFile& scene) {
  SceneForce force{.vertices = read_vertices(value),
                   .force = value.find<Eigen::Vector3d>("force"),
                   .pressure = value.find<double>("pressure"),
                   .from = value.get<double>("from"),
                   .until = {},
                   .path = value.path()};
  force.until = read_until(value, force.from, scene);
  return force;
}

SceneAttachment read_attachment(const SceneValue& value, const SceneFile& scene) {
  SceneAttachment attachment{.vertices = read_vertices(value),
                             .to = value.find<std::uint32_t>("to"),
                             .stiffness = value.get<double>("stiffness"),
                             .path = value.path()};
  if (!attachment.to) return attachment;
  if (!std::holds_alternative<BodyList>(scene.body.mesh))
    value.fail_at("to", fmt::format("is {} without /bodies", *attachment.to), "several bodies, or no such key");
  if (*attachment.to >= scene.bodies().size())
    value.fail_at("to", fmt::format("is {}", *attachment.to),
                  fmt::format("the number of a body, less than {}", scene.bodies().size()));
  return attachment;
}

SceneEvent read_event(const SceneValue& value, const SceneFile& scene) {
  SceneEvent event{.action = {}, .from = 0.0, .until = 0.0, .every = value.find<double>("every"), .path = value.path()};
  if (const auto at = value.find<double>("at")) {
    event.from = event.until = *at;
  } else {
    event.from = value.get<double>("from");
    event.until = value.find<double>("until").value_or(scene.duration);
    if (!event.every && !value.has(TearWhereStressed::key) && !value.has("until"))
      value.fail("has no time", "'at', or 'every', 'from' and 'until'");
    if (event.until < event.from)
      value.fail_at("until", fmt::format("is {} s", event.until),
                    fmt::format("no time before that of 'from', {} s", event.from));
  }
  if (event.from > scene.duration)
    value.fail_at(value.has("at") ? "at" : "from", fmt::format("is {} s", event.from),
                  fmt::format("a time within the duration of {} s", scene.duration));
  event.until = std::min(event.until, scene.duration);
  event.action = read_action(value, scene.has_springs());
  return event;
}

}  // namespace dartboard
