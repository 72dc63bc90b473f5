// Attachments on a map: each part of a vertex has its spring, which stays at its cell as long as there is that cell.

#include "core/views/attachments_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "core/base/archive.h"
#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/random_operations.h"

namespace dartboard::attachments_view_test {
namespace {

using Eigen::Vector3d;

/// A body in which every second point is attached twice: to a cell drawn at random, and to another one or a place.
template <class Map>
struct Attached {
  AdaptedBody<Map> body;
  std::vector<Attachment> attachments;
  std::vector<std::uint32_t> mesh_cell;
  AttachmentsView view;
  std::unique_ptr<ForceTerm> term;

  explicit Attached(const Mesh& mesh, std::uint64_t seed = 1) : body(body_of<Map>(mesh)) {
    SplitMix64 random(seed);
    const auto cells = static_cast<std::uint32_t>(mesh.cell_count());
    for (std::uint32_t c = 0; c < cells; ++c) mesh_cell.push_back(c);
    for (std::uint32_t p = 0; p < mesh.points.size(); p += 2)
      for (const bool second : {false, true}) {
        Attachment one{.point = p, .place = mesh.points[p], .per_mass = 1.0 + random.below(8)};
        if (!second || p % 3 != 0) {
          one.cell = random.below(cells);
          one.count = Map::dimension + 1;
          const auto nodes = mesh.cell(one.cell);
          for (std::uint32_t a = 0; a < one.count; ++a) one.corners[a] = nodes[a];
          one.weight = {0.5, 0.25, 0.5, -0.25};
        }
        attachments.push_back(one);
      }
    SplitMix64 shuffle(seed);
    for (std::size_t k = attachments.size(); k > 1; --k)
      std::swap(attachments[k - 1], attachments[shuffle.below(static_cast<std::uint32_t>(k))]);
    view = rebuilt();
    term = make_attachments(view.rows, body.vertices.mass);
    for (Vector3d& x : body.vertices.position)
      for (double& c : x) c += 0.25 * random.next_signed();
  }
  Attached(const Attached&) = delete;

  AttachmentsView rebuilt() const {
    AttachmentsView made(attachments, [this](std::uint32_t c) { return mesh_cell[c]; });
    made.rebuild(body);
    return made;
  }
  void follow(const ChangedEmbeddings& changed) {
    changed.move_cells(mesh_cell);
    view.apply(body, changed);
  }
  double energy() const { return term->energy(body.vertices.position); }

  /// All rows by going through all vertices, cells and attachments.
  std::multiset<std::vector<double>> expected() const {
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> vertex_of;  // by cell of the mesh, by point
    for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c)
      for_each_dart_of(body.map, Cell<Map::dimension>{body.cell_dart[c]}, [&](Dart d) {
        const std::uint32_t k = body.vertex(body.map, d);
        vertex_of[mesh_cell[c]][body.vertices.point[k]] = k;
      });
    std::multiset<std::vector<double>> rows;
    for (const Attachment& one : attachments)
      for (std::uint32_t k = 0; k < body.vertices.size(); ++k) {
        if (body.vertices.point[k] != one.point || (one.has_cell() && !vertex_of.contains(one.cell))) continue;
        std::vector<double> row{one.per_mass, static_cast<double>(k)};
        for (std::uint32_t a = 0; a < one.count; ++a)
          row.push_back(static_cast<double>(vertex_of.at(one.cell).at(one.corners[a])));
        rows.insert(row);
      }
    return rows;
  }
  std::multiset<std::vector<double>> found() const {
    std::multiset<std::vector<double>> rows;
    for (const AttachedVertex& one : view.rows) {
      std::vector<double> row{one.per_mass};
      for (std::uint32_t a = 0; a < one.count; ++a) row.push_back(static_cast<double>(one.nodes[a]));
      rows.insert(row);
    }
    return rows;
  }
};

template <class Map>
Mesh mesh_of() {
  if constexpr (Map::dimension == 2) return quadrilateral_grid(5, 4);
  if constexpr (std::is_same_v<Map, Map3>) return mixed_box(3, 2, 2, 0.5);
  return kuhn_grid(3, 2, 2, 0.25, 0.1, 3);
}

template <class Map>
struct AttachmentsOf : testing::Test {};
using Maps = testing::Types<Map2, Map3, TetMap>;
TYPED_TEST_SUITE(AttachmentsOf, Maps);

TYPED_TEST(AttachmentsOf, ABodyFollowRandomOperationsUntilNothingIsLeft) {
  int operations = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Attached<TypeParam> a(mesh_of<TypeParam>(), seed);
    ASSERT_EQ(a.found(), a.expected());
    ASSERT_GT(a.view.rows.size(), a.attachments.size() - 1);
    operate_at_random(a.body, seed, 40, [&](const auto&, const TopologyChange&, const ChangedEmbeddings& changed) {
      a.follow(changed);
      ASSERT_EQ(a.view, a.rebuilt()) << operations;
      ASSERT_EQ(a.found(), a.expected()) << operations;
      ++operations;
    });
    EXPECT_TRUE(a.view.rows.empty());
  }
  EXPECT_GT(operations, 150);
}

// Parts have the same place and the same target, and share the stiffness by their masses.
TYPED_TEST(AttachmentsOf, ABodyKeepTheirEnergyWhenItComesApart) {
  Attached<TypeParam> a(mesh_of<TypeParam>());
  const double before = a.energy();
  const std::size_t rows = a.view.rows.size();
  SplitMix64 random(4);
  for (int k = 0; k < 60; ++k) a.follow(adapt(a.body, dissociate_something(a.body.map, random)));
  EXPECT_GT(a.view.rows.size(), rows + 10);
  EXPECT_NEAR(a.energy(), before, 1e-13 * before);
}

TYPED_TEST(AttachmentsOf, ABodyAreKeptInACheckpointInTheirOrder) {
  Attached<TypeParam> a(mesh_of<TypeParam>()), b(mesh_of<TypeParam>());
  SplitMix64 random(2);
  for (int k = 0; k < 8; ++k) a.follow(adapt(a.body, do_something(a.body.map, random)));
  Archive written;
  a.view.state(written);
  Archive read(written.written(), "file");
  b.view.state(read);
  read.require_end();
  EXPECT_EQ(b.view.rows, a.view.rows);
  EXPECT_EQ(b.view, a.view);
}

TEST(AttachmentsOfABody, StayAtTheirCellsWhereCornersComeApart) {
  Attached<TetMap> a(mesh_of<TetMap>());
  SplitMix64 random(5);
  for (int k = 0; k < 40; ++k) a.follow(adapt(a.body, dissociate_something(a.body.map, random)));
  EXPECT_EQ(a.found(), a.expected());
}

}  // namespace
}  // namespace dartboard::attachments_view_test
