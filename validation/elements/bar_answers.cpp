#include "validation/elements/bar_answers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/plain/nan_maximum.h"
#include "reference/elements/held_factor.h"
#include "reference/elements/released_motion.h"

namespace dartboard {
namespace {

struct Asked {
  const LinearBar& bar;
  reference::HeldFactor factor;
  explicit Asked(const LinearBar& linear) : bar(linear), factor(linear.solid) {}

  BarAnswers statics_and_modes() const {
    BarAnswers a;
    a.nodes = static_cast<std::size_t>(bar.shear.size() / 3);
    a.bent = factor.displacements(bar.shear);
    a.work = bar.shear.dot(a.bent);
    std::ranges::copy(factor.frequencies(a.frequency.size()), a.frequency.begin());
    return a;
  }
  WatchedMotion motion(const Beats& beats) const {
    const reference::ReleasedMotion released(factor, bar.shear);
    WatchedMotion seen(static_cast<Eigen::Index>(3 * bar.watched.size()), Beats::count);
    for (int k = 0; k < Beats::count; ++k) {
      const Eigen::VectorXd u = released.displacements(beats.at(k));
      for (std::size_t i = 0; i < bar.watched.size(); ++i)
        seen.block<3, 1>(static_cast<Eigen::Index>(3 * i), k) =
            u.segment<3>(3 * static_cast<Eigen::Index>(bar.watched[i]));
    }
    return seen;
  }
};

}  // namespace

BarAnswers true_answers(const ClampedBar& bar, int finer, double poisson, Beats& beats) {
  const LinearBar linear = quadratic_bar(bar, finer, poisson);
  const Asked asked(linear);
  BarAnswers a = asked.statics_and_modes();
  a.confined = confined_modulus(bar.young, poisson);
  if (!(beats.period > 0.0)) beats.period = 2.0 * std::numbers::pi / a.frequency[0];
  a.motion = asked.motion(beats);
  return a;
}

BarAnswers model_answers(const ClampedBar& bar, const BarModel& model, int finer, const SimulatedBody& body,
                         const Beats& beats) {
  const LinearBar linear = linear_bar(bar, model, finer, body);
  const Asked asked(linear);
  BarAnswers a = asked.statics_and_modes();
  a.confined = confined_modulus_of(bar, body);
  a.motion = asked.motion(beats);
  return a;
}

BarErrors errors_of(const BarAnswers& answers, const BarAnswers& truth) {
  const auto share = [](double value, double right) { return std::abs(value / right - 1.0); };
  BarErrors e{.tip = share(answers.work, truth.work),
              .confined = share(answers.confined, truth.confined),
              .motion = motion_error(answers.motion, truth.motion)};
  for (std::size_t k = 0; k < truth.frequency.size(); ++k) {
    const double off = share(answers.frequency[k], truth.frequency[k]);
    if (!(off <= e.frequencies) && !std::isnan(e.frequencies)) {
      e.frequencies = off;
      e.worst_frequency = k;
    }
  }
  return e;
}

double motion_error(const WatchedMotion& motion, const WatchedMotion& truth) {
  double apart = 0.0, size = 0.0;
  for (Eigen::Index k = 0; k < truth.cols(); ++k) {
    apart = max_or_nan(apart, (motion.col(k) - truth.col(k)).norm());
    size = max_or_nan(size, truth.col(k).norm());
  }
  return apart / size;
}

}  // namespace dartboard
