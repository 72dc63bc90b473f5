#include "benchmarks/figures/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"

namespace dartboard {

using Eigen::Vector2d;

Film::Film(const Simulation& simulation, std::uint64_t steps, const Eigen::Vector3d& up)
    : steps_(steps), up_(up), first_(panel_of(simulation)) {
  take(simulation);
}

void Film::stepped(const Simulation& simulation) {
  const std::uint64_t n = simulation.steps_done(), parts = std::min(steps_, most_frames);
  if (n * parts / steps_ > (n - 1) * parts / steps_) take(simulation);
}

void Film::ended(const Simulation& simulation) {
  while (frames_.size() > 1 && frames_.back().time > simulation.time()) frames_.pop_back();
  if (frames_.back().time < simulation.time()) take(simulation);
}

Frame Film::panel_of(const Simulation& simulation) const {
  const Frame frame = simulation.frame({});
  return upright(std::span(&frame, 1), up_)[0];
}

void Film::take(const Simulation& simulation) {
  const Frame panel = panel_of(simulation);
  frames_.push_back({panel.time, drawn_facets(panel, first_), seen_box(panel)});
}

std::string draw_film(std::span<const FilmFrame> frames, const std::string& title, const std::filesystem::path& folder,
                      const std::string& name, const std::string& gnuplot) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const FilmFrame& frame : frames) boxes.push_back(frame.box);
  const PictureArea area = picture_area(boxes, 0.25);
  const Vector2d& size = area.size;

  constexpr double widest = 640, highest = 560, above_and_below = 70;                         // [pixels]
  const double pixels = std::min(widest / size.x(), (highest - above_and_below) / size.y());  // per metre
  const int width = static_cast<int>(std::lround(std::max(320.0, pixels * size.x())));
  const int height = static_cast<int>(std::lround(pixels * size.y() + above_and_below));
  const double lasts = std::clamp(frames.back().time - frames.front().time, 4.0, 12.0);  // [s]
  const double hundredths = std::max(3.0, std::round(100.0 * lasts / static_cast<double>(frames.size())));

  std::string script = fmt::format(
      "set terminal gif animate delay {} loop 0 size {},{} font \"DejaVu Sans,12\" background rgb \"white\"\n"
      "set output {}\nset encoding utf8\nunset key\nunset border\nunset tics\nset margins 0,0,2,3\nset size ratio -1\n"
      "set title {} font \",14\" noenhanced\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n"
      "set style fill solid 1.0 noborder\n",
      hundredths, width, height, plot_source(name + ".gif"), quoted_title(title, width, 14.0, 1), -0.5 * size.x(),
      0.5 * size.x(), -0.5 * size.y(), 0.5 * size.y());
  DataBlocks data(name);
  for (const FilmFrame& frame : frames) {
    const std::string time = fmt::format("t = {:.3g} s{}", frame.time, frame.box.isEmpty() ? ", nothing left" : "");
    script += fmt::format("set label 1 {} at graph 0.5,character 1.2 center font \",12\"\n", gnuplot_string(time));
    const std::string polygons = polygons_of(frame.facets, -area.centre_of(frame.box), pixels);
    script += polygons.empty()
                  ? "plot NaN\n"
                  : fmt::format("plot {} using 1:2:3 with polygons fillcolor rgb variable\n", data.add(time, polygons));
  }
  write_plot_file(folder / data.file(), data.text());
  write_plot_file(folder / (name + ".gnuplot"), script + "unset output\n");
  std::string trouble = run_gnuplot(gnuplot, folder, name);
  if (trouble.empty()) {  // together these are ten times as large as the film
    std::error_code ignored;
    for (const std::string& used : {data.file(), name + ".gnuplot"}) std::filesystem::remove(folder / used, ignored);
  }
  return trouble;
}

}  // namespace dartboard
