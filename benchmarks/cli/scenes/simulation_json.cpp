#include "benchmarks/cli/scenes/simulation_json.h"

#include <algorithm>
#include <string>

#include "benchmarks/harness/json_number.h"

namespace dartboard {

nlohmann::ordered_json to_json(const Diagnostics& d, int dimension) {
  std::string stress(stress_name(dimension));
  std::ranges::replace(stress, ' ', '_');
  nlohmann::ordered_json json{{"time", d.time},
                              {"kinetic", number(d.kinetic)},
                              {"elastic", number(d.elastic)},
                              {"gravitational", number(d.gravitational)},
                              {"mass", d.mass},
                              {"vertices", d.counts.vertices},
                              {"edges", d.counts.edges},
                              {"faces", d.counts.faces},
                              {"cells", d.counts.cells},
                              {"components", d.counts.components},
                              {"boundary", number(d.boundary)},
                              {stress, number(d.largest_stress)},
                              {"operations", d.operations}};
  if (d.applied) json["applied_forces"] = number(*d.applied);
  if (d.contact) {
    json["contact"] = number(d.contact->energy);
    json["lost_by_restitution"] = number(d.contact->damped);
    json["lost_by_friction"] = number(d.contact->rubbed);
    json["supplied_at_contacts"] = number(d.contact->supplied);
    json["contacts"] = d.contact->contacts;
    json["deepest_contact"] = number(d.contact->deepest);
  }
  if (d.sleep) {
    json["components_asleep"] = d.sleep->asleep;
    json["fallen_asleep"] = d.sleep->slept;
    json["woken"] = d.sleep->woken;
    json["removed_by_sleep"] = number(d.sleep->removed);
  }
  return json;
}

nlohmann::ordered_json to_json(std::span<const SelectionCount> selections) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SelectionCount& count : selections)
    json.push_back({{"path", count.path},
                    {"of_what", count.of_what},
                    {"selected", count.selected},
                    {"all", count.all},
                    {"just_outside", count.just_outside},
                    {"along", count.along}});
  return json;
}

nlohmann::ordered_json to_json(const EventJumps& jumps) {
  return {{"events", jumps.events},     {"mass", jumps.mass},     {"stiffness", jumps.stiffness},
          {"momentum", jumps.momentum}, {"energy", jumps.energy}, {"contact", jumps.contact}};
}

}  // namespace dartboard
