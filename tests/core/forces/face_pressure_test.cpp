// Pressures on faces that move: forces, work, and tangents.

#include "core/forces/face_pressure.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/eigenvalues.h"
#include "core/plain/random.h"
#include "core/views/pressed_faces.h"

namespace dartboard::face_pressure_test {
namespace {

using Eigen::Vector3d;

/// Faces of a box that is displaced at random, and velocities.
struct Pressed {
  Mesh mesh = mixed_box(2, 2, 2, 0.5);
  std::vector<PressedFace> rows = outer_faces(mesh);
  std::vector<double> pressure{-3.0, 5.0};
  std::vector<Vector3d> x = mesh.points, w = x;
  FacePressureTerm term{rows, pressure};

  explicit Pressed(bool all_round) {
    SplitMix64 random(7);
    for (auto* column : {&x, &w})
      for (Vector3d& place : *column)
        for (double& c : place) c += 0.2 * random.next_signed();
    if (!all_round) rows.resize(rows.size() / 3);
    if (!all_round)
      for (std::size_t k = 0; k < rows.size(); k += 2) rows[k].force = 1;
  }
  Pressed(const Pressed&) = delete;

  Eigen::VectorXd forces(const StagePlaces& at) const {
    std::vector<Vector3d> f(x.size(), Vector3d(0, 0, 0));
    term.add_forces(at, f);
    return Eigen::Map<const Eigen::VectorXd>(f[0].data(), static_cast<Eigen::Index>(3 * f.size()));
  }
  Eigen::MatrixXd tangent(Compression compression) const {
    const auto n = static_cast<Eigen::Index>(3 * x.size());
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    term.for_each_tangent({x}, compression, [&sum](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
      for (std::size_t a = 0, k = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b, ++k) {
          sum.block<3, 3>(3 * nodes[a], 3 * nodes[b]) += blocks[k];
          if (a != b) sum.block<3, 3>(3 * nodes[b], 3 * nodes[a]) += blocks[k].transpose();
        }
    });
    return sum;
  }
};

TEST(FacePressure, HasTheSymmetricPartOfItsDerivativeAsTangent) {
  for (const bool all_round : {true, false}) {
    Pressed p(all_round);
    const auto n = static_cast<Eigen::Index>(3 * p.x.size());
    Eigen::MatrixXd derivative(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      // forces are quadratic in the places, so central differences have no error but rounding
      auto ahead = p.x, behind = p.x;
      ahead[static_cast<std::size_t>(k / 3)][k % 3] += 0.125;
      behind[static_cast<std::size_t>(k / 3)][k % 3] -= 0.125;
      derivative.col(k) = -(p.forces({ahead}) - p.forces({behind})) / 0.25;
    }
    EXPECT_EQ((derivative - derivative.transpose()).norm() < 1e-12, all_round);
    EXPECT_LE((p.tangent(Compression::exact) - 0.5 * (derivative + derivative.transpose())).norm(), 1e-12);
    const Eigen::MatrixXd projected = p.tangent(Compression::projected);
    EXPECT_GT(projected.norm(), 1.0);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected).eigenvalues()[0], -1e-12);
  }
}

TEST(FacePressure, ChangesTheEnergyByTheWorkOnTheWay) {
  const Pressed p(false);
  // Simpson's rule is exact for the work, a cubic along a line
  double work = 0.0;
  for (const auto& [t, weight] : {std::pair(0.25, 1.0), {0.5, 4.0}, {0.75, 1.0}}) {
    const Eigen::VectorXd f = p.forces({p.x, p.w, t});
    for (std::size_t k = 0; k < p.x.size(); ++k)
      work += 0.5 * weight / 6.0 * f.segment<3>(static_cast<Eigen::Index>(3 * k)).dot(p.w[k]);
  }
  const EnergyChange change = p.term.energy_change({p.x, p.w, 0.25}, p.w, 0.5);
  EXPECT_NEAR(change.value, -work, 1e-13 * change.sizes);

  std::vector<Vector3d> discrete(p.x.size(), Vector3d(0, 0, 0)), end = p.x;
  p.term.add_discrete_forces({p.x, p.w, 0.25}, discrete);
  double of_discrete = 0.0;
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    of_discrete += 0.5 * discrete[k].dot(p.w[k]);
    end[k] += 0.5 * p.w[k];
  }
  EXPECT_NEAR(of_discrete, -p.term.energy_change({p.x}, p.w, 0.5).value, 1e-13 * change.sizes);

  Pressed again(false);
  again.term.begin_step(again.x);
  EXPECT_NEAR(again.term.work(end), of_discrete, 1e-13 * change.sizes);
}

TEST(FacePressure, HasThePowerOfSomeOfItsFaces) {
  const Pressed p(false);
  std::vector<std::uint32_t> all(p.rows.size()), first(all);
  std::iota(all.begin(), all.end(), 0u);
  const Eigen::VectorXd f = p.forces({p.x});
  double expected = 0.0;
  for (std::size_t k = 0; k < p.x.size(); ++k) expected += f.segment<3>(static_cast<Eigen::Index>(3 * k)).dot(p.w[k]);
  EXPECT_NEAR(p.term.power(all, p.x, p.w), expected, 1e-12);
  const std::vector<std::uint32_t> one{2}, rest = [&] {
    auto others = all;
    others.erase(others.begin() + 2);
    return others;
  }();
  EXPECT_NEAR(p.term.power(one, p.x, p.w) + p.term.power(rest, p.x, p.w), expected, 1e-12);
}

// Near rest, under the largest pressure that a face is meant for.
TEST(FacePressure, HasAConstantTangentThatIsAtLeastAsStiff) {
  Pressed p(true);
  p.x = p.mesh.points;
  for (PressedFace& row : p.rows) row.stiffness *= 3.0;
  const Eigen::MatrixXd exact = p.tangent(Compression::exact);
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(exact.rows());
  p.term.for_each_constant_tangent([&bound](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
    for (std::size_t a = 0; a < nodes.size(); ++a) bound.segment<3>(3 * nodes[a]) += blocks[a * (a + 3) / 2].diagonal();
  });
  const Eigen::MatrixXd stiffer = bound.asDiagonal();
  for (const double sign : {1.0, -1.0})
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(stiffer - sign * exact)).eigenvalues()[0],
              -1e-14);  // 0 within
}

// A coordinate that is rounded moves the force by at most what its size says.
TEST(FacePressure, HasForcesAsExactAsTheirSizesSay) {
  const Pressed p(false);
  std::vector<double> size(p.x.size(), 0.0);
  const StagePlaces at{p.x, p.w, 0.25};
  p.term.add_force_sizes(at, size);
  const Eigen::VectorXd f = p.forces(at);
  std::vector<Eigen::Matrix<long double, 3, 1>> exact(p.x.size(), Eigen::Matrix<long double, 3, 1>(0, 0, 0));
  const auto line = [&](std::uint32_t i, std::uint32_t j) {
    return Eigen::Matrix<long double, 3, 1>((p.x[j] - p.x[i]).cast<long double>() +
                                            0.25L * (p.w[j] - p.w[i]).cast<long double>());
  };
  for (const PressedFace& face : p.rows) {
    const std::uint32_t n = face.count;
    for (std::uint32_t a = 0; a < n; ++a) {  // a third of the area of each triangle, or the mean of both splits
      Eigen::Matrix<long double, 3, 1> all(0, 0, 0);
      for (std::uint32_t k = 1; k + 1 < n; ++k)
        all += line(face.corner[0], face.corner[k]).cross(line(face.corner[0], face.corner[k + 1]));
      const auto corner =
          line(face.corner[a], face.corner[(a + 1) % n]).cross(line(face.corner[a], face.corner[(a + n - 1) % n]));
      const long double by = -static_cast<long double>(p.pressure[face.force]);
      exact[face.corner[a]] += n == 3 ? Eigen::Matrix<long double, 3, 1>(by / 6 * all)
                                      : Eigen::Matrix<long double, 3, 1>(by / 12 * (all + corner));
    }
  }
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const double error =
        static_cast<double>((f.segment<3>(static_cast<Eigen::Index>(3 * k)).cast<long double>() - exact[k]).norm());
    EXPECT_LE(error, 2 * std::numeric_limits<double>::epsilon() * size[k]) << k;
  }
}

}  // namespace
}  // namespace dartboard::face_pressure_test
