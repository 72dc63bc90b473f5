#include "benchmarks/body_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/meshes/mesh_generators.h"

namespace dartboard {
namespace {

BodyPanel panel_of(Mesh mesh) {
  BodyPanel panel;
  panel.frame.mesh = std::move(mesh);
  panel.frame.component.assign(panel.frame.mesh.cell_count(), 0);
  for (std::uint32_t k = 0; k < panel.frame.mesh.points.size(); ++k) panel.point.push_back(k);
  return panel;
}

std::set<std::uint32_t> colours(const std::vector<DrawnFacet>& facets) {
  std::set<std::uint32_t> found;
  for (const DrawnFacet& f : facets) found.insert(f.colour);
  return found;
}

// a cube of six tetrahedra: two triangles on each side, and three sides towards the viewer
TEST(BodyPicture, ShowsTheBoundaryTowardsTheViewerOnly) {
  const BodyPanel panel = panel_of(kuhn_box(1, 1, 1, 1.0, 0.0, 0));
  EXPECT_EQ(drawn_facets(panel, panel).size(), 6u);
}

TEST(BodyPicture, DrawsTheFarthestFacetFirst) {
  const BodyPanel panel = panel_of(kuhn_box(2, 2, 2, 1.0, 0.0, 0));
  const auto facets = drawn_facets(panel, panel);
  EXPECT_TRUE(std::is_sorted(facets.begin(), facets.end(),
                             [](const DrawnFacet& a, const DrawnFacet& b) { return a.depth < b.depth; }));
}

TEST(BodyPicture, GivesAComponentOfItsOwnAnotherColour) {
  BodyPanel panel = panel_of(kuhn_box(1, 1, 1, 1.0, 0.0, 0));
  const auto one = colours(drawn_facets(panel, panel));
  panel.frame.component.assign(panel.frame.component.size(), 1);
  for (const std::uint32_t colour : colours(drawn_facets(panel, panel))) EXPECT_FALSE(one.contains(colour));
}

// Of a box of two cubes the one in front is taken away: the side it had hidden shows, in the colour of what was inside.
TEST(BodyPicture, ShowsWhatWasInsideInAColourOfItsOwn) {
  const BodyPanel first = panel_of(hexahedron_box(1, 2, 1, 1.0));
  BodyPanel later = first;
  Mesh fewer;
  fewer.points = first.frame.mesh.points;
  fewer.add_cell(CellKind::hexahedron, first.frame.mesh.cell(1));
  later.frame.mesh = fewer;
  const auto facets = drawn_facets(later, first);
  ASSERT_EQ(facets.size(), 3u);
  EXPECT_EQ(std::count_if(facets.begin(), facets.end(),
                          [](const DrawnFacet& f) { return (f.colour >> 16) > 2 * ((f.colour >> 8) & 0xff); }),
            1);
}

TEST(BodyPicture, OfAChainShowsItsLinksAsLines) {
  BodyPanel panel;
  panel.frame.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}};
  panel.frame.links = {{0, 1}, {1, 2}};
  panel.point = {0, 1, 2};
  const auto lines = drawn_facets(panel, panel);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].corners.size(), 2u);
}

TEST(BodyPicture, OfASurfaceShowsEveryPolygon) {
  const BodyPanel panel = panel_of(triangle_sheet(3, 2, 1.0));
  EXPECT_EQ(drawn_facets(panel, panel).size(), 12u);
}

}  // namespace
}  // namespace dartboard
