// Elements on a map: their corners and rest shapes follow its changes.

#include "core/views/element_nodes_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <vector>

#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/refine.h"
#include "core/mechanics/split_off.h"
#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/random_operations.h"

namespace dartboard::element_nodes_view_test {
namespace {

using Eigen::Vector3d;

Problem problem_of(Mesh mesh, Model model) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 1000.0,
                      .stiffness = 0.0,
                      .damping = 0.0,
                      .viscosity = 0.5,
                      .young = 2e4,
                      .poisson = 0.3,
                      .model = model};
  return problem;
}

/// A body with its view and its force term, shaken out of rest.
template <class Map>
struct Elements {
  AdaptedBody<Map> body;
  TetrahedronNodesView view;
  std::unique_ptr<ForceTerm> term;
  std::vector<Vector3d> rest_of_point;

  explicit Elements(const Mesh& mesh, Model model = Model::neo_hookean)
      : body(build_body<Map, Held::by_every_dart>(problem_of(mesh, model))), rest_of_point(mesh.points) {
    view.rebuild(body);
    term = make_tetrahedra(body.material, {view.nodes, shapes_of<RestShape>(body.elements), body.cell_mass});
    SplitMix64 random(5);
    for (Vector3d& x : body.vertices.position)
      for (double& c : x) c += 0.02 * random.next_signed();
  }
  double energy() const { return term->energy(body.vertices.position); }
  void follow(const TopologyChange& change) { view.apply(body, adapt(body, change)); }
  /// The force at each mesh point, summed over its vertices.
  std::vector<Vector3d> forces() const {
    std::vector<Vector3d> force(body.vertices.size(), Vector3d(0, 0, 0)), sum(rest_of_point.size(), Vector3d(0, 0, 0));
    term->add_forces({body.vertices.position}, force);
    for (std::size_t k = 0; k < force.size(); ++k)
      if (body.vertices.point[k] != no_point) sum[body.vertices.point[k]] += force[k];
    return sum;
  }
};

Mesh box() { return kuhn_box(3, 2, 2, 0.1, 0.2, 7); }

template <class Map>
class ElementsOn : public testing::Test {};
using Maps = testing::Types<TetMap, Map3>;
TYPED_TEST_SUITE(ElementsOn, Maps);

// The rest shape of each cell is that of its corners in the mesh, after any operations.
template <class Map>
void expect_shapes_of_the_mesh(const Elements<Map>& e) {
  for (std::uint32_t c = 0; c < shapes_of<RestShape>(e.body.elements).size(); ++c) {
    std::array<Vector3d, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = e.rest_of_point[e.body.vertices.point[e.view.nodes[c][k]]];
    EXPECT_EQ(shapes_of<RestShape>(e.body.elements)[c], rest_shape_of(x[0], x[1], x[2], x[3])) << c;
  }
}

TYPED_TEST(ElementsOn, FollowRandomOperationsUntilNothingIsLeft) {
  Elements<TypeParam> e(box());
  SplitMix64 random(11);
  int operations = 0;
  while (e.body.map.dart_count() > 0) {
    e.follow(do_something(e.body.map, random));
    ++operations;
    TetrahedronNodesView rebuilt;
    rebuilt.rebuild(e.body);
    ASSERT_EQ(e.view, rebuilt) << operations;
    ASSERT_NO_FATAL_FAILURE(expect_shapes_of_the_mesh(e));
  }
  EXPECT_GT(operations, 30);
}

// Corners that come apart stay where they are: no force on a tetrahedron and no energy changes, to the bit.
TYPED_TEST(ElementsOn, KeepTheirEnergyWhereFacesComeApart) {
  Elements<TypeParam> e(box());
  const double before = e.energy();
  const auto forces = e.forces();
  SplitMix64 random(12);
  for (int k = 0; k < 60; ++k) {
    e.follow(dissociate_something(e.body.map, random));
    ASSERT_EQ(e.energy(), before) << k;
  }
  const auto after = e.forces();
  double largest = 0.0;
  for (const Vector3d& f : forces) largest = std::max(largest, f.norm());
  // sums in another order
  for (std::size_t p = 0; p < forces.size(); ++p) EXPECT_LE((after[p] - forces[p]).norm(), 1e-13 * largest) << p;
}

TYPED_TEST(ElementsOn, LoseTheEnergyOfWhatIsRemovedAndNoMore) {
  Elements<TypeParam> e(box());
  SplitMix64 random(13);
  for (int k = 0; k < 30; ++k) {
    const Dart d = some_live_dart(e.body.map, random);
    const std::uint32_t c = e.body.cell(e.body.map, d);
    const double own = e.term->energy(e.body.vertices.position, c, e.term->size()), before = e.energy();
    ASSERT_GT(own, 0.0);
    e.follow(remove_volume(e.body.map, d));
    EXPECT_NEAR(e.energy(), before - own, 1e-14 * before) << k;
  }
}

// An affine deformation of a subdivided tetrahedron has the same F in every child: the energy stays, and a new inner
// vertex has no force, so that forces at the old ones stay too. A new vertex on the boundary takes a share of the
// forces there, so the first ones are put inside tetrahedra.
TYPED_TEST(ElementsOn, KeepForcesAndEnergyWhereAffineTetrahedraAreRefined) {
  for (const Model model : {Model::neo_hookean, Model::corotational, Model::stvk}) {
    Elements<TypeParam> e(box(), model);
    Eigen::Matrix3d f;
    f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0.0, -0.2, 1.2;
    for (std::size_t k = 0; k < e.body.vertices.size(); ++k)
      e.body.vertices.position[k] = f * e.rest_of_point[e.body.vertices.point[k]];
    const double before = e.energy();
    const auto forces = e.forces();
    double largest = 0.0;
    for (const Vector3d& force : forces) largest = std::max(largest, force.norm());
    SplitMix64 random(14);
    for (int k = 0; k < 40; ++k) {
      if (k == 15) {
        const auto after = e.forces();
        for (std::size_t p = 0; p < forces.size(); ++p) {
          EXPECT_LE((after[p] - forces[p]).norm(), 1e-12 * largest) << p;
        }
      }
      const Dart d = some_live_dart(e.body.map, random);
      const ChangedEmbeddings changed = k < 15       ? refine(e.body, Volume{d}, 0.5)
                                        : k % 2 == 0 ? refine(e.body, Face{d}, 0.5)
                                                     : refine(e.body, Edge{d}, 0.5);
      e.view.apply(e.body, changed);
      TetrahedronNodesView rebuilt;
      rebuilt.rebuild(e.body);
      ASSERT_EQ(e.view, rebuilt) << k;
      EXPECT_NEAR(e.energy(), before, 1e-12 * before) << k;
    }
    std::vector<Vector3d> force(e.body.vertices.size(), Vector3d(0, 0, 0));
    e.term->add_forces({e.body.vertices.position}, force);
    int inside = 0;
    for (std::size_t k = 0; k < force.size(); ++k) {
      if (e.body.vertices.point[k] != no_point) continue;
      const auto around = incident_cells<2>(e.body.map, Vertex{e.body.vertices.dart[k]});
      if (std::ranges::any_of(around, [&](const Face& face) { return e.body.map.template is_free<3>(face.dart); }))
        continue;
      EXPECT_LE(force[k].norm(), 1e-12 * largest) << k;
      ++inside;
    }
    EXPECT_GT(inside, 5);
  }
}

TYPED_TEST(ElementsOn, TakeTheirShapesAlongWhenAPartIsSplitOff) {
  Elements<TypeParam> e(several_components(3));
  const double whole = e.energy();
  ASSERT_GT(whole, 0.0);
  AdaptedBody<TypeParam> rest = e.body;
  auto split = split_off(rest, e.body.cell_dart[0]);
  const auto energy_of = [](const AdaptedBody<TypeParam>& body) {
    TetrahedronNodesView view;
    view.rebuild(body);
    return make_tetrahedra(body.material, {view.nodes, shapes_of<RestShape>(body.elements), body.cell_mass})
        ->energy(body.vertices.position);
  };
  EXPECT_NEAR(energy_of(rest) + energy_of(split.part), whole, 1e-14 * whole);
}

// One vertex at a time and all at once: the same stress, to the bit; of a uniform strain, Cauchy's stress.
TYPED_TEST(ElementsOn, HaveTheStressOfTheirLawAtEveryVertex) {
  Elements<TypeParam> e(box());
  Eigen::Matrix3d f;
  f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0.0, -0.2, 1.2;
  for (const bool uniform : {false, true}) {
    if (uniform)
      for (std::size_t k = 0; k < e.body.vertices.size(); ++k)
        e.body.vertices.position[k] = f * e.rest_of_point[e.body.vertices.point[k]];
    const ForceTerm* terms[] = {e.term.get()};
    std::vector<Eigen::Matrix3d> stress;
    vertex_stresses({}, {}, {e.body.vertices.mass, 1000.0}, e.body.vertices.position, stress, terms);
    const Eigen::Matrix3d cauchy = NeoHookean(lame_of(2e4, 0.3)).stress(f) * f.transpose() / f.determinant();
    for (std::uint32_t k = 0; k < stress.size(); ++k) {
      EXPECT_EQ(stress[k], vertex_stress(e.body, k)) << k;
      if (uniform) {
        EXPECT_LE((stress[k] - cauchy).norm(), 1e-12 * cauchy.norm()) << k;
      }
    }
  }
}

// A body of springs has no elements, but its stress is per present volume.
template <class Map>
struct CornersOfSprings : testing::Test {
  using View = std::conditional_t<Map::tetrahedral, TetrahedronNodesView, SolidNodesView>;
  static Mesh mesh() {
    if constexpr (Map::dimension == 2) return surfaces()[3];
    return Map::tetrahedral ? box() : mixed_box(3, 2, 2, 0.1);
  }
};
using AllMaps = testing::Types<Map2, TetMap, Map3>;
TYPED_TEST_SUITE(CornersOfSprings, AllMaps);

TYPED_TEST(CornersOfSprings, AreListedIfAskedForAndFollowOperations) {
  auto body = body_of<TypeParam>(this->mesh());
  typename TestFixture::View none, view(true);
  none.rebuild(body);
  view.rebuild(body);
  EXPECT_EQ(none.nodes.size(), 0u);
  SplitMix64 random(17);
  for (Vector3d& x : body.vertices.position)
    for (double& c : x) c += 0.02 * random.next_signed();
  for (int k = 0; body.map.dart_count() > 0; ++k) {
    ASSERT_EQ(view.nodes.size(), body.cell_dart.size());
    typename TestFixture::View rebuilt(true);
    rebuilt.rebuild(body);
    ASSERT_EQ(view.nodes, rebuilt.nodes) << k;
    // with the corners and without them the same volumes, to the bit, as with a single vertex
    CornerRows corners;
    if constexpr (TypeParam::tetrahedral)
      corners.tetrahedra = view.nodes;
    else
      corners.solids = view.nodes;
    VolumeRoom given, walked;
    vertex_volumes(body, corners, given);
    vertex_volumes(body, {}, walked);
    ASSERT_EQ(given.now, walked.now) << k;
    view.apply(body,
               adapt(body, k % 3 == 0 ? remove_something(body.map, random) : dissociate_something(body.map, random)));
  }
  EXPECT_EQ(view.nodes.size(), 0u);
}

/// A body of hexahedra, prisms, pyramids and tetrahedra with its view and its force term, shaken out of rest.
struct SolidElements {
  AdaptedBody<Map3> body;
  SolidNodesView view;
  std::unique_ptr<ForceTerm> term;

  SolidElements(const Mesh& mesh, Model model) : body(build_body<Map3, Held::by_every_dart>(problem_of(mesh, model))) {
    view.rebuild(body);
    term = make_solids(body.material, {view.nodes, shapes_of<SolidShape>(body.elements)});
    SplitMix64 random(5);
    for (Vector3d& x : body.vertices.position)
      for (double& c : x) c += 0.01 * random.next_signed();
  }
};

// Hexahedra, prisms, pyramids and tetrahedra: the same properties as for tetrahedra alone.
TEST(SolidsOnAMap, FollowRandomOperationsUntilNothingIsLeft) {
  const Mesh mesh = mixed_box(3, 3, 3, 0.1);
  SolidElements elements(mesh, Model::neo_hookean);
  AdaptedBody<Map3>& body = elements.body;
  SolidNodesView& view = elements.view;
  ASSERT_EQ(shapes_of<SolidShape>(body.elements).size(), mesh.cell_count());
  int operations = 0;
  operate_at_random(body, 3, 60, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
    view.apply(now, changed);
    SolidNodesView rebuilt;
    rebuilt.rebuild(now);
    ASSERT_EQ(view, rebuilt) << operations;
    for (std::uint32_t c = 0; c < view.nodes.size(); ++c) {
      std::vector<Vector3d> x;
      for (std::size_t k = 0; k < view.nodes[c].count; ++k)
        x.push_back(mesh.points[now.vertices.point[view.nodes[c].at[k]]]);
      const SolidShape shape = solid_shape_of(shapes_of<SolidShape>(now.elements)[c].kind, x);
      for (std::size_t q = 0; q < gauss_points(shape.kind); ++q) {
        ASSERT_EQ(shape.inverse[q], shapes_of<SolidShape>(now.elements)[c].inverse[q]) << c;
        ASSERT_EQ(shape.volume[q], shapes_of<SolidShape>(now.elements)[c].volume[q]) << c;
      }
    }
    ++operations;
  });
  EXPECT_GT(operations, 80);
}

TEST(SolidsOnAMap, KeepTheirEnergyWhereFacesComeApart) {
  SolidElements elements(mixed_box(3, 3, 3, 0.1), Model::corotational);
  auto& [body, view, term] = elements;
  SplitMix64 random(6);
  const double before = term->energy(body.vertices.position);
  ASSERT_GT(before, 0.0);
  for (int k = 0; k < 60; ++k) {
    view.apply(body, adapt(body, dissociate_something(body.map, random)));
    ASSERT_EQ(term->energy(body.vertices.position), before) << k;
  }
  const std::uint32_t c = 7;
  const double own = term->energy(body.vertices.position, c, term->size());
  view.apply(body, adapt(body, remove_volume(body.map, body.cell_dart[c])));
  EXPECT_NEAR(term->energy(body.vertices.position), before - own, 1e-14 * before);
}

// Vertices are inserted wherever only tetrahedra are around, and refused elsewhere. The shape of every cell is that of
// the places at rest, to a rounding for each refinement in its ancestry; an affine deformation keeps the energy, and
// has no force at inner vertices.
TEST(SolidsOnAMap, AreRefinedWhereTheyAreTetrahedra) {
  const Mesh mesh = mixed_box(2, 2, 2, 0.1);
  SolidElements elements(mesh, Model::neo_hookean);
  AdaptedBody<Map3>& body = elements.body;
  SolidNodesView& view = elements.view;
  const std::unique_ptr<ForceTerm>& term = elements.term;
  for (std::size_t k = 0; k < body.vertices.size(); ++k)
    body.vertices.position[k] = mesh.points[body.vertices.point[k]];
  body.vertices.keep_rest();
  Eigen::Matrix3d a;
  a << 1.1, 0.1, -0.1, 0.05, 0.9, 0.1, 0.0, -0.1, 1.05;
  for (Vector3d& x : body.vertices.position) x = a * x;
  const auto mass = [&] { return std::accumulate(body.vertices.mass.begin(), body.vertices.mass.end(), 0.0); };
  const auto forces = [&] {
    std::vector<Vector3d> f(body.vertices.size(), Vector3d::Zero());
    term->add_forces({body.vertices.position}, f);
    return f;
  };
  const double energy = term->energy(body.vertices.position), whole = mass();
  std::array<int, 4> refined{}, refused{};
  SplitMix64 random(3);
  for (int k = 0; k < 600; ++k) {
    const Dart d{random.below(body.map.capacity())};
    if (!body.map.is_live(d)) continue;
    const std::size_t dimension = 1 + random.below(3);
    try {
      const Subdivision made = dimension == 1   ? subdivide(body.map, Edge{d})
                               : dimension == 2 ? subdivide(body.map, Face{d})
                                                : subdivide(body.map, Volume{d});
      view.apply(body, adapt(body, made, 0.5));
      ++refined[dimension];
    } catch (const TopologyError&) {
      ++refused[dimension];
    }
    if (shapes_of<SolidShape>(body.elements).size() > 400) break;
  }
  for (std::size_t dimension = 1; dimension < 4; ++dimension) {
    EXPECT_GT(refined[dimension], 5) << dimension;
    EXPECT_GT(refused[dimension], 5) << dimension;
  }
  SolidNodesView rebuilt;
  rebuilt.rebuild(body);
  ASSERT_EQ(view, rebuilt);
  for (std::uint32_t c = 0; c < view.nodes.size(); ++c) {
    std::vector<Vector3d> x;
    for (std::size_t k = 0; k < view.nodes[c].count; ++k) x.push_back(body.vertices.rest[view.nodes[c].at[k]]);
    const SolidShape shape = solid_shape_of(shapes_of<SolidShape>(body.elements)[c].kind, x);
    for (std::size_t q = 0; q < gauss_points(shape.kind); ++q) {
      ASSERT_GT(shape.volume[q], 0.0) << c;
      ASSERT_LE((shape.inverse[q] - shapes_of<SolidShape>(body.elements)[c].inverse[q]).norm(),
                1e-9 * shape.inverse[q].norm())
          << c;
      ASSERT_NEAR(shape.volume[q], shapes_of<SolidShape>(body.elements)[c].volume[q], 1e-9 * shape.volume[q]) << c;
    }
  }
  EXPECT_NEAR(term->energy(body.vertices.position), energy, 1e-12 * energy);
  EXPECT_NEAR(mass(), whole, 1e-13 * whole);
  // vertices inside are in equilibrium, also the new ones
  double size = 0.0;
  std::size_t inside = 0;
  const std::vector<Vector3d> force = forces();
  for (const Vector3d& f : force) size = std::max(size, f.norm());
  for (std::size_t k = 0; k < force.size(); ++k) {
    const Vector3d& x = body.vertices.rest[k];
    if (x.minCoeff() < 1e-9 || x.maxCoeff() > 0.2 - 1e-9) continue;
    ++inside;
    EXPECT_LE(force[k].norm(), 1e-11 * size) << k;
  }
  EXPECT_GT(inside, 10u);
}

TEST(SolidsOnAMap, HaveTheStressOfTheirLawAtEveryVertex) {
  const Mesh mesh = mixed_box(2, 2, 2, 0.1);
  SolidElements elements(mesh, Model::stvk);
  auto& [body, view, term] = elements;
  const ForceTerm* terms[] = {term.get()};
  std::vector<Eigen::Matrix3d> stress;
  Eigen::Matrix3d f;
  f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0.0, -0.2, 1.2;
  const Lame lame = lame_of(body.material.young, body.material.poisson);
  const Eigen::Matrix3d cauchy = StVenantKirchhoff(lame).stress(f) * f.transpose() / f.determinant();
  for (const bool uniform : {false, true}) {
    if (uniform)
      for (std::size_t k = 0; k < body.vertices.size(); ++k)
        body.vertices.position[k] = f * mesh.points[body.vertices.point[k]];
    vertex_stresses({}, {}, {body.vertices.mass, 1000.0}, body.vertices.position, stress, terms);
    for (std::uint32_t k = 0; k < stress.size(); ++k) {
      EXPECT_EQ(stress[k], vertex_stress(body, k)) << k;
      if (uniform) {
        EXPECT_LE((stress[k] - cauchy).norm(), 1e-12 * cauchy.norm()) << k;
      }
    }
  }
}

// Flat or turned inside out, a body has no Cauchy stress: its volume counts as a hundredth of that at rest.
TEST(SolidsOnAMap, HaveAFiniteStressWhenTheyAreSqueezedFlat) {
  const Mesh mesh = mixed_box(2, 2, 2, 0.1);
  SolidElements elements(mesh, Model::stvk);
  AdaptedBody<Map3>& body = elements.body;
  const ForceTerm* terms[] = {elements.term.get()};
  const auto largest = [&](double squeezed) {
    for (std::size_t k = 0; k < body.vertices.size(); ++k)
      body.vertices.position[k] = mesh.points[body.vertices.point[k]].cwiseProduct(Eigen::Vector3d(1.1, 1, squeezed));
    std::vector<Eigen::Matrix3d> stress;
    vertex_stresses({}, {}, {body.vertices.mass, 1000.0}, body.vertices.position, stress, terms);
    return stress[0](0, 0);
  };
  const double flat = largest(1e-9);
  EXPECT_TRUE(std::isfinite(flat));
  EXPECT_NEAR(largest(-1e-9), flat, 1e-6 * std::abs(flat));
}

TEST(ElementsOnAMap, AreSolidCellsOfAMaterialThatExists) {
  const auto message = [](Mesh mesh, auto&& change) {
    Problem problem = problem_of(std::move(mesh), Model::neo_hookean);
    change(problem.material);
    try {
      build_body<Map3, Held::by_every_dart>(problem);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(box(), [](Material&) {}), "");
  Mesh crushed = hexahedron_box(1, 1, 1, 1.0);
  crushed.points[7] = {0.1, 0.1, 0.1};  // its volume is still above 0
  EXPECT_EQ(message(crushed, [](Material&) {}),
            "cell 0, a hexahedron, is flat or turned inside out at one of its corners");
  EXPECT_EQ(message(box(), [](Material& m) { m.poisson = 0.5; }),
            "poisson is 0.5, expected more than -1 and less than 0.5");
  EXPECT_EQ(message(box(), [](Material& m) { m.young = 0.0; }), "young is 0, expected a positive number of Pa");
  EXPECT_EQ(message(box(), [](Material& m) { m.stiffness = m.damping = 1.0; }), "");  // of springs, and not used
  EXPECT_EQ(message(box(), [](Material& m) { m.damping_time = -1.0; }), "damping time is -1, expected at least 0 s");
  EXPECT_EQ(message(box(), [](Material& m) { m = {.damping_time = 1.0}; }),
            "damping time is 1, expected 0 s with springs");
}

}  // namespace
}  // namespace dartboard::element_nodes_view_test
