#include "benchmarks/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "benchmarks/gnuplot.h"
#include "benchmarks/work_precision_plot.h"
#include "core/plain/error.h"
#include "tests/folder_for_tests.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

using PlotTest = FolderTest;

Plot small_plot() {
  Plot plot;
  plot.title = "A \"quoted\" title";
  plot.x_high = plot.y_high = 100.0;
  PlotSeries line{.title = "line", .points = {{1.0, 100.0}, {10.0, 10.0}, {100.0, 1.0, "end"}}, .colour = "#ff0000"};
  line.width = 2.0;
  line.opacity = 0.5;
  plot.series = {line, {.title = "empty", .points = {}, .colour = "#000000"}};
  return plot;
}

TEST(PlotText, DataHoldEveryPointWithAllItsDigits) {
  const PlotSeries series{.title = "", .points = {{1.0 / 3.0, 2.0, "a \"b\""}}, .colour = "#000000"};
  EXPECT_EQ(plot_data(series), "0.33333333333333331 2 \"a \\\"b\\\"\"\n");
}

TEST(PlotText, ScriptDrawsBothPicturesOfAllSeriesWithPoints) {
  const std::string script = plot_script(small_plot(), "figure");
  EXPECT_NE(script.find("set output './figure.png'"), std::string::npos);
  EXPECT_NE(script.find("set output './figure.svg'"), std::string::npos);
  EXPECT_NE(script.find("'./figure.dat' index 0 using 1:2 with linespoints linecolor rgb \"#80ff0000\""),
            std::string::npos);
  EXPECT_EQ(script.find("index 1"), std::string::npos);
  EXPECT_NE(script.find("'A \"quoted\" title'"), std::string::npos);
}

TEST(PlotText, LongTitlesAreBrokenAndShortenedToTheWidthOfThePicture) {
  // 200 pixels of 10-point letters, 8 pixels each: 23 letters a line
  EXPECT_EQ(quoted_title("short", 200, 10.0), "'short'");
  EXPECT_EQ(quoted_title("one two three four five six seven", 200, 10.0),
            "'one two three four five' . \"\\n\" . 'six seven'");
  EXPECT_EQ(quoted_title("one two three four five six seven", 200, 10.0, 1), "'one two three four ...'");
  // letters beyond ASCII count once, apostrophes are typographic, blanks and breaks are one blank
  EXPECT_EQ(
      quoted_title(
          "\xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9",
          200, 10.0),
      "'\xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 \xC3\xA9t\xC3\xA9 "
      "\xC3\xA9t\xC3\xA9'");
  EXPECT_EQ(quoted_title("a \"b's\"\n  c", 200, 10.0), "'a \"b\xE2\x80\x99s\" c'");
  // a word that is longer than a line is cut
  EXPECT_EQ(quoted_title(std::string(100000, 'a'), 200, 10.0), "'" + std::string(20, 'a') + "...'");
}

// A line of letters that just fits into the picture is broken where a legend takes of its width.
TEST(PlotText, TitlesAreCentredBesideTheLegend) {
  Plot plot = small_plot();
  plot.series.resize(1);
  plot.series[0].title.clear();
  plot.title.clear();
  for (int k = 0; k < 10; ++k) plot.title += k == 0 ? "ten letter" : " ten letter";
  const std::string one_line = "set title '" + plot.title + "' font";
  EXPECT_NE(plot_script(plot, "figure").find(one_line), std::string::npos);
  // sixty letters of 9 pixels and what stands beside them leave 800 of 1400: 62 letters of 12 pixels
  plot.series[0].title = std::string(60, 'l');
  EXPECT_NE(plot_script(plot, "figure")
                .find("set title 'ten letter ten letter ten letter ten letter ten letter ten' . \"\\n\" . 'letter ten"),
            std::string::npos)
      << plot_script(plot, "figure");
}

TEST_F(PlotTest, AMissingGnuplotIsToldAndDataAndScriptStay) {
  const std::string trouble = draw(small_plot(), folder_, "figure", "no-such-gnuplot");
  EXPECT_NE(trouble.find("no-such-gnuplot"), std::string::npos) << trouble;
  EXPECT_NE(text("figure.dat").find("100 1 \"end\""), std::string::npos);
  EXPECT_FALSE(text("figure.gnuplot").empty());
}

TEST_F(PlotTest, OneFileHoldsTheDataOfAllSeries) {
  Plot plot = small_plot();
  plot.series.push_back({.title = "second", .points = {{2.0, 3.0}}, .colour = "#00ff00"});
  ASSERT_EQ(draw(plot, folder_, "figure"), "");
  EXPECT_EQ(text("figure.dat"), "# line\n1 100 \"\"\n10 10 \"\"\n100 1 \"end\"\n\n\n# second\n2 3 \"\"\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 4);  // data, script, pictures
}

TEST_F(PlotTest, PicturesAreDrawnInAFolderGivenByARelativePath) {
  const std::string trouble = draw(small_plot(), fs::relative(folder_), "figure");
  ASSERT_EQ(trouble, "");
  EXPECT_EQ(text("figure.png").substr(1, 3), "PNG");
  EXPECT_NE(text("figure.svg").find("<svg"), std::string::npos);
}

TEST_F(PlotTest, AnAxisThatHasNoLogarithmIsRefused) {
  Plot plot = small_plot();
  plot.x_low = 0.0;
  EXPECT_THROW(draw(plot, folder_, "figure"), InputError);
}

WorkPoint run_of(const std::string& contender, std::uint64_t steps, double error, double cost) {
  WorkPoint p;
  p.contender = contender;
  p.setting.steps = steps;
  p.errors.x = error;
  p.costs = {cost};
  p.cost = cost;
  return p;
}

TEST(WorkPrecisionPlot, AFailedRunStandsAtTheBorderWhereItWouldHaveEndedWithItsDiagnosis) {
  WorkPrecision study;
  study.scene = "scene";
  study.reference.floor = 1e-9;
  WorkPoint failed = run_of("verlet", 10, 0.0, 3.0);
  failed.code = "NONFINITE";
  study.points = {failed, run_of("verlet", 20, 1e-3, 40.0)};
  classify(study.points, study.reference.floor);
  const Plot plot = work_precision_plot(study);
  bool found = false;
  for (const PlotSeries& s : plot.series)
    for (const auto& p : s.points)
      if (p.label == "NONFINITE") {
        found = true;
        EXPECT_DOUBLE_EQ(p.x, 20.0);  // half the steps of the run that cost 40
        EXPECT_GT(p.y, 1.0);
        EXPECT_LT(p.y, plot.y_high);
      }
  EXPECT_TRUE(found);
}

TEST(WorkPrecisionPlot, LinearSolversOfOneIntegratorAreToldApart) {
  WorkPrecision study;
  study.points = {run_of("ros2", 20, 1e-3, 10.0), run_of("ros2, fresh factor", 20, 1e-3, 20.0),
                  run_of("ros2, conjugate gradients", 20, 1e-3, 30.0)};
  classify(study.points, 0.0);
  std::vector<std::pair<int, std::string>> looks;
  for (const PlotSeries& s : work_precision_plot(study).series)
    if (s.title.starts_with("ros2")) looks.emplace_back(s.symbol, s.dash);
  ASSERT_EQ(looks.size(), 3u);
  std::sort(looks.begin(), looks.end());
  EXPECT_EQ(std::unique(looks.begin(), looks.end()), looks.end());
}

TEST(WorkPrecisionPlot, TheFrontIsDrawnFromTheCheapestToTheDearest) {
  WorkPrecision study;
  study.points = {run_of("rk4", 20, 1e-6, 100.0), run_of("verlet", 20, 1e-2, 10.0), run_of("verlet", 80, 1e-3, 400.0)};
  classify(study.points, 0.0);
  const Plot plot = work_precision_plot(study);
  const auto front = std::find_if(plot.series.begin(), plot.series.end(),
                                  [](const PlotSeries& s) { return s.title == "Pareto front"; });
  ASSERT_NE(front, plot.series.end());
  ASSERT_EQ(front->points.size(), 2u);
  EXPECT_EQ(front->points[0].x, 10.0);
  EXPECT_EQ(front->points[1].x, 100.0);
  // what lies between two runs was not reached
  EXPECT_NE(plot_element(*front, "front").find("with steps"), std::string::npos);
}

}  // namespace
}  // namespace dartboard
