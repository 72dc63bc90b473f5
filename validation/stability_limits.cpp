#include "validation/stability_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/time/integrators.h"
#include "core/time/stable_step.h"
#include "validation/extreme_bodies.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double gain = 1e3;
constexpr std::uint64_t window = 64;  // steps over which the size of an oscillation is taken

/// A body with the frequencies that matter and the shape of the fastest.
struct Subject {
  std::string name;
  SpringColumns body;
  std::vector<double> frequencies;  // those with limits of their own: all, or the highest
  std::vector<Vector3d> shape;
  double tolerance;
  std::uint64_t steps;
};

std::vector<Subject> subjects(bool quick) {
  const std::uint64_t steps = 10000;
  std::vector<Subject> list;
  Subject oscillator{"oscillator", extreme_body("oscillator"), {10.0}, {{0, 0, 0}, {1, 0, 0}}, 1e-3, steps};
  list.push_back(std::move(oscillator));
  Subject chain{"chain", extreme_body("chain"), {}, {}, 1e-3, steps};
  const std::size_t n = chain.body.x.size() - 2;
  const double angle = std::numbers::pi / static_cast<double>(n + 1);
  for (std::size_t j = n; j >= 1; --j) chain.frequencies.push_back(20.0 * std::sin(static_cast<double>(j) * angle / 2));
  for (std::size_t i = 0; i < n + 2; ++i) chain.shape.push_back({std::sin(static_cast<double>(i * n) * angle), 0, 0});
  chain.shape.front().setZero();
  chain.shape.back().setZero();
  list.push_back(std::move(chain));
  for (const char* name : {"box", "sheet"}) {
    Subject mesh{name, extreme_body(name), {}, {}, 5e-3, quick ? 1000u : 3000u};
    StableStepEstimate estimate;
    estimate.refresh(mesh.body.system(), mesh.body.x);
    for (int k = 0; k < 3000; ++k) estimate.follow(mesh.body.system(), mesh.body.x);
    mesh.frequencies = {estimate.latest().lower};
    mesh.shape.assign(estimate.shape().begin(), estimate.shape().end());
    list.push_back(std::move(mesh));
  }
  return list;
}

double size_of(const SpringColumns& body, const std::vector<Vector3d>& rest, double omega) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    sum += omega * omega * (body.x[i] - rest[i]).squaredNorm() + body.v[i].squaredNorm();
  return std::sqrt(sum);
}

// Growth from the first tenth to the end below the gain? The amplitude stays within 1e-4 of an edge.
bool stable(const Subject& subject, const SpringColumns& at_rest, Integrator& integrator, double h) {
  const double omega = subject.frequencies.front();
  SpringColumns body = at_rest;
  for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += 1e-8 * subject.shape[i];
  integrator.restart();
  double first = 0.0, last = 0.0;
  const double start = size_of(body, at_rest.x, omega);
  const std::uint64_t begin = subject.steps / 10;
  for (std::uint64_t k = 0; k < subject.steps; ++k) {
    if (!integrator.step(body.system(), body.motion(), h).ok()) return false;
    if (k >= begin && k < begin + window) first = std::max(first, size_of(body, at_rest.x, omega));
    // ten times more than the gain: what comes after that is no longer linear
    if (!(size_of(body, at_rest.x, omega) < 10 * gain * start)) return false;
    if (k + window >= subject.steps) last = std::max(last, size_of(body, at_rest.x, omega));
  }
  return last <= start || last < gain * first;  // what has decayed to rounding or to nothing is stable
}

}  // namespace

bool StabilityLimit::holds() const { return std::abs(measured / theory - 1.0) <= tolerance; }

std::vector<StabilityLimit> measure_stability_limits(bool quick) {
  std::vector<StabilityLimit> limits;
  for (const Subject& subject : subjects(quick))
    for (const IntegratorEntry& entry : integrators()) {
      const auto integrator = entry.make();
      const Scheme& scheme = integrator->scheme();
      if (scheme.implicit) continue;
      for (const double zeta : {0.0, 0.05, 0.2, 0.5, 1.0}) {
        // Symplectic Euler damps spring by spring. In a network that is less than what its scheme says of one damper,
        // and its limit, unlike that of the symmetric methods, depends on it.
        if (scheme.symplectic && !scheme.symmetric && zeta > 0.0 && subject.name != "oscillator") continue;
        const double omega = subject.frequencies.front();
        const auto steps = static_cast<double>(subject.steps - subject.steps / 10 - window);
        SpringColumns body = subject.body;
        for (Spring& s : body.springs) s.damping = 2 * zeta / omega * s.stiffness;
        StabilityLimit limit{subject.name, std::string(entry.name), zeta, Scheme::unlimited, 0.0, subject.tolerance};
        for (const double frequency : subject.frequencies)
          limit.theory =
              std::min(limit.theory, omega / frequency * stable_limit(scheme, zeta * frequency / omega, steps, gain));
        if (!std::isfinite(limit.theory)) continue;
        double low = 0.99 * limit.theory, high = 1.004 * limit.theory;
        if (subject.tolerance > 4e-3) high = 1.006 * limit.theory;
        if (stable(subject, body, *integrator, low / omega) && !stable(subject, body, *integrator, high / omega)) {
          for (int k = 0; k < 10; ++k) {
            const double middle = (low + high) / 2;
            (stable(subject, body, *integrator, middle / omega) ? low : high) = middle;
          }
          limit.measured = (low + high) / 2;
        }
        limits.push_back(std::move(limit));
      }
    }
  return limits;
}

}  // namespace dartboard
