#include "benchmarks/studies/elements/elements_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/studies/elements/calculix_study.h"
#include "benchmarks/studies/elements/newton_study.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

// Half the frequencies of a square beam are pairs: bending either way.
double bending_of(const CantileverAnswers& a) { return 0.5 * (a.frequency[0] + a.frequency[1]); }

constexpr std::array<std::pair<Model, CellKind>, 3> kinds{std::pair{Model::springs, CellKind::tetrahedron},
                                                          std::pair{Model::neo_hookean, CellKind::tetrahedron},
                                                          std::pair{Model::neo_hookean, CellKind::hexahedron}};

std::string percent(double share) { return fmt::format("{:+.1f} %", 100.0 * share); }

}  // namespace

ModelErrors errors_of(Model model, CellKind cells, int across, double poisson, const CantileverAnswers& truth) {
  const CantileverAnswers a = cantilever_of(model, across, poisson, cells);
  return {model,
          cells,
          across,
          poisson,
          a.nodes,
          a.work / truth.work - 1.0,
          bending_of(a) / bending_of(truth) - 1.0,
          a.frequency[2] / truth.frequency[2] - 1.0,
          a.frequency[5] / truth.frequency[5] - 1.0};
}

std::vector<Claim> claims_of(const ElementsResults& results) {
  // our own reference is trusted if another code has the same numbers
  double off = results.references.empty() ? NAN : 0.0;
  for (const auto& [published, ours] : results.references)
    for (const double ratio : {ours.work / published.work, bending_of(ours) / published.first,
                               ours.frequency[2] / published.torsion, ours.frequency[5] / published.axial})
      off = max_or_nan(off, std::abs(ratio - 1.0));
  Claim reference{.id = "elements-reference",
                  .text = "quadratic tetrahedra have the beam that 27-node hexahedra of another code have",
                  .paper_value = fmt::format("<= {:.0f} %", 100.0 * results.trusted),
                  .measured = fmt::format("{:.2f} %", 100.0 * off)};
  judge(reference, met(off <= results.trusted));

  // elements are conforming: they are too stiff, and less so the finer they are
  bool from_below = !results.errors.empty();
  const ModelErrors* before = nullptr;
  for (const ModelErrors& e : results.errors) {
    if (e.model == Model::springs) continue;
    const bool coarser = before != nullptr && before->poisson == e.poisson && before->cells == e.cells;
    from_below = from_below && e.tip > (coarser ? before->tip : -1.0) && e.tip < 0.0;
    before = &e;
  }
  Claim finer{.id = "elements-from-below",
              .text = "linear elements bend less than the truth, and nearer to it the finer they are",
              .paper_value = "always",
              .measured = from_below ? "always" : "not always"};
  judge(finer, met(from_below));
  return {reference, finer};
}

Table errors_table(const ElementsResults& results) {
  Table table({{"model"},
               {"Poisson's ratio", Align::right},
               {"across", Align::right},
               {"nodes", Align::right},
               {"tip", Align::right},
               {"bending", Align::right},
               {"torsion", Align::right},
               {"along the axis", Align::right}});
  for (const ModelErrors& e : results.errors)
    table.add_row({e.model == Model::springs         ? "springs"
                   : e.cells == CellKind::hexahedron ? "hexahedra"
                                                     : "tetrahedra",
                   fmt::format("{}", e.poisson), fmt::format("{}", e.across), fmt::format("{}", e.nodes),
                   percent(e.tip), percent(e.bending), percent(e.torsion), percent(e.axial)});
  return table;
}

Table references_table(const ElementsResults& results) {
  Table table({{"Poisson's ratio", Align::right},
               {"", Align::left},
               {"work [J]", Align::right},
               {"bending [1/s]", Align::right},
               {"torsion [1/s]", Align::right},
               {"along the axis [1/s]", Align::right}});
  for (const auto& [published, ours] : results.references) {
    table.add_row({fmt::format("{}", published.poisson), "quadratic tetrahedra", fmt::format("{:.4e}", ours.work),
                   fmt::format("{:.5f}", bending_of(ours)), fmt::format("{:.5f}", ours.frequency[2]),
                   fmt::format("{:.5f}", ours.frequency[5])});
    table.add_row({"", "27-node hexahedra", fmt::format("{:.4e}", published.work),
                   fmt::format("{:.5f}", published.first), fmt::format("{:.5f}", published.torsion),
                   fmt::format("{:.5f}", published.axial)});
  }
  return table;
}

Table costs_table(const ElementsResults& results) {
  Table table({{"model"},
               {"springs or elements", Align::right},
               {"ns each", Align::right},
               {"highest frequency [1/s]", Align::right},
               {"processor ms per simulated second", Align::right},
               {"over springs", Align::right}});
  for (const ModelCost& c : results.costs) {
    table.add_row({in_words(c.model, c.cells), fmt::format("{}", c.pieces),
                   fmt::format("{:.1f}", c.ns / static_cast<double>(std::max<std::size_t>(c.pieces, 1))),
                   fmt::format("{:.0f}", c.frequency), fmt::format("{:.1f}", 1e3 * c.per_second()),
                   c.model == Model::springs ? "1" : to_string(c.over_springs)});
  }
  return table;
}

std::string in_words(const ElementsResults& results) {
  const auto times_springs = [&](Model model, CellKind cells) {
    for (const ModelCost& c : results.costs)
      if (c.model == model && c.cells == cells)
        return fmt::format("{:.1f} ({:.1f} to {:.1f})", c.over_springs.median, c.over_springs.interval.low,
                           c.over_springs.interval.high);
    return std::string("?");
  };
  // at the first ratio, on the mesh whose cost was measured or the finest
  const auto errors = [&](bool springs, CellKind cells) {
    const ModelErrors* found = nullptr;
    for (const ModelErrors& e : results.errors)
      if ((e.model == Model::springs) == springs && e.cells == cells && e.poisson == results.errors.front().poisson &&
          (found == nullptr || e.across <= results.across))
        found = &e;
    return found;
  };
  const ModelErrors *springs = errors(true, CellKind::tetrahedron), *tets = errors(false, CellKind::tetrahedron),
                    *hexes = errors(false, CellKind::hexahedron);
  if (!springs || !tets || !hexes) return "";
  return fmt::format(
      "On {} nodes springs miss the tip by {} and torsion by {}, tetrahedra by {} and {}, hexahedra by {} and {}. For the "
      "same simulated time neo-hookean tetrahedra take {} times as long as springs, corotational ones {} times, "
      "neo-hookean hexahedra {} times.",
      springs->nodes, percent(springs->tip), percent(springs->torsion), percent(tets->tip), percent(tets->torsion),
      percent(hexes->tip), percent(hexes->torsion), times_springs(Model::neo_hookean, CellKind::tetrahedron),
      times_springs(Model::corotational, CellKind::tetrahedron),
      times_springs(Model::neo_hookean, CellKind::hexahedron));
}

Report elements_study(const ElementsPlan& plan, StudyLog& log) {
  ElementsResults results;
  results.across = plan.quick ? 2 : 4;
  results.trusted = plan.quick ? 0.03 : 0.01;
  const int truth_across = plan.quick ? 2 : 4;
  const std::vector<int> meshes = plan.quick ? std::vector{1, 2} : std::vector{1, 2, 4, 8};
  std::vector<CalculixQuestion> questions;
  if (plan.calculix) questions = calculix_questions(truth_across);
  log.begin("validate elements", published_cantilevers.size() + 2 * 3 * meshes.size() + 2 + questions.size());
  for (const PublishedCantilever& published : published_cantilevers) {
    results.references.emplace_back(published, quadratic_cantilever(truth_across, published.poisson));
    log.advance(fmt::format("quadratic tetrahedra, {}", published.poisson));
  }
  for (const std::size_t k : {0u, 2u})
    for (const auto& [model, cells] : kinds)  // near rest all laws are alike
      for (const int across : meshes) {
        const auto& [published, truth] = results.references[k];
        results.errors.push_back(errors_of(model, cells, across, published.poisson, truth));
        log.advance(fmt::format("{}, {} across", in_words(model, cells), across));
      }
  results.costs = element_costs({.processes = plan.quick ? 3 : 6,
                                 .rounds = plan.quick ? 4 : 20,
                                 .evaluations = plan.quick ? 20 : 200,
                                 .across = results.across},
                                log);
  log.advance("cost");

  const std::vector<NewtonRun> newton = newton_runs(truth_across);
  log.advance("Newton's method");
  std::vector<CalculixAnswer> answers;
  for (const CalculixQuestion& question : questions) {
    answers.push_back(answer_to(question, plan.calculix(question.deck)));
    log.advance("CalculiX: " + question.what);
  }

  Report report;
  report.claims = claims_of(results);
  report.claims.push_back(claim_on(newton));
  Table confined({{"Poisson's ratio", Align::right},
                  {"truth [E]", Align::right},
                  {"springs", Align::right},
                  {"tetrahedra", Align::right}});
  for (const double poisson : {0.25, 0.45}) {
    const auto in_young = [](double modulus) { return fmt::format("{:.3f}", modulus / cantilever::young); };
    confined.add_row({fmt::format("{}", poisson), in_young(confined_modulus(poisson)),
                      in_young(confined_modulus_of(Model::springs, poisson)),
                      in_young(confined_modulus_of(Model::neo_hookean, poisson))});
  }
  report.tables = {
      {"references", "The beam by two kinds of element: ours, and those of another code", references_table(results)},
      {"errors", "What models miss of it: work at the tip, frequencies", errors_table(results)},
      {"confined", "Stiffness of a slab that cannot expand sideways, in Young's moduli", std::move(confined)},
      {"costs",
       fmt::format("What they cost, {} across: one evaluation of forces, and a second at Verlet's longest step",
                   results.across),
       costs_table(results)},
      {"newton",
       fmt::format("Newton's method to a residual of {:.0e}: corotational tetrahedra, a load that is put on at once",
                   NewtonRun::residual),
       newton_table(newton)}};
  if (plan.calculix) {
    std::ranges::copy(claims_of(answers), std::back_inserter(report.claims));
    report.tables.push_back({"calculix", "The same meshes, clamps and loads in CalculiX", calculix_table(answers)});
    report.facts["calculix"] = plan.calculix_version;
  }
  report.limits = {
      "In torsion springs are too slow however fine the mesh is: six tetrahedra to a cube have directions of their own.",
      "The elements measured here are damped by viscosity alone, elements of surfaces are in no figure, and a factor that "
      "is kept is made anew after each cut."};
  report.sentence = in_words(results);
  for (const ModelCost& c : results.costs)
    log.sample({{"cost_of", in_words(c.model, c.cells)},
                {"across", results.across},
                {"pieces", c.pieces},
                {"ns", c.ns},
                {"over_springs", c.over_springs.median},
                {"frequency", c.frequency}});
  for (const ModelErrors& e : results.errors)
    log.sample({{"model", in_words(e.model, e.cells)},
                {"across", e.across},
                {"poisson", e.poisson},
                {"nodes", e.nodes},
                {"tip", e.tip},
                {"bending", e.bending},
                {"torsion", e.torsion},
                {"axial", e.axial}});
  for (const NewtonRun& run : newton)
    log.sample({{"newton", run.matrix},
                {"traction", run.traction},
                {"iterations", run.iterations ? nlohmann::json(*run.iterations) : nlohmann::json()},
                {"bent_by", run.bent}});
  for (const CalculixAnswer& a : answers)
    log.sample({{"calculix", a.what}, {"nodes", a.nodes}, {"bent_by", a.largest}, {"apart", a.apart}});
  return report;
}

}  // namespace dartboard
