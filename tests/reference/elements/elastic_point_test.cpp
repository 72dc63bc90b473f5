#include "reference/elements/elastic_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "reference/elements/cell_energy.h"

namespace dartboard::reference::elastic_point_test {
namespace {

Material solid() { return {.density = 1.0, .young = 10.0, .poisson = 0.3, .model = Model::neo_hookean}; }

Mesh jittered(Mesh mesh) {
  SplitMix64 random(9);
  for (Eigen::Vector3d& p : mesh.points) p += 0.1 * random.next_in_ball();
  return mesh;
}
std::vector<long double> moved(const Mesh& mesh) {
  SplitMix64 random(10);
  std::vector<long double> x;
  for (const Eigen::Vector3d& p : mesh.points)
    for (const double c : p) x.push_back(1.2L * c + 0.1L * random.next_signed());
  return x;
}
long double energy(const std::vector<ElasticPoint>& points, const std::vector<long double>& x) {
  long double sum = 0;
  for (const ElasticPoint& p : points) sum += p.volume * energy_density(p.law, deformation(p, x.data()));
  return sum;
}

TEST(ElasticPoint, OfATetrahedronIsItsEnergy) {
  const Mesh mesh = jittered(kuhn_box(1, 1, 1, 1.0));
  const std::vector<long double> x = moved(mesh);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    std::array<Eigen::Vector3d, 4> rest, now;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t node = mesh.cell(c)[k];
      rest[k] = mesh.points[node];
      for (std::size_t i = 0; i < 3; ++i) now[k][static_cast<Eigen::Index>(i)] = static_cast<double>(x[3 * node + i]);
    }
    // places rounded to double: some 1e-16 of the stress of order 10
    EXPECT_NEAR(static_cast<double>(energy(elastic_points(mesh, c, solid()), x)),
                static_cast<double>(tetrahedron_energy(solid(), rest, now)), 1e-14);
  }
}

// An affine map has the same F everywhere, and the volume of a hexahedron is that of its trilinear image.
TEST(ElasticPoint, OfAHexahedronIsExactForAffineMaps) {
  const Mesh mesh = jittered(hexahedron_box(1, 1, 1, 1.0));
  const auto points = elastic_points(mesh, 0, solid());
  ASSERT_EQ(points.size(), 8u);
  Matrix3<long double> f;
  f << 1.1L, 0.2L, 0, 0.1L, 0.9L, 0.3L, 0, 0.1L, 1.2L;
  std::vector<long double> x;
  for (const Eigen::Vector3d& p : mesh.points) {
    const Eigen::Matrix<long double, 3, 1> image = f * p.cast<long double>();
    x.insert(x.end(), image.begin(), image.end());
  }
  for (const ElasticPoint& p : points) EXPECT_LT((deformation(p, x.data()) - f).norm(), 1e-17L);
}

TEST(ElasticPoint, PullsAsItsEnergyFalls) {
  for (const Mesh& mesh : {jittered(kuhn_box(1, 1, 1, 1.0)), jittered(hexahedron_box(1, 1, 1, 1.0))}) {
    const auto points = elastic_points(mesh, 0, solid());
    std::vector<long double> x = moved(mesh), force(x.size(), 0);
    for (const ElasticPoint& p : points) add_pull(p, stress(p.law, deformation(p, x.data())), force.data());
    for (std::size_t c = 0; c < x.size(); ++c) {
      const long double at = x[c], t = 1e-7L;
      x[c] = at + t;
      const long double above = energy(points, x);
      x[c] = at - t;
      // central differences: 1e2 t^2 and 1e-19 / t
      EXPECT_NEAR(static_cast<double>(force[c]), static_cast<double>((energy(points, x) - above) / (2 * t)), 1e-10);
      x[c] = at;
    }
  }
}

TEST(ElasticPoint, HasTheStiffnessThatItsPullHas) {
  const Mesh mesh = jittered(hexahedron_box(1, 1, 1, 1.0));
  const ElasticPoint point = elastic_points(mesh, 0, solid())[3];
  std::vector<long double> x = moved(mesh);
  const auto pull = [&] {
    std::vector<long double> force(x.size(), 0);
    add_pull(point, stress(point.law, deformation(point, x.data())), force.data());
    return force;
  };
  const StressSlope slope = stress_slope(point.law, deformation(point, x.data()));
  for (std::size_t b = 0; b < 8; ++b)
    for (std::size_t j = 0; j < 3; ++j) {
      long double& c = x[3 * std::size_t{point.corner[b]} + j];
      const long double at = c, t = 1e-7L;
      c = at + t;
      const auto above = pull();
      c = at - t;
      const auto below = pull();
      c = at;
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t row = 3 * std::size_t{point.corner[a]} + i;
          const auto block = stiffness_block(point, slope, a, b);
          EXPECT_NEAR(static_cast<double>(block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))),
                      static_cast<double>((below[row] - above[row]) / (2 * t)), 1e-9);
        }
    }
}

TEST(ElasticPoint, IsNotOfPyramidsAndSprings) {
  const Mesh mesh = mixed_box(2, 2, 2, 1.0);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.kinds[c] == CellKind::pyramid) {
      EXPECT_THROW(elastic_points(mesh, c, solid()), InputError);
    }
  }
  EXPECT_THROW(elastic_points(kuhn_box(1, 1, 1, 1.0), 0, Material{}), InputError);
}

// The power lost is 2 mu E':E' + lambda tr(E')^2 times volume and time, E' from the difference of Green's strains; a
// rotation loses nothing.
TEST(ElasticPoint, IsDampedByTheRateOfGreensStrain) {
  Material material = solid();
  material.damping_time = 0.5;
  for (const Mesh& mesh : {jittered(kuhn_box(1, 1, 1, 1.0)), jittered(hexahedron_box(1, 1, 1, 1.0))}) {
    const std::vector<long double> x = moved(mesh);
    SplitMix64 random(12);
    std::vector<long double> v;
    for (std::size_t c = 0; c < x.size(); ++c) v.push_back(random.next_signed());
    for (const ElasticPoint& p : elastic_points(mesh, 0, material)) {
      EXPECT_EQ(p.damping_time, 0.5L);
      const Matrix3<long double> f = deformation(p, x.data()), rate = deformation(p, v.data());
      const long double t = 1e-6L;
      const auto green = [](const Matrix3<long double>& at) { return Matrix3<long double>(at.transpose() * at / 2); };
      const Matrix3<long double> strain = (green(f + t * rate) - green(f - t * rate)) / (2 * t);
      const long double lost =
          0.5L * (2 * p.law.mu * strain.squaredNorm() + p.law.lambda * strain.trace() * strain.trace());
      EXPECT_NEAR(static_cast<double>(damping_stress(p, f, rate).cwiseProduct(rate).sum() / lost), 1.0, 1e-11);
      Matrix3<long double> spin;
      spin << 0, -3, 2, 3, 0, -1, -2, 1, 0;
      EXPECT_LT(damping_stress(p, f, Matrix3<long double>(spin * f)).norm(), 1e-16L);
      // its block is what the pull at one corner falls by with the velocity of another
      std::vector<long double> unit(x.size(), 0), pull(x.size(), 0);
      unit[3 * std::size_t{p.corner[2]} + 1] = 1;
      add_pull(p, damping_stress(p, f, deformation(p, unit.data())), pull.data());
      for (std::size_t a = 0; a < p.corner.size(); ++a)
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(static_cast<double>(damping_block(p, f, a, 2)(static_cast<Eigen::Index>(k), 1)),
                      static_cast<double>(-pull[3 * std::size_t{p.corner[a]} + k]), 1e-16);
    }
  }
}

TEST(ElasticPoint, HasSixStrainsThatMeetAMultipleOfThemselves) {
  const long double mu = 2, lambda = 3;
  for (int k = 0; k < 6; ++k) {
    const Matrix3<long double> n = unit_strain<long double>(k);
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(static_cast<double>(n.cwiseProduct(unit_strain<long double>(j)).sum()), j == k ? 1.0 : 0.0, 1e-18);
    const Matrix3<long double> stress = 2 * mu * n + lambda * n.trace() * Matrix3<long double>::Identity();
    EXPECT_LT((stress - (2 * mu + (k == 0 ? 3 * lambda : 0)) * n).norm(), 1e-17L);
  }
}

}  // namespace
}  // namespace dartboard::reference::elastic_point_test
