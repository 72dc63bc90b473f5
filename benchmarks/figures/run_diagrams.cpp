#include "benchmarks/figures/run_diagrams.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "benchmarks/figures/gnuplot.h"
#include "benchmarks/figures/panels.h"

namespace dartboard {
namespace {

using Rows = std::span<const Diagnostics>;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

template <class Row, class Value>
std::vector<double> values_of(std::span<const Row> rows, const Value& value) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(value(row));
  return values;
}

template <class Row, class Vector>
std::vector<RunCurve> axes_of(std::span<const Row> rows, const Vector& vector) {
  std::vector<RunCurve> curves;
  for (int axis = 0; axis < 3; ++axis)
    curves.push_back({std::string(1, "xyz"[axis]),
                      values_of(rows, [&](const Row& row) { return Eigen::Vector3d(vector(row))[axis]; })});
  return curves;
}

void count_from_lowest(std::vector<double>& potential) {
  const double lowest = *std::ranges::min_element(potential);
  for (double& value : potential) value -= lowest;
}

std::string capitalised(std::string_view text) {
  std::string out(text);
  out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

RunDiagram energy_of(Rows rows, const SceneFile& scene) {
  const auto contact = [rows](double ContactDiagnostics::*part) {
    return values_of(rows, [part](const Diagnostics& d) { return d.contact ? (*d.contact).*part : 0.0; });
  };
  RunDiagram energy{.title = "Energy",
                    .unit = "J",
                    .note =
                        "Potentials count from their lowest value. The area between the parts and the dashed line is "
                        "what damping, parts that were removed and the integrator have taken, or added where the "
                        "parts are above it."};
  std::vector<RunCurve> parts{
      {"kinetic", values_of(rows, [](const Diagnostics& d) { return d.kinetic; })},
      {"elastic", values_of(rows, [](const Diagnostics& d) { return d.elastic; })},
      {"of contacts", contact(&ContactDiagnostics::energy)},
      {"gravitational", values_of(rows, [](const Diagnostics& d) { return d.gravitational; })},
      {"of forces", values_of(rows, [](const Diagnostics& d) { return d.applied.value_or(0.0); })},
      {"lost by restitution", contact(&ContactDiagnostics::damped)},
      {"lost by friction", contact(&ContactDiagnostics::rubbed)},
      {"lost by falling asleep",
       values_of(rows, [](const Diagnostics& d) { return d.sleep ? d.sleep->removed : 0.0; })}};
  count_from_lowest(parts[3].values);
  count_from_lowest(parts[4].values);
  const std::vector<double> supplied = contact(&ContactDiagnostics::supplied);
  double start = -supplied[0];
  for (RunCurve& part : parts) {
    start += part.values[0];
    part.is_part = true;
    if (std::ranges::any_of(part.values, [](double value) { return value != 0.0; }))
      energy.curves.push_back(std::move(part));
  }
  // the work of driven vertices is known with contact alone
  if (scene.driven.empty() || rows[0].contact) {
    RunCurve account{"start and supplied"};
    for (const double value : supplied) account.values.push_back(start + value);
    energy.curves.push_back(std::move(account));
  }
  return energy;
}

RunDiagram displacement_of(const std::string& name, std::size_t probe, std::span<const ProbeRow> rows) {
  const Eigen::Vector3d start = rows[0].probes[probe]->position;
  return {.title = fmt::format("Displacement of '{}'", name),
          .unit = "m",
          .times = values_of(rows, [](const ProbeRow& row) { return row.time; }),
          .curves = axes_of(rows, [&](const ProbeRow& row) -> Eigen::Vector3d {
            const auto& motion = row.probes[probe];
            if (motion) return motion->position - start;
            return Eigen::Vector3d::Constant(no_value);
          })};
}

}  // namespace

std::vector<RunDiagram> diagrams_of(Rows rows, std::span<const ProbeRow> probes, const SceneFile& scene,
                                    int dimension) {
  if (rows.empty()) return {};
  std::vector<RunDiagram> all{energy_of(rows, scene)};
  const auto add = [&all](std::string title, std::string_view unit, std::vector<RunCurve> curves) {
    all.push_back({.title = std::move(title), .unit = std::string(unit), .curves = std::move(curves)});
  };
  add("Momentum", "kg m/s", axes_of(rows, [](const Diagnostics& d) { return d.momentum; }));
  add("Angular momentum about the origin", "kg m²/s",
      axes_of(rows, [](const Diagnostics& d) { return d.angular_momentum; }));
  if (rows[0].contact) {
    const auto of_contact = [rows](auto part) {
      return values_of(rows, [part](const Diagnostics& d) { return static_cast<double>((*d.contact).*part); });
    };
    add("Contacts", "", {{"contacts", of_contact(&ContactDiagnostics::contacts)}});
    add("Deepest contact", "m", {{"depth", of_contact(&ContactDiagnostics::deepest)}});
  }
  add(capitalised(stress_name(dimension)), stress_unit(dimension),
      {{"largest", values_of(rows, [](const Diagnostics& d) { return d.largest_stress; })}});
  for (const auto& [name, count] : {std::pair("vertices", &CellCounts::vertices),
                                    {"cells", &CellCounts::cells},
                                    {"components", &CellCounts::components}}) {
    std::vector<double> counts =
        values_of(rows, [count = count](const Diagnostics& d) { return static_cast<double>(d.counts.*count); });
    if (std::ranges::any_of(counts, [&](double value) { return value != counts[0]; }))
      add(capitalised(name), "", {{name, std::move(counts)}});
  }
  const std::vector<double> times = values_of(rows, [](const Diagnostics& d) { return d.time; });
  for (RunDiagram& diagram : all) diagram.times = times;
  for (std::size_t p = 0; p < scene.probes.size() && !probes.empty(); ++p)
    if (probes[0].probes[p]) all.push_back(displacement_of(scene.probes[p].name, p, probes));
  return all;
}

std::string draw_diagrams(std::span<const RunDiagram> diagrams, const std::string& title,
                          const std::filesystem::path& folder, const std::string& name, const std::string& gnuplot) {
  constexpr std::array colours{"#4e79a7", "#f28e2b", "#59a14f", "#b07aa1", "#76b7b2", "#e15759", "#9c755f", "#bab0ac"};
  constexpr int columns = 3;
  const int rows = (static_cast<int>(diagrams.size()) + columns - 1) / columns;
  Panels panels{.title = title,
                .columns = columns,
                .panels = {},
                .field_label = {},
                .width = 1800,
                .height = 45 + 450 * rows,
                .between = 180};
  for (const RunDiagram& diagram : diagrams) {
    Panel panel{.title = diagram.title + (diagram.unit.empty() ? "" : fmt::format(" [{}]", diagram.unit)),
                .x_axis = "time [s]",
                .x_low = diagram.times.front(),
                .x_high = diagram.times.back(),
                .key = diagram.curves.size() > 1 ? "at graph 0.5,-0.24 center top horizontal maxcols 3" : ""};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<double> sum(diagram.times.size(), 0.0);
    for (std::size_t c = 0; c < diagram.curves.size(); ++c) {
      const RunCurve& curve = diagram.curves[c];
      PlotSeries series{
          .title = curve.name, .points = {}, .colour = colours[c % colours.size()], .symbol = 0, .width = 1.8};
      for (std::size_t k = 0; k < curve.values.size(); ++k) {
        if (curve.is_part) sum[k] += curve.values[k];
        const double value = curve.is_part ? sum[k] : curve.values[k];
        if (!std::isfinite(value)) continue;
        series.points.push_back({diagram.times[k], value});
        low = std::min({low, value, curve.is_part ? 0.0 : value});
        high = std::max(high, value);
      }
      series.filled = curve.is_part;
      const bool is_account = !curve.is_part && diagram.curves[0].is_part;
      if (is_account) {
        series.colour = "#202020";
        series.dash = "-";
      }
      // an area ends at 0, and hides what is behind it: that of the first part comes last
      panel.series.insert(curve.is_part ? panel.series.begin() : panel.series.end(), std::move(series));
    }
    const double room = high > low ? 0.04 * (high - low) : std::max(1.0, std::abs(high)) / 2;
    panel.y_low = std::isfinite(low) ? low - (diagram.curves[0].is_part && low == 0.0 ? 0.0 : room) : 0.0;
    panel.y_high = std::isfinite(high) ? high + room : 1.0;
    if (!(panel.x_low < panel.x_high)) panel.x_high = panel.x_low + 1.0;
    panels.panels.push_back(std::move(panel));
  }
  std::string trouble = draw(panels, folder, name, gnuplot);
  if (trouble.empty()) remove_drawn(folder, name);  // what it is drawn from is in the run's tables
  return trouble;
}

}  // namespace dartboard
