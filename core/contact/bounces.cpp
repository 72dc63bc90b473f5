#include "core/contact/bounces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/bytes.h"
#include "core/forces/one_minus_exp.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// A rate of depth [m/s] after the time t, which changes by - a r / r0 - by no more than `most` where that pulls.
/// units  a, most [m/s^2]
/// pre    a, most >= 0; r0 >= |rate|
double damped(double rate, double first, double a, double most, double t) {
  if (rate == 0.0) return 0.0;  // and r0 may be 0, where a depth is so small that its energy is
  if (rate < 0.0 && -a * rate > most * first) {
    // the largest pull, until the rate is as small as it fits
    const double until = -most / a * first, needed = most > 0.0 ? (until - rate) / most : t;
    if (needed >= t) return rate + most * t;
    rate = until;
    t -= needed;
  }
  return rate - rate * one_minus_exp_of_minus(a / first * t);
}

}  // namespace

Bounces::Bounces(ObstacleContact* obstacles, BodyContact* bodies) : obstacles_(obstacles), bodies_(bodies) {
  if (obstacles_ != nullptr)
    for (const ContactLaw& law : obstacles_->laws()) loss_.push_back(law.loss());
  if (bodies_ != nullptr)
    for (const ContactLaw& law : bodies_->laws()) loss_of_bodies_.push_back(law.loss());
}

bool Bounces::has_losses() const {
  return (obstacles_ != nullptr && obstacles_->has_damping()) || (bodies_ != nullptr && bodies_->has_damping());
}

bool Bounces::before(const Step& step, ContactLosses& losses) {
  if (!has_losses()) return false;
  starts_before_ = starts_;
  v_before_.assign(step.v.begin(), step.v.end());
  find_touches(step);
  match_starts(Side::before, step);
  for (std::size_t k = 0; k < starts_.size(); ++k) starts_[k].depth = touches_[k].depth;
  return damp(Side::before, step, losses);
}

bool Bounces::after(const Step& step, ContactLosses& losses) {
  if (!has_losses()) return false;
  find_touches(step);
  match_starts(Side::after, step);
  const bool changed = damp(Side::after, step, losses);
  // anew at the velocities that the step ends with: those before its last half of the losses are of order 1
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    if (starts_[k].depth == 0.0) starts_[k].rate = first_rate(touches_[k], Side::after, step);
    starts_[k].rate = std::max(starts_[k].rate, std::abs(touches_[k].rate(step.v)));
  }
  return changed;
}

void Bounces::add(Touch touch, std::uint32_t sample, std::uint32_t obstacle, const Step& step) {
  if (touch.site.mobility(step.inverse_mass, step.held) == 0.0) return;
  // 0 where the normal is along held axes; it may turn while they touch
  touch.mobility = touch.site.mobility_along(touch.normal, step.inverse_mass, step.held);
  touches_.push_back(touch);
  starts_.push_back({.sample = sample, .obstacle = obstacle});
}

/// Fills the touches, and for each a start that only names it.
void Bounces::find_touches(const Step& step) {
  earlier_.swap(starts_);
  starts_.clear();
  touches_.clear();
  if (step.near_obstacles && obstacles_ != nullptr && obstacles_->has_damping())
    obstacles_->for_each_touch(step.x, [&](std::uint32_t k, std::uint32_t o, const Penetration& in) {
      if (loss_[o] == 0.0) return;
      const SkinSample& sample = obstacles_->samples()[k];
      Touch touch{.normal = in.normal,
                  .law = &obstacles_->laws()[o],
                  .loss = loss_[o],
                  .area = sample.area,
                  .depth = in.depth,
                  .carried = obstacles_->obstacles()[o].velocity_at(step.time).dot(in.normal)};
      for (const std::uint32_t i : sample.corners()) touch.site.add(i, 1.0 / sample.count);
      add(touch, k, o, step);
    });
  if (step.near_bodies && bodies_ != nullptr && bodies_->has_damping())
    for (const BodyTouch& t : bodies_->touching({step.x}))
      if (loss_of_bodies_[t.law] > 0.0)
        add({.site = bodies_->normal_site(t),
             .normal = t.normal,
             .law = &bodies_->laws()[t.law],
             .loss = loss_of_bodies_[t.law],
             .area = t.area,
             .depth = t.depth},
            t.sample, body, step);
}

std::array<std::uint32_t, 4> Bounces::whole_nodes(const SkinSample& sample) const {
  std::array<std::uint32_t, 4> nodes = sample.nodes;
  if (!vertices_.empty())
    for (std::uint32_t k = 0; k < sample.count; ++k) nodes[k] = vertices_[nodes[k]];
  return nodes;
}

const SkinSample* Bounces::sample_of(const Start& start) const {
  const std::vector<SkinSample>& samples = start.obstacle == body ? bodies_->samples() : obstacles_->samples();
  return start.sample < samples.size() ? &samples[start.sample] : nullptr;
}

/// Finds the samples of the earlier starts by their vertices, if any of them has another number now.
/// cost  O(samples) then; otherwise O(contacts)
void Bounces::find_samples() {
  const auto is_found = [this](const Start& start) {
    const SkinSample* const sample = sample_of(start);
    return sample != nullptr && whole_nodes(*sample) == start.nodes;
  };
  if (std::ranges::all_of(earlier_, is_found)) return;
  std::vector<Start> found;
  std::ranges::sort(earlier_, {}, &Start::nodes);
  const auto look_among = [&](const std::vector<SkinSample>& samples, bool of_bodies) {
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
      const auto nodes = whole_nodes(samples[k]);
      auto old = std::ranges::lower_bound(earlier_, nodes, {}, &Start::nodes);
      for (; old != earlier_.end() && old->nodes == nodes; ++old) {
        if ((old->obstacle == body) != of_bodies) continue;
        found.push_back(*old);
        found.back().sample = k;
      }
    }
  };
  if (obstacles_ != nullptr) look_among(obstacles_->samples(), false);
  if (bodies_ != nullptr) look_among(bodies_->samples(), true);
  std::ranges::sort(found, {}, &Start::order);
  earlier_ = std::move(found);
}

/// The first rate of a touch that has not been there before.
double Bounces::first_rate(const Touch& touch, Side side, const Step& step) const {
  const double rate = touch.rate(step.v), earlier = side == Side::after ? touch.rate(v_before_) : 0.0;
  if (side == Side::after && rate + earlier > 0.0)  // back to the moment at which it met the surface
    return rate + std::min(1.0, 2.0 * touch.depth / (step.h * (rate + earlier))) * (earlier - rate);
  return std::sqrt(rate * rate + 2.0 * touch.law->energy(touch.area, touch.depth) * touch.mobility);
}

/// The start of a sample that was in another of the blocks that this obstacle is joined with; null if there is no such.
const Bounces::Start* Bounces::passed_on(const std::vector<Start>& among, std::uint32_t sample,
                                         std::uint32_t obstacle) const {
  if (obstacle == body) return nullptr;
  const Start first{.sample = sample};
  auto old = std::ranges::lower_bound(among, first.order(), {}, &Start::order);
  for (; old != among.end() && old->sample == sample && old->obstacle != body; ++old)
    if (obstacles_->are_joined(old->obstacle, obstacle)) return &*old;
  return nullptr;
}

void Bounces::match_starts(Side side, const Step& step) {
  if (!starts_.empty()) find_samples();
  auto old = earlier_.begin();
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    Start& start = starts_[k];
    const Touch& touch = touches_[k];
    start.nodes = whole_nodes(*sample_of(start));
    while (old != earlier_.end() && old->order() < start.order()) ++old;
    if (old != earlier_.end() && old->order() == start.order()) {
      start = *old;
    } else if (const Start* const same = passed_on(earlier_, start.sample, start.obstacle)) {
      start.rate = same->rate;
      start.depth = same->depth;
    } else {
      start.rate = std::max(first_rate(touch, side, step), std::abs(touch.rate(step.v)));
    }
  }
}

bool Bounces::damp(Side side, const Step& step, ContactLosses& losses) {
  bool changed = false;
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const std::size_t place = side == Side::before ? k : touches_.size() - 1 - k;
    const Touch& t = touches_[place];
    if (t.mobility == 0.0) continue;
    const Start& start = starts_[place];
    const double rate = t.rate(step.v);
    // the depths half way through the step, and the least within it, of a contact that comes apart
    double half_way = t.depth, least = t.depth;
    if (rate < 0.0) {
      half_way = side == Side::before ? t.depth + 0.5 * step.h * rate : 0.5 * (start.depth + t.depth);
      least = side == Side::before ? t.depth + step.h * rate : std::min(start.depth, t.depth);
    }
    const double there = damped(rate, start.rate, t.loss * t.mobility * t.law->force(t.area, half_way),
                                t.mobility * t.law->force(t.area, least), 0.5 * step.h),
                 impulse = (rate - there) / t.mobility;
    if (impulse == 0.0) continue;
    // what moves independently of forces: the obstacle, and driven nodes
    double driven = t.carried;
    for (std::size_t n = 0; n < t.site.count; ++n)
      if (mobility_of(t.site.nodes[n], step.inverse_mass, step.held) == 0.0)
        driven -= t.site.weights[n] * step.v[t.site.nodes[n]].dot(t.normal);
    t.site.push(impulse * t.normal, step.inverse_mass, step.held, step.v);
    losses.damped += 0.5 * impulse * (rate + there);
    losses.supplied += impulse * driven;
    changed = true;
  }
  return changed;
}

double Bounces::factor(std::uint32_t sample, std::uint32_t obstacle, const ContactLaw& law, double rate) const {
  const double loss = obstacle == body ? loss_of_bodies_[&law - bodies_->laws().data()] : loss_[obstacle];
  if (loss == 0.0) return 1.0;
  const Start named{.sample = sample, .obstacle = obstacle};
  const auto start = std::ranges::lower_bound(starts_, named.order(), {}, &Start::order);
  const bool is_known = start != starts_.end() && start->order() == named.order();
  const Start* const found = is_known ? &*start : passed_on(starts_, sample, obstacle);
  const double first = found != nullptr ? std::max(found->rate, std::abs(rate)) : std::abs(rate);
  return first > 0.0 ? std::max(0.0, 1.0 + loss * (rate / first)) : 1.0;
}

void Bounces::change_part(ObstacleContact* obstacles, BodyContact* bodies, std::span<const std::uint32_t> vertices) {
  obstacles_ = obstacles;
  bodies_ = bodies;
  vertices_ = vertices;
}

std::size_t Bounces::bytes() const {
  return bytes_of(loss_, loss_of_bodies_, touches_, starts_, starts_before_, earlier_, v_before_);
}

}  // namespace dartboard
