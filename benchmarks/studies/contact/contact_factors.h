#pragma once
// What contacts that come and go ask of the factor that an implicit integrator keeps.

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace dartboard {

/// Counts over the steps of a scene by backward Euler with a kept factor.
struct ContactFactors {
  std::string scene;
  std::size_t steps = 0, changing = 0;  // of these, steps in which a contact comes or goes
  std::size_t changes = 0;              // contacts that come or go
  std::uint64_t factorisations = 0;
  std::uint64_t iterations = 0, iterations_of_changing = 0;  // of conjugate gradients

  /// Iterations in a step in which contacts come or go, and in another; NaN without such steps.
  double with_changes() const;
  double without_changes() const;
};
void to_json(nlohmann::json& json, const ContactFactors& counts);

/// The scenes of the gallery that are counted: bodies at rest on each other, an instrument, and balls that roll.
std::vector<std::string> factor_scenes();
/// pre  one of these; duration [s] > 0
ContactFactors count_factors(const std::string& scene, double duration);

}  // namespace dartboard
