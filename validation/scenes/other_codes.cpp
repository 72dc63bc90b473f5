#include "validation/scenes/other_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <limits>

namespace dartboard {
namespace {

double distance(const TradeoffScene& scene, const reference::CodeRun& a, const reference::CodeRun& b) {
  if (!a.failure.empty() || !b.failure.empty()) return std::numeric_limits<double>::infinity();
  return reference::distance(scene.motion, a, b, scene.edge);
}

}  // namespace

SceneReference reference_by_other_codes(const TradeoffScene& scene, double accepted) {
  SceneReference found;
  found.kind = ReferenceKind::other_codes;
  // errors decay in damped motions
  const auto& springs = scene.motion.network.springs;
  const bool damped = std::ranges::any_of(springs, [](const reference::Spring& s) { return s.damping > 0.0; });
  double step = damped ? 2.0 : 0.7, tolerance = damped ? 1e-9 : 1e-11;
  reference::CodeRun odeint, other;
  for (int round = 0; round < 2; ++round, step *= 0.5, tolerance *= 0.1) {
    auto beside = std::async(std::launch::async, [&scene, tolerance] {
      return reference::have_sundials() ? reference::run_cvode_adams(scene.motion, tolerance)
                                        : reference::run_odeint_bulirsch_stoer(scene.motion, 1e-2 * tolerance);
    });
    odeint = reference::run_odeint_fehlberg(scene.motion, step);
    other = beside.get();
    found.cpu_s += odeint.cpu_s + other.cpu_s;
    found.agreement = distance(scene, odeint, other);
    // half the step leaves a 256th of an error; where that is not enough the motion is chaotic
    if (found.agreement <= accepted || !(found.agreement < 256.0 * accepted)) break;
  }
  for (const auto& y : odeint.states) found.states.push_back(reference::to_points(y));
  found.floor = 10.0 * found.agreement;
  found.what = fmt::format("{} ({:.1f} s); {} ({:.1f} s): {:.1e} edges away", odeint.code, odeint.cpu_s, other.code,
                           other.cpu_s, found.agreement);
  return found;
}

}  // namespace dartboard
