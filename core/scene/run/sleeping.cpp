#include "core/scene/run/sleeping.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "core/base/bytes.h"
#include "core/base/disjoint_sets.h"
#include "core/scene/file/step_times.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// What a way that is left is too long by, over the distance of vertices.
constexpr double rounding = 1e-9;
/// Boxes are near where they are closer than this share of the distance of vertices of either.
constexpr double near_share = 0.0625;

/// [m] Along the axis where they are farthest from each other; negative where they overlap.
double apart(const BoxAround& a, const BoxAround& b) { return (a.low - b.high).cwiseMax(b.low - a.high).maxCoeff(); }

/// The numbers after a change, by those before; both are given by their numbers in the whole.
std::vector<std::uint32_t> moved(const std::vector<std::uint32_t>& before, const std::vector<std::uint32_t>& after) {
  std::vector<std::uint32_t> now, to;
  for (std::uint32_t k = 0; k < after.size(); ++k) {
    now.resize(std::max<std::size_t>(now.size(), after[k] + std::size_t{1}), VertexSubset::none);
    now[after[k]] = k;
  }
  for (const std::uint32_t k : before) to.push_back(k < now.size() ? now[k] : VertexSubset::none);
  return to;
}

/// Sets the column to the values; whether any has changed.
template <class T>
bool update(std::vector<T>& column, std::span<const T> values) {
  const bool same = column.size() == values.size() &&
                    (values.empty() || std::memcmp(column.data(), values.data(), values.size_bytes()) == 0);
  if (!same) column.assign(values.begin(), values.end());
  return !same;
}

}  // namespace

Sleeping::Sleeping(const SceneSleep& rule, double step, SimulatedBody& body)
    : rule_(rule),
      // slow at the first and at the last of these boundaries: from one to the other it takes the time at least
      slow_steps_(1 + step_of_time(rule.time, step)),
      body_(body) {
  find_components();
  make_part();
}

// ---- components

void Sleeping::find_components() {
  const SpringSystem system = body_.system();
  DisjointSets sets(system.vertex_count());
  for (const auto& [i, j] : system.ends) sets.join(i, j);
  for (const ForceTerm* term : body_.terms_but_contact(system.terms))
    for (std::size_t piece = 0; piece < term->size(); ++piece) {
      const auto nodes = term->nodes(piece);
      for (const std::uint32_t i : nodes) sets.join(nodes[0], i);
    }
  components_.clear();
  component_.resize(system.vertex_count());
  for (std::uint32_t i = 0; i < component_.size(); ++i) {
    if (const std::uint32_t lowest = sets.set_of(i); lowest != i) {
      component_[i] = component_[lowest];
    } else {
      component_[i] = static_cast<std::uint32_t>(components_.size());
      components_.emplace_back();
    }
    ++components_[component_[i]].count;
  }
  std::uint32_t next = 0;
  for (Component& c : components_) {
    c.first = next;
    next += c.count;
    c.count = 0;
  }
  ordered_.resize(component_.size());
  for (std::uint32_t i = 0; i < component_.size(); ++i) {
    Component& c = components_[component_[i]];
    ordered_[c.first + c.count++] = i;
  }
  done_.asleep = 0;
  if (const BodyContact* contact = body_.contacts().bodies)
    for (const SkinSample& sample : contact->samples())
      components_[component_[sample.nodes[0]]].group = contact->solids().group_at(sample.nodes[0]);
  for (Component& c : components_) {
    look_at_box(c);
    c.size = (c.box.high - c.box.low).norm() / std::cbrt(c.count);
    c.near = near_share * c.size;
  }
  update<Vector3d>(pull_, body_.pull());
  update<double>(pressures_, body_.loads());
  if (const ObstacleContact* contact = body_.contacts().obstacles) update(obstacles_, contact->moved());
}

bool Sleeping::is_slow(const Component& c) {
  const auto is_slow = [most = rule_.speed * rule_.speed](const Vector3d& v) { return v.squaredNorm() <= most; };
  if (part_ && c.first_in_part != none)
    return std::ranges::all_of(part_->motion().v.subspan(c.first_in_part, c.count), is_slow);
  const auto& v = body_.vertices().velocity;
  return std::ranges::all_of(vertices_of(c), [&](std::uint32_t i) { return is_slow(v[i]); });
}

/// Does it have a fixed vertex that moves?
bool Sleeping::is_driven(const Component& c) const {
  const VertexColumns& v = body_.vertices();
  return !v.fixed.empty() && std::ranges::any_of(vertices_of(c), [&v](std::uint32_t i) {
    return v.fixed[i] != 0 && !v.velocity[i].isZero(0.0);
  });
}

/// Returns the way of the box since the last look.
double Sleeping::look_at_box(Component& c) {
  const BoxAround before = c.box;
  if (part_ && c.first_in_part != none) {
    c.box = box_around(part_->motion().x.subspan(c.first_in_part, c.count));
  } else {
    const auto& x = body_.vertices().position;
    const auto own = vertices_of(c);
    c.box = {x[own[0]], x[own[0]]};
    for (const std::uint32_t i : own) c.box = {c.box.low.cwiseMin(x[i]), c.box.high.cwiseMax(x[i])};
  }
  const Vector3d low = (c.box.low - before.low).cwiseAbs(), high = (c.box.high - before.high).cwiseAbs();
  const double way = low.cwiseMax(high).maxCoeff();
  c.near = near_share * c.size + 2.0 * way;
  return way;
}

bool Sleeping::may_touch(const Component& a, const Component& b) const {
  return a.group && b.group && body_.contacts().bodies->may_touch(*a.group, *b.group);
}

// Boxes that are not finite are near to nothing; such a run is ended by its watch.
bool Sleeping::are_near(const Component& a, const Component& b) const {
  return may_touch(a, b) && apart(a.box, b.box) <= a.near + b.near;
}

// ---- waking

void Sleeping::wake(Component& c) {
  c.asleep = false;
  c.slow = 0;
  --done_.asleep;
  ++done_.woken;
}

bool Sleeping::wake_near_awake() {
  if (done_.asleep == 0 || body_.contacts().bodies == nullptr) return false;
  std::vector<const Component*> waking;  // those whose sleepers nearby are still to be found
  for (const std::uint32_t k : awake_) {
    Component& c = components_[k];
    if (!c.group) continue;
    const double way = look_at_box(c);
    c.free_way -= way;
    if (c.free_way > 2.0 * way) continue;
    c.free_way = std::numeric_limits<double>::infinity();
    for (const Component& other : components_)
      if (other.asleep && may_touch(c, other))
        c.free_way = std::min(c.free_way, apart(c.box, other.box) - near_share * c.size - other.near);
    c.free_way -= rounding * c.size;
    if (c.free_way <= 2.0 * way) waking.push_back(&c);
  }
  bool any = false;
  while (!waking.empty()) {
    const Component& by = *waking.back();
    waking.pop_back();
    for (Component& c : components_)
      if (c.asleep && are_near(by, c)) {
        wake(c);
        waking.push_back(&c);
        any = true;
      }
  }
  return any;
}

bool Sleeping::wake_near_moving_obstacles() {
  ObstacleContact* const contact = body_.contacts().obstacles;
  if (contact == nullptr) return false;
  bool any = false;
  for (std::uint32_t o = 0; o < obstacles_.size(); ++o) {
    const double way = (contact->moved()[o] - obstacles_[o]).norm();
    if (way == 0.0) continue;
    obstacles_[o] = contact->moved()[o];
    for (Component& c : components_) {
      if (!c.asleep && c.slow == 0) continue;
      if (!c.asleep) look_at_box(c);
      if (contact->is_away(o, c.box, near_share * c.size + 2.0 * way)) continue;
      any = any || c.asleep;
      if (c.asleep) wake(c);
      c.slow = 0;
    }
  }
  return any;
}

bool Sleeping::body_changed() {
  const bool had_part = part_ != nullptr;
  done_.woken += done_.asleep;
  part_.reset();
  find_components();
  make_part();
  return had_part;
}

bool Sleeping::loads_changed() {
  const bool others = update<double>(pressures_, body_.loads());
  const VertexColumns& v = body_.vertices();
  bool any = false;
  const auto wake_at = [&](std::uint32_t vertex) {
    Component& c = components_[component_[vertex]];
    c.slow = 0;  // one that is awake must not fall asleep before it has felt the load
    if (!c.asleep) return;
    wake(c);
    any = true;
  };
  for (std::uint32_t i = 0; i < v.size(); ++i) {
    const bool is_driven = done_.asleep > 0 && components_[component_[i]].asleep && !v.velocity[i].isZero(0.0);
    if (is_driven || (!pull_.empty() && pull_[i] != v.pull[i])) wake_at(i);
  }
  if (others) {
    const ForceTerm& loaded = body_.forces().with_loads()->term();
    for (std::size_t piece = 0; piece < loaded.size(); ++piece) wake_at(loaded.nodes(piece)[0]);
  }
  update<Vector3d>(pull_, body_.pull());
  if (any)
    make_part();
  else if (part_)
    part_->take(body_.motion(), body_.pull());
  return any;
}

// ---- falling asleep

void Sleeping::put_to_sleep(Component& c) {
  VertexColumns& v = body_.vertices();
  for (const std::uint32_t i : vertices_of(c)) {
    done_.removed += 0.5 * v.mass[i] * v.velocity[i].squaredNorm();
    v.velocity[i].setZero();
  }
  c.asleep = true;
  c.first_in_part = none;
  c.near = near_share * c.size;
  ++done_.asleep;
  ++done_.slept;
}

bool Sleeping::put_to_sleep() {
  const auto is_ready = [this](std::uint32_t k) {
    return components_[k].slow >= slow_steps_ && !is_driven(components_[k]);
  };
  if (std::ranges::none_of(awake_, is_ready)) return false;
  std::vector<Component*> ready, others;
  for (const std::uint32_t k : awake_) (is_ready(k) ? ready : others).push_back(&components_[k]);
  if (body_.contacts().bodies != nullptr) {
    for (auto* some : {&ready, &others})
      for (Component* c : *some) look_at_box(*c);
    // one that is near to a component that stays awake stays awake as well
    while (!others.empty()) {
      const Component& awake = *others.back();
      others.pop_back();
      const auto stays = std::partition(ready.begin(), ready.end(), [&](Component* c) { return !are_near(*c, awake); });
      others.insert(others.end(), stays, ready.end());
      ready.erase(stays, ready.end());
    }
  }
  for (Component* c : ready) put_to_sleep(*c);
  return !ready.empty();
}

// ---- steps

void Sleeping::give() {
  if (!part_) return;
  part_->give(body_.motion());
  if (part_contact_ && body_.contacts().obstacles != nullptr)
    body_.contacts().obstacles->place_as(*part_contact_->contacts().obstacles);
}

bool Sleeping::after_step(std::uint64_t n) {
  bool changed = wake_near_awake();
  changed = wake_near_moving_obstacles() || changed;
  for (const std::uint32_t k : awake_) {
    Component& c = components_[k];
    c.slow = is_slow(c) ? c.slow + 1 : 0;
  }
  // a body at rest beside one that moves is not examined anew in every step
  const std::uint64_t between = std::max<std::uint64_t>(1, slow_steps_ / 8);
  if (!changed && n % between == 0) changed = put_to_sleep();
  if (changed) make_part();
  return changed;
}

std::array<std::vector<std::uint32_t>, 2> Sleeping::samples_in_whole() {
  if (part_contact_) return part_contact_->whole_samples();
  std::array<std::vector<std::uint32_t>, 2> numbers;
  for (const std::size_t k : {0, 1}) {
    numbers[k].resize(body_.contacts().samples(k == 1).size());
    std::iota(numbers[k].begin(), numbers[k].end(), std::uint32_t{0});
  }
  return numbers;
}

void Sleeping::make_part() {
  const auto before = samples_in_whole();
  part_.reset();
  part_contact_.reset();
  awake_.clear();
  for (std::uint32_t k = 0; k < components_.size(); ++k) {
    components_[k].free_way = 0.0;
    if (!components_[k].asleep) awake_.push_back(k);
  }
  if (done_.asleep > 0) {
    std::vector<std::uint32_t> awake;
    for (const std::uint32_t k : awake_) {
      Component& c = components_[k];
      c.first_in_part = static_cast<std::uint32_t>(awake.size());
      const auto own = vertices_of(c);
      awake.insert(awake.end(), own.begin(), own.end());
    }
    const SpringSystem system = body_.system();
    part_ = std::make_unique<SystemPart>(system, body_.terms_but_contact(system.terms), std::move(awake));
    part_->take(body_.motion(), body_.pull());
    if (const Contacts whole = body_.contacts(); whole.any()) {
      part_contact_ = std::make_unique<ContactOfPart>(whole, part_->subset());
      const Contacts own = part_contact_->contacts();
      if (own.obstacles != nullptr) part_->add(*own.obstacles);
      if (own.bodies != nullptr) part_->add(*own.bodies);
    }
  }
  const auto after = samples_in_whole();
  for (std::size_t k : {0, 1}) moved_samples_[k] = moved(before[k], after[k]);
}

void Sleeping::state(Archive& archive) {
  archive.part("sleeping");
  if (archive.reads()) find_components();
  std::uint64_t count = components_.size();
  archive(count, done_);
  if (count != components_.size()) archive.fail("the body has other components than the run had");
  for (Component& c : components_) archive(c.asleep, c.slow, c.size, c.box.low, c.box.high, c.near);
  if (!archive.reads()) return;
  make_part();
}

std::size_t Sleeping::bytes() const {
  return bytes_of(component_, ordered_, pull_) + (part_ ? part_->bytes() : 0) +
         (part_contact_ ? part_contact_->bytes() : 0);
}

}  // namespace dartboard
