#include "validation/drawn/changed_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

Vector3d vector_of(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}
Json json_of_bits(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

void scale(Json& value, int power) {
  if (value.is_array())
    for (Json& part : value) scale(part, power);
  else if (value.is_number())
    value = std::ldexp(value.get<double>(), power);
}

/// The dimensions of a key, where those of the table are those for solids.
Dimensions dimensions_among(const SceneKey& key, std::optional<int> dimension) {
  Dimensions unit = dimensions_of(key.unit);
  const bool is_of_material = key.shape == Shape::material || key.shape == Shape::tissue;
  const int d = dimension.value_or(3);
  if (is_of_material && key.name == "density") unit.length = -d;
  if ((is_of_material && key.name == "young") || (key.shape == Shape::stress && key.name == "threshold"))
    unit.length = 2 - d;
  return unit;
}

Json turned(const Json& point) { return {point[1], point[2], point[0]}; }

void turn_body(Json& body) {
  Eigen::Matrix3d axes;
  axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  Eigen::Matrix3d turn = axes;
  if (body.contains("rotate"))
    turn = axes * Eigen::AngleAxisd(body["rotate"]["degrees"].get<double>() * (std::numbers::pi / 180.0),
                                    vector_of(body["rotate"]["axis"]).normalized());
  const Eigen::AngleAxisd about(turn);
  body["rotate"] = {{"axis", json_of_bits(about.axis())}, {"degrees", about.angle() * (180.0 / std::numbers::pi)}};
}

template <class F>
void for_each_body(Json& scene, F&& f) {
  if (scene.contains("body")) f(scene["body"]);
  if (scene.contains("bodies"))
    for (Json& body : scene["bodies"]) f(body);
}

/// Of attachments, and of pairs that touch.
template <class F>
void for_each_number_of_a_body(Json& scene, F&& f) {
  if (scene.contains("attachments"))
    for (Json& one : scene["attachments"])
      if (one.contains("to")) f(one["to"]);
  if (scene.contains("contact") && scene["contact"].contains("pairs"))
    for (Json& pair : scene["contact"]["pairs"])
      for (Json& body : pair["of"]) f(body);
}

}  // namespace

Json in_units(Json scene, const Dimensions& powers, std::optional<int> dimension) {
  scene = with_standards(std::move(scene));
  for_each_key(scene, Shape::scene, "", [&](const SceneKey& key, Json& value, const std::string&) {
    if (value.is_object() || key.type == ValueType::objects) {
      // a traction on edges is a force per length
      if (key.name == "forces")
        for (Json& force : value)
          if (force.contains("traction") && force.value("on", "") == "edges") scale(force["traction"], powers.length);
      return;
    }
    const Dimensions unit = dimensions_among(key, dimension);
    const int power = unit.length * powers.length + unit.time * powers.time + unit.mass * powers.mass;
    if (power != 0) scale(value, power);
  });
  for_each_body(scene, [&](Json& body) {
    if (body.contains("mesh")) body["scale"] = std::ldexp(body.value("scale", 1.0), powers.length);
  });
  return scene;
}

Json in_turned_axes(Json scene) {
  scene = with_standards(std::move(scene));
  for_each_key(scene, Shape::scene, "", [](const SceneKey& key, Json& value, const std::string&) {
    if (key.shape == Shape::rotation) return;  // of bodies: below
    const bool is_point = key.type == ValueType::point || (key.type == ValueType::point_or_object && value.is_array());
    if (is_point) value = turned(value);
    if (key.type == ValueType::points)
      for (Json& point : value) point = turned(point);
    if (key.type == ValueType::matrix) value = Json{turned(value[1]), turned(value[2]), turned(value[0])};
    if (key.shape == Shape::held && key.name == "axes")
      for (Json& axis : value) axis = axis == "x" ? "z" : axis == "y" ? "x" : "y";
  });
  for_each_body(scene, turn_body);
  return scene;
}

Json with_disturbance(Json scene, double share, double length) {
  const double duration = scene["duration"].get<double>();
  const auto disturb = [rate = duration > 0.0 ? share / duration : 0.0](Json& object) {
    Json velocity = object.value("initial_velocity", Json{0, 0, 0});
    if (velocity.is_array()) velocity = {{"constant", velocity}};
    Json rows = velocity.value("linear", Json{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    // no motion has this symmetry
    double part = 0.3;
    for (Json& row : rows)
      for (Json& x : row) {
        x = x.get<double>() + rate * part;
        part = std::fmod(part * 2.7 + 0.9, 2.0) - 1.0;
      }
    velocity["linear"] = rows;
    object["initial_velocity"] = velocity;
  };
  disturb(scene);
  // what rests on another body, or on an obstacle, is lifted from it or pressed into it
  Vector3d way = share * length * Vector3d(0.3, -0.7, 0.5);
  for_each_body(scene, [&](Json& body) {
    body["translate"] = json_of_bits(vector_of(body.value("translate", Json{0, 0, 0})) + way);
    way *= -1.3;
    body["scale"] = body.value("scale", 1.0) * (1.0 + share);
    if (body.contains("initial_velocity")) disturb(body);
  });
  return scene;
}

Json with_idle_event(Json scene) {
  const double step = scene["step"].get<double>(), duration = scene["duration"].get<double>();
  const double steps = std::floor(0.5 * duration / step);
  const Json nowhere{{"sphere", {{"centre", {1e9, 1e9, 1e9}}, {"radius", 0}}}};
  if (!scene.contains("events")) scene["events"] = Json::array();
  scene["events"].push_back({{"at", steps * step}, {"remove", nowhere}});
  return scene;
}

Json with_list_of_bodies(Json scene) {
  Json body = scene["body"];
  scene.erase("body");
  scene["bodies"] = Json::array({body});
  return scene;
}

std::optional<LongerScene> with_body_far_away(Json scene, double size, double mass, int dimension) {
  // sides of planes on which the body must be
  std::vector<Vector3d> sides;
  for_each_key(scene, Shape::scene, "", [&](const SceneKey& key, Json& value, const std::string&) {
    if (key.name != "plane" || key.of != Shape::plane) return;
    const Vector3d normal = vector_of(value["normal"]).normalized();
    sides.emplace_back(key.shape == Shape::obstacle ? normal : Vector3d(-normal));
  });
  std::optional<Vector3d> way;
  double margin = 0.2;
  for (int k = 0; k < 27; ++k) {
    const Vector3d direction = Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).cast<double>();
    if (k == 13) continue;
    double least = 1.0;
    for (const Vector3d& side : sides) least = std::min(least, side.dot(direction.normalized()));
    if (least <= margin) continue;
    margin = least;
    way = direction.normalized();
  }
  if (!way) return std::nullopt;
  if (scene.contains("body")) scene = with_list_of_bodies(std::move(scene));
  const double edge = 0.1 * size;
  const Json generate = dimension == 3   ? Json{{"box", {{"cells", {1, 1, 1}}, {"spacing", edge}}}}
                        : dimension == 2 ? Json{{"sheet", {{"cells", {1, 1}}, {"spacing", edge}}}}
                                         : Json{{"chain", {{"links", 1}, {"spacing", edge}}}};
  const double step = scene["step"].get<double>();
  const double density = mass / std::pow(size, dimension),
               stiffness = 1e-6 * density * std::pow(edge, dimension) / (step * step);
  Json material{{"density", density}, {"stiffness", stiffness}, {"damping", 0}};
  if (dimension == 1) material["width"] = edge;
  const Vector3d there = 30.0 * size * *way;
  Json& bodies = scene["bodies"];
  const Json other{{"generate", generate},
                   {"translate", json_of_bits(there)},
                   {"material", material},
                   {"initial_velocity", {0, 0, 0}}};
  bodies.insert(bodies.begin(), other);
  for_each_number_of_a_body(scene, [](Json& body) { body = body.get<std::size_t>() + 1; });
  if (scene.contains("contact")) {
    Json& contact = scene["contact"];
    Json law{{"friction", 0.9}, {"restitution", 0.3}};
    if (contact.contains("pressure")) law["pressure"] = 8.0 * contact["pressure"].get<double>();
    Json pair = law;
    pair["of"] = {0, 0};
    pair["touch"] = dimension == 3 ? "yes" : "no";
    if (contact.value("bodies", "none") != "none") {
      contact["pairs"].push_back(pair);
      for (std::size_t k = 1; k < bodies.size(); ++k) contact["pairs"].push_back({{"of", {0, k}}, {"touch", "no"}});
    }
    if (contact.contains("obstacles")) {
      Json obstacle = law;
      obstacle["sphere"] = {{"centre", json_of_bits(there + 100.0 * size * *way)}, {"radius", size}};
      contact["obstacles"].insert(contact["obstacles"].begin(), obstacle);
    }
  }
  constexpr std::size_t points_of[] = {0, 2, 4, 8};
  return LongerScene{scene, points_of[dimension]};
}

Json with_opposite_order(Json scene) {
  const auto reverse = [](Json& object, const char* key) {
    if (object.contains(key)) std::reverse(object[key].begin(), object[key].end());
  };
  for (const char* key : {"bodies", "forces", "driven", "fixed", "attachments"}) reverse(scene, key);
  if (scene.contains("contact"))
    for (const char* key : {"obstacles", "pairs"}) reverse(scene["contact"], key);
  std::set<double> times;
  for (const Json& event : scene.value("events", Json::array()))
    if (event.contains("at")) times.insert(event["at"].get<double>());
  if (!times.empty() && times.size() == scene["events"].size()) reverse(scene, "events");
  if (!scene.contains("bodies")) return scene;
  const std::size_t last = scene["bodies"].size() - 1;
  for_each_number_of_a_body(scene, [last](Json& body) { body = last - body.get<std::size_t>(); });
  return scene;
}

std::optional<Json> in_pieces(Json scene, double time) {
  bool any = false;
  const auto divide_table = [&](Json& table, const char* value) {
    for (std::size_t k = 1; k < table.size(); ++k) {
      const double begin = table[k - 1]["at"].get<double>(), end = table[k]["at"].get<double>();
      if (!(begin < time && time < end)) continue;
      const double share = (time - begin) / (end - begin);
      const auto between = [share](const Json& a, const Json& b) {
        return a.get<double>() + share * (b.get<double>() - a.get<double>());
      };
      const Json &a = table[k - 1][value], &b = table[k][value];
      Json entry{{"at", time}};
      if (a.is_array())
        for (std::size_t axis = 0; axis < 3; ++axis) entry[value].push_back(between(a[axis], b[axis]));
      else
        entry[value] = between(a, b);
      table.insert(table.begin() + static_cast<std::ptrdiff_t>(k), entry);
      any = true;
      return;
    }
  };
  const auto divide_times = [&](Json& list, std::size_t k) {
    const bool acts = list[k].value("from", 0.0) < time && time < list[k].value("until", 2.0 * time);
    if (!acts) return;
    Json second = list[k];
    list[k]["until"] = time;
    second["from"] = time;
    list.push_back(second);
    any = true;
  };
  for (const char* key : {"forces", "driven"}) {
    if (!scene.contains(key)) continue;
    Json& list = scene[key];
    for (std::size_t k = list.size(); k-- > 0;) {
      if (list[k].contains("over_time")) divide_table(list[k]["over_time"], "factor");
      if (list[k].contains("path"))
        divide_table(list[k]["path"], "place");
      else if (list[k].contains("turn"))
        divide_table(list[k]["turn"]["angles"], "degrees");
      else if (!list[k].contains("reverse_every"))
        divide_times(list, k);
    }
  }
  return any ? std::optional(scene) : std::nullopt;
}

Json with_events_at_steps(Json scene) {
  const double step = scene["step"].get<double>();
  Json& events = scene["events"];
  std::stable_sort(events.begin(), events.end(),
                   [](const Json& a, const Json& b) { return a["at"].get<double>() < b["at"].get<double>(); });
  for (Json& event : events) event["at"] = std::ceil(event["at"].get<double>() / step) * step;
  return scene;
}

Json with_obstacles_that_move(Json scene, const Vector3d& velocity, double from, double until) {
  const double duration = scene["duration"].get<double>();
  const Vector3d way = std::max(0.0, std::min(until, duration) - from) * velocity;
  const auto move = [&way](Json& point) { point = json_of_bits(vector_of(point) - way); };
  for (Json& obstacle : scene["contact"]["obstacles"]) {
    const Json rest = obstacle.value("velocity", Json{0, 0, 0});
    if (!vector_of(rest).isZero(0.0)) continue;
    obstacle["velocity"] = json_of_bits(velocity);
    obstacle["from"] = from;
    obstacle["until"] = until;
    if (obstacle.contains("plane")) move(obstacle["plane"]["point"]);
    if (obstacle.contains("sphere")) move(obstacle["sphere"]["centre"]);
    if (obstacle.contains("box"))
      for (const char* corner : {"min", "max"}) move(obstacle["box"][corner]);
  }
  return scene;
}

Json in_shorter_steps(Json scene, int parts) {
  const double step = scene["step"].get<double>(), duration = scene["duration"].get<double>();
  const double steps = std::ceil(duration / step * (1.0 - 1e-12));
  scene["step"] = step / parts;
  scene["duration"] = steps * step;
  return scene;
}

Json with_rk4(Json scene) {
  scene["integrator"] = "rk4";
  scene.erase("solver");
  return scene;
}

Json in_mirror(Json scene) {
  const auto mirror = [](Json& vector) { vector[0] = -vector[0].get<double>(); };
  // an axis turns the other way round
  const auto mirror_axis = [](Json& axis) {
    axis[1] = -axis[1].get<double>();
    axis[2] = -axis[2].get<double>();
  };
  for_each_key(scene, Shape::scene, "", [&](const SceneKey& key, Json& value, const std::string&) {
    const bool is_point = key.type == ValueType::point || (key.type == ValueType::point_or_object && value.is_array());
    const bool is_axis =
        (key.shape == Shape::force && key.name == "torque") || (key.shape == Shape::driven_turn && key.name == "axis");
    if (is_axis)
      mirror_axis(value);
    else if (is_point)
      mirror(value);
    if (key.type == ValueType::points)
      for (Json& point : value) mirror(point);
    if (key.type == ValueType::matrix) {
      for (Json& row : value) mirror(row);
      for (Json& x : value[0]) x = -x.get<double>();
    }
    if (key.of == Shape::box && value.is_object()) {
      // by now neither of its corners is mirrored
      const Json least = value["min"][0];
      value["min"][0] = value["max"][0];
      value["max"][0] = least;
    }
  });
  return scene;
}

Json in_moving_frame(Json scene, const Vector3d& place, const Vector3d& velocity) {
  const auto move = [&place](Json& point) { point = json_of_bits(vector_of(point) + place); };
  for_each_key(scene, Shape::scene, "", [&](const SceneKey& key, Json& value, const std::string&) {
    // places are points in metres, but for the reach of a blade
    if (key.unit != "m" || key.name == "depth" || key.name == "translate") return;
    if (key.type == ValueType::point) move(value);
    if (key.type == ValueType::points)
      for (Json& point : value) move(point);
  });
  for_each_body(scene, [&](Json& body) {
    body["translate"] = json_of_bits(vector_of(body.value("translate", Json{0, 0, 0})) + place);
  });
  const auto speed_up = [&](Json& object) {
    Json& value = object["initial_velocity"];
    if (value.is_null()) value = {0, 0, 0};
    if (value.is_object() && !value.contains("centre")) value["centre"] = json_of_bits(place);
    Json& constant = value.is_object() ? value["constant"] : value;
    constant = json_of_bits((constant.is_null() ? Vector3d(0, 0, 0) : vector_of(constant)) + velocity);
  };
  speed_up(scene);
  if (scene.contains("bodies"))
    for (Json& body : scene["bodies"])
      if (body.contains("initial_velocity")) speed_up(body);
  if (scene.contains("contact") && scene["contact"].contains("obstacles"))
    for (Json& obstacle : scene["contact"]["obstacles"]) obstacle["velocity"] = json_of_bits(velocity);
  if (scene.contains("air"))
    scene["air"]["velocity"] = json_of_bits(vector_of(scene["air"].value("velocity", Json{0, 0, 0})) + velocity);
  return scene;
}

Json with_late_start(Json scene, int steps) {
  const double later = steps * scene["step"].get<double>();
  const auto delay = [later](Json& object, const char* key) { object[key] = object.value(key, 0.0) + later; };
  scene["gravity"] = {0, 0, 0};
  scene.erase("initial_velocity");
  for_each_body(scene, [](Json& body) { body.erase("initial_velocity"); });
  delay(scene, "duration");
  if (scene.contains("driven"))
    for (Json& drive : scene["driven"]) {
      if (drive.contains("path"))
        for (Json& place : drive["path"]) delay(place, "at");
      if (drive.contains("turn"))
        for (Json& angle : drive["turn"]["angles"]) delay(angle, "at");
      if (drive.contains("velocity")) delay(drive, "from");
      if (drive.contains("until")) delay(drive, "until");
    }
  if (scene.contains("forces"))
    for (Json& force : scene["forces"]) {
      delay(force, "from");
      if (force.contains("until")) delay(force, "until");
      if (force.contains("over_time"))
        for (Json& factor : force["over_time"]) delay(factor, "at");
    }
  if (scene.contains("contact") && scene["contact"].contains("obstacles"))
    for (Json& obstacle : scene["contact"]["obstacles"]) {
      delay(obstacle, "from");
      if (obstacle.contains("until")) delay(obstacle, "until");
    }
  if (scene.contains("events"))
    for (Json& event : scene["events"]) {
      delay(event, event.contains("at") ? "at" : "from");
      if (event.contains("until")) delay(event, "until");
    }
  return scene;
}

bool names_numbers(const Json& scene) {
  bool names = false;
  Json copy = scene;
  for_each_key(copy, Shape::scene, "", [&names](const SceneKey& key, Json&, const std::string&) {
    names =
        names || key.name == "ids" || key.name == "vertex" || (key.shape == Shape::dissociate && key.name == "points");
  });
  return names;
}

}  // namespace dartboard
