#include "benchmarks/studies/elements/operated_study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

// An operation that separates cells changes no summand of elements, and no order of summation. The stiffness of a
// spring is summed anew from the cells around each part of its edge, some forty at most: forty roundings of 1.1e-16 of
// its energy, which is less than half of all, and one of each sum of energies.
constexpr double most_jump = 1e-14;
// The reference is summed by other code from numbers of its own: a hundred roundings of some hundred summands.
constexpr double most_difference = 1e-13;

Claim claim_on(std::string id, std::string text, double bound, const std::vector<OperatedBody>& bodies,
               std::initializer_list<double ElementOperations::*> members) {
  double worst = bodies.empty() ? NAN : 0.0;
  for (const OperatedBody& body : bodies)
    for (const auto member : members) worst = max_or_nan(worst, body.found.*member);
  return target(std::move(id), std::move(text), fmt::format("<= {:.0e}", bound), fmt::format("{:.1e}", worst), "",
                met(worst <= bound));
}

}  // namespace

std::vector<Claim> claims_of(const std::vector<OperatedBody>& bodies) {
  using E = ElementOperations;
  std::size_t strangers = 0;
  for (const OperatedBody& body : bodies) strangers += body.found.strangers;
  return {claim_on("elements-dissociation", "what separates cells alone changes no energy", most_jump, bodies,
                   {&E::dissociation}),
          claim_on("elements-removal", "a removal takes the energy of the cell, as other code has it", most_difference,
                   bodies, {&E::removal}),
          claim_on("elements-rebuilt", "energies, forces and masses are those of a body that is built anew",
                   most_difference, bodies, {&E::energy, &E::force, &E::mass}),
          target("elements-materials", "each remaining cell has the corners and the material of its cell of the mesh",
                 "0 have not", fmt::format("{}", strangers), "", met(!bodies.empty() && strangers == 0))};
}

Table operations_table(const std::vector<OperatedBody>& bodies) {
  Table table({{"body"},
               {"cells", Align::right},
               {"model"},
               {"separations", Align::right},
               {"removals", Align::right},
               {"energy, separation", Align::right},
               {"energy, removal", Align::right},
               {"built anew", Align::right},
               {"energy", Align::right},
               {"forces", Align::right},
               {"masses", Align::right}});
  const auto small = [](double x) { return fmt::format("{:.1e}", x); };
  for (const auto& [body, cells, found] : bodies)
    table.add_row({body, std::to_string(cells), found.model, std::to_string(found.dissociated),
                   std::to_string(found.removed), small(found.dissociation), small(found.removal),
                   std::to_string(found.compared), small(found.energy), small(found.force), small(found.mass)});
  return table;
}

Report operated_study(const OperatedPlan& plan, StudyLog& log) {
  const std::size_t checks = (plan.each.operations + plan.each.check_every - 1) / plan.each.check_every;
  const std::vector<RegionMix> mixes = region_mixes();
  log.begin("validate elements --operations", plan.bodies.size() * mixes.size() * checks);
  std::vector<OperatedBody> bodies;
  for (const auto& [body, mesh] : plan.bodies)
    for (const RegionMix& mix : mixes) {
      const std::string what = fmt::format("{}, {}", body, mix.name);
      const ElementOperations found =
          operate_on_elements(mesh, mix, plan.each, [&](std::size_t) { log.advance(what); });
      bodies.push_back({body, mesh.cell_count(), found});
      log.sample({{"body", body},
                  {"cells", mesh.cell_count()},
                  {"model", mix.name},
                  {"seed", plan.each.seed},
                  {"dissociated", found.dissociated},
                  {"removed", found.removed},
                  {"compared", found.compared},
                  {"dissociation", found.dissociation},
                  {"removal", found.removal},
                  {"energy", found.energy},
                  {"force", found.force},
                  {"mass", found.mass},
                  {"strangers", found.strangers}});
    }
  Report report;
  report.claims = claims_of(bodies);
  report.tables = {
      {"operations",
       "Bodies of elements and springs, cut, torn and eroded at random: the largest differences, as parts of what was summed",
       operations_table(bodies)}};
  std::size_t operations = 0;
  for (const OperatedBody& body : bodies) operations += body.found.operations();
  report.sentence =
      fmt::format("{} random operations on {} bodies of {} mixes.", operations, plan.bodies.size(), mixes.size());
  return report;
}

}  // namespace dartboard
