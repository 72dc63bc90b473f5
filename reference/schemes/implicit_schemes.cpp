#include "reference/schemes/implicit_schemes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "reference/schemes/linearly_implicit.h"
#include "reference/schemes/rounding.h"
#include "reference/schemes/stage_equation.h"

namespace dartboard::reference {
namespace {

using Vector = Vector3<Extended>;
using Vectors = std::vector<Vector>;

constexpr std::string_view names[]{"backward-euler", "implicit-midpoint", "energy-momentum", "sdirk2",
                                   "bdf2",           "baraff-witkin"};
constexpr Extended newton_tolerance = 1e-10L;  // of these methods' solutions, relative to what acts

// a + t b, by point
Vectors sum(const Vectors& a, Extended t, const Vectors& b) {
  Vectors result(a);
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += t * b[i];
  return result;
}

struct Ends {
  Vectors x0, v0, x1, v1, x_earlier, v_earlier;
};

// |x1 - (xh + t w)| over its rounding in double; `speed` bounds the velocities that w was computed from.
Extended drift_excess(const Ends& s, const Vectors& xh, Extended t, const Vectors& w, Extended speed) {
  const Extended size = largest_of(s.x0) + largest_of(s.x1) + largest_of(s.x_earlier);
  const Extended allowed =
      8 * epsilon * (size + std::abs(t) * speed) + 8 * Extended(std::numeric_limits<double>::denorm_min());
  return largest_of(sum(s.x1, -1, sum(xh, t, w))) / allowed;
}

Extended excess_of(std::string_view name, const SpringNetwork& network, Extended h, const Ends& s) {
  const Extended speed = std::max(largest_of(s.v0), largest_of(s.v1));
  const Extended rounding = epsilon * (largest_of(s.x0) + largest_of(s.x1) + largest_of(s.x_earlier));
  if (name == "baraff-witkin")
    return max_or_nan(drift_excess(s, s.x0, h, s.v1, speed), linearly_implicit_excess(network, s.x0, s.v0, s.v1, h));
  if (name == "backward-euler") {
    const StageEquation stage{
        .network = network, .xh = s.x0, .vh = s.v0, .tau = h, .tolerance = newton_tolerance, .top_speed = speed};
    return max_or_nan(drift_excess(s, s.x0, h, s.v1, speed), stage.excess(s.v1));
  }
  if (name == "implicit-midpoint" || name == "energy-momentum") {
    const bool discrete = name == "energy-momentum";
    Vectors w = sum(s.v0, 1, s.v1);
    for (Vector& p : w) p /= 2;
    // a fixed point has the velocity that it keeps, to the last bit
    for (std::size_t i = 0; i < w.size(); ++i)
      if (network.fixed[i]) w[i] = s.v1[i];
    const StageEquation stage{.network = network,
                              .xh = s.x0,
                              .vh = s.v0,
                              .tau = h / 2,
                              .discrete_gradient = discrete,
                              .tolerance = discrete ? 0 : newton_tolerance,
                              .top_speed = 2 * speed};
    return max_or_nan(drift_excess(s, s.x0, h, w, 2 * speed), stage.excess(w));
  }
  if (name == "bdf2") {
    const bool first = s.x_earlier.empty();
    Vectors xh = s.x0, vh = s.v0;
    if (!first) {
      xh = sum(s.x0, Extended(1) / 3, sum(s.x0, -1, s.x_earlier));
      const Vectors ahead = sum(s.v0, Extended(1) / 3, sum(s.v0, -1, s.v_earlier));
      for (std::size_t i = 0; i < vh.size(); ++i)
        if (!network.fixed[i]) vh[i] = ahead[i];
    }
    const Extended tau = first ? h : 2 * h / 3;
    const StageEquation stage{.network = network,
                              .xh = xh,
                              .vh = vh,
                              .tau = tau,
                              .guess = s.v0,
                              .tolerance = newton_tolerance,
                              .top_speed = std::max(speed, largest_of(s.v_earlier)),
                              .xh_rounding = first ? 0 : rounding};
    return max_or_nan(drift_excess(s, xh, tau, s.v1, speed), stage.excess(s.v1));
  }
  // SDIRK2. The second stage ends the step, so w2 = v1; the first follows from the positions, x1 = x0 + (h - tau) w1 +
  // tau w2, to their accuracy. In short steps, where that is too low, it follows from its equation: the
  // iteration w = v0 + tau a(x0 + tau w, w) contracts.
  const Extended tau = (1 - 1 / std::sqrt(Extended(2))) * h;
  Vectors w1 = sum(sum(s.x1, -1, s.x0), -tau, s.v1);
  for (std::size_t i = 0; i < w1.size(); ++i) w1[i] = network.fixed[i] ? s.v0[i] : Vector(w1[i] / (h - tau));
  Extended lost = rounding / tau;
  const Extended solved_to = newton_tolerance * std::max(speed, largest_of(sum(s.v1, -1, s.v0)));
  const StageEquation first_stage{.network = network, .xh = s.x0, .vh = s.v0, .tau = tau};
  Extended last_move = std::numeric_limits<Extended>::infinity();
  for (Vectors now = w1; lost > solved_to;) {
    const Vectors next = sum(s.v0, tau, first_stage.forces(now).acceleration);
    const Extended move = largest_of(sum(next, -1, now));
    if (!(move <= last_move / 16)) break;  // hardly any contraction
    now = next;
    last_move = move;
    if (move > epsilon * speed) continue;
    w1 = now;
    lost = solved_to;
  }
  Vectors slope = sum(w1, -1, s.v0);
  for (Vector& p : slope) p /= tau;
  const Vectors xh = sum(s.x0, h - tau, w1), vh = sum(s.v0, h - tau, slope), guess = sum(vh, tau, slope);
  const Extended top = std::max({speed, largest_of(w1), largest_of(vh), largest_of(guess)});
  const StageEquation one{.network = network,
                          .xh = s.x0,
                          .vh = s.v0,
                          .tau = tau,
                          .tolerance = newton_tolerance,
                          .top_speed = top,
                          .xh_rounding = rounding,
                          .speed_rounding = lost};
  StageEquation two = one;
  two.xh = xh;
  two.vh = vh;
  two.guess = guess;
  return max_or_nan(drift_excess(s, xh, tau, s.v1, top), max_or_nan(one.excess(w1), two.excess(s.v1)));
}

}  // namespace

bool is_implicit_scheme(std::string_view name) { return std::ranges::find(names, name) != std::end(names); }

StepJudgement judge_implicit_step(std::string_view name, const SpringNetwork& network, const TakenStep& step) {
  const auto before = vector_of<Extended>(step.before), after = vector_of<Extended>(step.after),
             earlier = vector_of<Extended>(step.earlier);
  Ends s{part_of(before, 0), part_of(before, 1),  part_of(after, 0),
         part_of(after, 1),  part_of(earlier, 0), part_of(earlier, 1)};
  StepJudgement judgement;
  judgement.excess = static_cast<double>(excess_of(name, network, step.h, s));
  for (Vector& p : s.x1) p *= 1 + 1e-6L;
  judgement.nudged = static_cast<double>(excess_of(name, network, step.h, s));
  s.x1 = s.x0;
  s.v1 = s.v0;
  judgement.idle = static_cast<double>(excess_of(name, network, step.h, s));
  return judgement;
}

}  // namespace dartboard::reference
