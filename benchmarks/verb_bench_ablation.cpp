#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/ablation_study.h"
#include "benchmarks/json_text.h"
#include "benchmarks/manifest.h"
#include "benchmarks/plot.h"
#include "benchmarks/processes.h"
#include "benchmarks/progress.h"
#include "benchmarks/run_folder.h"
#include "benchmarks/tell.h"
#include "benchmarks/verb_bench.h"
#include "core/scene/measured_plan.h"
#include "core/scene/scene_problem.h"
#include "core/scene/simulation.h"

namespace dartboard {
namespace {

void add_measure_ablation(CLI::App& app) {
  auto options = std::make_shared<AblationOptions>();
  auto* verb =
      app.add_subcommand("measure-ablation", "Time features on and off in this process (used by bench).")->group("");
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(CLI::PositiveNumber);
  verb->add_option("--steps", options->steps)->check(CLI::PositiveNumber);
  verb->add_option("--seed", options->seed);
  verb->callback([options] {
    study_ablation(*options, [](const Sample& sample) { tell("{}\n", json_text(nlohmann::json(sample))); });
  });
}

// ---- what the variants hold

struct Bytes {
  std::size_t total = 0, tetrahedra = 0, springs = 0;
  std::size_t not_asked_for = 0;  // of parts that a bare scene does not need
  std::size_t damping = 0;        // of springs, beyond rest length, stiffness and ends
  double per_tetrahedron() const { return static_cast<double>(total) / static_cast<double>(tetrahedra); }
};

/// Asked of the built objects, part by part, whatever a plan says.
std::map<std::string, Bytes> bytes_of_variants() {
  std::map<std::string, Bytes> all;
  for (const AblationVariant& variant : ablation_variants()) {
    const MeshTally counts = plan_scene(variant.scene, make_problem(variant.scene)).counts;
    const MemoryReport report = measured_memory(variant.scene);
    Bytes bytes{.tetrahedra = counts.cells,
                .springs = counts.edges,
                .not_asked_for = bytes_not_asked_for(report),
                .damping = bytes_of_damping(report, counts.edges)};
    for (const MemoryItem& item : report) bytes.total += item.bytes;
    all[variant.name] = bytes;
  }
  return all;
}

// ---- tables

struct Results {
  std::vector<Sample> samples;
  std::map<std::string, Bytes> bytes;
  int steps;

  double step_us(const std::string& task) const { return times_of(samples, task).cpu_median / steps / 1e3; }
};

std::string percent(double ratio) { return fmt::format("{:+.2f} %", 100.0 * (ratio - 1.0)); }
std::string percent(const Interval& i) {
  return fmt::format("[{:+.2f}, {:+.2f}] at {:.1f} %", 100.0 * (i.low - 1.0), 100.0 * (i.high - 1.0),
                     100.0 * i.coverage);
}

Table features_table(const Results& r) {
  Table table({{"feature"},
               {"switched"},
               {"bytes per tetrahedron", Align::right},
               {"us per step", Align::right},
               {"of a step", Align::right},
               {"interval", Align::right}});
  const auto rows = [&](const std::vector<AblationPair>& pairs, const char* switched) {
    for (const AblationPair& pair : pairs) {
      const Ratio ratio = paired_ratio(r.samples, pair.task, pair.baseline);
      table.add_row({pair.feature, switched,
                     fmt::format("{:+.1f}",
                                 r.bytes.at(pair.task).per_tetrahedron() - r.bytes.at(pair.baseline).per_tetrahedron()),
                     fmt::format("{:+.2f}", r.step_us(pair.task) - r.step_us(pair.baseline)), percent(ratio.cpu.median),
                     percent(ratio.cpu.interval)});
    }
  };
  rows(switched_on(), "on, from bare");
  rows(switched_off(), "off, from full");
  return table;
}

Table staircase_table(const Results& r) {
  Table table({{"not asked for, or always there"},
               {"task"},
               {"over"},
               {"us per step", Align::right},
               {"of a step", Align::right},
               {"interval", Align::right}});
  for (const AblationPair& pair : staircase()) {
    const Ratio ratio = paired_ratio(r.samples, pair.task, pair.baseline);
    table.add_row({pair.feature, pair.task, pair.baseline, fmt::format("{:.2f}", r.step_us(pair.task)),
                   percent(ratio.cpu.median), percent(ratio.cpu.interval)});
  }
  return table;
}

const char* const note =
    "Each feature in a scene of the paper's body, undamped and at rest but for a spin where bare. Ratios are paired "
    "within rounds, intervals are over processes. The map and the watch on stress are those of events that never "
    "happen "
    "within the run: nothing but their presence is timed. Frames and diagnostics: every tenth step, in memory. Bytes "
    "are "
    "asked of the built objects: the elements of all containers at the start. On a map, frames are read off its darts; "
    "with it "
    "the full scene pays for that too.";

// ---- claims

Claim target(std::string id, std::string text, std::string bound, std::string measured, std::string interval,
             bool holds, std::string reason) {
  return {.id = std::move(id),
          .text = std::move(text),
          .section = "",
          .paper_value = std::move(bound),
          .measured = std::move(measured),
          .bound_or_interval = std::move(interval),
          .verdict = holds ? Verdict::holds : Verdict::falls_short,
          .reason = holds ? "" : std::move(reason)};
}

std::vector<Claim> claims_of(const Results& r) {
  std::vector<Claim> claims;
  const Ratio all = paired_ratio(r.samples, "simulation", "loop");
  claims.push_back(target("bare-scene-speed",
                          "a scene without topological events over the same integrator on plain arrays in a loop",
                          "<= 1.02", fmt::format("{:.4f}", all.cpu.median), to_string(all.cpu.interval),
                          all.cpu.median <= 1.02, "the staircase shows where"));
  // what is held by a map, and columns of terms that are zero
  const Bytes bare = r.bytes.at("bare");
  claims.push_back(target("bare-scene-holds-no-dart",
                          "such a scene holds no dart, and no column of what it does not ask for", "0 bytes",
                          fmt::format("{} bytes", bare.not_asked_for), "exact", bare.not_asked_for == 0, ""));
  claims.push_back(target("unasked-damping-bytes", "damping that is not asked for takes no byte", "0 bytes",
                          fmt::format("{} bytes for {} springs; {} where it is asked for", bare.damping, bare.springs,
                                      r.bytes.at("bare + damping").damping),
                          "exact", bare.damping == 0, "springs hold it"));
  const std::map<std::string, std::string> ids{{"loop", "unasked-terms-time"},
                                               {"loop and detector", "detector-time"},
                                               {"watched loop", "speed-check-time"},
                                               {"simulation", "unasked-events-and-output-time"}};
  for (const AblationPair& pair : staircase()) {
    if (pair.task == "simulation" && pair.baseline == "loop") continue;
    const Ratio ratio = paired_ratio(r.samples, pair.task, pair.baseline);
    Claim claim = target(ids.at(pair.task), fmt::format("{}: time when not asked for", pair.feature),
                         "<= 0.5 % of a step", percent(ratio.cpu.median), percent(ratio.cpu.interval), false,
                         fmt::format("'{}' over '{}'", pair.task, pair.baseline));
    claim.verdict = verdict_on_time(ratio.cpu);
    if (claim.verdict == Verdict::holds) claim.reason.clear();
    if (claim.verdict == Verdict::not_tested)
      claim.reason = fmt::format("'{}' does less than '{}' and is slower: no lower bound", pair.baseline, pair.task);
    claims.push_back(std::move(claim));
  }
  return claims;
}

// ---- the picture: a row for each feature, its time along it, its bytes beside it

Plot plot_of(const Results& r) {
  Plot plot;
  plot.title = "What a feature costs: on from a bare scene, off from a full one";
  plot.subtitle = "interval over processes; bytes per tetrahedron";
  plot.x_axis = "time per step with it, over that without";
  PlotSeries on{.title = "on, from bare", .points = {}, .colour = "#1f77b4", .symbol = 7, .size = 1.4},
      off{.title = "off, from full", .points = {}, .colour = "#d62728", .symbol = 5, .size = 1.4};
  double low = 1.0, high = 1.0;
  const std::size_t count = switched_on().size();
  const auto add = [&](const std::vector<AblationPair>& pairs, PlotSeries& series, double aside) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Ratio ratio = paired_ratio(r.samples, pairs[k].task, pairs[k].baseline);
      const double bytes =
          r.bytes.at(pairs[k].task).per_tetrahedron() - r.bytes.at(pairs[k].baseline).per_tetrahedron();
      const double y = static_cast<double>(count - k) + aside;
      const Interval& i = ratio.cpu.interval;
      series.points.push_back({ratio.cpu.median, y});
      plot.series.push_back({.title = "",
                             .points = {{i.low, y}, {i.high, y, bytes == 0.0 ? "" : fmt::format("{:+.1f} B", bytes)}},
                             .colour = series.colour,
                             .symbol = 0,
                             .width = 2.0});
      low = std::min(low, i.low);
      high = std::max(high, i.high);
    }
  };
  add(switched_on(), on, 0.12);
  add(switched_off(), off, -0.12);
  for (std::size_t k = count; k-- > 0;) plot.rows.push_back(switched_on()[k].feature);
  plot.series.push_back({.title = "",
                         .points = {{1.0, 0.5}, {1.0, static_cast<double>(count) + 0.5}},
                         .colour = "#404040",
                         .symbol = 0,
                         .width = 1.0});
  plot.series.push_back(std::move(on));
  plot.series.push_back(std::move(off));
  plot.x_low = 0.9 * low;
  plot.x_high = 1.3 * high;
  plot.y_low = 0.5;
  plot.y_high = static_cast<double>(count) + 0.5;
  return plot;
}

// ---- the verb

struct Options {
  bool json = false, quick = false;
  std::string out;
  std::uint64_t seed = 1;
};

void bench_ablation(const Options& options, Outcome& outcome) {
  const auto say = [&](const std::string& text) { tell(options.json ? stderr : stdout, "{}\n", text); };
  const RunFolder folder(run_path(options.out, "ablation"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of the tasks", options.seed}};
  facts.input_files = {std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes" / "liver564.mesh"};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);

  const int processes = options.quick ? 6 : 11, rounds = options.quick ? 3 : 12, steps = options.quick ? 20 : 60;
  Results results{.samples = {}, .bytes = bytes_of_variants(), .steps = steps};
  say(fmt::format("{} scenes and {} loops, {} steps each time, in {} processes", results.bytes.size(), 5, steps,
                  processes));
  auto lines = folder.json_lines("samples.jsonl");
  {
    Progress progress("timing", static_cast<std::size_t>(processes), options.json);
    for (int process = 0; process < processes; ++process) {
      run_self({"measure-ablation", "--process", std::to_string(process), "--rounds", std::to_string(rounds), "--steps",
                std::to_string(steps), "--seed", std::to_string(options.seed)},
               [&](std::string_view line) {
                 const auto json = nlohmann::json::parse(line);
                 lines.append(json);
                 results.samples.push_back(json.get<Sample>());
               });
      progress.advance();
    }
  }

  check_repeats(results.samples);
  const auto claims = claims_of(results);
  say("\n" + to_text(features_table(results)) + "\n" + note + "\n");
  say("The bare scene, with less and less around its loop\n\n" + to_text(staircase_table(results)));
  say("Targets\n\n" + to_text(claims));
  folder.write_claims(claims);
  folder.write_table("features", "Features on and off", features_table(results), note);
  folder.write_table("staircase", "The bare scene, with less and less around its loop", staircase_table(results));
  const std::string trouble = draw(plot_of(results), folder.path(), "ablation");
  if (!trouble.empty()) say(trouble);
  finish_manifest(manifest);
  folder.write_manifest(manifest);
  outcome.exit_code = exit_code(claims);
  picture_missing(outcome, trouble);
  if (options.json) tell("{}\n", json_text(nlohmann::json{{"claims", claims}, {"manifest", manifest}}, 2));
  say(fmt::format("{}{} Written to {}.", options.quick ? "This was a quick run. " : "",
                  outcome.exit_code != exit_disagrees ? "Every target holds." : "Some target is missed: see above.",
                  folder.path().string()));
}

}  // namespace

void add_bench_ablation(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = bench.add_subcommand(
      "ablation", "Each feature of a scene on from a bare one and off from a full one: bytes, and time per step.");
  verb->add_flag("--quick", options->quick, "fewer rounds, fewer processes");
  verb->add_option("--out", options->out, "folder to write to, new or empty [dartboard-results/ablation-TIME]");
  verb->add_option("--seed", options->seed, "of the order of the tasks [1]");
  verb->add_flag("--json", options->json,
                 "print claims and manifest as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { bench_ablation(*options, outcome); });
  add_measure_ablation(app);
}

}  // namespace dartboard
