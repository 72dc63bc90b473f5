#include "validation/elements/bar_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/time/integrators.h"
#include "core/time/method/step_limit.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::uint64_t most_steps = 1'000'000;  // of a period: methods that need more are dropped

std::uint64_t in_beats(double steps) {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(steps / Beats::count))) * Beats::count;
}

/// 16, 24, 32, 48 ...: powers of two and half as many again; others grow by a half.
std::uint64_t more(std::uint64_t steps) {
  const std::uint64_t beats = steps / Beats::count;
  if (beats >= 3 && beats % 3 == 0 && ((beats / 3) & (beats / 3 - 1)) == 0) return steps / 3 * 4;
  return in_beats(1.5 * static_cast<double>(steps));
}

/// A method with its next number of steps.
struct Offer {
  std::string integrator;
  std::uint64_t steps;
  double price;  // [ns] of a period
};

/// The price of a step, from a few that follow two others, which do the work that is done once.
std::optional<double> price_of_step(BentBar& bar, const std::string& name, double h,
                                    const std::function<std::int64_t()>& clock) {
  const auto integrator = make_integrator(name);
  bar.restore();
  for (int k = 0; k < 2; ++k)
    if (!bar.step(*integrator, h).ok()) return {};
  const std::int64_t start = clock();
  int taken = 0;
  for (; taken < 64 && (taken < 4 || clock() - start < 2'000'000); ++taken)
    if (!bar.step(*integrator, h).ok()) return {};
  return static_cast<double>(clock() - start) / taken;
}

}  // namespace

BentBar::BentBar(const ClampedBar& bar, std::unique_ptr<SimulatedBody> body, const VectorXd& bent)
    : body_(std::move(body)) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k + 2 < bent.size(); k += 3) largest = std::max(largest, bent.segment<3>(k).norm());
  scale_ = bend * bar.length() / largest;
  const auto x = body_->motion().x;
  rest_.assign(x.begin(), x.end());
  start_ = rest_;
  for (std::size_t i = 0; i < start_.size(); ++i)
    start_[i] += scale_ * bent.segment<3>(static_cast<Eigen::Index>(3 * i));
  restore();
}

BentBar::BentBar(const ClampedBar& bar, std::unique_ptr<SimulatedBody> body) : body_(std::move(body)) {
  const auto x = body_->motion().x;
  rest_.assign(x.begin(), x.end());
  start_ = rest_;
  for (Vector3d& p : start_) p[2] += bend * p[0] * p[0] / bar.length();
  restore();
}

void BentBar::restore() {
  const Motion motion = body_->motion();
  std::ranges::copy(start_, motion.x.begin());
  std::ranges::fill(motion.v, Vector3d::Zero());
}

BentBar::Run BentBar::follow(Integrator& integrator, std::uint64_t steps, const Beats& beats,
                             std::span<const std::uint32_t> watched) {
  restore();
  integrator.restart();
  const double h = beats.period / static_cast<double>(steps);
  Run run{{}, WatchedMotion(static_cast<Eigen::Index>(3 * watched.size()), Beats::count)};
  for (int beat = 0; beat < Beats::count; ++beat) {
    for (std::uint64_t k = 0; k < steps / Beats::count; ++k) {
      run.result = step(integrator, h);
      if (!run.result.ok()) return {run.result, {}};
    }
    const auto x = body_->motion().x;
    for (std::size_t i = 0; i < watched.size(); ++i)
      run.motion.block<3, 1>(static_cast<Eigen::Index>(3 * i), beat) = (x[watched[i]] - rest_[watched[i]]) / scale_;
  }
  return run;
}

std::vector<BarMethod> bar_methods(BentBar& bar, const Beats& beats) {
  std::vector<BarMethod> methods;
  bar.restore();
  const StableStep limits = StableStepEstimate().refresh(bar.body().system(), bar.body().vertices().position);
  for (const char* name : {"symplectic-euler", "verlet", "blanes-moan-4", "rk4"}) {
    const double longest = limits.safe_step(scheme_of(name), horizon_of(beats.period));
    methods.push_back({name, in_beats(beats.period / longest)});
  }
  for (const char* name : {"implicit-midpoint", "ros2"}) methods.push_back({name, Beats::count});
  return methods;
}

BestMethod best_method(BentBar& bar, const Beats& beats, std::span<const std::uint32_t> watched,
                       const WatchedMotion& exact, const WatchedMotion& truth, double allowed,
                       std::span<const BarMethod> methods, const std::function<std::int64_t()>& clock) {
  BestMethod best;
  std::vector<Offer> offers;
  const auto offer = [&](const std::string& name, std::uint64_t steps) {
    if (steps > most_steps) return;
    const auto price = price_of_step(bar, name, beats.period / static_cast<double>(steps), clock);
    if (price) offers.push_back({name, steps, *price * static_cast<double>(steps)});
  };
  for (const BarMethod& method : methods) offer(method.integrator, method.fewest_steps);
  while (!offers.empty()) {
    const auto cheapest = std::ranges::min_element(offers, {}, &Offer::price);
    const Offer next = *cheapest;
    offers.erase(cheapest);
    const auto integrator = make_integrator(next.integrator);
    const BentBar::Run run = bar.follow(*integrator, next.steps, beats, watched);
    ++best.followed;
    if (run.result.ok()) {
      best.error = motion_error(run.motion, exact);
      best.total_error = motion_error(run.motion, truth);
      if (best.error <= allowed) {
        best.integrator = next.integrator;
        best.steps = next.steps;
        best.step_ns = next.price / static_cast<double>(next.steps);
        return best;
      }
    }
    offer(next.integrator, more(next.steps));
  }
  return best;
}

}  // namespace dartboard
