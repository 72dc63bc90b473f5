#pragma once
// Small multiples: several panels in one picture, each with curves and, if wanted, a field of colours behind them.

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"

namespace dartboard {

/// A colour at every point of a grid.
struct Field {
  std::vector<double> x{}, y{};  // each ascending by equal distances
  std::vector<double> values{};  // a row per y
};

struct Tick {
  double at;
  std::string label;
};

struct Panel {
  std::string title{}, x_axis{}, y_axis{};
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
  bool x_log = false, y_log = false;
  std::vector<Tick> y_ticks{};  // empty: gnuplot's
  Field field{};                // on linear axes only
  std::vector<PlotSeries> series{};
  std::string key{};  // gnuplot's place of the legend: "bottom left"; empty: none
};

/// Values of fields from `field_low` to `field_high` go from blue through white to red; values beyond have the colour
/// of that end.
struct Panels {
  std::string title;
  int columns = 2;
  std::vector<Panel> panels;
  double field_low = -1.0, field_high = 1.0;
  std::string field_label;
  int width = 1800, height = 1000;  // pixels of the PNG
  int between = 130;                // of them, between rows
};

/// gnuplot's script for `name`.svg and `name`.png; the data of the panels are the blocks of
/// "`name`.dat", of each the field and then its series.
std::string panels_script(const Panels& panels, const std::string& name);

/// As `draw` of a plot.
///
/// throws  IoError when files cannot be written; InputError for an axis that does not ascend, a logarithmic one that is
///         not positive, or a field of another size than its grid
std::string draw(const Panels& panels, const std::filesystem::path& folder, const std::string& name,
                 const std::string& gnuplot = "gnuplot");

}  // namespace dartboard
