#include "benchmarks/studies/conservation/conservation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dartboard {
namespace {

std::string bound_text(const ConservedRow& row) {
  return !row.bound || *row.bound == 0.0 ? "exact" : fmt::format("{:.2e}", *row.bound);
}

std::string deviation_text(double deviation) { return deviation == 0.0 ? "0" : fmt::format("{:.2e}", deviation); }

}  // namespace

bool TakenApart::holds() const {
  return !result.violation && std::all_of(result.rows.begin(), result.rows.end(), [](auto& r) { return r.holds; });
}

Table table_of(const ConservationResult& result) {
  Table table({{"quantity", Align::left},
               {"checks", Align::right},
               {"largest deviation", Align::right},
               {"bound", Align::right},
               {"holds", Align::left}});
  for (const ConservedRow& row : result.rows)
    table.add_row({row.what, fmt::format("{}", row.checks), row.holds || row.bound ? deviation_text(row.largest) : "-",
                   bound_text(row), row.holds ? (row.checks > 0 ? "yes" : "not met") : "NO"});
  return table;
}

std::string to_text(const TakenApart& s, const std::string& repeat) {
  const ConservationResult& r = s.result;
  std::string text =
      fmt::format("{}, {} storage, {} cells, seed {}, h = {:.3g} s\n", s.name, s.storage, s.cells, s.seed, s.h);
  text += fmt::format(
      "{} operations ({} dissociations, {} torn fans, {} removals, {} refinements) in {} series, {} steps between; "
      "{} parts split off; the body was emptied and refilled {} times\n",
      r.operations(), r.dissociations, r.tears, r.removals, r.refinements, r.series, r.steps, r.parts_split_off,
      r.refills);
  if (r.whole_comparisons > 0)
    text += fmt::format(
        "compared after each series: sums, and all that it changed, the views' ends of springs included; everything, all "
        "views against rebuilt ones included: {} times\n",
        r.whole_comparisons);
  text += fmt::format("{:.0f} operations per second, checks and steps included; {} bodies built from scratch{}\n\n",
                      s.operations_per_s, r.bodies_from_scratch,
                      r.bodies_without_bound == 0
                          ? ""
                          : fmt::format(", for {} of which the bound of motion says nothing", r.bodies_without_bound));
  text += to_text(table_of(r)) + "\n";
  if (r.violation)
    text +=
        fmt::format("{}, {} storage: {}\nRepeat it with: {}\n\n", s.name, s.storage, to_string(*r.violation), repeat);
  return text;
}

nlohmann::ordered_json to_json(const TakenApart& s) {
  const ConservationResult& r = s.result;
  nlohmann::ordered_json json{{"mesh", s.name},
                              {"storage", s.storage},
                              {"cells", s.cells},
                              {"seed", s.seed},
                              {"h", s.h},
                              {"holds", s.holds()},
                              {"operations", r.operations()},
                              {"whole_comparisons", r.whole_comparisons},
                              {"dissociations", r.dissociations},
                              {"tears", r.tears},
                              {"removals", r.removals},
                              {"refinements", r.refinements},
                              {"parts_split_off", r.parts_split_off},
                              {"series", r.series},
                              {"steps", r.steps},
                              {"refills", r.refills},
                              {"bodies_from_scratch", r.bodies_from_scratch},
                              {"bodies_without_bound", r.bodies_without_bound},
                              {"operations_per_s", s.operations_per_s}};
  for (const ConservedRow& row : r.rows) {
    nlohmann::ordered_json quantity{
        {"what", row.what}, {"checks", row.checks}, {"largest_deviation", row.largest}, {"holds", row.holds}};
    quantity["exact"] = !row.bound || *row.bound == 0.0;
    if (row.bound) {  // for the check that came closest to its bound
      quantity["deviation"] = row.deviation;
      quantity["bound"] = *row.bound;
    }
    json["quantities"].push_back(quantity);
  }
  if (const auto& v = r.violation)
    json["violation"] = {{"what", v->what},     {"operation", v->operation}, {"seed", v->seed},
                         {"actual", v->actual}, {"expected", v->expected},   {"bound", v->bound}};
  return json;
}

}  // namespace dartboard
