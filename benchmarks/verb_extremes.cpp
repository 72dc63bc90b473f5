#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/cli.h"
#include "benchmarks/processes.h"
#include "benchmarks/run_folder.h"
#include "benchmarks/table.h"
#include "core/plain/error.h"
#include "validation/extremes.h"
#include "validation/stability_limits.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr unsigned hang_seconds = 20;  // of one run
constexpr std::array outcomes{ExtremeOutcome::ok, ExtremeOutcome::degraded, ExtremeOutcome::diagnosed,
                              ExtremeOutcome::silent, ExtremeOutcome::crash};
constexpr std::string_view limits_axis = "limits";

struct Options {
  std::string axis, out;
  bool quick = false, json = false;
  std::optional<std::size_t> child_from;  // of a child: the first run to make
};

// JSON has no infinity: numbers that may be none are text.
Json to_json(const ExtremeCell& cell) {
  Json json{{"axis", cell.axis},
            {"scene", cell.scene},
            {"integrator", cell.integrator},
            {"value", cell.value},
            {"outcome", to_string(cell.outcome)},
            {"step", cell.step}};
  if (!cell.diagnosis.ok()) {
    json["code"] = to_string(cell.diagnosis.code);
    if (cell.diagnosis.witness != Witness::none)
      json[cell.diagnosis.witness == Witness::vertex ? "vertex" : "edge"] = cell.diagnosis.number;
    json["quantity"] = cell.diagnosis.quantity;
    json["found"] = fmt::format("{:.6g}", cell.diagnosis.value);
  }
  if (!cell.warnings.empty()) json["warnings"] = cell.warnings;
  if (!cell.note.empty()) json["note"] = cell.note;
  return json;
}

/// The runs of an axis from a number on, a line before each and its result after it.
void run_child(const Options& options) {
  const std::vector<ExtremeCase> cases = extreme_cases(options.axis, options.quick);
  for (std::size_t k = *options.child_from; k < cases.size(); ++k) {
    fmt::print("{}\n", k);
    std::fflush(stdout);
    ::alarm(hang_seconds);  // ends the process: a hang is a crash
    fmt::print("{}\n", to_json(cases[k].run()).dump());
    std::fflush(stdout);
  }
}

/// All runs of an axis in child processes: after one that ended the process, the next goes on behind it.
std::vector<Json> run_axis(std::string_view axis, bool quick) {
  const std::vector<ExtremeCase> cases = extreme_cases(axis, quick);
  std::vector<Json> cells;
  while (cells.size() < cases.size()) {
    std::vector<std::string> arguments{"extremes", "--axis", std::string(axis), "--child-from",
                                       std::to_string(cells.size())};
    if (quick) arguments.emplace_back("--quick");
    std::string why = "the process ended";
    try {
      run_self(arguments, [&cells](std::string_view line) {
        if (line.starts_with('{')) cells.push_back(Json::parse(line));
      });
    } catch (const ProcessError& error) {
      why = error.what();
    }
    if (cells.size() == cases.size()) break;
    const ExtremeCase& which = cases[cells.size()];
    cells.push_back(
        to_json({which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::crash, {}, 0, {}, why}));
  }
  return cells;
}

/// How many cells ended how, by axis and by integrator.
Table count_outcomes(const std::vector<Json>& cells, const std::string& by) {
  std::vector<std::string> order;
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  for (const Json& cell : cells) {
    const auto key = cell.at(by).get<std::string>();
    if (!counts.contains(key)) order.push_back(key);
    ++counts[key][cell.at("outcome").get<std::string>()];
  }
  std::vector<Column> columns{{by, Align::left}};
  for (const ExtremeOutcome outcome : outcomes) columns.push_back({std::string(to_string(outcome)), Align::right});
  Table table(columns);
  for (const std::string& key : order) {
    std::vector<std::string> row{key};
    for (const ExtremeOutcome outcome : outcomes)
      row.push_back(fmt::format("{}", counts[key][std::string(to_string(outcome))]));
    table.add_row(std::move(row));
  }
  return table;
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
                   l.measured > 0 ? fmt::format("{:+.3f} %", 100 * (l.measured / l.theory - 1)) : "",
                   l.holds() ? "yes" : "NO"});
  return table;
}

Json to_json(const StabilityLimit& l) {
  return {{"body", l.body},     {"integrator", l.integrator}, {"zeta", l.zeta},
          {"theory", l.theory}, {"measured", l.measured},     {"holds", l.holds()}};
}

void extremes(const Options& options, Outcome& outcome) {
  if (options.child_from) {
    run_child(options);
    return;
  }
  std::vector<Json> cells;
  std::vector<StabilityLimit> limits;
  if (options.axis.empty() || options.axis == limits_axis) limits = measure_stability_limits(options.quick);
  if (options.axis != limits_axis)
    for (const ExtremeAxis& axis : extreme_axes())
      if (options.axis.empty() || options.axis == axis.name) {
        const std::vector<Json> found = run_axis(axis.name, options.quick);
        cells.insert(cells.end(), found.begin(), found.end());
      }
  if (cells.empty() && limits.empty()) extreme_cases(options.axis, options.quick);  // says which axes there are

  std::vector<Json> forbidden;
  for (const Json& cell : cells)
    if (cell.at("outcome") == "SILENT" || cell.at("outcome") == "CRASH") forbidden.push_back(cell);
  const auto failed = std::ranges::count_if(limits, [](const StabilityLimit& l) { return !l.holds(); });
  outcome.exit_code = forbidden.empty() && failed == 0 ? exit_agrees : exit_disagrees;

  if (!options.out.empty()) {
    const RunFolder folder(options.out);
    JsonLines matrix = folder.json_lines("extremes.jsonl");
    for (const Json& cell : cells) matrix.append(cell);
    if (!cells.empty()) folder.write_table("extremes", "Extremes, by axis", count_outcomes(cells, "axis"));
    if (!limits.empty()) folder.write_table("limits", "Stability limits beside theory", table_of(limits));
  }
  if (options.json) {
    Json json{{"cells", cells.size()}, {"forbidden", forbidden.size()}, {"matrix", cells}};
    json["limits"] = Json::array();
    for (const StabilityLimit& l : limits) json["limits"].push_back(to_json(l));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  if (!limits.empty()) fmt::print("Longest stable step times omega_max:\n\n{}\n", to_text(table_of(limits)));
  if (cells.empty()) return;
  fmt::print("{}\n{}\n", to_text(count_outcomes(cells, "axis")), to_text(count_outcomes(cells, "integrator")));
  for (const Json& cell : forbidden) fmt::print("{}\n", cell.dump());
  fmt::print("{} cells, {} of them SILENT or CRASH.\n", cells.size(), forbidden.size());
}

}  // namespace

void add_extremes(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand(
      "extremes", "Run every integrator at the extremes: each run is right, warned of, or stopped with a diagnosis.");
  std::string known;
  for (const ExtremeAxis& axis : extreme_axes()) known += fmt::format("{}, ", axis.name);
  verb->add_option("--axis", options->axis, fmt::format("only this one of {}{} [all]", known, limits_axis));
  verb->add_flag("--quick", options->quick, "every third value, shorter runs for limits");
  verb->add_flag("--json", options->json, "print JSON");
  verb->add_option("--out", options->out, "folder for the matrix and the tables, new or empty [nothing is written]");
  verb->add_option("--child-from", options->child_from)->group("");  // hidden: the runs of one child process
  verb->callback([options, &outcome] { extremes(*options, outcome); });
}

}  // namespace dartboard
