#include "core/scene/run/motion_watch.h"

#include <fmt/format.h>

#include <cmath>

#include "core/scene/file/scene_file.h"
#include "core/time/system/energy.h"

namespace dartboard {
namespace {

// NaN and infinity fail the comparison with the speed of light.
std::optional<Fault> too_fast(std::span<const Eigen::Vector3d> velocity) {
  if (all_slower(velocity, speed_of_light)) return {};
  for (std::uint32_t k = 0; k < velocity.size(); ++k) {
    if (velocity[k].squaredNorm() <= speed_of_light * speed_of_light) continue;
    for (const double v : velocity[k])
      if (!std::isfinite(v)) return Fault{"velocity", k, v};
    return Fault{"speed", k, velocity[k].stableNorm()};
  }
  return {};
}

}  // namespace

bool all_slower(std::span<const Eigen::Vector3d> velocity, double speed) {
  return sum_of_squares(velocity) <= speed * speed;
}

Fault MotionWatch::fault_of(const StepResult& result, const SpringSystem& system, Motion motion) const {
  const StepResult found = detector_.with_witness(result, system, motion);
  return {fmt::format("{} ({})", found.quantity, to_string(found.code)), found.number, found.value};
}

std::optional<Fault> MotionWatch::fault_before(const SpringSystem& system, Motion motion) const {
  if (before_.ok()) return {};
  return fault_of(before_, system, motion);
}

std::optional<Fault> MotionWatch::after_step(StepResult result, std::uint64_t n, bool is_last, double work,
                                             const SpringSystem& system, Motion motion) {
  const std::uint64_t checks = detector_.checks();
  if (result.ok()) {
    checked_ = n;
    detector_.add_work(work);
    result = detector_.after_step(system, motion);
  }
  if (result.ok() && is_last) result = detector_.check_all(system, motion);
  if (!result.ok()) return fault_of(result, system, motion);
  // a speed above that of light is finite: it is checked whenever the energy is
  return detector_.checks() != checks ? too_fast(motion.v) : std::nullopt;
}

}  // namespace dartboard
