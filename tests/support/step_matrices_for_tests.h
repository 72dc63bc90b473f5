#pragma once
// Bodies with the matrix of an implicit step, for tests of factorisations.

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "core/time/solve/backward_error.h"
#include "core/time/solve/cholesky.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard {

struct BodyMatrix {
  SpringArrays arrays;
  std::vector<SpringTangent> tangents;
  StepMatrix matrix;
  BlockMatrix blocks;

  explicit BodyMatrix(SpringArrays body, Compression compression = Compression::projected, double tau = 0.02)
      : arrays(std::move(body)) {
    const SpringSystem system = arrays.system();
    evaluate_tangents(system, arrays.x, compression, tangents);
    matrix.evaluate(system, tangents, tau);
    matrix.assemble(node_pattern_of(system), blocks);
  }
};

/// The body with its vertex 21, an interior one of 4 x 4 x 4, dissociated.
inline SpringArrays with_vertex_dissociated(SpringArrays body) {
  dissociate(body, 21);
  return body;
}

/// The componentwise backward error of a solution for some right side.
inline double solved_error(Cholesky& cholesky, const BlockMatrix& blocks) {
  const auto b = random_vectors(blocks.node_count(), 11);
  auto x = b;
  EXPECT_EQ(cholesky.solve(b, x), SolveStatus::ok);
  return backward_error(blocks, b, x);
}

}  // namespace dartboard
