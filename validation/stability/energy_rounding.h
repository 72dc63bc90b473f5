#pragma once
// Effects of rounding alone: on the energy over long runs, and on the motion in tiny steps.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// The energy error of a method that conserves a quadratic form exactly, so that nothing but rounding changes it.
struct RoundingGrowth {
  std::string integrator;
  double h_omega = 0.0;
  int starts = 0;
  struct Point {
    std::uint64_t steps;
    double error;  // root mean square over the starts, relative to the energy
  };
  std::vector<Point> points{};
  double exponent = 0.0;        // of the steps, by least squares on logarithms; 1/2 where errors are a random walk
  double standard_error = 0.0;  // of the exponent, over the random starts; NaN for one start
};

/// The power of the number of steps with which the errors grow, by least squares on logarithms.
double exponent_of(std::span<const RoundingGrowth::Point> points);

/// The standard error of the exponent of the root mean square over starts, by leaving out one start after the other
/// (jackknife): `squares` has the squared errors of each start at each of the steps.
double exponent_error(std::span<const RoundingGrowth::Point> points, const std::vector<std::vector<double>>& squares);

/// Runs of an oscillator from `starts` random states, h omega = 0.05, measured after 10^4 steps (10^3 if there are
/// fewer than 10^6) and then at every half decade up to `steps`.
///
/// The form is that of the matrix of one step, in extended precision, with the rounded drifts and kicks that the
/// integrator uses; for compensated states the lost digits are included.
/// throws  InputError unless it is a Verlet or Blanes-Moan method, plain or compensated
RoundingGrowth measure_rounding_growth(std::string_view integrator, std::uint64_t steps, int starts);

/// A run in steps so short that positions hardly change.
struct TinySteps {
  std::string integrator;
  double h = 0.0;  // [s]
  std::uint64_t steps = 0;
  double lost = 0.0;      // share of the displacement missing from the positions
  double readable = 0.0;  // half a unit in the last place of the position over the displacement: unavoidable loss
  double lost_with_digits = 0.0;  // with the lost digits, for compensated states; else as `lost`

  /// Only the unavoidable part is lost.
  bool keeps_all() const { return lost <= 2 * readable + 1e-7; }
};

/// `steps` steps of the oscillator from q = 1/8, v = 1/4 on a spring of length 2, against Verlet's closed form.
TinySteps measure_tiny_steps(std::string_view integrator, double h, std::uint64_t steps);

}  // namespace dartboard
