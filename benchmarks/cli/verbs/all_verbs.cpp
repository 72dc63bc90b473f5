#include "benchmarks/cli/scenes/scene_verbs.h"
#include "benchmarks/cli/studies/settle_with_progress.h"
#include "benchmarks/cli/verbs/verbs.h"

namespace dartboard {

void add_all_verbs(CLI::App& app, Outcome& outcome) {
  add_reproduce(app, outcome);
  add_validate(app, outcome);
  add_bench(app, outcome);
  add_simulate(app, outcome, settle_with_progress);
  add_scene(app, outcome);
  add_tradeoff(app, outcome);
  add_recommend(app, outcome);
  add_extremes(app, outcome);
  add_explain(app, outcome, settle_with_progress);
  add_explain_dt(app, outcome);
  add_gallery(app, outcome);
  add_mesh(app, outcome);
  add_report(app, outcome);
  add_compare(app, outcome);
  add_list(app, outcome);
  add_measure(app, outcome);
}

}  // namespace dartboard
