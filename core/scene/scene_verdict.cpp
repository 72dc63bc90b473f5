#include "core/scene/scene_verdict.h"

#include <fmt/format.h>

#include <cmath>

namespace dartboard {

std::vector<ExpectedRow> compare_with_expectation(const Expectation& expect, const Simulation& simulation) {
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
    const double mass = simulation.body().mass();
    const double tolerance = 5e-12 + static_cast<double>(counts.cells) * 0x1p-52;
    rows.push_back({"mass [kg]", fmt::format("{:.13g}", *expect.mass), fmt::format("{:.13g}", mass),
                    std::abs(mass - *expect.mass) <= tolerance * *expect.mass});
  }
  if (expect.hash) {
    const std::uint64_t hash = simulation.body().state_hash();
    rows.push_back({"hash", fmt::format("{:016x}", *expect.hash), fmt::format("{:016x}", hash), hash == *expect.hash});
  }
  return rows;
}

}  // namespace dartboard
