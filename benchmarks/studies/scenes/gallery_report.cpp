#include "benchmarks/studies/scenes/gallery_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/escape.h"

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

std::string gallery_page(const std::vector<ShownScene>& all) {
  std::string page = "# Gallery\n\nEach scene at four times of its run, drawn from its own output.\n";
  for (const ShownScene& s : all) {
    page += fmt::format(
        "\n## {0}\n\n{1}\n\n![{0}]({2}.png)\n\n{3}: {4}, {5}, {6} steps, {7} operations; {8} of {9} "
        "expectations hold.",
        markdown_text(s.scene.name), markdown_line(s.scene.about), file_name_of(s.scene.name), markdown_code(s.file),
        s.map, s.scene.integrator, s.steps, s.operations, s.held, s.expected);
    const Expectation& expect = s.scene.expect;
    if (!expect.why.empty()) page += " " + markdown_line(expect.why);
    page += "\n";
    std::string places;
    for (const ExpectedPlace& place : expect.places)
      if (!place.why.empty())
        places += fmt::format("- {}{}: {}\n", place.of_part ? "the part of " : "",
                              markdown_text(s.scene.probes.at(place.probe).name), markdown_line(place.why));
    if (!places.empty()) page += "\n" + places;
  }
  return page;
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
