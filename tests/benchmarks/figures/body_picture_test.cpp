#include "benchmarks/figures/body_picture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "benchmarks/figures/body_facets.h"
#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::body_picture_test {
namespace {

Frame panel_of(Mesh mesh) {
  Frame panel;
  panel.mesh = std::move(mesh);
  panel.component.assign(panel.mesh.cell_count(), 0);
  for (std::uint32_t k = 0; k < panel.mesh.points.size(); ++k) panel.mesh_point.push_back(k);
  return panel;
}

/// In the order in which they are drawn.
std::vector<DrawnFacet> drawn_facets(const Frame& panel, const Frame& first) {
  auto facets = BodyFacets({}, first).of(panel).facets;
  order_by_depth(facets);
  return facets;
}
double depth(const DrawnFacet& facet) {
  double sum = 0.0;
  for (const Eigen::Vector3d& x : facet.corners) sum += x.z();
  return sum / static_cast<double>(facet.corners.size());
}

std::set<std::uint32_t> colours(const std::vector<DrawnFacet>& facets) {
  std::set<std::uint32_t> found;
  for (const DrawnFacet& f : facets) found.insert(f.colour());
  return found;
}

// a cube of six tetrahedra: two triangles on each side, and three sides towards the viewer
TEST(BodyPicture, ShowsTheBoundaryTowardsTheViewerOnly) {
  const Frame panel = panel_of(kuhn_box(1, 1, 1, 1.0, 0.0, 0));
  EXPECT_EQ(drawn_facets(panel, panel).size(), 6u);
}

TEST(BodyPicture, DrawsTheFarthestFacetFirst) {
  const Frame panel = panel_of(kuhn_box(2, 2, 2, 1.0, 0.0, 0));
  const auto facets = drawn_facets(panel, panel);
  // those of one side are equally far, but for roundings
  for (std::size_t k = 1; k < facets.size(); ++k) EXPECT_GT(depth(facets[k]), depth(facets[k - 1]) - 0x1p-48);
}

TEST(BodyPicture, GivesAComponentOfItsOwnAnotherColour) {
  Frame panel = panel_of(kuhn_box(1, 1, 1, 1.0, 0.0, 0));
  const auto one = colours(drawn_facets(panel, panel));
  panel.component.assign(panel.component.size(), 1);
  for (const std::uint32_t colour : colours(drawn_facets(panel, panel))) EXPECT_FALSE(one.contains(colour));
}

// The front one of two cubes of a box is removed: the side that it had hidden shows, in the colour of inner facets.
TEST(BodyPicture, ShowsWhatWasInsideInAColourOfItsOwn) {
  const Frame first = panel_of(hexahedron_box(1, 2, 1, 1.0));
  Frame later = first;
  Mesh fewer;
  fewer.points = first.mesh.points;
  fewer.add_cell(CellKind::hexahedron, first.mesh.cell(1));
  later.mesh = fewer;
  const auto facets = drawn_facets(later, first);
  ASSERT_EQ(facets.size(), 3u);
  EXPECT_EQ(std::count_if(facets.begin(), facets.end(),
                          [](const DrawnFacet& f) { return (f.colour() >> 16) > 2 * ((f.colour() >> 8) & 0xff); }),
            1);
}

TEST(BodyPicture, OfAChainShowsItsLinksAsLines) {
  Frame panel;
  panel.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}};
  panel.links = {{0, 1}, {1, 2}};
  panel.component = {0, 0};
  panel.mesh_point = {0, 1, 2};
  const auto lines = drawn_facets(panel, panel);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].corners.size(), 2u);
}

TEST(BodyPicture, OfASurfaceShowsEveryPolygon) {
  const Frame panel = panel_of(triangle_sheet(3, 2, 1.0));
  EXPECT_EQ(drawn_facets(panel, panel).size(), 12u);
}

// ---- places

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The ends of three links of 1 m along x, y and z in the picture, as columns.
Eigen::Matrix<double, 2, 3> view() {
  Frame axes;
  axes.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  axes.links = {{0, 1}, {0, 2}, {0, 3}};
  axes.component = {0, 0, 0};
  axes.mesh_point = {0, 1, 2, 3};
  Eigen::Matrix<double, 2, 3> columns;
  for (int axis = 0; axis < 3; ++axis) {
    Frame one = axes;
    one.links = {axes.links[static_cast<std::size_t>(axis)]};
    const auto corners = drawn_facets(one, one).at(0).corners;
    columns.col(axis) = (corners[1] - corners[0]).head<2>();
  }
  return columns;
}
Vector3d towards_viewer() { return view().row(0).cross(view().row(1)).transpose(); }

// "from the front, a little from the right and above, z upwards"; x to the right and y away from the front
TEST(BodyPicture, IsSeenFromTheFrontRightAndAboveAndIsNotMirrored) {
  const auto v = view();
  // along parallels, one scale everywhere: rows of length 1 at right angles, to a few roundings
  EXPECT_NEAR(v.row(0).norm(), 1.0, 0x1p-49);
  EXPECT_NEAR(v.row(1).norm(), 1.0, 0x1p-49);
  EXPECT_NEAR(v.row(0).dot(v.row(1)), 0.0, 0x1p-49);
  EXPECT_NEAR(v(0, 2), 0.0, 0x1p-49);  // vertical lines stay vertical
  EXPECT_GT(v(1, 2), 0.7);
  EXPECT_GT(v(0, 0), 0.7);
  EXPECT_GT(v(1, 1), 0.1);  // seen from above: points behind are higher
  const Vector3d viewer = towards_viewer();
  EXPECT_LT(viewer.y(), -0.7);
  EXPECT_GT(viewer.x(), 0.1);
  EXPECT_GT(viewer.z(), 0.1);
}

TEST(BodyPicture, PutsEveryCornerWhereTheViewPutsItsVertex) {
  // no two edges of this cell are parallel and of one length
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  const Frame panel = panel_of(mesh);
  const auto facets = drawn_facets(panel, panel);
  // of its faces, those on y = 0 and across the corner look towards the viewer; the others towards -x and -z
  ASSERT_EQ(facets.size(), 2u);
  for (const std::vector<int>& face : {std::vector{0, 1, 3}, std::vector{1, 2, 3}}) {
    std::vector<Vector2d> expected;
    Vector3d middle(0, 0, 0);
    for (const int k : face) {
      expected.push_back(view() * mesh.points[static_cast<std::size_t>(k)]);
      middle += mesh.points[static_cast<std::size_t>(k)] / 3;
    }
    const bool drawn = std::ranges::any_of(facets, [&](const DrawnFacet& f) {
      std::vector<Vector2d> corners;
      for (const Vector3d& x : f.corners) corners.push_back(x.head<2>());
      return std::abs(depth(f) - middle.dot(towards_viewer())) < 0x1p-48 &&
             std::ranges::is_permutation(corners, expected,
                                         [](const Vector2d& a, const Vector2d& b) { return (a - b).norm() < 0x1p-48; });
    });
    EXPECT_TRUE(drawn) << face[0] << face[1] << face[2];
  }
}

// ---- colours

std::uint32_t red(std::uint32_t colour) { return colour >> 16; }
std::uint32_t sum_of_channels(std::uint32_t c) { return (c >> 16) + ((c >> 8) & 0xff) + (c & 0xff); }

TEST(BodyPicture, GivesSevenComponentsSevenColoursAndThenBeginsAnew) {
  Frame panel = panel_of(hexahedron_box(1, 1, 1, 1.0));
  const auto of = [&panel](std::uint32_t component) {
    panel.component = {component};
    return colours(drawn_facets(panel, panel));
  };
  std::set<std::uint32_t> all;
  for (std::uint32_t k = 0; k < 7; ++k) all.merge(of(k));
  EXPECT_EQ(all.size(), 7u * 3u);  // three sides, each in its own light
  EXPECT_EQ(of(7), of(0));
  EXPECT_EQ(of(12), of(5));
}

TEST(BodyPicture, GivesEachFacetTheColourOfItsOwnCell) {
  Frame panel = panel_of(hexahedron_box(2, 1, 1, 1.0));
  panel.component = {0, 1};
  Frame blue = panel, ochre = panel;
  blue.component = {0, 0};
  ochre.component = {1, 1};
  const auto facets = drawn_facets(panel, panel), at_left = drawn_facets(blue, blue),
             at_right = drawn_facets(ochre, ochre);
  ASSERT_EQ(facets.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_TRUE(facets[k].colour() == at_left[k].colour() || facets[k].colour() == at_right[k].colour());
    EXPECT_NE(at_left[k].colour(), at_right[k].colour());
  }
  // the side at the right end and the two next to it are the second cell's
  EXPECT_EQ(std::ranges::count_if(facets, [&](const DrawnFacet& f) { return colours(at_right).contains(f.colour()); }),
            3);
}

TEST(BodyPicture, LightsTheTopMost) {
  const Frame panel = panel_of(hexahedron_box(1, 1, 1, 1.0));
  auto facets = drawn_facets(panel, panel);
  std::ranges::sort(facets, {}, [](const DrawnFacet& f) {
    double y = 0.0;
    for (const Vector3d& corner : f.corners) y += corner.y();
    return y;
  });
  EXPECT_GT(sum_of_channels(facets[2].colour()), sum_of_channels(facets[0].colour()));
  EXPECT_GT(sum_of_channels(facets[2].colour()), sum_of_channels(facets[1].colour()));
}

bool is_inside(const DrawnFacet& f) {
  return red(f.colour()) > 2 * ((f.colour() >> 8) & 0xff);
}  // neither blue nor ochre

/// Of the boundary facets that look towards the viewer, those that are on a side of the box, and the others.
std::array<std::ptrdiff_t, 2> seen_on_and_off_the_sides(const Mesh& mesh, double side) {
  std::map<std::set<std::uint32_t>, std::pair<int, std::vector<Vector3d>>> faces;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const std::vector<int>& face : faces_of(mesh.kinds[c])) {
      std::set<std::uint32_t> nodes;
      std::vector<Vector3d> corners;
      for (const int k : face) {
        nodes.insert(mesh.cell(c)[static_cast<std::size_t>(k)]);
        corners.push_back(mesh.points[mesh.cell(c)[static_cast<std::size_t>(k)]]);
      }
      auto& [cells, of_last] = faces[nodes];
      ++cells;
      of_last = corners;
    }
  std::array<std::ptrdiff_t, 2> count{};
  for (const auto& [nodes, face] : faces) {
    const std::vector<Vector3d>& x = face.second;
    if (face.first != 1 || (x[1] - x[0]).cross(x[2] - x[0]).dot(towards_viewer()) <= 0.0) continue;
    bool is_on_a_side = false;
    for (const int axis : {0, 1, 2})
      for (const double at : {0.0, side})
        is_on_a_side |= std::ranges::all_of(x, [&](const Vector3d& p) { return p[axis] == at; });
    ++count[is_on_a_side ? 0 : 1];
  }
  return count;
}

// A box without forces, so that facets of its sides are known by their coordinates: means of powers of two are exact.
TEST(BodyPicture, KnowsOfFacetsThatRefinementMadeWhichAreOnTheOutside) {
  using namespace moving;
  for (const char* events :
       {R"([{"at": 0.001, "refine": {"cells": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.2}}}}])",
        R"([{"at": 0.001, "refine": {"cells": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.2}}}},
                                 {"at": 0.002, "refine": {"cells": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.1}}}},
                                 {"at": 0.003, "refine": {"cells": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.1}}, "at": "centre"}},
                                 {"at": 0.004, "remove": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.08}}},
                                 {"at": 0.005, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
                                 {"at": 0.006, "refine": {"cells": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.15}}}},
                                 {"at": 0.007, "remove": {"sphere": {"centre": [0.25, 0, 0], "radius": 0.09}}}])",
        R"([{"at": 0.001, "refine": {"cells": {"ids": [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]}, "at": "centre"}},
                                 {"at": 0.002, "remove": {"sphere": {"centre": [0.25, 0, 0.25], "radius": 0.1}}}])"}) {
    Json scene = with_events(moving_box(), events);
    scene.erase("initial_velocity");
    scene["gravity"] = {0, 0, 0};
    scene["material"]["stiffness"] = scene["material"]["damping"] = 0;
    Simulation simulation(parse(scene));
    const Frame first = simulation.frame();
    while (simulation.steps_done() < simulation.step_count()) {
      ASSERT_FALSE(simulation.advance());
      const Frame now = simulation.frame();
      const auto [on, off] = seen_on_and_off_the_sides(now.mesh, 0.25);
      const auto facets = drawn_facets(now, first);
      ASSERT_EQ(std::ranges::count_if(facets, is_inside), off) << simulation.time() << " s of " << events;
      ASSERT_EQ(static_cast<std::ptrdiff_t>(facets.size()), on + off) << simulation.time() << " s of " << events;
      ASSERT_GT(on, 12);  // each side of 2 x 2 squares has 8 at first
    }
    const auto off = seen_on_and_off_the_sides(simulation.frame().mesh, 0.25)[1];
    EXPECT_EQ(off > 0, std::string_view(events).find("remove") != std::string_view::npos) << events;
  }
}

// Two opposite corners of a cube exchange their numbers, as removals make vertices do: its sides remain its sides.
TEST(BodyPicture, KnowsFacetsByThePointsOfTheMeshWhateverTheirNumbersAre) {
  const Frame first = panel_of(hexahedron_box(1, 1, 1, 1.0));
  Frame renumbered = first;
  Mesh& mesh = renumbered.mesh;
  std::swap(mesh.points[0], mesh.points[7]);
  std::swap(renumbered.mesh_point[0], renumbered.mesh_point[7]);
  for (std::uint32_t& k : mesh.nodes) k = k == 0 ? 7 : k == 7 ? 0 : k;
  EXPECT_EQ(colours(drawn_facets(renumbered, first)), colours(drawn_facets(first, first)));
}

// ---- panels

using BodyPictureFiles = FolderTest;

std::vector<BodyPanel> panels(const Frame& first, const Frame& second) {
  BodyFacets facets({}, first);
  return {facets.of(first), facets.of(second)};
}

/// The corners in a file of polygons, one list for each.
std::vector<std::vector<Vector2d>> polygons(const std::string& data) {
  std::vector<std::vector<Vector2d>> all(1);
  std::istringstream stream(data);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) {
      all.emplace_back();
      continue;
    }
    std::istringstream numbers(line);
    Vector2d x;
    numbers >> x[0] >> x[1];
    all.back().push_back(x);
  }
  if (all.back().empty()) all.pop_back();
  return all;
}

TEST_F(BodyPictureFiles, HavePanelsSideBySideEachWithItsTime) {
  Frame first = panel_of(hexahedron_box(1, 1, 1, 1.0)), second = first;
  second.time = 0.5;
  for (Vector3d& x : second.mesh.points) x.z() += 0.25;
  ASSERT_EQ(draw_bodies(panels(first, second), {}, "t", folder_, "two"), "");
  const auto drawn = polygons(text("two.dat"));
  ASSERT_EQ(drawn.size(), 2u * 3u * 2u);  // two panels, three sides, rim and inner part
  // Every corner of the second panel is a panel's width to the right, and higher by the image of 0.25 m. The file has
  // six digits of numbers below 10.
  const Vector2d shift = drawn[6][0] - drawn[0][0];
  EXPECT_NEAR(shift.y(), 0.25 * view()(1, 2), 2e-5);
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t c = 0; c < 4; ++c) EXPECT_LT((drawn[k + 6][c] - drawn[k][c] - shift).norm(), 4e-5);
  double left = 0.0, right = 0.0;
  for (std::size_t k = 0; k < 6; ++k)
    for (const Vector2d& x : drawn[k]) {
      left = std::min(left, x.x());
      right = std::max(right, x.x());
    }
  EXPECT_GT(shift.x(), right - left);
  const std::string script = text("two.gnuplot");
  EXPECT_NE(script.find("set label 1 't = 0 s' at 0,"), std::string::npos) << script;
  const auto label = script.find("set label 2 't = 0.5 s' at ");
  ASSERT_NE(label, std::string::npos) << script;
  EXPECT_NEAR(std::stod(script.substr(label + 27)), shift.x(), 4e-5);
}

TEST_F(BodyPictureFiles, HaveARectangleAroundEachLink) {
  Frame panel;
  panel.mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 0, -1}};
  panel.links = {{0, 1}, {1, 2}};
  panel.component = {0, 0};
  panel.mesh_point = {0, 1, 2};
  ASSERT_EQ(draw_bodies(std::vector{BodyFacets({}, panel).of(panel)}, {}, "t", folder_, "links"), "");
  const auto drawn = polygons(text("links.dat"));
  const auto links = drawn_facets(panel, panel);
  ASSERT_EQ(drawn.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(drawn[k].size(), 4u);
    const Vector2d along = drawn[k][1] - drawn[k][0], aside = drawn[k][3] - drawn[k][0];
    const Vector2d link = (links[k].corners[1] - links[k].corners[0]).head<2>();
    // six digits of numbers below 10
    EXPECT_LT((drawn[k][2] - drawn[k][1] - aside).norm(), 4e-5);
    EXPECT_NEAR(along.normalized().dot(link.normalized()), 1.0, 1e-3);
    EXPECT_NEAR(along.norm() / link.norm(), 1.0, 0.02);
    EXPECT_LT(std::abs(along.normalized().dot(aside.normalized())), 0.02);
    EXPECT_GT(aside.norm(), 0.0);
    EXPECT_LT(aside.norm(), 0.02 * link.norm());
  }
}

TEST_F(BodyPictureFiles, HaveABodyThatFliesFarInTheMiddleOfItsPanel) {
  Frame first = panel_of(hexahedron_box(1, 1, 1, 1.0)), second = first;
  for (Vector3d& x : second.mesh.points) x.x() += 100;
  ASSERT_EQ(draw_bodies(panels(first, second), {}, "t", folder_, "two"), "");
  const auto drawn = polygons(text("two.dat"));
  ASSERT_EQ(drawn.size(), 12u);
  EXPECT_LT((drawn[6][0] - drawn[0][0]).norm(), 3.0);
  EXPECT_NEAR((drawn[6][0] - drawn[0][0]).y(), 0.0, 4e-5);
}

// ---- the view

TEST(PictureView, ShowsUpwardsWhatIsUp) {
  const PictureView turned({0, 9.81, 0}), upright;
  // a rotation of numbers of size 1: a few roundings
  EXPECT_LT((turned.seen({0, 1, 0}) - upright.seen({0, 0, 1})).norm(), 1e-15);
  Eigen::Matrix3d axes;
  for (int k = 0; k < 3; ++k) axes.col(k) = turned.seen(Vector3d::Unit(k));
  EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);  // no mirror image
  EXPECT_EQ(turned.light(), upright.light());
}

// To the right, upwards, towards the viewer: exact along the axes.
TEST(PictureView, IsFromTheDirectionAskedFor) {
  const PictureView from_x({0, 0, 1}, {2, 0, 0}), from_above({0, 0, 1}, {0, 0, 5}), with_y_up({0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(from_x.seen({1, 2, 3}), Vector3d(2, 3, 1));
  EXPECT_EQ(from_above.seen({1, 2, 3}), Vector3d(1, 2, 3));
  EXPECT_EQ(with_y_up.seen({1, 2, 3}), Vector3d(1, 2, 3));
  EXPECT_EQ(PictureView({0, 1, 0}, {0, 1, 0}).seen({1, 2, 3}), Vector3d(-1, 3, 2));
  EXPECT_EQ(from_x.light(), PictureView().light());
}

TEST(PictureView, ShowsZUpwardsWhereThereIsNoUp) {
  const Vector3d x(0.1, 0.2, 0.3);
  for (const Vector3d& up : {Vector3d(0, 0, 9.81), Vector3d(0, 0, 0)})
    EXPECT_EQ(PictureView(up).seen(x), PictureView().seen(x));
}

}  // namespace
}  // namespace dartboard::body_picture_test
