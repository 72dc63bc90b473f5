#include "core/scene/run/step_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/scene/body/contact_forecast.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {
namespace {

// More parts of a step than this are a mistake in a unit.
constexpr double most_parts = 1e6;

}  // namespace

std::string to_string(const StepWarning& w, double step, std::string_view integrator) {
  std::string text =
      fmt::format("{}: a step of {:.6g} s is too long for {}; {:.6g} s is stable",
                  w.step == 0 ? "at the start" : "after " + counted(w.step, "step"), step, integrator, w.stable);
  if (w.by_contact) text += " where contacts are as deep as is expected";
  if (w.parts > 1) text += fmt::format(", so each is taken in {} parts", w.parts);
  return text;
}

StepGuard::StepGuard(const SceneFile& scene, double step)
    : step_(step), treatment_(scene.unstable_step), horizon_(horizon_of(scene.duration)) {}

double StepGuard::rate_of_contact(const SimulatedBody& body) const {
  return contact_rate(body.system(), body.contacts(), contact_share_);
}

// The memory of the close estimate is freed: it is made at the start and after events only.
StableStep StepGuard::close_limits(const SimulatedBody& body) const {
  const StableStep limits = StableStepEstimate().refresh(body.system(), body.vertices().position);
  return body.contacts().any() ? with_contact(limits, rate_of_contact(body)) : limits;
}

StepLimit StepGuard::limit(const SimulatedBody& body, const Scheme& scheme) const {
  return close_limits(body).limit(scheme, horizon_);
}

void StepGuard::examine(const SimulatedBody& body, const Scheme& scheme, std::uint64_t n) {
  limits_ = quick_stable_step(body.system());
  too_long_ = false;
  parts_ = 1;
  if (limits_.is_stable(scheme, step_, horizon_)) return;
  limits_ = close_limits(body);
  if (limits_.is_stable(scheme, step_, horizon_)) return;
  stable_ = limits_.safe_step(scheme, horizon_);
  too_long_ = true;
  if (treatment_ == UnstableStep::substep) {
    parts_wanted_ = std::ceil(step_ / stable_);
    too_long_ = !(parts_wanted_ <= most_parts);
    if (!too_long_) parts_ = static_cast<std::uint64_t>(parts_wanted_);
  }
  if (warning_) return;
  // contact limits the step if it contributes more than half of the squares that add up to that of the highest
  // frequency, and damping does not halve the step
  const double rate = rate_of_contact(body);
  const bool by_contact = rate * rate > 0.5 * limits_.upper * limits_.upper &&
                          limits_.undamped().safe_step(scheme, horizon_) < 2.0 * stable_;
  warning_ = StepWarning{n, stable_, parts_, by_contact};
}

std::optional<StepRefusal> StepGuard::refusal(const Scheme& scheme, std::uint64_t n, double time) const {
  if (!too_long_ || treatment_ == UnstableStep::warn) return {};
  StepRefusal refusal{n + 1, time, fmt::format("a step of {:.6g} s is too long for {}", step_, scheme.name), stable_};
  if (treatment_ == UnstableStep::substep)
    refusal.why += fmt::format(" and would be divided into {:.3g} parts, more than {:.0f}", parts_wanted_, most_parts);
  return refusal;
}

double StepGuard::parts_of(double piece) const {
  const auto parts = static_cast<double>(parts_);
  return piece == step_ ? parts : std::max(1.0, std::ceil(parts * (piece / step_) * (1.0 - 0x1p-50)));
}

}  // namespace dartboard
