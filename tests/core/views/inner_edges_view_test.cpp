// Bending on a map: the stiffness between two faces follows the changes of their edge.

#include "core/views/inner_edges_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/bodies/term_checks_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::inner_edges_view_test {
namespace {

using Eigen::Vector3d;

constexpr double rigidity = 0.25, stiffness = 8.0;

/// A flat sheet of triangles, of quadrilaterals or of both, inner points moved within it.
Mesh sheet_of(const char* kind, int nx = 5, int ny = 4, double jitter = 0.02) {
  const std::string_view of = kind;
  Mesh mesh = of == "triangles" ? triangle_sheet(nx, ny, 0.1) : quad_sheet(nx, ny, 0.1);
  if (of == "both") {
    const Mesh quads = mesh;
    mesh = {};
    mesh.points = quads.points;
    for (std::size_t c = 0; c < quads.cell_count(); ++c) {
      const auto n = quads.cell(c);
      if (c % 3 != 0) {
        mesh.add_cell(CellKind::quadrilateral, n);
        continue;
      }
      mesh.add_cell(CellKind::triangle, std::array{n[0], n[1], n[2]});
      mesh.add_cell(CellKind::triangle, std::array{n[0], n[2], n[3]});
    }
  }
  SplitMix64 random(9);
  for (Vector3d& p : mesh.points)
    for (int k = 0; k < 2; ++k) p[k] += jitter * random.next_signed();
  return mesh;
}

template <class Row>
struct Sheet {
  AdaptedBody<Map2> body;
  InnerEdgesView<Row> view{rigidity};
  std::unique_ptr<ForceTerm> term;

  explicit Sheet(const Mesh& mesh) : body(body_of<Map2>(mesh)) {
    body.vertices.keep_rest();
    view.rebuild(body);
    if constexpr (std::is_same_v<Row, BendingEdge>)
      term = make_bending(view.rows);
    else
      term = make_second_neighbours(view.rows, stiffness);
  }
  void shake(double size) {
    SplitMix64 random(5);
    for (Vector3d& x : body.vertices.position)
      for (double& c : x) c += size * random.next_signed();
  }
  template <class Place>
  void place(const Place& at) {
    for (std::size_t k = 0; k < body.vertices.size(); ++k) body.vertices.position[k] = at(body.vertices.rest[k]);
  }
  double energy() const { return term->energy(body.vertices.position); }
  double energy_of(std::uint32_t edge) const { return term->energy(body.vertices.position, edge, term->size()); }
  void follow(const TopologyChange& change) { view.apply(body, adapt(body, change)); }
};
using Bent = Sheet<BendingEdge>;
using Sprung = Sheet<SecondNeighbours>;

TEST(Bending, PullsAlongTheSlopeOfItsEnergyAndStiffensAsThatDoes) {
  Bent bent(sheet_of("triangles"));
  bent.shake(0.02);
  expect_consistent(*bent.term, bent.body.vertices.position, 0.1);
  for (const char* kind : {"triangles", "quadrilaterals", "both"}) {
    Sprung sprung(sheet_of(kind));
    sprung.shake(0.02);
    expect_consistent(*sprung.term, sprung.body.vertices.position, 0.1);
  }
}

// Nothing bends where every face has the same affine picture: no energy, whatever the mesh.
TEST(Bending, IsNoneInAnAffinePictureOfAFlatSheet) {
  Bent bent(sheet_of("triangles"));
  bent.place([](const Vector3d& x) { return Vector3d(1.3 * x[0] + 0.2 * x[1], 0.7 * x[1], 0.4 * x[0] - x[1]); });
  // squares of roundings of coefficients below sqrt(rigidity) / 0.02 and places below 1
  EXPECT_LE(bent.energy(), static_cast<double>(bent.view.rows.size()) * std::pow(1e-16 * 0.5 / 0.02 * 10, 2));
}

/// Rolled up along a direction at `angle` to x, to a cylinder of this curvature.
Vector3d rolled(const Vector3d& x, double angle, double curvature) {
  const Vector3d along(std::cos(angle), std::sin(angle), 0), across(-std::sin(angle), std::cos(angle), 0);
  const double s = x.dot(along) * curvature;
  return std::sin(s) / curvature * along + x.dot(across) * across + Vector3d(0, 0, (1 - std::cos(s)) / curvature);
}

/// Triangles with equal sides; n of them along a side of the sheet.
Mesh equal_sided(int n) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.emplace_back((i + 0.5 * (j % 2)) / n, j * std::sqrt(0.75) / n, 0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i), b = a + static_cast<std::uint32_t>(n) + 1;
      if (j % 2 == 0) {
        mesh.add_cell(CellKind::triangle, std::array{a, a + 1, b});
        mesh.add_cell(CellKind::triangle, std::array{a + 1, b + 1, b});
      } else {
        mesh.add_cell(CellKind::triangle, std::array{a, b + 1, b});
        mesh.add_cell(CellKind::triangle, std::array{a, a + 1, b + 1});
      }
    }
  return mesh;
}

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) area += std::abs(signed_measure(mesh, c));
  return area;
}

/// Of a sheet rolled up a little, its energy over that of a plate of its rigidity.
double stiffness_rolled(const Mesh& mesh, double angle) {
  Bent bent(mesh);
  const double curvature = 0.05;
  bent.place([&](const Vector3d& x) { return rolled(x, angle, curvature); });
  return bent.energy() / (rigidity * curvature * curvature / 2 * area_of(mesh));
}

// Edges of the border do not bend: with n rows, some 1/n of the area does not contribute. Triangles with equal sides
// are isotropic. For a second derivative H, squares halved along one diagonal have the energy D / 2 times (Hxx - Hxy)^2
// + (Hyy - Hxy)^2 + 4 Hxy^2 per area: that of a plate along the sides; along the diagonals, where Hxx = Hyy = +-Hxy,
// once and three times that.
TEST(Bending, IsThatOfAPlateOfItsRigidity) {
  constexpr double degree = std::numbers::pi / 180;
  for (const double angle : {0.0, 17.0, 30.0, 45.0, 90.0})
    EXPECT_NEAR(stiffness_rolled(equal_sided(64), angle * degree), 0.99, 0.01) << angle;
  const Mesh squares = triangle_sheet(64, 64, 1.0 / 64);
  EXPECT_NEAR(stiffness_rolled(squares, 0.0), 0.98, 0.01);
  EXPECT_NEAR(stiffness_rolled(squares, 90 * degree), 0.98, 0.01);
  const double one = stiffness_rolled(squares, 45 * degree), other = stiffness_rolled(squares, -45 * degree);
  EXPECT_NEAR(std::max(one, other), 3.0, 0.05);
  EXPECT_NEAR(std::min(one, other), 1.0, 0.02);
}

template <class Row>
double slope_of_energy(const Mesh& mesh) {
  Sheet<Row> sheet(mesh);
  const auto energy = [&](double curvature) {
    sheet.place([&](const Vector3d& x) { return rolled(x, 0.3, curvature); });
    return sheet.energy();
  };
  return std::log2(energy(0.5) / energy(0.25));
}

TEST(Bending, OfSecondNeighboursGoesWithTheFourthPowerOfTheCurvature) {
  for (const char* kind : {"triangles", "quadrilaterals", "both"})
    EXPECT_NEAR(slope_of_energy<SecondNeighbours>(sheet_of(kind, 10, 10, 0.0)), 4.0, 0.05) << kind;
  EXPECT_NEAR(slope_of_energy<SecondNeighbours>(equal_sided(10)), 4.0, 0.05);
  EXPECT_NEAR(slope_of_energy<BendingEdge>(equal_sided(10)), 2.0, 0.05);
}

template <class Row>
void expect_followed(const Mesh& mesh) {
  Sheet<Row> sheet(mesh);
  int operations = 0;
  operate_at_random(sheet.body, 3, 10, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
    sheet.view.apply(now, changed);
    InnerEdgesView<Row> rebuilt(rigidity);
    rebuilt.rebuild(now);
    ASSERT_EQ(sheet.view, rebuilt) << operations;
    ++operations;
  });
  EXPECT_GT(operations, 15);
}

TEST(Bending, FollowsRandomOperationsUntilNothingIsLeft) {
  expect_followed<BendingEdge>(sheet_of("triangles"));
  for (const char* kind : {"triangles", "quadrilaterals", "both"}) expect_followed<SecondNeighbours>(sheet_of(kind));
}

// A cut through an edge removes the bending across that edge, and nothing else.
template <class Row>
void expect_energy_of_cut_edges(const Mesh& mesh) {
  Sheet<Row> sheet(mesh);
  sheet.shake(0.02);
  SplitMix64 random(4);
  int cut = 0;
  while (cut < 20) {
    const Dart d = some_live_dart(sheet.body.map, random);
    if (sheet.body.map.is_free(2, d)) continue;
    const double own = sheet.energy_of(sheet.body.edge(sheet.body.map, d)), before = sheet.energy();
    ASSERT_GT(own, 0.0);
    sheet.follow(dissociate_edge(sheet.body.map, d));
    EXPECT_NEAR(sheet.energy(), before - own, 1e-14 * before) << cut;
    ++cut;
  }
}

TEST(Bending, LosesTheEnergyOfAnEdgeThatIsCut) {
  expect_energy_of_cut_edges<BendingEdge>(sheet_of("triangles"));
  for (const char* kind : {"triangles", "quadrilaterals", "both"})
    expect_energy_of_cut_edges<SecondNeighbours>(sheet_of(kind));
}

// Of squares, the springs along a cut have half their stiffness on either side of it, and those across it are gone.
TEST(Bending, OfSecondNeighboursIsSharedByACutAlongThem) {
  const Mesh mesh = sheet_of("quadrilaterals", 4, 4, 0.0);
  for (const int axis : {0, 1}) {
    Sprung sheet(mesh);
    sheet.place([axis](Vector3d x) {
      x[axis] *= 1.25;
      return x;
    });
    // five lines of three springs of rest length 0.2; those on the border have half the stiffness
    const double one = stiffness * 0.05 * 0.05 / 2;
    EXPECT_NEAR(sheet.energy(), (3 + 0.5 + 0.5) * 3 * one, 1e-14);
    const double before = sheet.energy();
    std::vector<Dart> line;  // along y = 0.2
    for (const Dart d : sheet.body.edge_dart) {
      const auto& rest = sheet.body.vertices.rest;
      const Vector3d middle = (rest[sheet.body.vertex(sheet.body.map, d)] +
                               rest[sheet.body.vertex(sheet.body.map, sheet.body.map.alpha<0>(d))]) /
                              2;
      if (std::abs(middle[1] - 0.2) < 1e-9) line.push_back(d);
    }
    ASSERT_EQ(line.size(), 4u);
    for (const Dart d : line) sheet.follow(dissociate_edge(sheet.body.map, d));
    // across, the middle one of three springs in each line reached over the cut and is gone; those that end on it stay
    EXPECT_NEAR(sheet.energy(), axis == 0 ? before : before * 2 / 3, 1e-14);
  }
}

}  // namespace
}  // namespace dartboard::inner_edges_view_test
