#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "benchmarks/cli/bench_run.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/scenes.h"
#include "benchmarks/studies/topology/bench_topology_report.h"
#include "benchmarks/studies/topology/topology_tasks.h"
#include "reference/cgal/cgal_body.h"

namespace dartboard {
namespace {

// ---- one line of samples.jsonl

struct GroupSample {
  std::string body, figure;
  double units = 0.0;
  Sample sample;
};
void to_json(nlohmann::json& json, const GroupSample& s) {
  to_json(json, s.sample);
  json["body"] = s.body;
  json["figure"] = s.figure;
  json["units"] = s.units;
}
void from_json(const nlohmann::json& json, GroupSample& s) {
  from_json(json, s.sample);
  json.at("body").get_to(s.body);
  json.at("figure").get_to(s.figure);
  json.at("units").get_to(s.units);
}

// The child's side, a verb that help does not show: prints one sample per line.
void add_measure_topology(CLI::App& app) {
  struct Options {
    PairedOptions paired;
    std::vector<std::string> groups;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-topology", "Time topology in this process (used by bench).")->group("");
  verb->add_option("--process", options->paired.process);
  verb->add_option("--rounds", options->paired.rounds)->check(positive_number());
  verb->add_option("--seed", options->paired.seed);
  verb->add_option("BODY:FIGURE", options->groups)->required();
  verb->callback([options] {
    options->paired.warmup = 1;
    const std::set<std::string> wanted(options->groups.begin(), options->groups.end());
    for (const std::string& body : {topology_bodies[0], topology_bodies[1], scaling}) {
      if (std::none_of(wanted.begin(), wanted.end(), [&](const auto& w) { return w.starts_with(body + ":"); }))
        continue;
      TopologyStage stage = make_topology_stage(body, options->paired.seed);
      for (auto& group : stage.groups) {
        if (!wanted.contains(body + ":" + group.figure)) continue;
        std::vector<TimedTask> tasks;
        std::map<std::string, double> units;
        for (auto& entry : group.entries) {
          const auto found = std::make_shared<std::uint64_t>();
          units[entry.name] = entry.units;
          tasks.push_back({entry.name, entry.task.restore, [&entry, found] { *found = entry.task.run(); },
                           [found] { return *found; }});
        }
        run_rounds(tasks, options->paired, [&](const Sample& sample) {
          tell("{}\n", json_text(nlohmann::json(GroupSample{body, group.figure, units[sample.task], sample})));
        });
        for (auto& entry : group.entries) entry.task.restore();
      }
    }
  });
}

// ---- agreement

/// The bodies of all sizes: does the tetrahedral storage find what the general one does? Two walks that share neither
/// darts nor tables; CGAL's would not fit the largest.
void compare_scaling(TopologyFigures& results, std::vector<std::string>& agreed, std::uint64_t seed) {
  TopologyStage stage = make_topology_stage(scaling, seed);
  std::map<std::string, std::string> words;
  for (std::size_t k = 0; k < stage.works.size(); ++k) {
    std::vector<TopologyTask> general = topology_tasks<Map3>(stage.works[k]);
    for (auto& group : stage.groups) {
      const auto same = std::ranges::find(general, group.figure, &TopologyTask::figure);
      const std::uint64_t expected = same->run(), found = group.entries[k].task.run();
      same->restore();
      group.entries[k].task.restore();
      if (found != expected)
        words[group.figure] += fmt::format(" of {} the tetrahedral storage finds {}, the general one {};",
                                           scaling_sizes[k], found, expected);
    }
  }
  for (const auto& group : stage.groups)
    if (words[group.figure].empty())
      agreed.push_back(scaling + ":" + group.figure);
    else
      results.disagreements.push_back(fmt::format("{}, {}:{} not timed", scaling, group.figure, words[group.figure]));
}

/// Run everything once, untimed: who finds something else than CGAL (or, where CGAL finds nothing, than the others)?
std::vector<std::string> agreed_groups(TopologyFigures& results, const std::vector<std::string>& bodies,
                                       std::uint64_t seed) {
  const auto is_wanted = [&bodies](const std::string& body) { return std::ranges::find(bodies, body) != bodies.end(); };
  std::vector<std::string> agreed;
  for (const std::string& body : topology_bodies) {
    if (!is_wanted(body)) continue;
    const Mesh mesh = topology_mesh(body);
    const auto cells = static_cast<double>(mesh.cell_count());
    const auto per_cell = [&](std::size_t bytes) { return static_cast<double>(bytes) / cells; };
    results.bytes[body] = {{"general", per_cell(map_bytes<Map3>(mesh))},
                           {"tetrahedral", per_cell(map_bytes<TetMap>(mesh))},
                           {"CGAL", per_cell(cgal_map_bytes(mesh))}};
    TopologyStage stage = make_topology_stage(body, seed);
    for (auto& group : stage.groups) {
      std::set<std::uint64_t> found;
      std::string words;
      for (auto& entry : group.entries) {
        const std::uint64_t n = entry.task.run();
        entry.task.restore();
        found.insert(n);
        words += fmt::format(" {} finds {};", entry.name, n);
      }
      if (found.size() == 1)
        agreed.push_back(body + ":" + group.figure);
      else
        results.disagreements.push_back(fmt::format("{}, {}:{} not timed", body, group.figure, words));
    }
  }
  if (is_wanted(scaling)) compare_scaling(results, agreed, seed);
  return agreed;
}

// ---- the verb

std::vector<std::string> every_body() {
  std::vector<std::string> all = topology_bodies;
  all.push_back(scaling);
  return all;
}

void bench_topology(const BenchOptions& options, const std::vector<std::string>& bodies, Outcome& outcome) {
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of tasks, random faces", options.seed}};
  facts.libraries = {{"CGAL", reference::cgal_version()}};
  facts.input_files = {scene("liver").mesh};
  BenchRun run(options, "topology", facts);

  // No timing without agreement.
  TopologyFigures results;
  const std::vector<std::string> all = every_body();
  results.all_bodies =
      std::ranges::all_of(all, [&](const auto& body) { return std::ranges::find(bodies, body) != bodies.end(); });
  const std::vector<std::string> groups = agreed_groups(results, bodies, options.seed);
  for (const std::string& d : results.disagreements) run.say("They disagree: " + d);

  const int processes = options.quick ? 6 : 11, rounds = options.quick ? 3 : 6;
  run.say(fmt::format("{} figures; {} processes, {} interleaved rounds each", groups.size(), processes, rounds));
  Progress progress("timing", static_cast<std::size_t>(processes) * groups.size());
  auto lines = run.folder().json_lines("samples.jsonl");
  std::string last;
  repeat_self(
      processes,
      [&](int process) {
        std::vector<std::string> arguments{"measure-topology",     "--process", std::to_string(process),     "--rounds",
                                           std::to_string(rounds), "--seed",    std::to_string(options.seed)};
        arguments.insert(arguments.end(), groups.begin(), groups.end());
        return arguments;
      },
      [&](std::string_view line) {
        const auto s = nlohmann::json::parse(line).get<GroupSample>();
        const std::string group = s.body + ":" + s.figure;
        lines.append(s);
        results.samples[group].push_back(s.sample);
        results.units[group + ":" + s.sample.task] = s.units;
        if (group != last) progress.advance(last = group);
      });

  const std::string peers_heading = "Peers, by others on another machine (+-30 %): context, not a comparison";
  const auto claims = claims_of(results);
  run.say("\n" + to_text(figures_table(results)) + "\n" + figures_note() + "\n");
  run.say("How unsewing scales\n\n" + to_text(scaling_table(results)));
  run.say(peers_heading + "\n\n" + to_text(peers_table()));
  run.say("Targets\n\n" + to_text(claims));
  run.folder().write_claims(claims);
  run.folder().write_table("figures", "Topology, side by side with CGAL", figures_table(results), figures_note());
  run.folder().write_table("scaling", "How unsewing scales", scaling_table(results));
  run.folder().write_table("peers", peers_heading, peers_table());
  outcome.exit_code = results.disagreements.empty() ? exit_code(claims) : exit_disagrees;
  run.finish(claims, results.disagreements.empty()
                         ? ""
                         : fmt::format("{} of the figures differ between contenders and were not timed: see above. ",
                                       results.disagreements.size()));
}

}  // namespace

void add_bench_topology(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* topology =
      bench.add_subcommand("topology", "Memory, walks, checks, building and unsewing, side by side with CGAL.");
  const auto options =
      add_bench_options(*topology, "fewer processes and rounds", "the order of turns and the random faces");
  const auto only = std::make_shared<std::vector<std::string>>(every_body());
  topology->add_option("--only", *only, fmt::format("of {} [all]", fmt::join(every_body(), ", ")))
      ->check(CLI::IsMember(every_body()));
  topology->callback([options, only, &outcome] { bench_topology(*options, *only, outcome); });
  add_measure_topology(app);
}

}  // namespace dartboard
