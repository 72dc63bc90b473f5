#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/studies/solvers/solver_report.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {

PathSummary summary_of(std::span<const SolveCell> cells, SolvePath path) {
  PathSummary s;
  for (const SolveCell& c : cells) {
    if (c.path != path) continue;
    if (c.status != SolveStatus::ok) {
      ++s.diagnosed;
      ++s.diagnoses[std::string(to_string(c.status))];
      continue;
    }
    ++s.solved;
    s.updated += c.was_updated;
    s.before = max_or_nan(s.before, c.before);
    s.normwise = max_or_nan(s.normwise, c.normwise);
    s.after = max_or_nan(s.after, c.after);
  }
  return s;
}

namespace {

NamedTable accuracy_table(const SolverResults& results) {
  Table table({{"path"},
               {"solved", Align::right},
               {"updated", Align::right},
               {"componentwise, before", Align::right},
               {"after one refinement", Align::right},
               {"normwise, before", Align::right},
               {"ended with a diagnosis"}});
  for (const SolvePath path : solve_paths) {
    const PathSummary s = summary_of(results.cells, path);
    std::string diagnoses;
    for (const auto& [what, count] : s.diagnoses)
      diagnoses += fmt::format("{}{} {}", diagnoses.empty() ? "" : ", ", count, what);
    table.add_row({std::string(name(path)), std::to_string(s.solved),
                   path == SolvePath::updated ? std::to_string(s.updated) : "", fmt::format("{:.1e}", s.before),
                   fmt::format("{:.1e}", s.after), fmt::format("{:.1e}", s.normwise), diagnoses});
  }
  return {
      "accuracy", "Backward errors over all scales, the largest", std::move(table),
      "Bodies at rest, stretched and crushed; a refinement costs a product with the matrix in extended precision and "
      "a second solution. Where an update would take away more than a thousand times what it leaves, the factor is "
      "found again: those rows are solved but not updated. No verdict comes from a condition estimate."};
}

NamedTable indefinite_table(const SolverResults& results) {
  Table table({{"path"}, {"matrices", Align::right}, {"diagnosed", Align::right}, {"least eigenvalue", Align::right}});
  std::vector<std::string> paths;
  for (const IndefiniteCell& c : results.indefinite)
    if (std::ranges::find(paths, c.path) == paths.end()) paths.push_back(c.path);
  for (const std::string& path : paths) {
    std::size_t all = 0, diagnosed = 0;
    double least = -1.0;
    for (const IndefiniteCell& c : results.indefinite) {
      if (c.path != path) continue;
      ++all;
      diagnosed += c.diagnosed();
      least = std::max(least, c.least);
    }
    table.add_row({path, std::to_string(all), std::to_string(diagnosed), fmt::format("{:.1e}", least)});
  }
  return {"indefinite", "Indefinite matrices", std::move(table),
          "The least eigenvalue is that nearest to zero, over the largest of its matrix, by a dense solver."};
}

NamedTable edits_table(const SolverResults& results) {
  Table table({{"policy"},
               {"body"},
               {"edits", Align::right},
               {"terms", Align::right},
               {"rows", Align::right},
               {"factorisations", Align::right},
               {"normwise, largest", Align::right},
               {"componentwise", Align::right},
               {"ms an edit", Align::right},
               {"ms a solution", Align::right}});
  for (const EditRun& r : results.edits)
    table.add_row({r.policy, r.stretch == 0.0 ? "at rest" : "stretched", std::to_string(r.edits),
                   std::to_string(r.counters.rank_one_updates), std::to_string(r.counters.rows_replaced),
                   std::to_string(r.counters.factorisations),
                   r.failure.empty() ? fmt::format("{:.1e}", r.largest) : r.failure,
                   fmt::format("{:.1e}", r.componentwise), fmt::format("{:.3f}", 1e3 * r.follow_s),
                   fmt::format("{:.3f}", 1e3 * r.solve_s)});
  return {
      "edits", "A factor that follows edits", std::move(table),
      "Springs removed and put back, interior vertices dissociated and joined again. Each row replaced counts as two "
      "rank-one updates towards the renewal. A matrix is assembled for every edit whatever the policy; that is not "
      "counted."};
}

NamedTable updates_table(const SolverResults& results) {
  Table table({{"body"}, {"terms", Align::right}, {"task"}, {"ms", Align::right}, {"again / task, same ordering"}});
  for (const SolverTimes& t : results.updates)
    for (const std::string& task : t.tasks) {
      const std::string again = task.ends_with("AMD") ? "again, AMD" : "again, METIS";
      table.add_row({t.body, std::to_string(t.terms), task, fmt::format("{:.2f}", t.milliseconds(task)),
                     task == again ? "" : to_string(t.ratio(again, task))});
    }
  std::string terms;
  for (const SolverTimes& t : results.updates)
    terms += fmt::format("{}{} for {}", terms.empty() ? "" : ", ", t.terms, t.body);
  return {
      "updates", "Following one dissociated vertex", std::move(table),
      "Why stretched bodies differ: at rest a spring is one rank-one term, since nothing resists across it; stretched "
      "it is three. Terms: " +
          terms +
          ". What moves from a vertex to its twin leaves the diagonal blocks of all other vertices as they are, so only "
          "the rows of the two change, stretched or not: replacing those costs the same in both states. `follows` "
          "chooses by predicted cost. Intervals are over the rounds of one process: they say how steady it was, not "
          "what another process would find."};
}

NamedTable crossover_table(const SolverResults& results) {
  Table table({{"vertices", Align::right},
               {"springs", Align::right},
               {"explicit"},
               {"us a step", Align::right},
               {"implicit"},
               {"steps", Align::right},
               {"solutions a step", Align::right},
               {"us a solution", Align::right},
               {"overhead", Align::right},
               {"T omega_max, predicted", Align::right},
               {"measured", Align::right},
               {"deviation", Align::right},
               {"stiffness factor", Align::right}});
  for (const Crossover& c : results.crossovers) {
    const bool found = c.failure.empty();
    table.add_row({std::to_string(c.vertices), std::to_string(c.springs), c.explicit_method,
                   fmt::format("{:.1f}", 1e6 * c.explicit_step_s), c.implicit_method,
                   fmt::format("{:.1f}", c.predicted_steps), fmt::format("{:.1f}", c.work.solves),
                   fmt::format("{:.0f}", 1e6 * c.prices.solve), fmt::format("{:.2f}", c.overhead),
                   fmt::format("{:.3g}", c.predicted_phase),
                   found ? fmt::format("{:.3g}", c.measured_phase) : c.failure,
                   found ? fmt::format("{:+.0f} %", 100.0 * c.deviation()) : "",
                   found ? fmt::format("{:.2g}", c.measured_factor) : ""});
  }
  return {"crossover", fmt::format("Explicit or implicit, at an error of {:g} edges", results.crossover_error),
          std::move(table),
          "A box whose middle tenth is stiffer by a factor. Law: explicit steps T omega_max / (0.9 z_lim), implicit "
          "N (f t_force + l t_linearisation + s t_solve) + q t_factorisation, times what a pilot took over the law for "
          "its own counts. Predicted from two implicit pilots at a "
          "factor of 1e4, and two more where those put the crossover; measured by runs on both sides of it."};
}

NamedTable steps_table(const SolverResults& results) {
  Table table({{"body"}, {"solver"}, {"ms", Align::right}, {"over conjugate gradients"}});
  for (const SolverTimes& t : results.steps)
    for (const std::string& task : t.tasks)
      table.add_row(
          {t.body, task, fmt::format("{:.3f}", t.milliseconds(task)), to_string(t.ratio(task, "conjugate gradients"))});
  return {
      "steps", "One linearly implicit step", std::move(table),
      "Conjugate gradients to a residual of 1e-6; a kept factor preconditions them to 1e-12. Intervals are over the "
      "rounds of one process: they say how steady it was, not what another process would find."};
}

}  // namespace

std::vector<NamedTable> tables_of(const SolverResults& results) {
  std::vector<NamedTable> tables;
  if (!results.cells.empty()) tables.push_back(accuracy_table(results));
  if (!results.indefinite.empty()) tables.push_back(indefinite_table(results));
  if (!results.edits.empty()) tables.push_back(edits_table(results));
  if (!results.updates.empty()) tables.push_back(updates_table(results));
  if (!results.crossovers.empty()) tables.push_back(crossover_table(results));
  if (!results.steps.empty()) tables.push_back(steps_table(results));
  return tables;
}

}  // namespace dartboard
