#include "validation/recommend/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "validation/recommend/candidate_pilots.h"
#include "validation/scenes/order_limit.h"
#include "validation/solvers/break_even.h"

namespace dartboard {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// The fewest force evaluations that an implicit step has been seen to cost.
constexpr double least_implicit_step = 10.0;
// The force evaluations that a stage of a splitting costs where it sweeps through dampers.
constexpr double swept_stage = 3.0;
// The law uses the motion at the start only: it has to be wrong by this factor before a method is lost to it.
constexpr double doubt = 4.0;
// The part of the least time for pilots that explicit methods leave to implicit ones.
constexpr double for_implicit = 0.25;
// RecommendOptions::pilot_part and most_pilot_s where pilots are whole runs.
constexpr double part_of_whole_pilots = 10.0, most_whole_pilot_s = 600.0;

void rank(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.usable() != b.usable()) return a.usable();
    if (a.usable() && a.adaptive != b.adaptive) return b.adaptive;
    return a.usable() && a.predicted_cost < b.predicted_cost;
  });
}

/// Explicit methods before implicit ones, high orders before low ones: the later ones must cost less. Where nothing is
/// damped the symplectic method of order 4 comes before all. A compensated method equals the plain one until rounding
/// shows, at a higher cost: the list has either the plain ones or the compensated ones.
std::vector<Scheme> schemes_in_order(bool damped, const std::string& only, bool compensated = false) {
  std::vector<Scheme> schemes;
  for (const IntegratorEntry& entry : integrators())
    if (const Scheme& scheme = entry.make()->scheme();
        only.empty() ? scheme.compensated == compensated : entry.name == only)
      schemes.push_back(scheme);
  const auto rank = [damped](const Scheme& s) {
    return (s.implicit ? 0.0 : 100.0) + s.order + (s.symplectic && !damped && s.order > 2 ? 2.0 : 0.0);
  };
  std::stable_sort(schemes.begin(), schemes.end(), [&](const Scheme& a, const Scheme& b) { return rank(a) > rank(b); });
  return schemes;
}

/// One search, from the features to the ranking.
class Search {
 public:
  Search(const TradeoffScene& scene, double error, const CpuClock& clock, const RecommendOptions& options)
      : scene_(scene), error_(error), clock_(clock), options_(options), start_(clock()) {
    r_.scene = scene.name;
    r_.error = error;
    r_.best_error = std::numeric_limits<double>::quiet_NaN();
    r_.features =
        options.budget_s > 0.0
            ? features_of(scene, clock, static_cast<std::int64_t>(std::clamp(5e6 * options.budget_s, 5e4, 1e6)))
            : features_of(scene, clock);
    for (const IntegratorEntry& entry : integrators())
      least_error_ = std::min(least_error_, rounding_floor(scene, entry.make()->scheme()).at(per_interval()));
    pilots_.emplace(scene, clock, options, start_);
  }

  Recommendation run() {
    auto schemes = schemes_in_order(r_.features.damping_ratio > 0.0, options_.only);
    std::erase_if(schemes, [this](const Scheme& s) { return !takes(scene_, s.name); });
    // an order that contact or loads do not leave is not worth its stages
    if (limit_.most < 3.0) std::ranges::stable_sort(schemes, {}, &Scheme::stages);
    // where there may be no time for all, the cheapest by the law come first; for motions that last, the law is a worse
    // guide than their symplectic method
    if (options_.budget_s > 0.0 && r_.features.damping_ratio > 0.0)
      std::ranges::stable_sort(schemes, {}, [this](const Scheme& s) { return expected_s(s); });
    for (const Scheme& scheme : schemes) {
      if (scheme.implicit) continue;
      const bool first = r_.candidates.empty();
      try_explicit(scheme);
      for (const Scheme& other : schemes)
        if (first && other.implicit && is_promising(other)) try_implicit(other);
    }
    if (options_.adaptive && scene_.equal_steps().empty())
      for (const Scheme& scheme : schemes)
        if (dynamic_cast<AdaptiveIntegrator*>(make_integrator(scheme.name).get()) != nullptr) try_adaptive(scheme);
    for (const Scheme& scheme : schemes)
      if (scheme.implicit &&
          std::ranges::find(r_.candidates, scheme.name, &Candidate::contender) == r_.candidates.end())
        try_implicit(scheme);
    rank(r_.candidates);
    confirm();
    if (r_.pick() == nullptr && options_.only.empty() && std::ranges::any_of(r_.candidates, kept_by_rounding)) {
      for (const Scheme& scheme : schemes_in_order(r_.features.damping_ratio > 0.0, "", true))
        try_explicit(scheme, true);
      rank(r_.candidates);
      confirm();
    }
    time_the_best();
    look_around();
    for (const Candidate& c : r_.candidates)
      if (r_.pick() == nullptr && kept_by_rounding(c) && !(c.least_error >= r_.best_error)) {
        r_.best_error = c.least_error;
        r_.best_error_by = c.contender;
      }
    r_.pilot_s = pilots_->spent_s();
    return std::move(r_);
  }

 private:
  Candidate begin(const Scheme& scheme) const {
    Candidate c;
    c.contender = scheme.name;
    c.implicit = scheme.implicit;
    c.order = std::max(1, static_cast<int>(limit_.of(scheme)));
    c.rounding = rounding_floor(scene_, scheme);
    return c;
  }
  void solve(Candidate& c) {
    solve_for_error(c, error_, scene_.motion, r_.features.force_s, options_);
    if (!c.usable() && !kept_by_rounding(c)) return;  // too many steps
    if (!std::isfinite(c.predicted_s))
      c.pruned = "its pilots say nothing about its errors";
    else if (!c.adaptive)  // one that chooses its steps is no pick, which others would have to be cheaper than
      pilots_->predicted(c.predicted_s);
  }
  /// [s] The time that explicit methods leave to implicit ones; of a budget, all leave some to longer pilots.
  double left_for_others(bool implicit) const {
    if (options_.budget_s > 0.0) return pilots_->cheapest_s() < infinity ? options_.kept_back * options_.budget_s : 0.0;
    return implicit ? 0.0 : for_implicit * options_.pilot_floor_s;
  }
  bool has_time(Candidate& c) const {
    // where dampers are swept, the stable step of many stages takes a long look at amplification factors
    constexpr double long_look_s = 0.1;
    const Scheme& scheme = scheme_of(c.contender);
    const bool long_look =
        options_.budget_s > 0.0 && scheme.symplectic && scheme.stages > 1 && r_.features.damping_ratio > 0.0;
    if (pilots_->left_s() > left_for_others(c.implicit) + (long_look ? long_look_s : 0.0)) return true;
    c.untried = true;
    c.pruned = "the time for pilots is up";
    return false;
  }
  void pilot(Candidate& c, double h, double step_s) {
    if (!(h > 1e-4 / r_.features.omega_low))
      c.pruned = "no stable step of a useful size";
    else if (!scene_.equal_steps().empty())
      pilot_whole(c, *pilots_, h, sought());
    else
      pilot_prefix(c, *pilots_, h, step_s, sought());
    if (c.usable()) solve(c);
  }

  /// [s] The time of a run by the law, or by stability without damping.
  double expected_s(const Scheme& scheme) const {
    const double needed = steps_for_error(r_.features, scheme.order, scene_.duration, sought());
    if (scheme.implicit) return needed * scheme.stages * least_implicit_step * r_.features.force_s;
    // dampers are swept through in every stage of a splitting
    const double stage = scheme.symplectic && r_.features.damping_ratio > 0.0 ? swept_stage : 1.0;
    return std::max(needed, r_.features.phase / scheme.imaginary_limit) * scheme.stages * stage * r_.features.force_s;
  }

  /// A last resort has no cheaper method to be compared with: those so far do not meet the error.
  void try_explicit(const Scheme& scheme, bool last_resort = false) {
    Candidate c = begin(scheme);
    const double step_s = scheme.stages * r_.features.force_s;
    const double needed = steps_for_error(r_.features, scheme.order, scene_.duration, sought());
    if (!last_resort && needed * step_s > doubt * pilots_->cheapest_s())
      c.pruned = law(needed, step_s);
    else if (has_time(c))  // the limit alone may take as long as a pilot
      c.limit_h = stability_limit(scheme, r_.features, scene_.duration);
    const double least_s = c.usable() ? scene_.duration / c.limit_h * step_s : 0.0;
    if (!last_resort && least_s > 1.2 * pilots_->cheapest_s())
      c.pruned = fmt::format("its largest stable step takes {:.1e} s in all, against {:.1e} s", least_s,
                             pilots_->cheapest_s());
    else if (c.usable())
      // the longest step that could be recommended is tried: close to the limit errors grow faster than by any order
      pilot(c, std::min({options_.stability * c.limit_h, per_interval(), 2.7 / r_.features.omega_low}), step_s);
    r_.candidates.push_back(std::move(c));
  }

  /// Does the law, wrong as it may be, predict less time for an implicit method than for the best method so far? It
  /// says nothing about a motion that starts at rest.
  bool is_promising(const Scheme& scheme) const {
    if (!(r_.features.motion_size > 0.0)) return false;
    const double step_s = std::max(r_.features.implicit_step_s, least_implicit_step * r_.features.force_s);
    const double needed = std::max(steps_for_error(r_.features, scheme.order, scene_.duration, sought()),
                                   static_cast<double>(scene_.motion.checkpoints.size()));
    return doubt * needed * scheme.stages * step_s < pilots_->cheapest_s();
  }

  void try_implicit(const Scheme& scheme) {
    Candidate c = begin(scheme);
    const double needed = steps_for_error(r_.features, scheme.order, scene_.duration, sought());
    double& measured_s = r_.features.implicit_step_s;
    double step_s = scheme.stages * (measured_s > 0.0 ? measured_s : least_implicit_step * r_.features.force_s);
    if (measured_s == 0.0 && needed * step_s <= doubt * pilots_->cheapest_s()) {
      const auto steps = std::max(needed, static_cast<double>(scene_.motion.checkpoints.size()));
      measured_s = implicit_step_seconds(scene_, scene_.duration / steps, clock_);
      step_s = scheme.stages * measured_s;
    }
    if (!(needed * step_s <= doubt * pilots_->cheapest_s()))
      c.pruned = law(needed, step_s);
    else if (has_time(c))
      c.limit_h = stability_limit(scheme, r_.features, scene_.duration);
    if (c.usable()) pilot(c, std::min(per_interval(), 4.0 * scene_.duration / needed), step_s);
    r_.candidates.push_back(std::move(c));
  }

  /// A method that chooses its steps has little to win where fixed steps of the same method are far from the best.
  void try_adaptive(const Scheme& scheme) {
    constexpr double hope = 3.0;
    Candidate c = begin(scheme);
    c.contender = fmt::format("{}-adaptive", scheme.name);
    c.adaptive = true;
    c.limit_h = infinity;
    const auto fixed = std::ranges::find(r_.candidates, scheme.name, &Candidate::contender);
    if (!fixed->usable())
      c.pruned = fmt::format("as with fixed steps: {}", fixed->pruned);
    else if (fixed->predicted_s > hope * pilots_->cheapest_s())
      c.pruned =
          fmt::format("with fixed steps it costs {:.1f} times the best", fixed->predicted_s / pilots_->cheapest_s());
    else if (1.5 * fixed->predicted_s > pilots_->left_s()) {
      c.untried = true;
      c.pruned = "its pilots would take too long";
    } else
      pilot_tolerances(c, *pilots_, sought());
    if (c.usable()) solve(c);
    r_.candidates.push_back(std::move(c));
  }

  /// Run longer pilots of the best two, as long as they can be afforded.
  void confirm() {
    if (!scene_.equal_steps().empty()) return;  // its pilots are as long as they can be
    std::vector<std::string> tried;
    for (int round = 0; round < 12; ++round) {
      Candidate* next = nullptr;
      for (std::size_t k = 0; k < std::min<std::size_t>(2, r_.candidates.size()); ++k) {
        Candidate& c = r_.candidates[k];
        if (!c.usable() || c.adaptive || std::ranges::find(tried, c.contender) != tried.end()) continue;
        if (k > 0 && c.predicted_cost > 2.0 * r_.candidates[0].predicted_cost) continue;
        next = &c;
        break;
      }
      if (next == nullptr) break;
      const Longer outcome = pilot_longer(*next, *pilots_);
      if (outcome != Longer::unstable) tried.push_back(next->contender);
      if (outcome != Longer::skipped) solve(*next);
      rank(r_.candidates);
    }
  }

  /// Time the best two again: their pilots were timed only once each, in passing.
  void time_the_best() {
    if (scene_.has_contact()) return;  // steps take longer while bodies touch
    for (std::size_t k = 0; k < std::min<std::size_t>(2, r_.candidates.size()); ++k) {
      Candidate& c = r_.candidates[k];
      if (!c.usable() || c.adaptive || c.implicit || c.predicted_cost > 1.5 * r_.candidates[0].predicted_cost) continue;
      c.step_cost = pilots_->step_cost(c);
      solve(c);
    }
    rank(r_.candidates);
  }

  /// The cost of one more digit, and the error in real time.
  void look_around() {
    const Candidate* pick = r_.pick();
    if (pick == nullptr) return;
    r_.realtime_factor = scene_.duration / pick->predicted_s;
    const RealTime realtime = best_in_real_time(r_.candidates, r_.features.force_s, options_.stability);
    r_.realtime_error = realtime.error;
    r_.realtime_by = realtime.by;
    double best = infinity;
    for (const Candidate& candidate : r_.candidates) {
      if (!candidate.usable()) continue;
      Candidate c = candidate;
      if (c.confidence == Confidence::sufficient) c.slope = c.order;  // no order was seen: that of the method
      solve_for_error(c, error_ / 10.0, scene_.motion, r_.features.force_s, options_);
      if (c.usable() && c.predicted_s < best) {
        best = c.predicted_s;
        r_.one_more_digit_by = c.contender;
      }
    }
    r_.one_more_digit = best / pick->predicted_s;
  }

  static bool kept_by_rounding(const Candidate& c) { return c.least_error > 0.0; }
  /// The error that pilots and the law aim at: rounding must leave room for it.
  double sought() const { return std::max(error_, least_error_); }
  double per_interval() const { return scene_.duration / static_cast<double>(scene_.motion.checkpoints.size()); }
  std::string law(double needed, double step_s) const {
    return fmt::format("break-even law: about {:.2g} steps of {:.1e} s, {:.1e} s against {:.1e} s", needed, step_s,
                       needed * step_s, pilots_->cheapest_s());
  }

  const TradeoffScene& scene_;
  const OrderLimit limit_ = order_limit(scene_);
  double error_, least_error_ = infinity;  // asked for; what rounding leaves after the fewest steps
  const CpuClock& clock_;
  const RecommendOptions& options_;
  std::int64_t start_;
  std::optional<Pilots> pilots_;
  Recommendation r_;
};

}  // namespace

const Candidate* Recommendation::pick() const {
  return !candidates.empty() && candidates[0].usable() && !candidates[0].adaptive ? &candidates[0] : nullptr;
}
const Candidate* Recommendation::cheaper_by_tolerance() const {
  const auto found = std::ranges::find_if(candidates, [](const Candidate& c) { return c.usable() && c.adaptive; });
  const bool is_cheaper =
      found != candidates.end() && pick() != nullptr && found->predicted_cost < pick()->predicted_cost;
  return is_cheaper ? &*found : nullptr;
}
const Candidate* Recommendation::runner_up() const {
  return candidates.size() > 1 && candidates[1].usable() && !candidates[1].adaptive ? &candidates[1] : nullptr;
}

std::vector<std::string> Recommendation::untried() const {
  std::vector<std::string> names;
  for (const Candidate& c : candidates)
    if (c.untried) names.push_back(c.contender);
  return names;
}

Recommendation recommend(const TradeoffScene& scene, double error, const CpuClock& clock,
                         const RecommendOptions& options) {
  if (!(error > 0.0)) throw InputError("the requested error must be positive");
  RecommendOptions allowed = options;
  if (!scene.equal_steps().empty()) {
    allowed.pilot_part = part_of_whole_pilots;
    allowed.most_pilot_s = most_whole_pilot_s;
  }
  return Search(scene, error, clock, allowed).run();
}

}  // namespace dartboard
