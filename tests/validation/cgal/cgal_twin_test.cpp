#include "validation/cgal/cgal_twin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/plain/error.h"
#include "tests/support/meshes_for_tests.h"
#include "validation/topology/topology_report.h"

namespace dartboard::cgal_twin_test {
namespace {

using Counts = std::vector<std::size_t>;

std::vector<std::unique_ptr<MapTwin>> both_oracles(const AlphaList& list) {
  std::vector<std::unique_ptr<MapTwin>> twins;
  twins.push_back(make_cgal_gmap_twin(list));
  std::string why_not;
  twins.push_back(make_cgal_cmap_twin(list, &why_not));
  EXPECT_NE(twins.back(), nullptr) << why_not;
  return twins;
}

AlphaList darts_without_links(int dimension, std::uint32_t count) {
  AlphaList list{dimension, {}, {}};
  for (std::uint32_t k = 0; k < count; ++k) {
    const Dart d{k};
    list.darts.push_back(d);
    list.alphas.push_back({d, d, d, d});
  }
  return list;
}

std::size_t count_labels(const MapTwin& twin, Involutions set) {
  auto labels = twin.labels(set);
  std::sort(labels.begin(), labels.end());
  return static_cast<std::size_t>(std::unique(labels.begin(), labels.end()) - labels.begin());
}

// ---- a mesh written out

TEST(AlphasOfAMesh, AreThoseOfOurMap) {
  for (const Mesh& mesh : {kuhn_grid(2, 1, 1, 1.0), mixed_cells(), hexahedron_box(2, 2, 1, 1.0), pinched_ring()}) {
    const AlphaList list = alphas_of(mesh);
    const AlphaList ours = make_core_twin<Map3>(mesh)->alphas();
    EXPECT_EQ(list.darts, ours.darts);
    EXPECT_EQ(list.alphas, ours.alphas);
  }
}

TEST(AlphasOfAMesh, OfNoCellsAreNoDartsOfASolid) {
  const AlphaList list = alphas_of(Mesh{});
  EXPECT_EQ(list.dimension, 3);
  EXPECT_TRUE(list.darts.empty());
}

TEST(AlphasOfAMesh, AreRefusedWhereThreeCellsShareAFacet) {
  Mesh mesh = unequal_tetrahedra();
  mesh.points.emplace_back(1, 1, 3);
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 5});
  EXPECT_THROW(alphas_of(mesh), InputError);
}

// ---- the golden run: the unit cube of six Kuhn tetrahedra, taken apart face by face

TEST(GoldenRun, CountsTheCellsOfTheUnitCubeAndOfItsPieces) {
  for (const auto& twin : both_oracles(alphas_of(kuhn_grid(1, 1, 1, 1.0)))) {
    EXPECT_EQ(twin->dart_count(), 144u) << twin->library();
    EXPECT_EQ(twin->count_cells(), (Counts{8, 19, 18, 6, 1})) << twin->library();
    SplitCounts sum{};
    int faces = 0;
    for (const Dart d : twin->darts()) {
      if (twin->alpha(3, d) == d) continue;
      const SplitCounts split = twin->dissociate(d);
      ++faces;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += split[i];
      EXPECT_EQ(twin->violation(), "") << twin->library();
    }
    EXPECT_EQ(faces, 6);
    EXPECT_EQ(sum, (SplitCounts{16, 17, 6})) << twin->library();
    EXPECT_EQ(twin->count_cells(), (Counts{24, 36, 24, 6, 6})) << twin->library();
  }
}

// ---- generalized maps

TEST(CgalGmapTwin, WalksEverySetOfInvolutions) {
  const auto twin = make_cgal_gmap_twin(alphas_of(kuhn_grid(1, 1, 1, 1.0)));
  EXPECT_EQ(count_labels(*twin, {}), 144u);
  EXPECT_EQ(count_labels(*twin, {0}), 72u);
  EXPECT_EQ(count_labels(*twin, {0, 1}), 24u);    // sides of faces
  EXPECT_EQ(count_labels(*twin, {1, 2, 3}), 8u);  // vertices
  EXPECT_EQ(count_labels(*twin, {0, 1, 2}), 6u);  // volumes
  EXPECT_EQ(count_labels(*twin, {0, 1, 2, 3}), 1u);
}

TEST(CgalGmapTwin, KnowsComponentsApart) {
  Mesh mesh = regular_tetrahedron();
  for (int k = 0; k < 4; ++k) mesh.points.push_back(mesh.points[static_cast<std::size_t>(k)]);
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  for (const auto& twin : both_oracles(alphas_of(mesh))) EXPECT_EQ(count_labels(*twin, all_involutions(3)), 2u);
}

TEST(CgalGmapTwin, SaysWhetherASurfaceIsOrientable) {
  EXPECT_EQ(make_cgal_gmap_twin(alphas_of(moebius_lattice()))->is_orientable(), false);
  EXPECT_EQ(make_cgal_gmap_twin(alphas_of(klein_lattice()))->is_orientable(), false);
  EXPECT_EQ(make_cgal_gmap_twin(alphas_of(torus_lattice()))->is_orientable(), true);
}

TEST(CgalGmapTwin, SewsFlippedFacesAndTwoFacesOfOneTetrahedron) {
  const auto twin = make_cgal_gmap_twin(alphas_of(regular_tetrahedron()));
  EXPECT_TRUE(twin->can_sew(3, Dart{0}, Dart{6}));
  EXPECT_TRUE(twin->can_sew(3, Dart{0}, Dart{7}));  // the other way round
  twin->sew(3, Dart{0}, Dart{7});
  EXPECT_EQ(twin->alpha(3, Dart{0}), Dart{7});
  EXPECT_EQ(twin->violation(), "");
  twin->unsew(3, Dart{7});
  EXPECT_EQ(twin->alpha(3, Dart{0}), Dart{0});
}

// Cases in which its verdicts differ from ours: see the header.
TEST(CgalGmapTwin, RefusesFoldsByChoiceButCanBeFolded) {
  const auto twin = make_cgal_gmap_twin(alphas_of(regular_tetrahedron()));
  EXPECT_TRUE(twin->refuses_folds());
  EXPECT_FALSE(twin->can_sew(3, Dart{0}, Dart{5}));
  EXPECT_TRUE(make_core_twin<Map3>(regular_tetrahedron())->can_sew(3, Dart{0}, Dart{5}));
  twin->sew(3, Dart{0}, Dart{5});
  for (std::uint32_t r = 0; r < 6; ++r) EXPECT_EQ(twin->alpha(3, Dart{r}), Dart{5 - r});
  EXPECT_EQ(twin->violation(), "");
}

// Neither supports a fold: the one by choice, the other because beta would fix a dart.
TEST(CgalTwins, RefuseFolds) {
  for (const auto& twin : both_oracles(alphas_of(regular_tetrahedron()))) EXPECT_TRUE(twin->refuses_folds());
  EXPECT_FALSE(make_core_twin<Map3>(regular_tetrahedron())->refuses_folds());
  const auto combinatorial = make_cgal_cmap_twin(alphas_of(regular_tetrahedron()), nullptr);
  EXPECT_FALSE(combinatorial->can_carry_sew(3, Dart{0}, Dart{5}));
  EXPECT_TRUE(combinatorial->can_carry_sew(3, Dart{0}, Dart{7}));
}

TEST(CgalGmapTwin, CallsADartSewableToItselfInDimensionOne) {
  const auto twin = make_cgal_gmap_twin(darts_without_links(3, 1));
  EXPECT_TRUE(twin->can_sew(1, Dart{0}, Dart{0}));
  EXPECT_FALSE(twin->can_sew(2, Dart{0}, Dart{0}));
}

TEST(CgalGmapTwin, BringsEveryDartOfAFoldedEdgeOnce) {
  const auto twin = make_cgal_gmap_twin(alphas_of(quadrilateral_grid(1, 1)));
  twin->sew(2, Dart{0}, Dart{1});
  std::vector<Dart> edge;
  twin->orbit({0, 2}, Dart{0}, edge);
  EXPECT_EQ(edge, (std::vector<Dart>{{0}, {1}}));
}

// ---- combinatorial maps

TEST(CgalCmapTwin, GivesBackTheAlphasItWasMadeOf) {
  for (const Mesh& mesh :
       {kuhn_grid(2, 1, 1, 1.0), mixed_cells(), pinched_ring(), torus_lattice(), quadrilateral_grid(2, 2)}) {
    const AlphaList list = alphas_of(mesh);
    const AlphaList back = make_cgal_cmap_twin(list, nullptr)->alphas();
    EXPECT_EQ(back.darts, list.darts);
    EXPECT_EQ(back.alphas, list.alphas);
  }
}

TEST(CgalCmapTwin, SaysWhyAMapHasNone) {
  std::string why_not;
  EXPECT_EQ(make_cgal_cmap_twin(alphas_of(moebius_lattice()), &why_not), nullptr);
  EXPECT_EQ(why_not.substr(0, 14), "not orientable");
  EXPECT_EQ(make_cgal_cmap_twin(darts_without_links(3, 1), &why_not), nullptr);
  EXPECT_EQ(why_not, "d0 is 0-free");
  AlphaList folded = alphas_of(quadrilateral_grid(1, 1));
  folded.alphas[0][2] = {1};
  folded.alphas[1][2] = {0};
  EXPECT_EQ(make_cgal_cmap_twin(folded, &why_not), nullptr);
  EXPECT_EQ(why_not, "alpha2(d0) = alpha0(d0), a fold");
  EXPECT_NE(make_cgal_cmap_twin(alphas_of(torus_lattice()), &why_not), nullptr);
  EXPECT_EQ(why_not, "");
}

TEST(CgalCmapTwin, WalksSetsWithAlpha0AndVertices) {
  const auto twin = make_cgal_cmap_twin(alphas_of(regular_tetrahedron()), nullptr);
  int walked = 0;
  for (unsigned bits = 0; bits < 16; ++bits) walked += twin->can_walk(Involutions::from_bits(bits)) ? 1 : 0;
  EXPECT_EQ(walked, 9);
  EXPECT_TRUE(twin->can_walk({1, 2, 3}));
  EXPECT_FALSE(twin->can_walk({1, 2}));
}

TEST(CgalCmapTwin, CarriesOnlySewsThatKeepTheMapOriented) {
  const auto twin = make_cgal_cmap_twin(alphas_of(regular_tetrahedron()), nullptr);
  EXPECT_TRUE(twin->can_carry_sew(3, Dart{0}, Dart{7}));
  EXPECT_FALSE(twin->can_carry_sew(3, Dart{0}, Dart{6}));  // of the same colour
  EXPECT_FALSE(twin->can_carry_sew(3, Dart{0}, Dart{5}));  // a fold
  EXPECT_FALSE(twin->can_carry_sew(1, Dart{0}, Dart{7}));
}

// ---- both

TEST(CgalTwins, KeepASolidValidWhenAVolumeIsRemoved) {
  for (const auto& twin : both_oracles(alphas_of(kuhn_grid(1, 1, 1, 1.0)))) {
    twin->remove(Dart{30});
    EXPECT_EQ(twin->dart_count(), 120u);
    EXPECT_EQ(twin->count_cells()[3], 5u);
    EXPECT_EQ(twin->violation(), "");
    EXPECT_FALSE(twin->is_live(Dart{24}));
    twin->add(CellKind::tetrahedron, Dart{144});
    // less the two outer faces of one and the edge between them, more a tetrahedron of its own
    EXPECT_EQ(twin->count_cells(), (Counts{8 + 4, 19 - 1 + 6, 18 - 2 + 4, 6, 2})) << twin->library();
  }
}

TEST(CgalTwins, AreIsomorphicToTheirOwnAlphasAndToNoOthers) {
  for (const auto& twin : both_oracles(alphas_of(kuhn_grid(1, 1, 1, 1.0)))) {
    const AlphaList before = twin->alphas();
    EXPECT_TRUE(are_isomorphic(*twin, before));
    const auto dart =
        std::find_if(before.darts.begin(), before.darts.end(), [&](Dart d) { return twin->alpha(3, d) != d; });
    twin->unsew(3, *dart);
    EXPECT_FALSE(are_isomorphic(*twin, before)) << twin->library();
    EXPECT_TRUE(are_isomorphic(*twin, twin->alphas())) << twin->library();
  }
}

// A single component does not decide: the change is in the second one.
TEST(CgalTwins, AreComparedInEveryComponent) {
  Mesh mesh = regular_tetrahedron();
  for (int k = 0; k < 4; ++k) mesh.points.push_back(mesh.points[static_cast<std::size_t>(k)]);
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  for (const auto& twin : both_oracles(alphas_of(mesh))) {
    const AlphaList before = twin->alphas();
    twin->sew(3, Dart{24}, Dart{31});
    EXPECT_FALSE(are_isomorphic(*twin, before)) << twin->library();
  }
}

// ---- the comparison of a mesh at rest

TEST(CompareTopology, AgreesOnSolidsSurfacesAndNothing) {
  for (const Mesh& mesh :
       {Mesh{}, regular_tetrahedron(), unequal_tetrahedra(), kuhn_grid(2, 2, 1, 1.0), mixed_cells(), pinched_ring(),
        hexahedron_box(2, 1, 1, 1.0), moebius_lattice(), klein_lattice(), torus_lattice()}) {
    const TopologyComparison comparison = compare_topology(mesh);
    for (const AgreementRow& row : comparison.rows) EXPECT_TRUE(row.agrees) << row.what << ": " << row.answers[0];
    EXPECT_TRUE(comparison.agrees());
  }
}

TEST(CompareTopology, AsksEveryQuestionOfEveryCarrier) {
  const TopologyComparison comparison = compare_topology(kuhn_grid(1, 1, 1, 1.0));
  EXPECT_EQ(comparison.carriers, (std::vector<std::string>{"Map3", "TetMap", "CGAL g-map", "CGAL c-map"}));
  EXPECT_EQ(comparison.rows.size(), 29u);  // 16 of them are kinds of orbits
  const auto answer = [&](const std::string& what) {
    for (const AgreementRow& row : comparison.rows)
      if (row.what == what) return row.answers;
    return std::vector<std::string>{"no such row"};
  };
  using Answers = std::vector<std::string>;
  EXPECT_EQ(answer("vertices"), (Answers{"8", "8", "8", "8"}));
  EXPECT_EQ(answer("orbits <1,2,3>"), (Answers{"8", "8", "8", "8"}));
  EXPECT_EQ(answer("orbits <1,2>"), (Answers{"24", "24", "24", ""}));
  EXPECT_EQ(answer("boundary faces"), (Answers{"12", "12", "12", "12"}));
  EXPECT_EQ(answer("Euler characteristics"), (Answers{"1", "1", "1", "1"}));
  EXPECT_EQ(answer("isomorphic to ours"), (Answers{"", "", "yes", "yes"}));
}

TEST(CompareTopology, SaysWhyThereIsNoCombinatorialMap) {
  const TopologyComparison comparison = compare_topology(klein_lattice());
  EXPECT_EQ(comparison.carriers, (std::vector<std::string>{"Map2", "CGAL g-map"}));
  EXPECT_EQ(comparison.no_cmap.substr(0, 14), "not orientable");
}

TEST(CompareTwins, SeesPartitionsThatDifferThoughTheirCountsDoNot) {
  // two darts joined by alpha_1 out of four: other pairs, as many orbits
  AlphaList list = darts_without_links(2, 4), other = list;
  list.alphas[0][1] = {1};
  list.alphas[1][1] = {0};
  other.alphas[2][1] = {3};
  other.alphas[3][1] = {2};
  const auto a = make_cgal_gmap_twin(list), b = make_cgal_gmap_twin(other);
  const std::vector<const MapTwin*> twins{a.get(), b.get()};
  for (const AgreementRow& row : compare_twins(twins)) {
    if (row.what != "orbits <1>") continue;
    EXPECT_FALSE(row.agrees);
    EXPECT_EQ(row.answers, (std::vector<std::string>{"3", "3 others"}));
  }
}

}  // namespace
}  // namespace dartboard::cgal_twin_test
