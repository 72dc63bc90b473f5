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
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const ContactFriction& f = friction_[k];
    const double carried = f.force.dot(sliding_[k].carried);
    losses_.supplied += carried;
    losses_.rubbed += carried - f.force.dot(f.site.difference(x) - f.from);
  }
  clear_friction();
  bool changed = !friction_.empty();
  changed = place_at(time + h, x) || changed;
  return bounces_.after(bounce_step(time + h, h, inverse_mass, fixed, x, v), losses_) || changed;
}

Bounces::Step ContactImpulses::bounce_step(double time, double h, InverseMass inverse_mass, Fixed fixed,
                                           std::span<const Vector3d> x, std::span<Vector3d> v) {
  return {.time = time,
          .h = h,
          .near = {contacts_.obstacles != nullptr && contacts_.obstacles->has_damping() && !is_clear(x)
                       ? contacts_.obstacles
                       : nullptr,
                   contacts_.bodies != nullptr && contacts_.bodies->has_damping() && !are_apart(x) ? contacts_.bodies
                                                                                                   : nullptr},
          .inverse_mass = inverse_mass,
          .held = fixed,
          .x = x,
          .v = v};
}

bool ContactImpulses::is_clear(std::span<const Vector3d> x) {
  if (x.empty()) return true;
  if (!clear_) clear_ = contacts_.obstacles->clear_box(x);
  return clear_.has_value();
}

double ContactImpulses::room_at(std::span<const Vector3d> x) {
  if (!room_) room_ = contacts_.bodies->room_at(x);
  return *room_;
}

void ContactImpulses::clear_friction() {
  if (contacts_.obstacles != nullptr) contacts_.obstacles->frozen_friction_to_set().clear();
  if (contacts_.bodies != nullptr) contacts_.bodies->frozen_friction_to_set().clear();
}

void ContactImpulses::take_back() {
  forget_places();
  clear_friction();
  losses_ = losses_at_begin_;
  bounces_.take_back();
  if (contacts_.has_friction()) std::swap(friction_, earlier_);  // the obstacles are where `begin` has put them
}

void ContactImpulses::change_part(const Contacts& contacts, const MovedSamples& moved_to,
                                  std::span<const std::uint32_t> vertices) {
  contacts_ = contacts;
  bounces_.change_part(contacts, vertices);
  forget_places();
  std::erase_if(friction_, [&moved_to](ContactFriction& row) {
    const std::vector<std::uint32_t>& to = moved_to[row.is_of_bodies() ? 1 : 0];
    row.sample = row.sample < to.size() ? to[row.sample] : VertexSubset::none;
    return row.sample == VertexSubset::none;
  });
}

bool ContactImpulses::place_at(double time, std::span<const Vector3d> x) {
  if (contacts_.obstacles == nullptr) return false;
  const EnergyChange work = contacts_.obstacles->work_of_placing(time, x);
  losses_.supplied += work.value;
  if (contacts_.obstacles->place_at(time)) clear_.reset();
  return work.sizes > 0.0;  // obstacles that move elsewhere change no force
}

/// The contacts with friction, without a term of which no sample can be inside anything a time t later.
Contacts ContactImpulses::rubbing_after(double t, std::span<const Vector3d> x, std::span<const Vector3d> v) {
  Contacts rubbing = contacts_;
  if (ObstacleContact*& obstacles = rubbing.obstacles; obstacles != nullptr)
    if (!obstacles->has_friction() ||
        (clear_ ? obstacles->is_clear_after(*clear_, v, t) : obstacles->is_clear(x, v, t)))
      obstacles = nullptr;
  if (rubbing.bodies != nullptr) {
    const double room = rubbing.bodies->has_friction() ? room_at(x) : 0.0;
    if (!rubbing.bodies->has_friction() || (room > 0.0 && t * box_around(v).diagonal() < room))
      rubbing.bodies = nullptr;
  }
  return rubbing;
}

/// The friction of a sample in the step before: in the same obstacle or in one that it is joined with, or in a body.
Vector3d ContactImpulses::force_before(const Touch& touch) const {
  const auto order = [](const auto& row) { return std::pair(row.obstacle == Touch::body, row.sample); };
  auto row = std::ranges::lower_bound(earlier_, order(touch), {}, order);
  for (; row != earlier_.end() && order(*row) == order(touch); ++row)
    if (row->obstacle == touch.obstacle || contacts_.obstacles->are_joined(row->obstacle, touch.obstacle))
      return across(row->force, touch.normal);
  return {0, 0, 0};
}

/// [m] Of the sample in what it touches, at x.
double ContactImpulses::depth_at_beginning(const Touch& touch, std::span<const Vector3d> x) const {
  if (touch.in_body == nullptr)
    return contacts_.obstacles->penetration_in(touch.obstacle, ObstacleContact::place_of(contacts_.sample(touch), {x}))
        .depth;
  const auto found = std::ranges::lower_bound(depth_, touch.sample, {}, &std::pair<std::uint32_t, double>::first);
  return found != depth_.end() && found->first == touch.sample ? found->second : 0.0;
}

void ContactImpulses::find_rubbing(double time, double h, InverseMass inverse_mass, Fixed fixed,
                                   std::span<const Vector3d> x, std::span<const Vector3d> v) {
  const Contacts rubbing = rubbing_after(h / 2, x, v);
  depth_.clear();
  if (rubbing.bodies != nullptr)
    for (const BodyTouch& t : rubbing.bodies->touching({x})) depth_.emplace_back(t.sample, t.depth);
  rubbing.for_each_touch({x, v, h / 2}, [&](const Touch& t) {
    if (t.law->friction == 0.0) return;
    const ContactSite along = rubbing.normal_site(t), site = rubbing.tangential_site(t);
    const double mobility = along.mobility(inverse_mass, fixed);
    if (mobility == 0.0 || site.mobility(inverse_mass, fixed) == 0.0) return;
    Vector3d velocity(0, 0, 0), carried(0, 0, 0);
    std::uint32_t tetrahedron = 0;
    if (t.in_body != nullptr) {
      tetrahedron = t.in_body->tetrahedron;
    } else {
      const Obstacle& obstacle = contacts_.obstacles->obstacles()[t.obstacle];
      velocity = obstacle.velocity_at(time + h / 2);
      carried = obstacle.moved_by(time + h) - obstacle.moved_by(time);
    }
    const double approach = (velocity - along.difference(v)).dot(t.normal);
    sliding_.push_back({t.normal, carried,
                        most_friction(*t.law, bounces_.factor(t, approach), t.area, mobility, depth_at_beginning(t, x),
                                      t.depth, approach, h)});
    friction_.push_back(
        {t.sample, t.obstacle, tetrahedron, site, at_most(force_before(t), sliding_.back().most), site.difference(x)});
  });
}

bool ContactImpulses::set_friction(double time, double h, InverseMass inverse_mass, Fixed fixed,
                                   std::span<const Vector3d> x, std::span<const Vector3d> v,
                                   const Accelerations& accelerations) {
  if (!contacts_.has_friction()) return false;
  earlier_.swap(friction_);
  friction_.clear();
  sliding_.clear();
  find_rubbing(time, h, inverse_mass, fixed, x, v);
  if (friction_.empty()) return false;

  acceleration_.resize(x.size());
  accelerations(x, v, acceleration_);  // with no friction set yet
  for (const ContactFriction& f : friction_) f.site.push(f.force, inverse_mass, fixed, acceleration_);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool done = true;
    for (std::size_t k = 0; k < friction_.size(); ++k) {
      ContactFriction& f = friction_[k];
      const auto& [normal, carried, most] = sliding_[k];
      // The force that stops it by the end of the step; or the largest allowed, against its velocity half way there.
      const double mobility = f.site.mobility(inverse_mass, fixed);
      const Vector3d speed = across(f.site.difference(v) - carried / h, normal) / h,
                     others = across(f.site.difference(acceleration_), normal) - mobility * f.force;
      Vector3d force = -(speed + others) / mobility;
      if (force.norm() > most) {
        const Vector3d way = speed + 0.5 * others;
        const double size = way.norm();
        force = size > 0.0 ? Vector3d(-most / size * way) : at_most(force, most);
      }
      const Vector3d change = force - f.force;
      if (change.norm() > settled * most) done = false;
      f.force = force;
      f.site.push(change, inverse_mass, fixed, acceleration_);
    }
    if (done) break;
  }
  const auto between = std::ranges::find_if(friction_, &ContactFriction::is_of_bodies);
  if (contacts_.obstacles != nullptr) contacts_.obstacles->frozen_friction_to_set().assign(friction_.begin(), between);
  if (contacts_.bodies != nullptr) contacts_.bodies->frozen_friction_to_set().assign(between, friction_.end());
  return true;
}

std::size_t ContactImpulses::bytes() const {
  return bounces_.bytes() + acceleration_.capacity() * sizeof(Vector3d) + sliding_.capacity() * sizeof(Sliding) +
         (friction_.capacity() + earlier_.capacity()) * sizeof(ContactFriction) +
         depth_.capacity() * sizeof(std::pair<std::uint32_t, double>);
}

}  // namespace dartboard
