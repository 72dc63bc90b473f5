#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "benchmarks/studies/extremes/extremes_report.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array outcomes{ExtremeOutcome::ok,       ExtremeOutcome::scheme,    ExtremeOutcome::survived,
                              ExtremeOutcome::degraded, ExtremeOutcome::diagnosed, ExtremeOutcome::silent,
                              ExtremeOutcome::crash};
constexpr std::array judges{JudgedBy::motion, JudgedBy::scheme, JudgedBy::survival};

std::string percent(double share) { return fmt::format("{:+.3f} %", 100 * share); }

/// Numbers of cells by outcome, for each axis and each integrator; how many of the diagnosed ones were refused: they
/// never ran; and by which evidence the others are judged.
Table count_outcomes(const std::vector<Json>& cells, const std::string& by) {
  std::vector<std::string> order;
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  for (const Json& cell : cells) {
    const auto key = cell.at(by).get<std::string>();
    if (!counts.contains(key)) order.push_back(key);
    ++counts[key][cell.at("outcome").get<std::string>()];
    if (cell.at("outcome") == "DIAGNOSED" && cell.contains("refused")) ++counts[key]["refused"];
    ++counts[key]["by " + cell.at("judged_by").get<std::string>()];
  }
  std::vector<Column> columns{{by, Align::left}};
  for (const ExtremeOutcome outcome : outcomes) {
    columns.push_back({std::string(to_string(outcome)), Align::right});
    if (outcome == ExtremeOutcome::diagnosed) columns.push_back({"of it refused", Align::right});
  }
  for (const JudgedBy judge : judges) columns.push_back({fmt::format("by {}", to_string(judge)), Align::right});
  columns[columns.size() - judges.size()].title.insert(0, "judged ");
  Table table(columns);
  for (const std::string& key : order) {
    std::vector<std::string> row{key};
    for (const ExtremeOutcome outcome : outcomes) {
      row.push_back(fmt::format("{}", counts[key][std::string(to_string(outcome))]));
      if (outcome == ExtremeOutcome::diagnosed) row.push_back(fmt::format("{}", counts[key]["refused"]));
    }
    for (const JudgedBy judge : judges)
      row.push_back(fmt::format("{}", counts[key][fmt::format("by {}", to_string(judge))]));
    table.add_row(std::move(row));
  }
  return table;
}

/// "7920 runs: judged by the motion 29.1 %, by the scheme 31.1 %, by survival 0.0 %, diagnosed 39.4 %".
std::string shares_of(const std::vector<Json>& cells) {
  const auto share = [&cells](JudgedBy by) {
    const auto count = std::ranges::count_if(cells, [by](const Json& c) { return c.at("judged_by") == to_string(by); });
    return 100.0 * static_cast<double>(count) / static_cast<double>(cells.size());
  };
  return fmt::format(
      "{} runs: judged by the motion {:.1f} %, by the scheme {:.1f} %, by survival {:.1f} %, diagnosed "
      "{:.1f} %",
      cells.size(), share(JudgedBy::motion), share(JudgedBy::scheme), share(JudgedBy::survival),
      share(JudgedBy::diagnosis));
}

Table table_of(const std::vector<StabilityLimit>& limits) {
  Table table({{"body", Align::left},
               {"integrator", Align::left},
               {"damping ratio", Align::right},
               {"theory", Align::right},
               {"measured", Align::right},
               {"difference", Align::right},
               {"holds", Align::left}});
  for (const StabilityLimit& l : limits)
    table.add_row({l.body, l.integrator, fmt::format("{:g}", l.zeta), fmt::format("{:.5f}", l.theory),
                   l.measured > 0 ? fmt::format("{:.5f}", l.measured) : "none near",
                   l.measured > 0 ? percent(l.measured / l.theory - 1) : "", l.holds() ? "yes" : "NO"});
  return table;
}

Table table_of(const std::vector<MeshBody>& meshes) {
  Table table({{"body", Align::left},
               {"vertices", Align::right},
               {"springs", Align::right},
               {"omega_max / (1/s)", Align::right},
               {"within", Align::right},
               {"proven", Align::left},
               {"before the cuts", Align::right},
               {"estimate, lower", Align::right},
               {"upper", Align::right}});
  for (const MeshBody& m : meshes)
    table.add_row({m.name, fmt::format("{}", m.body.x.size()), fmt::format("{}", m.body.springs.size()),
                   fmt::format("{:.6f}", m.omega), fmt::format("{:.1e}", m.error), m.proven ? "yes" : "NO",
                   percent(m.rise - 1), percent(m.lower / m.omega - 1), percent(m.upper / m.omega - 1)});
  return table;
}

Table table_of(const std::vector<StabilityMap>& maps) {
  Table table({{"integrator", Align::left},
               {"runs in the map", Align::right},
               {"crossings", Align::right},
               {"found by runs", Align::right},
               {"worst distance", Align::right},
               {"at damping ratio", Align::right},
               {"h omega", Align::right}});
  for (const StabilityMap& m : maps) {
    std::size_t found = 0;
    const StabilityMap::Crossing* worst = nullptr;
    for (const auto& c : m.boundary) {
      found += c.measured > 0.0;
      if (c.measured > 0.0 && (worst == nullptr || c.distance() > worst->distance())) worst = &c;
    }
    table.add_row({m.integrator, fmt::format("{}", m.growth.size()), fmt::format("{}", m.boundary.size()),
                   fmt::format("{}", found), worst ? fmt::format("{:.3f} %", 100 * worst->distance()) : "",
                   worst ? fmt::format("{:.3g}", worst->zeta) : "", worst ? fmt::format("{:.5f}", worst->theory) : ""});
  }
  return table;
}

Table table_of(const std::vector<AmplificationPoint>& points) {
  Table table({{"integrator", Align::left},
               {"h omega", Align::right},
               {"amplitude", Align::right},
               {"phase error", Align::right},
               {"damping ratio", Align::right},
               {"in theory", Align::right},
               {"deviation", Align::right},
               {"holds", Align::left}});
  for (const AmplificationPoint& p : points) {
    const double decades = std::log10(p.theta);
    if (std::abs(decades - std::round(decades)) > 1e-9) continue;
    table.add_row({p.integrator, fmt::format("{:g}", p.theta), fmt::format("{:.6g}", p.amplitude()),
                   fmt::format("{:+.3e}", p.phase() / p.theta - 1), fmt::format("{:.3e}", p.damping_ratio()),
                   fmt::format("{:.3e}", p.theoretical_damping_ratio()), fmt::format("{:.1e}", p.deviation()),
                   p.holds() ? "yes" : "NO"});
  }
  return table;
}

Table table_of(const std::vector<RoundingGrowth>& all) {
  Table table({{"integrator", Align::left},
               {"starts", Align::right},
               {"steps", Align::right},
               {"energy error", Align::right},
               {"exponent", Align::right}});
  for (const RoundingGrowth& g : all)
    for (const auto& p : g.points)
      table.add_row({g.integrator, fmt::format("{}", g.starts), fmt::format("{:.3g}", static_cast<double>(p.steps)),
                     fmt::format("{:.2e}", p.error), &p == &g.points.back() ? fmt::format("{:.3f}", g.exponent) : ""});
  return table;
}

Table table_of(const std::vector<TinySteps>& all) {
  Table table({{"integrator", Align::left},
               {"step / s", Align::right},
               {"steps", Align::right},
               {"displacement lost", Align::right},
               {"cannot be read", Align::right},
               {"lost, all digits", Align::right}});
  for (const TinySteps& t : all)
    table.add_row({t.integrator, fmt::format("{:g}", t.h), fmt::format("{}", t.steps), fmt::format("{:.1e}", t.lost),
                   fmt::format("{:.1e}", t.readable), fmt::format("{:.1e}", t.lost_with_digits)});
  return table;
}

// By integrator and factor, the worst over bodies and motions.
Table table_of(const std::vector<Detection>& all) {
  Table table({{"integrator", Align::left},
               {"step / limit", Align::right},
               {"runs", Align::right},
               {"predicted", Align::right},
               {"passed the bound", Align::right},
               {"at step, latest", Align::right},
               {"detected at, latest", Align::right},
               {"most steps above", Align::right}});
  struct Worst {
    std::size_t runs = 0, predicted = 0, passed = 0;
    std::uint64_t at = 0, detected = 0, above = 0;
  };
  std::vector<std::pair<std::string, double>> order;
  std::map<std::pair<std::string, double>, Worst> worst;
  for (const Detection& d : all) {
    const std::pair key(d.integrator, d.factor);
    if (!worst.contains(key)) order.push_back(key);
    Worst& w = worst[key];
    ++w.runs;
    w.predicted += d.predicted;
    w.passed += d.passed.has_value();
    w.at = std::max(w.at, d.passed.value_or(0));
    w.detected = std::max(w.detected, d.detected.value_or(0));
    w.above = std::max(w.above, d.above);
  }
  for (const auto& key : order) {
    const Worst& w = worst[key];
    table.add_row({key.first, fmt::format("{:g}", key.second), fmt::format("{}", w.runs),
                   fmt::format("{}", w.predicted), fmt::format("{}", w.passed), fmt::format("{}", w.at),
                   fmt::format("{}", w.detected), fmt::format("{}", w.above)});
  }
  return table;
}

}  // namespace

std::vector<NamedTable> tables_of(const ExtremesResults& results) {
  std::vector<NamedTable> tables;
  if (!results.cells.empty()) {
    tables.push_back({.name = "extremes",
                      .heading = fmt::format("Extremes, by axis; {}", shares_of(results.cells)),
                      .table = count_outcomes(results.cells, "axis"),
                      .study = "matrix"});
    tables.push_back({.name = "integrators",
                      .heading = "Extremes, by integrator",
                      .table = count_outcomes(results.cells, "integrator"),
                      .study = "matrix"});
  }
  if (!results.limits.empty())
    tables.push_back({.name = "limits",
                      .heading = "Longest stable step times omega_max, compared with theory",
                      .table = table_of(results.limits),
                      .study = "limits"});
  if (!results.meshes.empty())
    tables.push_back({.name = "frequencies",
                      .heading = "Highest frequencies of meshes, by Lanczos",
                      .table = table_of(results.meshes),
                      .study = "limits"});
  if (!results.maps.empty())
    tables.push_back({.name = "maps",
                      .heading = "Boundaries of stability, by runs and in theory",
                      .table = table_of(results.maps),
                      .study = "maps"});
  if (!results.amplification.empty())
    tables.push_back({.name = "amplification",
                      .heading = "One step of an undamped oscillation",
                      .table = table_of(results.amplification),
                      .study = "amplification"});
  if (!results.rounding.empty())
    tables.push_back({.name = "rounding",
                      .heading = "Energy error by rounding alone",
                      .table = table_of(results.rounding),
                      .study = "rounding"});
  if (!results.tiny.empty())
    tables.push_back({.name = "tiny", .heading = "Tiny steps", .table = table_of(results.tiny), .study = "rounding"});
  if (!results.detections.empty())
    tables.push_back({.name = "detection",
                      .heading = "Unstable steps: predicted, and detected",
                      .table = table_of(results.detections),
                      .study = "detection"});
  return tables;
}

}  // namespace dartboard
