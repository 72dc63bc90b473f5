#include "benchmarks/figures/panels.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::panels_test {
namespace {

using PanelsTest = FolderTest;

Panels two_panels() {
  Panels panels;
  panels.title = "two";
  Panel map{.title = "a field"};
  map.field = {{0.25, 0.75}, {0.0, 0.5, 1.0}, {1, 2, 3, 4, 5, -6}};
  map.y_ticks = {{0.0, "none"}, {1.0, "all"}};
  Panel curve{.title = "a curve"};
  curve.x_log = true;
  curve.x_low = 0.01;
  curve.series = {{.title = "falls", .points = {{0.01, 1.0}, {1.0, 0.0}}, .colour = "#ff0000"}};
  curve.key = "top right";
  panels.panels = {map, curve};
  return panels;
}

TEST(PanelsText, ScriptHasEveryPanelInBothPictures) {
  const std::string script = panels_script(two_panels(), "figure");
  for (const char* part :
       {"figure.png", "figure.svg", "layout 1,2", "set ytics ('none' 0, 'all' 1)",
        "'./figure.dat' index 0 using 1:2:3 with image", "set logscale x", "'./figure.dat' index 1 using 1:2"})
    EXPECT_NE(script.find(part), std::string::npos) << part;
}

TEST_F(PanelsTest, FieldsAreWrittenRowByRowWithinTheColours) {
  ASSERT_EQ(draw(two_panels(), folder_, "figure"), "");
  EXPECT_EQ(text("figure.dat"),
            "# a field: the field\n0.25 0 1\n0.75 0 1\n0.25 0.5 1\n0.75 0.5 1\n0.25 1 1\n0.75 1 -1\n"
            "\n\n# a curve: falls\n0.01 1 \"\"\n1 0 \"\"\n");
  EXPECT_EQ(text("figure.png").substr(1, 3), "PNG");
  EXPECT_NE(text("figure.svg").find("<svg"), std::string::npos);
}

TEST_F(PanelsTest, AMissingGnuplotIsToldAndTheDataStay) {
  EXPECT_NE(draw(two_panels(), folder_, "figure", "no-such-gnuplot").find("no-such-gnuplot"), std::string::npos);
  EXPECT_FALSE(text("figure.gnuplot").empty());
  EXPECT_FALSE(text("figure.dat").empty());
}

TEST_F(PanelsTest, APanelThatCannotBeDrawnIsRefused) {
  Panels panels = two_panels();
  panels.panels[0].field.values.pop_back();
  EXPECT_THROW(draw(panels, folder_, "figure"), InputError);
  panels = two_panels();
  panels.panels[1].x_low = 0.0;
  EXPECT_THROW(draw(panels, folder_, "figure"), InputError);
  panels.panels[1].x_low = 2.0;
  EXPECT_THROW(draw(panels, folder_, "figure"), InputError);
}

}  // namespace
}  // namespace dartboard::panels_test
