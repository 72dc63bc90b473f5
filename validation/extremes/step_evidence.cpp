#include "validation/extremes/step_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"
#include "reference/ode_intervals.h"

namespace dartboard {

std::optional<reference::SpringNetwork> network_of(const SpringSystem& system, KnownElements elements) {
  if (!system.held_axes.empty() || (!system.terms.empty() && elements == nullptr)) return {};
  const std::size_t n = system.vertex_count();
  reference::SpringNetwork network;
  network.gravity = system.gravity;
  network.pull.assign(system.pull.begin(), system.pull.end());
  if (elements != nullptr) network.elements = *elements;
  bool known = false;
  for (std::size_t i = 0; i < n; ++i) {
    const bool fixed = system.fixed[i] != 0;
    network.fixed.push_back(fixed);
    network.mass.push_back(fixed ? 1.0 : system.mass[i]);  // the mass of a fixed vertex is never used
    if (fixed) continue;
    const double rate = system.viscosity[i] / system.mass[i];
    if (known && !(std::abs(rate - network.viscosity) <= 1e-14 * network.viscosity)) return {};
    if (!known) network.viscosity = rate;
    known = true;
  }
  for (std::size_t e = 0; e < system.springs.size(); ++e) {
    const Spring s = system.springs[e];
    network.springs.push_back({system.ends[e][0], system.ends[e][1], s.stiffness, s.damping, s.rest_length});
  }
  try {
    reference::check(network);
  } catch (const InputError&) {
    return {};
  }
  return network;
}

StepEvidence::StepEvidence(std::string_view integrator, std::uint64_t steps, KnownElements elements, JudgedSteps judged)
    : scheme_(integrator),
      elements_(elements),
      first_(judged.first),
      stride_(std::max<std::uint64_t>(reference::is_costly_to_judge(integrator) ? 5 : 1, steps / judged.most)) {}

void StepEvidence::restarted() {
  changed_ = true;
  step_.earlier = {};
}

void StepEvidence::before(const SpringSystem& system, Motion motion, double h) {
  const double start = reference::thread_cpu_seconds();
  if (changed_) {
    judge_.reset();
    if (const auto network = network_of(system, elements_))
      judge_ = std::make_unique<reference::StepJudge>(scheme_, *network);
    changed_ = false;
  }
  asks_ = judge_ != nullptr && (count_ < first_ || count_ % stride_ == 0);
  if (judge_ != nullptr) {
    step_.h = h;
    step_.before.x.assign(motion.x.begin(), motion.x.end());
    step_.before.v.assign(motion.v.begin(), motion.v.end());
  }
  seconds_ += reference::thread_cpu_seconds() - start;
}

void StepEvidence::after(Motion motion) {
  const double start = reference::thread_cpu_seconds();
  if (asks_) {
    step_.after.x.assign(motion.x.begin(), motion.x.end());
    step_.after.v.assign(motion.v.begin(), motion.v.end());
    const reference::StepJudgement judgement = judge_->judge(step_);
    ++judged_;
    seeing_ += judgement.sees();
    if (!(judgement.excess <= worst_) && !std::isnan(worst_)) {  // NaN is not less
      worst_ = judgement.excess;
      worst_step_ = count_;
    }
  }
  if (judge_ != nullptr) step_.earlier = step_.before;
  ++count_;
  seconds_ += reference::thread_cpu_seconds() - start;
}

}  // namespace dartboard
