#pragma once
// Times of clamped bars in motion, each with its own integrator and step, taken in turns.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "validation/elements/clamped_bar.h"

namespace dartboard {

/// A bar and how it is stepped: `steps` steps of h from the bent bar at rest are timed.
struct TimedBar {
  std::string model;  // in_words
  int finer = 1;
  double poisson = 0.25;
  std::string integrator;
  double h = 0.0;  // [s]
  std::uint64_t steps = 1;

  /// "springs, 4 finer, 0.25": the name of its task.
  std::string name() const;
  double simulated() const { return h * static_cast<double>(steps); }  // [s] in a sample
};
void to_json(nlohmann::json& json, const TimedBar& bar);
void from_json(const nlohmann::json& json, TimedBar& bar);

struct ModelTimesPlan {
  ClampedBar bar;
  std::vector<TimedBar> bars;
  int process = 0, rounds = 1;
  std::uint64_t seed = 1;
};
/// The plan as one argument of `dartboard measure-models`, and back.
std::string to_argument(const ModelTimesPlan& plan);
/// throws  InputError for a text that is no plan
ModelTimesPlan from_argument(const std::string& text);

/// Takes the times in this process.
/// throws  SolverError where a step fails
void measure_models(const ModelTimesPlan& plan, const std::function<void(const Sample&)>& sink);

}  // namespace dartboard
