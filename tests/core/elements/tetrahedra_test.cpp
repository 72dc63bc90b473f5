#include "core/elements/tetrahedra.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::tetrahedra_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ElementBody box(Model model, double jitter = 0.2) {
  return ElementBody(kuhn_box(3, 2, 2, 0.1, jitter, 7), model, 2e4, 0.3);
}
std::vector<Vector3d> forces_of(const ElementBody& body) {
  std::vector<Vector3d> force(body.x.size(), Vector3d(0, 0, 0));
  body.term->add_forces({body.x}, force);
  return force;
}
bool is_inside(const Vector3d& rest) {
  return rest[0] > 0.01 && rest[0] < 0.29 && rest[1] > 0.01 && rest[1] < 0.19 && rest[2] > 0.01 && rest[2] < 0.19;
}

// The patch test: every tetrahedron has the same F and the same stress, whatever its shape, so that forces within
// cancel. Sums of some 24 forces, each rounded.
TEST(Tetrahedra, AreInEquilibriumInsideABodyOfUniformStrain) {
  Matrix3d f;
  f << 1.2, 0.1, -0.2, 0.05, 0.9, 0.1, 0.0, -0.1, 1.1;
  for (const Model model : element_models) {
    ElementBody body = box(model);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] = f * body.rest[i];
    const auto force = forces_of(body);
    double inside = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i)
      (is_inside(body.rest[i]) ? inside : outside) =
          std::max(is_inside(body.rest[i]) ? inside : outside, force[i].norm());
    EXPECT_GT(outside, 1.0);
    EXPECT_LE(inside, 1e-13 * outside) << name(model);
    // and the virial of every vertex is that stress: V P F' of its share of the volume
    Matrix3d sum = Matrix3d::Zero();
    double volume = 0.0;
    for (std::size_t c = 0; c < body.term->size(); ++c) {
      sum += 4.0 * body.term->virial(body.x, c).tensor;
      volume += body.cell_mass[c] / body.material.density;
    }
    const Matrix3d one = 4.0 * body.term->virial(body.x, 0).tensor / (body.cell_mass[0] / body.material.density);
    EXPECT_LE((sum / volume - one).norm(), 1e-13 * one.norm());
  }
}

TEST(Tetrahedra, PullWithoutNetForceOrTorque) {
  for (const Model model : element_models) {
    ElementBody body = box(model);
    body.shake(0.03, 3);
    expect_no_net_pull(forces_of(body), body.x, name(model));
  }
}

// Central differences of step d: errors of d^2 and of rounding over d.
TEST(Tetrahedra, PullAlongTheSlopeOfTheirEnergy) {
  for (const Model model : element_models) {
    ElementBody body = box(model);
    body.shake(0.02, 4);
    const auto force = forces_of(body);
    double largest = 0.0;
    for (const Vector3d& f : force) largest = std::max(largest, f.norm());
    for (const std::size_t i : {0ul, 7ul, 20ul})
      for (int c = 0; c < 3; ++c) {
        const double x = body.x[i][c], d = 1e-6;
        body.x[i][c] = x + d;
        const double up = body.term->energy(body.x);
        body.x[i][c] = x - d;
        const double down = body.term->energy(body.x);
        body.x[i][c] = x;
        EXPECT_NEAR(force[i][c], -(up - down) / (2 * d), 1e-8 * largest) << name(model);
      }
  }
}

// The corners may be listed in any order, also the ones that turn the tetrahedron inside out.
TEST(Tetrahedra, DoNotDependOnTheOrderOfTheirCorners) {
  for (const Model model : element_models) {
    ElementBody body = box(model), other = box(model);
    body.shake(0.02, 8);
    other.x = body.x;
    for (std::size_t c = 0; c < other.nodes.size(); ++c) {
      std::swap(other.nodes[c][0], other.nodes[c][c % 3 + 1]);
      const auto& n = other.nodes[c];
      other.shape[c] = rest_shape_of(other.rest[n[0]], other.rest[n[1]], other.rest[n[2]], other.rest[n[3]]);
    }
    const auto force = forces_of(body), same = forces_of(other);
    for (std::size_t i = 0; i < force.size(); ++i)
      EXPECT_LE((force[i] - same[i]).norm(), 1e-12 * 2e4 * 0.01) << name(model);
  }
}

TEST(Tetrahedra, SumTheEnergyOfAShareOfThemFromAnyStart) {
  ElementBody body = box(Model::neo_hookean);
  body.shake(0.02, 9);
  double sum = 0.0;
  for (std::size_t first = 0; first < 5; ++first) sum += body.term->energy(body.x, first, 5);
  EXPECT_NEAR(sum, body.term->energy(body.x), 1e-13 * sum);
}

// Positions along a step: the same as the positions themselves, to rounding.
TEST(Tetrahedra, PullHalfWayAsTheyWouldThere) {
  for (const Model model : element_models) {
    ElementBody body = box(model);
    body.shake(0.01, 10);
    std::vector<Vector3d> w(body.x.size()), moved(body.x.size());
    SplitMix64 random(11);
    for (std::size_t i = 0; i < w.size(); ++i) {
      for (double& c : w[i]) c = random.next_signed();
      moved[i] = body.x[i] + 0.01 * w[i];
    }
    std::vector<Vector3d> force(w.size(), Vector3d(0, 0, 0)), there(w.size(), Vector3d(0, 0, 0));
    body.term->add_forces({body.x, w, 0.01}, force);
    body.term->add_forces({moved}, there);
    for (std::size_t i = 0; i < w.size(); ++i) EXPECT_LE((force[i] - there[i]).norm(), 1e-11) << name(model);
    const EnergyChange change = body.term->energy_change({body.x}, w, 0.01);
    EXPECT_NEAR(change.value, body.term->energy(moved) - body.term->energy(body.x), 1e-12 * 2e4 * 0.01);
    // the work of the discrete force is the loss of energy
    std::vector<Vector3d> discrete(w.size(), Vector3d(0, 0, 0));
    body.term->add_discrete_forces({body.x, w, 0.005}, discrete);
    double work = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i) work += discrete[i].dot(0.01 * w[i]);
    EXPECT_NEAR(work, -change.value, 1e-13 * 2e4 * 0.01);
    std::vector<std::uint32_t> all(body.term->size());
    for (std::uint32_t c = 0; c < all.size(); ++c) all[c] = c;
    double power = 0.0;
    const auto now = forces_of(body);
    for (std::size_t i = 0; i < w.size(); ++i) power += now[i].dot(w[i]);
    EXPECT_NEAR(body.term->power(all, body.x, w), power, 1e-12 * std::abs(power) + 1e-12);
  }
}

TEST(RestShape, OfAFlatTetrahedronIsNotFinite) {
  EXPECT_FALSE(rest_shape_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}).allFinite());
  EXPECT_TRUE(rest_shape_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-12}).allFinite());
}

}  // namespace
}  // namespace dartboard::tetrahedra_test
