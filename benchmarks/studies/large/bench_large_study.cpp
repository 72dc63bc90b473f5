#include "benchmarks/studies/large/bench_large_study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "benchmarks/studies/large/bench_large_report.h"

namespace dartboard {

Report large_bench(const LargeBenchPlan& plan, StudyLog& log) {
  const int processes = plan.quick ? 3 : 6;
  LargeFigures figures{.sides = large_sides(plan.quick), .times = {}, .counts = {}};
  const auto measure = [&](std::size_t side, int process, bool start) {
    std::vector<std::string> arguments{"measure-large", "--side", std::to_string(side), "--process",
                                       std::to_string(process)};
    if (start) arguments.emplace_back("--start");
    log.measure(arguments, [&](const nlohmann::json& json) {
      if (json.contains("part"))
        figures.times.push_back(json.get<LargeTime>());
      else
        figures.counts.push_back(json.get<LargeCounts>());
    });
    log.advance(fmt::format("{} tetrahedra", tetrahedra_of(side)));
  };
  log.say(fmt::format("boxes of up to {} tetrahedra, each in {} processes but the largest, which is run once",
                      tetrahedra_of(figures.sides.back()), processes));
  std::size_t runs = 0;
  const auto processes_of = [processes](std::size_t side) { return side == largest_side ? 1 : processes; };
  for (const std::size_t side : figures.sides) runs += 2 * static_cast<std::size_t>(processes_of(side));
  log.begin("timing", runs);
  for (const std::size_t side : figures.sides)
    for (int process = 0; process < processes_of(side); ++process)
      for (const bool start : {false, true}) measure(side, process, start);
  return {.tables = {{"parts", "A run of a large body, part by part", parts_table(figures), large_note()},
                     {"memory", "Its cut and its memory", memory_table(figures)}},
          .claims = claims_of(figures),
          .pictures = {{"large", large_plot(figures)}}};
}

}  // namespace dartboard
