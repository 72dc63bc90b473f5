// Bodies whose cells are made of several materials: every cell contributes by its own, through all operations.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/elements/tetrahedra.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/refine.h"
#include "core/mechanics/split_off.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/views/element_nodes_view.h"
#include "tests/support/random_operations.h"

namespace dartboard::several_materials_test {
namespace {

using Eigen::Vector3d;

constexpr Material soft{.density = 1000.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
constexpr Material stiff{.density = 1500.0, .stiffness = 16.0, .damping = 0.5, .viscosity = 0.5};
constexpr Material rubber{.density = 1200.0,
                          .stiffness = 0.0,
                          .damping = 0.0,
                          .viscosity = 0.5,
                          .young = 2e4,
                          .poisson = 0.3,
                          .model = Model::neo_hookean};
constexpr Material bone{.density = 1800.0,
                        .stiffness = 0.0,
                        .damping = 0.0,
                        .viscosity = 0.5,
                        .young = 9e4,
                        .poisson = 0.2,
                        .model = Model::corotational};

/// Cell c is of material c modulo their number.
Problem of_several(Mesh mesh, std::vector<Material> materials) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = materials[0];
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c)
    problem.cell_material.push_back(static_cast<MaterialNumber>(c % materials.size()));
  problem.materials = std::move(materials);
  return problem;
}
Mesh box() { return kuhn_box(2, 2, 2, 0.1, 0.2, 7); }

TEST(SeveralMaterials, GiveEveryVertexAndEdgeWhatItsCellsAreMadeOf) {
  const Problem problem = of_several(box(), {soft, stiff});
  const auto body = build_body<TetMap, Held::by_every_dart>(problem);
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) {
    double mass = 0.0, volume = 0.0;
    for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c)
      if (std::ranges::count(problem.mesh.cell(c), body.vertices.point[k]) > 0) {
        const double share = std::abs(signed_measure(problem.mesh, c)) / 4.0;
        mass += share * (c % 2 == 0 ? 1000.0 : 1500.0);
        volume += share;
      }
    // sums of at most 32 cells in another order
    EXPECT_NEAR(body.vertices.mass[k] / mass, 1.0, 32 * 0x1p-52);
    EXPECT_NEAR(body.volume_of(Vertex{body.vertices.dart[k]}) / volume, 1.0, 32 * 0x1p-52);
    EXPECT_EQ(body.vertices.viscosity[k], 0.5 * body.vertices.mass[k]);
  }
  for (std::uint32_t e = 0; e < body.springs.size(); ++e) {
    const Dart d = body.edge_dart[e];
    const std::uint32_t a = body.vertices.point[body.vertex(body.map, d)],
                        b = body.vertices.point[body.vertex(body.map, body.map.alpha<0>(d))];
    double stiffness = 0.0, damping = 0.0;
    for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c)
      if (std::ranges::count(problem.mesh.cell(c), a) > 0 && std::ranges::count(problem.mesh.cell(c), b) > 0) {
        stiffness += c % 2 == 0 ? 4.0 : 16.0;
        damping += c % 2 == 0 ? 0.25 : 0.5;
      }
    EXPECT_EQ(body.springs[e].stiffness, stiffness);  // sums of powers of two are exact
    EXPECT_EQ(body.springs[e].damping, damping);
  }
}

TEST(SeveralMaterials, OfEqualCellsHaveTheBitsOfOne) {
  Problem one;
  one.mesh = box();
  one.material = stiff;
  const auto a = build_body<TetMap, Held::by_every_dart>(one);
  const auto b = build_body<TetMap, Held::by_every_dart>(of_several(box(), {stiff, stiff, stiff}));
  EXPECT_EQ(a.vertices.mass, b.vertices.mass);
  ASSERT_EQ(a.springs.size(), b.springs.size());
  for (std::size_t e = 0; e < a.springs.size(); ++e) {
    EXPECT_EQ(a.springs[e].stiffness, b.springs[e].stiffness);
    EXPECT_EQ(a.springs[e].damping, b.springs[e].damping);
  }
}

/// Masses, stiffnesses and dampings of a body after operations equal those of one that is built anew from its present
/// cells, by their own numbers.
template <class Map>
void expect_as_rebuilt(const AdaptedBody<Map>& body) {
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
    ASSERT_EQ(body.vertices.mass[k], body.mass_of(Vertex{body.vertices.dart[k]}));
  for (std::uint32_t e = 0; e < body.springs.size(); ++e) {
    const Spring spring = body.spring_of(Edge{body.edge_dart[e]}, body.springs[e].rest_length);
    ASSERT_EQ(body.springs[e].stiffness, spring.stiffness);
    ASSERT_EQ(body.springs[e].damping, spring.damping);
  }
  ASSERT_EQ(body.cell_material.size(), body.cell_dart.size());
  for (std::size_t c = 0; c < body.cell_dart.size(); ++c) ASSERT_EQ(body.cell_mass[c] / body.node_share[c], 4.0);
}

// The total is the sum over the remaining cells: masses are powers of two times 2^-k / 3, so sums are not exact.
TEST(SeveralMaterials, FollowRandomOperationsUntilNothingIsLeft) {
  const Problem problem = of_several(box(), {soft, stiff, rubber});
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  operate_at_random(body, 11, 400, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings&) {
    expect_as_rebuilt(now);
    double stiffness = 0.0, expected = 0.0, mass = 0.0, of_vertices = 0.0;
    for (std::uint32_t e = 0; e < now.springs.size(); ++e) stiffness += now.springs[e].stiffness;
    for (std::size_t c = 0; c < now.cell_dart.size(); ++c) {
      expected += 6.0 * std::array{4.0, 16.0, 0.0}[now.cell_material[c]];
      mass += now.cell_mass[c];
    }
    for (const double m : now.vertices.mass) of_vertices += m;
    EXPECT_EQ(stiffness, expected);  // of six edges of each cell, shared or not
    EXPECT_NEAR(of_vertices, mass, 1e-13 * mass);
  });
  EXPECT_EQ(body.cell_dart.size(), 0u);
}

/// The force of each mesh point, of a body of elements, summed over its vertices.
std::vector<Vector3d> element_forces(const AdaptedBody<TetMap>& body, std::size_t points) {
  TetrahedronNodesView view;
  view.rebuild(body);
  const auto term =
      make_tetrahedra(body.cell_materials(), {view.nodes, shapes_of<RestShape>(body.elements), body.cell_mass});
  std::vector<Vector3d> force(body.vertices.size(), Vector3d::Zero()), sum(points, Vector3d::Zero());
  term->add_forces({body.vertices.position}, force);
  for (std::size_t k = 0; k < force.size(); ++k) sum[body.vertices.point[k]] += force[k];
  return sum;
}

// Each cell as a body of its own, of one material: forces of cells add up.
TEST(SeveralMaterials, PullByTheLawOfEachCell) {
  const Problem problem = of_several(box(), {rubber, bone, soft});
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  ASSERT_EQ(shapes_of<RestShape>(body.elements).size(), problem.mesh.cell_count());
  SplitMix64 random(3);
  std::vector<Vector3d> place = problem.mesh.points;
  for (Vector3d& x : place)
    for (double& c : x) c += 0.01 * random.next_signed();
  for (std::size_t k = 0; k < place.size(); ++k) body.vertices.position[k] = place[body.vertices.point[k]];
  const auto together = element_forces(body, place.size());
  std::vector<Vector3d> apart(place.size(), Vector3d::Zero());
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) {
    if (problem.cell_material[c] == 2) continue;  // springs
    Problem alone;
    alone.material = problem.materials[problem.cell_material[c]];
    const std::vector<std::uint32_t> nodes{0, 1, 2, 3};
    for (const std::uint32_t p : problem.mesh.cell(c)) alone.mesh.points.push_back(problem.mesh.points[p]);
    alone.mesh.add_cell(CellKind::tetrahedron, nodes);
    auto cell = build_body<TetMap, Held::by_every_dart>(alone);
    for (std::size_t k = 0; k < 4; ++k) cell.vertices.position[k] = place[problem.mesh.cell(c)[cell.vertices.point[k]]];
    const auto force = element_forces(cell, 4);
    for (std::size_t k = 0; k < 4; ++k) apart[problem.mesh.cell(c)[k]] += force[k];
  }
  double size = 0.0;
  for (const Vector3d& f : apart) size = std::max(size, f.norm());
  ASSERT_GT(size, 0.1);
  // each is a sum of at most 24 terms of that size
  for (std::size_t p = 0; p < place.size(); ++p) EXPECT_LT((together[p] - apart[p]).norm(), 24 * 0x1p-50 * size) << p;
}

TEST(SeveralMaterials, StayWithCellsThatAreSplitOffOrRefined) {
  auto body = build_body<TetMap, Held::by_every_dart>(of_several(box(), {rubber, bone}));
  double mass[2] = {0.0, 0.0};
  for (std::size_t c = 0; c < body.cell_dart.size(); ++c) mass[body.cell_material[c]] += body.cell_mass[c];
  for (int k = 0; k < 20; ++k)
    adapt(body, subdivide(body.map, Volume{body.cell_dart[static_cast<std::size_t>(k)]}), 0.0);
  ASSERT_EQ(body.cell_dart.size(), 48u + 60u);
  ASSERT_EQ(body.cell_material.size(), body.cell_dart.size());
  double now[2] = {0.0, 0.0};
  for (std::size_t c = 0; c < body.cell_dart.size(); ++c) now[body.cell_material[c]] += body.cell_mass[c];
  EXPECT_NEAR(now[0], mass[0], 1e-14);
  EXPECT_NEAR(now[1], mass[1], 1e-14);
  const auto split = split_off(body, body.cell_dart[0]);
  EXPECT_EQ(split.part.cell_material.size(), 108u);
  ASSERT_EQ(split.part.materials.size(), 2u);
  EXPECT_EQ(split.part.materials[1].density, bone.density);
}

// A stretched bar of two materials side by side: each has the stress of its own law.
TEST(SeveralMaterials, HaveStressesOverVolumesAndNotOverMasses) {
  const Problem problem = of_several(box(), {rubber, rubber});
  Problem heavy = problem;
  heavy.materials[1].density *= 8.0;  // the law is the same
  auto a = build_body<TetMap, Held::by_every_dart>(problem);
  auto b = build_body<TetMap, Held::by_every_dart>(heavy);
  for (auto* body : {&a, &b})
    for (Vector3d& x : body->vertices.position) x.x() *= 1.25;
  for (std::uint32_t k = 0; k < a.vertices.size(); ++k) {
    const Eigen::Matrix3d stress = vertex_stress(a, k);
    ASSERT_GT(stress(0, 0), 1000.0);
    EXPECT_LT((stress - vertex_stress(b, k)).norm(), 1e-12 * stress.norm()) << k;
  }
  VolumeRoom room;
  std::vector<Eigen::Matrix3d> all;
  TetrahedronNodesView view;
  view.rebuild(b);
  const auto term = make_tetrahedra(b.cell_materials(), {view.nodes, shapes_of<RestShape>(b.elements), b.cell_mass});
  const ForceTerm* terms[] = {term.get()};
  vertex_stresses({}, {}, vertex_volumes(b, {}, room), b.vertices.position, all, terms);
  for (std::uint32_t k = 0; k < b.vertices.size(); ++k)
    EXPECT_LT((all[k] - vertex_stress(b, k)).norm(), 1e-12 * all[k].norm()) << k;
}

TEST(SeveralMaterials, AreRefusedWhereACellHasNone) {
  const auto refusal = [](Problem problem) -> std::string {
    try {
      build_body<TetMap, Held::by_every_dart>(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  Problem problem = of_several(box(), {soft, stiff});
  problem.cell_material[5] = 2;
  EXPECT_EQ(refusal(problem), "the material of cell 5 is 2, expected less than 2");
  problem.cell_material.pop_back();
  EXPECT_EQ(refusal(problem), "47 numbers of materials for 48 cells of a body of several, expected 48");
  problem.materials.clear();
  EXPECT_EQ(refusal(problem), "47 numbers of materials for 48 cells of a body of one, expected 0");
  EXPECT_EQ(refusal(of_several(box(), std::vector<Material>(257, soft))), "257 materials, expected at most 256");
  problem = of_several(box(), {soft, stiff});
  problem.materials[1].density = 0.0;
  EXPECT_EQ(refusal(problem), "density is 0, expected a positive number of kg/m^3");
}

}  // namespace
}  // namespace dartboard::several_materials_test
