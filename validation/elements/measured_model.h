#pragma once
// A model of a clamped bar on a mesh: its errors, and the cheapest integrator and step that add little to them.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "validation/elements/bar_answers.h"
#include "validation/elements/bar_run.h"
#include "validation/elements/clamped_bar.h"

namespace dartboard {

/// Fineness of the meshes: of the models, and of the reference; one half as fine judges it.
struct BarMeshes {
  static constexpr std::size_t most_nodes = 3500;         // of a model
  static constexpr std::size_t most_true_nodes = 10'500;  // of a reference, whose factorisation takes seconds
  std::vector<int> models;
  int truth = 2;  // even
};
/// throws  InputError if the coarsest meshes are already too large
BarMeshes bar_meshes(const ClampedBar& bar, bool quick);

/// The converged reference of one Poisson's ratio.
struct BarTruth {
  double poisson = 0.25;
  Beats beats{};  // one period of its lowest frequency
  BarAnswers answers{};
  // The errors of a mesh half as fine: as much remains where errors fall with the size of cells, and at the corners of
  // the clamp they fall a little faster. Smaller errors cannot be resolved.
  BarErrors unsure{};
};
BarTruth bar_truth(const ClampedBar& bar, const BarMeshes& meshes, double poisson);

struct MeasuredModel {
  BarModel model;
  int finer = 1;
  std::size_t nodes = 0;
  BarErrors errors;           // the motion's as simulated
  double model_motion = 0.0;  // error of the motion in steps of no length
  double allowed = 0.0;       // for the error by steps: a tenth of that, or of the reference's resolution
  BestMethod method;
  double h = 0.0;  // [s] its step

  /// [s] of processor time for a simulated second, roughly.
  double rough_cost() const { return 1e-9 * method.step_ns / h; }
};
/// `clock` in ns.
MeasuredModel measure_model(const ClampedBar& bar, const BarModel& model, int finer, const BarTruth& truth,
                            const std::function<std::int64_t()>& clock);

}  // namespace dartboard
