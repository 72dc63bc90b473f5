#include "benchmarks/studies/scenes/explain_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/table.h"
#include "benchmarks/harness/tell.h"

namespace dartboard {
namespace {

std::string counted(const ScenePlan& plan) {
  return fmt::format("{} vertices, {} edges, {} faces, {} cells, {} darts", plan.counts.vertices, plan.counts.edges,
                     plan.counts.faces, plan.counts.cells, plan.counts.darts);
}

std::string time_text(double ns, double below = 0.0) {
  return below > 0.0 ? fmt::format("not measurable (< {:.0f})", std::max(1.0, below))
         : ns == 0.0 ? ""
                     : fmt::format("{:.0f}", ns);
}

}  // namespace

std::string to_text(const SceneFile& scene, const ScenePlan& plan, const std::optional<MeasuredScene>& measured) {
  std::string text = fmt::format("{}\n{}; {}; {} steps of {:.6g} s\n\n", one_line(scene.name), plan.map, counted(plan),
                                 plan.steps, scene.step);
  std::vector<Column> columns{{"part", Align::left}, {"bytes", Align::right}};
  if (measured) columns.push_back({"measured", Align::right});
  columns.insert(columns.end(), {{"ns per step", Align::right}, {"what", Align::left}, {"why", Align::left}});
  Table table(columns);
  const auto row = [&](const std::string& part, std::size_t bytes, std::size_t found, const std::string& ns,
                       const std::string& what, const std::string& why) {
    std::vector<std::string> cells{part, fmt::format("{}", bytes)};
    if (measured) cells.push_back(fmt::format("{}{}", found, found == bytes ? "" : " DIFFERS"));
    cells.insert(cells.end(), {ns, what, why});
    table.add_row(cells);
  };
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    const PlanItem& item = plan.items[k];
    row(std::string(name(item.part)), item.bytes, measured ? measured->found.bytes[k] : 0,
        time_text(item.ns, item.ns_below), item.what, item.why);
  }
  if (measured)
    for (const MemoryItem& item : measured->found.unplanned)
      row(std::string(name(item.part)), 0, item.bytes, "", "not planned", "");
  row("in all", plan.bytes(), measured ? measured->total : 0, time_text(plan.ns()), "", "");
  Table without({{"left out", Align::left}, {"because", Align::left}});
  for (const LeftOut& item : plan.left_out) without.add_row({item.what, item.why});
  text += to_text(table) + "\n" + to_text(without) + "\n";
  text +=
      "Bytes are those of the elements of all containers that live as long as the run, at the start; of a factor, its "
      "numbers.\nTimes are estimates from unit costs measured just now on arrays of this size, averaged over the run, "
      "output in memory included.\nNot in them: building the body, writing files, what stress tears, steps divided by "
      "/unstable_step.\n";
  if (!measured) return text;
  return text + fmt::format("\nmeasured: {:.0f} ns per step, {:+.1f} % from the estimate; bytes {}\n", measured->ns,
                            100.0 * (measured->ns / plan.ns() - 1.0),
                            measured->equal ? "exactly as planned" : "DIFFER");
}

nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan,
                               const std::optional<MeasuredScene>& measured) {
  nlohmann::ordered_json json{{"scene", scene.name},
                              {"map", plan.map},
                              {"integrator", scene.integrator},
                              {"steps", plan.steps},
                              {"counts",
                               {{"vertices", plan.counts.vertices},
                                {"edges", plan.counts.edges},
                                {"faces", plan.counts.faces},
                                {"cells", plan.counts.cells},
                                {"darts", plan.counts.darts}}},
                              {"bytes", plan.bytes()},
                              {"ns_per_step", plan.ns()}};
  json["plan"] = json["left_out"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    const PlanItem& item = plan.items[k];
    json["plan"].push_back({{"part", name(item.part)},
                            {"what", item.what},
                            {"why", item.why},
                            {"bytes", item.bytes},
                            {"ns_per_step", item.ns}});
    if (item.ns_below > 0.0) json["plan"].back()["ns_per_step_below"] = item.ns_below;
    if (measured) json["plan"].back()["measured_bytes"] = measured->found.bytes[k];
  }
  for (const LeftOut& item : plan.left_out) json["left_out"].push_back({{"what", item.what}, {"why", item.why}});
  if (measured) {
    json["measured"] = {
        {"bytes", measured->total}, {"bytes_as_planned", measured->equal}, {"ns_per_step", measured->ns}};
    for (const MemoryItem& item : measured->found.unplanned)
      json["measured"]["unplanned"].push_back({{"part", name(item.part)}, {"bytes", item.bytes}});
  }
  return json;
}

}  // namespace dartboard
