#include "validation/contact/drawn_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/plain/nan_maximum.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "validation/scenes/draw.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using OrderedJson = nlohmann::ordered_json;

constexpr double weight_of_mass = 9.81;  // [m/s^2]
constexpr int steps_of_scene = 400;
// Held bodies and what slides on them start this far apart [m], so that a plane selects one of them.
constexpr double apart = 1e-4;

/// One scene, in the order in which it is drawn. The way out of what is touched is upwards; `leaves` turns it.
class DrawnScene {
 public:
  DrawnScene(std::uint64_t seed, std::uint64_t number) : draw_(seed, number) {
    made_.kind = static_cast<DrawnKind>(number % 3);
    made_.with_bodies = draw_.happens(0.5);
    const auto all = integrators();
    do made_.integrator = all[draw_.below(all.size())].name;
    while (made_.with_bodies && made_.integrator == "energy-momentum");  // refused between bodies
    json_["name"] = fmt::format("seed {}, scene {}", seed, number);
    json_["integrator"] = made_.integrator;
    draw_body();
    draw_material();
    draw_law();
    switch (made_.kind) {
      case DrawnKind::leaves: draw_leaving(); break;
      case DrawnKind::slides: draw_slide(); break;
      case DrawnKind::drops: draw_drop(); break;
    }
    finish();
  }

  DrawnContact made() const { return made_; }

 private:
  void draw_body() {
    const double lot = draw_.uniform(0.0, 1.0);
    spacing_ = written(draw_.uniform(0.02, 0.05));
    if (lot < 0.2 && !made_.with_bodies) {
      const int nx = draw_.whole(1, 4), ny = draw_.whole(1, 4);
      body_["generate"]["sheet"] = {{"cells", {nx, ny}}, {"spacing", spacing_}};
      surface_ = true;
      size_ = {nx * spacing_, ny * spacing_, 0.0};
      height_ = 0.01;  // of a column whose weight is that of the sheet
      made_.about = "a sheet";
    } else if (lot < 0.4) {
      const double radius = written(draw_.uniform(0.03, 0.06));
      const int layers = draw_.whole(1, 3);
      body_["generate"]["ball"] = {{"layers", layers}, {"radius", radius}};
      ball_ = true;
      spacing_ = radius / layers;
      size_ = Vector3d::Constant(2.0 * radius);
      height_ = radius;
      made_.about = "a ball";
    } else {
      const int nx = draw_.whole(1, 3), ny = draw_.whole(1, 3), nz = draw_.whole(1, 2);
      hexahedra_ = draw_.happens(0.3);
      body_["generate"]["box"] = {{"cells", {nx, ny, nz}}, {"spacing", spacing_}};
      if (hexahedra_)
        body_["generate"]["box"]["kind"] = "hexahedra";
      else
        body_["generate"]["box"]["pattern"] = draw_.happens(0.5) ? "kuhn" : "mirrored";
      size_ = {nx * spacing_, ny * spacing_, nz * spacing_};
      height_ = size_.z();
      made_.about = hexahedra_ ? "a box of hexahedra" : "a box";
    }
  }

  void draw_material() {
    const double density = surface_ ? 10.0 : 1000.0;
    const bool elements = hexahedra_ || draw_.happens(0.5);
    OrderedJson material{{"density", density}};
    if (elements) {
      const double young = written(surface_ ? draw_.logarithmic(1e2, 1e4) : draw_.logarithmic(1e4, 3e6));
      material.update({{"young", young}, {"poisson", written(draw_.uniform(0.0, 0.4))}});
      rate_ = 10.0 * std::sqrt(young / density) / spacing_;
      made_.about += fmt::format(" of {:.2g} {}", young, surface_ ? "N/m" : "Pa");
    } else {
      const double mass = density * std::pow(spacing_, surface_ ? 2 : 3);
      const double stiffness = written(mass * draw_.logarithmic(1e4, 1e6));
      material["stiffness"] = stiffness;
      rate_ = 6.0 * std::sqrt(stiffness / mass);
      made_.about += fmt::format(" of springs of {:.2g} N/m", stiffness);
    }
    material["viscosity"] = 0;
    json_["material"] = material;
    load_ = density * weight_of_mass * (surface_ ? 1.0 : height_);
    area_mass_ = density * (surface_ ? 1.0 : 0.25 * spacing_);
  }

  /// The depth that carries the weight, and the law that has it there.
  void draw_law() {
    at_rest_ = made_.kind == DrawnKind::drops ? draw_.logarithmic(1e-5, 1e-2) : draw_.uniform(2e-4, 2e-3);
    exponent_ = draw_.whole(2, 4);
    const double depth = written(at_rest_ * draw_.uniform(1.2, 5.0));
    const double pressure = written(load_ * std::pow(depth / at_rest_, exponent_ - 1));
    const double restitution = draw_.happens(0.3) ? 1.0 : written(draw_.uniform(0.05, 1.0));
    json_["contact"] = {
        {"pressure", pressure}, {"depth", depth}, {"exponent", exponent_}, {"restitution", restitution}};
    // twice the depth at rest is reached where a weight is let go
    const double slope = (exponent_ - 1) * pressure / depth * std::pow(2.0 * at_rest_ / depth, exponent_ - 2);
    rate_ = std::max(rate_, 2.0 * std::sqrt(slope / area_mass_));
    step_ = written(draw_.uniform(0.2, 0.7) / rate_);
    made_.about += fmt::format(", p = {}, restitution {:.2g}", exponent_, restitution);
  }

  /// The lowest place of the body over its `translate`.
  double low() const { return ball_ ? -0.5 * size_.z() : 0.0; }
  Vector3d lifted_by(double z) const {
    const Vector3d middle = ball_ ? Vector3d(0, 0, 0) : Vector3d(0.5 * size_.x(), 0.5 * size_.y(), 0.0);
    return Vector3d(-middle.x(), -middle.y(), z - low());
  }

  void draw_leaving() {
    const double inside = written(at_rest_ * draw_.uniform(0.2, 1.0));
    made_.speed = written(inside / (step_ * draw_.logarithmic(1.0, 200.0)));
    json_["gravity"] = {0, 0, 0};
    if (made_.with_bodies) {
      // the other is above, and flies off
      const double edge = written(draw_.uniform(0.02, 0.05));
      const int across = 1 + static_cast<int>(std::ceil(std::max(size_.x(), size_.y()) / edge));
      const double half = 0.5 * across * edge;
      OrderedJson other;
      other["generate"]["box"] = {{"cells", {across, across, 1}}, {"spacing", edge}, {"pattern", "kuhn"}};
      other["translate"] = json_of({-half, -half, size_.z() - inside});
      other["initial_velocity"] = {0, 0, made_.speed};
      body_["translate"] = json_of(lifted_by(0.0));
      json_["bodies"] = {body_, other};
      json_["contact"]["bodies"] = "others";
      made_.about += ", drawn off by another body";
      return;
    }
    const Vector3d away = draw_.direction();
    OrderedJson obstacle;
    const double lot = draw_.uniform(0.0, 1.0);
    if (lot < 0.4) {
      obstacle["plane"] = plane_of(Vector3d(0, 0, inside), Vector3d(0, 0, 1));
    } else if (lot < 0.7) {
      obstacle["box"] = {{"min", {-1, -1, -1}}, {"max", json_of({1, 1, inside})}};
    } else {
      const double radius = written(draw_.uniform(0.5, 2.0));
      obstacle["sphere"] = {{"centre", json_of({0, 0, inside - radius})}, {"radius", radius}};
    }
    // sideways, too, without friction
    Vector3d velocity(0.5 * away.x(), 0.5 * away.y(), -1.0);
    obstacle["velocity"] = json_of(made_.speed * velocity);
    json_["contact"]["obstacles"] = OrderedJson::array({obstacle});
    body_["translate"] = json_of(lifted_by(0.0));
    json_["body"] = body_;
    made_.about += ", left by an obstacle";
  }

  void draw_slide() {
    const double way = draw_.uniform(0.2, 1.5) * spacing_;
    made_.speed = written(way / (steps_of_scene * step_));
    json_["gravity"] = {0, 0, -weight_of_mass};
    body_["translate"] = json_of(lifted_by(apart));
    made_.velocity = {made_.speed, 0, 0};
    const double reach = 0.5 * std::max(size_.x(), size_.y()) + way + 0.03;
    OrderedJson all = OrderedJson::array(), row = OrderedJson::array({body_});
    double from = -reach;
    int boxes = 0;
    for (; from < reach; ++boxes) {
      if (made_.with_bodies) {
        const double edge = written(draw_.uniform(0.03, 0.06));
        const int nx = draw_.whole(1, 3), ny = 2 * static_cast<int>(std::ceil(reach / edge));
        OrderedJson one;
        one["generate"]["box"] = {{"cells", {nx, ny, 1}}, {"spacing", edge}, {"pattern", "kuhn"}};
        one["translate"] = {written(from), written(-0.5 * ny * edge), -edge};
        row.push_back(one);
        from = written(written(from) + nx * edge);
      } else {
        const double to = written(from + draw_.uniform(0.01, 0.1)), over = draw_.happens(0.5) ? 0.0 : 0.01;
        all.push_back(
            {{"box",
              {{"min", {written(from - over), -1, written(-draw_.logarithmic(0.02, 1.0))}}, {"max", {to, 1, 0}}}}});
        from = to;
      }
    }
    if (made_.with_bodies) {
      json_["bodies"] = row;
      json_["contact"]["bodies"] = "others";
      json_["fixed"] = OrderedJson::array({{{"plane", plane_of({0, 0, 0.5 * apart}, {0, 0, -1})}}});
    } else {
      json_["body"] = body_;
      json_["contact"]["obstacles"] = all;
    }
    made_.about += fmt::format(", over {} {}", boxes, made_.with_bodies ? "bodies" : "boxes");
  }

  void draw_drop() {
    made_.speed = written(draw_.logarithmic(0.02, 2.0));
    json_["gravity"] = {0, 0, -weight_of_mass};
    body_["translate"] = json_of(lifted_by(std::max(apart, 20.0 * step_ * made_.speed)));
    made_.velocity = {0, 0, -made_.speed};
    double thickness = written(draw_.logarithmic(1e-4, 0.1));
    if (made_.with_bodies) {
      const double half = 0.5 * std::max(size_.x(), size_.y()) + 0.01;
      const int across = std::clamp(static_cast<int>(std::ceil(2.0 * half / thickness)), 1, 14);
      const double edge = std::max(thickness, written(2.0 * half / across));
      thickness = edge;
      OrderedJson plate;
      plate["generate"]["box"] = {{"cells", {across, across, 1}}, {"spacing", edge}, {"pattern", "kuhn"}};
      plate["translate"] = json_of({-0.5 * across * edge, -0.5 * across * edge, -edge});
      json_["bodies"] = {body_, plate};
      json_["contact"]["bodies"] = "others";
      json_["fixed"] = OrderedJson::array({{{"plane", plane_of({0, 0, 0.5 * apart}, {0, 0, -1})}}});
    } else {
      json_["contact"]["obstacles"] =
          OrderedJson::array({{{"box", {{"min", {-1, -1, -thickness}}, {"max", {1, 1, 0}}}}}});
      json_["body"] = body_;
    }
    made_.bottom = -thickness;
    made_.about += fmt::format(", onto {} {:.2g} mm thick at {:.2g} m/s", made_.with_bodies ? "a body" : "a plate",
                               1e3 * thickness, made_.speed);
  }

  void finish() {
    if (json_.contains("bodies"))
      json_["bodies"][0]["initial_velocity"] = json_of(made_.velocity);
    else
      json_["initial_velocity"] = json_of(made_.velocity);
    json_["step"] = step_;
    json_["duration"] = steps_of_scene * step_;
    made_.scene = json_;
  }

  Draw draw_;
  DrawnContact made_;
  OrderedJson json_, body_;
  bool surface_ = false, ball_ = false, hexahedra_ = false;
  Vector3d size_{0, 0, 0};
  double spacing_ = 0.0, height_ = 0.0;  // [m]
  double rate_ = 0.0;                    // [1/s] about the largest of the body, or of its contact
  double load_ = 0.0;                    // [Pa] of its weight
  double area_mass_ = 0.0;               // [kg/m^2] behind a place of its boundary
  double at_rest_ = 0.0, step_ = 0.0;
  int exponent_ = 2;
};

/// The body that is watched: the vertices that start with its velocity.
class Watched {
 public:
  Watched(const Simulation& simulation, const Vector3d& velocity) : columns_(simulation.body().vertices()) {
    for (std::uint32_t i = 0; i < columns_.size(); ++i)
      if (columns_.velocity[i] == velocity) vertices_.push_back(i);
  }
  Vector3d velocity() const {
    Vector3d sum(0, 0, 0);
    double mass = 0.0;
    for (const std::uint32_t i : vertices_) {
      sum += columns_.mass[i] * columns_.velocity[i];
      mass += columns_.mass[i];
    }
    return sum / mass;
  }
  bool has(std::uint32_t vertex) const { return std::ranges::binary_search(vertices_, vertex); }
  double lowest() const {
    double z = columns_.position[vertices_.front()].z();
    for (const std::uint32_t i : vertices_) z = std::min(z, columns_.position[i].z());
    return z;
  }

 private:
  const VertexColumns& columns_;
  std::vector<std::uint32_t> vertices_;
};

/// Of the ways out of what is below for places of the body: the largest part across the vertical, over the depth of the
/// law.
double largest_way_sideways(const Simulation& simulation, const Watched& body) {
  const BodyContact& contact = *simulation.body().contacts().bodies;
  double largest = 0.0;
  for (const BodyTouch& touch : contact.touching({simulation.body().vertices().position}))
    if (body.has(contact.samples()[touch.sample].nodes[0]))
      largest = max_or_nan(largest, touch.depth * touch.normal.head<2>().norm() / contact.laws()[touch.law].depth);
  return largest;
}

bool is_about_depth(const ContactWarning& warning) {
  using Kind = ContactWarning::Kind;
  switch (warning.kind) {
    case Kind::too_deep:
    case Kind::too_fast:
    case Kind::will_be_fast:
    case Kind::too_thin:
    case Kind::out_of_reach:
    case Kind::comes_through: return true;
    case Kind::starts_inside:
    case Kind::too_small:
    case Kind::soft_body: break;
  }
  return false;
}

}  // namespace

std::string_view name_of(DrawnKind kind) {
  switch (kind) {
    case DrawnKind::leaves: return "leaves";
    case DrawnKind::slides: return "slides";
    case DrawnKind::drops: break;
  }
  return "drops";
}

DrawnContact draw_contact(std::uint64_t seed, std::uint64_t number) { return DrawnScene(seed, number).made(); }

DrawnContactFound run_drawn_contact(const DrawnContact& drawn) {
  DrawnContactFound found;
  Simulation simulation(parse_scene(drawn.scene.dump(), "drawn scene", ""));
  const Watched body(simulation, drawn.velocity);
  // away from what is touched: another body is above
  const double side = drawn.kind == DrawnKind::leaves && drawn.with_bodies ? -1.0 : 1.0;
  double most_apart = side * body.velocity().z();
  found.ended = true;
  while (found.ended && simulation.steps_done() < simulation.step_count()) {
    found.ended = !simulation.advance();
    if (!found.ended) break;
    found.touched = found.touched || simulation.diagnostics().contact->contacts > 0;
    const Vector3d now = body.velocity();
    if (drawn.kind == DrawnKind::leaves) {
      found.pulled = max_or_nan(found.pulled, (most_apart - side * now.z()) / drawn.speed);
      most_apart = max_or_nan(most_apart, side * now.z());
    }
    if (drawn.kind == DrawnKind::slides && drawn.with_bodies)
      found.caught = max_or_nan(found.caught, largest_way_sideways(simulation, body));
    if (drawn.kind == DrawnKind::slides && !drawn.with_bodies)
      found.caught = max_or_nan(found.caught, std::abs(now.x() - drawn.speed) / drawn.speed);
    if (drawn.kind == DrawnKind::drops) found.lost = found.lost || body.lowest() < drawn.bottom;
  }
  // what has diverged is not judged, but by its warnings
  if (!found.ended) found.pulled = found.caught = 0.0;
  found.warned = std::ranges::any_of(simulation.contact_warnings(), is_about_depth);
  return found;
}

}  // namespace dartboard
