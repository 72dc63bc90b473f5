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

Bounces::Bounces(const Contacts& contacts) : contacts_(contacts) {
  if (contacts_.obstacles != nullptr)
    for (const ContactLaw& law : contacts_.obstacles->laws()) loss_.push_back(law.loss());
  if (contacts_.bodies != nullptr)
    for (const ContactLaw& law : contacts_.bodies->laws()) loss_of_bodies_.push_back(law.loss());
}

double Bounces::loss_of(const Touch& touch) const {
  return touch.in_body != nullptr ? loss_of_bodies_[touch.in_body->law] : loss_[touch.obstacle];
}

bool Bounces::before(const Step& step, ContactLosses& losses) {
  if (!contacts_.has_damping()) return false;
  starts_before_ = starts_;
  v_before_.assign(step.v.begin(), step.v.end());
  find_touches(step);
  match_starts(Side::before, step);
  for (std::size_t k = 0; k < starts_.size(); ++k) starts_[k].depth = touches_[k].depth;
  return damp(Side::before, step, losses);
}

bool Bounces::after(const Step& step, ContactLosses& losses) {
  if (!contacts_.has_damping()) return false;
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

/// Fills the touches, and for each a start that only names it.
void Bounces::find_touches(const Step& step) {
  earlier_.swap(starts_);
  starts_.clear();
  touches_.clear();
  step.near.for_each_touch({step.x}, [&](const Touch& found) {
    LossyTouch touch{found};
    touch.loss = loss_of(found);
    if (touch.loss == 0.0) return;
    touch.site = contacts_.normal_site(found);
    if (touch.site.mobility(step.inverse_mass, step.held) == 0.0) return;
    // 0 where the normal is along held axes; it may turn while they touch
    touch.mobility = touch.site.mobility_along(touch.normal, step.inverse_mass, step.held);
    if (found.in_body == nullptr)
      touch.carried = contacts_.obstacles->obstacles()[found.obstacle].velocity_at(step.time).dot(touch.normal);
    touches_.push_back(touch);
    starts_.push_back({.sample = found.sample, .obstacle = found.obstacle});
  });
}

std::array<std::uint32_t, 4> Bounces::whole_nodes(const SkinSample& sample) const {
  std::array<std::uint32_t, 4> nodes = sample.nodes;
  if (!vertices_.empty())
    for (std::uint32_t k = 0; k < sample.count; ++k) nodes[k] = vertices_[nodes[k]];
  return nodes;
}

const SkinSample* Bounces::sample_of(const Start& start) const {
  const std::vector<SkinSample>& samples = contacts_.samples(start.is_of_bodies());
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
  for (const bool of_bodies : {false, true}) {
    const std::vector<SkinSample>& samples = contacts_.samples(of_bodies);
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
      const auto nodes = whole_nodes(samples[k]);
      auto old = std::ranges::lower_bound(earlier_, nodes, {}, &Start::nodes);
      for (; old != earlier_.end() && old->nodes == nodes; ++old) {
        if (old->is_of_bodies() != of_bodies) continue;
        found.push_back(*old);
        found.back().sample = k;
      }
    }
  }
  std::ranges::sort(found, {}, &Start::order);
  earlier_ = std::move(found);
}

/// The first rate of a touch that has not been there before.
double Bounces::first_rate(const LossyTouch& touch, Side side, const Step& step) const {
  const double rate = touch.rate(step.v), earlier = side == Side::after ? touch.rate(v_before_) : 0.0;
  if (side == Side::after && rate + earlier > 0.0)  // back to the moment at which it met the surface
    return rate + std::min(1.0, 2.0 * touch.depth / (step.h * (rate + earlier))) * (earlier - rate);
  return std::sqrt(rate * rate + 2.0 * touch.law->energy(touch.area, touch.depth) * touch.mobility);
}

/// The start of a sample that was in another of the blocks that this obstacle is joined with; null if there is no such.
const Bounces::Start* Bounces::passed_on(const std::vector<Start>& among, std::uint32_t sample,
                                         std::uint32_t obstacle) const {
  if (obstacle == Touch::body) return nullptr;
  const Start first{.sample = sample};
  auto old = std::ranges::lower_bound(among, first.order(), {}, &Start::order);
  for (; old != among.end() && old->sample == sample && !old->is_of_bodies(); ++old)
    if (contacts_.obstacles->are_joined(old->obstacle, obstacle)) return &*old;
  return nullptr;
}

void Bounces::match_starts(Side side, const Step& step) {
  if (!starts_.empty()) find_samples();
  auto old = earlier_.begin();
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    Start& start = starts_[k];
    const LossyTouch& touch = touches_[k];
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
    const LossyTouch& t = touches_[place];
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

double Bounces::factor(const Touch& touch, double rate) const {
  const double loss = loss_of(touch);
  if (loss == 0.0) return 1.0;
  const Start named{.sample = touch.sample, .obstacle = touch.obstacle};
  const auto start = std::ranges::lower_bound(starts_, named.order(), {}, &Start::order);
  const bool is_known = start != starts_.end() && start->order() == named.order();
  const Start* const found = is_known ? &*start : passed_on(starts_, touch.sample, touch.obstacle);
  const double first = found != nullptr ? std::max(found->rate, std::abs(rate)) : std::abs(rate);
  return first > 0.0 ? std::max(0.0, 1.0 + loss * (rate / first)) : 1.0;
}

void Bounces::change_part(const Contacts& contacts, std::span<const std::uint32_t> vertices) {
  contacts_ = contacts;
  vertices_ = vertices;
}

std::size_t Bounces::bytes() const {
  return bytes_of(loss_, loss_of_bodies_, touches_, starts_, starts_before_, earlier_, v_before_);
}

}  // namespace dartboard
