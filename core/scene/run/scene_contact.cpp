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
#include "core/places/border.h"
#include "core/scene/run/body_in_words.h"
#include "core/time/solve/stop_request.h"

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
  const Vector3d middle = ObstacleContact::place_of(sample, {x});
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

SceneContact::SceneContact(const Contacts& contacts, bool undoes)
    : contacts_(contacts), impulses_(contacts), undoes_(undoes) {}

std::vector<std::uint32_t> SceneContact::nodes_of(const SkinSample& sample) const {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t i : sample.corners()) nodes.push_back(whole(i));
  return nodes;
}

bool SceneContact::has_warned(ContactWarning::Kind kind, bool of_bodies) const {
  return std::ranges::any_of(warnings_,
                             [=](const ContactWarning& w) { return w.kind == kind && w.of_bodies == of_bodies; });
}

void SceneContact::warn(ContactWarning warning) {
  if (!has_warned(warning.kind, warning.of_bodies)) warnings_.push_back(std::move(warning));
}

void SceneContact::start(std::span<const Vector3d> x, const ExpectedContacts& expected, double h) {
  if (contacts_.bodies != nullptr) {
    const double half = expected.bodies.empty() ? 0.0 : 0.5 * contacts_.bodies->least_altitude(x);
    for (const TouchForecast& f : expected.bodies) {
      look_ahead({.of_bodies = true, .from = f.first, .into = f.second}, f.contact, f.law, half, h);
      for (const auto& [from, into] : {std::pair(f.second, f.first), std::pair(f.first, f.second)})
        if (!has_warned(ContactWarning::Kind::too_thin, true))
          look_at_thickness({.of_bodies = true, .from = from, .into = into}, deepest_of(f.contact, f.law),
                            half_thickness(contacts_.bodies->solids(), into, x));
    }
    look_inside(true, x);
    look_for_lost(0.0, x);
  }
  if (contacts_.obstacles == nullptr) return;
  contacts_.obstacles->place_at(0.0);
  double gap = 0.0;
  for (const SkinSample& sample : contacts_.samples(false))
    if (!expected.obstacles.empty()) gap = std::max(gap, farthest_on_face(sample, x));
  for (std::uint32_t o = 0; o < expected.obstacles.size(); ++o) {
    const Obstacle& obstacle = contacts_.obstacles->obstacles()[o];
    const ContactLaw& law = contacts_.obstacles->laws()[o];
    const ContactForecast& forecast = expected.obstacles[o];
    look_ahead({.obstacle = o}, forecast, law, obstacle.half_thickness(), h);
    look_at_thickness({.obstacle = o}, deepest_of(forecast, law), obstacle.half_thickness());
    if (const double unfelt = obstacle.depth_between(gap); unfelt > law.depth)
      warn({.kind = ContactWarning::Kind::too_small, .obstacle = o, .value = unfelt, .limit = gap});
  }
  look_inside(false, x);
}

/// Warns of a speed that may pass `half` [m] in a step of h [s], and of a body that is soft beside the contact.
void SceneContact::look_ahead(ContactWarning at, const ContactForecast& expected, const ContactLaw& law, double half,
                              double h) {
  if (expected.speed * h > half) {
    at.kind = ContactWarning::Kind::will_be_fast;
    at.value = expected.speed * h;
    at.limit = half;
    warn(at);
  }
  if (expected.keeps_restitution(law)) return;
  at.kind = ContactWarning::Kind::soft_body;
  at.value = expected.stiffness_ratio;
  at.limit = law.restitution;
  warn(at);
}

/// Warns of what is entered more deeply than half of its thickness.
void SceneContact::look_at_thickness(ContactWarning at, double deepest, double half) {
  if (!(deepest > half)) return;
  at.kind = ContactWarning::Kind::too_thin;
  at.value = deepest;
  at.limit = half;
  warn(at);
}

/// Warns of samples that start inside something.
void SceneContact::look_inside(bool of_bodies, std::span<const Vector3d> x) {
  const Contacts contacts = contacts_.only(of_bodies);
  const ContactState found = contacts.state_at(x);
  if (!(found.deepest > border_thickness(x))) return;  // a body that lies on a surface, to rounding
  warn({.kind = ContactWarning::Kind::starts_inside,
        .of_bodies = of_bodies,
        .obstacle = of_bodies ? 0 : found.obstacle,
        .from = found.from,
        .into = found.into,
        .samples = found.contacts,
        .nodes = nodes_of(contacts.samples(of_bodies)[found.sample]),
        .value = found.deepest});
}

void SceneContact::change_part(const Contacts& contacts, const ContactImpulses::MovedSamples& moved_to,
                               std::span<const std::uint32_t> vertices) {
  contacts_ = contacts;
  vertices_ = vertices;
  impulses_.change_part(contacts, moved_to, vertices);
}

void SceneContact::resume(std::span<const Vector3d> x) {
  if (contacts_.bodies != nullptr) contacts_.bodies->find_lost(x);
  start_ways(x);
}

void SceneContact::system_changed(const SpringSystem& system, std::span<const Vector3d> x) {
  impulses_.forget_places();
  terms_ = terms_of(system);
  if (contacts_.bodies != nullptr) least_altitude_ = contacts_.bodies->least_altitude(x);
  start_ways(x);
}

StepResult SceneContact::step(Integrator& integrator, const SpringSystem& system, Motion motion, double time,
                              double h) {
  if (undoes_) kept_v_.assign(motion.v.begin(), motion.v.end());
  const HeldVertices held{system.fixed.span(), system.held_axes.span()};
  const auto accelerate = [&system, this](std::span<const Vector3d> x, std::span<const Vector3d> v,
                                          std::span<Vector3d> a) { accelerations(system, terms_, x, v, a); };
  if (impulses_.begin(time, h, system.inverse_mass, held, motion.x, motion.v, accelerate)) integrator.motion_changed();
  StepResult result;
  try {
    result = integrator.step(system, motion, h);
  } catch (const Stopped&) {
    undo(time, motion);
    throw;
  }
  if (!result.ok()) {
    undo(time, motion);
    return result;
  }
  if (impulses_.end(time, h, system.inverse_mass, held, motion.x, motion.v)) integrator.motion_changed();
  look_after_step(time + h, h, motion);
  return result;
}

/// Looks for what to warn of after a step of h [s] to `time`.
void SceneContact::look_after_step(double time, double h, Motion motion) {
  if (contacts_.obstacles != nullptr) {
    find_ways(false, motion.x);
    look_at_ways(false, time);
    if (!has_warned(ContactWarning::Kind::too_fast)) look_for_speed(time, h, motion.v);
  }
  if (contacts_.bodies != nullptr) {
    look_for_lost(time, motion.x);
    find_ways(true, motion.x);
    look_at_ways(true, time);
    if (!has_warned(ContactWarning::Kind::too_fast, true)) look_for_speed_of_bodies(time, h, motion.v);
  }
}

void SceneContact::undo(double time, Motion motion) {
  impulses_.take_back();
  go_to(time);
  if (undoes_) std::ranges::copy(kept_v_, motion.v.begin());
}

void SceneContact::look_for_speed(double time, double h, std::span<const Vector3d> v) {
  for (std::uint32_t o = 0; o < contacts_.obstacles->obstacles().size(); ++o) {
    const Obstacle& obstacle = contacts_.obstacles->obstacles()[o];
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
  const SkinSample& sample = contacts_.samples(of_bodies)[way.sample];
  return {.kind = kind,
          .of_bodies = of_bodies,
          .time = time,
          .obstacle = of_bodies ? 0 : way.other,
          .from = of_bodies ? contacts_.bodies->group_of(way.sample) : 0,
          .into = of_bodies ? way.other : 0,
          .nodes = nodes_of(sample),
          .value = way.depth};
}

void SceneContact::look_for_lost(double time, std::span<const Vector3d> x) {
  using Kind = ContactWarning::Kind;
  if (has_warned(Kind::out_of_reach, true) || (contacts_.bodies->has_none_to_lose() && impulses_.are_apart(x))) return;
  const auto lost = contacts_.bodies->find_lost(x);
  if (lost.empty()) return;
  const BodyTouch& first = lost.front();
  const Way way{.sample = first.sample, .other = contacts_.bodies->group_entered(first), .depth = first.depth};
  warnings_.push_back(warning_of(Kind::out_of_reach, true, time, way));
  warnings_.back().samples = lost.size();
}

/// Finds the ways out after a step, where something has not been warned of; a way of less than a tenth of the depth of
/// its law is none, where two surfaces just meet.
void SceneContact::find_ways(bool of_bodies, std::span<const Vector3d> x) {
  Ways& ways = ways_[of_bodies ? 1 : 0];
  ways.now.swap(ways.before);
  ways.now.clear();
  if (has_warned(ContactWarning::Kind::too_deep, of_bodies) && !may_warn_of_passages(of_bodies)) return;
  if (of_bodies ? impulses_.are_apart(x) : impulses_.is_clear(x)) return;
  contacts_.only(of_bodies).for_each_touch({x}, [&](const Touch& t) {
    const std::uint32_t other = of_bodies ? contacts_.bodies->group_entered(*t.in_body) : t.obstacle;
    if (t.depth > 0.1 * t.law->depth) ways.now.push_back({t.sample, other, t.depth, t.law->depth, t.normal});
  });
}

/// Has anything a middle to come through, and has none been warned of?
bool SceneContact::may_warn_of_passages(bool of_bodies) const {
  if (has_warned(ContactWarning::Kind::comes_through, of_bodies)) return false;
  return of_bodies || std::ranges::any_of(contacts_.obstacles->obstacles(),
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
  if (contacts_.obstacles != nullptr) find_ways(false, x);
  if (contacts_.bodies != nullptr) find_ways(true, x);
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

void SceneContact::go_back(double time) {
  impulses_.restore(kept_.losses);
  work_reported_ = kept_.work_reported;
  go_to(time);
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
  const ContactState now = body.contacts().state_at(x);
  d.energy = now.energy;
  d.contacts = now.contacts;
  d.deepest = now.deepest;
  return d;
}

std::size_t SceneContact::bytes() const {
  return impulses_.bytes() + bytes_of(kept_v_, ways_[0].now, ways_[0].before, ways_[1].now, ways_[1].before);
}

}  // namespace dartboard
