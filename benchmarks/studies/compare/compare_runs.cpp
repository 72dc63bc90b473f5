#include "benchmarks/studies/compare/compare_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/report/findings.h"
#include "benchmarks/studies/compare/compared_motion.h"
#include "core/base/counted.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr std::size_t rows_of_motion = 12;
constexpr std::array thresholds{0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-2, 1e-1, 1.0};  // [edges]

bool is_run_of_scene(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::exists(folder / "summary.json", error);
}

Table motion_table(const ComparedMotion& motion) {
  Table table({{"time [s]", Align::right},
               {"largest [edges]", Align::right},
               {"root mean square", Align::right},
               {"vertex", Align::right}});
  const std::size_t count = motion.distances.size(), rows = std::min(count, rows_of_motion);
  for (std::size_t k = 0; k < rows; ++k) {
    const FrameDistance& d = motion.distances[rows < 2 ? k : k * (count - 1) / (rows - 1)];
    table.add_row({fmt::format("{:.6g}", d.time), fmt::format("{:.3g}", d.largest),
                   fmt::format("{:.3g}", d.root_mean_square), d.largest > 0.0 ? std::to_string(d.vertex) : "-"});
  }
  return table;
}

Table parting_table(const ComparedMotion& motion) {
  Table table({{"further apart than [edges]", Align::right}, {"from [s]", Align::right}});
  for (const double edges : thresholds)
    if (const auto from = motion.further_than(edges))
      table.add_row({fmt::format("{:g}", edges), fmt::format("{:.6g}", *from)});
  return table;
}

Table column_table(const std::vector<ComparedColumn>& columns) {
  Table table({{"column"},
               {"largest difference", Align::right},
               {"at [s]", Align::right},
               {"of the largest value", Align::right}});
  for (const ComparedColumn& c : columns)
    table.add_row({fmt::format("{}: {}", c.file, c.name), fmt::format("{:.3g}", c.largest), fmt::format("{:.6g}", c.at),
                   c.scale > 0.0 ? fmt::format("{:.2g}", c.largest / c.scale) : "-"});
  return table;
}

/// The distance over time.
Panels motion_panels(const ComparedMotion& motion) {
  PlotSeries largest{.title = "largest", .points = {}, .colour = "#b2182b", .symbol = 0, .width = 2.0},
      mean{.title = "root mean square", .points = {}, .colour = "#2166ac", .symbol = 0, .width = 2.0, .dash = "-"};
  double low = motion.furthest()->largest;
  const double high = low;
  for (const FrameDistance& d : motion.distances) {
    if (d.root_mean_square <= 0.0) continue;  // the axis is logarithmic
    largest.points.push_back({d.time, d.largest});
    mean.points.push_back({d.time, d.root_mean_square});
    low = std::min(low, d.root_mean_square);
  }
  return {.title = "Distance of two runs",
          .columns = 1,
          .panels = {{.x_axis = "time [s]",
                      .y_axis = "distance [edges]",
                      .x_low = motion.distances.front().time,
                      .x_high = motion.distances.back().time,
                      .y_low = 0.5 * low,
                      .y_high = 2.0 * high,
                      .y_log = true,
                      .series = {std::move(largest), std::move(mean)},
                      .key = "bottom right"}},
          .field_label = ""};
}

}  // namespace

Report compare_runs(const ComparePlan& plan) {
  const auto settings =
      compare_manifests(read_json_file(plan.first / "manifest.json"), read_json_file(plan.second / "manifest.json"));
  const ComparedMotion motion = compare_motion(plan.first, plan.second);
  const std::vector<ComparedColumn> columns = compare_columns(plan.first, plan.second);
  const FrameDistance* furthest = motion.furthest();
  const bool apart = furthest != nullptr && furthest->largest > 0.0;

  Report report;
  report.opening =
      fmt::format("first: {}, {}\nsecond: {}, {}", plan.first.string(), counted(motion.frames[0], "frame", "frames"),
                  plan.second.string(), counted(motion.frames[1], "frame", "frames"));
  if (!settings.empty()) report.tables.push_back({"settings", "Settings that differ", table_of(settings)});
  if (apart) {
    report.tables.push_back({"parting", "When they part", parting_table(motion)});
    report.tables.push_back({"motion", "How far they are apart", motion_table(motion),
                             fmt::format("An edge is {:.4g} m long, the median at the start.", motion.edge)});
    if (motion.distances.size() > 1) report.pictures.push_back({"distance", motion_panels(motion)});
  }
  if (!columns.empty())
    report.tables.push_back({"columns", "Diagnostics and probes that differ", column_table(columns)});

  if (motion.distances.empty() && !motion.cells_part)
    report.disagreements.emplace_back("They have no time of a frame in common: nothing is compared.");
  if (furthest != nullptr && furthest->largest > plan.within)
    report.disagreements.push_back(fmt::format("At {:.6g} s vertex {} is {:.3g} edges ({:.3g} m) off.", furthest->time,
                                               furthest->vertex, furthest->largest, furthest->largest * motion.edge));
  if (motion.cells_part)
    report.disagreements.push_back(fmt::format("From {:.6g} s on they have other cells.", *motion.cells_part));
  if (report.disagreements.empty())
    report.sentence = apart ? fmt::format("No vertex is more than {:g} edges off, at {}.", plan.within,
                                          counted(motion.distances.size(), "time", "times"))
                            : fmt::format("All vertices have the same places, bit for bit, at {}.",
                                          counted(motion.distances.size(), "time", "times"));
  else
    report.sentence = "The runs differ.";

  report.numbers = {{"first", plan.first.string()}, {"second", plan.second.string()}, {"edge", motion.edge}};
  report.numbers["settings"] = to_data(settings);
  report.numbers["distances"] = nlohmann::json::array();
  for (const FrameDistance& d : motion.distances)
    report.numbers["distances"].push_back(
        {{"time", d.time}, {"largest", d.largest}, {"root_mean_square", d.root_mean_square}, {"vertex", d.vertex}});
  report.numbers["cells_part"] = motion.cells_part ? nlohmann::json(*motion.cells_part) : nlohmann::json(nullptr);
  report.numbers["columns"] = nlohmann::json::array();
  for (const ComparedColumn& c : columns)
    report.numbers["columns"].push_back(
        {{"file", c.file}, {"name", c.name}, {"largest", c.largest}, {"at", c.at}, {"scale", c.scale}});
  report.numbers["differences"] = report.disagreements;
  return report;
}

Report compare(const ComparePlan& plan) {
  const bool first = is_run_of_scene(plan.first), second = is_run_of_scene(plan.second);
  if (first != second)
    throw InputError(fmt::format("{} is a run of a scene, and {} is none; expected two of one kind",
                                 (first ? plan.first : plan.second).string(),
                                 (first ? plan.second : plan.first).string()));
  return first ? compare_runs(plan) : compare_study(plan);
}

}  // namespace dartboard
