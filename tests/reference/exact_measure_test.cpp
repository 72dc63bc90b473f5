#include "reference/exact_measure.h"

#include <gtest/gtest.h>

#include <array>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::exact_measure_test {
namespace {

TEST(ExactVolume, OfUnitCellsIsThatOfTheirFormulas) {
  const Mesh mesh = mixed_cells();  // a unit cube, a pyramid of height 1 on it, half a cube, a tetrahedron
  EXPECT_EQ(exact_volume(mesh, 0), 1);
  EXPECT_EQ(exact_volume(mesh, 1), Rational(1, 3));
  EXPECT_EQ(exact_volume(mesh, 2), Rational(1, 2));
  // base (1, 0, 0), (2, 0, 0), (1, 0, 1) of area 1/2, the tip one below it
  EXPECT_EQ(abs(exact_volume(mesh, 3)), Rational(1, 6));
}

TEST(ExactVolume, HasTheSignOfTheHandedness) {
  Mesh mesh = regular_tetrahedron();
  EXPECT_EQ(exact_volume(mesh, 0), Rational(8, 3));
  mesh.nodes = {1, 0, 2, 3};
  EXPECT_EQ(exact_volume(mesh, 0), Rational(-8, 3));
  EXPECT_EQ(exact_measure(mesh, 0), 8.0 / 3.0);
}

// The whole is a box whatever lies inside, and a warped face belongs to the two cells on its sides by halves.
TEST(ExactVolume, OfAllCellsOfABoxIsThatOfTheBox) {
  Mesh mesh = mixed_box(4, 3, 4, 0.25);
  for (auto& p : mesh.points) {
    const bool inside = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 0.75 && p.z() > 0 && p.z() < 1;
    if (inside) p += Eigen::Vector3d(0.03125, -0.015625, 0.0078125) * (p.x() * 4 - 2);
  }
  Rational sum;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) sum += exact_volume(mesh, c);
  EXPECT_EQ(sum, Rational(3, 4));
}

TEST(ExactVolume, KnowsNoScaleThatRoundsIt) {
  Mesh mesh = regular_tetrahedron();
  for (auto& p : mesh.points) p *= 0x1p-300;
  EXPECT_EQ(exact_volume(mesh, 0) * Rational(boost::multiprecision::cpp_int(1) << 900u), Rational(8, 3));
  for (auto& p : mesh.points) p = p * 0x1p300 + Eigen::Vector3d(0x1p40, -0x1p40, 0x1p40);
  EXPECT_EQ(exact_volume(mesh, 0), Rational(8, 3));
}

TEST(ExactMeasure, OfAPolygonIsItsArea) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}, {0, 4, 3}};
  mesh.add_cell(CellKind::quadrilateral, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 4});
  EXPECT_EQ(exact_measure(mesh, 0), 12.0);
  EXPECT_EQ(exact_measure(mesh, 1), 7.5);  // height 5
}

TEST(Rounded, IsTheNearestDouble) {
  EXPECT_EQ(rounded(Rational(1, 3)), 1.0 / 3.0);
  EXPECT_EQ(rounded(Rational(-2, 3)), -2.0 / 3.0);
  EXPECT_EQ(rounded(0), 0.0);
  EXPECT_EQ(rounded(Rational(1, 10)), 0.1);
  // between two doubles the even one, and the next for anything more
  const Rational one_and_half_ulp = 1 + Rational(1, boost::multiprecision::cpp_int(1) << 53u);
  EXPECT_EQ(rounded(one_and_half_ulp), 1.0);
  EXPECT_EQ(rounded(one_and_half_ulp + Rational(1, boost::multiprecision::cpp_int(1) << 200u)), 1.0 + 0x1p-52);
  EXPECT_EQ(rounded(one_and_half_ulp + Rational(1, boost::multiprecision::cpp_int(1) << 52u)), 1.0 + 0x1p-51);
}

// The bound holds, and is no more than a hundred times too wide.
TEST(MeasureRounding, CoversTheMeasureOfThePlainMesh) {
  for (const Mesh& mesh : {kuhn_box(4, 4, 4, 0.1, 0.2, 3), mixed_box(4, 3, 4, 0.1), hexahedron_box(3, 3, 3, 0.1),
                           torus_surface(9, 7), octasphere(2)}) {
    double worst = 0.0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const double off = std::abs(std::abs(signed_measure(mesh, c)) - exact_measure(mesh, c));
      worst = std::max(worst, off / measure_rounding(mesh, c));
    }
    EXPECT_LE(worst, 1.0);
    EXPECT_GE(worst, 0.01);
  }
}

}  // namespace
}  // namespace dartboard::reference::exact_measure_test
