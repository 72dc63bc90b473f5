#include "benchmarks/gnuplot.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string_view>

#include "benchmarks/processes.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

// "#rrggbb" and how much of it shows, as gnuplot's #aarrggbb, where 00 is solid.
std::string colour(const PlotSeries& series) {
  const int clear = static_cast<int>(std::lround(255.0 * (1.0 - series.opacity)));
  return fmt::format("\"#{:02x}{}\"", clear, series.colour.substr(1));
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

std::string plot_element(const PlotSeries& s, const std::string& data_file) {
  const std::string file = quoted(data_file);
  const std::string title = s.title.empty() ? "notitle" : "title " + quoted(s.title);
  std::string look = s.width > 0.0 && s.symbol > 0 ? "linespoints" : s.width > 0.0 ? "lines" : "points";
  look += " linecolor rgb " + colour(s);
  if (s.width > 0.0) look += fmt::format(" linewidth {:g}", s.width);
  if (!s.dash.empty()) look += fmt::format(" dashtype \"{}\"", s.dash);
  if (s.symbol > 0) look += fmt::format(" pointtype {} pointsize {:g}", s.symbol, s.size);
  std::string element = fmt::format("{} using 1:2 with {} {}", file, look, title);
  bool labelled = false;
  for (const auto& p : s.points) labelled |= !p.label.empty();
  if (labelled)
    element +=
        fmt::format(", \\\n     {} using 1:2:3 with labels {} left noenhanced font \",9\" textcolor rgb {} notitle",
                    file, s.slanted ? "rotate by 45 offset 0.3,0.5" : "offset 0.8,0", colour(s));
  return element;
}

void write_plot_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) throw IoError(fmt::format("{}: cannot be written", file.string()));
}

std::string run_gnuplot(const std::string& gnuplot, const std::filesystem::path& folder, const std::string& name) {
  std::string said;
  try {
    run_program(gnuplot, {"-e", fmt::format("cd {}", quoted(folder.string())), name + ".gnuplot"},
                [&](std::string_view line) { said += fmt::format(" {}", line); });
  } catch (const ProcessError& error) {
    return fmt::format("no picture of {}: {}{}; its data and script are kept", name, error.what(), said);
  }
  return "";
}

std::string for_both_pictures(const std::string& commands, const std::string& name, int width, int height) {
  std::string script;
  for (const auto& [terminal, end] :
       {std::pair(png_terminal(width, height), "png"), {svg_terminal(width, height), "svg"}})
    script += fmt::format("set terminal {}\nset output {}\n{}\nunset output\n", terminal,
                          quoted(fmt::format("{}.{}", name, end)), commands);
  return script;
}

std::string png_terminal(int width, int height) {
  return fmt::format("pngcairo size {},{} font \"DejaVu Sans,12\" background rgb \"white\"", width, height);
}

std::string svg_terminal(int width, int height) {
  return fmt::format("svg size {},{} font \"DejaVu Sans,12\" background rgb \"white\" enhanced", width, height);
}

}  // namespace dartboard
