#include "benchmarks/studies/models/model_times.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_fields.h"
#include "benchmarks/harness/json_text.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "validation/elements/bar_run.h"

namespace dartboard {

std::string TimedBar::name() const { return fmt::format("{}, {} finer, {}", model, finer, poisson); }

DARTBOARD_JSON_FIELDS(TimedBar, model, finer, poisson, integrator, h, steps)

std::string to_argument(const ModelTimesPlan& plan) {
  const nlohmann::json json{{"cubes", plan.bar.cubes}, {"spacing", plan.bar.spacing},
                            {"young", plan.bar.young}, {"density", plan.bar.density},
                            {"bars", plan.bars},       {"process", plan.process},
                            {"rounds", plan.rounds},   {"seed", plan.seed}};
  return json_text(json);
}

ModelTimesPlan from_argument(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    ModelTimesPlan plan;
    json.at("cubes").get_to(plan.bar.cubes);
    json.at("spacing").get_to(plan.bar.spacing);
    json.at("young").get_to(plan.bar.young);
    json.at("density").get_to(plan.bar.density);
    json.at("bars").get_to(plan.bars);
    json.at("process").get_to(plan.process);
    json.at("rounds").get_to(plan.rounds);
    json.at("seed").get_to(plan.seed);
    return plan;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("measure-models: {}", error.what()));
  }
}

void measure_models(const ModelTimesPlan& plan, const std::function<void(const Sample&)>& sink) {
  struct Running {
    BentBar bar;
    std::unique_ptr<Integrator> integrator;
  };
  std::vector<Running> running;
  std::vector<TimedTask> tasks;
  running.reserve(plan.bars.size());  // tasks keep pointers to the elements
  for (const TimedBar& bar : plan.bars) {
    running.push_back({BentBar(plan.bar, bar_body(plan.bar, bar_model(bar.model), bar.finer, bar.poisson)),
                       make_integrator(bar.integrator)});
    Running& r = running.back();
    tasks.push_back({bar.name(),
                     [&r] {
                       r.bar.restore();
                       r.integrator->restart();
                     },
                     [&r, &bar] {
                       for (std::uint64_t k = 0; k < bar.steps; ++k)
                         if (const StepResult result = r.bar.step(*r.integrator, bar.h); !result.ok())
                           throw SolverError(fmt::format("{}: {}", bar.name(), to_string(result)));
                     },
                     [&r] { return r.bar.body().state_hash(); }});
  }
  run_rounds(tasks, {.rounds = plan.rounds, .warmup = 1, .process = plan.process, .seed = plan.seed}, sink);
}

}  // namespace dartboard
