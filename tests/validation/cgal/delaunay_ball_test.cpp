#include "validation/cgal/delaunay_ball.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/storage/hash.h"
#include "core/topology/summary.h"

namespace dartboard::delaunay_ball_test {
namespace {

std::uint64_t hash_of(const Mesh& mesh) {
  Hash hash;
  hash.add(mesh.nodes);
  for (const auto& p : mesh.points) hash.add_bytes(p.data(), sizeof(double) * 3);
  return hash.value();
}

// A sum of many terms, and a bound on its rounding error.
//
// A term is a 3 x 3 determinant over 6, of numbers that were subtracted once or not at all. Each of its six products is
// rounded at most once in each of three factors, in two multiplications, in the subtraction within the cross product,
// in two additions of the scalar product, and in the division: at most 9 times. With g(n) = n u / (1 - n u), the term
// is off by at most g(9) times the sum of the products' absolute values over 6, and n terms in a row add at most g(n -
// 1) times the sum of their absolute values (Higham 2002, sections 3.1 and 4.2). The bound is doubled, to cover the
// rounding in the bound itself: it is a sum of fewer than 1/(8 u) positive numbers.
struct Sum {
  double value = 0.0, products = 0.0, terms = 0.0;
  std::size_t count = 0;

  void add(double term, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const auto x = a.cwiseAbs(), y = b.cwiseAbs(), z = c.cwiseAbs();
    value += term;
    terms += std::abs(term);
    products +=
        (x[0] * (y[1] * z[2] + y[2] * z[1]) + x[1] * (y[0] * z[2] + y[2] * z[0]) + x[2] * (y[0] * z[1] + y[1] * z[0])) /
        6.0;
    ++count;
  }
  double bound() const {
    const auto g = [u = std::numeric_limits<double>::epsilon() / 2](double n) { return n * u / (1 - n * u); };
    return 2 * (g(9) * products + g(static_cast<double>(count)) * terms);
  }
};

class DelaunayBall : public testing::TestWithParam<std::array<int, 2>> {
 protected:
  Mesh mesh = delaunay_ball(GetParam()[0], static_cast<std::uint64_t>(GetParam()[1]));
};

TEST_P(DelaunayBall, IsOneBallOfPositiveTetrahedra) {
  const auto built = build_map<TetMap>(mesh);
  const MapSummary s = summarize(built.map);
  EXPECT_EQ(s.violation, "");
  EXPECT_EQ(s.cells[0], static_cast<std::size_t>(GetParam()[0]));  // every point, each one vertex
  EXPECT_EQ(s.cells[3], mesh.cell_count());
  EXPECT_EQ(4 * s.cells[3], 2 * s.cells[2] - s.boundary_facets);
  EXPECT_EQ(s.euler, 1);
  EXPECT_EQ(s.components, 1u);
  EXPECT_TRUE(s.orientable);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) EXPECT_GT(signed_measure(mesh, c), 0.0) << c;
}

// Divergence theorem: three times the volume is the flux of x through the boundary, a determinant per triangle.
TEST_P(DelaunayBall, FillsTheConvexHullOfItsPoints) {
  const auto built = build_map<TetMap>(mesh);
  Sum inside, through;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto p = [&](std::size_t k) { return mesh.points[mesh.cell(c)[k]]; };
    inside.add(signed_measure(mesh, c), p(1) - p(0), p(2) - p(0), p(3) - p(0));
    for (const auto& face : faces_of(CellKind::tetrahedron)) {
      const auto q = [&](std::size_t k) { return p(static_cast<std::size_t>(face[k])); };
      // this cell's face is the map's face at the dart whose facet starts there: six darts a face, in the same order
      const auto number = static_cast<std::uint32_t>(&face - faces_of(CellKind::tetrahedron).data());
      if (!built.map.is_free<3>(Dart{built.first_dart[c] + 6 * number})) continue;
      through.add(q(0).cross(q(1)).dot(q(2)) / 6.0, q(0), q(1), q(2));
      // convex: no point is outside of a face of the hull, except for rounding in the test
      Sum height;
      for (const auto& r : mesh.points) {
        height = {};
        height.add((q(1) - q(0)).cross(q(2) - q(0)).dot(r - q(0)) / 6.0, q(1) - q(0), q(2) - q(0), r - q(0));
        ASSERT_LE(height.value, height.bound());
      }
    }
  }
  EXPECT_NEAR(inside.value, through.value, inside.bound() + through.bound());
  EXPECT_LT(inside.value, 4.18880);  // 4 pi / 3 = 4.18879...
}

INSTANTIATE_TEST_SUITE_P(Sizes, DelaunayBall,
                         testing::Values(std::array{4, 1}, std::array{5, 1}, std::array{40, 1}, std::array{250, 2},
                                         std::array{2000, 3}));

TEST(DelaunayBallSeeds, RepeatAndDiffer) {
  EXPECT_EQ(hash_of(delaunay_ball(250, 2)), hash_of(delaunay_ball(250, 2)));
  EXPECT_NE(hash_of(delaunay_ball(250, 2)), hash_of(delaunay_ball(250, 3)));
  EXPECT_EQ(hash_of(delaunay_ball(250, 2)), 8237004307286378007u);
  EXPECT_THROW(delaunay_ball(3, 0), InputError);
}

TEST(DelaunayMeshes, HaveAsManyPointsAsTheirNamesSay) {
  for (const NamedMesh& named : delaunay_meshes()) {
    const std::string count = std::to_string(named.make().points.size());
    EXPECT_EQ(named.name, "delaunay_ball_" + count);
    EXPECT_NE(std::string(named.what).find("of " + count + " random points"), std::string::npos) << named.what;
  }
}

TEST(DelaunayMeshes, AreSmall) {
  EXPECT_EQ(delaunay_meshes().size(), 2u);
  for (const NamedMesh& named : delaunay_meshes()) {
    EXPECT_GE(named.make().cell_count(), 100u) << named.name;
    EXPECT_LE(named.make().cell_count(), 2000u) << named.name;
  }
}

}  // namespace
}  // namespace dartboard::delaunay_ball_test
