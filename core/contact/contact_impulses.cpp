#include "core/contact/contact_impulses.h"

#include <algorithm>
#include <utility>

namespace dartboard {
namespace {

using Eigen::Vector3d;
using InverseMass = std::span<const double>;
using Fixed = const HeldVertices&;

// The most sweeps over contacts that share vertices in one step, from whose result the next step continues; and the
// change of a force, relative to the largest allowed, below which they end.
constexpr int most_sweeps = 4;
constexpr double settled = 1e-12;

/// The acceleration of a sample's place per force there [1/kg]: each node has 1/n of the force, and 1/n of the place.
/// This is for any direction, if no axis is held.
double mobility_of(const SkinSample& sample, InverseMass inverse_mass, Fixed fixed) {
  double sum = 0.0;
  for (const std::uint32_t i : sample.corners()) sum += mobility_of(i, inverse_mass, fixed);
  return sum / static_cast<double>(sample.count * sample.count);
}
/// Apply a force or an impulse at the sample, over the masses of its nodes.
void push(const SkinSample& sample, const Vector3d& impulse, InverseMass inverse_mass, Fixed fixed,
          std::span<Vector3d> v) {
  const Vector3d share = impulse / static_cast<double>(sample.count);
  for (const std::uint32_t i : sample.corners()) push(i, mobility_of(i, inverse_mass, fixed), share, fixed, v);
}

/// The largest friction [N] in a step of h, in which places approach each other at this speed from the depth at its
/// beginning to that half way. `factor` is that of the loss of a bounce.
double most_friction(const ContactLaw& law, double factor, double area, double mobility, double depth,
                     double depth_half_way, double approach, double h) {
  const double pushed = factor * law.force(area, depth_half_way);
  // A step that is long for the contact overestimates the depth: the normal force is at most the force at the beginning
  // plus the force that reverses the normal speed.
  const double turned =
      law.force(area, depth) + (1.0 + law.restitution) * (1.0 / mobility) * std::max(0.0, approach) / h;
  return law.friction * std::clamp(pushed, 0.0, turned);
}

Vector3d across(const Vector3d& v, const Vector3d& normal) { return v - v.dot(normal) * normal; }

/// The force, shortened to the size allowed.
Vector3d at_most(const Vector3d& force, double size) {
  const double now = force.norm();
  return now > size ? Vector3d(size / now * force) : force;
}

}  // namespace

ContactImpulses::ContactImpulses(ObstacleContact* obstacles, BodyContact* bodies)
    : obstacles_(obstacles), bodies_(bodies), bounces_(obstacles, bodies) {}

bool ContactImpulses::has_friction() const {
  return (obstacles_ != nullptr && obstacles_->has_friction()) || (bodies_ != nullptr && bodies_->has_friction());
}

bool ContactImpulses::begin(double time, double h, InverseMass inverse_mass, Fixed fixed, std::span<const Vector3d> x,
                            std::span<Vector3d> v, const Accelerations& accelerations) {
  losses_at_begin_ = losses_;
  bool changed = place_at(time, x);
  changed = bounces_.before(bounce_step(time, h, inverse_mass, fixed, x, v), losses_) || changed;
  changed = place_at(time + h / 2, x) || changed;
  return set_friction(time, h, inverse_mass, fixed, x, v, accelerations) || changed;
}

bool ContactImpulses::end(double time, double h, InverseMass inverse_mass, Fixed fixed, std::span<const Vector3d> x,
                          std::span<Vector3d> v) {
  forget_places();
  bool changed = false;
  if (obstacles_ != nullptr) {
    auto& frozen = obstacles_->frozen_friction_to_set();
    changed = !frozen.empty();
    for (const ContactFriction& f : frozen) {
      const Obstacle& obstacle = obstacles_->obstacles()[f.obstacle];
      const double carried = f.force.dot(obstacle.moved_by(time + h) - obstacle.moved_by(time));
      losses_.supplied += carried;
      losses_.rubbed += carried - f.force.dot(ObstacleContact::place_of(obstacles_->samples()[f.sample], x) - f.from);
    }
    frozen.clear();
  }
  if (bodies_ != nullptr) {
    auto& frozen = bodies_->frozen_friction_to_set();
    changed = changed || !frozen.empty();
    for (const BodyFriction& f : frozen) losses_.rubbed -= f.force.dot(f.site.difference(x) - f.from);
    frozen.clear();
  }
  changed = place_at(time + h, x) || changed;
  return bounces_.after(bounce_step(time + h, h, inverse_mass, fixed, x, v), losses_) || changed;
}

Bounces::Step ContactImpulses::bounce_step(double time, double h, InverseMass inverse_mass, Fixed fixed,
                                           std::span<const Vector3d> x, std::span<Vector3d> v) {
  return {.time = time,
          .h = h,
          .near_obstacles = obstacles_ != nullptr && obstacles_->has_damping() && !is_clear(x),
          .near_bodies = bodies_ != nullptr && bodies_->has_damping() && !are_apart(x),
          .inverse_mass = inverse_mass,
          .held = fixed,
          .x = x,
          .v = v};
}

bool ContactImpulses::is_clear(std::span<const Vector3d> x) {
  if (x.empty()) return true;
  if (!clear_) clear_ = obstacles_->clear_box(x);
  return clear_.has_value();
}

double ContactImpulses::room_at(std::span<const Vector3d> x) {
  if (!room_) room_ = bodies_->room_at(x);
  return *room_;
}

void ContactImpulses::take_back() {
  forget_places();
  if (obstacles_ != nullptr) obstacles_->frozen_friction_to_set().clear();
  if (bodies_ != nullptr) bodies_->frozen_friction_to_set().clear();
  losses_ = losses_at_begin_;
  bounces_.take_back();
  if (!has_friction()) return;
  // the obstacles are where `begin` has put them
  std::swap(before_, now_);
  std::swap(bodies_before_, bodies_now_);
}

void ContactImpulses::change_part(ObstacleContact* obstacles, BodyContact* bodies,
                                  std::span<const std::uint32_t> moved_to,
                                  std::span<const std::uint32_t> moved_to_of_bodies,
                                  std::span<const std::uint32_t> vertices) {
  obstacles_ = obstacles;
  bodies_ = bodies;
  bounces_.change_part(obstacles, bodies, vertices);
  forget_places();
  const auto renumber = [](auto& rows, std::span<const std::uint32_t> to) {
    std::erase_if(rows, [to](auto& row) {
      row.sample = row.sample < to.size() ? to[row.sample] : VertexSubset::none;
      return row.sample == VertexSubset::none;
    });
  };
  renumber(before_, moved_to);
  renumber(bodies_before_, moved_to_of_bodies);
}

bool ContactImpulses::place_at(double time, std::span<const Vector3d> x) {
  if (obstacles_ == nullptr) return false;
  const EnergyChange work = obstacles_->work_of_placing(time, x);
  losses_.supplied += work.value;
  if (obstacles_->place_at(time)) clear_.reset();
  return work.sizes > 0.0;  // obstacles that move elsewhere change no force
}

void ContactImpulses::find_rubbing_samples(double time, double h, InverseMass inverse_mass, Fixed fixed,
                                           std::span<const Vector3d> x, std::span<const Vector3d> v) {
  if (clear_ ? obstacles_->is_clear_after(*clear_, v, h / 2) : obstacles_->is_clear(x, v, h / 2)) return;
  auto old = before_.begin();
  const auto& samples = obstacles_->samples();
  for (std::uint32_t k = 0; k < samples.size(); ++k) {
    const SkinSample& s = samples[k];
    const Vector3d y = ObstacleContact::place_of(s, x), speed = ObstacleContact::place_of(s, v),
                   half_way = y + (h / 2) * speed;
    obstacles_->for_each_penetration(half_way, [&](std::uint32_t o, const Penetration& in) {
      const ContactLaw& law = obstacles_->laws()[o];
      if (law.friction == 0.0) return;
      const double mobility = mobility_of(s, inverse_mass, fixed);
      if (mobility == 0.0) return;
      const double approach = (obstacles_->obstacles()[o].velocity_at(time + h / 2) - speed).dot(in.normal);
      most_.push_back(most_friction(law, bounces_.factor(k, o, law, approach), s.area, mobility,
                                    obstacles_->penetration_in(o, y).depth, in.depth, approach, h));
      normal_.push_back(in.normal);
      // that of before, in the same obstacle or in one that it is joined with
      while (old != before_.end() && old->sample < k) ++old;
      auto held = old;
      while (held != before_.end() && held->sample == k && held->obstacle != o &&
             !obstacles_->are_joined(held->obstacle, o))
        ++held;
      const bool is_held = held != before_.end() && held->sample == k;
      now_.push_back({k, o, is_held ? across(held->force, in.normal) : Vector3d(0, 0, 0), y});
    });
  }
}

void ContactImpulses::find_rubbing_bodies(double h, InverseMass inverse_mass, Fixed fixed, std::span<const Vector3d> x,
                                          std::span<const Vector3d> v) {
  if (const double room = room_at(x); room > 0.0 && 0.5 * h * box_around(v).diagonal() < room) return;
  depth_.clear();
  for (const BodyTouch& t : bodies_->touching({x})) depth_.emplace_back(t.sample, t.depth);
  auto old = bodies_before_.begin();
  auto deep = depth_.begin();
  for (const BodyTouch& t : bodies_->touching({x, v, h / 2})) {
    const ContactLaw& law = bodies_->laws()[t.law];
    if (law.friction == 0.0) continue;
    const ContactSite along = bodies_->normal_site(t), site = bodies_->tangential_site(t);
    const double mobility = along.mobility(inverse_mass, fixed);
    if (mobility == 0.0 || site.mobility(inverse_mass, fixed) == 0.0) continue;
    const double approach = -along.difference(v).dot(t.normal);
    while (deep != depth_.end() && deep->first < t.sample) ++deep;
    const double depth = deep != depth_.end() && deep->first == t.sample ? deep->second : 0.0;
    most_.push_back(most_friction(law, bounces_.factor(t.sample, Bounces::body, law, approach), t.area, mobility, depth,
                                  t.depth, approach, h));
    normal_.push_back(t.normal);
    while (old != bodies_before_.end() && old->sample < t.sample) ++old;
    const bool held = old != bodies_before_.end() && old->sample == t.sample;
    bodies_now_.push_back(
        {t.sample, t.tetrahedron, site, held ? across(old->force, t.normal) : Vector3d(0, 0, 0), site.difference(x)});
  }
}

bool ContactImpulses::set_friction(double time, double h, InverseMass inverse_mass, Fixed fixed,
                                   std::span<const Vector3d> x, std::span<const Vector3d> v,
                                   const Accelerations& accelerations) {
  if (!has_friction()) return false;
  now_.clear();
  bodies_now_.clear();
  normal_.clear();
  most_.clear();
  if (obstacles_ != nullptr && obstacles_->has_friction()) find_rubbing_samples(time, h, inverse_mass, fixed, x, v);
  if (bodies_ != nullptr && bodies_->has_friction()) find_rubbing_bodies(h, inverse_mass, fixed, x, v);
  if (now_.empty() && bodies_now_.empty()) {
    before_.swap(now_);
    bodies_before_.swap(bodies_now_);
    return false;
  }

  acceleration_.resize(x.size());
  accelerations(x, v, acceleration_);  // with no friction set yet
  for (std::size_t k = 0; k < now_.size(); ++k) {
    now_[k].force = at_most(now_[k].force, most_[k]);
    push(obstacles_->samples()[now_[k].sample], now_[k].force, inverse_mass, fixed, acceleration_);
  }
  const std::size_t first = now_.size();  // place of the first contact between bodies
  for (std::size_t k = 0; k < bodies_now_.size(); ++k) {
    bodies_now_[k].force = at_most(bodies_now_[k].force, most_[first + k]);
    bodies_now_[k].site.push(bodies_now_[k].force, inverse_mass, fixed, acceleration_);
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool done = true;
    // The force that stops it by the end of the step; or the largest allowed, against its velocity half way there.
    const auto relax = [&](const Vector3d& speed, const Vector3d& others, double mobility, double most, Vector3d& old) {
      Vector3d force = -(speed + others) / mobility;
      if (force.norm() > most) {
        const Vector3d way = speed + 0.5 * others;
        const double size = way.norm();
        force = size > 0.0 ? Vector3d(-most / size * way) : at_most(force, most);
      }
      Vector3d change = force - old;
      if (change.norm() > settled * most) done = false;
      old = force;
      return change;
    };
    for (std::size_t k = 0; k < now_.size(); ++k) {
      ContactFriction& f = now_[k];
      const SkinSample& s = obstacles_->samples()[f.sample];
      const Obstacle& obstacle = obstacles_->obstacles()[f.obstacle];
      const double mobility = mobility_of(s, inverse_mass, fixed);
      const Vector3d carried = (obstacle.moved_by(time + h) - obstacle.moved_by(time)) / h,
                     speed = across(ObstacleContact::place_of(s, v) - carried, normal_[k]) / h,
                     others = across(ObstacleContact::place_of(s, acceleration_), normal_[k]) - mobility * f.force;
      push(s, relax(speed, others, mobility, most_[k], f.force), inverse_mass, fixed, acceleration_);
    }
    for (std::size_t k = 0; k < bodies_now_.size(); ++k) {
      BodyFriction& f = bodies_now_[k];
      const Vector3d& normal = normal_[first + k];
      const double mobility = f.site.mobility(inverse_mass, fixed);
      const Vector3d speed = across(f.site.difference(v), normal) / h,
                     others = across(f.site.difference(acceleration_), normal) - mobility * f.force;
      f.site.push(relax(speed, others, mobility, most_[first + k], f.force), inverse_mass, fixed, acceleration_);
    }
    if (done) break;
  }
  if (obstacles_ != nullptr) obstacles_->frozen_friction_to_set() = now_;
  if (bodies_ != nullptr) bodies_->frozen_friction_to_set() = bodies_now_;
  before_.swap(now_);
  bodies_before_.swap(bodies_now_);
  return true;
}

std::size_t ContactImpulses::bytes() const {
  return bounces_.bytes() + most_.capacity() * sizeof(double) +
         (acceleration_.capacity() + normal_.capacity()) * sizeof(Vector3d) +
         (before_.capacity() + now_.capacity()) * sizeof(ContactFriction) +
         (bodies_before_.capacity() + bodies_now_.capacity()) * sizeof(BodyFriction) +
         depth_.capacity() * sizeof(std::pair<std::uint32_t, double>);
}

}  // namespace dartboard
