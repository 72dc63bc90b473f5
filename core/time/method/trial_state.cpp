#include "core/time/method/trial_state.h"

#include <algorithm>
#include <cmath>

namespace dartboard {
namespace {

// 0 * x is 0 for every finite x and NaN for all others, and sums keep that; a maximum would not. There are eight
// independent partial sums, so that no addition waits for the one before.
bool all_finite(std::span<const Eigen::Vector3d> column) {
  using Eight = Eigen::Array<double, 8, 1>;
  const double* data = column.data()->data();
  const std::size_t size = 3 * column.size();
  Eight sum = Eight::Zero();
  std::size_t i = 0;
  for (; i + 8 <= size; i += 8) sum += 0.0 * Eigen::Map<const Eight>(data + i);
  double rest = sum.sum();
  for (; i < size; ++i) rest += 0.0 * data[i];
  return rest == 0.0;
}

}  // namespace

StepResult check_finite(std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v) {
  if (x.empty() || (all_finite(x) && all_finite(v))) return {};
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const auto* column : {&x, &v})
      for (const double value : (*column)[i])
        if (!std::isfinite(value))
          return {StepCode::nonfinite, Witness::vertex, static_cast<std::uint32_t>(i),
                  column == &x ? "position" : "velocity", value};
  return {};
}

StepResult TrialState::commit(Motion motion, WorkCounters& work) const {
  const StepResult result = check_finite(x, v);
  if (!result.ok()) {
    ++work.failed_steps;
    return result;
  }
  std::ranges::copy(x, motion.x.begin());
  std::ranges::copy(v, motion.v.begin());
  ++work.steps;
  return result;
}

}  // namespace dartboard
