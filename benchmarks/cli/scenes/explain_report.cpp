#include "benchmarks/cli/scenes/explain_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/scenes/simulation_json.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/harness/tell.h"
#include "core/base/counted.h"
#include "core/scene/run/body_in_words.h"

namespace dartboard {
namespace {

std::string counts_of(const ScenePlan& plan) {
  const CellCounts& n = plan.counts;  // no body has one vertex
  return fmt::format("{} vertices, {}, {}, {}, {}", n.vertices, counted(n.edges, "edge"), counted(n.faces, "face"),
                     counted(n.cells, "cell"), counted(plan.darts, "dart"));
}

std::string step_text(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.4g} s", seconds) : "any length";
}

/// A forecast of the contacts.
std::string contact_text(const SceneFile& scene, const ContactPlan& plan) {
  Table table({{plan.expected.bodies.empty() ? "obstacle" : "key"},
               {"carries"},
               {"mass behind kg/m^2", Align::right},
               {"depth at rest m", Align::right},
               {"impact m/s", Align::right},
               {"depth at impact m", Align::right},
               {"over that of its law", Align::right}});
  const auto add = [&table](const std::string& path, const ContactLaw& law, const ContactForecast& f) {
    table.add_row({path, fmt::format("{:.4g} Pa at {:.4g} m", law.pressure, law.depth),
                   fmt::format("{:.4g}", f.mass_behind), fmt::format("{:.4g}", f.depth_at_rest),
                   fmt::format("{:.4g}", f.speed), fmt::format("{:.4g}", f.depth_at_impact),
                   fmt::format("{:.3g}", f.share)});
  };
  std::string bounces;
  const auto look_at_bounce = [&bounces](const std::string& path, const ContactLaw& law, const ContactForecast& f) {
    if (!f.keeps_restitution(law))
      bounces += fmt::format(
          "The restitution {:.4g} of {} is that of places; a body that is {:.2g} times as stiff as the contact bounces "
          "otherwise. ",
          law.restitution, path, f.stiffness_ratio);
  };
  for (std::size_t k = 0; k < plan.expected.obstacles.size(); ++k) {
    add(scene.obstacles[k].path, scene.obstacles[k].law, plan.expected.obstacles[k]);
    look_at_bounce(scene.obstacles[k].path, scene.obstacles[k].law, plan.expected.obstacles[k]);
  }
  for (const TouchForecast& touch : plan.expected.bodies) {
    add(touch.path, touch.law, touch.contact);
    look_at_bounce(touch.path, touch.law, touch.contact);
  }
  std::string text = to_text(table) + bounces;
  if (!std::isfinite(plan.body_step))
    text += fmt::format("Every step is stable with {}. ", scene.integrator);
  else
    text += fmt::format("The longest stable step at these depths is {}, which {} limits; of the body alone {}. ",
                        step_text(plan.stable_step),
                        plan.contact_rate > plan.body_rate ? "the stiffness of the contact" : "the body",
                        step_text(plan.body_step));
  return text +
         "Depths are those of a column as high as the body: an edge or a corner that comes first comes deeper.\n\n";
}

/// [J/kg] The largest kinetic energy that is removed when a component is put to sleep: all of it moves at the speed.
double removed_at_most(const SceneSleep& sleep) { return 0.5 * sleep.speed * sleep.speed; }

std::string sleep_text(const SceneSleep& sleep) {
  return fmt::format(
      "A component is put to sleep when none of its vertices has been faster than {:.6g} m/s for {:.6g} s; at most "
      "{:.4g} J of kinetic energy per kg are removed each time.\n\n",
      sleep.speed, sleep.time, removed_at_most(sleep));
}

}  // namespace

std::string to_text(const SceneFile& scene, const ScenePlan& plan, const std::optional<MeasuredSteps>& measured) {
  std::string text = fmt::format("{}\n{}; {}; {} of {:.6g} s\n", one_line(scene.name), map_in_words(plan.map),
                                 counts_of(plan), counted(plan.steps, "step"), scene.step);
  for (const SelectionCount& count : plan.selections) text += to_string(count) + "\n";
  for (const std::string& remark : plan.remarks) text += remark + "\n";
  text += "\n";
  Table table({{"part"}, {"bytes", Align::right}, {"what"}, {"why"}});
  for (const PlanItem& item : plan.items)
    table.add_row({std::string(item.name()), fmt::format("{}", item.bytes), item.what, item.why});
  for (const MemoryItem& item : plan.unplanned)
    table.add_row({std::string(name_of(item.part, item.which)), fmt::format("{}", item.bytes), "NOT PLANNED", ""});
  table.add_row({"in all", fmt::format("{}", plan.bytes()), "", ""});
  Table without({{"left out", Align::left}, {"because", Align::left}});
  for (const LeftOut& item : plan.left_out) without.add_row({item.what, item.why});
  text += to_text(table) + "\n" + to_text(without) + "\n";
  if (plan.contact) text += contact_text(scene, *plan.contact);
  if (scene.sleep) text += sleep_text(*scene.sleep);
  text +=
      "Bytes are those of the elements of all containers that live as long as the run, asked of the body as it was "
      "built; of a factor, its numbers.\n";
  if (!measured) return text;
  return text + fmt::format(
                    "\nMeasured: {:.0f} ns of processor time per step, with events and output, over {} of {}; the "
                    "median of three runs.\n",
                    measured->ns, measured->steps == plan.steps ? "all" : fmt::format("the first {}", measured->steps),
                    counted(plan.steps, "step"));
}

nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan,
                               const std::optional<MeasuredSteps>& measured) {
  nlohmann::ordered_json json{{"scene", scene.name},
                              {"map", plan.map},
                              {"integrator", scene.integrator},
                              {"steps", plan.steps},
                              {"counts",
                               {{"vertices", plan.counts.vertices},
                                {"edges", plan.counts.edges},
                                {"faces", plan.counts.faces},
                                {"cells", plan.counts.cells},
                                {"darts", plan.darts}}},
                              {"bytes", plan.bytes()}};
  json["selections"] = to_json(plan.selections);
  json["remarks"] = plan.remarks;
  json["plan"] = json["left_out"] = nlohmann::ordered_json::array();
  for (const PlanItem& item : plan.items)
    json["plan"].push_back({{"part", item.name()}, {"what", item.what}, {"why", item.why}, {"bytes", item.bytes}});
  if (plan.contact) {
    const auto or_null = [](double x) {
      return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json();
    };
    nlohmann::ordered_json contact{{"stable_step", or_null(plan.contact->stable_step)},
                                   {"stable_step_of_body", or_null(plan.contact->body_step)},
                                   {"contact_rate", plan.contact->contact_rate},
                                   {"body_rate", plan.contact->body_rate}};
    for (std::size_t k = 0; k < plan.contact->expected.obstacles.size(); ++k) {
      const ContactForecast& f = plan.contact->expected.obstacles[k];
      contact["obstacles"].push_back({{"path", scene.obstacles[k].path},
                                      {"mass_behind", f.mass_behind},
                                      {"depth_at_rest", f.depth_at_rest},
                                      {"speed", f.speed},
                                      {"depth_at_impact", f.depth_at_impact},
                                      {"allowed_depth", scene.obstacles[k].law.depth}});
    }
    for (const TouchForecast& touch : plan.contact->expected.bodies)
      contact["bodies"].push_back({{"path", touch.path},
                                   {"of", {touch.first, touch.second}},
                                   {"mass_behind", touch.contact.mass_behind},
                                   {"depth_at_rest", touch.contact.depth_at_rest},
                                   {"speed", touch.contact.speed},
                                   {"depth_at_impact", touch.contact.depth_at_impact},
                                   {"allowed_depth", touch.law.depth}});
    json["contact"] = std::move(contact);
  }
  if (scene.sleep)
    json["sleep"] = {{"speed", scene.sleep->speed},
                     {"time", scene.sleep->time},
                     {"removed_per_kg_at_most", removed_at_most(*scene.sleep)}};
  for (const LeftOut& item : plan.left_out) json["left_out"].push_back({{"what", item.what}, {"why", item.why}});
  for (const MemoryItem& item : plan.unplanned)
    json["unplanned"].push_back({{"part", name_of(item.part, item.which)}, {"bytes", item.bytes}});
  if (measured) json["measured"] = {{"ns_per_step", measured->ns}, {"steps", measured->steps}};
  return json;
}

}  // namespace dartboard
