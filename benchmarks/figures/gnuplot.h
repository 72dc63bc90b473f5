#pragma once
// gnuplot as a child process, and text that its scripts have in common.

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"

namespace dartboard {

/// A label in a data file, where gnuplot runs nothing and treats only double quotes specially; "?" stands for each
/// character that the font of the pictures lacks, here and in titles.
std::string data_string(const std::string& text);

/// A file in the folder that the script runs in, as a script names it; never a pipe, which gnuplot would open for a
/// name that begins with "<" or "|".
std::string plot_source(const std::string& file);

/// The title of a picture of that width [pixels] and font [points], as an expression of gnuplot: broken between words
/// into at most `lines` lines, shortened with "..." if it is longer.
std::string quoted_title(const std::string& text, int width, double font, int lines = 3);

/// ... using 1:2 with ...: a series drawn from its data ("figure.dat" index 3), with its labels if it has some.
std::string plot_element(const PlotSeries& series, const std::string& data);

/// All data of one picture in one file next to it: blocks, which gnuplot refers to by their index.
class DataBlocks {
 public:
  explicit DataBlocks(const std::string& name) : name_(name) {}
  /// Adds another block under a comment: lines of numbers, without an empty one.
  ///
  /// returns the expression by which a script refers to it
  std::string add(const std::string& what, const std::string& lines);
  const std::string& text() const { return text_; }
  std::string file() const { return name_ + ".dat"; }

 private:
  std::string name_, text_;
  int count_ = 0;
};

/// throws  IoError if it cannot be written
void write_plot_file(const std::filesystem::path& file, const std::string& text);

/// Run the script "`name`.gnuplot" that lies in `folder`.
///
/// returns what went wrong, in a sentence; empty when all is well
std::string run_gnuplot(const std::string& gnuplot, const std::filesystem::path& folder, const std::string& name);

/// Draws every diagram whose script and data lie in a folder as `name`.pdf, too: as wide as the text of a page, with
/// letters of some 7 points.
///
/// returns what went wrong, in sentences; empty when all is well
/// throws  IoError where a script cannot be read or written
std::vector<std::string> draw_for_paper(const std::filesystem::path& folder, const std::string& gnuplot = "gnuplot");

/// Remove the data and the script of a picture, where these can be had again.
void remove_drawn(const std::filesystem::path& folder, const std::string& name);

/// The commands, which plot, once for `name`.png and once for `name`.svg.
std::string for_both_pictures(const std::string& commands, const std::string& name, int width, int height);
/// "set terminal ..." for a PNG or an SVG of this size.
std::string png_terminal(int width, int height);
std::string svg_terminal(int width, int height);

}  // namespace dartboard
