#include "validation/scenes/random_scenes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>

#include "validation/scenes/draw.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

TradeoffScene read(const Json& json) {
  return scene_of_file(parse_scene(json.dump(), json.at("name").get<std::string>(), ""));
}

/// What a body is like before anything happens to it.
struct BodyFacts {
  double rate, edge;      // [1/s] omega_max; [m]
  double cost;            // of its forces, in springs
  Vector3d centre, size;  // [m]
};
BodyFacts facts_of(Json json) {
  json["step"] = json["duration"] = 1.0;
  const TradeoffScene scene = read(json);
  const Mesh& mesh = scene.frozen->problem.mesh;
  Vector3d low = mesh.points[0], high = low;
  for (const Vector3d& x : mesh.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const bool elements = scene.frozen->file.has_elements();
  const auto springs = static_cast<double>(elements ? 6 * mesh.cell_count() : scene.motion.network.springs.size());
  return {scene.fastest_rate, scene.edge, springs, 0.5 * (low + high), high - low};
}

/// One scene, in the order in which it is drawn.
class RandomScene {
 public:
  RandomScene(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options)
      : draw_(seed, number), options_(options) {
    json_["name"] = fmt::format("seed {}, scene {}", seed, number);
    json_["about"] = "";
    draw_body();
    draw_material();
    body_ = facts_of(json_);
    slow_rate_ = body_.rate / draw_.uniform(4.0, 24.0);
    strain_ = draw_.logarithmic(options.least_strain, options.most_strain);
    draw_hold();
    draw_motion();
    const double contrast = draw_inclusion();
    const double rate = contrast > 1.0 ? facts_of(json_).rate : body_.rate;
    draw_damping(rate, contrast);
    draw_duration(rate);
    if (!options.only_springs) {
      draw_load();
      draw_event();
    }
    json_["about"] = about_;
  }

  Json json() const { return json_; }

 private:
  void draw_body() {
    const double points = draw_.logarithmic(options_.least_points, options_.most_points), edge = std::cbrt(points);
    const auto cubes = [&](double part) { return std::max(2, static_cast<int>(part)) - 1; };
    const double kind = draw_.uniform(0.0, 1.0);
    elements_ = !options_.only_springs && draw_.happens(0.4);
    Json body;
    if (kind < 0.25) {
      const int layers = std::max(2, static_cast<int>(std::round(std::cbrt(points * 0.6))));
      body["ball"] = {{"layers", layers}, {"radius", 0.1}};
      about_ += fmt::format("a ball of {} layers", layers);
    } else if (kind < 0.45 && !options_.only_springs) {
      const int nx = cubes(std::sqrt(points) * draw_.uniform(0.6, 1.2));
      const int ny = std::max(2, static_cast<int>(points / (nx + 1))) - 1;
      body["sheet"] = {{"cells", {nx, ny}}, {"spacing", 0.02}};
      surface_ = true;
      about_ += fmt::format("a sheet of {} x {} squares", nx, ny);
    } else {
      // two sides, and the third as long as the points allow
      const int nx = cubes(edge * draw_.uniform(0.6, 1.2)), ny = cubes(edge * draw_.uniform(0.6, 1.2));
      const int nz = std::clamp(static_cast<int>(points / ((nx + 1) * (ny + 1))), 2, 80) - 1;
      const bool hexahedra = elements_ && draw_.happens(0.4);
      body["box"] = {{"cells", {nx, ny, nz}}, {"spacing", 0.02}};
      if (hexahedra)
        body["box"]["kind"] = "hexahedra";
      else
        body["box"].update({{"jitter", written(draw_.uniform(0.0, 0.3))},
                            {"seed", draw_.below(1000000)},
                            {"pattern", draw_.happens(0.5) ? "kuhn" : "mirrored"}});
      about_ += fmt::format("a box of {} x {} x {} {}", nx, ny, nz, hexahedra ? "hexahedra" : "cubes");
    }
    json_["body"] = {{"generate", body}};
  }

  void draw_material() {
    json_["material"] = {{"density", 1000}};
    stiffness_ = written(elements_ ? draw_.logarithmic(1e3, 1e6) : draw_.logarithmic(1.0, 1e3));
    if (elements_)
      json_["material"].update({{"young", stiffness_}, {"poisson", written(draw_.uniform(0.0, 0.45))}});
    else
      json_["material"].update({{"stiffness", stiffness_}, {"damping", 0}});
    json_["material"]["viscosity"] = 0;
    json_["gravity"] = {0, 0, 0};
    about_ += elements_ ? " of elements" : " of springs";
  }

  /// [m] About how far the body reaches in a direction: a ball by its radius, others by a corner.
  double reach(const Vector3d& direction) const {
    if (json_["body"]["generate"].contains("ball")) return 0.1;
    return 0.5 * body_.size.cwiseProduct(direction).cwiseAbs().sum();
  }

  Json side(const Vector3d& direction) const {
    return plane_of(body_.centre + 0.7 * reach(direction) * direction, direction);
  }

  void draw_hold() {
    side_ = draw_.direction();
    if (surface_) side_ = Vector3d(side_.x(), side_.y(), 0.0).normalized();
    if (draw_.happens(0.5)) {
      if (!options_.only_springs && draw_.happens(0.3)) {
        driven_ = true;
        about_ += ", one side driven";
      } else {
        json_["fixed"] = Json::array({{{"plane", side(side_)}}});
        about_ += ", clamped";
      }
    } else {
      free_ = true;
      about_ += ", free";
    }
  }

  void draw_motion() {
    // gravity moves the body by about an edge within a slow turn
    const double gravity = draw_.uniform(options_.least_sag, options_.most_sag) * body_.edge * slow_rate_ * slow_rate_;
    const Vector3d down = draw_.direction();
    const bool lands = free_ && !options_.only_springs && draw_.happens(0.4);
    if (lands || draw_.happens(0.5)) {
      json_["gravity"] = json_of(gravity * down);
      about_ += ", gravity";
    }
    if (lands) draw_floor(down);
    Eigen::Matrix3d speed;
    speed << -0.5, 0.5, 0.0, 0.25, 1.0, -0.25, 0.125, 0.0, -0.75;
    speed *= strain_ * slow_rate_;
    if (free_ && draw_.happens(0.4)) {
      const Vector3d spin = draw_.direction() * (draw_.uniform(0.2, 1.0) * slow_rate_ * 0.2);
      speed.col(0) += spin.cross(Vector3d::UnitX());
      speed.col(1) += spin.cross(Vector3d::UnitY());
      speed.col(2) += spin.cross(Vector3d::UnitZ());
      about_ += ", spinning";
    }
    json_["initial_velocity"] = {{"constant", lands ? json_of(fall_speed_ * down) : Json{0, 0, 0}},
                                 {"linear", {json_of(speed.row(0)), json_of(speed.row(1)), json_of(speed.row(2))}},
                                 {"centre", json_of(body_.centre)}};
  }

  /// A floor that the body comes to within some slow turns, and comes into by a few hundredths of an edge.
  void draw_floor(const Vector3d& down) {
    fall_speed_ = written(draw_.uniform(0.2, 1.0) * strain_ * slow_rate_ * reach(down));
    const double depth = written(0.05 * body_.edge);
    const double pressure = written(1000.0 * 2.0 * reach(down) * fall_speed_ * fall_speed_ / depth);
    json_["contact"] = {
        {"pressure", pressure},
        {"depth", depth},
        {"exponent", 2 + draw_.below(3)},
        {"restitution", draw_.happens(0.5) ? 1.0 : 0.5},
        {"friction", draw_.happens(0.5) ? 0.0 : 0.3},
        {"obstacles",
         Json::array({{{"plane", plane_of(body_.centre + (reach(down) + 0.05 * body_.edge) * down, -down)}}})}};
    about_ += ", falls on a floor";
  }
  /// How much stiffer a part of it is; 1 without one.
  double draw_inclusion() {
    if (!draw_.happens(0.3)) return 1.0;
    const double contrast = draw_.logarithmic(3.0, elements_ ? 1e2 : 1e4);
    const Vector3d place = body_.centre + 0.25 * body_.size.cwiseProduct(draw_.direction());
    Json material{{"density", 1000}};
    if (elements_)
      material.update({{"young", written(contrast * stiffness_)}, {"poisson", 0.3}});
    else
      material.update({{"stiffness", written(contrast * stiffness_)}, {"damping", 0}});
    json_["regions"] = Json::array(
        {{{"cells", {{"sphere", {{"centre", json_of(place)}, {"radius", written(0.25 * body_.size.maxCoeff())}}}}},
          {"material", material}}});
    about_ += fmt::format(", a part of it {:.3g} times stiffer", contrast);
    return contrast;
  }

  void draw_damping(double rate, double contrast) {
    const double lot = draw_.uniform(0.0, 1.0);
    if (lot < 0.4) return;
    damped_ = true;
    const double ratio = lot < 0.75 ? draw_.logarithmic(1e-3, 0.1) : draw_.logarithmic(0.3, 1.5);
    const auto damp = [&](Json& material, double factor) {
      if (elements_ && surface_) return;  // nothing but viscosity damps membranes
      if (elements_)
        material["damping"] = {{"ratio", written(ratio)}, {"frequency", written(rate / 6.2831853)}};
      else
        material["damping"] = written(2.0 * ratio / rate * factor * stiffness_);
    };
    damp(json_["material"], 1.0);
    if (json_.contains("regions")) damp(json_["regions"][0]["material"], contrast);
    json_["material"]["viscosity"] = written(draw_.uniform(0.0, 0.02) * ratio * rate);
    about_ += fmt::format(", damping ratio {:.2g}", ratio);
  }

  void draw_duration(double rate) {
    const double a_spring = (damped_ ? options_.damped_work : 1.0) / body_.cost;
    const double least = std::max(options_.least_phase, options_.least_work * a_spring);
    const double most = std::clamp(options_.most_work * a_spring, least, std::max(options_.most_phase, least));
    duration_ = written(draw_.logarithmic(least, std::max(most, 1.01 * least)) / rate);
    json_["duration"] = duration_;
    json_["step"] = duration_ / std::ceil(2.0 * rate * duration_);
  }

  double time(double low, double high) { return written(draw_.uniform(low, high) * duration_); }

  void draw_load() {
    const double acceleration = strain_ * 0.2 * body_.size.maxCoeff() * slow_rate_ * slow_rate_;
    if (driven_) {
      const double speed = strain_ * 0.2 * body_.size.maxCoeff() * slow_rate_;
      json_["driven"] = Json::array({{{"plane", side(side_)},
                                      {"velocity", json_of(speed * draw_.direction())},
                                      {"from", time(0.0, 0.2)},
                                      {"until", time(0.6, 0.9)},
                                      {"reverse_every", written(draw_.uniform(1.0, 3.0) / slow_rate_)}}});
    }
    if (!draw_.happens(0.3)) return;
    Json force{{"plane", side(-side_)}, {"acceleration", json_of(acceleration * draw_.direction())}};
    if (draw_.happens(0.3))
      force["over_time"] = {{{"at", time(0.0, 0.2)}, {"factor", 0}}, {{"at", time(0.3, 0.8)}, {"factor", 1}}};
    else
      force.update({{"from", time(0.0, 0.4)}, {"until", time(0.5, 0.9)}});
    json_["forces"] = Json::array({force});
    about_ += ", pulled for a time";
  }

  void draw_event() {
    const double lot = draw_.uniform(0.0, 1.0);
    const Json middle = plane_of(body_.centre, surface_ ? Vector3d(side_.y(), -side_.x(), 0.1) : draw_.direction());
    Json event;
    if (lot < 0.25) {
      event = {{"at", time(0.1, 0.9)}, {"dissociate", {{"plane", middle}}}};
      about_ += ", cut in two";
    } else if (lot < (surface_ ? 0.5 : 0.4)) {
      const Vector3d place = body_.centre + 0.4 * body_.size.cwiseProduct(draw_.direction());
      event = {
          {"at", time(0.1, 0.9)},
          {"remove", {{"sphere", {{"centre", json_of(place)}, {"radius", written(0.2 * body_.size.maxCoeff())}}}}}};
      about_ += ", cells removed";
    } else if (lot < 0.5) {
      const double stress = elements_ ? stiffness_ : stiffness_ / body_.edge;
      event = {{"tear_where_stressed", {{"threshold", written(0.5 * strain_ * stress)}, {"plane", middle}}}};
      about_ += ", may tear along a seam";
    } else {
      return;
    }
    json_["events"] = Json::array({event});
  }

  Draw draw_;
  const RandomSceneOptions& options_;
  Json json_;
  std::string about_;
  BodyFacts body_{};
  bool elements_ = false, surface_ = false, free_ = false, driven_ = false, damped_ = false;
  double stiffness_ = 0.0;  // [N/m] of springs, [Pa] of elements
  double slow_rate_ = 0.0, strain_ = 0.0, fall_speed_ = 0.0, duration_ = 0.0;
  Vector3d side_{0, 0, 1};
};

}  // namespace

Json random_scene_file(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options) {
  return RandomScene(seed, number, options).json();
}

TradeoffScene random_scene(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options) {
  return read(random_scene_file(seed, number, options));
}

}  // namespace dartboard
