#include "benchmarks/studies/models/model_advice_study.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/clock.h"

namespace dartboard {

std::string in_words(const ClampedBar& bar, const ModelAdvice& advice) {
  const MeasuredModel* pick = advice.pick();
  if (pick == nullptr)
    return fmt::format("Nothing is recommended for an error of {:g}: {}.", advice.error, advice.why_not);
  const ModelTrial& last = advice.trials.back();
  return fmt::format(
      "For an error of {:g} of how far the bar is bent, over one period: {} with sides of {:.3g} m ({} nodes), {} "
      "with a step of {:.3g} s. Measured: an error of {:.3g} (predicted {:.3g}), {:.3g} s of processor time for a "
      "simulated second (predicted {:.3g}).",
      advice.error, in_words(pick->model), bar.spacing / pick->finer, pick->nodes, pick->method.integrator, pick->h,
      pick->errors.motion, last.predicted_error, pick->rough_cost(), last.predicted_cost);
}

Table trends_table(const ModelAdvice& advice) {
  Table table({{"model"},
               {"error of a mesh", Align::right},
               {"of a finer one", Align::right},
               {"order", Align::right},
               {"needs cubes finer by", Align::right},
               {"predicted s per simulated s", Align::right}});
  for (const ModelTrend& t : advice.trends) {
    const int finer = t.finer_for(advice.error);
    table.add_row({in_words(t.model), fmt::format("{:.3g}", t.coarse_error), fmt::format("{:.3g}", t.fine_error),
                   fmt::format("{:.1f}", t.order()), finer == 0 ? "no mesh" : fmt::format("{}", finer),
                   finer == 0 ? "" : fmt::format("{:.3g}", t.cost_at(finer))});
  }
  return table;
}

nlohmann::ordered_json json_of(const ClampedBar& bar, const ModelAdvice& advice) {
  nlohmann::ordered_json json{{"error", advice.error}};
  if (const MeasuredModel* pick = advice.pick())
    json["pick"] = {{"model", in_words(pick->model)},
                    {"side", bar.spacing / pick->finer},
                    {"nodes", pick->nodes},
                    {"integrator", pick->method.integrator},
                    {"step", pick->h},
                    {"measured_error", pick->errors.motion},
                    {"predicted_error", advice.trials.back().predicted_error},
                    {"cost", pick->rough_cost()},
                    {"predicted_cost", advice.trials.back().predicted_cost}};
  else
    json["why_not"] = advice.why_not;
  json["tried"] = advice.trials.size();
  return json;
}

Report model_advice_study(const ModelsPlan& plan, const std::vector<double>& errors, StudyLog& log) {
  Report report{.numbers = nlohmann::ordered_json::array()};
  for (const std::string& omission : plan.of.omissions) log.say(omission);
  for (const double error : errors) {
    log.begin(fmt::format("models for an error of {:g}", error), 0);
    const ModelAdvice advice = advise_model(plan.of.bar, bar_meshes(plan.of.bar, false), plan.of.poisson, error,
                                            thread_cpu_ns, [&log](const std::string& what) { log.advance(what); });
    log.say(in_words(plan.of.bar, advice));
    report.tables.push_back(
        {"", fmt::format("What two meshes of each model say of an error of {:g}", error), trends_table(advice)});
    report.numbers.push_back(json_of(plan.of.bar, advice));
    if (advice.pick() == nullptr)
      report.disagreements.push_back(fmt::format("No model is recommended for an error of {:g}.", error));
  }
  return report;
}

}  // namespace dartboard
