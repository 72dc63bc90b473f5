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

std::string to_text(const SceneFile& scene, const ScenePlan& plan, const std::optional<double>& measured_ns) {
  std::string text = fmt::format("{}\n{}; {}; {} steps of {:.6g} s\n\n", one_line(scene.name), plan.map, counted(plan),
                                 plan.steps, scene.step);
  Table table({{"part"}, {"bytes", Align::right}, {"ns per step", Align::right}, {"what"}, {"why"}});
  for (const PlanItem& item : plan.items)
    table.add_row({std::string(name(item.part)), fmt::format("{}", item.bytes), time_text(item.ns, item.ns_below),
                   item.what, item.why});
  for (const MemoryItem& item : plan.unplanned)
    table.add_row({std::string(name(item.part)), fmt::format("{}", item.bytes), "", "NOT PLANNED", ""});
  table.add_row({"in all", fmt::format("{}", plan.bytes()), time_text(plan.ns()), "", ""});
  Table without({{"left out", Align::left}, {"because", Align::left}});
  for (const LeftOut& item : plan.left_out) without.add_row({item.what, item.why});
  text += to_text(table) + "\n" + to_text(without) + "\n";
  text +=
      "Bytes are those of the elements of all containers that live as long as the run, asked of the body as it was "
      "built; of a factor, its numbers.\nTimes are estimates from unit costs measured just now on arrays of this size, averaged over the run, "
      "output in memory included.\nNot in them: building the body, writing files, what stress tears, steps divided by "
      "/unstable_step.\n";
  if (!measured_ns) return text;
  return text + fmt::format("\nmeasured: {:.0f} ns per step, {:+.1f} % from the estimate\n", *measured_ns,
                            100.0 * (*measured_ns / plan.ns() - 1.0));
}

nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan,
                               const std::optional<double>& measured_ns) {
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
  for (const PlanItem& item : plan.items) {
    json["plan"].push_back({{"part", name(item.part)},
                            {"what", item.what},
                            {"why", item.why},
                            {"bytes", item.bytes},
                            {"ns_per_step", item.ns}});
    if (item.ns_below > 0.0) json["plan"].back()["ns_per_step_below"] = item.ns_below;
  }
  for (const LeftOut& item : plan.left_out) json["left_out"].push_back({{"what", item.what}, {"why", item.why}});
  for (const MemoryItem& item : plan.unplanned)
    json["unplanned"].push_back({{"part", name(item.part)}, {"bytes", item.bytes}});
  if (measured_ns) json["measured"] = {{"ns_per_step", *measured_ns}};
  return json;
}

}  // namespace dartboard
