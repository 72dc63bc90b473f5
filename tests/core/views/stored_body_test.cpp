// A body with its views, stored and read into another one of the same mesh: later operations act as on the first.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/mechanics/refine.h"
#include "core/topology/check.h"
#include "core/topology/storage/hash.h"
#include "core/views/component_labels.h"
#include "core/views/spring_ends.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::stored_body_test {
namespace {

template <class Map>
struct Followed {
  explicit Followed(const Mesh& mesh) : body(body_of<Map>(mesh)), random(5) {
    ends.rebuild(body);
    components.rebuild(body);
  }

  /// Tetrahedra are refined, too: that is what uses the slots of removed ones again.
  void operate() {
    if (body.map.dart_count() == 0) return;
    if constexpr (Map::tetrahedral) {
      if (random.below(3) == 0) {
        const ChangedEmbeddings changed = refine(body, Volume{some_live_dart(body.map, random)}, 0.5);
        ends.apply(body, changed);
        components.apply(body, {}, changed);
        return;
      }
    }
    const TopologyChange change = do_something(body.map, random);
    const ChangedEmbeddings changed = adapt(body, change);
    ends.apply(body, changed);
    components.apply(body, change, changed);
  }

  template <class SomeArchive>
  void state(SomeArchive& archive) {
    archive(body, ends, components, random);
  }

  AdaptedBody<Map> body;
  SpringEndsView ends;
  ComponentLabels components;
  SplitMix64 random;
};

/// All visible data of the body, in order.
template <class Map>
std::vector<std::uint64_t> seen(const Followed<Map>& f) {
  const auto& body = f.body;
  Hash columns;
  for_each_column(body.vertices, VertexColumns::embedded(),
                  [&](const auto& column, const auto&) { columns.add(column); });
  for_each_column(body, AdaptedBody<Map>::embedded_in_cells(),
                  [&](const auto& column, const auto&) { columns.add(column); });
  columns.add(body.edge_share);
  columns.add(body.springs.list());
  Hash darts;
  for (const auto* column : {&body.vertices.dart, &body.edge_dart, &body.face_dart, &body.cell_dart})
    darts.add(*column);
  std::vector<std::uint32_t> numbers;
  body.map.for_each_dart([&](Dart d) {
    for (const std::uint32_t k : {body.vertex(body.map, d), body.edge(body.map, d), body.cell(body.map, d)})
      numbers.push_back(k);
    if constexpr (Map::dimension == 3) numbers.push_back(body.face(body.map, d));
  });
  for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c) numbers.push_back(f.components.label(c));
  darts.add(numbers);
  return {body.map.hash(), columns.value(), darts.value(), f.components.count()};
}

template <class Map>
void expect_to_go_on(const Mesh& mesh, int operations) {
  Followed<Map> first(mesh);
  for (int n = 0; n < operations && first.body.map.dart_count() > 0; ++n) {
    SCOPED_TRACE(n);
    Archive out;
    out(first);
    Followed<Map> second(mesh), one = first;
    Archive in(out.written(), "body");
    in(second);
    in.require_end();
    ASSERT_EQ(second.ends, one.ends);
    for (int k = 0; k < 12; ++k) {
      ASSERT_EQ(seen(second), seen(one)) << k;
      one.operate();
      second.operate();
    }
    ASSERT_EQ(check(second.body.map), "");
    for (int k = 0; k < 5; ++k) first.operate();
  }
}

TEST(StoredBody, OfTetrahedraIsOperatedOnAlike) { expect_to_go_on<TetMap>(kuhn_grid(3, 3, 2, 0.5), 10); }
TEST(StoredBody, OfMixedCellsIsOperatedOnAlike) { expect_to_go_on<Map3>(mixed_cells(), 10); }
TEST(StoredBody, OfACubeGridInAGeneralMapIsOperatedOnAlike) { expect_to_go_on<Map3>(kuhn_grid(2, 2, 2, 0.5), 10); }
TEST(StoredBody, OfASurfaceIsOperatedOnAlike) { expect_to_go_on<Map2>(quadrilateral_grid(6, 5), 10); }

// A slot of a dead dart that is used again has another generation, in the stored map as in the first.
TEST(StoredBody, GivesNoGenerationTwice) {
  AlphaTable<3> table;
  const Dart born = table.add_dart();
  table.add_dart();
  table.remove_dart(born);
  Archive out;
  out(table);
  AlphaTable<3> stored;
  Archive in(out.written(), "table");
  in(stored);
  EXPECT_EQ(stored.hash(), table.hash());
  EXPECT_EQ(stored.add_dart(), born);
  EXPECT_EQ(stored.generation(born), 3u);
}

}  // namespace
}  // namespace dartboard::stored_body_test
