#include "core/views/sparse_pattern.h"

#include <cholmod.h>
#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard {
namespace {

using Entries = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;  // (row, column), multiplicity

Entries entries_of(const SparsePattern& pattern) {
  Entries entries;
  for (std::uint32_t column = 0; column < pattern.columns(); ++column)
    for (int k = 0; k < pattern.column_length()[column]; ++k) {
      const auto place = static_cast<std::size_t>(pattern.column_start()[column] + k);
      const auto row = static_cast<std::uint32_t>(pattern.row_index()[place]);
      EXPECT_TRUE(entries.insert({{row, column}, pattern.multiplicity()[place]}).second);
      EXPECT_EQ(pattern.place(row, column), place);
      EXPECT_EQ(pattern.place(column, row), place);
      EXPECT_TRUE(k == 0 || pattern.row_index()[place - 1] < pattern.row_index()[place]);
    }
  EXPECT_EQ(entries.size(), pattern.entries());
  return entries;
}

template <class Body>
Entries covered(const Body& body) {
  Entries entries;
  for (std::uint32_t v = 0; v < body.vertices.size(); ++v) entries[{v, v}] = 1;
  for_each_cell<1>(body.map, [&](Edge e) {
    const std::uint32_t a = body.vertex(body.map, e.dart);
    const std::uint32_t b = body.vertex(body.map, body.map.template alpha<0>(e.dart));
    if (a != b) ++entries[std::minmax(a, b)];
  });
  return entries;
}

const auto expect_rebuilt = [](const SparsePattern& view, const auto& body) {
  SparsePattern rebuilt;
  rebuilt.rebuild(body);
  ASSERT_EQ(view, rebuilt);
  ASSERT_EQ(entries_of(view), covered(body));
};

template <class Map>
struct SparsePatternOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SparsePatternOf, Solids);

TYPED_TEST(SparsePatternOf, OneBodyIsForgottenForAnother) {
  SparsePattern pattern;
  for (const Mesh& mesh : {kuhn_grid(2, 2, 1, 1.0), regular_tetrahedron(), unequal_tetrahedra()}) {
    const auto body = body_of<TypeParam>(mesh);
    pattern.rebuild(body);
    expect_rebuilt(pattern, body);
  }
}

TYPED_TEST(SparsePatternOf, OneTetrahedronIsAFullTriangle) {
  const auto body = body_of<TypeParam>(regular_tetrahedron());
  SparsePattern pattern;
  pattern.rebuild(body);
  EXPECT_EQ(pattern.columns(), 4u);
  EXPECT_EQ(pattern.entries(), 10u);
  for (std::uint32_t a = 0; a < 4; ++a)
    for (std::uint32_t b = 0; b < 4; ++b) EXPECT_NE(pattern.place(a, b), SparsePattern::no_place);
}

TYPED_TEST(SparsePatternOf, TwoTetrahedraHasNoPlaceForTheTips) {
  const auto body = body_of<TypeParam>(unequal_tetrahedra());
  SparsePattern pattern;
  pattern.rebuild(body);
  std::vector<std::uint32_t> number(5);
  for (std::uint32_t v = 0; v < 5; ++v) number[body.vertices.point[v]] = v;
  EXPECT_EQ(pattern.place(number[3], number[4]), SparsePattern::no_place);
  EXPECT_EQ(pattern.place(number[4], number[3]), SparsePattern::no_place);
  EXPECT_EQ(pattern.entries(), 5u + 9u);
}

TYPED_TEST(SparsePatternOf, ADissociatedEdgeCountsBothParts) {
  auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 1.0));
  SparsePattern pattern;
  pattern.rebuild(body);
  SplitMix64 random(4);
  std::uint32_t most = 0;
  for (int k = 0; k < 60; ++k) {
    pattern.apply(body, adapt(body, dissociate_face(body.map, some_live_dart(body.map, random))));
    for (const auto& [where, multiplicity] : entries_of(pattern)) most = std::max(most, multiplicity);
  }
  EXPECT_GE(most, 2u);
}

TYPED_TEST(SparsePatternOf, ABodyFollowsEveryOperationUntilNothingIsLeft) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto pattern = followed_until_nothing_is_left<SparsePattern>(body_of<TypeParam>(kuhn_grid(3, 2, 2, 0.125)),
                                                                       seed, seed == 1 ? 150 : 20, expect_rebuilt);
    EXPECT_EQ(pattern.columns(), 0u);
    EXPECT_EQ(pattern.entries(), 0u);
  }
}

TEST(SparsePatternOfASurface, FollowsEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : surfaces())
    EXPECT_EQ(followed_until_nothing_is_left<SparsePattern>(body_of<Map2>(mesh), 2, 60, expect_rebuilt).columns(), 0u);
}

// A = D - P, where P holds the multiplicities and the diagonal D exceeds the sums of its rows by 1, in whole numbers.
// So A 1 = 1, and as A is an M-matrix, its inverse has no negative entry and the maximum norm 1. The computed solution
// is that of A + E with |E| <= gamma_(3n+1) |R^T| |R|, whose entries are at most gamma_(3n+1) max(D): with n < 2^8 and
// max(D) < 2^6 its norm is below 2^10 u 2^8 2^6 = 2^-29, and the error below twice that.
TEST(SparsePatternForCholmod, IsItsUnpackedForm) {
  auto body = body_of<TetMap>(kuhn_grid(2, 2, 2, 1.0));
  SparsePattern pattern;
  pattern.rebuild(body);
  SplitMix64 random(6);
  for (int k = 0; k < 40; ++k)
    pattern.apply(body, adapt(body, dissociate_face(body.map, some_live_dart(body.map, random))));
  const std::size_t n = pattern.columns();
  ASSERT_LT(n, 256u);

  std::vector<double> value(pattern.room(), 0.0);
  const auto at = [&](std::uint32_t a, std::uint32_t b) -> double& { return value[pattern.place(a, b)]; };
  for (std::uint32_t v = 0; v < n; ++v) at(v, v) = 1.0;
  for (std::uint32_t column = 0; column < n; ++column)
    for (int k = 0; k + 1 < pattern.column_length()[column]; ++k) {
      const auto place = static_cast<std::size_t>(pattern.column_start()[column] + k);
      const auto row = static_cast<std::uint32_t>(pattern.row_index()[place]);
      value[place] = -static_cast<double>(pattern.multiplicity()[place]);
      at(row, row) -= value[place];
      at(column, column) -= value[place];
    }
  for (std::uint32_t v = 0; v < n; ++v) ASSERT_LT(at(v, v), 64.0);

  std::vector<std::int32_t> p(pattern.column_start().begin(), pattern.column_start().end()),
      nz(pattern.column_length().begin(), pattern.column_length().end()),
      i(pattern.row_index().begin(), pattern.row_index().end());
  cholmod_common common;
  cholmod_start(&common);
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = n;
  matrix.nzmax = pattern.room();
  matrix.p = p.data();
  matrix.nz = nz.data();
  matrix.i = i.data();
  matrix.x = value.data();
  matrix.stype = 1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = 1;
  matrix.packed = 0;
  EXPECT_TRUE(cholmod_check_sparse(&matrix, &common));
  EXPECT_EQ(cholmod_nnz(&matrix, &common), static_cast<long>(pattern.entries()));
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  EXPECT_TRUE(cholmod_factorize(&matrix, factor, &common));
  EXPECT_EQ(common.status, CHOLMOD_OK);
  cholmod_dense* ones = cholmod_ones(n, 1, CHOLMOD_REAL, &common);
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor, ones, &common);
  ASSERT_NE(solution, nullptr);
  for (std::size_t v = 0; v < n; ++v) EXPECT_NEAR(static_cast<double*>(solution->x)[v], 1.0, 0x1p-28);
  cholmod_free_dense(&solution, &common);
  cholmod_free_dense(&ones, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
}

}  // namespace
}  // namespace dartboard
