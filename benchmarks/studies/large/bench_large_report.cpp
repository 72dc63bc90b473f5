#include "benchmarks/studies/large/bench_large_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "benchmarks/harness/statistics.h"

namespace dartboard {
namespace {

using namespace large_part;

constexpr double most_until_first_step = 5.0, most_for_info = 4.0;       // [s]
constexpr double most_bytes = 300.0, most_bytes_without_events = 190.0;  // of a tetrahedron

std::vector<double> values_of(const LargeFigures& f, std::size_t side, const char* part,
                              const std::function<double(const LargeTime&)>& value) {
  std::vector<double> values;
  for (const LargeTime& time : f.times)
    if (time.side == side && time.part == part) values.push_back(value(time));
  return values;
}

double median_of(const LargeFigures& f, std::size_t side, const char* part, double LargeTime::*member) {
  return median(values_of(f, side, part, [member](const LargeTime& time) { return time.*member; }));
}

double of_tetrahedron(double sum, std::size_t side) { return sum / static_cast<double>(tetrahedra_of(side)); }

/// As many faces as lie in the middle plane, two to each square, come apart, and nothing else changes.
bool is_cut_rightly(const LargeCounts& c) {
  return c.operations == 2 * c.side * c.side && c.components == 2 && c.keeps_mass && c.violation.empty();
}

Claim claim_on_cuts(const LargeFigures& f) {
  Claim made = target("large-cut",
                      "a planar cut in mid-run separates a box into two, along as many faces as the plane has, on a "
                      "valid map, and keeps the mass to the bit",
                      "0 differ");
  const auto wrong = std::ranges::count_if(f.counts, std::not_fn(is_cut_rightly));
  made.measured = fmt::format("{} differ", wrong);
  std::size_t most = 0;
  for (const LargeCounts& c : f.counts) most = std::max(most, tetrahedra_of(c.side));
  made.bound_or_interval = fmt::format("of {} runs of up to {} tetrahedra", f.counts.size(), most);
  judge(made, met(wrong == 0 && !f.counts.empty()));
  return made;
}

Claim claim_on_bytes(const LargeFigures& f, const char* id, const char* text, std::size_t LargeCounts::*bytes,
                     double most) {
  Claim made = target(id, text, fmt::format("<= {:g} a tetrahedron", most));
  double largest = 0.0;
  for (const LargeCounts& c : f.counts)
    largest = std::max(largest, of_tetrahedron(static_cast<double>(c.*bytes), c.side));
  made.measured = fmt::format("{:.0f}", largest);
  made.bound_or_interval = "exact, the largest of all bodies";
  judge(made, met(largest <= most && !f.counts.empty()));
  return made;
}

Claim claim_on_time(const LargeFigures& f, const char* id, const char* text, const char* part, double most,
                    const char* cause) {
  Claim made = target(id, fmt::format("{}, of {} tetrahedra", text, tetrahedra_of(started_side)),
                      fmt::format("<= {:g} s", most));
  if (!f.has(started_side, part)) {
    made.reason = too_quick;
    return made;
  }
  const Figure seconds = f.seconds(started_side, part);
  made.measured = fmt::format("{:.2f} s", seconds.median);
  made.bound_or_interval = to_string(seconds.interval);
  judge(made, at_most(seconds, most), cause);
  return made;
}

}  // namespace

std::vector<std::size_t> large_sides(bool quick) {
  if (quick) return {26};
  return {26, 55, started_side, largest_side};
}

bool LargeFigures::has(std::size_t side, const char* part) const {
  return std::ranges::any_of(times, [&](const LargeTime& time) { return time.side == side && time.part == part; });
}

Figure LargeFigures::seconds(std::size_t side, const char* part) const {
  return figure_of(values_of(*this, side, part, [](const LargeTime& time) { return time.seconds; }));
}

Figure LargeFigures::over_limit(std::size_t side, const char* part) const {
  return figure_of(
      values_of(*this, side, part, [](const LargeTime& time) { return time.seconds / time.limit_seconds; }));
}

std::vector<Claim> claims_of(const LargeFigures& f) {
  return {
      claim_on_cuts(f),
      claim_on_bytes(f, "large-bytes", "bytes of a run of springs on a map with all its views, as 'explain' lists them",
                     &LargeCounts::bytes, most_bytes),
      claim_on_bytes(f, "large-bytes-without-events", "the same without events", &LargeCounts::bytes_without_events,
                     most_bytes_without_events),
      claim_on_time(f, "large-first-step", "from the start of a run to its first step", first_step,
                    most_until_first_step,
                    "darts, cells and points lead from one to the other, and each of these reads waits for memory"),
      claim_on_time(f, "large-info", "mesh info of a frame", info, most_for_info,
                    "it checks all of the file, and builds a map of it")};
}

Table parts_table(const LargeFigures& f) {
  Table table({{"part"},
               {"tetrahedra", Align::right},
               {"seconds", Align::right},
               {"interval", Align::right},
               {"ns of a tetrahedron", Align::right},
               {"bytes of a tetrahedron", Align::right},
               {"over its limit", Align::right}});
  for (const char* part : large_parts())
    for (const std::size_t side : f.sides) {
      if (!f.has(side, part)) continue;
      const Figure seconds = f.seconds(side, part);
      const double bytes = median_of(f, side, part, &LargeTime::bytes);
      const bool limited = median_of(f, side, part, &LargeTime::limit_seconds) > 0.0;
      const bool once = values_of(f, side, part, [](const LargeTime& time) { return time.seconds; }).size() == 1;
      table.add_row({part, std::to_string(tetrahedra_of(side)), fmt::format("{:.3g}", seconds.median),
                     once ? "one run" : to_string(seconds.interval),
                     fmt::format("{:.1f}", of_tetrahedron(seconds.median * 1e9, side)),
                     bytes > 0.0 ? fmt::format("{:.1f}", of_tetrahedron(bytes, side)) : "",
                     limited ? fmt::format("{:.2f}", f.over_limit(side, part).median) : ""});
    }
  return table;
}

Table memory_table(const LargeFigures& f) {
  Table table({{"tetrahedra", Align::right},
               {"vertices", Align::right},
               {"springs", Align::right},
               {"faces cut", Align::right},
               {"us of a face", Align::right},
               {"bytes of a tetrahedron", Align::right},
               {"without events", Align::right},
               {"process at most, MB", Align::right},
               {"bytes of a tetrahedron", Align::right}});
  for (const std::size_t side : f.sides) {
    std::vector<double> peaks;
    const LargeCounts* last = nullptr;
    for (const LargeCounts& c : f.counts)
      if (c.side == side) {
        peaks.push_back(static_cast<double>(c.peak_bytes));
        last = &c;
      }
    if (last == nullptr || !f.has(side, cut)) continue;
    const auto bytes = [&](double count) { return fmt::format("{:.0f}", of_tetrahedron(count, side)); };
    table.add_row({std::to_string(tetrahedra_of(side)), std::to_string(last->vertices), std::to_string(last->springs),
                   std::to_string(last->operations),
                   fmt::format("{:.2f}", f.seconds(side, cut).median * 1e6 / static_cast<double>(last->operations)),
                   bytes(static_cast<double>(last->bytes)), bytes(static_cast<double>(last->bytes_without_events)),
                   fmt::format("{:.0f}", median(peaks) / 1e6), bytes(median(peaks))});
  }
  return table;
}

std::string large_note() {
  return fmt::format(
      "Boxes of cubes of six tetrahedra, springs with damping by the classical Runge-Kutta method on one thread; the "
      "cut is followed by all views, and its parts are found. Seconds are the clock's, medians over "
      "processes; of {} tetrahedra there is one run. The limit of what leaves data in memory is the time to copy as many "
      "bytes; of frames, the time to write or read a file of as many. 'From the start to the first step' is a run "
      "with its files, by all processors: the first frame is written meanwhile. The memory of a process is that until "
      "the simulation is made; bytes 'of a tetrahedron' before it are those of the elements of all containers, as "
      "'explain' lists them.",
      tetrahedra_of(largest_side));
}

Plot large_plot(const LargeFigures& f) {
  Plot plot;
  plot.title = "Parts of a run of a large body";
  plot.x_axis = "tetrahedra";
  plot.y_axis = "ns of a tetrahedron";
  double low = INFINITY, high = 0.0;
  const auto add = [&](PlotSeries series, const char* part, double LargeTime::*member) {
    for (const std::size_t side : f.sides) {
      if (!f.has(side, part)) continue;
      const double ns = of_tetrahedron(median_of(f, side, part, member) * 1e9, side);
      series.points.push_back({static_cast<double>(tetrahedra_of(side)), ns});
      low = std::min(low, ns);
      high = std::max(high, ns);
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  };
  const std::pair<const char*, const char*> shown[]{{simulation, "#1f77b4"}, {map, "#ff7f0e"},     {columns, "#9467bd"},
                                                    {info, "#8c564b"},       {written, "#2ca02c"}, {read, "#d62728"},
                                                    {frame, "#17becf"},      {step, "#7f7f7f"}};
  for (const auto& [part, colour] : shown)
    add({.title = part, .points = {}, .colour = colour, .size = 1.5, .width = 1.5}, part, &LargeTime::seconds);
  add({.title = "limit: copying as many bytes as the simulation has",
       .points = {},
       .colour = "#404040",
       .symbol = 0,
       .width = 3.0,
       .dash = "-"},
      simulation, &LargeTime::limit_seconds);
  if (plot.series.empty()) return plot;
  plot.x_low = 0.6 * static_cast<double>(tetrahedra_of(f.sides.front()));
  plot.x_high = 1.7 * static_cast<double>(tetrahedra_of(f.sides.back()));
  plot.y_low = 0.6 * low;
  plot.y_high = 3.0 * high;
  return plot;
}

}  // namespace dartboard
