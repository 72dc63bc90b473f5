#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "benchmarks/bench_run.h"
#include "benchmarks/json_text.h"
#include "benchmarks/paired.h"
#include "benchmarks/processes.h"
#include "benchmarks/progress.h"
#include "benchmarks/scenes.h"
#include "benchmarks/tell.h"
#include "benchmarks/topology_tasks.h"
#include "benchmarks/verb_bench.h"
#include "reference/cgal_body.h"

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

// ---- what is known in the end

struct Results {
  std::map<std::string, std::map<std::string, double>> bytes;  // per tetrahedron, by body and contender
  std::vector<std::string> disagreements;
  std::map<std::string, std::vector<Sample>> samples;  // by "BODY:FIGURE"
  std::map<std::string, double> units;                 // by "BODY:FIGURE:CONTENDER"

  /// Processor time per unit [ns]; nothing if it was not timed.
  std::optional<double> ns(const std::string& group, const std::string& who) const {
    const auto unit = units.find(group + ":" + who);
    if (unit == units.end()) return std::nullopt;
    return times_of(samples.at(group), who).cpu_median / unit->second;
  }
  /// Time per unit of `a` over that of `b`.   pre  both were timed
  Figure ratio(const std::string& group, const std::string& a, const std::string& b) const {
    Figure f = paired_ratio(samples.at(group), a, b).cpu;
    const double scale = units.at(group + ":" + b) / units.at(group + ":" + a);
    f.median *= scale;
    f.interval.low *= scale;
    f.interval.high *= scale;
    return f;
  }
};

/// The bodies of all sizes: does the tetrahedral storage find what the general one does? Two walks that share neither
/// darts nor tables; CGAL's would not fit the largest.
void compare_scaling(Results& results, std::vector<std::string>& agreed, std::uint64_t seed) {
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
std::vector<std::string> agreed_groups(Results& results, std::uint64_t seed) {
  std::vector<std::string> agreed;
  for (const std::string& body : topology_bodies) {
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
  compare_scaling(results, agreed, seed);
  return agreed;
}

// ---- what is said of it

/// A line of the table: every body must keep to the bound, and where `faster` is not 0 be so much faster than
/// CGAL.
struct Target {
  std::string id, text;
  std::vector<std::string> figures;
  std::string unit;
  double ns_per_unit;  // that the figure is printed in
  double bound;        // in that unit; 0 for none
  double faster;
};
const std::vector<Target>& targets() {
  static const std::vector<Target> table{
      {"vertex-orbit", "vertex orbit", {"vertex-orbit"}, "ns per dart", 1.0, 3.0, 20.0},
      {"full-check", "full validity check", {"full-check"}, "ns per dart", 1.0, 5.0, 20.0},
      {"local-check", "incremental check of an operation", {"local-check"}, "us per face", 1e3, 1.0, 0.0},
      {"build", "build from a mesh in memory", {"build"}, "us per tetrahedron", 1e3, 0.8, 0.0},
      {"unsew",
       "unsew a face and tell what came apart",
       {"unsew-cut", "unsew-scattered"},
       "us per face",
       1e3,
       1.5,
       0.0},
      {"", "vertex to tetrahedra", {"vertex-to-tetrahedra"}, "us per vertex", 1e3, 0.0, 0.0},
      {"", "count all cells", {"count-cells"}, "ns per dart", 1.0, 0.0, 0.0},
  };
  return table;
}

std::string target_text(const Target& t) {
  if (t.bound == 0.0) return "-";
  return fmt::format("<= {:g} {}", t.bound, t.unit) + (t.faster > 0.0 ? fmt::format(", {:g}x CGAL", t.faster) : "");
}

struct Row {
  std::vector<std::string> cells;
  bool timed = false, holds = false;
};

Row row_of(const Results& r, const Target& t, const std::string& figure, const std::string& body) {
  const std::string group = body + ":" + figure;
  const auto show = [&](const char* who) {
    const auto ns = r.ns(group, who);
    return ns ? fmt::format("{:.3g}", *ns / t.ns_per_unit) : std::string("-");
  };
  Row row;
  const auto ns = r.ns(group, "tetrahedral");
  row.timed = ns.has_value();
  std::string ratio = "-", bare_ratio = "-";
  row.holds = row.timed && (t.bound == 0.0 || *ns / t.ns_per_unit <= t.bound);
  if (row.timed && r.ns(group, "CGAL")) {
    const Figure f = r.ratio(group, "CGAL", "tetrahedral");
    ratio = to_string(f);
    row.holds = row.holds && f.median >= t.faster;
  }
  if (row.timed && r.ns(group, "bare CGAL"))
    bare_ratio = fmt::format("{:.3g}", r.ratio(group, "bare CGAL", "tetrahedral").median);
  const std::string verdict = t.bound == 0.0 ? "-" : !row.timed ? "not timed" : row.holds ? "holds" : "falls short";
  const std::string which = t.figures.size() == 1 ? "" : figure == "unsew-cut" ? ", along a cut" : ", at random";
  row.cells = {t.text + which, body,  target_text(t),    show("general"), show("tetrahedral"),
               show("CGAL"),   ratio, show("bare CGAL"), bare_ratio,      verdict};
  return row;
}

constexpr double memory_bound = 64.0, cut_bound = 1.5, scattered_bound = 3.0;
const std::string memory_target = fmt::format("<= {:g} bytes per tetrahedron", memory_bound);
const std::string &smallest = scaling_sizes.front(), &largest = scaling_sizes.back();

std::string scaling_group(bool cut) { return scaling + (cut ? ":unsew-cut" : ":unsew-scattered"); }

Table figures_table(const Results& r) {
  Table table({{"figure"},
               {"body"},
               {"target"},
               {"general", Align::right},
               {"tetrahedral", Align::right},
               {"CGAL", Align::right},
               {"its ratio to tetrahedral", Align::right},
               {"bare CGAL", Align::right},
               {"its ratio", Align::right},
               {"verdict"}});
  for (const auto& [body, bytes] : r.bytes)
    table.add_row({"memory, vertex and edge ids included", body, memory_target,
                   fmt::format("{:.4g}", bytes.at("general")), fmt::format("{:.4g}", bytes.at("tetrahedral")),
                   fmt::format("{:.4g}", bytes.at("CGAL")),
                   fmt::format("{:.3g}", bytes.at("CGAL") / bytes.at("tetrahedral")), "-", "-",
                   bytes.at("tetrahedral") <= memory_bound ? "holds" : "falls short"});
  for (const Target& t : targets())
    for (const std::string& figure : t.figures)
      for (const std::string& body : topology_bodies) table.add_row(row_of(r, t, figure, body).cells);
  return table;
}

Table scaling_table(const Results& r) {
  Table table({{"unsew, tetrahedral map"},
               {"2,058 [us]", Align::right},
               {"48,000 [us]", Align::right},
               {"998,250 [us]", Align::right},
               {"largest / smallest", Align::right},
               {"target"}});
  for (const bool cut : {true, false}) {
    const std::string group = scaling_group(cut);
    std::vector<std::string> row{cut ? "along a cut" : "at random"};
    for (const std::string& n : scaling_sizes) {
      const auto ns = r.ns(group, n);
      row.push_back(ns ? fmt::format("{:.3g}", *ns / 1e3) : "-");
    }
    row.push_back(r.ns(group, largest) ? to_string(r.ratio(group, largest, smallest)) : "-");
    row.push_back(fmt::format("<= {:g}", cut ? cut_bound : scattered_bound));
    table.add_row(row);
  }
  return table;
}

/// Other programs, measured once by others on another machine (a shared virtual one, +-30 %): context and no more.
Table peers_table() {
  Table table({{"1,920 / 48,000 tetrahedra"},
               {"CGAL 5.5.1 g-map", Align::right},
               {"CGoGN_3", Align::right},
               {"OpenVolumeMesh", Align::right},
               {"tet-implicit probe", Align::right}});
  table.add_row({"memory [bytes per tetrahedron]", "1,830", "512", "416", "32"});
  table.add_row({"vertex orbit [ns per dart]", "48 / 95", "10 / 10", "-", "0.7-1.3"});
  table.add_row({"vertex to tetrahedra [us]", "19 / 22", "-", "0.65 / 1.75", "0.1"});
  table.add_row({"full validity [ns per dart]", "57-113 / 109-138", "none", "-", "0.6-0.7"});
  table.add_row({"count all cells [ns per dart]", "69-143 / 179-208", "-", "-", "29-63"});
  table.add_row({"unsew a face [us]", "10 / 51-72", "none", "none", "0.44 / 0.3"});
  table.add_row({"build [us per tetrahedron]", "2.0-3.3 / 3.3-3.7", "2.3 / 2.2", "5.8 / 5.9", "0.38 / 0.34"});
  return table;
}

const char* const note =
    "Verdicts are for the tetrahedral storage, medians of processor time over processes; ratios are paired within "
    "rounds, their intervals distribution-free over processes. Before each run the map is put back and read through "
    "once, so that what fits the caches is there.\n\n"
    "CGAL's map carries what the memory counts for all, a number on each vertex and edge, and is_valid() checks those "
    "too; bare CGAL has no attributes, so it compares walks and conditions alone. CGAL's unsew renews the attributes "
    "of "
    "the cells that came apart, its only way to tell them, while ours reports them, has written a journal and has "
    "checked the darts it touched. Not in the memory: a mark in use takes 4 bytes per dart of ours, 96 per "
    "tetrahedron, "
    "for each mark in use at once; CGAL's marks are in its darts.";

std::vector<Claim> claims_of(const Results& r) {
  const auto claim = [](std::string id, std::string text, std::string bound) {
    return Claim{.id = std::move(id), .text = std::move(text), .section = "", .paper_value = std::move(bound)};
  };
  const auto verdict = [](bool holds) { return holds ? Verdict::holds : Verdict::falls_short; };
  std::vector<Claim> claims;
  Claim memory = claim("topology-memory", "memory of the tetrahedral storage with vertex and edge ids", memory_target);
  bool fits = true;
  for (const auto& [body, bytes] : r.bytes) {
    memory.measured += fmt::format("{}{:.4g}", memory.measured.empty() ? "" : " / ", bytes.at("tetrahedral"));
    fits = fits && bytes.at("tetrahedral") <= memory_bound;
  }
  memory.verdict = verdict(fits);
  memory.bound_or_interval = "counted";
  claims.push_back(memory);

  for (const Target& t : targets()) {
    if (t.bound == 0.0) continue;
    Claim c = claim("topology-" + t.id, t.text, target_text(t));
    bool timed = true, holds = true;
    for (const std::string& figure : t.figures)
      for (const std::string& body : topology_bodies) {
        const Row row = row_of(r, t, figure, body);
        timed = timed && row.timed;
        holds = holds && row.holds;
        c.measured += (c.measured.empty() ? "" : " / ") + row.cells[4];
        if (t.faster > 0.0)
          c.bound_or_interval +=
              fmt::format("{}{} (bare: {})", c.bound_or_interval.empty() ? "" : "; ", row.cells[6], row.cells[8]);
      }
    c.verdict = timed ? verdict(holds) : Verdict::not_tested;
    if (!timed) c.reason = "the contenders do not find the same";
    claims.push_back(c);
  }
  for (const bool cut : {true, false}) {
    const double bound = cut ? cut_bound : scattered_bound;
    Claim c = claim(cut ? "topology-unsew-cut-scaling" : "topology-unsew-random-scaling",
                    std::string("time to unsew a face ") + (cut ? "along a cut" : "at random") +
                        ", of 998,250 tetrahedra over 2,058",
                    fmt::format("<= {:g}", bound));
    if (r.ns(scaling_group(cut), largest)) {
      const Figure f = r.ratio(scaling_group(cut), largest, smallest);
      c.measured = fmt::format("{:.3g}", f.median);
      c.bound_or_interval = to_string(f.interval);
      c.verdict = verdict(f.median <= bound);
    } else {
      c.reason = "the storages do not find the same";
    }
    claims.push_back(c);
  }
  return claims;
}

// ---- the verb

void bench_topology(const BenchOptions& options, Outcome& outcome) {
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of tasks, random faces", options.seed}};
  facts.libraries = {{"CGAL", reference::cgal_version()}};
  facts.input_files = {scene("liver").mesh};
  BenchRun run(options, "topology", facts);

  // No timing without agreement.
  Results results;
  const std::vector<std::string> groups = agreed_groups(results, options.seed);
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
  run.say("\n" + to_text(figures_table(results)) + "\n" + note + "\n");
  run.say("How unsewing scales\n\n" + to_text(scaling_table(results)));
  run.say(peers_heading + "\n\n" + to_text(peers_table()));
  run.say("Targets\n\n" + to_text(claims));
  run.folder().write_claims(claims);
  run.folder().write_table("figures", "Topology, side by side with CGAL", figures_table(results), note);
  run.folder().write_table("scaling", "How unsewing scales", scaling_table(results));
  run.folder().write_table("peers", peers_heading, peers_table());
  outcome.exit_code = results.disagreements.empty() ? exit_code(claims) : exit_disagrees;
  run.finish(claims, outcome.exit_code == exit_agrees, "Something does not hold: see above.");
}

}  // namespace

void add_bench_topology(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* topology =
      bench.add_subcommand("topology", "Memory, walks, checks, building and unsewing, side by side with CGAL.");
  const auto options =
      add_bench_options(*topology, "fewer processes and rounds", "the order of turns and the random faces");
  topology->callback([options, &outcome] { bench_topology(*options, outcome); });
  add_measure_topology(app);
}

}  // namespace dartboard
