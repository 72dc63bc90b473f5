#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "benchmarks/bench_run.h"
#include "benchmarks/json_text.h"
#include "benchmarks/operation_study.h"
#include "benchmarks/paired.h"
#include "benchmarks/paper_claims.h"
#include "benchmarks/processes.h"
#include "benchmarks/progress.h"
#include "benchmarks/scenes.h"
#include "benchmarks/tell.h"
#include "benchmarks/verb_bench.h"

namespace dartboard {
namespace {

void add_measure_operations(CLI::App& app) {
  struct Options {
    OperationStudyOptions study;
    std::string body;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-operations", "Time operations on one body in this process (used by bench).")
                   ->group("");
  verb->add_option("--process", options->study.process);
  verb->add_option("--times", options->study.times)->check(positive_number());
  verb->add_option("--seed", options->study.seed);
  verb->add_option("BODY", options->body)->required();
  verb->callback([options] {
    const auto print = [](const auto& sample) { tell("{}\n", json_text(nlohmann::json(sample))); };
    study_operations(options->body, options->study, print, print);
  });
}

// ---- what the samples say

using Values = std::vector<double>;  // one of each process

struct Results {
  std::map<std::string, std::vector<OperationSample>> operations;  // by "BODY:OPERATION"
  std::map<std::string, std::vector<BodySample>> bodies;

  /// A quantile of the whole time of an operation [us], or of its first phases, in each process.
  Values quantiles(const std::string& body, const std::string& operation, double p, std::size_t first_phase = 0,
                   std::size_t phases = 99) const {
    Values values;
    const auto found = operations.find(body + ":" + operation);
    if (found == operations.end()) return values;
    for (const OperationSample& s : found->second) {
      Values totals(s.ns[0].size(), 0.0);
      for (std::size_t phase = first_phase; phase < std::min(first_phase + phases, s.ns.size()); ++phase)
        for (std::size_t k = 0; k < totals.size(); ++k) totals[k] += static_cast<double>(s.ns[phase][k]) / 1e3;
      values.push_back(quantile(totals, p));
    }
    return values;
  }
};

double milliseconds(const std::vector<std::int64_t>& ns) { return median(Values(ns.begin(), ns.end())) / 1e6; }

Figure figure_of(const Values& values) { return {median(values), median_interval(values)}; }

Values ratios(const Values& a, const Values& b) {
  Values ratio;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) ratio.push_back(a[k] / b[k]);
  return ratio;
}

std::string show(const Values& values) { return values.empty() ? "-" : fmt::format("{:.3g}", median(values)); }

Table operations_table(const Results& r, const std::vector<std::string>& bodies) {
  Table table({{"operation"},
               {"body"},
               {"map [us]", Align::right},
               {"embeddings [us]", Align::right},
               {"six views [us]", Align::right},
               {"all: median [us]", Align::right},
               {"99th percentile [us]", Align::right},
               {"median over a step", Align::right}});
  for (const std::string& operation : operations())
    for (const std::string& body : bodies) {
      const Values all = r.quantiles(body, operation, 0.5);
      if (all.empty()) continue;
      const double step_us = 1e3 * milliseconds(r.bodies.at(body).front().step_ns);
      table.add_row({operation, body, show(r.quantiles(body, operation, 0.5, 0, 1)),
                     show(r.quantiles(body, operation, 0.5, 1, 1)), show(r.quantiles(body, operation, 0.5, 2)),
                     show(all), show(r.quantiles(body, operation, 0.99)),
                     fmt::format("{:.2g}", median(all) / step_us)});
    }
  return table;
}

Table views_table(const Results& r, const std::vector<std::string>& bodies) {
  Table table({{"view"},
               {"body"},
               {"follow a dissociation [us]", Align::right},
               {"follow a removal [us]", Align::right},
               {"rebuild [ms]", Align::right},
               {"a step [ms]", Align::right}});
  for (std::size_t view = 2; view < operation_phases().size(); ++view)
    for (const std::string& body : bodies) {
      Values rebuild, step;
      for (const BodySample& s : r.bodies.at(body)) {
        rebuild.push_back(milliseconds(s.rebuild_ns[view - 2]));
        step.push_back(milliseconds(s.step_ns));
      }
      table.add_row({operation_phases()[view], body, show(r.quantiles(body, "dissociate, random", 0.5, view, 1)),
                     show(r.quantiles(body, "remove", 0.5, view, 1)), show(rebuild), show(step)});
    }
  return table;
}

const char* const note =
    "Wall time of each operation by itself, on the tetrahedral storage: the median and the 99th percentile are taken "
    "within each process, and the median over processes is shown. Each phase includes one reading of the clock, some "
    "0.03 us. 'split off' copies some hundred tetrahedra out, map and embeddings in one; 'undo' is of a dissociation, "
    "by "
    "the journal, the map alone. A step is one of the classical Runge-Kutta method over the cell arrays.";

Claim claim(std::string id, std::string text, std::string target, std::string measured, std::string interval,
            bool holds) {
  return {.id = std::move(id),
          .text = std::move(text),
          .section = "",
          .paper_value = std::move(target),
          .measured = std::move(measured),
          .bound_or_interval = std::move(interval),
          .verdict = holds ? Verdict::holds : Verdict::falls_short};
}

/// The median of an operation must keep to a bound on every body; the 99th percentiles are told.
Claim bounded(const Results& r, const std::vector<std::string>& bodies, const std::string& id,
              const std::vector<std::string>& names, double bound_us) {
  std::string measured, tails;
  bool holds = true;
  for (const std::string& operation : names)
    for (const std::string& body : bodies) {
      const Values middle = r.quantiles(body, operation, 0.5);
      if (middle.empty()) continue;
      measured += (measured.empty() ? "" : " / ") + show(middle);
      tails += (tails.empty() ? "99th percentile " : " / ") + show(r.quantiles(body, operation, 0.99));
      holds = holds && median(middle) <= bound_us;
    }
  return claim("operation-" + id, fmt::format("{}, with embeddings and six views", fmt::join(names, " / ")),
               fmt::format("<= {:g} us", bound_us), measured + " us", tails, holds);
}

std::vector<Claim> claims_of(const Results& r, const std::vector<std::string>& bodies) {
  std::vector<Claim> claims;
  claims.push_back(bounded(r, bodies, "dissociate", {"dissociate, cut", "dissociate, random"}, 5.0));
  claims.push_back(bounded(r, bodies, "remove", {"remove"}, 10.0));
  claims.push_back(bounded(r, bodies, "tear-fan", {"tear fan"}, 20.0));
  for (const auto& [operation, bound] : {std::pair("dissociate, cut", 1.5), std::pair("dissociate, random", 3.0)}) {
    const Values ratio = ratios(r.quantiles("kuhn-998250", operation, 0.5), r.quantiles("kuhn-2058", operation, 0.5));
    if (ratio.empty()) continue;
    const Figure f = figure_of(ratio);
    claims.push_back(
        claim(fmt::format("operation-{}-scaling", operation == std::string("dissociate, cut") ? "cut" : "random"),
              fmt::format("{}: 998,250 tetrahedra over 2,058", operation), fmt::format("<= {:g}", bound),
              fmt::format("{:.3g}", f.median), to_string(f.interval), f.median <= bound));
  }
  for (const std::string body : {"liver564", "kuhn-105456"}) {
    Values ratio;
    if (const auto found = r.bodies.find(body); found != r.bodies.end())
      for (const BodySample& s : found->second)
        ratio.push_back(milliseconds(s.eventful_step_ns) / milliseconds(s.step_ns));
    if (ratio.empty()) continue;
    const Figure f = figure_of(ratio);
    claims.push_back(claim("operation-step-" + body,
                           "a step with a dissociation and all views over one without, " + body, "<= 2",
                           fmt::format("{:.3g}", f.median), to_string(f.interval), f.median <= 2.0));
  }
  // the paper's claim, by what one operation costs
  Values rebuild;
  for (const BodySample& s : r.bodies.at("liver564")) rebuild.push_back(1e3 * milliseconds(s.rebuild_ns[0]));
  Values removal;
  for (const auto phase : {0, 1}) {
    const Values part = r.quantiles("liver564", "remove", 0.5, static_cast<std::size_t>(phase), 1);
    removal.resize(part.size(), 0.0);
    for (std::size_t k = 0; k < part.size(); ++k) removal[k] += part[k];
  }
  const Figure f = figure_of(ratios(rebuild, removal));
  Claim c = claim_of("rebuild-negligible");
  c.measured = fmt::format("rebuilding takes {:.3g} removals", f.median);
  c.bound_or_interval = to_string(f.interval);
  c.verdict = f.median <= 0.1 ? Verdict::holds : Verdict::falls_short;
  if (f.median > 0.1) c.reason = "rebuilding covers every dart, while an operation touches a few cells";
  claims.push_back(c);
  return claims;
}

// ---- the verb

void bench_operations(const BenchOptions& options, Outcome& outcome) {
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"places of operations", options.seed}};
  facts.input_files = {scene("liver").mesh};
  BenchRun run(options, "operations", facts);

  std::vector<std::string> bodies = operation_bodies();
  if (options.quick) bodies = {"liver564", "kuhn-2058"};
  const int processes = options.quick ? 3 : 6, times = options.quick ? 50 : 200;
  run.say(
      fmt::format("{} bodies, each in {} processes, each operation up to {} times", bodies.size(), processes, times));
  Progress progress("timing", static_cast<std::size_t>(processes) * bodies.size());
  auto lines = run.folder().json_lines("samples.jsonl");
  Results results;
  for (int process = 0; process < processes; ++process)
    for (const std::string& body : bodies) {
      run_self({"measure-operations", "--process", std::to_string(process), "--times", std::to_string(times), "--seed",
                std::to_string(options.seed + static_cast<std::uint64_t>(process)), body},
               [&](std::string_view line) {
                 const auto json = nlohmann::json::parse(line);
                 lines.append(json);
                 if (json.contains("operation")) {
                   auto s = json.get<OperationSample>();
                   results.operations[s.body + ":" + s.operation].push_back(std::move(s));
                 } else {
                   auto s = json.get<BodySample>();
                   results.bodies[s.body].push_back(std::move(s));
                 }
               });
      progress.advance(body);
    }

  const auto claims = claims_of(results, bodies);
  run.say("\n" + to_text(operations_table(results, bodies)) + "\n" + note + "\n");
  run.say("Views: following a change, and starting again\n\n" + to_text(views_table(results, bodies)));
  run.say("Targets\n\n" + to_text(claims));
  run.folder().write_claims(claims);
  run.folder().write_table("operations", "Operations, one by one", operations_table(results, bodies), note);
  run.folder().write_table("views", "Views: following a change, and starting again", views_table(results, bodies));
  // that the paper's sentence does not hold here is a finding about the paper, and no failure of the program
  outcome.exit_code = exit_code(std::span(claims).first(claims.size() - 1));
  run.finish(claims, outcome.exit_code == exit_agrees, "Some target is missed: see above.");
}

}  // namespace

void add_bench_operations(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "operations",
      "Dissociate, remove, tear, refine, split off, undo: by size of the body, beside the time of a step.");
  const auto options = add_bench_options(*verb, "small bodies, fewer processes", "the places of the operations");
  verb->callback([options, &outcome] { bench_operations(*options, outcome); });
  add_measure_operations(app);
}

}  // namespace dartboard
