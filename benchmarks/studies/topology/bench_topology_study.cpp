#include "benchmarks/studies/topology/bench_topology_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/topology/bench_topology_report.h"
#include "benchmarks/studies/topology/topology_tasks.h"

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

// ---- agreement

/// Compares bodies of all sizes: does the tetrahedral storage find the same as the general one? Two walks that share
/// neither darts nor tables; CGAL's map of the largest would not fit into memory.
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

/// Run everything once, untimed, and return the figures that agree with CGAL's (without CGAL's: with each other).
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

}  // namespace

std::vector<std::string> topology_bench_bodies() {
  std::vector<std::string> all = topology_bodies;
  all.push_back(scaling);
  return all;
}

void run_topology_child(const PairedOptions& paired, const std::vector<std::string>& groups) {
  PairedOptions options = paired;
  options.warmup = 1;
  const std::set<std::string> wanted(groups.begin(), groups.end());
  for (const std::string& body : {topology_bodies[0], topology_bodies[1], scaling}) {
    if (std::none_of(wanted.begin(), wanted.end(), [&](const auto& w) { return w.starts_with(body + ":"); })) continue;
    TopologyStage stage = make_topology_stage(body, options.seed);
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
      run_rounds(tasks, options, [&](const Sample& sample) {
        tell("{}\n", json_text(nlohmann::json(GroupSample{body, group.figure, units[sample.task], sample})));
      });
      for (auto& entry : group.entries) entry.task.restore();
    }
  }
}

Report topology_bench(const TopologyBenchPlan& plan, StudyLog& log) {
  TopologyFigures results;
  const std::vector<std::string> all = topology_bench_bodies();
  results.all_bodies = std::ranges::all_of(
      all, [&](const auto& body) { return std::ranges::find(plan.bodies, body) != plan.bodies.end(); });
  const std::vector<std::string> groups = agreed_groups(results, plan.bodies, plan.seed);

  const int processes = plan.quick ? 6 : 11, rounds = plan.quick ? 3 : 6;
  log.say(fmt::format("{} figures; {} processes, {} interleaved rounds each", groups.size(), processes, rounds));
  log.begin("timing", static_cast<std::size_t>(processes) * groups.size());
  std::string last;
  for (int process = 0; process < processes; ++process) {
    std::vector<std::string> arguments{"measure-topology",     "--process", std::to_string(process),  "--rounds",
                                       std::to_string(rounds), "--seed",    std::to_string(plan.seed)};
    arguments.insert(arguments.end(), groups.begin(), groups.end());
    log.measure(arguments, [&](const nlohmann::json& json) {
      const auto s = json.get<GroupSample>();
      const std::string group = s.body + ":" + s.figure;
      results.samples[group].push_back(s.sample);
      results.units[group + ":" + s.sample.task] = s.units;
      if (group != last) log.advance(last = group);
    });
  }

  Report report{.claims = claims_of(results)};
  report.tables = {{"figures", "Topology, side by side with CGAL", figures_table(results), figures_note()},
                   {"scaling", "How unsewing scales", scaling_table(results)},
                   {"peers", "Peers, by others on another machine (+-30 %): context, not a comparison", peers_table()}};
  for (const std::string& d : results.disagreements) report.disagreements.push_back("They disagree: " + d);
  if (!results.disagreements.empty())
    report.sentence = fmt::format("{} of the figures differ between contenders and were not timed: see above. {}",
                                  results.disagreements.size(), in_words(report.claims));
  return report;
}

}  // namespace dartboard
