#pragma once
// Newton's method over corotational elements: with the exact tangent, its projection, and the paper's warped stiffness.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// A load that bends a beam of corotational tetrahedra, applied at once.
struct NewtonRun {
  static constexpr std::string_view exact = "exact tangent", projected = "projected tangent",
                                    warped = "warped stiffness";
  static constexpr double residual = 1e-9;  // stops the iteration
  static constexpr std::size_t most = 200;  // iterations
  double traction = 0.0;                    // [Pa]
  std::string matrix;
  std::optional<std::size_t> iterations{};  // nothing: `most` were not enough
  double bent = 0.0;                        // [m] of 1 m, at rest
};

/// With each matrix in turn, under loads that bend it to some 0.35 and 0.6 of its length; steps are whole.
/// pre  across is 2 or 4
std::vector<NewtonRun> newton_runs(int across);

}  // namespace dartboard
