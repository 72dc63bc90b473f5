// A force written as the energy, force and tangent of a piece has all that a force term needs.

#include "core/forces/piece_term.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/plain/eigenvalues.h"
#include "tests/support/bodies/term_checks_for_tests.h"

namespace dartboard::piece_term_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Places = std::span<const Vector3d>;

/// k / (8 L^2) (d^2 - L^2)^2 of the line d between two vertices.
struct QuarticSprings {
  std::vector<std::array<std::uint32_t, 2>> ends;
  double stiffness_of_each = 3.0, length = 0.5;

  static constexpr bool is_internal = true;
  std::string_view name() const { return "quartic springs"; }
  std::size_t size() const { return ends.size(); }
  ForceTerm::Nodes nodes(std::size_t k) const { return ends[k]; }
  double excess(Places x) const { return (x[1] - x[0]).squaredNorm() - length * length; }
  double scale() const { return stiffness_of_each / (2.0 * length * length); }
  double energy(std::size_t, Places x) const { return 0.25 * scale() * excess(x) * excess(x); }
  void add_forces(std::size_t, Places x, std::span<Vector3d> force) const {
    const Vector3d f = scale() * excess(x) * (x[1] - x[0]);
    force[0] += f;
    force[1] -= f;
  }
  void add_tangent(std::size_t, Places x, std::span<Matrix3d> blocks) const {
    const Vector3d d = x[1] - x[0];
    const Matrix3d k = scale() * (excess(x) * Matrix3d::Identity() + 2.0 * d * d.transpose());
    blocks[0] += k;
    blocks[1] -= k;
    blocks[2] += k;
  }
  double stiffness(std::size_t) const { return 2.0 * stiffness_of_each; }
};

/// Linear springs from vertices to fixed places.
struct Tethers {
  std::vector<std::uint32_t> vertex;
  Vector3d place{1, 2, 3};
  double k = 5.0;

  static constexpr bool is_internal = false;
  std::string_view name() const { return "tethers"; }
  std::size_t size() const { return vertex.size(); }
  ForceTerm::Nodes nodes(std::size_t piece) const { return {&vertex[piece], 1}; }
  double energy(std::size_t, Places x) const { return 0.5 * k * (x[0] - place).squaredNorm(); }
  void add_forces(std::size_t, Places x, std::span<Vector3d> force) const { force[0] -= k * (x[0] - place); }
  void add_tangent(std::size_t, Places, std::span<Matrix3d> blocks) const { blocks[0] += k * Matrix3d::Identity(); }
  double stiffness(std::size_t) const { return k; }
};

const std::vector<Vector3d> triangle{{0.1, 0, 0}, {0.6, 0.2, -0.1}, {0.2, 0.6, 0.15}};
const PieceTerm<QuarticSprings> springs(QuarticSprings{{{0, 1}, {1, 2}, {2, 0}}});

TEST(PieceTerm, HasForcesTangentsAndChangesThatAreThoseOfItsEnergy) { expect_consistent(springs, triangle, 0.5); }

TEST(PieceTerm, NamesItsPiecesAndTheirVertices) {
  EXPECT_EQ(springs.pieces_name(), "quartic springs");
  EXPECT_EQ(springs.size(), 3u);
  EXPECT_EQ(std::vector<std::uint32_t>(springs.nodes(2).begin(), springs.nodes(2).end()),
            (std::vector<std::uint32_t>{2, 0}));
  EXPECT_EQ(springs.damping(), nullptr);
}

TEST(PieceTerm, OfForcesFromOutsidePullsAndResistsAsItsPiecesDo) {
  const PieceTerm<Tethers> tethers(Tethers{{2, 0}});
  const std::vector<Vector3d> force = forces_of(tethers, triangle);
  EXPECT_EQ(force[0], Vector3d(5.0 * (Vector3d(1, 2, 3) - triangle[0])));
  EXPECT_EQ(force[1], Vector3d(0, 0, 0));
  const std::vector<Vector3d> w{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(product_of(tethers, triangle, w)[2], Vector3d(35, 40, 45));
  EXPECT_EQ(tethers.virial(triangle, 0).tensor, Matrix3d::Zero());
}

TEST(PieceTerm, LosesTheEnergyThatItsDiscreteForcesDoAsWork) {
  const PieceTerm<Tethers> tethers(Tethers{{0, 1, 2}});
  const std::vector<Vector3d> w{{1, -2, 0.5}, {0.25, 1, 1}, {-1, 0, 2}};
  for (const ForceTerm* term : {static_cast<const ForceTerm*>(&springs), static_cast<const ForceTerm*>(&tethers)}) {
    std::vector<Vector3d> force(3, Vector3d(0, 0, 0));
    const double t = 0.25;
    term->add_discrete_forces({triangle, w, t / 2}, force);
    const double before = term->energy(triangle), after = term->energy(moved(triangle, w, t));
    EXPECT_GT(std::abs(after - before), 0.01 * before);
    EXPECT_NEAR(dot(force, w) * t, before - after, 1e-14 * (before + after)) << term->pieces_name();
  }
}

TEST(PieceTerm, OfInternalPiecesKeepsMomentumByItsDiscreteForces) {
  const std::vector<Vector3d> w{{1, -2, 0.5}, {0.25, 1, 1}, {-1, 0, 2}};
  std::vector<Vector3d> force(3, Vector3d(0, 0, 0));
  springs.add_discrete_forces({triangle, w, 0.25}, force);
  EXPECT_LE((force[0] + force[1] + force[2]).norm(), 1e-15 * size_of(force));
}

TEST(PieceTerm, ProjectsATangentThatIsNegativeSomewhere) {
  const PieceTerm<QuarticSprings> one(QuarticSprings{{{0, 1}}});
  const std::vector<Vector3d> pressed{{0, 0, 0}, {0.1, 0.05, 0}};
  const auto lowest = [&](Compression compression) {
    Eigen::Matrix<double, 6, 6> whole;
    one.for_each_tangent({pressed}, compression, [&](ForceTerm::Nodes, std::span<const Matrix3d> blocks) {
      whole << blocks[0], blocks[1].transpose(), blocks[1], blocks[2];
    });
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(whole)).eigenvalues().minCoeff();
  };
  EXPECT_LT(lowest(Compression::exact), -1.0);
  EXPECT_GT(lowest(Compression::projected), -1e-14);
}

TEST(PieceTerm, HasTheVirialOfTheStretchOfItsPieces) {
  const PieceTerm<QuarticSprings> one(QuarticSprings{{{0, 1}}});
  const Virial share = one.virial(triangle, 0);
  const Vector3d d = triangle[1] - triangle[0];
  const double tension = 3.0 / 0.5 * (d.squaredNorm() - 0.25);  // over the length
  EXPECT_LE((share.tensor - 0.5 * tension * d * d.transpose()).norm(), 1e-15 * share.tensor.norm());
}

}  // namespace
}  // namespace dartboard::piece_term_test
