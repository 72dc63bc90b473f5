#include "core/elements/solids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <tuple>

#include "core/elements/tetrahedra.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/eigenvalues.h"
#include "core/plain/random.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::solids_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Material material_of(Model model) {
  return {.density = 1000.0, .stiffness = 0.0, .damping = 0.0, .young = 2e4, .poisson = 0.3, .model = model};
}

/// Cells of a mesh as elements.
struct SolidBody {
  Material material;
  std::vector<Vector3d> rest, x;
  std::vector<SolidNodes> nodes;
  std::vector<SolidShape> shape;
  std::unique_ptr<ForceTerm> term;

  SolidBody(const Mesh& mesh, Model model) : material(material_of(model)), rest(mesh.points), x(mesh.points) {
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      SolidNodes n;
      std::vector<Vector3d> corners;
      for (const std::uint32_t p : mesh.cell(c)) {
        n.at[n.count++] = p;
        corners.push_back(mesh.points[p]);
      }
      nodes.push_back(n);
      shape.push_back(solid_shape_of(mesh.kinds[c], corners));
    }
    term = make_solids(material, {nodes, shape});
  }
  std::vector<Vector3d> forces() const {
    std::vector<Vector3d> force(x.size(), Vector3d(0, 0, 0));
    term->add_forces({x}, force);
    return force;
  }
  void shake(double size, std::uint64_t seed) {
    SplitMix64 random(seed);
    for (Vector3d& p : x)
      for (double& c : p) c += size * random.next_signed();
  }
};

/// All four kinds of cell, their points moved so that no face of four is flat.
Mesh crooked() {
  Mesh mesh = mixed_box(3, 3, 3, 0.1);
  SplitMix64 random(3);
  for (Vector3d& p : mesh.points)
    for (double& c : p) c += 0.008 * random.next_signed();
  return mesh;
}
bool is_inside(const Vector3d& p) { return (p.array() > 0.02).all() && (p.array() < 0.28).all(); }

TEST(Solids, AreOfEveryKind) {
  std::array<int, 6> met{};
  for (const CellKind kind : crooked().kinds) ++met[static_cast<std::size_t>(kind)];
  for (const CellKind kind : {CellKind::tetrahedron, CellKind::pyramid, CellKind::prism, CellKind::hexahedron})
    EXPECT_GT(met[static_cast<std::size_t>(kind)], 0);
}

// Gauss points integrate the volume that the shape functions fill: faces of four points are ruled surfaces on both
// sides, so that neighbours leave no gap and the volumes add up to that of the box.
TEST(Solids, FillTheBodyThatTheyAreOf) {
  Mesh mesh = mixed_box(3, 3, 3, 0.1);
  SplitMix64 random(4);
  for (Vector3d& p : mesh.points)
    if (is_inside(p))
      for (double& c : p) c += 0.008 * random.next_signed();
  const SolidBody body(mesh, Model::stvk);
  double volume = 0.0;
  for (const SolidShape& shape : body.shape)
    for (std::size_t q = 0; q < gauss_points(shape.kind); ++q) {
      EXPECT_GT(shape.volume[q], 0.0);
      volume += shape.volume[q];
    }
  EXPECT_NEAR(volume, 0.027, 1e-15);
}

// The patch test: whatever the shapes, a uniform strain pulls nowhere inside.
TEST(Solids, AreInEquilibriumInsideABodyOfUniformStrain) {
  Matrix3d f;
  f << 1.2, 0.1, -0.2, 0.05, 0.9, 0.1, 0.0, -0.1, 1.1;
  for (const Model model : element_models) {
    SolidBody body(crooked(), model);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] = f * body.rest[i];
    const auto force = body.forces();
    double inside = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      double& largest = is_inside(body.rest[i]) ? inside : outside;
      largest = std::max(largest, force[i].norm());
    }
    EXPECT_GT(outside, 1.0);
    EXPECT_LE(inside, 1e-13 * outside) << name(model);
  }
}

TEST(Solids, PullWithoutNetForceOrTorque) {
  for (const Model model : element_models) {
    SolidBody body(crooked(), model);
    body.shake(0.02, 5);
    expect_no_net_pull(body.forces(), body.x, name(model));
  }
}

TEST(Solids, PullAlongTheSlopeOfTheirEnergyAndStiffenAsTheyDo) {
  for (const Model model : element_models) {
    SolidBody body(crooked(), model);
    body.shake(0.01, 6);
    const auto force = body.forces();
    double largest = 0.0;
    for (const Vector3d& f : force) largest = std::max(largest, f.norm());
    SplitMix64 random(7);
    std::vector<Vector3d> w(body.x.size()), product(body.x.size(), Vector3d(0, 0, 0));
    for (Vector3d& v : w)
      for (double& c : v) c = random.next_signed();
    body.term->for_each_tangent({body.x}, Compression::exact,
                                [&](ForceTerm::Nodes n, std::span<const Matrix3d> blocks) {
                                  for (std::size_t a = 0, k = 0; a < n.size(); ++a)
                                    for (std::size_t b = 0; b <= a; ++b, ++k) {
                                      product[n[a]] += blocks[k] * w[n[b]];
                                      if (b < a) product[n[b]] += blocks[k].transpose() * w[n[a]];
                                    }
                                });
    const double d = 1e-7;
    SolidBody up = SolidBody(crooked(), model), down = SolidBody(crooked(), model);
    double power = 0.0, size = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      up.x[i] = body.x[i] + d * w[i];
      down.x[i] = body.x[i] - d * w[i];
      power += force[i].dot(w[i]);
      size += force[i].norm();
    }
    EXPECT_NEAR((down.term->energy(down.x) - up.term->energy(up.x)) / (2 * d), power, 1e-8 * size) << name(model);
    const auto f_up = up.forces(), f_down = down.forces();
    double worst = 0.0, stiffest = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      worst = std::max(worst, ((f_down[i] - f_up[i]) / (2 * d) - product[i]).norm());
      stiffest = std::max(stiffest, product[i].norm());
    }
    EXPECT_LE(worst, 1e-6 * stiffest) << name(model);
    // discrete gradients and changes of energy go by the same points
    const EnergyChange change = body.term->energy_change({body.x}, w, 0.01);
    std::vector<Vector3d> moved(w.size()), discrete(w.size(), Vector3d(0, 0, 0));
    for (std::size_t i = 0; i < w.size(); ++i) moved[i] = body.x[i] + 0.01 * w[i];
    EXPECT_NEAR(change.value, body.term->energy(moved) - body.term->energy(body.x), 1e-12 * 2e4);
    body.term->add_discrete_forces({body.x, w, 0.005}, discrete);
    double work = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i) work += discrete[i].dot(0.01 * w[i]);
    EXPECT_NEAR(work, -change.value, 1e-12 * 2e4);
    std::vector<std::uint32_t> all(body.term->size());
    for (std::uint32_t c = 0; c < all.size(); ++c) all[c] = c;
    EXPECT_NEAR(body.term->power(all, body.x, w), power, 1e-12 * size);
  }
}

// For u = e (x z, 0, 0), which prisms and hexahedra can follow, the linear energy is mu e^2 (z^2 + x^2 / 2) + lambda /
// 2 e^2 z^2: points that are exact for squares only have its integral. Of the prism over (0, 0), (1, 0), (0, 1) and |z|
// < 1/2, the squares of x and z integrate to 1/12 and 1/24; of the unit cube around the origin both to 1/12.
TEST(Solids, HaveTheEnergyOfABendExactly) {
  const Lame lame = lame_of(2e4, 0.3);
  Mesh prism, cube = hexahedron_box(1, 1, 1, 1.0);
  prism.points = {{0, 0, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}, {0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}};
  const std::array<std::uint32_t, 6> corners{0, 1, 2, 3, 4, 5};
  prism.add_cell(CellKind::prism, corners);
  for (Vector3d& p : cube.points) p -= Vector3d(0.5, 0.5, 0.5);
  for (const auto& [mesh, xx, zz] : {std::tuple{prism, 1.0 / 12, 1.0 / 24}, {cube, 1.0 / 12, 1.0 / 12}}) {
    SolidBody body(mesh, Model::stvk);
    const double e = 1e-5;
    for (Vector3d& x : body.x) x[0] += e * x[0] * x[2];
    const double linear = e * e * (lame.mu * (zz + xx / 2) + lame.lambda / 2 * zz);
    EXPECT_NEAR(body.term->energy(body.x) / linear, 1.0, 10 * e);  // third orders
  }
}

// A tetrahedron among other cells is the same as one of a mesh of tetrahedra.
TEST(Solids, OfTetrahedraAreTetrahedra) {
  const Mesh mesh = kuhn_box(2, 2, 2, 0.1, 0.2, 7);
  for (const Model model : element_models) {
    ElementBody tetrahedra(mesh, model, 2e4, 0.3);
    Mesh upright = mesh;  // right-handed, as bodies list them
    for (std::size_t c = 0; c < upright.cell_count(); ++c)
      if (signed_measure(upright, c) < 0.0) std::swap(upright.nodes[4 * c], upright.nodes[4 * c + 1]);
    SolidBody solids(upright, model);
    tetrahedra.shake(0.02, 8);
    solids.x = tetrahedra.x;
    std::vector<Vector3d> force(mesh.points.size(), Vector3d(0, 0, 0));
    tetrahedra.term->add_forces({tetrahedra.x}, force);
    const auto same = solids.forces();
    for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LE((force[i] - same[i]).norm(), 1e-11) << name(model);
  }
}

// A bent cube shows whether integration is full: with one point it would have hourglass modes.
TEST(Solids, ResistEveryShapeButRigidMotions) {
  Mesh mesh = hexahedron_box(1, 1, 1, 0.1);
  SolidBody body(mesh, Model::corotational);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(24, 24);
  body.term->for_each_tangent({body.x}, Compression::exact, [&](ForceTerm::Nodes n, std::span<const Matrix3d> blocks) {
    for (Eigen::Index a = 0, k = 0; a < 8; ++a)
      for (Eigen::Index b = 0; b <= a; ++b, ++k) {
        const auto i = static_cast<Eigen::Index>(n[static_cast<std::size_t>(a)]),
                   j = static_cast<Eigen::Index>(n[static_cast<std::size_t>(b)]);
        stiffness.block<3, 3>(3 * i, 3 * j) = blocks[static_cast<std::size_t>(k)];
        stiffness.block<3, 3>(3 * j, 3 * i) = blocks[static_cast<std::size_t>(k)].transpose();
      }
  });
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_LT(values[5], 1e-9 * values[23]);
  EXPECT_GT(values[6], 1e-2 * values[23]);
}

TEST(SolidShape, OfACellThatIsTurnedInsideOutHasANegativeVolume) {
  const Mesh mesh = hexahedron_box(1, 1, 1, 1.0);
  std::vector<Vector3d> x;
  for (const std::uint32_t p : mesh.cell(0)) x.push_back(mesh.points[p]);
  EXPECT_NEAR(solid_shape_of(CellKind::hexahedron, x).volume[3], 0.125, 1e-15);
  std::swap(x[0], x[1]);
  EXPECT_LT(solid_shape_of(CellKind::hexahedron, x).volume[0], 0.0);
}

}  // namespace
}  // namespace dartboard::solids_test
