// Membranes on a map: their corners and rest shapes follow its changes.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/elements/membrane_law.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/split_off.h"
#include "core/views/element_nodes_view.h"
#include "tests/support/bodies/membrane_body_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::membrane_nodes_test {
namespace {

using Eigen::Vector3d;
using Surface = AdaptedBody<Map2>;

/// Triangles have the one law, surfaces with quadrilaterals the other.
Material material_for(const Mesh& mesh) {
  Material material = sheet_material();
  if (mesh.nodes.size() > 3 * mesh.cell_count()) material.model = Model::corotational;
  return material;
}

Problem problem_of(Mesh mesh) {
  Problem problem;
  problem.material = material_for(mesh);
  problem.mesh = std::move(mesh);
  return problem;
}

/// The views and the term of a surface, for either kind.
struct SurfaceViews {
  TriangleNodesView triangles;
  SolidNodesView cells;
  friend bool operator==(const SurfaceViews&, const SurfaceViews&) = default;

  void rebuild(const Surface& body) {
    triangles.rebuild(body);
    cells.rebuild(body);
  }
  void apply(const Surface& body, const ChangedEmbeddings& changed) {
    triangles.apply(body, changed);
    cells.apply(body, changed);
  }
  std::vector<std::uint32_t> corners(std::size_t c) const {
    if (cells.nodes.empty()) return {triangles.nodes[c].begin(), triangles.nodes[c].end()};
    return {cells.nodes[c].at.begin(), cells.nodes[c].at.begin() + cells.nodes[c].count};
  }
  std::unique_ptr<ForceTerm> term(const Surface& body) const {
    if (cells.nodes.empty())
      return make_membranes(body.cell_materials(), {triangles.nodes, shapes_of<PlaneInverse>(body.elements)});
    return make_membranes(body.cell_materials(), {cells.nodes, shapes_of<MembraneShape>(body.elements)});
  }
};

/// A surface with its views and its force term, shaken out of rest.
struct Sheet {
  Mesh mesh;
  Surface body;
  SurfaceViews views;
  std::unique_ptr<ForceTerm> term;

  explicit Sheet(const Mesh& of) : mesh(of), body(build_body<Map2, Held::by_every_dart>(problem_of(of))) {
    views.rebuild(body);
    term = views.term(body);
    SplitMix64 random(5);
    for (Vector3d& x : body.vertices.position)
      for (double& c : x) c += 0.02 * random.next_signed();
  }
  double energy() const { return term->energy(body.vertices.position); }
  void follow(const TopologyChange& change) { views.apply(body, adapt(body, change)); }
  /// The force at each mesh point, summed over its vertices.
  std::vector<Vector3d> forces() const {
    std::vector<Vector3d> force(body.vertices.size(), Vector3d(0, 0, 0)), sum(mesh.points.size(), Vector3d(0, 0, 0));
    term->add_forces({body.vertices.position}, force);
    for (std::size_t k = 0; k < force.size(); ++k) sum[body.vertices.point[k]] += force[k];
    return sum;
  }
};

std::vector<Mesh> sheets() { return {saddle(crooked_triangles(6, 5)), saddle(mixed_sheet(6, 5))}; }

// If the corners of each cell are at the mesh's points, its rest shape is that of the mesh, to the bit. So forces and
// energies are those of a surface that is built from the remaining cells, which the last lines build.
void expect_to_be_as_built_anew(const Sheet& sheet) {
  SurfaceViews rebuilt;
  rebuilt.rebuild(sheet.body);
  ASSERT_EQ(sheet.views, rebuilt);
  Mesh left;
  left.points.resize(sheet.body.vertices.size());
  for (std::size_t k = 0; k < left.points.size(); ++k) left.points[k] = sheet.mesh.points[sheet.body.vertices.point[k]];
  for (std::size_t c = 0; c < sheet.body.cell_dart.size(); ++c) {
    const auto corners = sheet.views.corners(c);
    left.add_cell(corners.size() == 3 ? CellKind::triangle : CellKind::quadrilateral, corners);
  }
  MembraneBody anew(left, sheet.body.material);
  anew.x = sheet.body.vertices.position;
  if (!shapes_of<PlaneInverse>(sheet.body.elements).empty()) {
    ASSERT_EQ(shapes_of<PlaneInverse>(sheet.body.elements), anew.triangle_shape);
  }
  // the rest of a mixed sheet may be triangles alone
  if (shapes_of<MembraneShape>(sheet.body.elements).empty() || !anew.shape.empty()) {
    ASSERT_EQ(shapes_of<MembraneShape>(sheet.body.elements), anew.shape);
    ASSERT_EQ(sheet.energy(), anew.energy());
  }
  ASSERT_NEAR(sheet.energy(), anew.energy(), 1e-15 * anew.energy());
  std::vector<Vector3d> force(anew.x.size(), Vector3d(0, 0, 0)), same = force;
  sheet.term->add_forces({anew.x}, force);
  anew.term->add_forces({anew.x}, same);
  ASSERT_EQ(force, same);
}

TEST(MembranesOnAMap, FollowAThousandRandomOperations) {
  int operations = 0;
  for (const Mesh& mesh : {crooked_triangles(20, 16), mixed_sheet(20, 16)}) {
    Sheet sheet(saddle(mesh));
    SplitMix64 random(11);
    const auto operate = [&](const TopologyChange& change) {
      sheet.follow(change);
      ++operations;
      // not after each, as it inspects the whole sheet: a fault stays
      if (operations % 10 == 0) expect_to_be_as_built_anew(sheet);
    };
    for (int k = 0; k < 300; ++k) operate(dissociate_something(sheet.body.map, random));
    while (sheet.body.map.dart_count() > 0 && !HasFatalFailure()) operate(do_something(sheet.body.map, random));
  }
  EXPECT_GT(operations, 1000);
}

// Corners that come apart stay where they are: no force on a cell and no energy changes, to the bit.
TEST(MembranesOnAMap, KeepTheirEnergyWhereEdgesComeApart) {
  for (const Mesh& mesh : sheets()) {
    Sheet sheet(mesh);
    const double before = sheet.energy();
    ASSERT_GT(before, 0.0);
    const auto forces = sheet.forces();
    SplitMix64 random(12);
    for (int k = 0; k < 40; ++k) {
      sheet.follow(dissociate_something(sheet.body.map, random));
      ASSERT_EQ(sheet.energy(), before) << k;
    }
    const auto after = sheet.forces();
    double largest = 0.0;
    for (const Vector3d& f : forces) largest = std::max(largest, f.norm());
    // sums in another order
    for (std::size_t p = 0; p < forces.size(); ++p) EXPECT_LE((after[p] - forces[p]).norm(), 1e-13 * largest) << p;
  }
}

TEST(MembranesOnAMap, LoseTheEnergyOfWhatIsRemovedAndNoMore) {
  for (const Mesh& mesh : sheets()) {
    Sheet sheet(mesh);
    SplitMix64 random(13);
    for (int k = 0; k < 15; ++k) {
      const Dart d = some_live_dart(sheet.body.map, random);
      const std::uint32_t c = sheet.body.cell(sheet.body.map, d);
      const double own = sheet.term->energy(sheet.body.vertices.position, c, sheet.term->size()),
                   before = sheet.energy();
      ASSERT_GT(own, 0.0);
      sheet.follow(remove_face(sheet.body.map, d));
      EXPECT_NEAR(sheet.energy(), before - own, 1e-14 * before) << k;
    }
  }
}

TEST(MembranesOnAMap, TakeTheirShapesAlongWhenAPartIsSplitOff) {
  for (Mesh mesh : sheets()) {
    Mesh far = mesh;
    for (Vector3d& p : far.points) p += Vector3d(3, 0, 0);
    append(mesh, far);
    const Sheet sheet(mesh);
    Surface rest = sheet.body;
    const auto split = split_off(rest, sheet.body.cell_dart[0]);
    const auto energy_of = [](const Surface& body) {
      SurfaceViews views;
      views.rebuild(body);
      return views.term(body)->energy(body.vertices.position);
    };
    EXPECT_GT(energy_of(split.part), 0.1 * sheet.energy());
    EXPECT_NEAR(energy_of(rest) + energy_of(split.part), sheet.energy(), 1e-14 * sheet.energy());
  }
}

// One vertex at a time and all at once: the same stress, to the bit; for a uniform strain, Cauchy's tension: that per
// present length.
TEST(MembranesOnAMap, HaveTheStressOfTheirLawAtEveryVertex) {
  SurfaceGradient f;
  f << 1.2, 0.1, 0.05, 0.9, -0.3, 0.4;
  for (const Mesh& mesh : {crooked_triangles(6, 5), mixed_sheet(6, 5)})
    for (const bool uniform : {false, true}) {
      const double growth = f.col(0).cross(f.col(1)).norm();
      const Eigen::Matrix3d cauchy = MembraneLaw(material_for(mesh)).stress(f) * f.transpose() / growth;
      Sheet sheet(mesh);
      VertexColumns& v = sheet.body.vertices;
      if (uniform)
        for (std::size_t k = 0; k < v.size(); ++k) v.position[k] = f * mesh.points[v.point[k]].head<2>();
      const ForceTerm* terms[] = {sheet.term.get()};
      std::vector<Eigen::Matrix3d> stress;
      vertex_stresses({}, {}, {v.mass, sheet_material().density}, v.position, stress, terms);
      for (std::uint32_t k = 0; k < stress.size(); ++k) {
        EXPECT_EQ(stress[k], vertex_stress(sheet.body, k)) << k;
        if (uniform) {
          EXPECT_LE((stress[k] - cauchy).norm(), 1e-12 * cauchy.norm()) << k;
        }
      }
    }
}

// A surface of springs holds no membrane data, and one of membranes only those of its kind.
TEST(MembranesOnAMap, AreHeldWhereTheyAreNeeded) {
  Problem springs = problem_of(mixed_sheet(3, 3));
  springs.material = {.density = 0.5, .stiffness = 4.0};
  const Surface of_springs = build_body<Map2, Held::by_every_dart>(springs);
  EXPECT_TRUE(shapes_of<PlaneInverse>(of_springs.elements).empty() &&
              shapes_of<MembraneShape>(of_springs.elements).empty());
  SurfaceViews views;
  views.rebuild(of_springs);
  EXPECT_TRUE(views.cells.nodes.empty() && views.triangles.nodes.empty());
  const Sheet triangles(crooked_triangles(3, 3)), mixed(mixed_sheet(3, 3));
  EXPECT_EQ(shapes_of<PlaneInverse>(triangles.body.elements).size(), 18u);
  EXPECT_TRUE(shapes_of<MembraneShape>(triangles.body.elements).empty() && triangles.views.cells.nodes.empty());
  EXPECT_EQ(shapes_of<MembraneShape>(mixed.body.elements).size(), mixed.mesh.cell_count());
  EXPECT_TRUE(shapes_of<PlaneInverse>(mixed.body.elements).empty() && mixed.views.triangles.nodes.empty());
}

TEST(MembranesOnAMap, AreFlatNowhereAndOfTheirOwnModel) {
  const auto message = [](Mesh mesh, auto&& change) {
    Problem problem = problem_of(std::move(mesh));
    change(problem.material);
    try {
      build_body<Map2, Held::by_every_dart>(problem);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(quad_sheet(2, 1, 1.0), [](Material&) {}), "");
  Mesh crushed = quad_sheet(1, 1, 1.0);
  crushed.points[3] = {0.1, 0.1, 0.0};  // its area is still above 0
  EXPECT_EQ(message(crushed, [](Material&) {}),
            "cell 0, a quadrilateral, is flat or turned over at one of its corners");
  EXPECT_EQ(message(quad_sheet(1, 1, 1.0), [](Material& m) { m.model = Model::neo_hookean; }),
            "cell 0 is a quadrilateral, which the model 'neo-hookean' has no element for; expected 'stvk' or "
            "'corotational', or solid cells");
  EXPECT_EQ(message(quad_sheet(1, 1, 1.0), [](Material& m) { m.poisson = 0.5; }),
            "poisson is 0.5, expected more than -1 and less than 0.5");
}

}  // namespace
}  // namespace dartboard::membrane_nodes_test
