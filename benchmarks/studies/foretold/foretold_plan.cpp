#include "benchmarks/studies/foretold/foretold_plan.h"

#include <cmath>

#include "validation/scenes/random_scenes.h"

namespace dartboard {
namespace {

constexpr std::uint64_t errors_of_a_scene = 5;
constexpr double largest_error = 3e-5, smallest_error = 3e-7;  // [edges]

}  // namespace

ForetoldCases::ForetoldCases(std::uint64_t seed, bool quick) : seed_(seed), quick_(quick), random_(seed + 177) {}

std::uint64_t ForetoldCases::size() const { return quick_ ? 2 : 13; }

double ForetoldCases::budget_s() const { return 0.03; }

ForetoldCase ForetoldCases::next() {
  // springs times duration times omega_max: a run makes two to twenty evaluations of some nanoseconds of each
  const double work = quick_ ? 2e5 : 2e7;
  const RandomSceneOptions options{.least_points = 60,
                                   .most_points = 200,
                                   .most_work = 1.3 * work,
                                   .least_work = work,
                                   .damped_work = 2.6,
                                   .least_phase = 1e3,
                                   .most_phase = 2e6,
                                   .least_strain = 2e-4,
                                   .most_strain = 1e-3,
                                   .least_sag = 5e-4,
                                   .most_sag = 5e-3,
                                   .cuts = false};
  ForetoldCase drawn{random_scene(seed_, drawn_++, options), {}};
  for (std::uint64_t k = 0; k < errors_of_a_scene; ++k) {
    const double u = (static_cast<double>(k) + 0.5 * (random_.next_signed() + 1.0)) / errors_of_a_scene;
    drawn.errors.push_back(largest_error * std::pow(smallest_error / largest_error, u));
  }
  return drawn;
}

}  // namespace dartboard
