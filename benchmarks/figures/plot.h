#pragma once
// Diagrams on logarithmic axes, drawn by gnuplot from files that stay next to the picture.

#include <filesystem>
#include <string>
#include <vector>

namespace dartboard {

/// A set of points of one look.
struct PlotSeries {
  std::string title;  // in the legend; empty: not in it
  struct Point {
    double x, y;
    std::string label{};  // next to the point
  };
  std::vector<Point> points;
  std::string colour;  // "#rrggbb"
  int symbol = 7;      // gnuplot's number of the point type; 0: none
  double size = 1.0;   // of the symbols
  double width = 0.0;  // of a line through the points in their order; 0: none
  std::string dash{};  // "-", ".": gnuplot's dash type; empty: solid
  double opacity = 1.0;
  bool slanted = false;    // labels, above and at 45 degrees
  bool staircase = false;  // a line that keeps the y of a point up to the x of the next
  bool filled = false;     // an area between the points and y = 0
};

struct Plot {
  std::string title, subtitle, x_axis, y_axis;
  double x_low = 1.0, x_high = 10.0, y_low = 1.0, y_high = 10.0;
  std::vector<PlotSeries> series;  // drawn in this order
  double y_last_tick = 0.0;        // the last tick on the y axis; 0: ticks everywhere
  double shaded_below = 0.0;       // y below this is shaded; 0: nothing is
  std::string shaded_label{};
  // Names in place of the numbers 1, 2 ... up the y axis, whose steps are then even; along x plain numbers, for ratios.
  std::vector<std::string> rows{};
  int width = 1400, height = 900;  // pixels of the PNG
};

/// gnuplot's script; the data of the series that have points are the blocks of "`name`.dat", in their order. Two
/// pictures: `name`.svg and `name`.png.
std::string plot_script(const Plot& plot, const std::string& name);
/// The data of a series: x, y and label, one point a line.
std::string plot_data(const PlotSeries& series);

/// Write the data into a file of `folder` and draw the pictures.
///
/// returns what went wrong, in a sentence, when gnuplot is missing or fails: data and script are kept then; empty when
///         all is well
/// throws  IoError when the files cannot be written; InputError for an axis that is not positive and ascending
std::string draw(const Plot& plot, const std::filesystem::path& folder, const std::string& name,
                 const std::string& gnuplot = "gnuplot");

}  // namespace dartboard
