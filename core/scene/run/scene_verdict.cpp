#include "core/scene/run/scene_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/disjoint_sets.h"
#include "core/scene/timeline/event_jumps.h"
#include "core/time/system/energy.h"

namespace dartboard {

std::optional<Eigen::Vector3d> centre_of_part(const SimulatedBody& body, std::uint32_t vertex) {
  if (vertex == SimulatedBody::no_vertex) return {};
  const SpringSystem system = body.system();
  // a spring is an edge of the map, and connected vertices are connected along edges
  DisjointSets parts(system.mass.size());
  for (const SpringEnds& ends : system.ends) parts.join(ends[0], ends[1]);
  for (const ForceTerm* term : system.terms)
    for (std::size_t piece = 0; piece < term->size() && term->is_within_cells(); ++piece)
      for (const std::uint32_t node : term->nodes(piece)) parts.join(term->nodes(piece)[0], node);
  double mass = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::uint32_t v = 0; v < system.mass.size(); ++v)
    if (parts.set_of(v) == parts.set_of(vertex)) {
      mass += system.mass[v];
      moment += system.mass[v] * body.vertices().position[v];
    }
  return moment / mass;
}

std::vector<ExpectedRow> compare_with_expectation(const SceneFile& scene, const Simulation& simulation,
                                                  const RunResult& result) {
  const Expectation& expect = scene.expect;
  std::vector<ExpectedRow> rows;
  const CellCounts counts = simulation.body().counts();
  const auto count = [&rows](const char* what, const std::optional<std::uint64_t>& expected, std::size_t actual) {
    if (expected) rows.push_back({what, fmt::format("{}", *expected), fmt::format("{}", actual), *expected == actual});
  };
  count("vertices", expect.vertices, counts.vertices);
  count("edges", expect.edges, counts.edges);
  count("faces", expect.faces, counts.faces);
  count("cells", expect.cells, counts.cells);
  count("components", expect.components, counts.components);
  if (expect.components_at_least)
    rows.push_back({"components", fmt::format("at least {}", *expect.components_at_least),
                    fmt::format("{}", counts.components), counts.components >= *expect.components_at_least});
  count("operations", expect.operations, simulation.operations());
  if (expect.mass) {
    // the masses of the cells and of the vertices, which a dissociation shares out: the worse one is reported
    const double of_cells = simulation.body().mass(), shared = kept_sums(simulation.body()).mass;
    const double mass = std::abs(of_cells - *expect.mass) >= std::abs(shared - *expect.mass) ? of_cells : shared;
    const double tolerance =
        5e-12 + static_cast<double>(std::max(counts.cells, scene.is_chain() ? counts.edges : 0)) * 0x1p-52;
    rows.push_back({"mass [kg]", fmt::format("{:.13g}", *expect.mass), fmt::format("{:.13g}", mass),
                    std::abs(mass - *expect.mass) <= tolerance * *expect.mass});
  }
  const auto at_most = [&rows](const char* what, const std::optional<double>& limit, double actual) {
    if (limit)
      rows.push_back({what, fmt::format("at most {:.6g}", *limit), fmt::format("{:.6g}", actual), actual <= *limit});
  };
  if (expect.kinetic_at_most)
    at_most("kinetic energy [J]", expect.kinetic_at_most,
            kinetic_energy(simulation.body().system(), simulation.body().vertices().velocity));
  at_most("energy drift", expect.energy_drift_at_most, result.energy_drift);
  const auto place_text = [](const Eigen::Vector3d& x) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
  };
  if (!expect.places.empty()) {
    const ProbeRow now = simulation.probes();
    for (const ExpectedPlace& place : expect.places) {
      std::optional<Eigen::Vector3d> found;
      if (place.of_part)
        found = centre_of_part(simulation.body(), simulation.body().tracked()[place.probe]);
      else if (const auto& probe = now.probes.at(place.probe))
        found = probe->position;
      rows.push_back(
          {fmt::format("place of {}{} [m]", place.of_part ? "the part of " : "", scene.probes.at(place.probe).name),
           fmt::format("{} within {:.6g}", place_text(place.position), place.within),
           found ? place_text(*found) : "removed", found && (*found - place.position).norm() <= place.within});
    }
  }
  if (expect.hash) {
    const std::uint64_t hash = simulation.body().state_hash();
    rows.push_back({"hash", fmt::format("{:016x}", *expect.hash), fmt::format("{:016x}", hash), hash == *expect.hash});
  }
  return rows;
}

}  // namespace dartboard
