#include "validation/statics/static_problem.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dartboard::static_problem_test {
namespace {

using Eigen::Vector3d;

// The surface stays, so the volume does; traction times area in all, aside by 3 : 4.
TEST(LoadedBeam, HasMovedPointsInsideAndTheLoadOfItsEnd) {
  for (const CellKind cells : {CellKind::tetrahedron, CellKind::hexahedron}) {
    const StaticProblem beam = loaded_beam(cells, 2, 5.0, false), regular = loaded_beam(cells, 1, 5.0, true);
    EXPECT_TRUE(regular.large);
    double volume = 0.0;
    for (std::size_t c = 0; c < beam.mesh.cell_count(); ++c) {
      EXPECT_GT(signed_measure(beam.mesh, c), 0.0);
      volume += signed_measure(beam.mesh, c);
    }
    EXPECT_NEAR(volume, 0.04, 1e-15);
    Vector3d load = Vector3d::Zero();
    std::size_t moved = 0;
    for (std::size_t p = 0; p < beam.mesh.points.size(); ++p) {
      load += beam.force[p];
      const Vector3d cells_away = beam.mesh.points[p] / 0.1;
      if ((cells_away.array() - cells_away.array().round()).abs().maxCoeff() > 1e-9) ++moved;
    }
    EXPECT_LT((load - 0.04 * 5.0 * Vector3d(0.0, 0.6, 0.8)).norm(), 1e-15);
    EXPECT_EQ(moved, 9u);  // the middle of each of nine inner cross sections
    EXPECT_EQ(beam.held.size(), 9u);
    EXPECT_EQ(regular.held.size(), 4u);
  }
}

TEST(DisplacementsByCore, AreLinearOrNotAsTheProblemSays) {
  const auto bent = [](double traction, bool large) {
    return displacements_by_core(loaded_beam(CellKind::hexahedron, 1, traction, large));
  };
  std::vector<Vector3d> once = bent(1.0, false), far = bent(800.0, false);
  for (Vector3d& d : once) d *= 800.0;
  EXPECT_LT(displacements_apart(far, once), 1e-12);
  // a beam that turns is stiffer than one that only shears, and comes nearer to the clamp
  const std::vector<Vector3d> large = bent(800.0, true);
  EXPECT_LT(largest_displacement(large), 0.9 * largest_displacement(far));
  // they differ by the slope, which is 0.03 here
  const double parted = displacements_apart(bent(30.0, true), bent(30.0, false));
  EXPECT_LT(parted, 0.03);
  EXPECT_GT(parted, 1e-3);
}

TEST(DisplacementsApart, IsTheLargestDistanceOverTheLargestDisplacement) {
  const std::vector<Vector3d> truth{{0, 0, 0}, {0, 3, 4}}, off{{0, 0, 1e-5}, {0, 3, 4}};
  EXPECT_DOUBLE_EQ(displacements_apart(off, truth), 2e-6);
  EXPECT_EQ(displacements_apart(truth, truth), 0.0);
  EXPECT_TRUE(std::isnan(displacements_apart({}, truth)));
  const std::vector<Vector3d> none{{0, 0, NAN}, {0, 3, 4}};
  EXPECT_TRUE(std::isnan(displacements_apart(none, truth)));
}

}  // namespace
}  // namespace dartboard::static_problem_test
