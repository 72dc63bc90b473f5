#include "benchmarks/studies/scenes/simulation_json.h"

#include <algorithm>
#include <string>

#include "benchmarks/harness/json_number.h"

namespace dartboard {

nlohmann::ordered_json to_json(const Diagnostics& d, int dimension) {
  std::string stress(stress_name(dimension));
  std::ranges::replace(stress, ' ', '_');
  return {{"time", d.time},
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
}

nlohmann::ordered_json to_json(const EventJumps& jumps) {
  return {{"events", jumps.events},
          {"mass", jumps.mass},
          {"stiffness", jumps.stiffness},
          {"momentum", jumps.momentum},
          {"energy", jumps.energy}};
}

}  // namespace dartboard
