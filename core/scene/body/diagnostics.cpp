#include "core/scene/body/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dartboard {

std::string_view boundary_unit(int dimension) { return dimension == 3 ? "m^2" : "m"; }
std::string_view stress_unit(int dimension) { return dimension == 3 ? "Pa" : dimension == 2 ? "N/m" : "N"; }

std::string_view stress_name(int dimension) { return dimension > 0 ? "largest principal stress" : "largest tension"; }

std::string diagnostics_header(int dimension, bool with_applied, bool with_contact, bool with_sleep) {
  return fmt::format(
      "time [s],kinetic [J],elastic [J],gravitational [J],momentum x [kg m/s],momentum y [kg m/s],momentum z [kg m/s],"
      "angular momentum x [kg m^2/s],angular momentum y [kg m^2/s],angular momentum z [kg m^2/s],mass [kg],"
      "vertices,edges,faces,cells,components,boundary [{}],{} [{}],operations{}{}{}\n",
      boundary_unit(dimension), stress_name(dimension), stress_unit(dimension),
      with_applied ? ",applied forces [J]" : "",
      with_contact ? ",contact [J],lost by restitution [J],lost by friction [J],supplied at contacts [J],contacts,"
                     "deepest contact [m]"
                   : "",
      with_sleep ? ",components asleep,fallen asleep,woken,removed by sleep [J]" : "");
}

bool is_finite(const Diagnostics& d) {
  const ContactDiagnostics contact = d.contact.value_or(ContactDiagnostics{});
  const double numbers[] = {d.time,         d.kinetic,      d.elastic,        d.gravitational,
                            d.mass,         d.boundary,     d.largest_stress, d.applied.value_or(0.0),
                            contact.energy, contact.damped, contact.rubbed,   contact.supplied};
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }) && d.momentum.allFinite() &&
         d.angular_momentum.allFinite();
}

std::string diagnostics_row(const Diagnostics& d) {
  std::string row;
  const auto add = [&row](double value) {
    if (std::isfinite(value)) fmt::format_to(std::back_inserter(row), "{:.17g}", value);
    row += ',';
  };
  for (const double value : {d.time, d.kinetic, d.elastic, d.gravitational, d.momentum[0], d.momentum[1], d.momentum[2],
                             d.angular_momentum[0], d.angular_momentum[1], d.angular_momentum[2], d.mass})
    add(value);
  const CellCounts& n = d.counts;
  fmt::format_to(std::back_inserter(row), "{},{},{},{},{},", n.vertices, n.edges, n.faces, n.cells, n.components);
  add(d.boundary);
  add(d.largest_stress);
  row += fmt::format("{}", d.operations);
  const auto add_after = [&row](double value) { row += std::isfinite(value) ? fmt::format(",{:.17g}", value) : ","; };
  if (d.applied) add_after(*d.applied);
  if (d.contact) {
    for (const double value : {d.contact->energy, d.contact->damped, d.contact->rubbed, d.contact->supplied})
      add_after(value);
    row += fmt::format(",{}", d.contact->contacts);
    add_after(d.contact->deepest);
  }
  if (d.sleep) {
    row += fmt::format(",{},{},{}", d.sleep->asleep, d.sleep->slept, d.sleep->woken);
    add_after(d.sleep->removed);
  }
  return row + "\n";
}

}  // namespace dartboard
