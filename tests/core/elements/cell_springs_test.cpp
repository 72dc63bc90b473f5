#include "core/elements/cell_springs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/mechanics/add_cell_springs.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/split_off.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/views/element_nodes_view.h"
#include "core/views/spring_ends.h"
#include "tests/support/bodies/term_checks_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::cell_springs_test {
namespace {

using Eigen::Vector3d;

/// The stiffness of edges to which diagonals are added, a mean over them, as scenes compute it; any number will do.
constexpr double mean = 3.0;

Problem problem_of(Mesh mesh, double young) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 1000.0, .stiffness = young > 0 ? mean : 40.0, .damping = 0.0, .young = young};
  return problem;
}

/// A body with its springs within cells.
template <class Map>
struct Braced {
  AdaptedBody<Map> body;
  SolidNodesView view;
  SpringEndsView ends;
  std::unique_ptr<ForceTerm> term;

  Braced(const Mesh& mesh, Diagonals which, double young = 0.0)
      : body(build_body<Map, Held::by_every_dart>(problem_of(mesh, young))) {
    add_cell_springs(body, mesh, which);
    view.rebuild(body);
    ends.rebuild(body);
    term = make_cell_springs({view.nodes, body.cell_springs});
  }
  void shake(double size) {
    SplitMix64 random(5);
    for (Vector3d& x : body.vertices.position)
      for (double& c : x) c += size * random.next_signed();
  }
  double energy() const { return term->energy(body.vertices.position); }
  void follow(const TopologyChange& change) {
    const ChangedEmbeddings changed = adapt(body, change);
    view.apply(body, changed);
    ends.apply(body, changed);
  }
};

TEST(CellSprings, PullAlongTheSlopeOfTheirEnergyAndStiffenAsTheyDo) {
  for (const double young : {0.0, 2e4})
    for (const Diagonals which : {Diagonals::faces, Diagonals::volumes, Diagonals::all}) {
      Braced<Map3> braced(mixed_box(3, 3, 3, 0.1), which, young);
      braced.shake(0.02);
      expect_consistent(*braced.term, braced.body.vertices.position, 0.1);
    }
  Braced<Map2> sheet(quad_sheet(4, 3, 0.1), Diagonals::faces, 30.0);
  sheet.shake(0.02);
  expect_consistent(*sheet.term, sheet.body.vertices.position, 0.1);
}

// By hand: corner to corner of one cube, stretched along x.
TEST(CellSprings, OfOneCubePullAsTheirLengthsHaveIt) {
  for (const Diagonals which : {Diagonals::faces, Diagonals::volumes, Diagonals::all}) {
    Braced<Map3> cube(hexahedron_box(1, 1, 1, 2.0), which);
    for (Vector3d& x : cube.body.vertices.position) x[0] *= 1.5;
    const double across = std::sqrt(13.0) - std::sqrt(8.0), through = std::sqrt(17.0) - std::sqrt(12.0);
    const double faces = 8 * 20.0 * across * across, volumes = 4 * 20.0 * through * through;
    EXPECT_NEAR(cube.energy(), (which == Diagonals::volumes ? 0 : faces) + (which == Diagonals::faces ? 0 : volumes),
                1e-13);
  }
}

// Pressed to half their lengths they push, and give way to rotations: except with the projected tangent.
TEST(CellSprings, GiveWayWhereTheyArePressedAndNoProjectedTangentDoes) {
  Braced<Map3> block(hexahedron_box(2, 2, 2, 0.1), Diagonals::faces);
  for (Vector3d& x : block.body.vertices.position) x *= 0.5;
  const auto& x = block.body.vertices.position;
  std::vector<Vector3d> turned;  // about the z axis
  for (const Vector3d& p : x) turned.emplace_back(-p[1], p[0], 0.0);
  const double gives_way = dot(product_of(*block.term, x, turned), turned);
  EXPECT_LT(gives_way, 0.0);
  // a rotation changes no length, to rounding
  EXPECT_GE(dot(product_of(*block.term, x, turned, Compression::projected), turned), 1e-12 * gives_way);
}

/// Linear forces of edges and diagonals at the displacement u.
template <class Map>
std::vector<Vector3d> linear_forces(const Braced<Map>& braced, const std::vector<Vector3d>& u) {
  const auto& x = braced.body.vertices.position;
  std::vector<Vector3d> force = product_of(*braced.term, x, u);
  for (std::size_t k = 0; k < braced.ends.ends.size(); ++k) {
    const auto [i, j] = braced.ends.ends[k];
    const Vector3d along = (x[j] - x[i]).normalized();
    const Vector3d f = braced.body.springs[k].stiffness * along.dot(u[j] - u[i]) * along;
    force[i] -= f;
    force[j] += f;
  }
  return force;
}

// Pulled along z by a strain e, and thinner by e times Poisson's ratio, a lattice of any size is in balance with the
// traction E e on its ends alone: no force within, and none on its sides.
TEST(CellSprings, MakeALatticeOfCubesTheSolidOfItsYoungsModulus) {
  const double young = 2e4, e = 1e-3, a = 0.1;
  for (const Diagonals which : {Diagonals::faces, Diagonals::volumes, Diagonals::all})
    for (const auto& [nx, ny, nz] : {std::array{1, 1, 1}, {2, 3, 4}, {5, 1, 2}}) {
      const Braced<Map3> block(hexahedron_box(nx, ny, nz, a), which, young);
      std::vector<Vector3d> u;
      for (const Vector3d& x : block.body.vertices.position) u.push_back(e * Vector3d(-x[0] / 4, -x[1] / 4, x[2]));
      const auto force = linear_forces(block, u);
      for (std::size_t k = 0; k < u.size(); ++k) {
        const Vector3d& x = block.body.vertices.position[k];
        const auto share = [a](double at, int n) { return at < a / 2 || at > a * n - a / 2 ? a / 2 : a; };
        const double end = x[2] < a / 2 ? -1.0 : x[2] > a * nz - a / 2 ? 1.0 : 0.0;
        const Vector3d pull(0, 0, end * young * e * share(x[0], nx) * share(x[1], ny));
        EXPECT_LE((force[k] - pull).norm(), 1e-12 * young * e * a * a) << name(which) << ", " << x.transpose();
      }
    }
}

TEST(CellSprings, MakeASheetOfSquaresOneOfItsYoungsModulus) {
  const double young = 30.0, e = 1e-3, a = 0.1;
  const Braced<Map2> sheet(quad_sheet(4, 3, a), Diagonals::faces, young);
  std::vector<Vector3d> u;
  for (const Vector3d& x : sheet.body.vertices.position) u.push_back(e * Vector3d(x[0], -x[1] / 3, 0));
  const auto force = linear_forces(sheet, u);
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Vector3d& x = sheet.body.vertices.position[k];
    const double share = x[1] < a / 2 || x[1] > 2.5 * a ? a / 2 : a;
    const double end = x[0] < a / 2 ? -1.0 : x[0] > 3.5 * a ? 1.0 : 0.0;
    EXPECT_LE((force[k] - Vector3d(end * young * e * share, 0, 0)).norm(), 1e-12 * young * e * a);
  }
}

/// A body through random operations until nothing is left: the view, and every cell's own rest lengths.
template <class Map>
void expect_followed(const Mesh& mesh) {
  Braced<Map> braced(mesh, Diagonals::all);
  SplitMix64 random(11);
  int operations = 0;
  while (braced.body.map.dart_count() > 0) {
    braced.follow(do_something(braced.body.map, random));
    SolidNodesView rebuilt;
    rebuilt.rebuild(braced.body);
    ASSERT_EQ(braced.view, rebuilt) << operations;
    ASSERT_EQ(braced.body.cell_springs.size(), braced.view.nodes.size());
    for (std::uint32_t c = 0; c < rebuilt.nodes.size(); ++c) {
      const CellSprings& springs = braced.body.cell_springs[c];
      std::size_t k = 0;
      for (const CornerSpring& s : diagonals_of(springs.kind, springs.which)) {
        const auto place = [&](int corner) {
          return mesh.points[braced.body.vertices.point[rebuilt.nodes[c].at[static_cast<std::size_t>(corner)]]];
        };
        ASSERT_EQ(springs.rest_length[k++], (place(s.b) - place(s.a)).norm()) << c;
      }
    }
    ++operations;
  }
  EXPECT_GT(operations, 15);
}

TEST(CellSprings, FollowRandomOperationsUntilNothingIsLeft) {
  Mesh crooked = mixed_box(3, 3, 3, 0.1), sheet = quad_sheet(5, 4, 0.1);
  SplitMix64 random(3);
  for (Mesh* mesh : {&crooked, &sheet})
    for (Vector3d& p : mesh->points)
      for (double& c : p) c += 0.008 * random.next_signed();
  expect_followed<Map3>(crooked);
  expect_followed<Map2>(sheet);
}

// Each cell has springs of its own: cells that come apart keep them, to the bit; removed cells take theirs along.
template <class Map>
void expect_energy_of_cells(const Mesh& mesh) {
  Braced<Map> braced(mesh, Diagonals::all);
  braced.shake(0.01);
  const double before = braced.energy();
  ASSERT_GT(before, 0.0);
  SplitMix64 random(12);
  for (int k = 0; k < 40; ++k) {
    braced.follow(dissociate_something(braced.body.map, random));
    ASSERT_EQ(braced.energy(), before) << k;
  }
  for (int k = 0; k < 8; ++k) {
    const Dart d = some_live_dart(braced.body.map, random);
    const std::uint32_t c = braced.body.cell(braced.body.map, d);
    const auto& x = braced.body.vertices.position;
    const double own = braced.term->energy(x, c, braced.term->size()), all = braced.energy();
    const CellKind kind = braced.body.cell_springs[c].kind;
    EXPECT_EQ(own > 0.0, kind != CellKind::tetrahedron);
    if constexpr (Map::dimension == 3)
      braced.follow(remove_volume(braced.body.map, d));
    else
      braced.follow(remove_face(braced.body.map, d));
    EXPECT_NEAR(braced.energy(), all - own, 1e-14 * before) << k;
  }
}

TEST(CellSprings, KeepTheirEnergyWhereCellsComeApartAndLoseTheirOwnWhereOneGoes) {
  expect_energy_of_cells<Map3>(mixed_box(3, 3, 3, 0.1));
  expect_energy_of_cells<Map2>(quad_sheet(5, 4, 0.1));
}

TEST(CellSprings, GoAlongWhenAPartIsSplitOff) {
  Mesh mesh = hexahedron_box(2, 2, 1, 0.1);
  Mesh other = hexahedron_box(1, 2, 2, 0.1);
  for (Vector3d& p : other.points) p[0] += 1.0;
  append(mesh, other);
  Braced<Map3> braced(mesh, Diagonals::faces);
  braced.shake(0.01);
  const auto energy_of = [](const AdaptedBody<Map3>& body) {
    SolidNodesView view;
    view.rebuild(body);
    return make_cell_springs({view.nodes, body.cell_springs})->energy(body.vertices.position);
  };
  const double whole = braced.energy();
  const auto split = split_off(braced.body, braced.body.cell_dart[0]);
  EXPECT_GT(energy_of(split.part), 0.0);
  EXPECT_NEAR(energy_of(braced.body) + energy_of(split.part), whole, 1e-14 * whole);
}

// One vertex at a time and all at once: the same stress, to the bit. Of a small uniform strain, the stress of the
// solid: 2 mu e + lambda tr(e), both moduli 0.4 E, at every vertex; to the strain itself.
TEST(CellSprings, HaveTheStressOfTheirSolidAtEveryVertex) {
  const double young = 2e4;
  for (const bool uniform : {false, true}) {
    Braced<Map3> braced(uniform ? hexahedron_box(3, 2, 2, 0.1) : mixed_box(2, 2, 2, 0.1), Diagonals::faces, young);
    Eigen::Matrix3d strain;
    strain << 2, 1, 0, 1, -1, 3, 0, 3, 1;
    strain *= 1e-6;
    if (uniform)
      for (Vector3d& x : braced.body.vertices.position) x += strain * x;
    else
      braced.shake(0.01);
    const ForceTerm* terms[] = {braced.term.get()};
    std::vector<Eigen::Matrix3d> stress;
    VolumeRoom room;
    vertex_stresses(braced.ends.ends, braced.body.springs, vertex_volumes(braced.body, {}, room),
                    braced.body.vertices.position, stress, terms);
    Eigen::Matrix3d mean_stress = Eigen::Matrix3d::Zero();
    double mass = 0.0;
    for (std::uint32_t k = 0; k < stress.size(); ++k) {
      EXPECT_EQ(stress[k], vertex_stress(braced.body, k)) << k;
      mean_stress += braced.body.vertices.mass[k] * stress[k];
      mass += braced.body.vertices.mass[k];
    }
    const Eigen::Matrix3d expected = 0.4 * young * (2.0 * strain + strain.trace() * Eigen::Matrix3d::Identity());
    if (uniform) {
      EXPECT_LE((mean_stress / mass - expected).norm(), 2e-5 * expected.norm());
    }
  }
}

TEST(CellSprings, AreNoneInABodyOfTetrahedra) {
  const Mesh mesh = kuhn_box(2, 2, 2, 0.1);
  AdaptedBody<TetMap> body = build_body<TetMap, Held::by_every_dart>(problem_of(mesh, 0.0));
  add_cell_springs(body, mesh, Diagonals::all);
  EXPECT_TRUE(body.cell_springs.empty());
}

}  // namespace
}  // namespace dartboard::cell_springs_test
