#include "validation/stability/growth_run.h"

#include <algorithm>
#include <cmath>

namespace dartboard {
namespace {

using Eigen::Vector3d;

double size_of(const SpringColumns& body, const std::vector<Vector3d>& rest, double omega) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    sum += omega * omega * (body.x[i] - rest[i]).squaredNorm() + body.v[i].squaredNorm();
  return std::sqrt(sum);
}

}  // namespace

bool is_stable(const GrowthRun& run, const SpringColumns& at_rest, Integrator& integrator, double h) {
  SpringColumns body = at_rest;
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += 1e-8 * run.shape[i];
  integrator.restart();
  double first = 0.0, last = 0.0;
  const double start = size_of(body, at_rest.x, run.omega);
  const std::uint64_t begin = run.steps / 10;
  for (std::uint64_t k = 0; k < run.steps; ++k) {
    if (!integrator.step(body.system(), body.motion(), h).ok()) return false;
    const double size = size_of(body, at_rest.x, run.omega);
    if (k >= begin && k < begin + GrowthRun::window) first = std::max(first, size);
    // ten times more than the gain: beyond that the motion is no longer linear
    if (!(size < 10 * run.gain * start)) return false;
    if (k + GrowthRun::window >= run.steps) last = std::max(last, size);
  }
  return last <= start || last < run.gain * first;  // a motion that has decayed to rounding or to nothing is stable
}

}  // namespace dartboard
