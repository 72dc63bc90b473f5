#include "core/mechanics/embedding.h"

#include <gtest/gtest.h>

#include "core/topology/build.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::embedding_test {
namespace {

template <class MapType, Held how>
struct Choice {
  using Map = MapType;
  static constexpr Held held = how;
};

template <class C>
class Embeddings : public testing::Test {
 protected:
  using Map = typename C::Map;
  template <int i>
  using Embedding = CellEmbedding<i, Map, C::held>;

  // Number the i-cells in the order of a coverage, attaching each by the last dart of its orbit.
  template <int i>
  static void expect_every_dart_finds_its_cell(const Map& map) {
    Embedding<i> embedding;
    std::uint32_t n = 0;
    for_each_cell<i>(map, [&](Cell<i> cell) { embedding.attach(map, {orbit(map, cell).back()}, n++); });
    n = 0;
    for_each_cell<i>(map, [&](Cell<i> cell) {
      for (const Dart d : orbit(map, cell)) ASSERT_EQ(embedding(map, d), n) << i << "-cell of " << to_string(d);
      ++n;
    });
  }

  Map map_ = build_map<Map>(unequal_tetrahedra()).map;
};

using Choices = testing::Types<Choice<Map3, Held::by_one_dart>, Choice<Map3, Held::by_every_dart>,
                               Choice<TetMap, Held::by_one_dart>, Choice<TetMap, Held::by_every_dart>>;
TYPED_TEST_SUITE(Embeddings, Choices);

TYPED_TEST(Embeddings, AreFoundFromEveryDartOfTheirCell) {
  const auto map = build_map<typename TypeParam::Map>(kuhn_grid(2, 1, 1, 1.0)).map;
  this->template expect_every_dart_finds_its_cell<0>(map);
  this->template expect_every_dart_finds_its_cell<1>(map);
  this->template expect_every_dart_finds_its_cell<2>(map);
  this->template expect_every_dart_finds_its_cell<3>(map);
}

TYPED_TEST(Embeddings, AreMissingBeforeAnyIsAttached) {
  const typename TestFixture::template Embedding<0> vertex;
  EXPECT_EQ(vertex(this->map_, Dart{0}), no_embedding);
}

TYPED_TEST(Embeddings, AreMissingWhereNoneIsAttached) {
  typename TestFixture::template Embedding<1> edge;
  edge.attach(this->map_, Edge{{0}}, 4);
  this->map_.for_each_dart([&](Dart d) {
    EXPECT_EQ(edge(this->map_, d), same_cell<1>(this->map_, Dart{0}, d) ? 4u : no_embedding) << to_string(d);
  });
}

TYPED_TEST(Embeddings, AreMissingForCellsBornLater) {
  typename TestFixture::template Embedding<0> vertex;
  vertex.attach(this->map_, Vertex{{0}}, 1);
  const Dart later = add_cell(this->map_, CellKind::tetrahedron);
  EXPECT_EQ(vertex(this->map_, later), no_embedding);
}

// The last attachment counts, whichever dart of the cell it is made by.
TYPED_TEST(Embeddings, AreReplacedForTheWholeCell) {
  typename TestFixture::template Embedding<0> vertex;
  const auto darts = orbit(this->map_, Vertex{{0}});
  for (std::uint32_t k = 0; k < darts.size(); ++k) {
    vertex.attach(this->map_, {darts[k]}, k);
    for (const Dart d : darts) ASSERT_EQ(vertex(this->map_, d), k) << "after attaching by " << to_string(darts[k]);
  }
}

TYPED_TEST(Embeddings, OfTwoCellsOfAnUnsewnFaceAreTheirOwn) {
  typename TestFixture::template Embedding<2> face;
  Dart d{0};
  while (this->map_.template is_free<3>(d)) ++d.index;
  const Dart other = this->map_.template alpha<3>(d);
  unsew<3>(this->map_, d);
  face.attach(this->map_, {d}, 1);
  face.attach(this->map_, {other}, 2);
  EXPECT_EQ(face(this->map_, this->map_.template alpha<0>(d)), 1u);
  EXPECT_EQ(face(this->map_, this->map_.template alpha<0>(other)), 2u);
}

// "When an orbit is dissociated, its embedding is available for only one of both resulting orbits" (section 3.2).
TEST(EmbeddingOfADissociatedCell, StaysWithTheHalfThatHasItsDart) {
  Map3 map = build_map<Map3>(unequal_tetrahedra()).map;
  Dart d{0};
  while (map.is_free<3>(d)) ++d.index;
  const Dart other = map.alpha<3>(d);
  CellEmbedding<0, Map3, Held::by_one_dart> one;
  CellEmbedding<0, Map3, Held::by_every_dart> every;
  one.attach(map, {d}, 7);
  every.attach(map, {d}, 7);
  unsew<3>(map, d);
  EXPECT_EQ(one(map, map.alpha<1>(d)), 7u);
  EXPECT_EQ(one(map, other), no_embedding);
  EXPECT_EQ(every(map, other), 7u);  // both halves still have it
}

// Four places for the nodes of a tetrahedron instead of 24.
TEST(EmbeddingOnTetMap, KeepsOnePlacePerCornerAndNotPerDart) {
  const TetMap map = build_map<TetMap>(kuhn_grid(1, 1, 1, 1.0)).map;
  CellEmbedding<0, TetMap, Held::by_every_dart> vertex;
  vertex.attach(map, Vertex{{0}}, 0);
  EXPECT_EQ(vertex.bytes(), 6 * 4 * sizeof(std::uint32_t));
}

}  // namespace
}  // namespace dartboard::embedding_test
