// What single keys say, evaluated here from the motion: where drives have taken vertices, and how deep obstacles are.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/overloads.h"
#include "core/scene/file/scene_problem.h"
#include "validation/drawn/relations/comparison.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double rounding = 1e-11;

/// The quantities of one time.
class Instant {
 public:
  /// `at` " at step 12".
  Instant(const DrawnMotion& motion, std::string_view at) {
    for (const Quantity& q : motion.quantities)
      if (q.name.ends_with(at)) values_[q.name.substr(0, q.name.size() - at.size())] = &q.values;
  }
  std::span<const double> of(const std::string& name) const { return *values_.at(name); }
  std::size_t size() const { return of("masses").size(); }
  Vector3d vector(const std::string& name, std::size_t k) const { return Vector3d::Map(of(name).data() + 3 * k); }
  double time() const { return of("time")[0]; }

 private:
  std::map<std::string, const std::vector<double>*> values_;
};

std::vector<Instant> instants_of(const DrawnMotion& motion) {
  std::vector<Instant> all;
  for (const Quantity& q : motion.quantities)
    if (q.name.starts_with("time at")) all.emplace_back(motion, std::string_view(q.name).substr(4));
  return all;
}

/// [s] The time from one moment on, less that in which the sign is the other one.
double signed_time(const SceneDrive& drive, double time) {
  const double passed = std::max(0.0, std::min(time, drive.until.value_or(time)) - drive.from);
  if (!drive.reverse_every) return passed;
  const double turns = std::floor(passed / *drive.reverse_every), rest = passed - turns * *drive.reverse_every;
  return std::fmod(turns, 2.0) == 0.0 ? rest : *drive.reverse_every - rest;
}

/// [m] How far a drive has taken a vertex from where it is at rest.
Vector3d way_of(const SceneDrive& drive, const Vector3d& rest, double time) {
  if (!drive.way.empty()) return drive.way(time) - drive.way.value.front();
  if (!drive.turn) return signed_time(drive, time) * drive.velocity.at(rest);
  const Vector3d arm = rest - drive.turn->centre;
  return Eigen::AngleAxisd(drive.turn->angle(time) - drive.turn->angle.value.front(), drive.turn->axis) * arm - arm;
}

RelationFound judge_held(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (file.driven.empty() && file.fixed.empty()) return does_not_apply("nothing of it is held or driven");
  const auto& rest = s.mesh().points;
  std::vector<std::vector<const SceneDrive*>> drives(rest.size());
  for (const SceneDrive& drive : file.driven)
    for (const std::uint32_t p : select_points(drive.vertices, rest, drive.path)) drives[p].push_back(&drive);
  for (const Instant& now : instants_of(s.motion()))
    for (std::size_t k = 0; k < now.size(); ++k) {
      const double held = now.of("holds")[k], number = now.of("numbers of points")[k];
      if ((held != 1.0 && held != 2.0) || number < 0.0) continue;
      const auto p = static_cast<std::size_t>(number);
      Vector3d expected(0, 0, 0);
      for (const SceneDrive* drive : drives[p]) expected += way_of(*drive, rest[p], now.time());
      const Vector3d found = now.vector("positions", k) - rest[p];
      const double allowed = rounding * (s.scales().length + rest[p].norm() + expected.norm());
      if (!((found - expected).norm() <= allowed))
        return breaks(
            fmt::format("vertex {} is ({:.6g}, {:.6g}, {:.6g}) m from where it was at {:.6g} s, where keys say "
                        "({:.6g}, {:.6g}, {:.6g})",
                        p, found.x(), found.y(), found.z(), now.time(), expected.x(), expected.y(), expected.z()));
    }
  return {};
}

/// [m] How deep a place is in an obstacle at a time; at most 0 outside.
double depth_in(const Obstacle& obstacle, const Vector3d& place, double time) {
  const double moved = std::max(0.0, std::min(time, obstacle.until) - obstacle.from);
  const Vector3d x = place - moved * obstacle.velocity;
  return std::visit(
      Overloads{[&x](const HalfSpace& plane) { return (plane.point - x).dot(plane.normal); },
                [&x](const Ball& ball) { return ball.radius - (x - ball.centre).norm(); },
                [&x](const Block& block) { return std::min((x - block.low).minCoeff(), (block.high - x).minCoeff()); }},
      obstacle.shape);
}

/// By point of a mesh: is it on a face of one cell alone, or of a surface or chain?
std::vector<bool> touches_obstacles(const Mesh& mesh) {
  std::vector<bool> on(mesh.points.size(), false);
  std::map<std::vector<std::uint32_t>, int> cells_of;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      std::vector<std::uint32_t> face;
      for (const int k : cycle) face.push_back(cell[static_cast<std::size_t>(k)]);
      std::ranges::sort(face);
      if (dimension(mesh.kinds[c]) == 2)
        for (const std::uint32_t p : face) on[p] = true;
      else
        ++cells_of[face];
    }
  }
  for (const auto& [face, count] : cells_of)
    if (count == 1)
      for (const std::uint32_t p : face) on[p] = true;
  for (const auto& ends : mesh.links)
    for (const std::uint32_t p : ends) on[p] = true;
  return on;
}

RelationFound judge_obstacles(const JudgedScene& s) {
  const SceneFile& file = s.file();
  if (file.obstacles.empty()) return does_not_apply("it has no obstacles");
  if (!file.touches.empty()) return does_not_apply("the depths in bodies are among those in obstacles");
  if (file.obstacles.size() > 1 && s.has_box_obstacle())
    return does_not_apply("a box that touches another obstacle is one with it");
  const std::vector<bool> on = touches_obstacles(s.mesh());
  for (const Instant& now : instants_of(s.motion()))
    for (std::size_t k = 0; k < now.size(); ++k) {
      const Vector3d place = now.vector("positions", k), force = now.vector("contact forces", k);
      double expected = 0.0, reach = s.scales().length + place.norm();
      for (const SceneObstacle& one : file.obstacles) {
        expected = std::max(expected, depth_in(one.obstacle, place, now.time()));
        if (const auto* ball = std::get_if<Ball>(&one.obstacle.shape)) reach += ball->radius + ball->centre.norm();
      }
      const double found = now.of("contact depths")[k], number = now.of("numbers of points")[k];
      // what is within solids is in no obstacle, before they are cut
      if (found == 0.0 && (number < 0.0 || !on[static_cast<std::size_t>(number)])) continue;
      if (!(std::abs(found - expected) <= rounding * reach))
        return breaks(
            fmt::format("a vertex is {:.6g} m deep at {:.6g} s, and its place {:.6g} m", found, now.time(), expected));
      const auto* plane = std::get_if<HalfSpace>(&file.obstacles.front().obstacle.shape);
      if (file.obstacles.size() > 1 || plane == nullptr || force.isZero(0.0)) continue;
      if (!(force.dot(plane->normal) >= (1.0 - rounding) * force.norm()))
        return breaks(fmt::format("a plane pushes by ({:.6g}, {:.6g}, {:.6g}) N, which is not along its normal",
                                  force.x(), force.y(), force.z()));
    }
  return {};
}

RelationFound judge_strains(const JudgedScene& s) {
  const auto& rest = s.mesh().points;
  bool any = false;
  for (const Instant& now : instants_of(s.motion())) {
    const auto strains = now.of("strains"), numbers = now.of("numbers of points");
    if (strains.empty()) continue;
    std::vector<double> ends(now.of("links").begin(), now.of("links").end());
    ends.insert(ends.end(), now.of("springs").begin(), now.of("springs").end());
    if (ends.size() != 2 * strains.size())
      return breaks(fmt::format("{} links and springs have {} strains", ends.size() / 2, strains.size()));
    for (std::size_t k = 0; k < strains.size(); ++k) {
      const auto a = static_cast<std::size_t>(ends[2 * k]), b = static_cast<std::size_t>(ends[2 * k + 1]);
      if (numbers[a] < 0.0 || numbers[b] < 0.0) continue;
      any = true;
      const Vector3d apart = now.vector("positions", b) - now.vector("positions", a);
      const double length =
          (rest[static_cast<std::size_t>(numbers[b])] - rest[static_cast<std::size_t>(numbers[a])]).norm();
      const double expected = apart.norm() / length - 1.0;
      if (!(std::abs(strains[k] - expected) <= rounding * (1.0 + (s.scales().length + apart.norm()) / length)))
        return breaks(
            fmt::format("the strain of number {} is {:.6g}, and its length gives {:.6g}", k, strains[k], expected));
    }
  }
  return any ? RelationFound{} : does_not_apply("it has no links or springs");
}

/// [J] The most that restitution or friction has given between two times, beyond a hundredth of the largest energy, or
/// in all, beyond 1e-5 of it.
double given_by_losses(const DrawnMotion& motion) {
  double before[] = {0.0, 0.0}, largest = 0.0, given = 0.0;
  for (const Instant& now : instants_of(motion)) {
    const auto energies = now.of("energies of contact");
    for (const double energy : {energies[0], energies[1], energies[2], now.of("kinetic energy")[0]})
      largest = std::max(largest, std::abs(energy));
    for (const std::size_t k : {0, 1}) {
      given = std::max(given, before[k] - energies[k + 1]);
      before[k] = energies[k + 1];
    }
  }
  // what holds a place still until the end of a step may push it back within it
  const double in_all = std::max(-before[0], -before[1]);
  return std::max({0.0, given - 1e-2 * largest, in_all - 1e-5 * largest});
}

RelationFound judge_losses(const JudgedScene& s) {
  if (!s.has_losses()) return does_not_apply("no contact of it has losses");
  const double given = given_by_losses(s.motion());
  if (given == 0.0) return {};
  if (!s.file().events.empty()) return does_not_apply("its steps are long for its contacts");
  // the way of a long step is not the one that friction was found for
  for (const int parts : {4, 16})
    if (given_by_losses(s.in_shorter_steps(parts)) <= 0.6 * given) return {};
  return breaks(fmt::format("friction and restitution give {:.3g} J, and as much in shorter steps", given));
}

}  // namespace

std::vector<Relation> relations_of_keys() {
  return {
      {"held", "vertices that are fixed or driven are where keys say", "1e-11 of the size and the way", judge_held},
      {"obstacles",
       "vertices are as deep as their places are in obstacles at that time; a plane pushes along its normal",
       "1e-11 of the size", judge_obstacles},
      {"strains", "links and springs are as long as their strains say", "1e-11 of the size", judge_strains},
      {"losses", "restitution and friction take energy, and give none",
       "1e-2 of the largest energy between two times, 1e-5 in all, or 0.6 of that in steps of 1/4 or 1/16",
       judge_losses},
  };
}

}  // namespace dartboard
