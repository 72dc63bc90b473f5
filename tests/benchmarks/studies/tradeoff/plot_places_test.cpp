// Places of the points of diagrams, read from gnuplot's SVG: nothing here knows how a script is written.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "benchmarks/figures/panels.h"
#include "benchmarks/figures/plot.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::plot_places_test {
namespace {

struct Spot {
  double x, y;  // [pixels] to the right and down
  std::string colour;
};

/// The round symbols of a picture, in the order they are drawn; those of a legend are not among them.
std::vector<Spot> spots(const std::string& svg) {
  static const std::regex symbol(
      R"(<use xlink:href='#gpPt6' transform='translate\(([-\d.]+),([-\d.]+)\)[^']*' color='rgb\( *(\d+), *(\d+), *(\d+)\)')");
  std::vector<Spot> found;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), symbol); it != std::sregex_iterator(); ++it)
    found.push_back(
        {std::stod((*it)[1]), std::stod((*it)[2]), (*it)[3].str() + " " + (*it)[4].str() + " " + (*it)[5].str()});
  return found;
}

constexpr double rounding = 0.02;  // [pixels] the file has two digits

using PlotPlaces = FolderTest;

TEST_F(PlotPlaces, AreOnLogarithmicAxesToTheRightAndUpwards) {
  Plot plot;
  plot.title = "places";
  plot.x_high = 1000.0;
  plot.y_low = 0.01;
  plot.y_high = 100.0;
  plot.series = {{.title = "", .points = {{1, 0.01}, {10, 1}, {1000, 10}}, .colour = "#ff0000"},
                 {.title = "", .points = {{100, 100}}, .colour = "#0000ff"}};
  ASSERT_EQ(draw(plot, folder_, "figure"), "");
  const auto found = spots(text("figure.svg"));
  ASSERT_EQ(found.size(), 4u);
  const double decade = found[1].x - found[0].x;
  EXPECT_GT(decade, 50.0);
  EXPECT_NEAR(found[2].x - found[0].x, 3 * decade, 3 * rounding);
  EXPECT_NEAR(found[3].x - found[0].x, 2 * decade, 3 * rounding);
  const double up = (found[0].y - found[1].y) / 2;
  EXPECT_GT(up, 50.0);
  EXPECT_NEAR(found[0].y - found[2].y, 3 * up, 3 * rounding);
  EXPECT_NEAR(found[0].y - found[3].y, 4 * up, 3 * rounding);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(found[static_cast<std::size_t>(k)].colour, "255 0 0");
  EXPECT_EQ(found[3].colour, "0 0 255");
}

TEST_F(PlotPlaces, OfRowsAreAtEqualDistancesUpwards) {
  Plot plot;
  plot.title = "rows";
  plot.x_low = 0.5;
  plot.x_high = 2.0;
  plot.y_low = 0.5;
  plot.y_high = 3.5;
  plot.rows = {"one", "two", "three"};
  plot.series = {{.title = "", .points = {{0.5, 1}, {1, 2}, {2, 3}}, .colour = "#ff0000"}};
  ASSERT_EQ(draw(plot, folder_, "figure"), "");
  const auto found = spots(text("figure.svg"));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_GT(found[0].y - found[1].y, 20.0);
  EXPECT_NEAR(found[1].y - found[2].y, found[0].y - found[1].y, 2 * rounding);
  EXPECT_NEAR(found[2].x - found[1].x, found[1].x - found[0].x, 2 * rounding);  // a ratio and its inverse
}

Panel with_points(std::string title, std::vector<PlotSeries::Point> points) {
  Panel panel{.title = std::move(title)};
  panel.series = {{.title = "", .points = std::move(points), .colour = "#ff0000"}};
  return panel;
}

TEST_F(PlotPlaces, OfPanelsFollowRowByRow) {
  Panels panels;
  panels.title = "four";
  panels.columns = 2;
  const std::vector<PlotSeries::Point> corners{{0, 0}, {0.25, 0.5}, {1, 1}};
  panels.panels = {with_points("a", corners), with_points("b", corners), with_points("c", corners)};
  panels.panels[2].x_log = true;
  panels.panels[2].x_low = 0.01;
  panels.panels[2].series[0].points = {{0.01, 0}, {0.1, 0.5}, {1, 1}};
  ASSERT_EQ(draw(panels, folder_, "figure"), "");
  const auto found = spots(text("figure.svg"));
  ASSERT_EQ(found.size(), 9u);
  for (std::size_t first : {0u, 3u}) {
    const double width = found[first + 2].x - found[first].x, height = found[first].y - found[first + 2].y;
    EXPECT_GT(width, 50.0);
    EXPECT_GT(height, 50.0);
    EXPECT_NEAR(found[first + 1].x - found[first].x, width / 4, 2 * rounding);
    EXPECT_NEAR(found[first].y - found[first + 1].y, height / 2, 2 * rounding);
  }
  EXPECT_NEAR(found[7].x - found[6].x, (found[8].x - found[6].x) / 2, 2 * rounding);  // a decade of two
  EXPECT_GT(found[3].x, found[2].x);                                                  // b stands right of a,
  EXPECT_NEAR(found[3].y, found[0].y, 2 * rounding);                                  // level with it,
  EXPECT_GT(found[8].y, found[0].y);                                                  // and c below a
  EXPECT_NEAR(found[6].x, found[0].x, 2 * rounding);
}

// "from blue through white to red": the box of colours is drawn as small bars from its low end up
TEST_F(PlotPlaces, OfFieldColoursGoFromBlueBelowToRedAbove) {
  Panels panels;
  panels.title = "field";
  panels.field_label = "value";
  Panel map{.title = "map"};
  map.field = {{0.25, 0.75}, {0.25, 0.75}, {-1, 1, 0, 0.5}};
  panels.panels = {map};
  ASSERT_EQ(draw(panels, folder_, "figure"), "");
  static const std::regex bar(R"(<polygon fill = 'rgb\( *(\d+), *(\d+), *(\d+)\)' points = '[-\d.]+,([-\d.]+) )");
  const std::string svg = text("figure.svg");
  struct Bar {
    double y;
    int red, green, blue;
  };
  std::vector<Bar> bars;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), bar); it != std::sregex_iterator(); ++it)
    bars.push_back({std::stod((*it)[4]), std::stoi((*it)[1]), std::stoi((*it)[2]), std::stoi((*it)[3])});
  ASSERT_GT(bars.size(), 50u);
  std::ranges::sort(bars, std::ranges::greater(), &Bar::y);
  EXPECT_GT(bars.front().blue, 2 * bars.front().red);
  EXPECT_GT(bars.back().red, 2 * bars.back().blue);
  const Bar& middle = bars[bars.size() / 2];
  EXPECT_GT(std::min({middle.red, middle.green, middle.blue}), 235);
}

}  // namespace
}  // namespace dartboard::plot_places_test
