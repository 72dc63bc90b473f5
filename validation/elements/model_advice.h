#pragma once
// Which model, mesh, integrator and step is the cheapest for a bar whose motion may be so far from the truth.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/elements/measured_model.h"

namespace dartboard {

/// A model on two meshes, and what follows for others.
struct ModelTrend {
  BarModel model;
  int coarse = 2, fine = 3;                     // how fine the two meshes are
  double coarse_error = 0.0, fine_error = 0.0;  // of the motion
  double fine_cost = 0.0;                       // [s] for a simulated second

  /// Of the error, as a power of the size of a cube; NaN where the coarser mesh is exact.
  double order() const;
  /// The coarsest mesh that should have that error; 0 where the error falls too slowly for any, or grows.
  int finer_for(double error) const;
  /// Elements, and steps that are shorter by as much: the fourth power, of explicit methods.
  double cost_at(int finer) const;
};

/// What was tried, in its order; the last is the advice, where it meets the error.
struct ModelTrial {
  double predicted_error = 0.0, predicted_cost = 0.0;
  MeasuredModel measured;
};
struct ModelAdvice {
  double error = 0.0;  // asked for: a share of how far the bar is bent, over one period
  std::vector<ModelTrend> trends;
  std::vector<ModelTrial> trials;
  std::string why_not{};  // where there is no pick

  const MeasuredModel* pick() const;
};

/// The algorithm: each model is measured on two coarse meshes, beside the reference. From the order that these show
/// follows the mesh that it needs, and what that should cost. The model that should be the cheapest is measured on
/// that mesh; if it meets the error, it is the advice; else it needs a finer one, and all are compared again.
///
/// No answer is given that was not measured; errors below twice what the reference can tell are refused.
/// throws  InputError unless error > 0
ModelAdvice advise_model(const ClampedBar& bar, const BarMeshes& meshes, double poisson, double error,
                         const std::function<std::int64_t()>& clock,
                         const std::function<void(const std::string&)>& tells = {});

}  // namespace dartboard
