#include <memory>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/contact/bench_contact_study.h"
#include "benchmarks/studies/contact/contact_costs.h"

namespace dartboard {
namespace {

// A verb that help does not show.
void add_measure_contact(CLI::App& app) {
  auto options = std::make_shared<ContactCostPlan>();
  auto* verb = app.add_subcommand("measure-contact", "Time contact in this process (used by bench).")->group("");
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(positive_number());
  verb->add_option("--steps", options->steps)->check(positive_number());
  verb->add_option("--largest", options->largest);
  verb->add_option("--seed", options->seed);
  verb->callback([options] {
    const auto print = [](const auto& sample) { tell("{}\n", json_text(nlohmann::json(sample))); };
    measure_contact_costs(*options, print, print);
  });
}

}  // namespace

void add_bench_contact(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "contact", "Contact at rest, in a pile, after a cut, compared with steps and forces; its growth with the body.");
  auto options = study_options(*verb, {.quick = "small plates, fewer processes",
                                       .seed = "the order of the tasks, and the places in the pile",
                                       .goes_on = true});
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"order of the tasks, places in the pile", options->seed}},
                   .input_files = {source_folder() / "benchmarks/meshes/liver564.mesh"}};
    run_study(
        *options, {.label = "contact-costs", .facts = facts},
        [&](StudyLog& log) {
          return contact_bench({options->quick, options->seed}, log);
        },
        outcome);
  });
  add_measure_contact(app);
}

}  // namespace dartboard
