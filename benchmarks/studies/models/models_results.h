#pragma once
// The measurements of `dartboard tradeoff --models`, and the cheapest model for an error.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "benchmarks/studies/models/model_times.h"
#include "validation/elements/measured_model.h"

namespace dartboard {

/// The four questions, in the order of BarErrors.
enum class Asked { tip, frequencies, confined, motion };
inline constexpr std::array<std::string_view, 4> asked_names{"tip", "frequencies", "confined modulus", "motion"};
inline constexpr std::array all_asked{Asked::tip, Asked::frequencies, Asked::confined, Asked::motion};
constexpr std::string_view name(Asked asked) { return asked_names[static_cast<std::size_t>(asked)]; }
double error_of(const BarErrors& errors, Asked asked);

/// A model on a mesh.
struct ModelPoint {
  TimedBar timed;
  MeasuredModel measured;
  Figure cost;  // [s] of processor time for a simulated second
};

struct ModelsResults {
  std::string what;  // the bar, in words
  std::vector<BarTruth> truths;
  std::vector<ModelPoint> points;
  std::vector<Sample> samples;

  const BarTruth& truth(double poisson) const;
  double sure = 0.02;                    // how far tip and frequencies of the reference may be off
  static constexpr double exact = 1e-6;  // smaller errors count as this one
  /// The error of a point as far as it is known: its own, or that of the reference if this is larger.
  double known_error(const ModelPoint& point, Asked asked) const;
  /// The cheapest point with at most that error, of a family ("springs", "hexahedra", empty for all) and a ratio; null
  /// if there is none.
  const ModelPoint* cheapest(Asked asked, double poisson, double error, std::string_view family = {}) const;
  /// Cost per simulated second of one over that of another, paired within rounds.
  Figure cost_ratio(const ModelPoint& point, const ModelPoint& baseline) const;
};

/// Cost of a bar, from the samples of its task: seconds of processor time for a simulated second.
Figure cost_of(const std::vector<Sample>& samples, const TimedBar& bar);

/// Says whether a model belongs to this family: its name contains the word.
bool belongs(const ModelPoint& point, std::string_view family);

/// The cost of an error with a model, for a simulated second [s]: between two meshes that follow each other, cost is a
/// power of error; infinite below the errors of all of them.
/// pre  points of a model go from coarse to fine
double cost_for(const ModelsResults& results, const std::string& model, Asked asked, double poisson, double error);

/// Errors for which one model is the cheapest by `cost_for`.
struct Reign {
  std::string model;
  double least = 0.0, below = 0.0;  // errors from `least` on, smaller than `below`; infinite for the first
};
/// From large errors to small ones, at the errors of all meshes and in steps of a hundredth of a decade; below the last
/// one no model was measured.
std::vector<Reign> reigns(const ModelsResults& results, Asked asked, double poisson);

}  // namespace dartboard
