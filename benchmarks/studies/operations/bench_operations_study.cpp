#include "benchmarks/studies/operations/bench_operations_study.h"

#include <fmt/format.h>

#include <utility>

#include "benchmarks/studies/operations/bench_operations_report.h"

namespace dartboard {

Report operations_bench(const OperationsBenchPlan& plan, StudyLog& log) {
  std::vector<std::string> bodies = operation_bodies();
  if (plan.quick) bodies = {"liver564", "kuhn-2058"};
  const int processes = plan.quick ? 3 : 6, times = plan.quick ? 50 : 200;
  log.say(
      fmt::format("{} bodies, each in {} processes, each operation up to {} times", bodies.size(), processes, times));
  log.begin("timing", static_cast<std::size_t>(processes) * bodies.size());
  OperationFigures results;
  for (int process = 0; process < processes; ++process)
    for (const std::string& body : bodies) {
      log.measure({"measure-operations", "--process", std::to_string(process), "--times", std::to_string(times),
                   "--seed", std::to_string(plan.seed + static_cast<std::uint64_t>(process)), body},
                  [&](const nlohmann::json& json) {
                    if (json.contains("operation")) {
                      auto s = json.get<OperationSample>();
                      results.operations[s.body + ":" + s.operation].push_back(std::move(s));
                    } else {
                      auto s = json.get<BodySample>();
                      results.bodies[s.body].push_back(std::move(s));
                    }
                  });
      log.advance(body);
    }
  return {.tables = {{"operations", "Operations, one by one", operations_table(results, bodies), operations_note()},
                     {"views", "Views: following a change, and starting again", views_table(results, bodies)}},
          .claims = claims_of(results, bodies)};
}

}  // namespace dartboard
