#include "benchmarks/figures/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr double title_font = 15.0;

/// Where the title is centred: the picture without its legend [pixels].
int plot_width(const Plot& plot) {
  std::size_t longest = 0;
  for (const PlotSeries& s : plot.series) longest = std::max(longest, s.title.size());
  return plot.width - (longest == 0 ? 0 : 60 + 9 * static_cast<int>(std::min<std::size_t>(longest, 80)));
}

struct Drawing {
  DataBlocks data;
  std::string lines;  // of the command that plots them
};

Drawing drawing_of(const Plot& plot, const std::string& name) {
  Drawing drawing{DataBlocks(name), ""};
  for (const PlotSeries& s : plot.series) {
    if (s.points.empty()) continue;
    drawing.lines += (drawing.lines.empty() ? "plot " : ", \\\n     ") +
                     plot_element(s, drawing.data.add(s.title.empty() ? "without a name" : s.title, plot_data(s)));
  }
  if (drawing.lines.empty()) drawing.lines = "plot NaN notitle";
  return drawing;
}

}  // namespace

std::string plot_data(const PlotSeries& series) {
  std::string text;
  for (const auto& p : series.points) text += fmt::format("{:.17g} {:.17g} {}\n", p.x, p.y, data_string(p.label));
  return text;
}

std::string plot_script(const Plot& plot, const std::string& name) {
  std::string script = fmt::format(
      "set encoding utf8\n"
      "set logscale xy\n"
      "set format x \"10^{{%T}}\"\nset format y \"10^{{%T}}\"\n"
      "set xrange [{:.17g}:{:.17g}]\nset yrange [{:.17g}:{:.17g}]\n"
      "set title {} font \",{:g}\" noenhanced offset 0,0.3\n"
      "set xlabel {} font \",14\" noenhanced\nset ylabel {} font \",14\" noenhanced offset -0.5,0\n"
      "set tics out nomirror\nset border 3 linewidth 1.2 linecolor rgb \"#404040\"\n"
      "set mxtics 10\nset mytics 10\n"
      "set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb \"#e4e4e4\"\n"
      "set key outside right top vertical Left reverse noenhanced samplen 2.2 spacing 1.25 font \",12\"\n"
      "set datafile separator whitespace\n",
      plot.x_low, plot.x_high, plot.y_low, plot.y_high,
      quoted_title(plot.title + (plot.subtitle.empty() ? "" : " - " + plot.subtitle), plot_width(plot), title_font),
      title_font, gnuplot_string(plot.x_axis), gnuplot_string(plot.y_axis));
  if (!plot.rows.empty()) {
    std::string names;
    for (std::size_t k = 0; k < plot.rows.size(); ++k)
      names += fmt::format("{}{} {}", k == 0 ? "" : ", ", gnuplot_string(plot.rows[k]), k + 1);
    script += fmt::format(
        "unset logscale y\nunset mytics\nset ytics ({}) noenhanced\nset format x \"%g\"\nunset mxtics\n"
        "set xtics (0.1, 0.2, 0.5, 0.8, 0.9, 1, 1.1, 1.25, 1.5, 2, 3, 5, 10, 20, 50, 100)\n",
        names);
  }
  if (plot.y_last_tick > 0.0) {
    // every decade, every second one where there are many
    const double decades = std::log10(plot.y_last_tick / plot.y_low);
    script +=
        fmt::format("set ytics {:.17g},{},{:.17g}\nset mytics {}\n", std::pow(10.0, std::ceil(std::log10(plot.y_low))),
                    decades > 9.0 ? 100 : 10, plot.y_last_tick, decades > 9.0 ? 2 : 10);
    script += fmt::format(
        "set arrow 1 from graph 0, first {0:.17g} to graph 1, first {0:.17g} nohead linewidth 0.8 dashtype \"-\" "
        "linecolor rgb \"#a0a0a0\"\n",
        plot.y_last_tick);
  }
  if (plot.shaded_below > plot.y_low) {
    script += fmt::format(
        "set object 1 rectangle from graph 0, graph 0 to graph 1, first {:.17g} behind fillcolor rgb \"#f0f0f0\" "
        "fillstyle solid noborder\n",
        plot.shaded_below);
    script += fmt::format(
        "set label 1 {} at graph 0.01, graph 0.02 noenhanced textcolor rgb \"#707070\" font \",11\" front\n",
        gnuplot_string(plot.shaded_label));
  }
  return script + for_both_pictures(drawing_of(plot, name).lines, name, plot.width, plot.height);
}

std::string draw(const Plot& plot, const std::filesystem::path& folder, const std::string& name,
                 const std::string& gnuplot) {
  if (!(plot.x_low > 0.0 && plot.x_low < plot.x_high && plot.y_low > 0.0 && plot.y_low < plot.y_high))
    throw InputError("a logarithmic axis must be positive and ascending");
  const DataBlocks data = drawing_of(plot, name).data;
  write_plot_file(folder / data.file(), data.text());
  // the script names its files without a folder, so that they can be moved together
  write_plot_file(folder / (name + ".gnuplot"), plot_script(plot, name));
  return run_gnuplot(gnuplot, folder, name);
}

}  // namespace dartboard
