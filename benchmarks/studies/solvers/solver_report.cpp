#include "benchmarks/studies/solvers/solver_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr double componentwise_gate = 1e-15;
constexpr double edits_gate = 2e-15;
constexpr double crossover_gate = 0.25;
constexpr double step_gate_ms = 0.9;
constexpr std::string_view default_policy = "as by default";

// "by rows, AMD" or "by terms, AMD", whichever is faster, and the same for METIS.
struct UpdateFigures {
  Figure amd, metis;  // again / follows, the same ordering
  double best = 0.0;  // fastest of `again` over fastest of `follows`, medians
};
UpdateFigures figures_of(const SolverTimes& t) {
  UpdateFigures f;
  f.amd = t.ratio("again, AMD", "follows, AMD");
  f.metis = t.ratio("again, METIS", "follows, METIS");
  f.best = std::min(t.milliseconds("again, AMD"), t.milliseconds("again, METIS")) /
           std::min(t.milliseconds("follows, AMD"), t.milliseconds("follows, METIS"));
  return f;
}

void claim_accuracy(const SolverResults& results, std::vector<Claim>& claims) {
  if (results.cells.empty()) return;
  double before = 0.0, after = 0.0;
  std::size_t solved = 0, failed = 0;
  for (const SolvePath path : solve_paths) {
    if (path == SolvePath::conjugate_gradients) continue;
    const PathSummary s = summary_of(results.cells, path);
    before = max_or_nan(before, s.before);
    after = max_or_nan(after, s.after);
    solved += s.solved;
    failed += s.diagnosed;
  }
  claims.push_back({.id = "solve-componentwise",
                    .text =
                        "componentwise backward error of direct solutions after one refinement, masses 1e-6 .. 1e6, "
                        "stiffness 1 .. 1e14, h omega 1e-3 .. 1e8",
                    .paper_value = fmt::format("<= {:.0e}", componentwise_gate),
                    .measured = fmt::format("{:.1e}, {:.1e} before", after, before),
                    .bound_or_interval = fmt::format("{} systems solved, {} ended with a diagnosis", solved, failed),
                    .verdict = verdict_of(met(after <= componentwise_gate && failed == 0))});
  const PathSummary pcg = summary_of(results.cells, SolvePath::conjugate_gradients);
  claims.push_back(
      {.id = "solve-iterative",
       .text = "conjugate gradients that meet their tolerance, after one refinement",
       .paper_value = fmt::format("<= {:.0e}, or a diagnosis", componentwise_gate),
       .measured = fmt::format("{:.1e}, {:.1e} before", pcg.after, pcg.before),
       .bound_or_interval = fmt::format("{} systems solved, {} said not converged", pcg.solved, pcg.diagnosed),
       .verdict = pcg.solved == 0 ? Verdict::not_tested : verdict_of(met(pcg.after <= componentwise_gate))});
}

void claim_indefinite(const SolverResults& results, std::vector<Claim>& claims) {
  if (results.indefinite.empty()) return;
  std::size_t passed = 0;
  std::string worst_case;
  for (const IndefiniteCell& c : results.indefinite)
    if (!c.diagnosed()) {
      ++passed;
      worst_case = fmt::format("{} at h omega {:g}", c.path, c.h_omega);
    }
  claims.push_back({.id = "indefinite-diagnosed",
                    .text = "indefinite matrices, by a dense eigenvalue, that pass as solved",
                    .paper_value = "0",
                    .measured = fmt::format("{} of {}", passed, results.indefinite.size()),
                    .verdict = verdict_of(met(passed == 0)),
                    .reason = worst_case});
}

void claim_edits(const SolverResults& results, std::vector<Claim>& claims) {
  double largest = 0.0;
  std::size_t edits = 0, runs = 0;
  for (const EditRun& run : results.edits) {
    if (run.policy != default_policy) continue;
    ++runs;
    largest = run.failure.empty() ? max_or_nan(largest, run.largest) : std::nan("");
    edits = run.edits;
  }
  if (runs == 0) return;
  claims.push_back(
      {.id = "edits-backward-error",
       .text = fmt::format("normwise backward error during {} edits, as the factor follows by default", edits),
       .paper_value = fmt::format("<= {:.0e}", edits_gate),
       .measured = fmt::format("{:.1e}", largest),
       .verdict = verdict_of(met(largest <= edits_gate))});
}

void claim_updates(const SolverResults& results, std::vector<Claim>& claims) {
  for (const SolverTimes& t : results.updates) {
    const bool small = t.vertices<1000, large = t.vertices> 3000;
    const double gate = large ? 4.0 : 2.0;
    const UpdateFigures f = figures_of(t);
    Claim claim{.id = fmt::format("update-{}{}", t.vertices, t.stretched ? "-stretched" : ""),
                .text = fmt::format("one interior vertex dissociated, {}: analysing and factoring again over following",
                                    t.body)};
    claim.paper_value = small || large ? fmt::format(">= {:g}", gate) : "between the others";
    claim.measured = fmt::format("{:.2f} with AMD, {:.2f} with METIS, {:.2f} the best of each", f.amd.median,
                                 f.metis.median, f.best);
    claim.bound_or_interval = fmt::format("AMD {}, over the rounds of one process", to_string(f.amd.interval));
    judge(claim, at_least(f.amd, gate));
    claims.push_back(claim);
  }
}

/// The deviation of the prediction from the measurement, which lies between the runs on both sides of it.
Figure deviation_of(const Crossover& c) {
  const auto off = [&c](double phase) { return c.predicted_phase / phase - 1.0; };
  const auto enclosure = c.enclosure();
  if (!enclosure) return {c.deviation(), {c.deviation(), c.deviation(), 0.0, false}};
  return {c.deviation(), {off(enclosure->high), off(enclosure->low), 1.0, true}};
}

void claim_crossovers(const SolverResults& results, std::vector<Claim>& claims) {
  if (results.crossovers.empty()) return;
  Claim claim{.id = "break-even-law",
              .text = fmt::format("T omega_max where implicit becomes cheaper than explicit at an error of {:g} edges, "
                                  "predicted against measured",
                                  results.crossover_error)};
  claim.paper_value = fmt::format("within {:.0f} %", 100.0 * crossover_gate);
  Met met = Met::yes;
  for (const Crossover& c : results.crossovers) {
    const char* const comma = claim.measured.empty() ? "" : "; ";
    if (!c.failure.empty()) {
      met = Met::no;
      claim.measured += fmt::format("{}{}: {}", comma, c.vertices, c.failure);
      continue;
    }
    const Figure off = deviation_of(c);
    met = std::min({met, at_least(off, -crossover_gate), at_most(off, crossover_gate)});
    claim.measured += fmt::format("{}{}: {:+.0f} %", comma, c.vertices, 100.0 * off.median);
    claim.bound_or_interval +=
        fmt::format("{}{}: {}", comma, c.vertices,
                    off.interval.reached ? fmt::format("[{:+.0f}, {:+.0f}] %, between runs on both sides",
                                                       100.0 * off.interval.low, 100.0 * off.interval.high)
                                         : "no run on one of the sides");
  }
  judge(claim, met);
  claims.push_back(claim);
}

void claim_steps(const SolverResults& results, std::vector<Claim>& claims) {
  if (results.steps.empty()) return;
  const SolverTimes& t = results.steps.front();
  const Figure ms = t.time_ms("conjugate gradients");
  Claim claim{.id = "implicit-step",
              .text = fmt::format("implicit step of {} by conjugate gradients at a residual of 1e-6", t.body),
              .paper_value = fmt::format("<= {:g} ms", step_gate_ms),
              .measured = fmt::format("{:.2f} ms", ms.median),
              .bound_or_interval =
                  fmt::format("{}, over the rounds of one process; fresh factor {:.2f} ms, kept {:.2f} ms",
                              to_string(ms.interval), t.milliseconds("fresh factor"), t.milliseconds("kept factor"))};
  judge(claim, at_most(ms, step_gate_ms));
  claims.push_back(std::move(claim));
}

}  // namespace

std::vector<Claim> claims_of(const SolverResults& results) {
  std::vector<Claim> claims;
  claim_accuracy(results, claims);
  claim_indefinite(results, claims);
  claim_edits(results, claims);
  claim_updates(results, claims);
  claim_crossovers(results, claims);
  claim_steps(results, claims);
  return claims;
}

void for_each_sample(const SolverResults& results, const std::function<void(const nlohmann::json&)>& sink) {
  for (const SolveCell& c : results.cells)
    sink({{"study", "accuracy"},
          {"masses", c.masses},
          {"stiffnesses", c.stiffnesses},
          {"state", c.state},
          {"h_omega", c.h_omega},
          {"path", name(c.path)},
          {"status", to_string(c.status)},
          {"before", number(c.before)},
          {"after", number(c.after)},
          {"normwise", number(c.normwise)},
          {"updated", c.was_updated},
          {"iterations", c.iterations}});
  for (const IndefiniteCell& c : results.indefinite)
    sink({{"study", "indefinite"},
          {"path", c.path},
          {"h_omega", c.h_omega},
          {"least", c.least},
          {"status", to_string(c.status)}});
  for (const EditRun& r : results.edits)
    sink({{"study", "edits"},
          {"policy", r.policy},
          {"stretch", r.stretch},
          {"edits", r.edits},
          {"rank_one_updates", r.counters.rank_one_updates},
          {"rows_replaced", r.counters.rows_replaced},
          {"factorisations", r.counters.factorisations},
          {"largest", number(r.largest)},
          {"last", number(r.last)},
          {"componentwise", number(r.componentwise)},
          {"follow_s", r.follow_s},
          {"solve_s", r.solve_s},
          {"failure", r.failure}});
  for (const auto* times : {&results.updates, &results.steps})
    for (const SolverTimes& t : *times)
      for (const Sample& s : t.samples) {
        nlohmann::json json = s;
        json["study"] = times == &results.updates ? "updates" : "steps";
        json["body"] = t.body;
        sink(json);
      }
  for (const Crossover& c : results.crossovers)
    for (const CostPair& p : c.costs)
      sink({{"study", "crossover"},
            {"vertices", c.vertices},
            {"factor", p.factor},
            {"phase", p.phase},
            {"explicit_s", p.explicit_s},
            {"explicit_error", p.explicit_error},
            {"implicit", p.implicit_method},
            {"implicit_s", p.implicit_s},
            {"implicit_steps", p.implicit_steps},
            {"predicted_phase", number(c.predicted_phase)}});
}

Plot crossover_plot(std::span<const Crossover> crossovers) {
  Plot plot;
  plot.title = "Where implicit becomes cheaper than explicit";
  plot.x_axis = "vertices";
  plot.y_axis = "T omega_max at the crossover";
  PlotSeries predicted{.title = "predicted by the law", .points = {}, .colour = "#1f77b4", .symbol = 6};
  PlotSeries measured{.title = "measured", .points = {}, .colour = "#d62728", .symbol = 7};
  predicted.size = measured.size = 1.6;
  predicted.width = measured.width = 1.4;
  predicted.dash = "-";
  double low = 1e300, high = 0.0, fewest = 1e300, most = 0.0;
  for (const Crossover& c : crossovers) {
    if (!c.failure.empty()) continue;
    const auto n = static_cast<double>(c.vertices);
    predicted.points.push_back({n, c.predicted_phase});
    measured.points.push_back({n, c.measured_phase, fmt::format("{:+.0f} %", 100.0 * c.deviation())});
    low = std::min({low, c.predicted_phase, c.measured_phase});
    high = std::max({high, c.predicted_phase, c.measured_phase});
    fewest = std::min(fewest, n);
    most = std::max(most, n);
  }
  plot.x_low = fewest / 1.5;
  plot.x_high = most * 1.8;
  plot.y_low = low / 2.0;
  plot.y_high = high * 2.0;
  plot.series = {predicted, measured};
  return plot;
}

}  // namespace dartboard
