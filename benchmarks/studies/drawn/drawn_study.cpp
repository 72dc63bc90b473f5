#include "benchmarks/studies/drawn/drawn_study.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/scratch_folder.h"
#include "core/meshes/text/file_text.h"
#include "core/plain/error.h"
#include "core/scene/file/keys/strict_json.h"
#include "validation/drawn/broken_scene.h"
#include "validation/drawn/drawn_scene.h"
#include "validation/drawn/met_values.h"
#include "validation/drawn/relations/drawn_trial.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Tally {
  std::array<std::size_t, 3> outcomes{};       // by RelationOutcome
  std::map<std::string, std::size_t> reasons;  // why it does not apply
};

struct Broken {
  std::string scene, relation, words, file;
};

struct DrawnResults {
  std::map<std::string_view, Tally> tallies;
  std::vector<Broken> broken;
  std::vector<std::string> wrong_refusals;
  std::size_t scenes = 0, faults = 0;
  MetValues met;
};

std::string_view word_of(RelationOutcome outcome) {
  return outcome == RelationOutcome::holds ? "holds" : outcome == RelationOutcome::breaks ? "BREAKS" : "does not apply";
}

/// Writes the smallest scene that breaks the relation; returns the file's name, empty if there is a file of that name.
std::string write_smallest(const Json& scene, const std::string& name, const Relation& relation, const fs::path& meshes,
                           const fs::path& scratch, const fs::path& folder) {
  const fs::path file = folder / fmt::format("{}-{}.json", relation.name, name);
  if (fs::exists(file)) return "";
  fs::create_directories(folder);
  std::ofstream out(file);
  out << json_text(smallest_breaking(scene, relation, meshes, scratch), 1) << "\n";
  if (!out) throw IoError(fmt::format("{}: cannot be written", file.string()));
  return file.string();
}

/// Takes up what relations came to on a scene.
void take(const std::vector<RelationTrial>& trials, const Json& scene, const std::string& name, const fs::path& meshes,
          const fs::path& scratch, const fs::path& folder, DrawnResults& results) {
  for (const auto& [relation, found] : trials) {
    Tally& tally = results.tallies[relation->name];
    ++tally.outcomes[static_cast<std::size_t>(found.outcome)];
    if (found.outcome == RelationOutcome::does_not_apply) ++tally.reasons[found.words];
    if (found.outcome != RelationOutcome::breaks) continue;
    const bool is_first = tally.outcomes[static_cast<std::size_t>(RelationOutcome::breaks)] == 1;
    results.broken.push_back({name, std::string(relation->name), found.words,
                              is_first ? write_smallest(scene, name, *relation, meshes, scratch, folder) : ""});
  }
}

Table relations_table(const DrawnResults& results) {
  Table table({{"relation"},
               {"what is compared"},
               {"bound"},
               {"holds", Align::right},
               {"breaks", Align::right},
               {"does not apply", Align::right}});
  for (const Relation& relation : relations()) {
    const auto found = results.tallies.find(relation.name);
    if (found == results.tallies.end()) continue;
    const auto& [holds, breaks, not_applied] = found->second.outcomes;
    table.add_row({std::string(relation.name), std::string(relation.sentence), std::string(relation.bound),
                   std::to_string(holds), std::to_string(breaks), std::to_string(not_applied)});
  }
  return table;
}

Table reasons_table(const DrawnResults& results) {
  Table table({{"relation"}, {"does not apply where"}, {"scenes", Align::right}});
  for (const auto& [relation, tally] : results.tallies)
    for (const auto& [reason, count] : tally.reasons)
      table.add_row({std::string(relation), reason, std::to_string(count)});
  return table;
}

Table broken_table(const DrawnResults& results) {
  Table table({{"scene"}, {"relation"}, {"what differs"}, {"smallest scene"}});
  for (const Broken& one : results.broken) table.add_row({one.scene, one.relation, one.words, one.file});
  return table;
}

Table trials_table(const std::vector<RelationTrial>& trials) {
  Table table({{"relation"}, {"what is compared"}, {"bound"}, {"outcome"}, {"why"}});
  for (const auto& [relation, found] : trials)
    table.add_row({std::string(relation->name), std::string(relation->sentence), std::string(relation->bound),
                   std::string(word_of(found.outcome)), found.words});
  return table;
}

void add_broken(const DrawnResults& results, Report& report) {
  if (results.broken.empty()) return;
  report.tables.push_back({"broken", "Relations that break", broken_table(results)});
}

Json numbers_of(const DrawnResults& results) {
  Json relations = Json::array(), broken = Json::array();
  for (const auto& [relation, tally] : results.tallies) {
    const auto& [holds, breaks, not_applied] = tally.outcomes;
    relations.push_back(
        {{"relation", relation}, {"holds", holds}, {"breaks", breaks}, {"does_not_apply", not_applied}});
  }
  for (const Broken& one : results.broken)
    broken.push_back({{"scene", one.scene}, {"relation", one.relation}, {"words", one.words}, {"smallest", one.file}});
  return {{"scenes", results.scenes},
          {"values", results.met.values()},
          {"pairs", results.met.pairs()},
          {"triples", results.met.triples()},
          {"faults", results.faults},
          {"relations", relations},
          {"broken", broken}};
}

Report of_scene(const DrawnPlan& plan, StudyLog& log) {
  const std::string text = file_text(plan.scene, "a scene");
  const Json scene = first_steps(parse_strict_json(text, plan.scene.string()), plan.steps);
  const ScratchFolder scratch("drawn");
  const std::string name = plan.scene.stem().string();
  log.begin("validate drawn: " + name, 1);
  DrawnResults results;
  const auto trials = try_relations(scene, plan.scene.parent_path(), scratch.path(), plan.relation);
  log.advance(name);
  take(trials, scene, name, plan.scene.parent_path(), scratch.path(), plan.folder, results);
  Report report;
  report.tables.push_back({"relations", fmt::format("Relations of the first steps of {}, {} at most", name, plan.steps),
                           trials_table(trials)});
  add_broken(results, report);
  if (!results.broken.empty()) report.disagreements.emplace_back("A relation breaks: see above.");
  report.numbers = numbers_of(results);
  std::size_t holds = 0;
  for (const RelationTrial& trial : trials) holds += trial.found.outcome == RelationOutcome::holds;
  if (results.broken.empty())
    report.sentence = fmt::format("{} of {} relations hold, and the others do not apply.", holds, trials.size());
  return report;
}

/// The scenes that have all pairs of values.
Report chosen(const DrawnPlan& plan, StudyLog& log) {
  std::vector<std::set<std::string>> values;
  log.begin("validate drawn --choose", plan.count);
  for (std::uint64_t number = plan.first; number < plan.first + plan.count; ++number) {
    values.push_back(values_of(drawn_scene(plan.seed, number)));
    log.advance(std::to_string(number));
  }
  MetValues met;
  Json numbers = Json::array();
  Table table({{"scene", Align::right}, {"pairs so far", Align::right}});
  for (const std::size_t k : covering(values)) {
    met.add(values[k]);
    numbers.push_back(plan.first + k);
    table.add_row({std::to_string(plan.first + k), std::to_string(met.pairs())});
  }
  Report report;
  report.opening = fmt::format("{} of {} scenes have all {} pairs of {} keys and choices that meet in one of them.",
                               numbers.size(), plan.count, met.pairs(), met.values());
  report.tables.push_back({"chosen", "Scenes, those first that have most new pairs", table});
  report.numbers = {{"chosen", numbers}, {"pairs", met.pairs()}, {"values", met.values()}};
  report.facts = {{"seed", plan.seed}, {"first", plan.first}, {"scenes", plan.count}};
  return report;
}

}  // namespace

Report drawn_study(const DrawnPlan& plan, StudyLog& log) {
  if (!plan.relation.empty()) (void)find_relation(plan.relation);
  if (!plan.scene.empty()) return of_scene(plan, log);
  if (plan.only_choose) return chosen(plan, log);
  const ScratchFolder scratch("drawn");
  DrawnResults results;
  log.begin("validate drawn", plan.count);
  for (std::uint64_t number = plan.first; number < plan.first + plan.count; ++number) {
    const Json scene = drawn_scene(plan.seed, number);
    const std::string name = fmt::format("{}-{}", plan.seed, number);
    results.met.add(values_of(scene));
    ++results.scenes;
    take(try_relations(scene, "", scratch.path(), plan.relation), scene, name, "", scratch.path(), plan.folder,
         results);
    Draw draw(plan.seed, number);
    for (std::size_t k = 0; k < plan.broken; ++k) {
      if (const auto wrong = wrong_refusal(broken_scene(scene, draw)))
        results.wrong_refusals.push_back(fmt::format("scene {}: {}", name, *wrong));
      ++results.faults;
    }
    log.advance(name);
  }
  Report report;
  report.opening = fmt::format(
      "{} scenes of {} keys and choices, {} pairs and {} triples of which meet in one of them; {} scenes with one fault "
      "each.",
      results.scenes, results.met.values(), results.met.pairs(), results.met.triples(), results.faults);
  report.tables.push_back({"relations", "Relations of drawn scenes", relations_table(results)});
  report.tables.push_back({"reasons", "Where relations do not apply", reasons_table(results)});
  add_broken(results, report);
  Claim relations_hold{.id = "drawn-relations",
                       .text = "relations of drawn scenes hold",
                       .paper_value = "all",
                       .measured = fmt::format("{} break", results.broken.size())};
  relations_hold.verdict = results.scenes == 0      ? Verdict::not_tested
                           : results.broken.empty() ? Verdict::holds
                                                    : Verdict::falls_short;
  Claim refused{.id = "drawn-refusals",
                .text = "scenes with a fault are refused where it is",
                .paper_value = "all",
                .measured = fmt::format("{} of {}", results.faults - results.wrong_refusals.size(), results.faults)};
  refused.verdict = results.faults == 0              ? Verdict::not_tested
                    : results.wrong_refusals.empty() ? Verdict::holds
                                                     : Verdict::falls_short;
  if (!results.wrong_refusals.empty()) refused.reason = results.wrong_refusals.front();
  report.claims = {relations_hold, refused};
  report.numbers = numbers_of(results);
  report.facts = {{"seed", plan.seed}, {"first", plan.first}, {"scenes", plan.count}};
  return report;
}

}  // namespace dartboard
