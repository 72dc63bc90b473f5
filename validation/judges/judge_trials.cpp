#include "validation/judges/judge_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/plain/nan_maximum.h"
#include "validation/order/discrete_exact.h"

namespace dartboard {
namespace {

std::vector<JudgeTrial> one_for_each_kind(std::string_view judge, std::string_view part) {
  std::vector<JudgeTrial> trials;
  for (const WrongIntegrator& wrong : wrong_integrators())
    trials.push_back({std::string(judge), std::string(part), wrong.kind});
  return trials;
}

bool is_right(const ExtremeCell& cell) {
  return cell.outcome == ExtremeOutcome::ok || cell.outcome == ExtremeOutcome::scheme;
}
bool is_seen(const ExtremeCell& cell) {
  return cell.outcome == ExtremeOutcome::silent || cell.outcome == ExtremeOutcome::diagnosed;
}

}  // namespace

bool same_but_for_rounding(const ExtremeCell& a, const ExtremeCell& b) {
  const std::size_t n = a.end.size();
  if (b.end.size() != n) return false;
  std::array<double, 2> largest{}, apart{};  // of positions, of velocities
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t part = k < n / 2 ? 0 : 1;
    largest[part] = max_or_nan(largest[part], std::abs(a.end[k]));
    apart[part] = max_or_nan(apart[part], std::abs(a.end[k] - b.end[k]));
  }
  const double roundings = std::numeric_limits<double>::epsilon() * static_cast<double>(a.step + 4);
  return apart[0] <= roundings * largest[0] && apart[1] <= roundings * largest[1];
}

void ExtremesTrial::take(const ExtremeCase& which) {
  const ExtremeCell sound = which.run();
  auto slack = std::ranges::find(slack_, which.integrator, &SchemeSlack::integrator);
  if (slack == slack_.end()) slack = slack_.insert(slack_.end(), {which.integrator});
  ++slack->runs;
  slack->worst = max_or_nan(slack->worst, sound.scheme_excess);
  if (std::ranges::find(trials_, which.axis, &JudgeTrial::part) == trials_.end())
    std::ranges::move(one_for_each_kind("extremes", which.axis), std::back_inserter(trials_));
  if (!is_right(sound)) return;
  for (JudgeTrial& trial : trials_) {
    if (trial.part != which.axis) continue;
    const ExtremeCell wrong = which.run([&trial](std::string_view name) { return make_wrong(trial.kind, name); });
    ++trial.right;
    if (is_seen(wrong)) {
      ++trial.seen;
      trial.by_scheme += wrong.outcome == ExtremeOutcome::silent && wrong.judged_by == JudgedBy::scheme;
    } else if (same_but_for_rounding(sound, wrong)) {
      ++trial.same;
    } else {
      trial.unseen.push_back(fmt::format("{}, {}, {}: {:.2g} of its bound", which.scene, which.integrator, which.value,
                                         wrong.scheme_excess));
    }
  }
}

std::vector<JudgeTrial> try_order(const OrderStage& stage, std::span<const IntegratorEntry> methods,
                                  const OrderOptions& options) {
  std::vector<JudgeTrial> trials = one_for_each_kind("order", name(stage.which));
  for (const IntegratorEntry& entry : methods) {
    const OrderStudy sound = study_order(stage, entry, options);
    if (!sound.holds) continue;
    for (JudgeTrial& trial : trials) {
      const OrderStudy wrong = study_order(stage, wrong_entry(trial.kind, entry.name), options);
      const auto same = [](const OrderPoint& a, const OrderPoint& b) {
        return a.errors.x == b.errors.x && a.errors.v == b.errors.v;
      };
      ++trial.right;
      if (!wrong.holds)
        ++trial.seen;
      else if (std::ranges::equal(wrong.points, sound.points, same))
        ++trial.same;
      else
        trial.unseen.push_back(fmt::format("{}: {:.2f}, {:.2f}", entry.name, wrong.p_x, wrong.p_v));
    }
  }
  return trials;
}

std::vector<JudgeTrial> try_exact_maps(double zeta, std::uint64_t steps) {
  constexpr double rounding = 1e-10;  // the gate of `validate order`
  const double steps_of_rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(steps);
  std::vector<JudgeTrial> trials = one_for_each_kind("exact maps", zeta > 0.0 ? "damped" : "undamped");
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.make()->scheme().amplification == nullptr) continue;
    const DiscreteExact sound = compare_with_discrete_map(entry, zeta, steps);
    if (!(sound.deviation <= rounding)) continue;
    for (JudgeTrial& trial : trials) {
      const DiscreteExact wrong = compare_with_discrete_map(wrong_entry(trial.kind, entry.name), zeta, steps);
      ++trial.right;
      if (!(wrong.deviation <= rounding) || !wrong.diagnosis.empty())
        ++trial.seen;
      else if (std::abs(wrong.deviation - sound.deviation) <= steps_of_rounding)
        ++trial.same;
      else
        trial.unseen.push_back(fmt::format("{}: {:.1e}", entry.name, wrong.deviation));
    }
  }
  return trials;
}

}  // namespace dartboard
