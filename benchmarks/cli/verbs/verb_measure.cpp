#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/reproduce/measure.h"
#include "core/plain/error.h"
#include "validation/contenders/contenders.h"

namespace dartboard {

// The child's side, a verb that help does not show: prints one sample per line.
void add_measure(CLI::App& app, Outcome&) {
  struct Options {
    std::string scene;
    PairedOptions paired;
    std::vector<std::string> tasks;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure", "Time contenders in this process (used by reproduce).")->group("");
  verb->add_option("--scene", options->scene)->required();
  verb->add_option("--process", options->paired.process);
  verb->add_option("--rounds", options->paired.rounds)->check(positive_number());
  verb->add_option("--seed", options->paired.seed);
  verb->add_option("CONTENDER:STEPS", options->tasks)->required();
  verb->callback([options] {
    const Problem problem = paper_body(options->scene).make();
    std::vector<std::unique_ptr<ContenderBody>> simulations;
    std::vector<TimedTask> tasks;
    std::map<std::string, int> steps_of;
    for (const std::string& task : options->tasks) {
      const auto colon = task.find(':');
      const std::string id = task.substr(0, colon);
      const int steps = colon == std::string::npos ? 0 : std::atoi(task.c_str() + colon + 1);
      if (steps < 1) throw InputError(fmt::format("'{}' is not CONTENDER:STEPS with at least one step", task));
      simulations.push_back(contender(id).make(problem));
      ContenderBody& s = *simulations.back();
      auto start = std::make_shared<PointState>(s.state());
      steps_of[id] = steps;
      tasks.push_back({id, [&s, start] { s.set_state(*start); }, [&s, steps] { s.step(steps); },
                       [&s] { return state_hash(s.state()); }});
    }
    run_rounds(tasks, options->paired, [&](const Sample& sample) {
      tell("{}\n", json_text(nlohmann::json(StepSample{sample, steps_of[sample.task]})));
    });
  });
}

}  // namespace dartboard
