#include "validation/statics/calculix_deck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"

namespace dartboard::calculix_deck_test {
namespace {

using Eigen::Vector3d;

/// Two tetrahedra that stand on the triangle 0, 1, 2 and are pulled at the last point.
StaticProblem two_standing(bool large) {
  StaticProblem problem{
      .mesh = two_tetrahedra(), .young = 1e5, .poisson = 0.25, .held = {0, 1, 2}, .force = {}, .large = large};
  problem.force.assign(5, Vector3d::Zero());
  problem.force[4] = (large ? 1000.0 : 1.0) * Vector3d(1.0, -0.5, 2.5);
  return problem;
}

// The output of ccx 2.20 for both decks, the last two parts of ten of the large load.
constexpr const char* small_printed = R"(
 displacements (vx,vy,vz) for set ALL and time  0.1000000E+01

         1  0.000000E+00  0.000000E+00  0.000000E+00
         2  0.000000E+00  0.000000E+00  0.000000E+00
         3  0.000000E+00  0.000000E+00  0.000000E+00
         4 -5.877297E-05 -9.091583E-05 -5.010373E-05
         5 -3.432128E-05 -1.950356E-04  2.517635E-04
)";
constexpr const char* large_printed = R"(
 displacements (vx,vy,vz) for set ALL and time  0.9000000E+00

         1  0.000000E+00  0.000000E+00  0.000000E+00
         2  0.000000E+00  0.000000E+00  0.000000E+00
         3  0.000000E+00  0.000000E+00  0.000000E+00
         4 -3.705387E-02 -5.796698E-02 -4.142304E-02
         5 -2.317684E-02 -1.466311E-01  1.741681E-01

 displacements (vx,vy,vz) for set ALL and time  0.1000000E+01

         1  0.000000E+00  0.000000E+00  0.000000E+00
         2  0.000000E+00  0.000000E+00  0.000000E+00
         3  0.000000E+00  0.000000E+00  0.000000E+00
         4 -3.964476E-02 -6.222086E-02 -4.541509E-02
         5 -2.484840E-02 -1.599093E-01  1.888801E-01
)";

TEST(CalculixDeck, SaysMeshMaterialClampsAndLoads) {
  EXPECT_EQ(calculix_deck(two_standing(false)), R"(*NODE, NSET=ALL
1, 0.0000000000000e+00, 0.0000000000000e+00, 0.0000000000000e+00
2, 1.0000000000000e+00, 0.0000000000000e+00, 0.0000000000000e+00
3, 0.0000000000000e+00, 1.0000000000000e+00, 0.0000000000000e+00
4, 0.0000000000000e+00, 0.0000000000000e+00, 1.0000000000000e+00
5, 1.0000000000000e+00, 1.0000000000000e+00, 1.0000000000000e+00
*ELEMENT, TYPE=C3D4, ELSET=SOLID
1, 1, 2, 3, 4
2, 2, 3, 4, 5
*MATERIAL, NAME=ELASTIC
*ELASTIC
1.0000000000000e+05, 2.5000000000000e-01
*SOLID SECTION, ELSET=SOLID, MATERIAL=ELASTIC
*BOUNDARY
1, 1, 3
2, 1, 3
3, 1, 3
*STEP
*STATIC
*CLOAD
5, 1, 1.0000000000000e+00
5, 2, -5.0000000000000e-01
5, 3, 2.5000000000000e+00
*NODE PRINT, NSET=ALL
U
*END STEP
)");
}

TEST(CalculixDeck, AsksForLargeDisplacementsInTenParts) {
  const std::string deck = calculix_deck(two_standing(true));
  EXPECT_NE(
      deck.find("*STEP, NLGEOM, INC=10\n*STATIC, DIRECT\n0.100000, 1.\n*CONTROLS, PARAMETERS=FIELD\n1.e-9, 1.e-9\n"),
      std::string::npos)
      << deck;
  EXPECT_EQ(deck.find("*STEP\n"), std::string::npos);
}

TEST(CalculixDeck, HasHexahedraInTheOrderOfTheMesh) {
  const Mesh mesh = hexahedron_box(1, 1, 1, 0.5);
  StaticProblem problem{.mesh = mesh, .force = std::vector<Vector3d>(8, Vector3d::Zero())};
  std::string line = "*ELEMENT, TYPE=C3D8, ELSET=SOLID\n1";
  for (const std::uint32_t node : mesh.cell(0)) line += ", " + std::to_string(node + 1);
  EXPECT_NE(calculix_deck(problem).find(line + "\n"), std::string::npos) << calculix_deck(problem);
  problem.mesh = mixed_box(2, 2, 2, 0.5);
  EXPECT_THROW(calculix_deck(problem), InputError);
}

// C3D10: the corners, then the middles of 01, 12, 20, 03, 13, 23.
TEST(CalculixDeck, HasTheMiddlesOfQuadraticTetrahedraInItsOwnOrder) {
  const StaticProblem problem = two_standing(false);
  const reference::QuadraticSolid solid(problem.mesh, {1e5, 0.25, 1.0});
  Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * solid.nodes().size()));
  force[3 * 6 + 1] = 2.0;
  const std::string deck = calculix_deck(problem, solid, {0, 5}, force);
  std::istringstream lines(deck.substr(deck.find("C3D10")));
  std::string line;
  std::getline(lines, line);
  for (std::size_t c = 0; c < 2; ++c) {
    std::getline(lines, line);
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::size_t number = 0;
    words >> number;
    EXPECT_EQ(number, c + 1);
    std::vector<Vector3d> place;
    for (std::size_t node = 0; words >> node;) place.push_back(solid.nodes()[node - 1]);
    ASSERT_EQ(place.size(), 10u);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(place[k], problem.mesh.points[problem.mesh.cell(c)[k]]);
    EXPECT_EQ(place[4], 0.5 * (place[0] + place[1]));
    EXPECT_EQ(place[5], 0.5 * (place[1] + place[2]));
    EXPECT_EQ(place[6], 0.5 * (place[2] + place[0]));
    EXPECT_EQ(place[7], 0.5 * (place[0] + place[3]));
    EXPECT_EQ(place[8], 0.5 * (place[1] + place[3]));
    EXPECT_EQ(place[9], 0.5 * (place[2] + place[3]));
  }
  EXPECT_NE(deck.find("*BOUNDARY\n1, 1, 3\n6, 1, 3\n*STEP"), std::string::npos);
  EXPECT_NE(deck.find("*CLOAD\n7, 2, 2.0000000000000e+00\n*NODE PRINT"), std::string::npos);
}

TEST(CalculixDisplacements, AreThoseOfTheWholeLoad) {
  const std::vector<Vector3d> u = calculix_displacements(large_printed, 5);
  ASSERT_EQ(u.size(), 5u);
  EXPECT_EQ(u[2], Vector3d::Zero());
  EXPECT_EQ(u[3], Vector3d(-3.964476e-2, -6.222086e-2, -4.541509e-2));
  EXPECT_EQ(u[4], Vector3d(-2.484840e-2, -1.599093e-1, 1.888801e-1));
}

// Numbers are printed with seven digits: 5e-7 of themselves, and of a displacement, at most.
TEST(CalculixDisplacements, AreThoseOfCoresElements) {
  for (const bool large : {false, true}) {
    const std::vector<Vector3d> ours = displacements_by_core(two_standing(large)),
                                theirs = calculix_displacements(large ? large_printed : small_printed, 5);
    EXPECT_LT(displacements_apart(ours, theirs), 5e-7) << large;
    EXPECT_GT(displacements_apart(ours, theirs), 1e-9) << large;  // our numbers, not printed ones
  }
}

std::string refusal(const std::string& printed, std::size_t nodes) {
  try {
    calculix_displacements(printed, nodes);
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST(CalculixDisplacements, AreRefusedWhereTheyAreNotThoseOfAllNodes) {
  const std::string head = " displacements (vx,vy,vz) for set ALL and time  0.1000000E+01\n\n";
  EXPECT_EQ(refusal("", 1), "calculix: line 0: expected the displacements of 1 nodes, found 0");
  EXPECT_EQ(refusal(small_printed, 6), "calculix: line 8: expected the displacements of 6 nodes, found 5");
  EXPECT_EQ(refusal(head + " 2 0.0 0.0 0.0\n", 2), "calculix: line 3: expected node 1, found node 2");
  EXPECT_EQ(refusal(head + " 1 0.0 0.0\n", 1),
            "calculix: line 3: expected a node and three displacements, found ' 1 0.0 0.0'");
  EXPECT_EQ(refusal(head + " 1 0.0 NaN 0.0\n", 1), "calculix: line 3: expected a displacement, found 'NaN'");
  EXPECT_EQ(refusal(head + " 1 0.0 0.0 1.2x\n", 1), "calculix: line 3: expected a displacement, found '1.2x'");
}

}  // namespace
}  // namespace dartboard::calculix_deck_test
