#pragma once
// Samples of a clock without errors.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/harness/paired.h"

namespace dartboard {

/// One round in each of some processes, in which each task takes the nanoseconds given, processor and wall time alike.
inline std::vector<Sample> timed_samples(const std::vector<std::pair<std::string, double>>& ns, int processes = 7) {
  std::vector<Sample> samples;
  for (int process = 0; process < processes; ++process)
    for (const auto& [task, each] : ns) {
      Sample sample;
      sample.task = task;
      sample.process = process;
      sample.cpu_ns = sample.wall_ns = std::llround(each);
      samples.push_back(sample);
    }
  return samples;
}

}  // namespace dartboard
