#include <fmt/format.h>

#include <array>
#include <map>

#include "core/base/overloads.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/read_parts.h"

namespace dartboard {
namespace {

/// The law of /contact, but for what is given here.
ContactLaw read_law(const SceneValue& value, ContactLaw law) {
  law.pressure = value.find<double>("pressure").value_or(law.pressure);
  law.depth = value.find<double>("depth").value_or(law.depth);
  law.restitution = value.find<double>("restitution").value_or(law.restitution);
  law.friction = value.find<double>("friction").value_or(law.friction);
  return law;
}

decltype(Obstacle::shape) read_shape(const SceneValue& value) {
  using Shape = decltype(Obstacle::shape);
  return std::visit(Overloads{[](const PlaneSelection& side) -> Shape {
                                return HalfSpace{side.point, side.normal};
                              },
                              [&value](const SphereSelection& ball) -> Shape {
                                if (ball.radius == 0.0)
                                  value.fail_at("sphere/radius", "is 0 m", "a ball that has an inside");
                                return Ball{ball.centre, ball.radius};
                              },
                              [&value](const BoxSelection& box) -> Shape {
                                for (int k = 0; k < 3; ++k)
                                  if (box.min[k] == box.max[k])
                                    value.fail_at("box",
                                                  fmt::format("has a min[{}] and a max[{}] of {}", k, k, box.min[k]),
                                                  "a box that has an inside");
                                return Block{box.min, box.max};
                              }},
                    read_one_of<std::variant<PlaneSelection, SphereSelection, BoxSelection>>(value).value());
}

SceneObstacle read_obstacle(const SceneValue& value, const ContactLaw& law, double duration) {
  SceneObstacle made{{}, read_law(value, law), value.path()};
  Obstacle& obstacle = made.obstacle;
  obstacle.shape = read_shape(value);
  obstacle.velocity = value.get<Eigen::Vector3d>("velocity");
  if (!(obstacle.velocity.stableNorm() <= speed_of_light))
    value.fail_at("velocity", fmt::format("is {:.6g} m/s", obstacle.velocity.stableNorm()),
                  "no speed above that of light");
  obstacle.from = value.get<double>("from");
  obstacle.until = value.find<double>("until").value_or(obstacle.until);
  if (!(obstacle.from < obstacle.until))
    value.fail_at("until", fmt::format("is {} s", obstacle.until),
                  fmt::format("a time after that of 'from', {} s", obstacle.from));
  if (obstacle.from >= duration && obstacle.from > 0.0)
    value.fail_at("from", fmt::format("is {} s", obstacle.from),
                  fmt::format("a time before the duration of {} s", duration));
  return made;
}

/// The touches by 'bodies' for all pairs, then those by 'pairs' for some.
std::vector<SceneTouch> read_touches(const SceneValue& contact, const ContactLaw& law, std::size_t bodies) {
  constexpr std::size_t most_bodies = 1000;  // their pairs make a table
  const auto which = contact.get<std::string>("bodies");
  const std::vector<SceneValue> pairs = contact.at("pairs").entries();
  if (which == "others" && bodies == 1)
    contact.fail_at("bodies", "is \"others\" with only one body", "\"themselves\", \"all\", or several bodies");
  if ((which != "none" || !pairs.empty()) && bodies > most_bodies)
    contact.fail(fmt::format("has bodies that touch among {}", bodies), fmt::format("at most {}", most_bodies));
  std::map<std::pair<std::uint32_t, std::uint32_t>, SceneTouch> all;
  for (std::uint32_t a = 0; a < bodies && which != "none"; ++a)
    for (std::uint32_t b = a; b < bodies; ++b)
      if (a == b ? which != "others" : which != "themselves") all[{a, b}] = {a, b, law, contact.path() + "/bodies"};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> named;
  for (const SceneValue& pair : pairs) {
    const SceneValue of = pair.at("of");
    const auto two = of.as<std::array<std::uint32_t, 2>>();
    for (const std::uint32_t body : two)
      if (body >= bodies) of.fail("is " + of.shown(), fmt::format("numbers below {}, of the bodies", bodies));
    const auto [first, second] = std::minmax(two[0], two[1]);
    const auto [place, is_new] = named.insert({{first, second}, pair.path()});
    if (!is_new) of.fail(fmt::format("is {}, like {}/of", of.shown(), place->second), "each pair once");
    if (pair.get<std::string>("touch") == "yes")
      all[{first, second}] = {first, second, read_law(pair, law), pair.path()};
    else
      all.erase({first, second});
  }
  std::vector<SceneTouch> touches;
  for (auto& [pair, touch] : all) touches.push_back(std::move(touch));
  return touches;
}

}  // namespace

void read_contact(const SceneValue& value, SceneFile& scene) {
  const ContactLaw law{.pressure = value.get<double>("pressure"),
                       .depth = value.get<double>("depth"),
                       .exponent = value.get<int>("exponent"),
                       .restitution = value.get<double>("restitution"),
                       .friction = value.get<double>("friction")};
  for (const SceneValue& one : value.at("obstacles").entries())
    scene.obstacles.push_back(read_obstacle(one, law, scene.duration));
  scene.touches = read_touches(value, law, scene.bodies().size());
  if (!scene.has_contact())
    value.fail("has no obstacle and no bodies that touch", "'obstacles', 'bodies' or 'pairs', or no 'contact'");
}

}  // namespace dartboard
