#include "validation/statics/static_rest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/plain/error.h"
#include "reference/elements/elastic_point.h"
#include "validation/elements/clamped_bar.h"
#include "validation/statics/linearised.h"

namespace dartboard::static_rest_test {
namespace {

using Eigen::Vector3d;

/// A bar of ten hexahedra in a row, pulled aside at one corner of its end so that it bends by two fifths of its length.
struct Pulled {
  ClampedBar bar{{10, 1, 1}, 0.1, 1e5, 1000.0};
  std::unique_ptr<SimulatedBody> body = bar_body(bar, {Model::stvk, CellKind::hexahedron}, 1, 0.3);
  std::vector<Vector3d> force = std::vector<Vector3d>(body->vertices().size(), Vector3d::Zero());
  Pulled() {
    for (std::size_t k = 0; k < force.size(); ++k)
      if ((body->vertices().position[k] - Vector3d(1.0, 0.1, 0.1)).norm() < 1e-9) force[k] = {0.0, 0.8, 2.0};
  }
  StaticRest rest(const StaticPlan& plan, const StaticMatrix& matrix = {}) const {
    return static_rest(body->system(), body->vertices().position, force, plan, matrix);
  }
};

// Forces by the witness, in long double from the definition of the law: they balance the load, at every free vertex.
TEST(StaticRest, IsWhereTheWitnessOfTheLawHoldsTheLoad) {
  const Pulled pulled;
  const StaticRest rest = pulled.rest({.parts = 4});
  EXPECT_LE(rest.residual, 1e-11);
  const auto& vertices = pulled.body->vertices();
  Mesh mesh;
  mesh.points.assign(vertices.position.begin(), vertices.position.end());
  for (std::uint32_t i = 0; i < 10; ++i) {
    std::vector<std::uint32_t> corner;
    for (const auto& [x, y, z] : {std::tuple{0, 0, 0},
                                  {1, 0, 0},
                                  {1, 1, 0},
                                  {0, 1, 0},  //
                                  {0, 0, 1},
                                  {1, 0, 1},
                                  {1, 1, 1},
                                  {0, 1, 1}})
      for (std::uint32_t k = 0; k < vertices.size(); ++k)
        if ((vertices.position[k] - 0.1 * Vector3d(i + x, y, z)).norm() < 1e-9) corner.push_back(k);
    mesh.add_cell(CellKind::hexahedron, corner);
  }
  std::vector<long double> x, f(3 * vertices.size(), 0.0L);
  for (const Vector3d& p : rest.x) x.insert(x.end(), p.begin(), p.end());
  const Material material{.young = 1e5, .poisson = 0.3, .model = Model::stvk};
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& point : reference::elastic_points(mesh, c, material))
      reference::add_pull(point, reference::stress(point.law, reference::deformation(point, x.data())), f.data());
  double bent = 0.0;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    bent = std::max(bent, (rest.x[k] - vertices.position[k]).norm());
    if (pulled.body->system().fixed[k]) continue;
    for (std::size_t c = 0; c < 3;
         ++c)  // the residual, and rounding of core's forces, which are a hundred times the load
      EXPECT_NEAR(static_cast<double>(f[3 * k + c]), -pulled.force[k][static_cast<Eigen::Index>(c)], 1e-9);
  }
  EXPECT_GT(bent, 0.3);
}

// Quadratic: from a thousandth to 1e-11 in two or three. With the stiffness at rest residuals fall by a factor, if at
// all.
TEST(StaticRest, TakesFewIterationsWithTheExactTangent) {
  const Pulled pulled;
  const StaticPlan plan{.parts = 10};
  EXPECT_LE(pulled.rest(plan).iterations, 60u);
  Pulled weak;
  for (Vector3d& f : weak.force) f *= 0.02;
  const StaticPlan whole{.residual = 1e-9};
  const auto x = weak.body->vertices().position;
  const Eigen::SparseMatrix<double> at_rest = linearised(weak.body->system(), x).stiffness;
  const std::size_t exact = weak.rest(whole).iterations;
  const std::size_t constant = weak.rest(whole, [&](std::span<const Vector3d>) { return at_rest; }).iterations;
  EXPECT_LE(exact, 6u);
  EXPECT_GT(constant, 2 * exact);
}

TEST(StaticRest, SaysWhereItIsNotFound) {
  const Pulled pulled;
  EXPECT_THROW(pulled.rest({.parts = 10, .most = 1}), SolverError);
  Pulled endless;
  for (Vector3d& f : endless.force) f *= std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(endless.rest({}), SolverError);
}

}  // namespace
}  // namespace dartboard::static_rest_test
