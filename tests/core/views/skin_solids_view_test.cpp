// The solids that a point can be inside of: tetrahedra and triangles along the boundary that follow changes of the map.

#include "core/views/skin_solids_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/archive.h"
#include "core/contact/body_contact.h"
#include "core/contact/contacts.h"
#include "core/mechanics/refine.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/views/boundary_surface.h"
#include "core/views/skin.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::skin_solids_view_test {
namespace {

using Eigen::Vector3d;

template <class Body>
SkinSolidsView view_of(const Body& body) {
  SkinSolidsView view;
  view.rebuild(body);
  return view;
}

double volume_of(const SkinTetrahedron& t, const std::vector<Vector3d>& x) {
  const Vector3d &a = x[t.nodes[0]], b = x[t.nodes[1]] - a, c = x[t.nodes[2]] - a, d = x[t.nodes[3]] - a;
  return b.cross(c).dot(d) / 6;
}

Vector3d area_of(const SkinTriangle& t, const std::vector<Vector3d>& x) {
  return 0.5 * (x[t.nodes[1]] - x[t.nodes[0]]).cross(x[t.nodes[2]] - x[t.nodes[0]]);
}

std::set<std::uint32_t> without(const SkinTetrahedron& t, std::size_t k) {
  std::set<std::uint32_t> nodes(t.nodes.begin(), t.nodes.end());
  nodes.erase(t.nodes[k]);
  return nodes;
}

/// The same by going through all cells and faces of the body: which cells are there, that they are right-handed and
/// fill their cell, that triangles are those of the boundary and look outwards, and are the outer faces of tetrahedra.
template <class Body>
void expect_what_is_along_the_boundary(const SkinSolids& solids, const Body& body) {
  const auto& rest = body.vertices.rest;
  std::map<std::uint32_t, Vector3d> area;  // by face
  std::map<std::set<std::uint32_t>, int> outer;
  for (const SkinTriangle& t : solids.triangles()) {
    area.try_emplace(t.face, 0, 0, 0).first->second += area_of(t, rest);
    ++outer[{t.nodes.begin(), t.nodes.end()}];
  }
  BoundarySurface boundary;
  boundary.rebuild(body);
  ASSERT_EQ(area.size(), boundary.facets().size());
  std::set<std::uint32_t> on_boundary;
  Body still = body;
  still.vertices.position = rest;
  for (const BoundaryFacet& facet : boundary.facets()) {
    ASSERT_TRUE(area.contains(facet.number));
    const Vector3d expected = BoundarySurface::area_vector(still, facet);
    ASSERT_LE((area[facet.number] - expected).norm(), 1e-14 * (1 + expected.norm()));
    for (const std::uint32_t i : boundary.corners(body, facet)) on_boundary.insert(i);
  }
  for (std::uint32_t i = 0; i < body.vertices.size(); ++i)
    ASSERT_EQ(solids.is_on_boundary(i), on_boundary.contains(i)) << i;

  std::map<std::uint32_t, double> volume;  // by cell
  std::map<std::uint32_t, std::set<std::uint32_t>> nodes;
  for (const SkinTetrahedron& t : solids.tetrahedra()) {
    ASSERT_GT(volume_of(t, rest), 0.0);
    volume[t.cell] += volume_of(t, rest);
    nodes[t.cell].insert(t.nodes.begin(), t.nodes.end());
    for (std::size_t k = 0; k < 4; ++k)
      if ((t.outer >> k & 1u) != 0) --outer[without(t, k)];
  }
  // two sides of a cut may have the same nodes
  for (const auto& [face, count] : outer) ASSERT_EQ(count, 0) << "a triangle that is no face of a tetrahedron";
  for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c) {
    std::set<std::uint32_t> corners;
    for_each_dart_of(body.map, Volume{body.cell_dart[c]}, [&](Dart d) { corners.insert(body.vertex(body.map, d)); });
    const bool along = std::ranges::any_of(corners, [&](std::uint32_t i) { return on_boundary.contains(i); });
    ASSERT_EQ(nodes.contains(c), along) << c;
    if (!along) continue;
    ASSERT_EQ(nodes[c], corners);
    ASSERT_NEAR(volume[c] / (body.cell_mass[c] / 1000.0), 1.0, 1e-12);
  }
  // what is around each node and of each cell is found
  std::size_t rows = 0;
  for (std::uint32_t i = 0; i < body.vertices.size(); ++i)
    solids.for_each_tetrahedron_at(i, [&](std::uint32_t k) {
      const auto& n = solids.tetrahedra()[k].nodes;
      ASSERT_NE(std::ranges::find(n, i), n.end());
      ++rows;
    });
  ASSERT_EQ(rows, 4 * solids.tetrahedra().size());
}

template <class Map>
struct SkinSolidsOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SkinSolidsOf, Solids);

TYPED_TEST(SkinSolidsOf, ABodyFollowAThousandOperationsUntilNothingIsLeft) {
  int operations = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto body = at_rest<TypeParam>(with_left_handed_cells(kuhn_grid(3, 3, 3, 0.25, 0.1, 3)));
    SkinSolidsView view = view_of(body);
    expect_what_is_along_the_boundary(view.solids(), body);
    operate_at_random(body, seed, 200, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      view.apply(now, changed);
      ASSERT_EQ(view, view_of(now)) << operations;
      if (operations % 7 == 0) expect_what_is_along_the_boundary(view.solids(), now);
      ++operations;
    });
    EXPECT_TRUE(view.solids().tetrahedra().empty());
    EXPECT_TRUE(view.solids().triangles().empty());
  }
  EXPECT_GT(operations, 1000);
}

TYPED_TEST(SkinSolidsOf, ABodyFollowRefinement) {
  auto body = at_rest<TypeParam>(with_left_handed_cells(kuhn_grid(2, 2, 2, 0.25, 0.1, 3)));
  SkinSolidsView view = view_of(body);
  SplitMix64 random(6);
  for (int k = 0; k < 60; ++k) {
    const Dart d = some_live_dart(body.map, random);
    const ChangedEmbeddings changed = k % 3 == 0   ? refine(body, Volume{d}, 0.5)
                                      : k % 3 == 1 ? refine(body, Face{d}, 0.5)
                                                   : refine(body, Edge{d}, 0.5);
    view.apply(body, changed);
    ASSERT_EQ(view, view_of(body)) << k;
    if (k % 7 == 0) expect_what_is_along_the_boundary(view.solids(), body);
    view.apply(body, adapt(body, dissociate_something(body.map, random)));
    ASSERT_EQ(view, view_of(body)) << k;
  }
}

TEST(SkinSolidsOfHexahedra, FollowEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : {hexahedron_box(4, 3, 3, 1.0), mixed_cells(), mixed_box(3, 2, 3, 0.5)}) {
    auto body = at_rest<Map3>(mesh);
    SkinSolidsView view = view_of(body);
    expect_what_is_along_the_boundary(view.solids(), body);
    operate_at_random(body, 1, 20, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      view.apply(now, changed);
      ASSERT_EQ(view, view_of(now));
      expect_what_is_along_the_boundary(view.solids(), now);
    });
    EXPECT_TRUE(view.solids().tetrahedra().empty());
  }
}

// Cells that share a face cut it alike, so that every point of the body is in one of their tetrahedra, or on a face of
// two: every face of a tetrahedron that is not on the boundary occurs twice. Also after numbers have changed.
TEST(SkinSolidsOfHexahedra, HaveNoGapsBetweenCells) {
  for (const Mesh& mesh : {hexahedron_box(3, 2, 2, 1.0), mixed_box(3, 2, 2, 0.5)}) {
    auto body = at_rest<Map3>(mesh);
    SkinSolidsView view = view_of(body);
    SplitMix64 random(3);
    for (int k = 0; k < 6; ++k) {
      std::map<std::set<std::uint32_t>, int> faces;
      for (const SkinTetrahedron& t : view.solids().tetrahedra())
        for (std::size_t c = 0; c < 4; ++c) faces[without(t, c)] += (t.outer >> c & 1u) != 0 ? 2 : 1;
      for (const auto& [nodes, count] : faces) ASSERT_EQ(count, 2);
      view.apply(body, adapt(body, remove_something(body.map, random)));
    }
  }
}

TYPED_TEST(SkinSolidsOf, ABodyAreInTheGroupsOfTheirCells) {
  auto body = at_rest<TypeParam>(kuhn_grid(2, 1, 1, 0.5));
  std::vector<std::uint32_t> group;
  for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c) group.push_back(c / 6);
  SkinSolidsView view([&group](std::uint32_t c) { return group[c]; });
  view.rebuild(body);
  SplitMix64 random(2);
  while (body.cell_dart.size() > 1) {
    const ChangedEmbeddings changed = adapt(body, remove_something(body.map, random));
    for (const auto [from, to] : changed.moved_cells) group[to] = group[from];
    view.apply(body, changed);
    for (const SkinTetrahedron& t : view.solids().tetrahedra()) {
      EXPECT_EQ(t.group, group[t.cell]);
      if (body.cell_dart.size() == 1) {
        EXPECT_EQ(view.solids().group_at(t.nodes[0]), group[0]);
      }
    }
  }
  EXPECT_EQ(view_of(body).solids().group_at(0), 0u);
}

TYPED_TEST(SkinSolidsOf, ABodyAreKeptInACheckpoint) {
  auto body = at_rest<TypeParam>(kuhn_grid(2, 2, 1, 0.5));
  SkinSolidsView view = view_of(body);
  SplitMix64 random(2);
  for (int k = 0; k < 5; ++k) view.apply(body, adapt(body, do_something(body.map, random)));
  Archive written;
  view.state(written);
  SkinSolidsView other = view_of(at_rest<TypeParam>(kuhn_grid(1, 1, 1, 0.5)));
  const std::uint64_t changes = other.solids().changes();
  Archive read(written.written(), "file");
  other.state(read);
  read.require_end();
  EXPECT_EQ(other, view);
  EXPECT_NE(other.solids().changes(), changes);
}

TEST(SkinSolidsOfEitherStorage, AreTheSame) {
  const Mesh mesh = kuhn_grid(3, 2, 2, 0.25, 0.1, 3);
  const SkinSolidsView one = view_of(at_rest<Map3>(mesh)), other = view_of(at_rest<TetMap>(mesh));
  EXPECT_EQ(one.solids().tetrahedra().size(), other.solids().tetrahedra().size());
  expect_what_is_along_the_boundary(other.solids(), at_rest<TetMap>(mesh));
}

/// Cut a box of unit width right through at x = 1/2, face by face; visit(body, changed) after each.
template <class Map, class Visit>
void cut_through(AdaptedBody<Map>& body, Visit&& visit) {
  for (bool found = true; found;) {
    found = false;
    for (std::uint32_t k = 0; k < body.face_dart.size() && !found; ++k) {
      const Dart d = body.face_dart[k];
      bool in_plane = !body.map.template is_free<3>(d);
      for_each_dart_of(body.map, Face{d},
                       [&](Dart e) { in_plane = in_plane && body.vertices.rest[body.vertex(body.map, e)][0] == 0.5; });
      if (!in_plane) continue;
      visit(body, adapt(body, dissociate_face(body.map, d)));
      found = true;
    }
  }
}

// A body that is bent and pressed together has no contact while it is cut, to the last bit: neither does its energy
// jump. The part that has been cut off and pushed into the other then has the pressure of the law over the cut.
TYPED_TEST(SkinSolidsOf, ABodyHaveNoContactInAFreshCut) {
  for (const bool bent : {false, true}) {
    const int p = bent ? 3 : 2;
    ContactLaw law;
    law.pressure = 1000.0;
    law.depth = 0.02;
    law.exponent = p;
    auto body = at_rest<TypeParam>(kuhn_grid(4, 4, 4, 0.25));
    Skin skin;
    skin.rebuild(body);
    SkinSolidsView view = view_of(body);
    BodyContact contact(skin.samples(), view.solids(), {{0, 0, law}});
    if (bent)
      for (Vector3d& x : body.vertices.position)
        x = Vector3d(0.7 * x[0] + 0.1 * x[1] * x[2], 0.9 * x[1] - 0.05 * x[0] * x[0], x[2] + 0.1 * x[0] * x[1]);
    EXPECT_EQ(contact.energy(body.vertices.position), 0.0);
    cut_through(body, [&](const auto& now, const ChangedEmbeddings& changed) {
      skin.apply(now, changed);
      view.apply(now, changed);
      ASSERT_EQ(Contacts(nullptr, &contact).state_at(now.vertices.position).contacts, 0u);
      ASSERT_EQ(contact.energy(now.vertices.position), 0.0);
    });
    // the vertices of the right part
    std::vector<std::uint8_t> right(body.vertices.size(), 0);
    for (std::uint32_t c = 0; c < body.cell_dart.size(); ++c) {
      bool is_right = false;
      const auto visit = [&](auto&& f) { for_each_dart_of(body.map, Volume{body.cell_dart[c]}, f); };
      visit([&](Dart d) { is_right = is_right || body.vertices.rest[body.vertex(body.map, d)][0] > 0.5; });
      visit([&](Dart d) { right[body.vertex(body.map, d)] |= static_cast<std::uint8_t>(is_right); });
    }
    const double depth = 0.01;
    std::vector<Vector3d> x = body.vertices.rest, force(x.size(), Vector3d(0, 0, 0));
    for (std::size_t i = 0; i < x.size(); ++i) x[i][0] -= right[i] * depth;
    contact.add_forces({x}, force);
    double pushed = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) pushed += right[i] * force[i][0];
    // as for boxes on each other: those at the border have no depth
    const double expected = (0.75 + 0.25 * 9 / 16) * law.force(1.0, depth);
    EXPECT_NEAR(pushed, expected, 1e-11 * expected) << p;
  }
}

// A surface has no inside, and a body without places at rest no orientation.
TEST(SkinSolidsOfASurface, AreNone) {
  auto sheet = at_rest<Map2>(triangle_sheet(3, 2, 0.1));
  SkinSolidsView view = view_of(sheet);
  SplitMix64 random(2);
  view.apply(sheet, adapt(sheet, dissociate_something(sheet.map, random)));
  EXPECT_TRUE(view.solids().tetrahedra().empty());
  auto box = at_rest<Map3>(kuhn_grid(1, 1, 1, 0.5));
  box.vertices.rest.clear();
  view = view_of(box);
  view.apply(box, adapt(box, dissociate_something(box.map, random)));
  EXPECT_TRUE(view.solids().tetrahedra().empty());
  EXPECT_TRUE(view.solids().triangles().empty());
}

}  // namespace
}  // namespace dartboard::skin_solids_view_test
