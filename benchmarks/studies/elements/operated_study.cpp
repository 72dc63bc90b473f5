#include "benchmarks/studies/elements/operated_study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

// An operation that separates cells changes no summand, and no order of summation: any change is wrong.
constexpr double most_jump = 1e-14;
// The reference is summed by other code from numbers of its own: a hundred roundings of some hundred summands.
constexpr double most_difference = 1e-13;

constexpr Model models[] = {Model::neo_hookean, Model::corotational, Model::stvk};

Claim claim_on(std::string id, std::string text, double bound, const std::vector<OperatedBody>& bodies,
               std::initializer_list<double ElementOperations::*> members) {
  double worst = bodies.empty() ? NAN : 0.0;
  for (const OperatedBody& body : bodies)
    for (const auto member : members) worst = max_or_nan(worst, body.found.*member);
  Claim claim{.id = std::move(id),
              .text = std::move(text),
              .paper_value = fmt::format("<= {:.0e}", bound),
              .measured = fmt::format("{:.1e}", worst)};
  claim.verdict = worst <= bound ? Verdict::holds : Verdict::falls_short;
  return claim;
}

}  // namespace

std::vector<Claim> claims_of(const std::vector<OperatedBody>& bodies) {
  using E = ElementOperations;
  return {claim_on("elements-dissociation", "what separates cells alone changes no energy of elements", most_jump,
                   bodies, {&E::dissociation}),
          claim_on("elements-removal", "a removal takes the energy of the cell, as other code has it", most_difference,
                   bodies, {&E::removal}),
          claim_on("elements-rebuilt", "energies, forces and masses are those of a body that is built anew",
                   most_difference, bodies, {&E::energy, &E::force, &E::mass})};
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
    table.add_row({body, std::to_string(cells), std::string(name(found.model)), std::to_string(found.dissociated),
                   std::to_string(found.removed), small(found.dissociation), small(found.removal),
                   std::to_string(found.compared), small(found.energy), small(found.force), small(found.mass)});
  return table;
}

Report operated_study(const OperatedPlan& plan, StudyLog& log) {
  const std::size_t checks = (plan.each.operations + plan.each.check_every - 1) / plan.each.check_every;
  log.begin("validate elements --operations", plan.bodies.size() * std::size(models) * checks);
  std::vector<OperatedBody> bodies;
  for (const auto& [body, mesh] : plan.bodies)
    for (const Model model : models) {
      const std::string what = fmt::format("{}, {}", body, name(model));
      const ElementOperations found =
          operate_on_elements(mesh, model, plan.each, [&](std::size_t) { log.advance(what); });
      bodies.push_back({body, mesh.cell_count(), found});
      log.sample({{"body", body},
                  {"cells", mesh.cell_count()},
                  {"model", name(model)},
                  {"seed", plan.each.seed},
                  {"dissociated", found.dissociated},
                  {"removed", found.removed},
                  {"compared", found.compared},
                  {"dissociation", found.dissociation},
                  {"removal", found.removal},
                  {"energy", found.energy},
                  {"force", found.force},
                  {"mass", found.mass}});
    }
  Report report;
  report.claims = claims_of(bodies);
  report.tables = {
      {"operations",
       "Bodies of elements, cut, torn and eroded at random: the largest differences, as parts of what was summed",
       operations_table(bodies)}};
  std::size_t operations = 0;
  for (const OperatedBody& body : bodies) operations += body.found.operations();
  report.sentence =
      fmt::format("{} random operations on {} bodies by {} models.", operations, plan.bodies.size(), std::size(models));
  return report;
}

}  // namespace dartboard
