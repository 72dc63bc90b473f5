// dartboard tradeoff: what accuracy costs, on every scene of the study, with every integrator.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/json_number.h"
#include "benchmarks/json_text.h"
#include "benchmarks/manifest.h"
#include "benchmarks/run_folder.h"
#include "benchmarks/study_names.h"
#include "benchmarks/tell.h"
#include "benchmarks/tradeoff_report.h"
#include "benchmarks/work_precision_plot.h"
#include "core/plain/error.h"
#include "validation/scene_of_file.h"
#include "validation/work_precision.h"

namespace dartboard {
namespace {

struct Options {
  std::string scene, out;
  std::vector<std::string> only;
  bool all = false, quick = false, json = false, solvers = false;
  double most_s = 0.0;
  std::uint64_t seed = 1;
};

// JSON has no number for what is not finite.
nlohmann::json json_of(const WorkCounters& w) {
  return {{"steps", w.steps},
          {"failed_steps", w.failed_steps},
          {"rejected_steps", w.rejected_steps},
          {"force_evaluations", w.force_evaluations},
          {"damping_sweeps", w.damping_sweeps},
          {"assemblies", w.assemblies},
          {"analyses", w.analyses},
          {"factorisations", w.factorisations},
          {"solves", w.solves},
          {"rank_one_updates", w.rank_one_updates},
          {"newton_iterations", w.newton_iterations},
          {"linear_iterations", w.linear_iterations},
          {"line_search_trials", w.line_search_trials},
          {"projections", w.projections},
          {"factor_nonzeros", w.factor_nonzeros}};
}

nlohmann::json json_of(const std::string& scene, const WorkPoint& p) {
  nlohmann::json json{{"scene", scene},
                      {"integrator", p.contender},
                      {"peer", p.peer},
                      {"h", number(p.h)},
                      {"h_omega", number(p.h_omega)},
                      {"work", json_of(p.work)},
                      {"costs", p.costs},
                      {"cost", number(p.cost)},
                      {"cpu_s", number(p.cpu_s)},
                      {"force_s", number(p.force_s)},
                      {"under_floor", p.under_floor}};
  if (p.setting.steps > 0)
    json["steps"] = p.setting.steps;
  else
    json["tolerance"] = p.setting.tolerance;
  if (p.failed()) {
    json["code"] = p.code;
    json["diagnosis"] = p.diagnosis;
  } else {
    json["errors"] = {{"x", number(p.errors.x)},
                      {"x_p95", number(p.errors.x_p95)},
                      {"x_largest", number(p.errors.x_largest)},
                      {"v", number(p.errors.v)},
                      {"energy", number(p.errors.energy)},
                      {"momentum", number(p.errors.momentum)},
                      {"angular", number(p.errors.angular)}};
  }
  return json;
}

std::vector<double> decades(const WorkPrecision& study) {
  std::vector<double> errors;
  for (int k = 1; k <= 13; ++k) {
    const double error = std::pow(10.0, -k);
    if (error < study.reference.floor) break;
    errors.push_back(error);
  }
  return errors;
}

std::string show(double x) { return std::isfinite(x) ? fmt::format("{:.3g}", x) : "-"; }

Table winners_table(const WorkPrecision& study) {
  Table table({{"error [edges]"},
               {"cheapest"},
               {"cost [evaluations' time]", Align::right},
               {"force evaluations", Align::right},
               {"seconds", Align::right},
               {"runner-up"},
               {"costs", Align::right},
               {"cvode-adams costs", Align::right}});
  double force_s = 0.0;
  for (const WorkPoint& p : study.points)
    if (force_s == 0.0 || p.force_s < force_s) force_s = p.force_s;
  const auto ratio = [](double cost, double best) {
    return std::isfinite(cost) ? fmt::format("{:.2f} x", cost / best) : "-";
  };
  for (const Winner& w : winners(study.points, decades(study))) {
    const double peer = cost_at(study.points, "cvode-adams", w.error);
    if (w.contender.empty())
      table.add_row({fmt::format("{:.0e}", w.error), "none", "-", "-", "-", "-", "-", "-"});
    else
      table.add_row({fmt::format("{:.0e}", w.error), w.contender, fmt::format("{:.0f}", w.cost),
                     fmt::format("{:.0f}", w.evaluations), show(w.cost * force_s),
                     w.runner_up.empty() ? "-" : w.runner_up,
                     w.runner_up.empty() ? "-" : ratio(w.runner_up_cost, w.cost), ratio(peer, w.cost)});
  }
  return table;
}

Table regrets_table(const WorkPrecision& study) {
  const std::vector<double> errors = decades(study);
  std::vector<Column> columns{{"always"}};
  for (const double error : errors) columns.push_back({fmt::format("{:.0e}", error), Align::right});
  columns.push_back({"worst", Align::right});
  Table table(columns);
  for (const Regret& r : regrets(study.points, errors)) {
    std::vector<std::string> row{r.contender + (r.peer ? " (peer)" : "")};
    for (const double x : r.of_error) row.push_back(std::isfinite(x) ? fmt::format("{:.3g}", x) : "-");
    row.push_back(show(r.worst));
    table.add_row(row);
  }
  return table;
}

Table points_table(const WorkPrecision& study) {
  Table table({{"integrator"},
               {"h omega_max", Align::right},
               {"tolerance", Align::right},
               {"E_x", Align::right},
               {"E_v", Align::right},
               {"energy", Align::right},
               {"force evaluations", Align::right},
               {"factorisations", Align::right},
               {"solves", Align::right},
               {"cost [evaluations' time]", Align::right},
               {"range"},
               {"standing"}});
  for (const WorkPoint& p : study.points) {
    const bool bad = p.failed();
    table.add_row(
        {p.contender, show(p.h_omega), p.setting.steps > 0 ? "" : fmt::format("{:.0e}", p.setting.tolerance),
         bad ? "" : fmt::format("{:.2e}", p.errors.x), bad ? "" : fmt::format("{:.2e}", p.errors.v),
         bad ? "" : fmt::format("{:.2e}", p.errors.energy), std::to_string(p.work.force_evaluations),
         std::to_string(p.work.factorisations), std::to_string(p.work.solves), fmt::format("{:.0f}", p.cost),
         fmt::format("{:.0f} .. {:.0f}", p.cost_low(), p.cost_high()),
         bad ? p.diagnosis : fmt::format("{}{}", name(p.standing), p.under_floor ? ", under the floor" : "")});
  }
  return table;
}

/// Each line as it may stand there.
std::string bullets(const std::vector<std::string>& lines, std::string (*escaped)(std::string_view)) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("- {}\n", escaped(line));
  return text;
}

constexpr std::string_view reading =
    "Costs are processor time, in units of the time of one evaluation of the forces of the same system, timed in turn "
    "with the "
    "runs; a run includes all of its factorisations and what its scene does to the body. Between two steps the cost is "
    "interpolated on the log-log scale. The regret of a fixed choice is its cost over that of the best; '-' where it "
    "does not reach the error. A point is dominated when another is no less accurate and its slowest repetition is "
    "faster than the fastest of the point.";

/// Those that take part.
///
/// throws  InputError for a name that none has
std::vector<TradeoffContender> contenders_of(const Options& options) {
  std::vector<TradeoffContender> contenders = tradeoff_contenders(options.solvers);
  std::string known;
  for (const TradeoffContender& c : contenders) known += fmt::format("{}'{}'", known.empty() ? "" : ", ", c.name);
  for (const std::string& name : options.only)
    if (std::ranges::find(contenders, name, &TradeoffContender::name) == contenders.end())
      throw InputError(fmt::format("--only: no integrator '{}' takes part; expected some of {}", name, known));
  if (!options.only.empty())
    std::erase_if(contenders, [&](const TradeoffContender& c) {
      return std::ranges::find(options.only, c.name) == options.only.end();
    });
  return contenders;
}

WorkPrecision study_scene(const std::string& scene_name, const Options& options, const RunFolder& folder,
                          JsonLines& samples, Outcome& outcome, const std::function<void(const std::string&)>& say) {
  const TradeoffScene scene =
      find_scene(scene_name, std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes");
  say(fmt::format("{}: {}; T omega_max = {:.4g}", one_line(scene.name), one_line(scene.what, 400),
                  scene.duration * scene.fastest_rate));
  const CpuClock clock = thread_cpu_ns;
  const SceneReference reference = reference_of(
      scene, clock,
      {.oracle_s = options.quick ? 6.0 : 60.0, .self_converged_s = options.quick ? 4.0 : 40.0, .gain = !options.quick});
  say(fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", reference.what, reference.floor, reference.cpu_s));

  WorkPrecisionOptions how;
  how.seed = options.seed;
  how.most_s = options.most_s > 0.0 ? options.most_s : options.quick ? 0.4 : 8.0;
  if (options.quick) {
    how.fewest_repetitions = 2;
    how.repetitions_s = 0.05;
  }
  const std::vector<TradeoffContender> contenders = contenders_of(options);
  WorkPrecision study = work_precision(scene, reference, contenders, clock, how,
                                       [&](const WorkPoint& p) { samples.append(json_of(scene.name, p)); });
  if (reference.gain > 0.0) say(fmt::format("a small disturbance grows by {:.3g}", reference.gain));
  if (!options.solvers)
    study.omissions.emplace_back(
        "Implicit methods solve with a kept factor only; --solvers adds fresh factors and conjugate gradients.");
  study.omissions.emplace_back(
      "Steps are powers of two of the distance of checkpoints; the largest stable step lies "
      "up to a factor of two above the largest tried.");
  study.omissions.emplace_back("No multirate, exponential or multigrid method takes part.");

  say("\n" + to_text(winners_table(study)) + "\nRegret of a fixed choice\n\n" + to_text(regrets_table(study)) +
      "\nOmissions\n\n" + bullets(study.omissions, terminal_text));
  // what the files are called
  const std::string stem = file_name_of(scene.name);
  folder.write(stem + ".md",
               fmt::format("# The trade between speed and accuracy: {}\n\n{}. T omega_max = {:.4g}; {} vertices, {} "
                           "springs.\nReference: {}; errors below {:.1e} edges say nothing.\n\n![diagram]({}.svg)\n\n"
                           "## The cheapest method for an error\n\n{}\n## Regret of a fixed choice\n\n{}\n{}\n\n## All "
                           "runs\n\n{}\n## Omissions\n\n{}",
                           markdown_text(scene.name), markdown_line(scene.what), scene.duration * scene.fastest_rate,
                           study.vertices, study.springs, reference.what, reference.floor, stem,
                           to_markdown(winners_table(study)), to_markdown(regrets_table(study)), reading,
                           to_markdown(points_table(study)), bullets(study.omissions, markdown_text)));
  if (const std::string trouble = draw(work_precision_plot(study), folder.path(), stem); !trouble.empty()) {
    say(trouble);
    picture_missing(outcome, trouble);
  }
  return study;
}

nlohmann::json summary_of(const WorkPrecision& study) {
  nlohmann::json best = nlohmann::json::array();
  for (const Winner& w : winners(study.points, decades(study)))
    best.push_back({{"error", w.error},
                    {"integrator", w.contender},
                    {"cost", number(w.cost)},
                    {"force_evaluations", number(w.evaluations)},
                    {"runner_up", w.runner_up},
                    {"runner_up_cost", number(w.runner_up_cost)},
                    {"cvode_adams_cost", number(cost_at(study.points, "cvode-adams", w.error))}});
  return {{"scene", study.scene},
          {"reference", study.reference.what},
          {"floor", study.reference.floor},
          {"winners", best},
          {"omissions", study.omissions}};
}

void tradeoff(const Options& options, Outcome& outcome) {
  const auto say = [&](const std::string& text) {
    tell(options.json ? stderr : stdout, "{}\n", text);
    std::fflush(options.json ? stderr : stdout);
  };
  std::vector<std::string> names;
  if (options.all == !options.scene.empty()) throw InputError("give the name of a scene, a scene file, or --all");
  const std::string given = options.all ? "" : study_scene_or_file(options.scene);
  const bool file = given.ends_with(".json");
  if (file) names.push_back(given);
  for (const TradeoffEntry& entry : tradeoff_scenes())
    if (options.all || entry.name == given) names.emplace_back(entry.name);
  if (names.empty()) make_tradeoff_scene(given, "");  // tells which there are
  contenders_of(options);                             // and this, which integrators

  const RunFolder folder(run_path(options.out, "tradeoff"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of the integrators", options.seed}};
  facts.input_files = {std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes" / "liver564.mesh"};
  if (file) facts.input_files = {given};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);
  auto samples = folder.json_lines("samples.jsonl");
  nlohmann::json summaries = nlohmann::json::array();
  for (const std::string& scene_name : names) {
    const WorkPrecision study = study_scene(scene_name, options, folder, samples, outcome, say);
    summaries.push_back(summary_of(study));
    if (const std::string trouble = trouble_of(study); !trouble.empty()) {
      say(trouble);
      outcome.exit_code = exit_disagrees;
    }
  }
  folder.write_json("winners.json", summaries);
  finish_manifest(manifest);
  folder.write_manifest(manifest);
  if (options.json) tell("{}\n", json_text(nlohmann::json{{"scenes", summaries}, {"manifest", manifest}}, 2));
  say(fmt::format("Written to {}.", folder.path().string()));
}

}  // namespace

void add_tradeoff(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("tradeoff", "Measure what accuracy costs on a scene: every integrator, every step.");
  std::string known;
  for (const TradeoffEntry& entry : tradeoff_scenes())
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  verb->add_option("SCENE", options->scene, "a scene file (.json), the name of one of the gallery, or one of " + known);
  verb->add_flag("--all", options->all, "all scenes");
  verb->add_option("--only", options->only, "names of the integrators that take part [all]");
  verb->add_flag("--quick", options->quick, "short runs, few repetitions");
  verb->add_flag("--solvers", options->solvers, "implicit methods with every linear solver");
  verb->add_option("--most", options->most_s, "seconds that one run may take [8, quick 0.4]")->check(positive_number());
  verb->add_option("--out", options->out, "folder to write to, new or empty [dartboard-results/tradeoff-TIME]");
  verb->add_option("--seed", options->seed, "of the order of the integrators [1]");
  verb->add_flag("--json", options->json,
                 "print the winners and the manifest as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { tradeoff(*options, outcome); });
}

}  // namespace dartboard
