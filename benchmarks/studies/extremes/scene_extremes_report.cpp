#include "benchmarks/studies/extremes/scene_extremes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "benchmarks/studies/extremes/extremes_report.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

std::size_t count_of(const std::vector<Json>& cells, std::string_view key, std::string_view value) {
  return static_cast<std::size_t>(std::ranges::count_if(cells, [&](const Json& c) { return c.at(key) == value; }));
}

Claim claim_of(const SceneCells& scene) {
  Claim claim{.id = "no-silent-run-on-" + scene.name,
              .text = fmt::format("no run of {} is wrong without a word, or ends the process", scene.name),
              .paper_value = "0"};
  std::ranges::replace(claim.id, ' ', '-');
  if (!scene.failure.empty() || scene.cells.empty()) {
    claim.reason = scene.failure.empty() ? "no run: the scene has neither a step nor a rate of change" : scene.failure;
    return claim;
  }
  const std::vector<Json> forbidden = forbidden_cells({.cells = scene.cells});
  const std::size_t survived = count_of(scene.cells, "judged_by", to_string(JudgedBy::survival));
  claim.measured = fmt::format("{}", forbidden.size());
  claim.bound_or_interval =
      fmt::format("{} runs: {} judged by the motion, {} by the steps of the scheme, {} diagnosed", scene.cells.size(),
                  count_of(scene.cells, "judged_by", "motion"), count_of(scene.cells, "judged_by", "scheme"),
                  count_of(scene.cells, "judged_by", "diagnosis"));
  if (survived > 0)
    claim.reason =
        fmt::format("{} runs are judged by their survival alone{}", survived,
                    scene.beyond_references.empty() ? ": witnesses with dense factors would take too long"
                                                    : fmt::format(": no witness supports {}", scene.beyond_references));
  claim.verdict = !forbidden.empty() ? Verdict::falls_short : survived > 0 ? Verdict::undecided : Verdict::holds;
  return claim;
}

std::string in_words(const Json& cell) {
  auto outcome = cell.at("outcome").get<std::string>();
  if (outcome == to_string(ExtremeOutcome::degraded)) {
    const Json& by = cell.at("judged_by");
    return fmt::format("{}, warned", to_string(by == to_string(JudgedBy::motion)   ? ExtremeOutcome::ok
                                               : by == to_string(JudgedBy::scheme) ? ExtremeOutcome::scheme
                                                                                   : ExtremeOutcome::survived));
  }
  if (outcome != to_string(ExtremeOutcome::diagnosed)) return outcome;
  if (cell.contains("refused")) return "refused";
  return fmt::format("{} at {}", cell.value("code", outcome), cell.at("step").get<std::uint64_t>());
}

}  // namespace

std::vector<Claim> claims_of(const std::vector<SceneCells>& scenes) {
  std::vector<Claim> claims;
  for (const SceneCells& scene : scenes) claims.push_back(claim_of(scene));
  return claims;
}

std::vector<NamedTable> tables_of(const std::vector<SceneCells>& scenes) {
  std::vector<NamedTable> tables;
  for (const SceneCells& scene : scenes) {
    if (scene.cells.empty()) continue;
    std::vector<std::string> integrators, steps;
    std::map<std::pair<std::string, std::string>, std::string> outcomes;
    const auto add = [](std::vector<std::string>& names, const std::string& name) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    };
    for (const Json& cell : scene.cells) {
      const auto integrator = cell.at("integrator").get<std::string>(), step = cell.at("value").get<std::string>();
      add(integrators, integrator);
      add(steps, step);
      outcomes[{integrator, step}] = in_words(cell);
    }
    std::vector<Column> columns{{"integrator"}};
    for (const std::string& step : steps) columns.push_back({step});
    Table table(columns);
    for (const std::string& integrator : integrators) {
      std::vector<std::string> row{integrator};
      for (const std::string& step : steps) row.push_back(outcomes[{integrator, step}]);
      table.add_row(std::move(row));
    }
    tables.push_back({.name = scene.name,
                      .heading = fmt::format("{} in 100 steps, by integrator and step", scene.name),
                      .table = std::move(table),
                      .note = "OK: every step is its scheme's, and the end is that of the true motion; SCHEME: every "
                              "step is its scheme's; SURVIVED: finite, within the energy there is; warned: before the "
                              "run; a code: stopped at that step with that diagnosis"});
  }
  return tables;
}

}  // namespace dartboard
