#include "benchmarks/studies/compare/compare_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/report/findings.h"
#include "core/base/counted.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Json = nlohmann::json;

/// The claims of all parts, by id.
std::map<std::string, Json> claims_of(const Json& run) {
  std::map<std::string, Json> claims;
  for (const Json& part : run.at("findings").at("parts"))
    for (const Json& claim : part.at("claims")) claims.insert_or_assign(claim.at("id").get<std::string>(), claim);
  return claims;
}

struct ComparedClaim {
  std::string id;
  Json first, second;  // null where a run has not got it
};

std::string verdict_of(const Json& claim) { return claim.is_null() ? "-" : claim.at("verdict").get<std::string>(); }
std::string measured_of(const Json& claim) { return claim.is_null() ? "-" : claim.value("measured", ""); }

/// One of them was not decided: the same program may decide it another time.
bool is_open(const Json& claim) {
  const std::string verdict = verdict_of(claim);
  return verdict == name(Verdict::undecided) || verdict == name(Verdict::not_tested) || claim.is_null();
}
bool is_change(const ComparedClaim& claim) { return !is_open(claim.first) && !is_open(claim.second); }

std::vector<ComparedClaim> changed_claims(const Json& first, const Json& second) {
  const auto of_first = claims_of(first), of_second = claims_of(second);
  std::vector<ComparedClaim> changed;
  const auto add = [&](const std::string& id) {
    const auto find = [&id](const auto& claims) { return claims.contains(id) ? claims.at(id) : Json(); };
    ComparedClaim claim{id, find(of_first), find(of_second)};
    if (verdict_of(claim.first) != verdict_of(claim.second)) changed.push_back(std::move(claim));
  };
  for (const auto& [id, claim] : of_first) add(id);
  for (const auto& [id, claim] : of_second)
    if (!of_first.contains(id)) add(id);
  return changed;
}

std::string in_words(const Shift& shift) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]{}", shift.median, shift.interval.low, shift.interval.high,
                     shift.interval.reached ? "" : fmt::format(" at only {:.3g} %", 100.0 * shift.interval.coverage));
}

Json to_data(const Shift& shift) {
  return {{"ratio", shift.median},
          {"low", shift.interval.low},
          {"high", shift.interval.high},
          {"coverage", shift.interval.coverage},
          {"reached", shift.interval.reached}};
}

Table table_of(const ComparedTimes& times) {
  Table table({{"task"}, {"processes", Align::right}, {"second / first", Align::right}, {"verdict"}, {"bits"}});
  for (const ComparedTask& t : times.tasks)
    table.add_row({t.task, fmt::format("{} and {}", t.processes[0], t.processes[1]), in_words(t.shift),
                   std::string(name(t.verdict)), t.same_state ? "same" : "other"});
  return table;
}

Table table_of(const std::vector<ComparedClaim>& claims) {
  Table table({{"claim"}, {"first"}, {""}, {"second"}, {""}});
  for (const ComparedClaim& c : claims)
    table.add_row({c.id, verdict_of(c.first), measured_of(c.first), verdict_of(c.second), measured_of(c.second)});
  return table;
}

std::string note_on(const ComparedTimes& times, double least) {
  return fmt::format(
      "Processor times by process, the median over its rounds; the ratio of two runs is the median over all pairs of\n"
      "processes, with Mann and Whitney's interval, and all intervals hold together at 95 %. All tasks together take\n"
      "{} of the time of the first run: that is the machine's share, or of the build as a whole, and is taken out of\n"
      "each task. A change counts where the ratio is off by {:g} % or more, and its whole interval by half of that.",
      in_words(times.all), 100.0 * least);
}

}  // namespace

std::vector<ComparedSetting> compare_manifests(const Json& first, const Json& second) {
  const auto settings_of = [](Json manifest) {
    for (const char* key : {"started", "finished", "cpu_s", "wall_s"}) manifest.erase(key);
    std::string command;
    for (const Json& word : manifest.value("command_line", Json::array()))
      command += (command.empty() ? "" : " ") + word.get<std::string>();
    manifest["command_line"] = command;
    return manifest.flatten();
  };
  const Json a = settings_of(first), b = settings_of(second);
  std::vector<ComparedSetting> differing;
  const auto value = [](const Json& all, const std::string& path) {
    return all.contains(path) ? json_text(all.at(path)) : "-";
  };
  for (const auto& [path, of] : a.items())
    if (!b.contains(path) || b.at(path) != of) differing.push_back({path, json_text(of), value(b, path)});
  for (const auto& [path, of] : b.items())
    if (!a.contains(path)) differing.push_back({path, "-", json_text(of)});
  return differing;
}

Table table_of(const std::vector<ComparedSetting>& settings) {
  Table table({{"setting"}, {"first"}, {"second"}});
  for (const ComparedSetting& s : settings) table.add_row({s.path, s.first, s.second});
  return table;
}

Json to_data(const std::vector<ComparedSetting>& settings) {
  Json data = Json::array();
  for (const ComparedSetting& s : settings)
    data.push_back({{"path", s.path}, {"first", s.first}, {"second", s.second}});
  return data;
}

Report compare_study(const ComparePlan& plan) {
  const Json first = read_run(plan.first), second = read_run(plan.second);
  const auto label = [](const Json& run) { return run.at("findings").at("label").get<std::string>(); };
  if (label(first) != label(second))
    throw InputError(fmt::format("{} is a run of '{}' and {} one of '{}'; expected two runs of one study",
                                 plan.first.string(), label(first), plan.second.string(), label(second)));
  const auto settings = compare_manifests(first.at("manifest"), second.at("manifest"));
  const ComparedTimes times = compare_times(read_timed_tasks(plan.first), read_timed_tasks(plan.second), plan.least);
  const auto claims = changed_claims(first, second);

  Report report;
  report.opening = fmt::format("first: {}\nsecond: {}", plan.first.string(), plan.second.string());
  if (!settings.empty()) report.tables.push_back({"settings", "Settings that differ", table_of(settings)});
  if (!times.tasks.empty())
    report.tables.push_back({"times", "Times of tasks", table_of(times), note_on(times, plan.least)});
  if (!claims.empty()) report.tables.push_back({"verdicts", "Claims with another verdict", table_of(claims)});

  // other seeds draw other bodies and operations
  const bool same_seeds = first.at("manifest").value("seeds", Json()) == second.at("manifest").value("seeds", Json());
  std::size_t counts[4]{};
  for (const ComparedTask& t : times.tasks) {
    ++counts[static_cast<std::size_t>(t.verdict)];
    if (t.verdict == TimeVerdict::slower || t.verdict == TimeVerdict::faster)
      report.disagreements.push_back(fmt::format("{} is {}: {}", t.task, name(t.verdict), in_words(t.shift)));
    if (same_seeds && !t.same_state) report.disagreements.push_back(t.task + " leaves other bits");
  }
  for (const ComparedClaim& c : claims)
    if (is_change(c))
      report.disagreements.push_back(
          fmt::format("{} was '{}' and is '{}'", c.id, verdict_of(c.first), verdict_of(c.second)));
  report.sentence =
      fmt::format("{}: {} of {} take the same time, of {} this cannot tell; {} with another verdict.",
                  report.disagreements.empty() ? "No difference is found" : "The runs differ", counts[0],
                  counted(times.tasks.size(), "task", "tasks"), counts[3], counted(claims.size(), "claim", "claims"));

  report.numbers = {{"first", plan.first.string()}, {"second", plan.second.string()}};
  report.numbers["settings"] = to_data(settings);
  report.numbers["all_tasks"] = to_data(times.all);
  for (const ComparedTask& t : times.tasks) {
    Json row = to_data(t.shift);
    row.update({{"task", t.task},
                {"processes", {t.processes[0], t.processes[1]}},
                {"verdict", name(t.verdict)},
                {"same_bits", t.same_state}});
    report.numbers["tasks"].push_back(nlohmann::ordered_json(row));
  }
  report.numbers["alone"] = times.alone;
  for (const ComparedClaim& c : claims)
    report.numbers["claims"].push_back({{"id", c.id}, {"first", c.first}, {"second", c.second}});
  report.numbers["differences"] = report.disagreements;
  return report;
}

}  // namespace dartboard
