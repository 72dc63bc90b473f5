#include "core/scene/body/contact_forecast.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/extent.h"
#include "core/scene/file/selections/selection.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// What is behind the boundary of the bodies.
struct Behind {
  double density = 0.0;  // [kg/m^3] the largest of solids
  double surface = 0.0;  // [kg/m^2] the largest of surfaces, and of chains over their width
  double young = std::numeric_limits<double>::infinity();  // [Pa] the least of solids that have one
};

Behind behind_boundaries(const Problem& problem) {
  Behind behind;
  const Mesh& mesh = problem.mesh;
  const CellMaterials materials = problem.cell_materials();
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const Material& material = materials[c];
    double& density = dimension(mesh.kinds[c]) == 3 ? behind.density : behind.surface;
    density = std::max(density, material.density);
    if (dimension(mesh.kinds[c]) == 3 && material.young > 0.0) behind.young = std::min(behind.young, material.young);
  }
  for (std::size_t k = mesh.cell_count(); k < mesh.cell_count() + mesh.links.size(); ++k)
    if (materials[k].width > 0.0) behind.surface = std::max(behind.surface, materials[k].density / materials[k].width);
  return behind;
}

/// What presses onto a surface, or hits it: a column of the body, and the way it comes.
struct Column {
  double mass = 0.0, height = 0.0, young = 0.0;  // [kg/m^2], [m], [Pa]
  double gravity = 0.0, upright = 1.0;           // [m/s^2], and the share of its weight that presses
  double speed = 0.0, fall = 0.0;                // [m/s] before a fall of so many [m], or of ...
  double duration = 0.0;                         // [s]
};

ContactForecast forecast(const ContactLaw& law, const Column& c) {
  ContactForecast f;
  f.mass_behind = c.mass;
  f.depth_at_rest = law.depth_at_rest(c.mass * (c.gravity * c.upright));
  f.speed = std::min(std::sqrt(c.speed * c.speed + 2.0 * c.gravity * c.fall), c.speed + c.gravity * c.duration);
  f.depth_at_impact = law.depth_at_impact(c.mass * f.speed * f.speed / 2.0);
  const double deepest = std::max(f.depth_at_rest, f.depth_at_impact);
  f.share = deepest / law.depth;
  if (deepest > 0.0) f.stiffness_ratio = c.young / c.height / law.stiffness(1.0, deepest);
  return f;
}

class Forecaster {
 public:
  Forecaster(const SceneFile& scene, const Problem& problem)
      : scene_(scene),
        points_(problem.mesh.points),
        gravity_(problem.surroundings.gravity.norm()),
        behind_(behind_boundaries(problem)) {
    if (gravity_ > 0.0) up_ = -problem.surroundings.gravity / gravity_;
    velocities_ = problem.initial_velocity;
    if (velocities_.empty()) velocities_.emplace_back(0, 0, 0);
    for (const SceneDrive& drive : scene.driven)
      for (const std::uint32_t p : select_points(drive.vertices, points_, drive.path)) {
        add_velocities(drive, points_[p]);
      }
  }

  ContactForecast at(const SceneObstacle& one) const {
    const auto* plane = std::get_if<HalfSpace>(&one.obstacle.shape);
    return forecast(one.law, {.mass = std::max(behind_.density * height(one), behind_.surface),
                              .height = height(one),
                              .young = behind_.young,
                              .gravity = gravity_,
                              .upright = plane == nullptr ? 1.0 : std::max(0.0, up_.dot(plane->normal)),
                              .speed = own_speed(one),
                              .fall = fall_onto(one),
                              .duration = scene_.duration});
  }

 private:
  /// The velocities that a drive gives to the vertex at x at rest; of a path or a turn its largest speed, along each
  /// axis in both directions.
  void add_velocities(const SceneDrive& drive, const Vector3d& x) {
    if (!drive.has_table()) {
      velocities_.push_back(drive.velocity.at(x));
      if (drive.reverse_every) velocities_.push_back(-velocities_.back());
      return;
    }
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0})
        velocities_.push_back(sign * drive.largest_speed_of(x) * Vector3d::Unit(axis));
  }
  double height(const SceneObstacle& one) const {
    if (const auto* plane = std::get_if<HalfSpace>(&one.obstacle.shape)) return extent_along(plane->normal, points_);
    if (gravity_ > 0.0) return extent_along(up_, points_);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, extent_along(Vector3d::Unit(k), points_));
    return longest;
  }

  /// The speed before anything falls; for obstacles that move, while they move and while they are at rest.
  double own_speed(const SceneObstacle& one) const {
    double most = 0.0;
    for (const Vector3d& v : velocities_)
      most = std::max({most, v.norm(), one.moves() ? (v - one.obstacle.velocity).norm() : 0.0});
    return most;
  }

  double fall_onto(const SceneObstacle& one) const {
    if (gravity_ == 0.0) return 0.0;
    double most = 0.0;
    if (const auto* plane = std::get_if<HalfSpace>(&one.obstacle.shape)) {
      const double slope = up_.dot(plane->normal);
      for (const Vector3d& x : points_)
        if (slope > 0.0) most = std::max(most, (x - plane->point).dot(plane->normal) / slope);
      return most;
    }
    double top = 0.0;
    if (const auto* ball = std::get_if<Ball>(&one.obstacle.shape)) {
      top = ball->centre.dot(up_) + ball->radius;
    } else {
      const Block& block = std::get<Block>(one.obstacle.shape);
      top = ((block.low + block.high) / 2).dot(up_) + ((block.high - block.low) / 2).dot(up_.cwiseAbs());
    }
    for (const Vector3d& x : points_) most = std::max(most, x.dot(up_) - top);
    return most;
  }

  const SceneFile& scene_;
  std::span<const Vector3d> points_;
  double gravity_;
  Behind behind_;
  Vector3d up_{0, 0, 0};
  std::vector<Vector3d> velocities_;  // initial and driven velocities of vertices
};

/// The forecast of contacts between bodies.
class TouchForecaster {
 public:
  TouchForecaster(const SceneFile& scene, const Problem& problem) : scene_(scene), behind_(behind_boundaries(problem)) {
    const Vector3d& g = problem.surroundings.gravity;
    gravity_ = g.norm();
    bodies_.resize(problem.bodies.count());
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  // for points of chains
    std::vector<std::uint32_t> body_of(problem.mesh.points.size(), none);
    for (std::uint32_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t c = problem.bodies.cell[b]; c < problem.bodies.cell[b + 1]; ++c)
        for (const std::uint32_t p : problem.mesh.cell(c)) body_of[p] = b;
    // without gravity, along the axis that a body is longest along
    for (std::uint32_t p = 0; p < body_of.size(); ++p) {
      if (body_of[p] == none) continue;
      Body& body = bodies_[body_of[p]];
      const Vector3d& x = problem.mesh.points[p];
      const Vector3d heights = gravity_ > 0.0 ? Vector3d::Constant(-x.dot(g) / gravity_) : x;
      body.low = body.low.cwiseMin(heights);
      body.high = body.high.cwiseMax(heights);
      if (!problem.initial_velocity.empty()) body.speed = std::max(body.speed, problem.initial_velocity[p].norm());
    }
    for (const SceneDrive& drive : scene.driven)
      for (const std::uint32_t p : select_points(drive.vertices, problem.mesh.points, drive.path)) {
        if (body_of[p] == none) continue;
        double& speed = bodies_[body_of[p]].speed;
        speed = std::max(speed, drive.largest_speed_of(problem.mesh.points[p]));
      }
    Vector3d low = Body().low, high = Body().high;
    for (const Body& body : bodies_) {
      if (!(body.high[0] >= body.low[0])) continue;  // a chain
      low = low.cwiseMin(body.low);
      high = high.cwiseMax(body.high);
      heights_ += body.height();
    }
    extent_ = (high - low).maxCoeff();
    changes_ = std::ranges::any_of(scene.events, changes_topology, &SceneEvent::action);
  }

  ContactForecast at(const SceneTouch& touch) const {
    const Body &a = bodies_[touch.first], &b = bodies_[touch.second];
    const bool itself = touch.first == touch.second;
    const double column = itself ? a.height() : std::min(heights_ - std::min(a.height(), b.height()), extent_);
    return forecast(touch.law, {.mass = behind_.density * column,
                                .height = column,
                                .young = behind_.young,
                                .gravity = gravity_,
                                .upright = 1.0,
                                .speed = a.speed + b.speed,
                                .fall = itself ? (changes_ ? a.height() : 0.0) : std::abs(a.high[0] - b.high[0]),
                                .duration = scene_.duration});
  }

 private:
  struct Body {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    double speed = 0.0;  // of its fastest vertex [m/s]
    double height() const { return (high - low).maxCoeff(); }
  };

  const SceneFile& scene_;
  Behind behind_;
  double gravity_ = 0.0, heights_ = 0.0, extent_ = 0.0;
  bool changes_ = false;  // the topology
  std::vector<Body> bodies_;
};

std::vector<ContactForecast> at_obstacles(const SceneFile& scene, const Problem& problem) {
  std::vector<ContactForecast> contacts;
  if (scene.obstacles.empty()) return contacts;
  const Forecaster forecaster(scene, problem);
  for (const SceneObstacle& one : scene.obstacles) contacts.push_back(forecaster.at(one));
  return contacts;
}

std::vector<TouchForecast> between_bodies(const SceneFile& scene, const Problem& problem) {
  std::vector<TouchForecast> keys;
  if (scene.touches.empty()) return keys;
  const TouchForecaster forecaster(scene, problem);
  for (const SceneTouch& touch : scene.touches) {
    const ContactForecast f = forecaster.at(touch);
    const auto known = std::ranges::find(keys, touch.path, &TouchForecast::path);
    if (known == keys.end())
      keys.push_back({touch.path, touch.law, touch.first, touch.second, f});
    else if (f.share > known->contact.share)
      *known = {touch.path, touch.law, touch.first, touch.second, f};
  }
  return keys;
}

}  // namespace

ExpectedContacts expect_contacts(const SceneFile& scene, const Problem& problem) {
  return {at_obstacles(scene, problem), between_bodies(scene, problem)};
}

double ExpectedContacts::share() const {
  double most = 0.0;
  for (const ContactForecast& f : obstacles) most = std::max(most, f.share);
  for (const TouchForecast& f : bodies) most = std::max(most, f.contact.share);
  return most;
}

double contact_rate(const SpringSystem& system, const Contacts& contacts, double share_of_depth) {
  std::vector<double> mobility(system.inverse_mass.begin(), system.inverse_mass.end());
  for (std::size_t i = 0; i < mobility.size(); ++i)
    if (system.fixed[i] != 0) mobility[i] = 0.0;
  return std::sqrt(contacts.frequency_squared(mobility, share_of_depth));
}

StableStep with_contact(StableStep limits, double rate) {
  limits.upper = std::hypot(limits.upper, rate);
  limits.any_state = std::hypot(limits.any_state, rate);
  limits.across = std::hypot(limits.across, rate);
  return limits;
}

}  // namespace dartboard
