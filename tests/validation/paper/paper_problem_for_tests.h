#pragma once
// A small body in the paper's material, and code shared by the tests of the paper's sentences.

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/problem.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

inline Problem small_tetrahedral_problem() {
  Problem problem;
  problem.mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 7);
  problem.material = {.density = 1000.0, .stiffness = 48.0, .damping = 0.1, .viscosity = 0.5};
  return problem;
}

inline void expect_yes(const ClaimAnswer& answer) { EXPECT_TRUE(answer.holds) << answer.measured; }
inline void expect_no(const ClaimAnswer& answer) { EXPECT_FALSE(answer.holds) << answer.measured; }

}  // namespace dartboard
