#include "core/scene/diagnostics.h"

#include <fmt/format.h>

namespace dartboard {

std::string diagnostics_header() {
  return "time [s],kinetic [J],elastic [J],gravitational [J],momentum x [kg m/s],momentum y [kg m/s],"
         "momentum z [kg m/s],angular momentum x [kg m^2/s],angular momentum y [kg m^2/s],angular momentum z [kg "
         "m^2/s],"
         "mass [kg],vertices,edges,faces,cells,components,boundary,largest stress,operations\n";
}

std::string diagnostics_row(const Diagnostics& d) {
  std::string row;
  for (const double value : {d.time, d.kinetic, d.elastic, d.gravitational, d.momentum[0], d.momentum[1], d.momentum[2],
                             d.angular_momentum[0], d.angular_momentum[1], d.angular_momentum[2], d.mass})
    fmt::format_to(std::back_inserter(row), "{:.17g},", value);
  const CellCounts& n = d.counts;
  fmt::format_to(std::back_inserter(row), "{},{},{},{},{},{:.17g},{:.17g},{}\n", n.vertices, n.edges, n.faces, n.cells,
                 n.components, d.boundary, d.largest_stress, d.operations);
  return row;
}

}  // namespace dartboard
