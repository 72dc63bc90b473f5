#include "benchmarks/studies/topology/topology_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/escape.h"

namespace dartboard {

Table rest_table(const TopologyComparison& comparison) {
  std::vector<Column> columns{{"question", Align::left}};
  for (const std::string& carrier : comparison.carriers) columns.push_back({carrier, Align::right});
  columns.push_back({"agrees", Align::left});
  Table table(columns);
  for (const AgreementRow& row : comparison.rows) {
    std::vector<std::string> cells{row.what};
    for (const std::string& answer : row.answers) cells.push_back(answer.empty() ? "-" : answer);
    cells.emplace_back(row.agrees ? "yes" : "NO");
    table.add_row(cells);
  }
  return table;
}

Table summary_table(const std::vector<TopologyVerdict>& verdicts) {
  Table table({{"mesh", Align::left},
               {"darts", Align::right},
               {"at rest", Align::left},
               {"combinatorial map", Align::left},
               {"operations", Align::right},
               {"refused by all", Align::right},
               {"not carried", Align::right},
               {"per second", Align::right},
               {"agrees", Align::left}});
  for (const TopologyVerdict& v : verdicts) {
    std::size_t applied = 0, illegal = 0, not_carried = 0;
    double slowest = 0.0;
    for (const FuzzSeries& s : v.sessions) {
      applied += s.result.applied;
      illegal += s.result.illegal;
      not_carried += s.result.not_carried;
      slowest = slowest == 0.0 ? s.operations_per_s : std::min(slowest, s.operations_per_s);
    }
    const auto held =
        std::count_if(v.at_rest.rows.begin(), v.at_rest.rows.end(), [](const auto& row) { return row.agrees; });
    table.add_row({v.name, fmt::format("{}", v.darts), fmt::format("{} of {}", held, v.at_rest.rows.size()),
                   v.at_rest.no_cmap.empty() ? "yes" : "not representable: " + v.at_rest.no_cmap,
                   fmt::format("{}", applied), fmt::format("{}", illegal), fmt::format("{}", not_carried),
                   fmt::format("{:.0f}", slowest), v.agrees() ? "yes" : "NO"});
  }
  return table;
}

nlohmann::ordered_json to_json(const Disagreement& d) {
  return {{"operation", d.operation}, {"line", d.line}, {"what", d.what}, {"ours", d.ours}, {"theirs", d.theirs}};
}

nlohmann::ordered_json to_json(const TopologyVerdict& v) {
  nlohmann::ordered_json json{
      {"mesh", v.name}, {"agrees", v.agrees()}, {"darts", v.darts}, {"carriers", v.at_rest.carriers}};
  if (!v.at_rest.no_cmap.empty()) json["no_combinatorial_map"] = v.at_rest.no_cmap;
  for (const AgreementRow& row : v.at_rest.rows)
    json["at_rest"].push_back({{"what", row.what}, {"answers", row.answers}, {"agrees", row.agrees}});
  for (const FuzzSeries& s : v.sessions) {
    nlohmann::ordered_json session{
        {"storage", name(s.storage)},      {"oracles", name(s.oracles)},  {"seed", s.seed},
        {"applied", s.result.applied},     {"illegal", s.result.illegal}, {"not_carried", s.result.not_carried},
        {"per_second", s.operations_per_s}};
    if (s.result.disagreement) {
      session["disagreement"] = to_json(*s.result.disagreement);
      session["script"] = to_string(s.result.script);
      session["script_file"] = v.script_file;
    }
    json["sessions"].push_back(session);
  }
  return json;
}

std::string disagreements_text(const TopologyVerdict& v) {
  std::string text;
  for (const AgreementRow& row : v.at_rest.rows)
    if (!row.agrees) text += fmt::format("{}: at rest, {}: {}\n", v.name, row.what, fmt::join(row.answers, " | "));
  for (const FuzzSeries& s : v.sessions)
    if (s.result.disagreement)
      text +=
          fmt::format("{}: seed {}, {}\n{}Replay it with: dartboard validate topology --replay {}\n", v.name, s.seed,
                      to_string(*s.result.disagreement), to_string(s.result.script), shell_word(v.script_file));
  return text;
}

}  // namespace dartboard
