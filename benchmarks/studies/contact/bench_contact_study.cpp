#include "benchmarks/studies/contact/bench_contact_study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "benchmarks/studies/contact/bench_contact_report.h"

namespace dartboard {

Report contact_bench(const ContactBenchPlan& plan, StudyLog& log) {
  const int processes = plan.quick ? 3 : 8, rounds = plan.quick ? 3 : 24, steps = plan.quick ? 20 : 60;
  ContactCosts costs{
      .samples = {}, .counts = {}, .largest = plan.quick ? std::size_t{10'000} : 1'000'000, .steps = steps};
  log.say(fmt::format("steps and forces, plates of up to {} tetrahedra, in {} processes", costs.largest, processes));
  log.begin("timing", static_cast<std::size_t>(processes));
  for (int process = 0; process < processes; ++process) {
    log.measure(
        {"measure-contact", "--process", std::to_string(process), "--rounds", std::to_string(rounds), "--steps",
         std::to_string(steps), "--largest", std::to_string(costs.largest), "--seed", std::to_string(plan.seed)},
        [&](const nlohmann::json& json) {
          if (json.contains("situation"))
            costs.counts[json.at("situation")] = json.get<ContactCounts>();
          else
            costs.samples.push_back(json.get<Sample>());
        });
    log.advance();
  }
  check_repeats(costs.samples);
  const std::vector<std::string> scenes = factor_scenes();
  log.begin("factors", scenes.size());
  for (const std::string& scene : scenes) {
    costs.factors.push_back(count_factors(scene, plan.quick ? 0.2 : 0.8));
    log.sample(costs.factors.back());
    log.advance(scene);
  }
  return {
      .tables = {{"steps", "A step with contact, and without", contact_steps_table(costs), contact_costs_note()},
                 {"sleep", "A step beside bodies asleep, and of the awake one alone", sleep_table(costs)},
                 {"factors", "A factor that is kept while contacts come and go", factors_table(costs)},
                 {"forces", "Forces of contact, and of elements", contact_forces_table(costs)}},
      .claims = claims_of(costs),
      .limits = {"An implicit integrator keeps its factor while contacts come and go. Updates of rank one for "
                 "contacts, which are not made, would save at most what steps with a change take in iterations over "
                 "other steps."}};
}

}  // namespace dartboard
