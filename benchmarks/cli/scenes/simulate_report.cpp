#include "benchmarks/cli/scenes/simulate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/cli/scenes/simulation_json.h"
#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/tell.h"
#include "core/base/counted.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/run/body_in_words.h"
#include "core/scene/survey/scene_warnings.h"

namespace dartboard {
namespace {

std::string drift_text(double drift) { return drift == 0.0 ? "0" : fmt::format("{:.2e}", drift); }

/// "springs", "neo-hookean elements, springs"
std::string in_words(std::span<const Model> models) {
  std::string said;
  for (const Model model : models)
    said += fmt::format("{}{}{}", said.empty() ? "" : ", ", name(model), model == Model::springs ? "" : " elements");
  return said;
}

/// The advice on the step of a run that diverged; empty where every step is stable.
std::string step_advice(const Divergence& divergence, const SimulationReport& r) {
  if (!std::isfinite(divergence.stable)) return "";
  const double step = r.simulation.step();
  if (step > divergence.stable)
    return fmt::format(" A step of {:.6g} s is too long for that state: at most {:.6g} s is stable.", step,
                       divergence.stable);
  const bool has_elements = !r.survey.models.empty() && r.survey.models.front() != Model::springs;
  return fmt::format(" The longest stable step of that state is {:.6g} s{}.", divergence.stable,
                     has_elements ? ", and a shorter one where elements are deformed further" : "");
}

}  // namespace

Table summary_of(const SimulationReport& r) {
  Table table({{"quantity", Align::left}, {"start", Align::right}, {"end", Align::right}});
  const Diagnostics &first = r.result.first, &last = r.result.last;
  const auto shown = [](double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : "-"; };
  const auto row = [&](const std::string& what, double start, double end) {
    table.add_row({what, shown(start), shown(end)});
  };
  const auto counts = [&table](const char* what, std::size_t start, std::size_t end) {
    table.add_row({what, fmt::format("{}", start), fmt::format("{}", end)});
  };
  row("time [s]", first.time, last.time);
  counts("steps", 0, r.kept_step());
  counts("operations", first.operations, last.operations);
  counts("vertices", first.counts.vertices, last.counts.vertices);
  counts("edges", first.counts.edges, last.counts.edges);
  counts("faces", first.counts.faces, last.counts.faces);
  counts("cells", first.counts.cells, last.counts.cells);
  counts("components", first.counts.components, last.counts.components);
  row("mass [kg]", first.mass, last.mass);
  row("kinetic energy [J]", first.kinetic, last.kinetic);
  row("elastic energy [J]", first.elastic, last.elastic);
  row("gravitational energy [J]", first.gravitational, last.gravitational);
  if (first.applied && last.applied) row("potential of applied forces [J]", *first.applied, *last.applied);
  if (first.contact && last.contact) {
    row("contact energy [J]", first.contact->energy, last.contact->energy);
    row("lost by restitution [J]", first.contact->damped, last.contact->damped);
    row("lost by friction [J]", first.contact->rubbed, last.contact->rubbed);
    row("supplied at contacts [J]", first.contact->supplied, last.contact->supplied);
    counts("contacts", first.contact->contacts, last.contact->contacts);
    row("deepest contact [m]", first.contact->deepest, last.contact->deepest);
  }
  if (first.sleep && last.sleep) {
    counts("components asleep", first.sleep->asleep, last.sleep->asleep);
    counts("fallen asleep", first.sleep->slept, last.sleep->slept);
    counts("woken", first.sleep->woken, last.sleep->woken);
    row("kinetic energy removed by sleep [J]", first.sleep->removed, last.sleep->removed);
  }
  const int dimension = r.simulation.dimension();
  row(fmt::format("boundary [{}]", boundary_unit(dimension)), first.boundary, last.boundary);
  row(fmt::format("{} [{}]", stress_name(dimension), stress_unit(dimension)), first.largest_stress,
      last.largest_stress);
  return table;
}

std::string opening_of(const SceneFile& scene, const SceneSurvey& survey, const Simulation& simulation,
                       std::string_view step_in_words) {
  std::string said = fmt::format("{}\n{}, {}, h = {:.6g} s ({})\n{}: {}\n", one_line(scene.name),
                                 map_in_words(simulation.body().map_name()), scene.integrator, scene.step,
                                 step_in_words, in_words(survey.models), in_words(simulation.body()));
  for (const SelectionCount& count : survey.selections) said += to_string(count) + "\n";
  for (const std::string& note : survey.notes) said += "note: " + note + "\n";
  return said + "\n";
}

std::string to_text(const SimulationReport& r) {
  std::string said;
  const auto say = [&said]<class... T>(fmt::format_string<T...> format, T&&... arguments) {
    said += fmt::format(format, std::forward<T>(arguments)...);
  };
  say("{}\n", to_text(summary_of(r)));
  if (r.settled) {
    say("{}\n", to_string(*r.settled));
    for (const std::string& omission : r.settled->omissions) say("  {}\n", omission);
  }
  const auto steps = static_cast<double>(r.simulation.steps_done() - r.steps_before);
  const std::string pace = steps > 0 ? fmt::format(", {:.3g} microseconds per step", r.cpu_s / steps * 1e6) : "";
  say("wall {:.3g} s, processor {:.3g} s{}, events and output included\n", r.wall_s, r.cpu_s, pace);
  if (r.simulation.body().removed_mass() > 0.0)
    say("mass unaccounted for after removals: {} of the mass\n", drift_text(r.mass_drift()));
  const EventJumps& jumps = r.simulation.jumps();
  if (jumps.events > 0)
    say("largest jump at {} that {}: mass {}, stiffness {}, momentum {}, kinetic and elastic energy {}{} "
        "(relative)\n",
        counted(jumps.events, "event"), jumps.events == 1 ? "dissociates" : "dissociate", drift_text(jumps.mass),
        drift_text(jumps.stiffness), drift_text(jumps.momentum), drift_text(jumps.energy),
        jumps.contact == 0.0 ? "" : fmt::format(", energy of contacts {}", drift_text(jumps.contact)));
  say("hash of the last state {:016x}\n", r.simulation.body().state_hash());
  for (const std::string& warning : warnings_of(r.scene, r.survey, r.simulation))
    if (std::ranges::find(r.warned, warning) == r.warned.end()) say("warning: {}\n", warning);
  if (r.result.divergence)
    say("\nThe motion {}. The state of step {}, t = {:.6g} s is kept, and what was written until then.{}\n",
        to_string(*r.result.divergence), r.kept_step(), r.result.last.time, step_advice(*r.result.divergence, r));
  if (r.result.refusal) say("\nThe motion {}. What was written until then is kept.\n", to_string(*r.result.refusal));
  if (!r.expected.empty()) {
    Table table(
        {{"expected", Align::left}, {"by the scene", Align::right}, {"found", Align::right}, {"holds", Align::left}});
    for (const ExpectedRow& row : r.expected)
      table.add_row({row.what, row.expected, row.actual, row.holds ? "yes" : "NO"});
    say("\n{}", to_text(table));
  }
  if (!r.unjudged.empty()) say("\n{}\n", r.unjudged);
  if (!r.folder.empty())
    say("\n{}, frames.pvd, diagnostics.csv{} written to {}.\n", counted(r.frames, "frame"),
        r.scene.probes.empty() ? "" : ", probes.csv", r.folder);
  if (r.continues_after)
    say("From its checkpoint of step {} the run goes on with: dartboard simulate --continue {}\n", *r.continues_after,
        r.folder);
  else if (r.result.interrupted && !r.folder.empty())
    say("It left no checkpoint: the step that was given up could not be taken back.\n");
  if (!r.picture.empty()) say("{}\n", r.picture);
  return said;
}

nlohmann::ordered_json to_json(const SimulationReport& r) {
  nlohmann::ordered_json json{{"scene", r.scene.name},
                              {"map", r.simulation.body().map_name()},
                              {"integrator", r.scene.integrator},
                              {"selections", to_json(r.survey.selections)},
                              {"steps", r.simulation.steps_done()},
                              {"first", to_json(r.result.first, r.simulation.dimension())},
                              {"last", to_json(r.result.last, r.simulation.dimension())},
                              {"hash", fmt::format("{:016x}", r.simulation.body().state_hash())},
                              {"wall_s", r.wall_s},
                              {"cpu_s", r.cpu_s},
                              {"mass_drift", r.mass_drift()},
                              {"jumps", to_json(r.simulation.jumps())}};
  const bool is_judged = !r.expected.empty() || r.result.ended_early();
  json["holds"] = is_judged ? nlohmann::ordered_json(r.holds()) : nlohmann::ordered_json();
  json["divergence"] = nullptr;
  if (const auto& d = r.result.divergence)
    json["divergence"] = {{"step", d->step},
                          {"time", d->time},
                          {"quantity", d->quantity},
                          {"vertex", d->vertex},
                          {"taken_back", d->taken_back},
                          {"kept_step", r.kept_step()},
                          {"kept_time", r.result.last.time},
                          {"stable", number(d->stable)},
                          {"value", number(d->value)}};
  json["refusal"] = nullptr;
  if (const auto& refusal = r.result.refusal)
    json["refusal"] = {
        {"step", refusal->step}, {"time", refusal->time}, {"why", refusal->why}, {"stable", number(refusal->stable)}};
  json["warnings"] = warnings_of(r.scene, r.survey, r.simulation);
  json["idle_events"] = r.simulation.idle_events();
  json["expected"] = nlohmann::ordered_json::array();
  for (const ExpectedRow& row : r.expected)
    json["expected"].push_back(
        {{"what", row.what}, {"expected", row.expected}, {"actual", row.actual}, {"holds", row.holds}});
  if (r.settled) json["settled"] = nlohmann::json(*r.settled);
  if (!r.unjudged.empty()) json["unjudged"] = r.unjudged;
  json["interrupted"] = r.result.interrupted;
  if (!r.folder.empty()) json["folder"] = r.folder;
  return json;
}

}  // namespace dartboard
