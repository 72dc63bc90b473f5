#pragma once
// The point where implicit methods become cheaper than explicit ones: predicted by the break-even law, and measured.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/solvers/break_even.h"

namespace dartboard {

struct CrossoverOptions {
  double error = 3e-3;             // [edges] that both sides must meet
  double pilot_factor = 1e4;       // stiffness of the inclusion that the pilots begin with
  std::uint64_t pilot_steps = 16;  // and twice as many
  int most_evaluations = 6;        // of the cost ratio
};

/// Costs at one stiffness, by runs: the cheapest settings that meet the error.
struct CostPair {
  double factor = 0.0, phase = 0.0;  // T omega_max
  double explicit_s = 0.0, implicit_s = 0.0;
  double explicit_error = 0.0;  // [edges]
  double implicit_steps = 0.0;  // for the error, between two runs by interpolation
  std::string implicit_method;
  double ratio() const { return explicit_s / implicit_s; }
};

struct Crossover {
  std::size_t vertices = 0, springs = 0;
  StepPrices prices;
  double explicit_step_s = 0.0;
  std::string explicit_method, implicit_method;
  ImplicitWork work;             // in a step of the prediction
  double predicted_steps = 0.0;  // of the implicit method
  double overhead = 1.0;         // of a pilot over the law for its own counts: what the parts leave out
  double predicted_s = 0.0;      // of both at the crossover
  double first_phase = 0.0;      // predicted by pilots at pilot_factor
  double predicted_phase = 0.0, predicted_factor = 0.0;  // by pilots at the stiffness of first_phase
  double measured_phase = 0.0, measured_factor = 0.0;
  std::vector<CostPair> costs;
  std::string failure;  // empty when it was found
  double deviation() const { return predicted_phase / measured_phase - 1.0; }

  /// T omega_max of the stiffest body that was seen to cost less by explicit steps, and of the softest by implicit
  /// ones, the smaller first: the measured crossover lies between. No value where no run was on one of the two sides.
  struct Enclosure {
    double low, high;
  };
  std::optional<Enclosure> enclosure() const;
};

/// A box of `side`^3 vertices, the tenth of its cells in the middle stiffer by a factor, moving softly and undamped.
///
/// Predicted: two pilots of each implicit method at one stiffness give the steps for the error, by Richardson, and the
/// work of a step; microbenchmarks give the prices, the pilot what they leave out; the law gives T omega_max. Measured:
/// the stiffness factor at which the fastest explicit run (Verlet at 0.9 of its limit: fewest evaluations per stable
/// time) and the cheapest implicit run that meet the error take the same processor time. Ratios are found by runs, the
/// factor by false position on the logarithms. The reference is the explicit method with half the step.
Crossover find_crossover(int side, const CrossoverOptions& options, const CpuClock& clock,
                         const std::function<void(const CostPair&)>& each = {});

}  // namespace dartboard
