#include "core/views/component_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/mechanics/fracture/seam.h"
#include "core/operations/dissociate_all.h"
#include "core/topology/cells.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::component_labels_test {
namespace {

// The paper's way: walk along all alpha-links, and see which cells are reached.
template <class Body>
std::set<std::set<std::uint32_t>> walked(const Body& body) {
  constexpr int n = Body::dimension;
  std::set<std::set<std::uint32_t>> components;
  Mark seen(body.map);
  body.map.for_each_dart([&](Dart start) {
    if (seen(start)) return;
    std::set<std::uint32_t> cells;
    for_each_dart_of(body.map, all_involutions(n), start, [&](Dart d) {
      seen.set(d);
      cells.insert(body.cell(body.map, d));
    });
    components.insert(std::move(cells));
  });
  return components;
}

std::set<std::set<std::uint32_t>> listed(const ComponentLabels& labels) {
  std::vector<std::set<std::uint32_t>> by_label(labels.count());
  for (std::uint32_t cell = 0; cell < labels.cell_count(); ++cell) by_label.at(labels.label(cell)).insert(cell);
  for (std::uint32_t label = 0; label < labels.count(); ++label) {
    EXPECT_EQ(by_label[label].size(), labels.size(label));
    EXPECT_FALSE(by_label[label].empty());
  }
  return {by_label.begin(), by_label.end()};
}

template <class Body>
ComponentLabels components_of(const Body& body) {
  ComponentLabels labels;
  labels.rebuild(body);
  return labels;
}

// A listener that counts the components from the reports.
struct Listener {
  std::size_t count;
  void hear(const ComponentChange& report) { count += report.separated.size() - report.moved.size(); }
};

template <class Map>
void expect_followed_until_nothing_is_left(const Mesh& mesh, std::uint64_t seed, int dissociations_first) {
  auto body = body_of<Map>(mesh);
  ComponentLabels labels = components_of(body);
  Listener listener{labels.count()};
  operate_at_random(body, seed, dissociations_first,
                    [&](const auto& now, const TopologyChange& change, const ChangedEmbeddings& changed) {
                      const ComponentChange report = labels.apply(now, change, changed);
                      listener.hear(report);
                      for (const std::uint32_t label : report.separated) ASSERT_LT(label, labels.count());
                      ASSERT_EQ(listener.count, labels.count());
                      ASSERT_EQ(listed(labels), walked(now));
                      ASSERT_EQ(labels, components_of(now));
                    });
  EXPECT_EQ(labels.count(), 0u);
}

template <class Map>
struct ComponentsOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(ComponentsOf, Solids);

TYPED_TEST(ComponentsOf, TwoTetrahedraAreTwoWhenTheirFaceIsDissociated) {
  auto body = body_of<TypeParam>(unequal_tetrahedra());
  ComponentLabels labels = components_of(body);
  EXPECT_EQ(labels.count(), 1u);
  Dart shared = no_dart;
  body.map.for_each_dart([&](Dart d) {
    if (!body.map.template is_free<3>(d)) shared = d;
  });
  const TopologyChange change = dissociate_face(body.map, shared);
  const ComponentChange report = labels.apply(body, change, adapt(body, change));
  EXPECT_EQ(report.separated, std::vector<std::uint32_t>{1});
  EXPECT_TRUE(report.moved.empty());
  EXPECT_EQ(labels.count(), 2u);
  EXPECT_NE(labels.label(0), labels.label(1));
}

TYPED_TEST(ComponentsOf, SeparateBodiesAreNumberedByTheirLowestCell) {
  Mesh mesh = unequal_tetrahedra();
  mesh.points.insert(mesh.points.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}});
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{5, 6, 7, 8});
  const auto labels = components_of(body_of<TypeParam>(mesh));
  ASSERT_EQ(labels.count(), 2u);
  EXPECT_EQ(labels.label(0), 0u);
  EXPECT_EQ(labels.label(1), 0u);
  EXPECT_EQ(labels.label(2), 1u);
}

// The last component takes the label of the removed one.
TYPED_TEST(ComponentsOf, ABodyThatGoesAwayLeavesItsLabelToTheLast) {
  Mesh mesh = regular_tetrahedron();
  for (std::uint32_t k = 1; k < 3; ++k) {
    for (std::uint32_t p = 0; p < 4; ++p) mesh.points.push_back(mesh.points[p] + Eigen::Vector3d(5.0 * k, 0, 0));
    mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3});
  }
  auto body = body_of<TypeParam>(mesh);
  ComponentLabels labels = components_of(body);
  const TopologyChange change = remove_volume(body.map, body.cell_dart[0]);
  const ComponentChange report = labels.apply(body, change, adapt(body, change));
  ASSERT_EQ(report.moved.size(), 1u);
  EXPECT_EQ(report.moved[0].from, 2u);
  EXPECT_EQ(report.moved[0].to, 0u);
  EXPECT_TRUE(report.separated.empty());
  ASSERT_EQ(labels.count(), 2u);
  EXPECT_EQ(labels.label(0), 0u);  // cell 2 took number 0, and its component label 0
  EXPECT_EQ(labels.label(1), 1u);
}

template <class Body>
std::vector<Dart> faces_in_plane(const Body& body, double x) {
  std::vector<Dart> faces;
  for (const Dart face : body.face_dart) {
    bool within = !body.map.template is_free<3>(face);
    for_each_dart_of(body.map, Face{face},
                     [&](Dart d) { within = within && body.vertices.position[body.vertex(body.map, d)][0] == x; });
    if (within) faces.push_back(face);
  }
  return faces;
}

TYPED_TEST(ComponentsOf, ABoxAreTwoExactlyWhenTheLastFaceOfAPlaneGoes) {
  auto body = body_of<TypeParam>(kuhn_grid(3, 3, 3, 1.0));
  ComponentLabels labels = components_of(body);
  const auto plane = faces_in_plane(body, 1.0);
  ASSERT_EQ(plane.size(), 18u);
  for (std::size_t k = 0; k < plane.size(); ++k) {
    EXPECT_EQ(labels.count(), 1u);
    const TopologyChange change = dissociate_face(body.map, plane[k]);
    EXPECT_EQ(labels.apply(body, change, adapt(body, change)).empty(), k + 1 < plane.size());
  }
  ASSERT_EQ(labels.count(), 2u);
  EXPECT_EQ(labels.size(0), 108u);  // the larger part keeps
  EXPECT_EQ(labels.size(1), 54u);
}

TYPED_TEST(ComponentsOf, ABoxCutInOneSeriesAreReportedAtOnce) {
  auto body = body_of<TypeParam>(kuhn_grid(4, 3, 3, 1.0));
  ComponentLabels labels = components_of(body);
  TopologyChange change;
  for (const double x : {1.0, 3.0})
    for (const Dart face : faces_in_plane(body, x)) change.append(dissociate_face(body.map, face));
  const ComponentChange report = labels.apply(body, change, adapt(body, change));
  EXPECT_EQ(report.separated, (std::vector<std::uint32_t>{1, 2}));
  ASSERT_EQ(labels.count(), 3u);
  EXPECT_EQ(labels.size(0), 108u);
  EXPECT_EQ(labels.size(1), 54u);
  EXPECT_EQ(labels.size(2), 54u);
  EXPECT_EQ(listed(labels), walked(body));
}

TYPED_TEST(ComponentsOf, ABodyAreItsTetrahedraWhenAllIsDissociated) {
  auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 1.0));
  ComponentLabels labels = components_of(body);
  const auto faces = body.face_dart;
  for (const Dart face : faces) {
    const TopologyChange change = dissociate_face(body.map, face);
    labels.apply(body, change, adapt(body, change));
    ASSERT_EQ(listed(labels), walked(body));
  }
  EXPECT_EQ(labels.count(), 48u);
}

TYPED_TEST(ComponentsOf, ABodyFollowEveryOperationUntilNothingIsLeft) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u})
    expect_followed_until_nothing_is_left<TypeParam>(kuhn_grid(3, 2, 2, 0.125), seed, seed == 1 ? 150 : 30);
}

TYPED_TEST(ComponentsOf, APinchedBodyFollowEveryOperation) {
  for (std::uint64_t seed = 1; seed < 20; ++seed)
    expect_followed_until_nothing_is_left<TypeParam>(pinched_ring(), seed, 4);
}

// Series of many operations without updates in between: seeds may be dead, and parts may have parts.
TYPED_TEST(ComponentsOf, ABodyFollowLongSeries) {
  for (std::uint64_t seed = 1; seed < 15; ++seed) {
    auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 0.125));
    ComponentLabels labels = components_of(body);
    SplitMix64 random(seed);
    while (body.map.dart_count() > 0) {
      TopologyChange change;
      for (int k = 0; k < 12 && body.map.dart_count() > 0; ++k) change.append(do_something(body.map, random));
      labels.apply(body, change, adapt(body, change));
      ASSERT_EQ(listed(labels), walked(body));
    }
  }
}

TEST(ComponentsOfHexahedra, FollowEveryOperationUntilNothingIsLeft) {
  expect_followed_until_nothing_is_left<Map3>(hexahedron_box(3, 2, 2, 1.0), 1, 20);
}

TEST(ComponentsOfASurface, FollowEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : surfaces())
    for (const std::uint64_t seed : {1u, 2u, 3u}) expect_followed_until_nothing_is_left<Map2>(mesh, seed, 15);
}

/// Two strips of two squares, whose cells are numbered in this order.
Mesh two_strips(const std::array<std::uint32_t, 4>& order) {
  Mesh mesh;
  for (const double y : {0.0, 1.0, 5.0, 6.0})
    for (const double x : {0.0, 1.0, 2.0}) mesh.points.emplace_back(x, y, 0);
  for (const std::uint32_t square : order) {
    const std::uint32_t first = 6 * (square / 2) + square % 2;
    mesh.add_cell(CellKind::quadrilateral, std::array{first, first + 1, first + 4, first + 3});
  }
  return mesh;
}

// As many cells and components, of the same sizes.
TEST(ComponentsOfStrips, AreNotThoseOfOthersWithOtherNeighbours) {
  const ComponentLabels in_a_row = components_of(body_of<Map2>(two_strips({0, 1, 2, 3})));
  const ComponentLabels in_turn = components_of(body_of<Map2>(two_strips({0, 2, 1, 3})));
  ASSERT_EQ(in_a_row.count(), 2u);
  EXPECT_EQ(in_a_row, components_of(body_of<Map2>(two_strips({2, 3, 0, 1}))));
  EXPECT_FALSE(in_a_row == in_turn);
  EXPECT_FALSE(in_turn == in_a_row);
}

// A strip of five squares: cut at both ends in one series, the middle keeps its label.
TEST(ComponentsOfAStrip, LetTheLargestPartKeepItsLabel) {
  auto body = body_of<Map2>(quadrilateral_grid(5, 1));
  ComponentLabels labels = components_of(body);
  TopologyChange change;
  for (std::uint32_t k = 0; k < body.edge_dart.size(); ++k) {
    const Dart d = body.edge_dart[k];
    if (body.map.is_free<2>(d)) continue;
    std::set<std::uint32_t> sides{body.cell(body.map, d), body.cell(body.map, body.map.alpha<2>(d))};
    if (sides.contains(0) || sides.contains(4)) change.append(dissociate_edge(body.map, d));
  }
  labels.apply(body, change, adapt(body, change));
  ASSERT_EQ(labels.count(), 3u);
  EXPECT_EQ(labels.label(2), 0u);
  EXPECT_EQ(labels.size(0), 3u);
}

// Five squares around one that has a tail, four in all: the five are found first, by three searches, and keep the
// label.
TEST(ComponentsOfASheet, LetTheLargestPartKeepItsLabelWhenItIsFoundFirst) {
  Mesh mesh;
  for (std::uint32_t x = 0; x < 4; ++x)
    for (std::uint32_t y = 0; y < (x == 0 || x == 3 ? 3u : 6u); ++y) mesh.points.emplace_back(x, y, 0);
  const std::uint32_t column[4] = {0, 3, 9, 15};  // the first point of each
  for (std::uint32_t x = 0; x < 3; ++x)
    for (std::uint32_t y = 0; y < (x == 1 ? 5u : 2u); ++y)
      mesh.add_cell(CellKind::quadrilateral,
                    std::array{column[x] + y, column[x + 1] + y, column[x + 1] + y + 1, column[x] + y + 1});
  auto body = body_of<Map2>(mesh);
  ComponentLabels labels = components_of(body);
  TopologyChange change;
  const std::set<std::uint32_t> around{0, 1, 2, 7, 8};
  for (const Dart d : body.edge_dart)
    if (around.contains(body.cell(body.map, d)) != around.contains(body.cell(body.map, body.map.alpha<2>(d))))
      change.append(dissociate_edge(body.map, d));
  labels.apply(body, change, adapt(body, change));
  ASSERT_EQ(labels.count(), 2u);
  EXPECT_EQ(labels.size(0), 5u);
  EXPECT_EQ(labels.label(8), 0u);
  EXPECT_EQ(labels.label(3), 1u);
  EXPECT_EQ(listed(labels), walked(body));
}

// As if a refinement had made cells: a body of one tetrahedron becomes one of two.
TYPED_TEST(ComponentsOf, ABodyTakeInCellsThatAppear) {
  ComponentLabels labels = components_of(body_of<TypeParam>(regular_tetrahedron()));
  const auto larger = body_of<TypeParam>(kuhn_grid(2, 1, 1, 1.0));
  ChangedEmbeddings changed;
  changed.cell_count = 12;
  for (std::uint32_t k = 1; k < 12; ++k) changed.cells.push_back(k);
  EXPECT_TRUE(labels.apply(larger, TopologyChange{}, changed).empty());
  EXPECT_EQ(labels, components_of(larger));
  EXPECT_EQ(labels.size(0), 12u);
}

TYPED_TEST(ComponentsOf, DifferentPartitionsAreNotEqual) {
  auto body = body_of<TypeParam>(kuhn_grid(1, 1, 1, 1.0));
  const ComponentLabels whole = components_of(body);
  SplitMix64 random(1);
  while (components_of(body) == whole) adapt(body, dissociate_face(body.map, some_live_dart(body.map, random)));
  EXPECT_EQ(components_of(body).count(), 2u);
}

// Cut at a quarter and in the middle, so that a search of the parts would visit more cells than `most_looks`.
TEST(ComponentLabels, AreLookedForInAllCellsWhereLargePartsComeOff) {
  auto body = body_of<TetMap>(kuhn_box(20, 20, 20, 1.0));
  ComponentLabels labels = components_of(body);
  const auto cut = [&](double x) {
    const auto seam = faces_on_plane(body, {x, 0.0, 0.0}, {1.0, 0.0, 0.0});
    EXPECT_EQ(seam.size(), 800u);
    const TopologyChange change = dissociate_all(body.map, std::span<const Dart>(seam));
    return labels.apply(body, change, adapt(body, change));
  };
  ASSERT_GT(std::size_t{2 * 12'000}, ComponentLabels::most_looks);
  EXPECT_EQ(cut(5.001).separated, std::vector<std::uint32_t>{1});
  EXPECT_EQ(labels.size(0), 36'000u);
  EXPECT_EQ(labels.size(1), 12'000u);
  EXPECT_EQ(cut(10.001).separated, std::vector<std::uint32_t>{2});
  EXPECT_EQ(labels.size(0), 24'000u);
  EXPECT_EQ(labels.size(1), 12'000u);
  EXPECT_EQ(labels.size(2), 12'000u);
  EXPECT_EQ(labels, components_of(body));
  EXPECT_EQ(listed(labels), walked(body));
}

}  // namespace
}  // namespace dartboard::component_labels_test
