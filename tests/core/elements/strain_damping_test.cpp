#include "core/elements/strain_damping.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/material.h"
#include "core/plain/random.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::strain_damping_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double young = 2e4, poisson = 0.3, tau = 0.02;

Material damped(Model model = Model::neo_hookean, double time = tau, double ratio = poisson) {
  return {.density = 1000.0,
          .stiffness = 0.0,
          .damping = 0.0,
          .young = young,
          .poisson = ratio,
          .model = model,
          .damping_time = time};
}

/// Cells of a mesh as elements; a mesh of tetrahedra as those of core/elements/tetrahedra.h.
struct DampedBody {
  Material material;
  Vectors rest, x, v;
  std::vector<SolidNodes> nodes;
  std::vector<SolidShape> shape;
  std::vector<TetrahedronNodes> corners;
  std::vector<RestShape> tetrahedra;
  std::vector<double> mass;  // of cells
  std::unique_ptr<ForceTerm> term;
  double volume = 0.0;

  DampedBody(const Mesh& mesh, const Material& m, bool as_solids = true)
      : material(m), rest(mesh.points), x(mesh.points), v(mesh.points.size(), Vector3d(0, 0, 0)) {
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      SolidNodes n;
      Vectors at;
      for (const std::uint32_t p : mesh.cell(c)) {
        n.at[n.count++] = p;
        at.push_back(mesh.points[p]);
      }
      nodes.push_back(n);
      shape.push_back(solid_shape_of(mesh.kinds[c], at));
      double of_cell = 0.0;
      for (std::size_t q = 0; q < gauss_points(mesh.kinds[c]); ++q) of_cell += shape.back().volume[q];
      volume += of_cell;
      if (as_solids) continue;
      corners.push_back({n.at[0], n.at[1], n.at[2], n.at[3]});
      tetrahedra.push_back(rest_shape_of(at[0], at[1], at[2], at[3]));
      mass.push_back(m.density * of_cell);
    }
    term = as_solids ? make_solids(material, {nodes, shape}) : make_tetrahedra(material, {corners, tetrahedra, mass});
  }
  const TermDamping& damping() const { return *term->damping(); }
  Vectors forces() const {
    Vectors force(x.size(), Vector3d(0, 0, 0));
    damping().add_forces({x}, v, force);
    return force;
  }
  void shake(double size, double speed, std::uint64_t seed) {
    SplitMix64 random(seed);
    for (Vector3d& p : x)
      for (double& c : p) c += size * random.next_signed();
    for (Vector3d& p : v)
      for (double& c : p) c = speed * random.next_signed();
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
Mesh tetrahedra() { return kuhn_box(3, 2, 2, 0.1, 0.15, 5); }

std::array<DampedBody, 2> both(const Material& m = damped()) {
  return {DampedBody(crooked(), m), DampedBody(tetrahedra(), m, false)};
}

/// C v from the blocks.
Vectors product(const DampedBody& body, const Vectors& v) {
  Vectors result(v.size(), Vector3d(0, 0, 0));
  std::size_t piece = 0;
  body.damping().for_each_tangent({body.x}, [&](ForceTerm::Nodes n, std::span<const Matrix3d> blocks) {
    const double time = body.damping().time(piece++);
    for (std::size_t a = 0, k = 0; a < n.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b, ++k) {
        result[n[a]] += time * (blocks[k] * v[n[b]]);
        if (b < a) result[n[b]] += time * (blocks[k].transpose() * v[n[a]]);
      }
  });
  return result;
}
double dot(const Vectors& a, const Vectors& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}
std::vector<std::uint32_t> pieces_of(const DampedBody& body) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t k = 0; k < body.term->size(); ++k) all.push_back(k);
  return all;
}

TEST(StrainDamping, IsThereWhereTheMaterialHasIt) {
  for (const bool as_solids : {true, false}) {
    EXPECT_EQ(DampedBody(tetrahedra(), damped(Model::stvk, 0.0), as_solids).term->damping(), nullptr);
    EXPECT_NE(DampedBody(tetrahedra(), damped(), as_solids).term->damping(), nullptr);
  }
  // critical at 1 Hz: zeta = tau omega / 2
  EXPECT_DOUBLE_EQ(damping_time_of(1.0, 1.0) * 2.0 * std::acos(-1.0) / 2.0, 1.0);
  EXPECT_DOUBLE_EQ(damping_time_of(0.05, 2.0), 0.05 / (2.0 * std::acos(-1.0)));
}

// A rigid motion of a body however deformed; forces are as accurate as their sizes state, to the eight roundings to
// which the equations of implicit methods are solved.
TEST(StrainDamping, LetsABodyMoveAndTurnAsAWhole) {
  for (DampedBody& body : both()) {
    body.shake(0.02, 0.0, 5);
    const Vector3d spin(30, -20, 10), speed(5, 6, 7);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.v[i] = speed + spin.cross(body.x[i]);
    const Vectors force = body.forces();
    std::vector<double> size(force.size(), 0.0);
    body.damping().add_force_sizes({body.x}, body.v, size);
    double largest = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      EXPECT_LE(force[i].norm(), 8.0 * epsilon * size[i]) << i;
      largest = std::max(largest, size[i]);
    }
    // and not larger than needed: the forces of a stretch at that rate, except for signs that cancel in three sums and
    // at some twenty cells around a vertex
    for (std::size_t i = 0; i < body.x.size(); ++i) body.v[i] = 30.0 * body.x[i];
    double stretched = 0.0;
    for (const Vector3d& f : body.forces()) stretched = std::max(stretched, f.norm());
    EXPECT_LT(largest, 1000.0 * stretched);
  }
}

TEST(StrainDamping, PullsWithoutNetForceOrTorque) {
  for (DampedBody& body : both()) {
    body.shake(0.02, 3.0, 6);
    expect_no_net_pull(body.forces(), body.x, "damping");
  }
}

// In a uniform deformation F that changes at the rate G, E' = sym(F'G) everywhere: the power lost is V tau (2 mu E':E'
// + lambda tr(E')^2), whatever the law and the shapes of cells.
TEST(StrainDamping, LosesWhatTheRateOfGreensStrainSays) {
  Matrix3d f, g;
  f << 1.2, 0.1, -0.2, 0.05, 0.9, 0.1, 0.0, -0.1, 1.1;
  g << 0.3, -1.0, 0.5, 2.0, 0.7, -0.4, 0.1, 0.2, -0.6;
  const Matrix3d rate = 0.5 * (f.transpose() * g + g.transpose() * f);
  for (const double ratio : {0.3, -0.4})
    for (const Model model : element_models)
      for (DampedBody& body : both(damped(model, tau, ratio))) {
        for (std::size_t i = 0; i < body.x.size(); ++i) {
          body.x[i] = f * body.rest[i];
          body.v[i] = g * body.rest[i];
        }
        const double mu = young / (2.0 * (1.0 + ratio)), lambda = 2.0 * mu * ratio / (1.0 - 2.0 * ratio);
        const double lost = body.volume * tau * (2.0 * mu * rate.squaredNorm() + lambda * rate.trace() * rate.trace());
        // sums over some hundred points of a few roundings each
        EXPECT_NEAR(-dot(body.forces(), body.v), lost, 1e-13 * lost) << name(model);
        EXPECT_NEAR(-body.damping().power(pieces_of(body), body.x, body.v, body.v), lost, 1e-13 * lost) << name(model);
      }
}

TEST(StrainDamping, TakesPowerAndGivesNone) {
  for (const double ratio : {0.45, 0.0, -0.9})
    for (DampedBody& body : both(damped(Model::corotational, tau, ratio)))
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        body.x = body.rest;
        body.shake(0.1, 1.0, seed);  // inverts some
        EXPECT_LT(dot(body.forces(), body.v), 0.0);
      }
}

// Power over all vertices, of which only some move on, as driven ones do.
TEST(StrainDamping, KnowsThePowerOfSomeOfTheVertices) {
  for (DampedBody& body : both()) {
    body.shake(0.01, 1.0, 7);
    Vectors w(body.v.size(), Vector3d(0, 0, 0));
    for (std::size_t i = 0; i < w.size(); i += 3) w[i] = body.v[i];
    const double exact = dot(body.forces(), w);
    EXPECT_NEAR(body.damping().power(pieces_of(body), body.x, body.v, w), exact, 1e-12 * std::abs(exact));
  }
}

// Forces are linear in velocities, so the matrix is no approximation: not of differences, not of small ones.
TEST(StrainDamping, HasTheMatrixThatItsForcesAreMadeOf) {
  for (DampedBody& body : both()) {
    body.shake(0.02, 2.0, 8);
    const Vectors force = body.forces(), expected = product(body, body.v);
    double largest = 0.0;
    for (const Vector3d& f : force) largest = std::max(largest, f.norm());
    for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LE((force[i] + expected[i]).norm(), 1e-13 * largest) << i;
  }
}

// The same at positions further along the step, as implicit stages need it.
TEST(StrainDamping, IsTakenWhereAStepLeadsTo) {
  for (DampedBody& body : both()) {
    body.shake(0.01, 1.0, 9);
    Vectors on_the_way(body.x.size(), Vector3d(0, 0, 0));
    body.damping().add_forces({body.x, body.v, 0.01}, body.v, on_the_way);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.x[i] += 0.01 * body.v[i];
    const Vectors there = body.forces();
    double largest = 0.0;
    for (const Vector3d& f : there) largest = std::max(largest, f.norm());
    for (std::size_t i = 0; i < there.size(); ++i) EXPECT_LE((there[i] - on_the_way[i]).norm(), 1e-12 * largest) << i;
  }
}

// Near rest damping is in proportion to the stiffness of every law: that makes it a damping ratio.
TEST(StrainDamping, IsTheStiffnessOfEveryLawAtRest) {
  for (const Model model : element_models)
    for (const DampedBody& body : both(damped(model))) {
      std::vector<Matrix3d> stiffness, damping;
      const auto keep = [](std::vector<Matrix3d>& into) {
        return [&into](ForceTerm::Nodes, std::span<const Matrix3d> blocks) {
          into.insert(into.end(), blocks.begin(), blocks.end());
        };
      };
      body.term->for_each_tangent({body.x}, Compression::exact, keep(stiffness));
      body.damping().for_each_tangent({body.x}, keep(damping));
      ASSERT_EQ(stiffness.size(), damping.size());
      double largest = 0.0;
      for (const Matrix3d& block : stiffness) largest = std::max(largest, block.norm());
      for (std::size_t k = 0; k < stiffness.size(); ++k)
        EXPECT_LE((stiffness[k] - damping[k]).norm(), 1e-13 * largest) << name(model);
    }
}

TEST(StrainDamping, KnowsWhatItsRateChangesBy) {
  for (DampedBody& body : both()) {
    body.shake(0.02, 1.0, 10);
    Vectors step(body.v.size()), after(body.v.size());
    SplitMix64 random(11);
    for (std::size_t i = 0; i < step.size(); ++i) {
      for (double& c : step[i]) c = random.next_signed();
      after[i] = body.v[i] + 0.3 * step[i];
    }
    const double expected = 0.5 * (dot(after, product(body, after)) - dot(body.v, product(body, body.v)));
    const EnergyChange change = body.damping().rate_change({body.x}, body.v, step, 0.3);
    EXPECT_NEAR(change.value, expected, 1e-12 * change.sizes);
    EXPECT_GE(change.sizes, std::abs(change.value));
  }
}

// Whatever the step, kinetic energy falls and momenta stay; fixed vertices keep their velocity.
TEST(StrainDamping, DecaysInStepsOfAnyLength) {
  for (const double h : {1e-6, 1e-3, 1.0, 1e6, 1e300})
    for (DampedBody& body : both()) {
      body.shake(0.02, 1.0, 12);
      std::vector<double> mobility;
      for (std::size_t i = 0; i < body.x.size(); ++i)
        mobility.push_back(1.0 / (1.0 + 0.1 * static_cast<double>(i % 7)));
      const auto sums = [&] {
        double energy = 0.0;
        Vector3d p(0, 0, 0), l(0, 0, 0);
        for (std::size_t i = 0; i < body.x.size(); ++i) {
          energy += body.v[i].squaredNorm() / mobility[i] / 2;
          p += body.v[i] / mobility[i];
          l += body.x[i].cross(body.v[i]) / mobility[i];
        }
        return std::tuple(energy, p, l);
      };
      const auto [energy, p, l] = sums();
      body.damping().decay(body.x, h, mobility, false, body.v);
      body.damping().decay(body.x, h, mobility, true, body.v);
      const auto [after, p_after, l_after] = sums();
      EXPECT_LT(after, energy) << h;
      // 2 sweeps of 6 impulses at 200 points, each rounded a few times at the size of what moves
      EXPECT_LT((p_after - p).norm(), 2 * 6 * 200 * 4 * epsilon * 100) << h;
      EXPECT_LT((l_after - l).norm(), 2 * 6 * 200 * 4 * epsilon * 100) << h;

      mobility.assign(mobility.size(), 0.0);
      const Vectors before = body.v;
      body.damping().decay(body.x, h, mobility, false, body.v);
      EXPECT_EQ(body.v, before);
    }
}

// The last strain of a sweep, a shear in x and y, is zero after a step that is long enough.
TEST(StrainDamping, StopsAStrainInALongStep) {
  for (std::size_t cell = 0; cell < 6; ++cell) {
    DampedBody body(kuhn_box(1, 1, 1, 0.1), damped(), false);
    body.shake(0.01, 1.0, 16);
    const TetrahedronNodes n = body.corners[cell];
    const std::vector<Material> several{damped(Model::neo_hookean, 0.0), damped()};  // that cell alone is damped
    std::vector<MaterialNumber> of_cell(6, 0);
    of_cell[cell] = 1;
    const auto term =
        make_tetrahedra(CellMaterials(several[0], several, of_cell), {body.corners, body.tetrahedra, body.mass});
    const std::vector<double> mobility(body.x.size(), 2.0);
    const auto shear = [&] {
      const auto gradient = [&](const Vectors& at) {
        Matrix3d edges;
        for (int k = 0; k < 3; ++k) edges.col(k) = at[n[static_cast<std::size_t>(k) + 1]] - at[n[0]];
        return Matrix3d(edges * body.tetrahedra[cell]);
      };
      const Matrix3d whole = gradient(body.x).transpose() * gradient(body.v);
      return std::abs(whole(0, 1) + whole(1, 0));
    };
    EXPECT_GT(shear(), 0.1);
    term->damping()->decay(body.x, 1e3, mobility, false, body.v);
    EXPECT_LT(shear(), 1e-12);
  }
}

// A short step takes h C v / m: at first order the parts one by one have the effect of all of them together.
TEST(StrainDamping, DecaysAtTheRateOfItsForces) {
  for (DampedBody& body : both()) {
    body.shake(0.02, 1.0, 13);
    const std::vector<double> mobility(body.x.size(), 0.5);
    const Vectors force = body.forces(), before = body.v;
    double largest = 0.0;
    for (const Vector3d& f : force) largest = std::max(largest, 0.5 * f.norm());
    const double h = 1e-6 / largest;  // takes a millionth: the next term is as small again
    body.damping().decay(body.x, h, mobility, false, body.v);
    for (std::size_t i = 0; i < force.size(); ++i)
      EXPECT_LE(((body.v[i] - before[i]) / h - 0.5 * force[i]).norm(), 1e-3 * largest) << i;
  }
}

// Backwards by -h restores the velocities, part by part: a sweep there and back is symmetric.
TEST(StrainDamping, IsUndoneBackwards) {
  for (DampedBody& body : both()) {
    body.shake(0.02, 1.0, 14);
    const std::vector<double> mobility(body.x.size(), 1.0);
    const Vectors before = body.v;
    body.damping().decay(body.x, 1e-3, mobility, false, body.v);
    double moved = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) moved = std::max(moved, (body.v[i] - before[i]).norm());
    EXPECT_GT(moved, 0.01);
    body.damping().decay(body.x, -1e-3, mobility, true, body.v);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE((body.v[i] - before[i]).norm(), 1e-11) << i;
  }
}

// Two tissues: each cell has the time of its own material, and springs have none.
TEST(StrainDamping, IsThatOfEachCellsMaterial) {
  const Mesh mesh = kuhn_box(1, 1, 1, 0.1);
  const std::vector<Material> several{damped(Model::stvk, 0.01), damped(Model::corotational, 0.0),
                                      Material{.damping = 3.0, .model = Model::springs}};
  const std::vector<MaterialNumber> of_cell{0, 1, 2, 0, 1, 2};
  const DampedBody whole(mesh, damped(Model::stvk, 0.01), false);
  const auto term =
      make_tetrahedra(CellMaterials(several[0], several, of_cell), {whole.corners, whole.tetrahedra, whole.mass});
  ASSERT_NE(term->damping(), nullptr);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(term->damping()->time(c), of_cell[c] == 0 ? 0.01 : 0.0) << c;
  DampedBody moving(mesh, damped(Model::stvk, 0.01), false);
  moving.shake(0.01, 1.0, 15);
  const auto power = [&](const TermDamping& damping, std::uint32_t c) {
    return damping.power({&c, 1}, moving.x, moving.v, moving.v);
  };
  for (std::uint32_t c = 0; c < 6; ++c)
    EXPECT_EQ(power(*term->damping(), c), of_cell[c] == 0 ? power(whole.damping(), c) : 0.0) << c;
  // and damping that only some cells have acts on their vertices only
  const std::vector<double> mobility(moving.x.size(), 1.0);
  Vectors force(moving.x.size(), Vector3d(0, 0, 0));
  term->damping()->add_forces({moving.x}, moving.v, force);
  double taken = 0.0;
  for (std::uint32_t c = 0; c < 6; ++c) taken += power(*term->damping(), c);
  EXPECT_NEAR(dot(force, moving.v), taken, 1e-13 * std::abs(taken));
}

}  // namespace
}  // namespace dartboard::strain_damping_test
