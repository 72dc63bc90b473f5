#include "reference/schemes/explicit_schemes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/error.h"
#include "reference/ode_codes.h"
#include "reference/schemes/network_state.h"

namespace dartboard::reference::explicit_schemes_test {
namespace {

/// Four points, one of them held, six springs of several strengths, off their rest lengths; dampers and viscosity.
SpringNetwork tetrahedron(double damping, double viscosity) {
  SpringNetwork network;
  network.mass = {1.0, 2.0, 0.5, 1.5};
  network.fixed = {0, 0, 0, 1};
  for (std::uint32_t a = 0; a < 4; ++a)
    for (std::uint32_t b = a + 1; b < 4; ++b) network.springs.push_back({a, b, 1.0 + a + b, damping * (1 + a), 1.0});
  network.viscosity = viscosity;
  network.gravity = {0, 0, -0.5};
  return network;
}
PointState start() {
  return {{{0, 0, 0}, {1.1, 0, 0}, {0.1, 0.9, 0.1}, {0, 0.2, 1.2}},
          {{0.2, 0, 0}, {0, -0.1, 0.3}, {0.1, 0, 0}, {0, 0, 0}}};
}

long double error_after(std::string_view name, const SpringNetwork& network, int steps) {
  const CodeRun truth = run_odeint_fehlberg({network, start(), {}, {1.0}}, 0.05);
  const ExplicitScheme<long double> scheme(name, network);
  std::vector<long double> y = vector_of<long double>(start());
  for (int k = 0; k < steps; ++k) scheme.step(y, 1.0L / steps);
  long double sum = 0;
  for (std::size_t c = 0; c < y.size(); ++c) sum += (y[c] - truth.states[0][c]) * (y[c] - truth.states[0][c]);
  return std::sqrt(sum);
}

// Halving a step leaves 2^-p of the error, to a tenth of the exponent at the steps taken here.
TEST(ExplicitSchemes, HaveTheOrderOfTheirMethodWithAndWithoutDamping) {
  const std::pair<const char*, int> orders[]{{"explicit-euler", 1},
                                             {"symplectic-euler", 1},
                                             {"verlet", 2},
                                             {"verlet-compensated", 2},
                                             {"rk4", 4},
                                             {"blanes-moan-4", 4},
                                             {"blanes-moan-4-compensated", 4},
                                             {"dormand-prince-54", 5}};
  for (const auto& [name, order] : orders)
    for (const double damping : {0.0, 0.2}) {
      const SpringNetwork network = tetrahedron(damping, damping);
      const int steps = order == 1 ? 400 : order == 2 ? 100 : 80;
      const long double coarse = error_after(name, network, steps), fine = error_after(name, network, 2 * steps);
      EXPECT_NEAR(static_cast<double>(std::log2(coarse / fine)), order, 0.1) << name << " damping " << damping;
    }
}

// Energy of an undamped oscillation is kept by splittings over ten thousand steps, to the square of h omega / 2.
TEST(ExplicitSchemes, KeepEnergyWhereTheyAreSplittings) {
  SpringNetwork network;
  network.mass = {1.0, 1.0};
  network.fixed = {1, 0};
  network.springs = {{0, 1, 1.0, 0.0, 1.0}};
  for (const char* name : {"symplectic-euler", "verlet", "blanes-moan-4"}) {
    const ExplicitScheme<double> scheme(name, network);
    std::vector<double> y = vector_of<double>({{{0, 0, 0}, {1.1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}});
    for (int k = 0; k < 10000; ++k) scheme.step(y, 0.1);
    const double energy = 0.5 * y[9] * y[9] + 0.5 * (y[3] - 1) * (y[3] - 1);
    EXPECT_NEAR(energy / 0.005, 1.0, 0.06) << name;
  }
}

TEST(ExplicitSchemes, KnowTheirNames) {
  EXPECT_TRUE(is_explicit_scheme("rk4"));
  EXPECT_FALSE(is_explicit_scheme("bdf2"));
  EXPECT_THROW(ExplicitScheme<double>("bdf2", tetrahedron(0, 0)), InputError);
}

}  // namespace
}  // namespace dartboard::reference::explicit_schemes_test
