#include "benchmarks/figures/panels.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

std::string field_data(const Panels& panels, const Field& field) {
  std::string text;
  for (std::size_t y = 0; y < field.y.size(); ++y)
    for (std::size_t x = 0; x < field.x.size(); ++x)
      text += fmt::format("{:.6g} {:.6g} {:.6g}\n", field.x[x], field.y[y],
                          std::clamp(field.values[y * field.x.size() + x], panels.field_low, panels.field_high));
  return text;
}

std::string axis(char which, bool logarithmic, double low, double high, const std::string& label) {
  return fmt::format(
      "{0} logscale {1}\nset format {1} \"{2}\"\nset {1}range [{3:.17g}:{4:.17g}]\nset {1}label {5} noenhanced\n",
      logarithmic ? "set" : "unset", which, logarithmic ? "10^{%T}" : "%g", low, high, gnuplot_string(label));
}

std::string panel_script(const Panels& panels, std::size_t k, DataBlocks& data) {
  const Panel& panel = panels.panels[k];
  std::string script =
      fmt::format("set title {} noenhanced font \",13\" offset 0,-0.5\n", gnuplot_string(panel.title)) +
      axis('x', panel.x_log, panel.x_low, panel.x_high, panel.x_axis) +
      axis('y', panel.y_log, panel.y_low, panel.y_high, panel.y_axis) + "set xtics autofreq\nset ytics autofreq\n";
  if (!panel.y_ticks.empty()) {
    std::string ticks;
    for (const Tick& t : panel.y_ticks)
      ticks += fmt::format("{}{} {:.17g}", ticks.empty() ? "" : ", ", gnuplot_string(t.label), t.at);
    script += fmt::format("set ytics ({})\n", ticks);
  }
  script += panel.key.empty() ? "unset key\n"
                              : fmt::format("set key {} Left reverse noenhanced samplen 1.5 font \",11\"\n", panel.key);
  std::string lines;
  const auto add = [&lines](const std::string& element) {
    lines += (lines.empty() ? "plot " : ", \\\n     ") + element;
  };
  if (!panel.field.values.empty())
    add(fmt::format("{} using 1:2:3 with image notitle",
                    data.add(panel.title + ": the field", field_data(panels, panel.field))));
  for (const PlotSeries& s : panel.series)
    if (!s.points.empty()) add(plot_element(s, data.add(fmt::format("{}: {}", panel.title, s.title), plot_data(s))));
  return script + (lines.empty() ? "plot NaN notitle" : lines) + "\n";
}

void check(const Panel& panel) {
  if (!(panel.x_low < panel.x_high && panel.y_low < panel.y_high) || (panel.x_log && !(panel.x_low > 0.0)) ||
      (panel.y_log && !(panel.y_low > 0.0)))
    throw InputError(fmt::format("the axes of panel '{}' must ascend, logarithmic ones from above 0", panel.title));
  if (panel.field.values.size() != panel.field.x.size() * panel.field.y.size())
    throw InputError(fmt::format("the field of panel '{}' has {} values for {} x {} points", panel.title,
                                 panel.field.values.size(), panel.field.x.size(), panel.field.y.size()));
}

}  // namespace

std::string panels_script(const Panels& panels, const std::string& name) {
  const auto count = static_cast<int>(panels.panels.size());
  const int rows = std::max(1, (count + panels.columns - 1) / panels.columns);
  bool fields = false;
  for (const Panel& p : panels.panels) fields |= !p.field.values.empty();
  std::string script = fmt::format(
      "set encoding utf8\nset datafile separator whitespace\n"
      "set tics out nomirror font \",11\"\nset border 3 linewidth 1.2 linecolor rgb \"#404040\"\n"
      "set xlabel font \",12\"\nset ylabel font \",12\"\n"
      "set palette defined (0 \"#2166ac\", 0.25 \"#92c5de\", 0.5 \"#f7f7f7\", 0.75 \"#f4a582\", 1 \"#b2182b\")\n"
      "set cbrange [{:.17g}:{:.17g}]\nset cblabel {} noenhanced font \",12\"\n",
      panels.field_low, panels.field_high, gnuplot_string(panels.field_label));
  script += fields ? "set colorbox user origin 0.945,0.2 size 0.012,0.6\n" : "unset colorbox\n";
  for (const auto& [terminal, end] : {std::pair(png_terminal(panels.width, panels.height), "png"),
                                      {svg_terminal(panels.width, panels.height), "svg"}}) {
    script += fmt::format(
        "set terminal {}\nset output {}\n"
        "set multiplot layout {},{} rowsfirst margins 0.055,{},{:.4g},{:.4g} spacing 0.055,{:.4g} title {} noenhanced "
        "font \",17\"\n",
        terminal, plot_source(fmt::format("{}.{}", name, end)), rows, panels.columns, fields ? 0.925 : 0.985,
        (panels.between - 55.0) / panels.height, 1.0 - 100.0 / panels.height, 1.0 * panels.between / panels.height,
        quoted_title(panels.title, panels.width, 17.0, 1));
    DataBlocks data(name);
    for (std::size_t k = 0; k < panels.panels.size(); ++k) script += panel_script(panels, k, data);
    script += "unset multiplot\nunset output\n";
  }
  return script;
}

std::string draw(const Panels& panels, const std::filesystem::path& folder, const std::string& name,
                 const std::string& gnuplot) {
  DataBlocks data(name);
  for (std::size_t k = 0; k < panels.panels.size(); ++k) {
    check(panels.panels[k]);
    panel_script(panels, k, data);
  }
  write_plot_file(folder / data.file(), data.text());
  // the script names its files without a folder, so that they can be moved together
  write_plot_file(folder / (name + ".gnuplot"), panels_script(panels, name));
  return run_gnuplot(gnuplot, folder, name);
}

}  // namespace dartboard
