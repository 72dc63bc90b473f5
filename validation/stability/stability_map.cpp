#include "validation/stability/stability_map.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/plain/nan_maximum.h"
#include "validation/scenes/extreme_bodies.h"
#include "validation/stability/growth_run.h"

namespace dartboard {
namespace {

constexpr double omega = 10.0;  // of the oscillator
constexpr double gain = 1e3;

SpringColumns damped_oscillator(double zeta) {
  SpringColumns body = extreme_body("oscillator");
  for (Spring& s : body.springs) s.damping = 2 * zeta / omega * s.stiffness;
  return body;
}

// ln of the growth per step, from where the size has changed by 10^6, or from 400 steps, the first ten left out.
double growth_of(Integrator& integrator, const SpringColumns& at_rest, double theta) {
  constexpr int skip = 10, window = 16, most = 400;
  SpringColumns body = at_rest;
  body.x[1].x() += 1e-8;
  body.v[1].x() = 0.7e-8 * omega;
  integrator.restart();
  const auto size = [&] { return std::hypot(omega * (body.x[1].x() - at_rest.x[1].x()), body.v[1].x()); };
  std::vector<double> sizes{size()};
  for (int k = 0; k < most; ++k) {
    if (!integrator.step(body.system(), body.motion(), theta / omega).ok()) break;
    sizes.push_back(size());
    const double ratio = sizes.back() / sizes.front();
    if (!(ratio < 1e6 && ratio > 1e-6)) break;
  }
  const auto n = sizes.size();
  if (n < skip + 2 * window)
    return std::log(std::max(sizes.back(), 1e-300) / sizes.front()) / static_cast<double>(n - 1);
  const auto begin = sizes.begin() + skip;
  const double first = max_or_nan(std::span(begin, begin + window)),
               last = max_or_nan(std::span(sizes.end() - window, sizes.end()));
  return std::log(last / first) / static_cast<double>(n - skip - window);
}

/// Calls at(theta) for every sign change of `grows` between 0 and the end, to 1e-7.
template <class Grows, class At>
void for_each_change(double from, double to, double scan, const Grows& grows, const At& at) {
  bool before = grows(from);
  for (double low = from; low < to; low += scan) {
    const double high = std::min(to, low + scan);
    const bool after = grows(high);
    if (after != before) {
      double a = low, b = high;
      while (b - a > 1e-7 * b) {
        const double middle = (a + b) / 2;
        (grows(middle) == before ? a : b) = middle;
      }
      at((a + b) / 2);
    }
    before = after;
  }
}

}  // namespace

double StabilityMap::worst() const {
  double worst = 0.0;
  for (const Crossing& c : boundary) worst = max_or_nan(worst, c.distance());
  return worst;
}

MapPlan map_plan(const Scheme& scheme, bool quick) {
  MapPlan plan;
  if (scheme.stages > 4 && scheme.symplectic) plan.theta_most = 8.0;
  if (quick) {
    plan.columns = 40;
    plan.rows = 20;
    plan.boundary_rows = 7;
    plan.steps = 1000;
  }
  return plan;
}

StabilityMap measure_stability_map(const IntegratorEntry& entry, const MapPlan& plan) {
  StabilityMap map;
  map.integrator = entry.name;
  const auto integrator = entry.make();
  const Scheme& scheme = integrator->scheme();
  const GrowthRun run{.omega = omega, .shape = {{0, 0, 0}, {1, 0, 0}}, .steps = plan.steps, .gain = gain};
  const double allowed = std::log(gain) / run.measured_steps();
  const auto grows = [&](double theta, double zeta) {
    return !(std::log(spectral_radius(scheme, theta, zeta)) < allowed);
  };
  const auto ratio = [&plan](int row, int rows) {
    return row == 0 ? 0.0 : plan.zeta_least * std::pow(plan.zeta_most / plan.zeta_least, (row - 1.0) / (rows - 2.0));
  };

  for (int c = 1; c <= plan.columns; ++c) map.theta.push_back(plan.theta_most * c / plan.columns);
  for (int r = 0; r < plan.rows; ++r) {
    map.zeta.push_back(ratio(r, plan.rows));
    const SpringColumns body = damped_oscillator(map.zeta.back());
    for (const double theta : map.theta) map.growth.push_back(growth_of(*integrator, body, theta));
  }

  for (int r = 0; r < plan.boundary_rows; ++r) {
    const double zeta = ratio(r, plan.boundary_rows);
    const SpringColumns body = damped_oscillator(zeta);
    std::vector<double> crossings;
    for_each_change(
        1e-3, plan.theta_most, 1e-3, [&](double theta) { return grows(theta, zeta); },
        [&](double theta) { crossings.push_back(theta); });
    for (std::size_t c = 0; c < crossings.size(); ++c) {
      StabilityMap::Crossing crossing{zeta, crossings[c]};
      // the next boundary may be closer than one percent
      double a = 0.99 * crossings[c], b = std::min(1.01 * crossings[c], plan.theta_most);
      if (c > 0) a = std::max(a, (crossings[c - 1] + crossings[c]) / 2);
      if (c + 1 < crossings.size()) b = std::min(b, (crossings[c] + crossings[c + 1]) / 2);
      const auto stable = [&](double at) { return is_stable(run, body, *integrator, at / omega); };
      const bool below = stable(a);
      if (below != stable(b) && below == !grows(a, zeta)) {
        for (int k = 0; k < 12; ++k) {
          const double middle = (a + b) / 2;
          (stable(middle) == below ? a : b) = middle;
        }
        crossing.measured = (a + b) / 2;
      }
      map.boundary.push_back(crossing);
    }
  }

  // along rows and along columns, so that the line is closed wherever it runs
  constexpr int fine = 400;
  for (int r = 0; r < fine; ++r) {
    const double zeta = ratio(r, fine);
    for_each_change(
        1e-3, plan.theta_most, plan.theta_most / 500, [&](double theta) { return grows(theta, zeta); },
        [&](double theta) {
          map.theory.push_back({theta, zeta});
        });
  }
  for (int c = 1; c <= fine; ++c) {
    const double theta = plan.theta_most * c / fine, span = std::log(plan.zeta_most / plan.zeta_least);
    for_each_change(
        0.001, 1.0, 1.0 / 400, [&](double t) { return grows(theta, plan.zeta_least * std::exp(span * t)); },
        [&](double t) {
          map.theory.push_back({theta, plan.zeta_least * std::exp(span * t)});
        });
  }
  return map;
}

}  // namespace dartboard
