#include "core/elements/membranes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/elements/membrane_law.h"
#include "tests/support/bodies/membrane_body_for_tests.h"
#include "tests/support/bodies/term_checks_for_tests.h"

namespace dartboard::membranes_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double area_of(const MembraneBody& body, std::size_t c) { return signed_measure(body.mesh, c); }

/// Sheets in the plane z = 0, of triangles alone and mixed.
std::vector<Mesh> flat_sheets() { return {crooked_triangles(5, 4), mixed_sheet(5, 4)}; }

/// Calls f(mesh, model) for those, with either law.
template <class F>
void for_each_sheet(F&& f) {
  for (const Mesh& mesh : flat_sheets())
    for (const Model model : membrane_models) f(mesh, model);
}

SurfaceGradient some_gradient() {
  SurfaceGradient f;
  f << 1.2, 0.1, 0.05, 0.9, -0.3, 0.4;
  return f;
}
bool is_inside(const Vector3d& p) { return p[0] > 0.01 && p[1] > 0.01 && p[0] < 0.49 && p[1] < 0.39; }

// The patch test: whatever the shapes, a uniform strain pulls nowhere inside and is the same stress everywhere.
TEST(Membranes, AreInEquilibriumInsideASheetOfUniformStrain) {
  const SurfaceGradient f = some_gradient();
  for_each_sheet([&](const Mesh& mesh, Model model) {
    MembraneBody body(mesh, sheet_material(2e3, 0.3, model));
    const Matrix3d stress = MembraneLaw(body.material).stress(f) * f.transpose();
    for (Vector3d& p : body.x) p = f * p.head<2>();
    const auto force = forces_of(*body.term, body.x);
    double inside = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      double& largest = is_inside(mesh.points[i]) ? inside : outside;
      largest = std::max(largest, force[i].norm());
    }
    EXPECT_GT(outside, 1.0);
    EXPECT_LE(inside, 1e-13 * outside);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto corners = static_cast<double>(mesh.cell(c).size());
      EXPECT_LE((corners / area_of(body, c) * body.term->virial(body.x, c).tensor - stress).norm(),
                1e-12 * stress.norm())
          << c;
    }
  });
}

TEST(Membranes, PullAlongTheSlopeOfTheirEnergyAndStiffenAsTheyDo) {
  for_each_sheet([](const Mesh& mesh, Model model) {
    for (const bool bent : {false, true}) {
      MembraneBody body(bent ? saddle(mesh) : mesh, sheet_material(2e3, 0.3, model));
      body.shake(0.01, 5);
      expect_consistent(*body.term, body.x, 0.1);
    }
  });
}

/// Energy of a triangle from the lengths of its edges and their angles alone, in long double: with no frame, no F and
/// no rotation. M = (A'A)^-1 B'B of edges A at rest and B now has the squares of both stretches as eigenvalues.
long double energy_of_metric(const Material& material, const std::array<Vector3d, 3>& rest,
                             const std::array<Eigen::Matrix<long double, 3, 1>, 3>& now) {
  Eigen::Matrix<long double, 3, 2> a, b;
  for (int k = 0; k < 2; ++k) {
    a.col(k) = rest[static_cast<std::size_t>(k) + 1].cast<long double>() - rest[0].cast<long double>();
    b.col(k) = now[static_cast<std::size_t>(k) + 1] - now[0];
  }
  const Eigen::Matrix<long double, 2, 2> metric = a.transpose() * a, m = metric.inverse() * (b.transpose() * b);
  const long double young = material.young, nu = material.poisson, mu = young / (2 * (1 + nu)),
                    lambda = young * nu / (1 - nu * nu), squares = m.trace();
  long double trace, norm;  // of the strain
  if (material.model == Model::stvk) {
    trace = (squares - 2) / 2;
    norm = (squares * squares - 2 * m.determinant() - 2 * squares + 2) / 4;
  } else {
    const long double sum = std::sqrt(squares + 2 * std::sqrt(m.determinant()));
    trace = sum - 2;
    norm = squares - 2 * sum + 2;
  }
  return std::sqrt(metric.determinant()) / 2 * (mu * norm + lambda / 2 * trace * trace);
}

// Central differences of step 1e-6 in long double are right to 1e-12 of the third derivative, and their rounding is
// less.
TEST(Membranes, HaveTheEnergyOfTheirMetricAndPullAlongItsSlope) {
  for (const Model model : membrane_models) {
    MembraneBody body(saddle(crooked_triangles(4, 3)), sheet_material(2e3, 0.3, model));
    body.shake(0.015, 8);
    std::vector<Eigen::Matrix<long double, 3, 1>> x;
    for (const Vector3d& p : body.x) x.push_back(p.cast<long double>());
    const auto energy = [&] {
      long double sum = 0;
      for (const auto& [i, j, k] : body.triangles)
        sum += energy_of_metric(body.material, {body.mesh.points[i], body.mesh.points[j], body.mesh.points[k]},
                                {x[i], x[j], x[k]});
      return sum;
    };
    EXPECT_NEAR(body.energy() / static_cast<double>(energy()), 1.0, 1e-13);
    const auto force = forces_of(*body.term, body.x);
    double largest = 0.0;
    for (const Vector3d& f : force) largest = std::max(largest, f.norm());
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const long double here = x[i][c], step = 1e-6L;
        x[i][c] = here + step;
        const long double up = energy();
        x[i][c] = here - step;
        const long double down = energy();
        x[i][c] = here;
        EXPECT_NEAR(force[i][c], static_cast<double>((down - up) / (2 * step)), 1e-9 * largest) << i;
      }
  }
}

// Whatever the shape at rest, also of quadrilaterals that are not flat. Forces are known to eps times their sizes, of
// which a few are taken: F is summed from up to three products.
TEST(Membranes, AreFreeOfForceWhereTheyAreMovedWithoutStrain) {
  const Matrix3d turn = Eigen::AngleAxisd(2.0, Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  for_each_sheet([&](const Mesh& mesh, Model model) {
    MembraneBody body(saddle(mesh), sheet_material(2e3, 0.3, model));
    for (Vector3d& p : body.x) p = turn * p + Vector3d(0.5, -0.25, 1.0);
    const auto force = forces_of(*body.term, body.x);
    std::vector<double> size(force.size(), 0.0);
    body.term->add_force_sizes({body.x}, size);
    for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LE(force[i].norm(), 16 * 2.3e-16 * size[i]) << i;
    EXPECT_LE(body.energy(), 1e-27 * sheet_material().young);
    body.x[12][2] += 0.05;
    EXPECT_GT(body.energy(), 1e-4);
  });
}

// A strip that is drawn out by l1 is thinner by l2 = sqrt(1 - nu (l1^2 - 1)), from S22 = 0: its sides are free then,
// and its ends hold Y l1 (l1^2 - 1) / 2 per width, from S11 = Y E11. For a small strain e these are Young's modulus, Y
// e, and Poisson's ratio, 1 - nu e; of the corotational law for any strain.
TEST(Membranes, OfAStripThatIsDrawnOutHaveYoungsModulusAndPoissonsRatio) {
  const double young = sheet_material().young, nu = sheet_material().poisson, width = 0.4;
  for_each_sheet([&](const Mesh& mesh, Model model) {
    for (const double l1 : {0.7, 1.0 + 1e-6, 1.2, 1.9}) {
      const bool linear = model == Model::corotational;
      const double l2 = linear ? 1.0 - nu * (l1 - 1.0) : std::sqrt(1.0 - nu * (l1 * l1 - 1.0));
      const double pull = young * width * (linear ? l1 - 1.0 : l1 * (l1 * l1 - 1.0) / 2.0);
      MembraneBody body(mesh, sheet_material(young, nu, model));
      for (Vector3d& p : body.x) p = {l1 * p[0], l2 * p[1], 0.0};
      const auto force = forces_of(*body.term, body.x);
      double at_end = 0.0;
      for (std::size_t i = 0; i < force.size(); ++i) {
        if (mesh.points[i][0] > 0.49) {
          at_end += force[i][0];
        } else if (mesh.points[i][0] > 0.01) {
          EXPECT_LE(force[i].norm(), 1e-12 * young * width) << i;
        }
      }
      EXPECT_NEAR(at_end, -pull, 1e-12 * young * width) << l1;
    }
  });
}

// Per width the bottom k rows of squares weigh k rho g h, of which half of the last hangs on the edge below it: if row
// k of a strip without Poisson's ratio carries Y l (l^2 - 1) / 2 = (k - 1/2) rho g h, every vertex rests. For small
// strains that lengthens it by sum of h (k - 1/2) rho g h / Y = rho g L^2 / 2 Y, whatever the number of rows; strains
// of s reduce that by 3/2 of themselves.
TEST(Membranes, HangUnderTheirWeightLongerByRhoGLSquaredOverTwoY) {
  const double h = 0.1, g = 9.81, young = 4e3, rho = 0.5;
  const int rows = 12;
  Material material = sheet_material(young, 0.0);
  material.density = rho;
  MembraneBody body(quad_sheet(3, rows, h), material);
  std::vector<double> depth(rows + 1, 0.0);  // of row lines, from the top, which is y = 0
  for (int k = rows; k >= 1; --k) {
    const double pull = (k - 0.5) * rho * g * h / young;
    double l = 1.0;
    for (int n = 0; n < 20; ++n) l -= (l * (l * l - 1.0) / 2.0 - pull) / ((3.0 * l * l - 1.0) / 2.0);
    const auto line = static_cast<std::size_t>(rows - k);
    depth[line + 1] = depth[line] + l * h;
  }
  std::vector<double> mass(body.x.size(), 0.0);
  for (std::size_t c = 0; c < body.mesh.cell_count(); ++c)
    for (const std::uint32_t i : body.mesh.cell(c)) mass[i] += rho * h * h / 4.0;
  for (Vector3d& p : body.x) p[1] = -depth[static_cast<std::size_t>(std::lround(p[1] / h))];
  const auto force = forces_of(*body.term, body.x);
  for (std::size_t i = 0; i < force.size(); ++i)
    if (body.mesh.points[i][1] > 0.5 * h) {
      EXPECT_LE((force[i] - mass[i] * Vector3d(0, g, 0)).norm(), 1e-12 * young) << i;
    }
  const double length = rows * h, strain = rho * g * length / young;
  EXPECT_NEAR((depth.back() - length) / (rho * g * length * length / (2.0 * young)), 1.0, 1.5 * strain);
}

// In an affine motion, a quadrilateral of any flat shape has the energy of the triangles that fill it; a parallelogram
// pulls its corners as the mean of both ways to halve it.
TEST(Membranes, OfFourCornersAreTrianglesWhereTheMotionIsAffine) {
  const SurfaceGradient f = some_gradient();
  Mesh quad, one_way, other_way;
  quad.points = one_way.points = other_way.points = {{0, 0, 0}, {0.2, 0.05, 0}, {0.25, 0.3, 0}, {0.05, 0.25, 0}};
  quad.add_cell(CellKind::quadrilateral, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  one_way.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  one_way.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 2, 3});
  other_way.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 3});
  other_way.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{1, 2, 3});
  const auto expect_alike = [&](Model model, bool parallelogram) {
    if (!parallelogram)
      for (Mesh* mesh : {&quad, &one_way, &other_way}) mesh->points[2] = {0.35, 0.28, 0};
    std::vector<std::vector<Vector3d>> force;
    std::vector<double> energy;
    for (const Mesh* mesh : {&quad, &one_way, &other_way}) {
      MembraneBody body(*mesh, sheet_material(2e3, 0.3, model));
      for (Vector3d& p : body.x) p = f * p.head<2>();
      force.push_back(forces_of(*body.term, body.x));
      energy.push_back(body.energy());
    }
    EXPECT_NEAR(energy[1], energy[0], 1e-13 * energy[0]);
    EXPECT_NEAR(energy[2], energy[0], 1e-13 * energy[0]);
    for (std::size_t i = 0; parallelogram && i < 4; ++i)
      EXPECT_LE((force[0][i] - 0.5 * (force[1][i] + force[2][i])).norm(), 1e-13 * size_of(force[0])) << i;
  };
  for (const bool parallelogram : {true, false})
    for (const Model model : membrane_models) expect_alike(model, parallelogram);
}

// For u = e (x y, 0), which a square can follow, the linear energy is mu e^2 (y^2 + x^2 / 2) + lambda / 2 e^2 y^2; over
// a square of side 1 around the origin the squares of x and y integrate to 1/12 each. One Gauss point would give zero.
TEST(Membranes, OfFourCornersHaveTheEnergyOfATrapezeExactly) {
  const Lame lame = lame_of_sheet(2e3, 0.3);
  Mesh mesh = quad_sheet(1, 1, 1.0);
  for (Vector3d& p : mesh.points) p -= Vector3d(0.5, 0.5, 0);
  MembraneBody body(mesh);
  const double e = 1e-5;
  for (Vector3d& p : body.x) p[0] += e * p[0] * p[1];
  const double linear = e * e / 12.0 * (1.5 * lame.mu + 0.5 * lame.lambda);
  EXPECT_NEAR(body.energy() / linear, 1.0, 10 * e);  // third orders
}

// Cells of springs have no force here, and the others that of their own material.
TEST(Membranes, AreOfTheMaterialsOfTheirCells) {
  for (const Mesh& mesh : flat_sheets()) {
    MembraneBody soft(mesh), stiff(mesh, sheet_material(5e3, 0.1, Model::corotational));
    soft.shake(0.02, 6);
    stiff.x = soft.x;
    std::vector<Material> several{sheet_material(), stiff.material, {.model = Model::springs}};
    std::vector<MaterialNumber> of_cell;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) of_cell.push_back(static_cast<MaterialNumber>(c % 3));
    const CellMaterials materials(several[0], several, of_cell);
    const auto term = soft.nodes.empty()
                          ? make_membranes(materials, TriangleColumns{soft.triangles, soft.triangle_shape})
                          : make_membranes(materials, MembraneColumns{soft.nodes, soft.shape});
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const double own = c % 3 == 0   ? soft.term->energy(soft.x, c, mesh.cell_count())
                         : c % 3 == 1 ? stiff.term->energy(soft.x, c, mesh.cell_count())
                                      : 0.0;
      EXPECT_EQ(term->energy(soft.x, c, mesh.cell_count()), own) << c;
      if (c % 3 == 2) {
        EXPECT_TRUE(term->virial(soft.x, c).tensor.isZero(0.0)) << c;
      }
    }
  }
}

TEST(MembraneShape, HasTheAreaOfItsCell) {
  for (const Mesh& mesh : flat_sheets()) {
    const MembraneBody body(mesh);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const std::size_t corners = mesh.cell(c).size();
      double area = 0.0;
      for (std::size_t q = 0; q < membrane_points(corners); ++q) {
        const PlaneInverse& p = body.nodes.empty() ? body.triangle_shape[c] : body.shape[c][q];
        area += (corners == 3 ? 0.5 : 1.0) / (p[0] * p[2]);
      }
      EXPECT_NEAR(area, area_of(body, c), 1e-15) << c;
    }
  }
}

TEST(MembraneShape, TellsACellThatIsFlatOrTurnedOver) {
  const auto ok = [](const std::vector<Vector3d>& x) {
    const MembraneShape shape = membrane_shape_of(x);
    bool all = true;
    for (std::size_t q = 0; q < membrane_points(x.size()); ++q)
      all = all && shape[q][2] > 0.0 && std::isfinite(shape[q][2]);
    return all;
  };
  EXPECT_TRUE(ok({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_TRUE(ok({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}));  // seen from below
  EXPECT_FALSE(ok({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  EXPECT_TRUE(ok({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0}}));
  EXPECT_FALSE(ok({{0, 0, 0}, {1, 0, 0}, {0.1, 0.1, 0}, {0, 1, 0}}));  // not convex
  EXPECT_FALSE(ok({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}));      // crosses itself
}

// A whole that moves by as much everywhere feels no force: the blocks of each vertex of a piece add up to zero.
TEST(Membranes, HaveAConstantMatrixThatDoesNotResistAMovedWhole) {
  for_each_sheet([](const Mesh& mesh, Model model) {
    const MembraneBody body(mesh, sheet_material(2e3, 0.3, model));
    body.term->for_each_constant_tangent([](ForceTerm::Nodes nodes, std::span<const Matrix3d> blocks) {
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        Matrix3d sum = Matrix3d::Zero();
        for (std::size_t b = 0; b < nodes.size(); ++b)
          sum += blocks[std::max(a, b) * (std::max(a, b) + 1) / 2 + std::min(a, b)];
        EXPECT_LE(sum.norm(), 1e-13 * blocks[a * (a + 1) / 2 + a].norm());
      }
    });
  });
}

}  // namespace
}  // namespace dartboard::membranes_test
