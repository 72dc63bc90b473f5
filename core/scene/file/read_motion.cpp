#include <fmt/format.h>

#include <array>
#include <numbers>

#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/read_parts.h"

namespace dartboard {
namespace {

/// The end of what begins at `from`; no value if it is not before the end of the scene.
std::optional<double> read_until(const SceneValue& value, double from, const SceneFile& scene) {
  if (from >= scene.duration)
    value.fail_at("from", fmt::format("is {} s", from),
                  fmt::format("a time before the duration of {} s", scene.duration));
  const auto until = value.find<double>("until");
  if (until && *until <= from)
    value.fail_at("until", fmt::format("is {} s", *until), fmt::format("more than {} s", from));
  return until && *until <= scene.duration ? until : std::nullopt;
}

/// A table of values by ascending times, `least` of them or more.
template <class T>
TimeTable<T> read_table(const SceneValue& list, std::string_view key, std::size_t least) {
  TimeTable<T> table;
  const std::vector<SceneValue> entries = list.entries();
  if (entries.size() < least) list.fail(fmt::format("has {} times", entries.size()), fmt::format("{} or more", least));
  for (const SceneValue& entry : entries) {
    const double at = entry.get<double>("at");
    if (!table.at.empty() && !(at > table.at.back()))
      entry.fail_at("at", fmt::format("is {} s", at),
                    fmt::format("a time after {} s, that of the entry before", table.at.back()));
    table.at.push_back(at);
    table.value.push_back(entry.get<T>(key));
  }
  return table;
}

SceneTurn read_turn(const SceneValue& value) {
  SceneTurn turn{.axis = value.at("axis").direction(),
                 .centre = value.get<Eigen::Vector3d>("centre"),
                 .angle = read_table<double>(value.at("angles"), "degrees", 2)};
  for (double& angle : turn.angle.value) angle *= std::numbers::pi / 180.0;
  return turn;
}

SharedBy read_shared_by(const SceneValue& value) {
  const auto given = value.find<std::string>("on");
  if (!given) return value.has("traction") ? SharedBy::faces : SharedBy::vertices;
  if (*given == "faces") return SharedBy::faces;
  if (*given == "edges") return SharedBy::edges;
  if (value.has("traction")) value.fail_at("on", "is \"vertices\" beside 'traction'", "\"faces\" or \"edges\"");
  return SharedBy::vertices;
}

}  // namespace

InitialVelocity read_velocity(const SceneValue& value) {
  if (value.json().is_array()) return {.constant = value.as<Eigen::Vector3d>()};
  InitialVelocity v{.constant = value.get<Eigen::Vector3d>("constant"), .centre = value.get<Eigen::Vector3d>("centre")};
  const auto rows = value.get<std::vector<Eigen::Vector3d>>("linear");
  for (int r = 0; r < 3; ++r) v.linear.row(r) = rows[static_cast<std::size_t>(r)];
  return v;
}

SceneSleep read_sleep(const SceneValue& value) {
  return {.speed = value.get<double>("speed"), .time = value.get<double>("time")};
}

SceneDrive read_drive(const SceneValue& value, const SceneFile& scene) {
  SceneDrive drive{.vertices = read_vertices(value),
                   .velocity = value.has("velocity") ? read_velocity(value.at("velocity")) : InitialVelocity{},
                   .from = value.get<double>("from"),
                   .until = {},
                   .reverse_every = value.find<double>("reverse_every"),
                   .path = value.path()};
  if (value.has("path")) drive.way = read_table<Eigen::Vector3d>(value.at("path"), "place", 2);
  if (value.has("turn")) drive.turn = read_turn(value.at("turn"));
  if (!drive.has_table()) {
    drive.until = read_until(value, drive.from, scene);
    return drive;
  }
  const std::vector<double>& times = drive.turn ? drive.turn->angle.at : drive.way.at;
  drive.from = times.front();
  if (drive.from >= scene.duration)
    value.fail_at(drive.turn ? "turn" : "path", fmt::format("begins at {} s", drive.from),
                  fmt::format("a time before the duration of {} s", scene.duration));
  if (times.back() <= scene.duration) drive.until = times.back();
  return drive;
}

SceneForce read_force(const SceneValue& value, const SceneFile& scene) {
  SceneForce force{.vertices = read_vertices(value),
                   .force = value.find<Eigen::Vector3d>("force"),
                   .pressure = value.find<double>("pressure"),
                   .from = value.get<double>("from"),
                   .until = {},
                   .path = value.path(),
                   .traction = value.find<Eigen::Vector3d>("traction"),
                   .shared_by = read_shared_by(value),
                   .acceleration = value.find<Eigen::Vector3d>("acceleration"),
                   .torque = value.find<Eigen::Vector3d>("torque")};
  if (value.has("over_time")) force.factor = read_table<double>(value.at("over_time"), "factor", 1);
  force.follows = value.get<std::string>("normals") == "current";
  if (force.follows && !force.pressure)
    value.fail_at("normals", "is \"current\" without 'pressure'", "a pressure, or no such key");
  force.until = read_until(value, force.from, scene);
  return force;
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
