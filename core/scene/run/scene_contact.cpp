#include "core/scene/run/scene_contact.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/bytes.h"
#include "core/base/counted.h"
#include "core/contact/box_around.h"
#include "core/scene/run/body_in_words.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// "vertex 5", "the middle of the face of vertices 1, 2 and 3"
std::string place_in_words(std::span<const std::uint32_t> nodes) {
  if (nodes.size() == 1) return vertex_in_words(nodes[0]);
  if (std::ranges::find(nodes, no_point) != nodes.end()) return "the middle of a face that refinement made";
  return fmt::format("the middle of the {} of vertices {} and {}", nodes.size() == 2 ? "link" : "face",
                     fmt::join(nodes.first(nodes.size() - 1), ", "), nodes.back());
}

/// [m] The largest distance of a place on an edge of the sample's face, or on its link, from the nearest of the face's
/// corners and its middle, which are all sampled; 0 for a vertex. Places inside are nearer.
double farthest_on_face(const SkinSample& sample, std::span<const Vector3d> x) {
  if (sample.count == 1) return 0.0;
  const Vector3d middle = ObstacleContact::place_of(sample, x);
  double farthest = 0.0;
  for (std::uint32_t k = 0; k < sample.count; ++k) {
    const Vector3d &a = x[sample.nodes[k]], &b = x[sample.nodes[(k + 1) % sample.count]];
    const double length = (b - a).norm();
    for (const Vector3d& end : {a, b}) {
      // as far from this corner as from the middle, or half way to the other corner
      const Vector3d along = (end == a ? b - a : a - b) / length, to_middle = middle - end;
      farthest = std::max(farthest, std::min(0.5 * length, 0.5 * to_middle.squaredNorm() / to_middle.dot(along)));
    }
  }
  return farthest;
}

/// [m] A load that is let go where surfaces touch works on the way down: law.energy(1, d) = load d. Together with an
/// impact the depth is at most the sum of both.
double deepest_of(const ContactForecast& expected, const ContactLaw& law) {
  const double load = law.force(1.0, expected.depth_at_rest);
  return law.depth_at_rest(law.exponent * load) + expected.depth_at_impact;
}

/// [m] Half of the least extent of a body along its principal axes: in a convex one nothing is deeper inside.
double half_thickness(const SkinSolids& solids, std::uint32_t body, std::span<const Vector3d> x) {
  std::vector<std::uint8_t> is_its(x.size(), 0);
  for (const SkinTetrahedron& t : solids.tetrahedra())
    if (t.group == body)
      for (const std::uint32_t i : t.nodes) is_its[i] = 1;
  Vector3d mean(0, 0, 0);
  double count = 0.0;
  const auto for_each = [&](const auto& f) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (is_its[i] != 0) f(x[i]);
  };
  for_each([&](const Vector3d& place) {
    mean += place;
    count += 1.0;
  });
  if (count == 0.0) return std::numeric_limits<double>::infinity();
  mean /= count;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for_each([&](const Vector3d& place) { spread += (place - mean) * (place - mean).transpose(); });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for_each([&](const Vector3d& place) {
      const double along = (place - mean).dot(axes.eigenvectors().col(k));
      low = std::min(low, along);
      high = std::max(high, along);
    });
    least = std::min(least, high - low);
  }
  return 0.5 * least;
}

HeldVertices held_in(const SpringSystem& system) { return {system.fixed.span(), system.held_axes.span()}; }

}  // namespace

std::string to_string(const ContactWarning& w, std::span<const std::string> obstacles,
                      std::span<const std::string> bodies) {
  const std::string other = !w.of_bodies       ? obstacles[w.obstacle]
                            : w.from == w.into ? "its own body " + bodies[w.into]
                                               : bodies[w.into];
  switch (w.kind) {
    case ContactWarning::Kind::starts_inside:
      return fmt::format("{} of the boundary {} inside {} at the start, the deepest {}{}, {:.4g} m inside {}",
                         counted(w.samples, "place"), w.samples == 1 ? "is" : "are",
                         w.of_bodies ? "bodies" : "obstacles", place_in_words(w.nodes),
                         w.of_bodies ? " of " + bodies[w.from] : "", w.value, other);
    case ContactWarning::Kind::too_deep:
      return fmt::format(
          "at t = {:.6g} s: {} is {:.4g} m inside {}, deeper than the {:.4g} m of its law; a larger "
          "'pressure' or 'depth' carries more",
          w.time, place_in_words(w.nodes), w.value, other, w.limit);
    case ContactWarning::Kind::out_of_reach:
      return fmt::format(
          "at t = {:.6g} s: {} of the boundary {} so far inside a body that no way out is found and no contact felt, "
          "the first {}, {}inside {}; take a shorter /step, or a larger 'pressure' or 'depth'",
          w.time, counted(w.samples, "place"), w.samples == 1 ? "is" : "are", place_in_words(w.nodes),
          w.value > 0.0 ? fmt::format("more than {:.4g} m ", w.value) : "", other);
    case ContactWarning::Kind::will_be_fast:
      if (w.of_bodies)
        return fmt::format(
            "at the expected speeds a vertex moves {:.4g} m in a step relative to {}, where half of the "
            "least altitude of a cell at the boundary is {:.4g} m: it may pass through; take a shorter /step",
            w.value, other, w.limit);
      return fmt::format(
          "at the expected speeds a vertex moves {:.4g} m in a step relative to {}, where "
          "nothing is more than {:.4g} m inside: it may pass through; take a shorter /step",
          w.value, other, w.limit);
    case ContactWarning::Kind::too_thin:
      return fmt::format(
          "{} may be {:.4g} m deep in a body, and nothing is more than {:.4g} m inside it: what is deeper comes out on its "
          "other side; make it thicker, or take a larger 'pressure' or a smaller 'depth'",
          other, w.value, w.limit);
    case ContactWarning::Kind::too_small:
      return fmt::format(
          "{} may come {} into faces of bodies between the places that feel contact, which are up to {:.4g} m from other "
          "places of the boundary; take smaller cells, or a larger obstacle",
          other, std::isfinite(w.value) ? fmt::format("{:.4g} m deep", w.value) : "any depth", w.limit);
    case ContactWarning::Kind::soft_body:
      return fmt::format(
          "the restitution {:.4g} at {} is that of places, and a body will bounce otherwise: it is {:.2g} times as stiff as "
          "the contact, and vibrates; a lower 'pressure' or a larger 'depth' makes the contact softer",
          w.limit, other, w.value);
    case ContactWarning::Kind::comes_through:
      return fmt::format(
          "at t = {:.6g} s: {} comes through {}: {:.4g} m inside, it is driven out on the other side than a step before; "
          "take a larger 'pressure', a smaller 'depth', or something thicker",
          w.time, place_in_words(w.nodes), other, w.value);
    case ContactWarning::Kind::too_fast: break;
  }
  if (w.of_bodies)
    return fmt::format(
        "at t = {:.6g} s: {} moves {:.4g} m in a step relative to others, where half of the least altitude of a cell at "
        "the boundary is {:.4g} m: it may pass through; take a shorter /step",
        w.time, place_in_words(w.nodes), w.value, w.limit);
  return fmt::format(
      "at t = {:.6g} s: {} moves {:.4g} m in a step relative to {}, where nothing is more than {:.4g} m "
      "inside: it may pass through; take a shorter /step",
      w.time, place_in_words(w.nodes), w.value, other, w.limit);
}

SceneContact::SceneContact(ObstacleContact* obstacles, BodyContact* bodies, bool undoes)
    : obstacles_(obstacles), bodies_(bodies), impulses_(obstacles, bodies), undoes_(undoes) {}

std::vector<std::uint32_t> SceneContact::nodes_of(const SkinSample& sample) const {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t i : sample.corners()) nodes.push_back(whole(i));
  return nodes;
}

bool SceneContact::has_warned(ContactWarning::Kind kind, bool of_bodies) const {
  return std::ranges::any_of(warnings_,
                             [=](const ContactWarning& w) { return w.kind == kind && w.of_bodies == of_bodies; });
}

void SceneContact::start(std::span<const Vector3d> x, std::span<const ContactForecast> expected,
                         std::span<const TouchForecast> expected_touches, double h) {
  if (bodies_ != nullptr) start_bodies(x, expected_touches, h);
  if (obstacles_ == nullptr) return;
  obstacles_->place_at(0.0);
  for (std::uint32_t o = 0; o < expected.size(); ++o)
    if (const double half = obstacles_->obstacles()[o].half_thickness(); expected[o].speed * h > half) {
      warnings_.push_back({.kind = ContactWarning::Kind::will_be_fast,
                           .obstacle = o,
                           .nodes = {},
                           .value = expected[o].speed * h,
                           .limit = half});
      break;
    }
  if (!expected.empty()) look_at_sizes(x, expected);
  const ContactState found = obstacles_->state_at(x);
  if (found.contacts == 0) return;
  warnings_.push_back({.kind = ContactWarning::Kind::starts_inside,
                       .obstacle = found.obstacle,
                       .samples = found.contacts,
                       .nodes = nodes_of(obstacles_->samples()[found.sample]),
                       .value = found.deepest});
}

/// Warns of an obstacle that is too thin for the depths expected in it, and of one that is too small for the samples.
void SceneContact::look_at_sizes(std::span<const Vector3d> x, std::span<const ContactForecast> expected) {
  double gap = 0.0;
  for (const SkinSample& sample : obstacles_->samples()) gap = std::max(gap, farthest_on_face(sample, x));
  for (std::uint32_t o = 0; o < expected.size(); ++o) {
    const Obstacle& obstacle = obstacles_->obstacles()[o];
    const ContactLaw& law = obstacles_->laws()[o];
    const double deepest = deepest_of(expected[o], law);
    if (deepest > obstacle.half_thickness() && !has_warned(ContactWarning::Kind::too_thin))
      warnings_.push_back({.kind = ContactWarning::Kind::too_thin,
                           .obstacle = o,
                           .nodes = {},
                           .value = deepest,
                           .limit = obstacle.half_thickness()});
    if (!expected[o].keeps_restitution(law) && !has_warned(ContactWarning::Kind::soft_body))
      warnings_.push_back({.kind = ContactWarning::Kind::soft_body,
                           .obstacle = o,
                           .nodes = {},
                           .value = expected[o].stiffness_ratio,
                           .limit = law.restitution});
    if (const double unfelt = obstacle.depth_between(gap);
        unfelt > law.depth && !has_warned(ContactWarning::Kind::too_small))
      warnings_.push_back(
          {.kind = ContactWarning::Kind::too_small, .obstacle = o, .nodes = {}, .value = unfelt, .limit = gap});
  }
}

void SceneContact::start_bodies(std::span<const Vector3d> x, std::span<const TouchForecast> expected, double h) {
  const double half = 0.5 * bodies_->least_altitude(x);
  for (const TouchForecast& f : expected)
    if (f.contact.speed * h > half) {
      warnings_.push_back({.kind = ContactWarning::Kind::will_be_fast,
                           .of_bodies = true,
                           .from = f.first,
                           .into = f.second,
                           .nodes = {},
                           .value = f.contact.speed * h,
                           .limit = half});
      break;
    }
  const auto soft =
      std::ranges::find_if(expected, [](const TouchForecast& f) { return !f.contact.keeps_restitution(f.law); });
  if (soft != expected.end())
    warnings_.push_back({.kind = ContactWarning::Kind::soft_body,
                         .of_bodies = true,
                         .from = soft->first,
                         .into = soft->second,
                         .nodes = {},
                         .value = soft->contact.stiffness_ratio,
                         .limit = soft->law.restitution});
  for (const TouchForecast& f : expected)
    for (const std::uint32_t body : {f.first, f.second}) {
      if (has_warned(ContactWarning::Kind::too_thin, true)) continue;
      const double thin = half_thickness(bodies_->solids(), body, x), deepest = deepest_of(f.contact, f.law);
      if (!(deepest > thin)) continue;
      warnings_.push_back({.kind = ContactWarning::Kind::too_thin,
                           .of_bodies = true,
                           .from = body == f.first ? f.second : f.first,
                           .into = body,
                           .nodes = {},
                           .value = deepest,
                           .limit = thin});
    }
  const BodyContactState found = bodies_->state_at(x);
  if (found.contacts > 0)
    warnings_.push_back({.kind = ContactWarning::Kind::starts_inside,
                         .of_bodies = true,
                         .from = found.from,
                         .into = found.into,
                         .samples = found.contacts,
                         .nodes = nodes_of(bodies_->samples()[found.sample]),
                         .value = found.deepest});
  look_for_lost(0.0, x);
}

void SceneContact::change_part(ObstacleContact* obstacles, BodyContact* bodies, std::span<const std::uint32_t> moved_to,
                               std::span<const std::uint32_t> moved_to_of_bodies,
                               std::span<const std::uint32_t> vertices) {
  obstacles_ = obstacles;
  bodies_ = bodies;
  vertices_ = vertices;
  impulses_.change_part(obstacles, bodies, moved_to, moved_to_of_bodies, vertices);
}

void SceneContact::resume(std::span<const Vector3d> x) {
  if (bodies_ != nullptr) bodies_->find_lost(x);
  start_ways(x);
}

void SceneContact::system_changed(const SpringSystem& system, std::span<const Vector3d> x) {
  impulses_.forget_places();
  terms_ = terms_of(system);
  if (bodies_ != nullptr) least_altitude_ = bodies_->least_altitude(x);
  start_ways(x);
}

bool SceneContact::begin(double time, double h, const SpringSystem& system, Motion motion) {
  if (undoes_) kept_v_.assign(motion.v.begin(), motion.v.end());
  const auto accelerate = [&system, this](std::span<const Vector3d> x, std::span<const Vector3d> v,
                                          std::span<Vector3d> a) { accelerations(system, terms_, x, v, a); };
  return impulses_.begin(time, h, system.inverse_mass, held_in(system), motion.x, motion.v, accelerate);
}

bool SceneContact::end(double time, double h, const SpringSystem& system, Motion motion) {
  const bool changed = impulses_.end(time, h, system.inverse_mass, held_in(system), motion.x, motion.v);
  if (obstacles_ != nullptr) {
    find_ways(false, motion.x);
    look_at_ways(false, time + h);
    if (!has_warned(ContactWarning::Kind::too_fast)) look_for_speed(time + h, h, motion.v);
  }
  if (bodies_ != nullptr) {
    const bool has_found_touches = look_for_lost(time + h, motion.x);
    find_ways(true, motion.x, has_found_touches);
    look_at_ways(true, time + h);
    if (!has_warned(ContactWarning::Kind::too_fast, true)) look_for_speed_of_bodies(time + h, h, motion.v);
  }
  return changed;
}

void SceneContact::undo(double time, Motion motion) {
  impulses_.take_back();
  go_to(time);
  if (undoes_) std::ranges::copy(kept_v_, motion.v.begin());
}

void SceneContact::look_for_speed(double time, double h, std::span<const Vector3d> v) {
  for (std::uint32_t o = 0; o < obstacles_->obstacles().size(); ++o) {
    const Obstacle& obstacle = obstacles_->obstacles()[o];
    const double half = obstacle.half_thickness();
    if (!std::isfinite(half)) continue;
    const Vector3d speed = obstacle.velocity_at(time);
    double most = half / h * (half / h);
    std::uint32_t fastest = ContactState::none;
    for (std::uint32_t i = 0; i < v.size(); ++i)
      if (const double square = (v[i] - speed).squaredNorm(); square > most) {
        most = square;
        fastest = i;
      }
    if (fastest == ContactState::none) continue;
    warnings_.push_back({.kind = ContactWarning::Kind::too_fast,
                         .time = time,
                         .obstacle = o,
                         .nodes = {whole(fastest)},
                         .value = std::sqrt(most) * h,
                         .limit = half});
    return;
  }
}

ContactWarning SceneContact::warning_of(ContactWarning::Kind kind, bool of_bodies, double time, const Way& way) const {
  const SkinSample& sample = of_bodies ? bodies_->samples()[way.sample] : obstacles_->samples()[way.sample];
  return {.kind = kind,
          .of_bodies = of_bodies,
          .time = time,
          .obstacle = of_bodies ? 0 : way.other,
          .from = of_bodies ? bodies_->solids().group_at(sample.nodes[0]) : 0,
          .into = of_bodies ? way.other : 0,
          .nodes = nodes_of(sample),
          .value = way.depth};
}

SceneContact::Way SceneContact::way_of(const BodyTouch& touch) const {
  return {touch.sample, bodies_->solids().tetrahedra()[touch.tetrahedron].group, touch.depth,
          bodies_->laws()[touch.law].depth, touch.normal};
}

/// Returns whether the touches at these places are those that were found last.
bool SceneContact::look_for_lost(double time, std::span<const Vector3d> x) {
  using Kind = ContactWarning::Kind;
  if (has_warned(Kind::out_of_reach, true) || (bodies_->has_none_to_lose() && impulses_.are_apart(x))) return false;
  if (const auto lost = bodies_->find_lost(x); !lost.empty()) {
    warnings_.push_back(warning_of(Kind::out_of_reach, true, time, way_of(lost.front())));
    warnings_.back().samples = lost.size();
  }
  return true;
}

/// Finds the ways out after a step, where something has not been warned of; a way of less than a tenth of the depth of
/// its law is none, where two surfaces just meet.
void SceneContact::find_ways(bool of_bodies, std::span<const Vector3d> x, bool has_found_touches) {
  Ways& ways = ways_[of_bodies ? 1 : 0];
  ways.now.swap(ways.before);
  ways.now.clear();
  if (has_warned(ContactWarning::Kind::too_deep, of_bodies) && !may_warn_of_passages(of_bodies)) return;
  if (of_bodies ? impulses_.are_apart(x) : impulses_.is_clear(x)) return;
  const auto add = [&ways](const Way& way) {
    if (way.depth > 0.1 * way.allowed) ways.now.push_back(way);
  };
  if (of_bodies)
    for (const BodyTouch& touch : has_found_touches ? bodies_->found_touching() : bodies_->touching({x}))
      add(way_of(touch));
  else
    obstacles_->for_each_touch(x, [&](std::uint32_t sample, std::uint32_t o, const Penetration& in) {
      add({sample, o, in.depth, obstacles_->laws()[o].depth, in.normal});
    });
}

/// Has anything a middle to come through, and has none been warned of?
bool SceneContact::may_warn_of_passages(bool of_bodies) const {
  if (has_warned(ContactWarning::Kind::comes_through, of_bodies)) return false;
  return of_bodies || std::ranges::any_of(obstacles_->obstacles(),
                                          [](const Obstacle& o) { return std::isfinite(o.half_thickness()); });
}

/// Warns of the sample that is deepest, relative to its law, and of one whose way out of something has turned round
/// since the last step: it has come beyond its middle.
void SceneContact::look_at_ways(bool of_bodies, double time) {
  using Kind = ContactWarning::Kind;
  const auto& [now, before] = ways_[of_bodies ? 1 : 0];
  if (now.empty()) return;
  const auto share = [](const Way& way) { return way.depth / way.allowed; };
  if (const Way& deepest = *std::ranges::max_element(now, {}, share);
      share(deepest) > 1.0 && !has_warned(Kind::too_deep, of_bodies)) {
    warnings_.push_back(warning_of(Kind::too_deep, of_bodies, time, deepest));
    warnings_.back().limit = deepest.allowed;
  }
  if (!may_warn_of_passages(of_bodies)) return;
  constexpr double turned = -0.5;  // the cosine of the angle
  auto old = before.begin();
  for (const Way& way : now) {
    while (old != before.end() && old->sample < way.sample) ++old;
    for (auto same = old; same != before.end() && same->sample == way.sample; ++same)
      if (same->other == way.other && same->normal.dot(way.normal) < turned)
        return warnings_.push_back(warning_of(Kind::comes_through, of_bodies, time, way));
  }
}

/// The next step is compared with the ways out of these places.
void SceneContact::start_ways(std::span<const Vector3d> x) {
  ways_ = {};
  if (obstacles_ != nullptr) find_ways(false, x);
  if (bodies_ != nullptr) find_ways(true, x);
  impulses_.forget_places();
}

// The relative speed of two places is at most that between opposite corners of a box around all velocities.
void SceneContact::look_for_speed_of_bodies(double time, double h, std::span<const Vector3d> v) {
  if (v.empty()) return;
  const BoxAround speeds = box_around(v);
  const double way = speeds.diagonal() * h;
  if (!(way > 0.5 * least_altitude_)) return;
  const Vector3d middle = 0.5 * (speeds.low + speeds.high);
  std::uint32_t fastest = 0;
  for (std::uint32_t i = 1; i < v.size(); ++i)
    if ((v[i] - middle).squaredNorm() > (v[fastest] - middle).squaredNorm()) fastest = i;
  warnings_.push_back({.kind = ContactWarning::Kind::too_fast,
                       .of_bodies = true,
                       .time = time,
                       .nodes = {whole(fastest)},
                       .value = way,
                       .limit = 0.5 * least_altitude_});
}

double SceneContact::new_work() {
  const double work = impulses_.losses().supplied - work_reported_;
  work_reported_ = impulses_.losses().supplied;
  return work;
}

ContactDiagnostics SceneContact::diagnostics(const SimulatedBody& body) const {
  const std::span<const Vector3d> x = body.vertices().position;
  const ContactLosses& losses = impulses_.losses();
  ContactDiagnostics d{.damped = losses.damped, .rubbed = losses.rubbed, .supplied = losses.supplied};
  const auto add = [&d](const auto& now) {
    d.energy += now.energy;
    d.contacts += now.contacts;
    d.deepest = std::max(d.deepest, now.deepest);
  };
  if (const ObstacleContact* obstacles = body.contact()) add(obstacles->state_at(x));
  if (const BodyContact* bodies = body.body_contact()) add(bodies->state_at(x));
  return d;
}

std::size_t SceneContact::bytes() const {
  return impulses_.bytes() + bytes_of(kept_v_, ways_[0].now, ways_[0].before, ways_[1].now, ways_[1].before);
}

}  // namespace dartboard
