#include "reference/schemes/step_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/plain/random.h"
#include "reference/schemes/rounding.h"

namespace dartboard::reference {
namespace {

// Numbers by axis, for positions and then for velocities.
using Sizes = std::array<Extended, 6>;

template <class F>
Sizes largest(std::size_t count, F&& number) {
  Sizes sizes{};
  for (std::size_t c = 0; c < count; ++c) {
    Extended& size = sizes[c % 3 + (c < count / 2 ? 0 : 3)];
    size = max_or_nan(size, std::abs(number(c)));
  }
  return sizes;
}

Sizes distance(const std::vector<Extended>& a, const std::vector<Extended>& b) {
  return largest(a.size(), [&](std::size_t c) { return a[c] - b[c]; });
}

// The state displaced by a rounding of its positions, of its velocities, and of the contributions of forces to these.
std::vector<Extended> disturbed(const SpringNetwork& network, const std::vector<Extended>& y, Extended h,
                                SplitMix64& random) {
  const std::size_t n = network.point_count();
  std::vector<Extended> kick(n, 0);
  for (const Spring& s : network.springs) {
    const Extended length = (three(y, s.b) - three(y, s.a)).norm();
    const Extended apart = (three(y, n + s.b) - three(y, n + s.a)).norm();
    for (const auto i : {s.a, s.b})
      if (!network.fixed[i])
        kick[i] += std::abs(h) / network.mass[i] *
                   (std::abs(Extended(s.stiffness)) * (length + std::abs(Extended(s.rest_length))) +
                    std::abs(Extended(s.damping)) * apart);
  }
  for (const ElasticPoint& point : network.elements)
    for_each_size(point, y.data(), 0, [&](std::uint32_t i, Extended size) {
      if (!network.fixed[i]) kick[i] += std::abs(h) / network.mass[i] * size;
    });
  const std::vector<Extended> speeds(y.begin() + static_cast<std::ptrdiff_t>(3 * n), y.end());
  Extended fastest = 0;
  for (const Extended speed : speeds) fastest = max_or_nan(fastest, std::abs(speed));
  for (const ElasticPoint& point : network.elements)
    for_each_damping_size(point, y.data(), 0, 2 * fastest, [&](std::uint32_t i, Extended size) {
      if (!network.fixed[i]) kick[i] += std::abs(h) / network.mass[i] * size;
    });
  const Sizes sizes = largest(y.size(), [&](std::size_t c) { return y[c]; });
  std::vector<Extended> result = y;
  for (std::size_t c = 0; c < y.size(); ++c) {
    const std::size_t point = c / 3 % n;
    const bool velocity = c >= 3 * n;
    if (velocity && network.fixed[point]) continue;
    const Extended size = sizes[c % 3 + (velocity ? 3 : 0)] + (velocity ? kick[point] : 0);
    result[c] += epsilon * size * Extended(random.next_signed());
  }
  return result;
}

}  // namespace

StepJudgement compare_step(const SpringNetwork& network, const TakenStep& step,
                           const std::function<void(std::vector<Extended>&)>& witness,
                           const std::vector<std::vector<Extended>>& others, const std::array<Extended, 2>& solver) {
  const std::vector<Extended> start = vector_of<Extended>(step.before), end = vector_of<Extended>(step.after);
  std::vector<Extended> truth = start;
  witness(truth);
  Sizes spread{};
  const auto widen = [&](const std::vector<Extended>& other) {
    const Sizes moved = distance(other, truth);
    for (std::size_t k = 0; k < 6; ++k) spread[k] = max_or_nan(spread[k], moved[k]);
  };
  SplitMix64 random(1);
  for (int run = 0; run < 3; ++run) {
    std::vector<Extended> y = disturbed(network, start, step.h, random);
    witness(y);
    widen(y);
  }
  std::ranges::for_each(others, widen);

  const Sizes off = distance(end, truth), idle = distance(start, truth);
  const Sizes size = largest(truth.size(), [&](std::size_t c) { return truth[c]; });
  StepJudgement judgement;
  for (std::size_t k = 0; k < 6; ++k) {
    const Extended bound =
        30 * spread[k] + epsilon * size[k] + solver[k / 3] + 4 * Extended(std::numeric_limits<double>::denorm_min());
    if (!std::isfinite(bound)) return {};  // the method itself overflows: no judgement is possible
    const auto ratio = [&](Extended d) { return static_cast<double>(d / bound); };
    judgement.excess = max_or_nan(judgement.excess, ratio(off[k]));
    judgement.idle = max_or_nan(judgement.idle, ratio(idle[k]));
    judgement.nudged = max_or_nan(judgement.nudged, ratio(1e-6L * size[k]));
  }
  return judgement;
}

}  // namespace dartboard::reference
