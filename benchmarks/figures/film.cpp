#include "benchmarks/figures/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "benchmarks/figures/body_picture.h"
#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"

namespace dartboard {

using Eigen::Vector2d;

std::string draw_film(std::span<const BodyPanel> panels, const Look& look, const std::string& title,
                      const std::filesystem::path& folder, const std::string& name, const std::string& gnuplot) {
  const Drawing drawing = drawing_of(panels, look, 0.25);
  const Vector2d& size = drawing.area.size;

  constexpr double widest = 640, highest = 450;                           // [pixels]
  const double pixels = std::min(widest / size.x(), highest / size.y());  // per metre
  const int width = static_cast<int>(std::lround(std::max(320.0, pixels * size.x())));
  const Sheet sheet = sheet_of(drawing, look, title, pixels, width, 0.0, 15);
  const double lasts = std::clamp(panels.back().time - panels.front().time, 4.0, 12.0);  // [s]
  const double hundredths = std::max(3.0, std::round(100.0 * lasts / static_cast<double>(panels.size())));

  std::string script =
      fmt::format(
          "set terminal gif animate delay {} loop 0 size {},{} font \"DejaVu Sans,12\" background rgb \"white\"\n"
          "set output {}\n",
          hundredths, width, sheet.canvas.height, plot_source(name + ".gif")) +
      sheet.commands;
  DataBlocks data(name);
  for (const BodyPanel& panel : drawing.panels) {
    script += sheet.time_of(panel, 1, 0.0);
    const std::string polygons = polygons_of(panel.facets, -drawing.area.centre_of(panel.box), pixels);
    script += polygons.empty() ? "plot NaN\n"
                               : fmt::format("plot {} using 1:2:3 with polygons fillcolor rgb variable\n",
                                             data.add(fmt::format("{:.3g} s", panel.time), polygons));
  }
  write_plot_file(folder / data.file(), data.text());
  write_plot_file(folder / (name + ".gnuplot"), script + "unset output\n");
  std::string trouble = run_gnuplot(gnuplot, folder, name);
  if (trouble.empty()) remove_drawn(folder, name);  // together these are ten times as large as the film
  return trouble;
}

}  // namespace dartboard
