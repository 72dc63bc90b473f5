#include "benchmarks/studies/scenes/gallery_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace dartboard {

Table gallery_table(const std::vector<ShownScene>& all) {
  Table table({{"scene"},
               {"map"},
               {"integrator"},
               {"steps", Align::right},
               {"operations", Align::right},
               {"expected", Align::right},
               {"hash"},
               {"holds"}});
  for (const ShownScene& s : all)
    table.add_row({s.scene.name, s.map, s.scene.integrator, std::to_string(s.steps), std::to_string(s.operations),
                   fmt::format("{} of {}", s.held, s.expected), s.hash, s.holds() ? "yes" : "NO"});
  return table;
}

Table shown_table(const std::vector<ShownScene>& all) {
  Table table({{"scene"}, {"file"}, {"what it shows"}, {"why that is expected"}});
  for (const ShownScene& s : all) {
    std::string why = s.scene.expect.why;
    for (const ExpectedPlace& place : s.scene.expect.places)
      if (!place.why.empty())
        why += fmt::format("{}{}{}: {}", why.empty() ? "" : "\n", place.of_part ? "the part of " : "",
                           s.scene.probes.at(place.probe).name, place.why);
    table.add_row({s.scene.name, s.file, s.scene.about, why});
  }
  return table;
}

nlohmann::ordered_json to_json(const ShownScene& s) {
  return {{"scene", s.scene.name},
          {"map", s.map},
          {"integrator", s.scene.integrator},
          {"steps", s.steps},
          {"operations", s.operations},
          {"hash", s.hash},
          {"expected", s.expected},
          {"held", s.held},
          {"holds", s.holds()},
          {"divergence", s.divergence},
          {"cpu_s", s.cpu_s}};
}

}  // namespace dartboard
