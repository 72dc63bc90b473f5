#pragma once
// The cheapest model, mesh, integrator and step for a bar whose motion may have a given error.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/elements/measured_model.h"

namespace dartboard {

/// A model on two meshes, and the extrapolation to others.
struct ModelTrend {
  BarModel model;
  int coarse = 2, fine = 3;                     // fineness of the two meshes
  double coarse_error = 0.0, fine_error = 0.0;  // of the motion
  double fine_cost = 0.0;                       // [s] for a simulated second

  /// Order of the error, as a power of the size of a cube; NaN where the coarser mesh is exact.
  double order() const;
  /// The coarsest mesh predicted to have that error; 0 where the error falls too slowly for any, or grows.
  int finer_for(double error) const;
  /// More elements, and steps that are shorter by as much: the fourth power, for explicit methods.
  double cost_at(int finer) const;
};

/// The trials, in their order; the last is the advice, where it meets the error.
struct ModelTrial {
  double predicted_error = 0.0, predicted_cost = 0.0;
  MeasuredModel measured;
};
struct ModelAdvice {
  double error = 0.0;  // requested: a share of how far the bar is bent, over one period
  std::vector<ModelTrend> trends;
  std::vector<ModelTrial> trials;
  std::string why_not{};  // where there is no pick

  const MeasuredModel* pick() const;
};

/// The algorithm: each model is measured on two coarse meshes, and compared with the reference. The order that these
/// show gives the mesh that it needs, and its predicted cost. The model predicted to be the cheapest is measured on
/// that mesh; if it meets the error, it is the advice; else it needs a finer one, and all are compared again.
///
/// Every answer was measured; errors below twice the resolution of the reference are refused.
/// throws  InputError unless error > 0
ModelAdvice advise_model(const ClampedBar& bar, const BarMeshes& meshes, double poisson, double error,
                         const std::function<std::int64_t()>& clock,
                         const std::function<void(const std::string&)>& tells = {});

}  // namespace dartboard
