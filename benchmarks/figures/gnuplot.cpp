#include "benchmarks/figures/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "benchmarks/harness/processes.h"
#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr double paper_inches = 7.0;  // the width of a page's text

// "#rrggbb" and the opacity, as gnuplot's #aarrggbb, where 00 is solid.
std::string colour(const PlotSeries& series) {
  const int clear = static_cast<int>(std::lround(255.0 * (1.0 - series.opacity)));
  return fmt::format("\"#{:02x}{}\"", clear, series.colour.substr(1));
}

/// Does DejaVu Sans have it? Latin, Greek and Cyrillic letters, punctuation, arrows and mathematical signs.
bool is_in_font(std::uint32_t code) {
  return code <= 0x52f || (code >= 0x1e00 && code <= 0x1fff) || (code >= 0x2000 && code <= 0x22ff);
}

/// A line that is drawn: the PNG and the GIF would show a black box as high as the picture for a character that the
/// font lacks. The SVG has "?" too, since both pictures are drawn from one script and one file of data.
std::string drawn_text(std::string_view text) { return font_text(text, is_in_font); }

/// Length of a text in UTF-8.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string quoted_title(const std::string& text, int width, double font, int lines) {
  // DejaVu Sans: letters are 0.6 of the font wide on average, blanks included; a point is 4/3 pixels
  const auto most = static_cast<std::size_t>(std::max(20.0, 0.94 * width / (0.6 * font * 4.0 / 3.0)));
  std::vector<std::string> broken(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    word = shortened(drawn_text(word), most);
    std::string& line = broken.back();
    if (line.empty())
      line = word;
    else if (letters(line) + 1 + letters(word) <= most)
      line += " " + word;
    else if (broken.size() < static_cast<std::size_t>(lines))
      broken.push_back(word);
    else {
      // words are removed until the dots fit
      while (letters(line) + 4 > most && line.find(' ') != std::string::npos) line.erase(line.rfind(' '));
      line += " ...";
      break;
    }
  }
  std::string out;
  for (const std::string& line : broken) out += (out.empty() ? "" : " . \"\\n\" . ") + gnuplot_string(line);
  return out;
}

std::string data_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : drawn_text(text)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string plot_source(const std::string& file) { return gnuplot_string("./" + file); }

std::string DataBlocks::add(const std::string& what, const std::string& lines) {
  text_ += fmt::format("{}# {}\n{}", count_ == 0 ? "" : "\n\n", terminal_text(what), lines);
  return fmt::format("{} index {}", plot_source(file()), count_++);
}

std::string plot_element(const PlotSeries& s, const std::string& data) {
  const std::string title = s.title.empty() ? "notitle" : "title " + gnuplot_string(shortened(drawn_text(s.title), 80));
  std::string look = s.filled                        ? "filledcurves y1=0"
                     : s.staircase                   ? "steps"
                     : s.width > 0.0 && s.symbol > 0 ? "linespoints"
                     : s.width > 0.0                 ? "lines"
                                                     : "points";
  look += " linecolor rgb " + colour(s);
  if (s.width > 0.0 && !s.filled) look += fmt::format(" linewidth {:g}", s.width);
  if (!s.dash.empty()) look += fmt::format(" dashtype \"{}\"", s.dash);
  if (s.symbol > 0) look += fmt::format(" pointtype {} pointsize {:g}", s.symbol, s.size);
  std::string element = fmt::format("{} using 1:2 with {} {}", data, look, title);
  bool labelled = false;
  for (const auto& p : s.points) labelled |= !p.label.empty();
  if (labelled)
    element +=
        fmt::format(", \\\n     {} using 1:2:3 with labels {} left noenhanced font \",9\" textcolor rgb {} notitle",
                    data, s.slanted ? "rotate by 45 offset 0.3,0.5" : "offset 0.8,0", colour(s));
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
    // in that folder, as a path with a slash: a name then acts as no command, no option and no pipe
    run_program(
        gnuplot, {"./" + name + ".gnuplot"}, [&](std::string_view line) { said += fmt::format(" {}", line); },
        Stderr::as_output, folder);
  } catch (const ProcessError& error) {
    return fmt::format("no picture of {}: {}{}; its data and script are kept", name, error.what(), said);
  }
  return "";
}

std::vector<std::string> draw_for_paper(const std::filesystem::path& folder, const std::string& gnuplot) {
  const std::string added = "-paper";
  std::vector<std::filesystem::path> scripts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".gnuplot" && !entry.path().stem().string().ends_with(added))
      scripts.push_back(entry.path());
  std::ranges::sort(scripts);
  std::vector<std::string> troubles;
  for (const std::filesystem::path& script : scripts) {
    const std::string name = script.stem().string();
    const std::filesystem::path of = script.parent_path();
    std::ifstream in(script, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    // the PNG is drawn first
    text.erase(std::min(text.find("unset output\n"), text.size()));
    const std::regex png("set terminal pngcairo size (\\d+),(\\d+)[^\n]*\nset output [^\n]*\n");
    std::smatch size;
    if (!std::regex_search(text, size, png))
      throw IoError(fmt::format("{}: is no script of a diagram of this program", script.string()));
    const std::string pdf = fmt::format(
        "set terminal pdfcairo size {:g}in,{:.3g}in font \"DejaVu Sans,12\" fontscale 0.6 linewidth 0.6 pointscale 0.6\n"
        "set output {}\n",
        paper_inches, paper_inches * std::stod(size[2]) / std::stod(size[1]), plot_source(name + ".pdf"));
    write_plot_file(of / (name + added + ".gnuplot"), size.prefix().str() + pdf + size.suffix().str());
    if (const std::string trouble = run_gnuplot(gnuplot, of, name + added); !trouble.empty())
      troubles.push_back(trouble);
    else
      remove_drawn(of, name + added);
  }
  return troubles;
}

void remove_drawn(const std::filesystem::path& folder, const std::string& name) {
  std::error_code ignored;
  for (const char* end : {".dat", ".gnuplot"}) std::filesystem::remove(folder / (name + end), ignored);
}

std::string for_both_pictures(const std::string& commands, const std::string& name, int width, int height) {
  std::string script;
  for (const auto& [terminal, end] :
       {std::pair(png_terminal(width, height), "png"), {svg_terminal(width, height), "svg"}})
    script += fmt::format("set terminal {}\nset output {}\n{}\nunset output\n", terminal,
                          plot_source(fmt::format("{}.{}", name, end)), commands);
  return script;
}

std::string png_terminal(int width, int height) {
  return fmt::format("pngcairo size {},{} font \"DejaVu Sans,12\" background rgb \"white\"", width, height);
}

std::string svg_terminal(int width, int height) {
  return fmt::format("svg size {},{} font \"DejaVu Sans,12\" background rgb \"white\" enhanced", width, height);
}

}  // namespace dartboard
