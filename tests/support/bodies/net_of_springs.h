#pragma once
// A tangle of springs on which all acts that may act on springs, for tests of loops over them.

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "core/time/system/spring_system.h"

namespace dartboard {

/// Springs between vertices, most of which are near each other in number, with all that may act on these.
struct Net {
  std::vector<SpringEnds> ends;
  std::vector<Spring> damped;
  std::vector<UndampedSpring> undamped;
  std::vector<Eigen::Vector3d> x, v, pull;
  std::vector<double> mass, inverse_mass, viscosity;
  std::vector<std::uint8_t> fixed, held;

  explicit Net(std::uint32_t vertices = 2000, std::uint32_t springs = 60001) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Eigen::Vector3d(number(random), number(random), number(random)); };
    for (std::uint32_t i = 0; i < vertices; ++i) {
      x.push_back(vector());
      v.push_back(vector());
      pull.push_back(vector());
      mass.push_back(2.0 + number(random));
      inverse_mass.push_back(1.0 / mass.back());
      viscosity.push_back(0.5 * mass.back());
      fixed.push_back(i % 17 == 0);
      held.push_back(i % 13 == 1 ? static_cast<HeldAxes>(1 + i % 7) : 0);
    }
    x[8] = x[9];  // a spring without a length
    for (std::uint32_t s = 0; s < springs; ++s) {
      const auto a = static_cast<std::uint32_t>(std::uint64_t{s} * vertices / springs);
      const auto reach = s % 50 == 0 ? vertices - 1 : 20u;
      ends.push_back({a, (a + 1 + static_cast<std::uint32_t>(random() % reach)) % vertices});
      damped.push_back({1.0 + 0.5 * number(random), 10.0 + number(random), 0.2 + 0.1 * number(random)});
      undamped.push_back({damped.back().rest_length, damped.back().stiffness});
    }
  }
  /// A vertex without a spring.
  void add_vertex() {
    for (auto* column : {&x, &v, &pull}) column->emplace_back(0, 0, 0);
    for (auto* column : {&mass, &inverse_mass}) column->push_back(1.0);
    viscosity.push_back(0.0);
    for (auto* column : {&fixed, &held}) column->push_back(0);
  }
  SpringSystem system(SpringSpan springs) const {
    SpringSystem made{.ends = ends,
                      .springs = springs,
                      .mass = mass,
                      .inverse_mass = inverse_mass,
                      .viscosity = viscosity,
                      .fixed = fixed,
                      .gravity = {0, 0, -9.81},
                      .pull = pull};
    made.held_axes = held;
    return made;
  }
};

}  // namespace dartboard
