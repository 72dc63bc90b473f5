#include "validation/solvers/break_even.h"

#include <algorithm>
#include <cmath>

#include "core/time/solve/cholesky.h"

namespace dartboard {
namespace {

constexpr double of_limit = 0.9;  // the part of the stable step that is used

template <class Do>
double least_seconds(const CpuClock& clock, Do&& action) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 5; ++k) {
    const std::int64_t start = clock();
    action();
    least = std::min(least, 1e-9 * static_cast<double>(clock() - start));
  }
  return least;
}

}  // namespace

StepPrices step_prices(const TradeoffScene& scene, double h, const CpuClock& clock) {
  StepPrices prices;
  ForceTimer force(scene, clock, 500'000);
  prices.force = 1e-9 * std::min({force.measure(), force.measure(), force.measure()});

  SceneStage stage(scene);
  const SpringSystem system = stage.system();
  std::vector<SpringTangent> tangents;
  StepMatrix matrix;
  BlockMatrix blocks;
  const NodePattern pattern = node_pattern_of(system);
  prices.linearisation = least_seconds(clock, [&] {
    evaluate_tangents(system, stage.motion().x, Compression::projected, tangents);
    matrix.evaluate(system, tangents, h);
  });
  Cholesky cholesky;
  matrix.assemble(pattern, blocks);
  if (cholesky.factorise(blocks) != SolveStatus::ok) {
    prices.factorisation = prices.solve = std::numeric_limits<double>::infinity();
    return prices;
  }
  prices.factorisation = least_seconds(clock, [&] {
    matrix.assemble(pattern, blocks);
    (void)cholesky.factorise(blocks);
  });
  std::vector<Eigen::Vector3d> x(system.vertex_count(), Eigen::Vector3d::Ones()), y = x;
  prices.solve = least_seconds(clock, [&] {
    matrix.multiply(x, y);
    (void)cholesky.solve(y, x);
  });
  return prices;
}

ImplicitWork implicit_work(const WorkCounters& work) {
  const auto steps = static_cast<double>(std::max<std::uint64_t>(work.steps, 1));
  ImplicitWork result;
  // a line search evaluates the energy of every spring once per iteration: another evaluation of the forces
  result.forces =
      static_cast<double>(work.force_evaluations + work.newton_iterations + work.line_search_trials) / steps;
  result.linearisations = static_cast<double>(work.newton_iterations) / steps;
  result.solves = static_cast<double>(work.solves) / steps;
  result.factorisations = static_cast<double>(work.factorisations);
  return result;
}

double steps_for_error(const SceneFeatures& f, int order, double duration, double error) {
  const double turn = duration * f.motion_rate;
  const double constant = order == 1 ? 0.5 : order == 2 ? 1.0 / 12.0 : 1e-3;
  return turn * std::pow(std::max(constant * f.motion_size * turn / error, 1e-3), 1.0 / order);
}

double steps_for_stability(double duration, double limit) { return duration / (of_limit * limit); }

double implicit_seconds(double steps, const ImplicitWork& work, const StepPrices& prices) {
  return steps *
             (work.forces * prices.force + work.linearisations * prices.linearisation + work.solves * prices.solve) +
         work.factorisations * prices.factorisation;
}

double break_even_phase(double imaginary_limit, double step_s, double implicit_s) {
  return implicit_s / step_s / steps_for_stability(1.0, imaginary_limit);
}

}  // namespace dartboard
