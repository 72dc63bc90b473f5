#include "benchmarks/figures/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "benchmarks/figures/gnuplot.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::plot_test {
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

// kanji, an emoji, and letters and signs of the font's ranges
TEST(PlotText, DrawnNamesHaveAQuestionMarkForEachCharacterThatTheFontLacks) {
  const std::string name = "\xE8\x82\x9D\xE8\x87\x93 \xF0\x9F\x98\x80 \xC3\xA9\xD0\x94\xE1\xBC\x80\xE2\x89\xA4";
  const std::string drawn = "?? ? \xC3\xA9\xD0\x94\xE1\xBC\x80\xE2\x89\xA4";
  EXPECT_EQ(quoted_title(name, 400, 10.0), "'" + drawn + "'");
  EXPECT_EQ(data_string(name), '"' + drawn + '"');
  const PlotSeries series{.title = name, .points = {{1.0, 1.0}}, .colour = "#ff0000"};
  EXPECT_NE(plot_element(series, "x").find("title '" + drawn + "'"), std::string::npos);
}

TEST(PlotText, FilesKeepTheirNamesWhateverTheFont) {
  EXPECT_EQ(plot_source("\xE8\x82\x9D.dat"), "'./\xE8\x82\x9D.dat'");
}

// A line of letters that just fits into the picture is broken if a legend takes a part of the width.
TEST(PlotText, TitlesAreCentredBesideTheLegend) {
  Plot plot = small_plot();
  plot.series.resize(1);
  plot.series[0].title.clear();
  plot.title.clear();
  for (int k = 0; k < 10; ++k) plot.title += k == 0 ? "ten letter" : " ten letter";
  const std::string one_line = "set title '" + plot.title + "' font";
  EXPECT_NE(plot_script(plot, "figure").find(one_line), std::string::npos);
  // sixty letters of 9 pixels and the symbols next to them leave 800 of 1400: 62 letters of 12 pixels
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

TEST_F(PlotTest, EveryDiagramOfAFolderIsDrawnForAPaperAsWideAsItsText) {
  fs::create_directory(folder_ / "part");
  ASSERT_EQ(draw(small_plot(), folder_ / "part", "figure"), "");
  ASSERT_TRUE(draw_for_paper(folder_).empty());
  const std::string pdf = text("part/figure.pdf");
  ASSERT_EQ(pdf.substr(0, 5), "%PDF-");
  // 7 inches of 72 points, and 900 pixels to 1400
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 504 324 ]"), std::string::npos) << pdf;
  EXPECT_FALSE(fs::exists(folder_ / "part" / "figure-paper.gnuplot"));
  std::ofstream(folder_ / "other.gnuplot") << "print 1\n";
  EXPECT_THROW(draw_for_paper(folder_), IoError);
}

TEST_F(PlotTest, AnAxisThatHasNoLogarithmIsRefused) {
  Plot plot = small_plot();
  plot.x_low = 0.0;
  EXPECT_THROW(draw(plot, folder_, "figure"), InputError);
}

// One decade from tick to tick, and two if there are more than nine; no tick above the last one, which has a line.
TEST(PlotText, TicksEndAtTheLastOne) {
  Plot plot = small_plot();
  plot.y_low = 2e-5;
  plot.y_high = 1e3;
  plot.y_last_tick = 1.0;
  const std::string script = plot_script(plot, "figure");
  const auto at = script.find("set ytics ");
  ASSERT_NE(at, std::string::npos);
  double first = 0.0, factor = 0.0, last = 0.0;
  ASSERT_EQ(std::sscanf(script.c_str() + at, "set ytics %lg,%lg,%lg", &first, &factor, &last), 3);
  EXPECT_DOUBLE_EQ(first, 1e-4);
  EXPECT_EQ(factor, 10.0);
  EXPECT_EQ(last, 1.0);
  EXPECT_NE(script.find("from graph 0, first 1 to graph 1, first 1"), std::string::npos);
  plot.y_low = 2e-12;
  EXPECT_NE(plot_script(plot, "figure").find(",100,1\nset mytics 2\n"), std::string::npos);
}

}  // namespace
}  // namespace dartboard::plot_test
