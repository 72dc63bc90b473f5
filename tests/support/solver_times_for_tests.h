#pragma once
// Known times of solvers: the same in each of the rounds of one process.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/studies/solvers/solver_timing.h"

namespace dartboard {

constexpr int solver_rounds = 7;

/// Each task takes the milliseconds given in every round.
inline SolverTimes solver_times(const std::string& body, const std::vector<std::pair<std::string, double>>& ms) {
  SolverTimes t;
  t.body = body;
  for (int round = 0; round < solver_rounds; ++round)
    for (const auto& [task, each] : ms) {
      Sample sample;
      sample.task = task;
      sample.round = round;
      sample.cpu_ns = sample.wall_ns = std::llround(1e6 * each);
      t.samples.push_back(sample);
    }
  for (const auto& [task, each] : ms) t.tasks.push_back(task);
  return t;
}

}  // namespace dartboard
