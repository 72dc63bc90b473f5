// What pictures show of a scene besides the shape of its bodies: obstacles, constraints, attachments, quantities and
// scales.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "benchmarks/figures/album.h"
#include "benchmarks/figures/body_picture.h"
#include "core/mechanics/fracture/stress.h"
#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::scene_picture_test {
namespace {

using Eigen::Vector3d;
using moving::Json;
using moving::moving_box;

BodyPanel panel_of(const Simulation& simulation, const Look& look) {
  const Frame frame = simulation.frame(BodyFacets::fields(look));
  return BodyFacets(look, frame).of(frame);
}
std::map<std::uint32_t, std::size_t> dots_of(const BodyPanel& panel) {
  std::map<std::uint32_t, std::size_t> dots;
  for (const DrawnFacet& facet : panel.facets)
    if (facet.corners.size() == 1) ++dots[facet.base];
  return dots;
}
Json entry(const char* text) { return Json::parse(text); }

// ---- constraints

// the top has 9 vertices, all seen, and the bottom 9, of which 5 are on the front or on the right
TEST(ScenePicture, HasADotOnEachVisibleVertexThatIsHeldOrDriven) {
  Json scene = moving_box();
  scene["fixed"] = entry(R"([{"plane": {"point": [0, 0, 0.24], "normal": [0, 0, 1]}}])");
  scene["driven"] = entry(R"([{"plane": {"point": [0, 0, 0.01], "normal": [0, 0, -1]}, "velocity": [0, 0, -1]}])");
  EXPECT_EQ(dots_of(panel_of(Simulation(moving::parse(scene)), {})),
            (std::map<std::uint32_t, std::size_t>{{colours::held, 9}, {colours::driven, 5}}));
}

TEST(ScenePicture, ShowsAttachmentsFromTheirVerticesToTheirPlaces) {
  Json scene = moving_box();
  scene["attachments"] = entry(R"([{"plane": {"point": [0, 0, 0.24], "normal": [0, 0, 1]}, "stiffness": 1}])");
  Simulation simulation(moving::parse(scene));
  const Frame first = simulation.frame();
  BodyPanel panel = panel_of(simulation, {});
  EXPECT_EQ(dots_of(panel), (std::map<std::uint32_t, std::size_t>{{colours::attached, 9}}));
  moving::run(simulation);
  const Frame now = simulation.frame({.attachments = true});
  ASSERT_EQ(now.attachments.size(), 9u);
  for (const auto& [vertex, place] : now.attachments) {
    const auto k = std::ranges::find(now.mesh.points, vertex) - now.mesh.points.begin();
    ASSERT_LT(static_cast<std::size_t>(k), first.mesh.points.size());
    EXPECT_EQ(place, first.mesh.points[static_cast<std::size_t>(k)]);
    EXPECT_NE(place, vertex);
  }
  panel = panel_of(simulation, {});
  std::size_t lines = 0;
  for (const DrawnFacet& facet : panel.facets) {
    if (facet.corners.size() != 2) continue;
    EXPECT_EQ(facet.base, colours::attached);
    EXPECT_EQ(facet.corners[0], PictureView().seen(now.attachments[lines][0]));
    EXPECT_EQ(facet.corners[1], PictureView().seen(now.attachments[lines][1]));
    ++lines;
  }
  EXPECT_EQ(lines, 9u);
}

TEST(ScenePicture, OfOtherFramesHasNoAttachments) {
  Json scene = moving_box();
  scene["attachments"] = entry(R"([{"plane": {"point": [0, 0, 0.24], "normal": [0, 0, 1]}, "stiffness": 1}])");
  EXPECT_TRUE(Simulation(moving::parse(scene)).frame().attachments.empty());
}

// ---- obstacles

const Eigen::AlignedBox3d reach(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));

/// The places in the scene of corners that the view shows.
std::vector<Vector3d> places_of(const DrawnFacet& facet) {
  Eigen::Matrix3d axes;
  for (int k = 0; k < 3; ++k) axes.col(k) = PictureView().seen(Vector3d::Unit(k));
  std::vector<Vector3d> places;
  // they are drawn as if farther by 0.02 of the extent of `reach`
  for (const Vector3d& x : facet.corners) places.push_back(axes.transpose() * (x + Vector3d(0, 0, 0.04)));
  return places;
}
Eigen::AlignedBox3d box_of(const std::vector<DrawnFacet>& facets) {
  Eigen::AlignedBox3d box;
  for (const DrawnFacet& facet : facets)
    for (const Vector3d& x : places_of(facet)) box.extend(x);
  return box;
}
void expect_box(const std::vector<DrawnFacet>& facets, const Vector3d& low, const Vector3d& high) {
  const Eigen::AlignedBox3d box = box_of(facets);
  EXPECT_LT((box.min() - low).norm(), 1e-12) << box.min().transpose();
  EXPECT_LT((box.max() - high).norm(), 1e-12) << box.max().transpose();
}

TEST(ScenePicture, ShowsAPlaneUpToTheReachOfTheBodiesWhereItIsAtThatTime) {
  const Look look{.obstacles = {{.shape = HalfSpace{.point = {70, 80, -0.5}}, .velocity = {3, 0, 0.5}}}};
  for (const double time : {0.0, 1.0}) {
    const auto facets = facets_of_obstacles(look, time, reach);
    ASSERT_EQ(facets.size(), 1u);
    expect_box(facets, {-1, -1, 0.5 * time - 0.5}, {1, 1, 0.5 * time - 0.5});
    EXPECT_EQ(facets[0].corners.size(), 4u);
    EXPECT_FALSE(facets[0].outline);
  }
  EXPECT_TRUE(facets_of_obstacles(look, 4.0, reach).empty());  // it is above them
}

TEST(ScenePicture, ShowsAPlaneWithItsBackToTheViewerAsAnOutline) {
  const auto facets = facets_of_obstacles({.obstacles = {{.shape = HalfSpace{.normal = {0, 1, 0}}}}}, 0.0, reach);
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_TRUE(facets[0].outline);
}

TEST(ScenePicture, ShowsTheThreeSidesOfABlockThatLookTowardsTheViewer) {
  const auto whole = facets_of_obstacles({.obstacles = {{.shape = Block{{0.5, 0.5, 0.5}, {2, 2, 1}}}}}, 0.0, reach);
  ASSERT_EQ(whole.size(), 3u);
  expect_box(whole, {0.5, 0.5, 0.5}, {2, 2, 1});
  const auto large = facets_of_obstacles({.obstacles = {{.shape = Block{{-9, -9, -9}, {9, 9, -0.5}}}}}, 0.0, reach);
  ASSERT_EQ(large.size(), 3u);
  expect_box(large, {-1, -1, -1}, {1, 1, -0.5});
}

TEST(ScenePicture, ShowsTheWholeOfABallThatComesNearAndTheNearPartOfALargeOne) {
  const auto whole = facets_of_obstacles({.obstacles = {{.shape = Ball{{1.2, 0, 0}, 0.4}}}}, 0.0, reach);
  ASSERT_FALSE(whole.empty());
  for (const DrawnFacet& facet : whole)
    for (const Vector3d& x : places_of(facet)) EXPECT_NEAR((x - Vector3d(1.2, 0, 0)).norm(), 0.4, 1e-12);
  EXPECT_NEAR(box_of(whole).max().x(), 1.6, 1e-12);
  const auto large = facets_of_obstacles({.obstacles = {{.shape = Ball{{0, 0, -9}, 9}}}}, 0.0, reach);
  ASSERT_FALSE(large.empty());
  EXPECT_LT(box_of(large).min().cwiseAbs().maxCoeff(), 1.0 + 1e-12);
  EXPECT_LT(box_of(large).max().cwiseAbs().maxCoeff(), 1.0 + 1e-12);
  EXPECT_TRUE(facets_of_obstacles({.obstacles = {{.shape = Ball{{1.5, 0, 0}, 0.4}}}}, 0.0, reach).empty());
}

TEST(ScenePicture, OfASceneShowsItsObstaclesAndItsGravityDownwards) {
  Json scene = moving_box();
  scene["gravity"] = {0, -5, 0};
  scene["contact"] = entry(R"({"pressure": 1000, "depth": 0.01, "obstacles": [{"plane": {"point": [0, -0.01, 0],
                               "normal": [0, 1, 0]}}]})");
  const Look look = look_of(moving::parse(scene));
  ASSERT_EQ(look.obstacles.size(), 1u);
  EXPECT_EQ(look.view.seen({1, 2, 3}), PictureView({0, 5, 0}).seen({1, 2, 3}));
  const Simulation simulation(moving::parse(scene));
  const auto panel = panel_of(simulation, look);
  const Drawing drawing = drawing_of(std::span(&panel, 1), look, 0.1);
  EXPECT_EQ(std::ranges::count(drawing.panels[0].facets, colours::obstacle, &DrawnFacet::base), 1);
}

// ---- quantities

TEST(ScenePicture, ColoursFacetsByTheMeanOfTheirCornersInOneScaleForAllTimes) {
  for (const ColourBy by : {ColourBy::speed, ColourBy::stress}) {
    const Look look{.colour = by};
    Simulation simulation(moving::parse(moving_box()));
    Album album(simulation, even_steps(10, 10), look);
    double largest = 0.0;
    for (int k = 0; k < 10; ++k) {
      ASSERT_FALSE(simulation.advance());
      album.stepped(simulation);
    }
    const Frame frame = simulation.frame({.stress = true});
    for (const BodyPanel& panel : album.pictures())
      for (const DrawnFacet& facet : panel.facets) largest = std::max(largest, facet.value);
    ASSERT_GT(largest, 0.0);
    EXPECT_EQ(album.pictures()[0].unit, by == ColourBy::speed ? "m/s" : "Pa");
    const Drawing drawing = drawing_of(album.pictures(), look, 0.1);
    EXPECT_EQ(drawing.largest, largest);
    for (const DrawnFacet& facet : drawing.panels.back().facets) {
      double mean = 0.0;
      for (const Vector3d& corner : facet.corners)
        for (std::size_t k = 0; k < frame.mesh.points.size(); ++k)
          if (PictureView().seen(frame.mesh.points[k]) == corner)
            mean += (by == ColourBy::speed ? frame.velocity[k].norm() : measures_of(frame.stress[k]).von_mises) /
                    static_cast<double>(facet.corners.size());
      EXPECT_NEAR(facet.value, mean, 1e-12 * largest);
      EXPECT_EQ(facet.base, shade_of(facet.value / largest));
    }
  }
}

TEST(ScenePicture, GivesStressesOfSolidsAloneAColourWhereThereAreSurfacesToo) {
  Frame frame;
  frame.mesh = hexahedron_box(1, 1, 1, 1.0);
  frame.mesh.add_cell(CellKind::triangle, std::vector<std::uint32_t>{0, 1, 2});
  frame.component = {0, 1};
  for (std::int64_t k = 0; k < 8; ++k) frame.mesh_point.push_back(k);
  frame.stress.assign(8, Eigen::Matrix3d(Vector3d(3, 0, 0).asDiagonal()));
  const BodyPanel panel = BodyFacets({.colour = ColourBy::stress}, frame).of(frame);
  for (const DrawnFacet& facet : panel.facets) {
    if (facet.corners.size() == 4)
      EXPECT_NEAR(facet.value, 3.0, 1e-14);
    else
      EXPECT_TRUE(std::isnan(facet.value));
  }
  EXPECT_EQ(panel.unit, "Pa");
}

TEST(ScenePicture, GivesLinksOfAChainTheSizeOfTheirTension) {
  Frame frame;
  frame.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  frame.links = {{0, 1}, {1, 2}};
  frame.component = {0, 0};
  frame.mesh_point = {0, 1, 2};
  frame.tension = {-2.0, 5.0};
  const BodyPanel panel = BodyFacets({.colour = ColourBy::stress}, frame).of(frame);
  ASSERT_EQ(panel.facets.size(), 2u);
  EXPECT_EQ(panel.facets[0].value, 2.0);
  EXPECT_EQ(panel.facets[1].value, 5.0);
  EXPECT_EQ(panel.unit, "N");
}

TEST(ScenePicture, ColoursByTheMeanContactForceOfTheCornersOfAFacet) {
  Frame frame;
  frame.mesh = hexahedron_box(1, 1, 1, 1.0);
  frame.component = {0};
  for (std::int64_t k = 0; k < 8; ++k) frame.mesh_point.push_back(k);
  const auto largest = [&frame] {
    double value = -1.0;
    for (const DrawnFacet& facet : BodyFacets({.colour = ColourBy::contact}, frame).of(frame).facets)
      value = std::isnan(facet.value) ? value : std::max(value, facet.value);
    return value;
  };
  EXPECT_EQ(largest(), -1.0) << "a scene without contact has no values";
  for (const Vector3d& x : frame.mesh.points) frame.contact_force.emplace_back(0, 0, x.z() > 0.5 ? -3.0 : 0.0);
  EXPECT_EQ(largest(), 3.0) << "the upper side";
  EXPECT_TRUE(BodyFacets::fields({.colour = ColourBy::contact}).contact);
}

TEST(ScenePicture, ColoursByMaterialWhateverComponentItIsIn) {
  Frame frame;
  frame.mesh = hexahedron_box(2, 1, 1, 1.0);
  frame.component = {0, 0};
  frame.material = {1, 1};
  for (std::int64_t k = 0; k < 12; ++k) frame.mesh_point.push_back(k);
  const auto colour_of = [&frame](ColourBy by) {
    return BodyFacets({.colour = by}, frame).of(frame).facets.at(0).base;
  };
  const std::uint32_t second = colour_of(ColourBy::material);
  frame.material = {0, 0};
  EXPECT_EQ(colour_of(ColourBy::material), colour_of(ColourBy::component));
  EXPECT_NE(colour_of(ColourBy::material), second);
}

// ---- components

Frame components(std::vector<std::uint32_t> of, std::vector<std::uint32_t> cells = {},
                 std::vector<std::uint32_t> body = {}) {
  Frame frame;
  if (cells.empty())
    for (std::uint32_t c = 0; c < of.size(); ++c) cells.push_back(c);
  frame.component = std::move(of);
  frame.mesh_cell = std::move(cells);
  frame.body = std::move(body);
  return frame;
}
using Numbers = std::vector<std::uint32_t>;

TEST(LastingComponents, KeepTheirNumbersInTheLargestPartWhateverFramesNumberFirst) {
  LastingComponents lasting;
  EXPECT_EQ(lasting.of(components({0, 0, 0, 0, 0, 0, 1, 1})), (Numbers{0, 1}));
  // the first two cells come apart, and are the first component of the frame
  EXPECT_EQ(lasting.of(components({0, 0, 1, 1, 1, 1, 2, 2})), (Numbers{2, 0, 1}));
  // then the large part loses its first cells, and falls apart into one cell and two
  EXPECT_EQ(lasting.of(components({0, 0, 1, 2, 2, 3, 3}, {0, 1, 3, 4, 5, 6, 7})), (Numbers{2, 3, 0, 1}));
}

TEST(LastingComponents, GiveTheLargestNewPartTheFirstNewNumber) {
  LastingComponents lasting;
  lasting.of(components({0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(lasting.of(components({0, 1, 1, 2, 2, 2, 2, 2})), (Numbers{2, 1, 0}));
}

TEST(LastingComponents, OfABodyDoNotDependOnCutsOfAnother) {
  LastingComponents lasting;
  EXPECT_EQ(lasting.of(components({0, 0, 1, 1}, {0, 1, 0, 1}, {0, 0, 1, 1})), (Numbers{0, 1}));
  EXPECT_EQ(lasting.of(components({0, 1, 2, 2}, {0, 1, 0, 1}, {0, 0, 1, 1})), (Numbers{0, 2, 1}));
}

// ---- scales

using ScenePictureFiles = FolderTest;

TEST_F(ScenePictureFiles, HaveABarAsLongAsItSays) {
  const std::map<std::string, double> units{{"nm", 1e-9}, {"µm", 1e-6}, {"mm", 1e-3},
                                            {"m", 1.0},   {"km", 1e3},  {"Mm", 1e6}};
  for (const double size : {1e-8, 3e-6, 0.0007, 0.02, 0.5, 1.0, 47.0, 9e3, 2e6}) {
    Frame frame;
    frame.mesh = hexahedron_box(1, 1, 1, size);
    frame.component = {0};
    for (std::int64_t k = 0; k < 8; ++k) frame.mesh_point.push_back(k);
    const BodyPanel panel = BodyFacets({}, frame).of(frame);
    draw_bodies(std::span(&panel, 1), {}, "t", folder_, "bar", "false");
    const std::string script = text("bar.gnuplot");
    const auto arrow = script.find("set arrow 1001 from "), label = script.find("set label 1002 '");
    ASSERT_NE(arrow, std::string::npos) << script;
    ASSERT_NE(label, std::string::npos) << script;
    double from = 0.0, to = 0.0, number = 0.0;
    std::string unit;
    ASSERT_EQ(std::sscanf(script.c_str() + arrow, "set arrow 1001 from %lf,%*f to %lf,", &from, &to), 2);
    std::istringstream(script.substr(label + 16, script.find('\'', label + 16) - label - 16)) >> number >> unit;
    ASSERT_TRUE(units.contains(unit)) << unit;
    // the script has eight digits of places of the size of the body
    EXPECT_NEAR(to - from, number * units.at(unit), 1e-6 * size);
    EXPECT_GT(to - from, 0.05 * size);
    EXPECT_LT(to - from, 1.5 * size);
  }
}

TEST_F(ScenePictureFiles, ExplainTheColoursThatTheyHaveAndNoOthers) {
  Json scene = moving_box();
  scene["fixed"] = entry(R"([{"plane": {"point": [0, 0, 0.24], "normal": [0, 0, 1]}}])");
  const Simulation simulation(moving::parse(scene));
  const auto script_of = [&](const Look& look) {
    const BodyPanel panel = panel_of(simulation, look);
    draw_bodies(std::span(&panel, 1), look, "t", folder_, "legend", "false");
    return text("legend.gnuplot");
  };
  const std::string plain = script_of({}), by_speed = script_of({.colour = ColourBy::speed});
  EXPECT_NE(plain.find("'held'"), std::string::npos);
  for (const char* absent : {"'driven'", "'attached'", "'was inside'", "'obstacle'", "'speed 0'", "'material 0'"})
    EXPECT_EQ(plain.find(absent), std::string::npos) << absent;
  EXPECT_NE(by_speed.find("'speed 0'"), std::string::npos);
  EXPECT_NE(by_speed.find("m/s'"), std::string::npos);
  EXPECT_NE(script_of({.colour = ColourBy::material}).find("'material 0'"), std::string::npos);
}

}  // namespace
}  // namespace dartboard::scene_picture_test
