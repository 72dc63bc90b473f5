#include "core/scene/survey/scene_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/plain/error.h"
#include "core/scene/survey/cut_counts.h"
#include "core/scene/survey/free_shapes.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

/// The number of facets between cells of a body at rest.
std::size_t inner_facets(const Mesh& mesh, const CellCounts& counts) {
  if (is_mixed(mesh)) return count_inner_facets(mesh);
  const bool is_volume = mesh.highest_dimension() == 3;
  std::size_t of_cells = 0;
  for (const CellKind kind : mesh.kinds)
    of_cells += is_volume ? faces_of(kind).size() : static_cast<std::size_t>(node_count(kind));
  return of_cells - (is_volume ? counts.faces : counts.edges);
}

std::vector<SelectionCount> count_all(const SceneFile& scene, const Mesh& mesh, const Simulation& simulation) {
  std::vector<SelectionCount> counts = count_selections(scene, mesh);
  std::optional<std::size_t> all;
  for (std::size_t e = 0; e < scene.events.size(); ++e)
    if (const auto facets = simulation.facets_of_events()[e]) {
      if (!all) all = inner_facets(mesh, simulation.counts_at_rest());
      counts.push_back(count_cut(scene.events[e], mesh, *facets, *all));
    }
  return counts;
}

/// Another integrator for the same step, in a sentence; empty without one.
///
/// A method that damps cell by cell, there and back, evaluates the tangent of each twice in a step: 2.3 to 4.4 times
/// the cost of a damped step of RK4 (tetrahedra and hexahedra, neo-Hookean and corotational).
std::string cheaper_integrator(const SceneFile& scene, const CellMaterials& materials, const Simulation& simulation) {
  const Scheme& scheme = scheme_of(scene.integrator);
  const auto is_damped = [](const Material& m) { return m.model != Model::springs && m.damping_time > 0.0; };
  if (!scheme.sweeps || !scheme.symmetric || !std::ranges::any_of(materials.all(), is_damped)) return "";
  const Scheme& other = scheme_of("rk4");
  if (simulation.step() > simulation.stable_step().limit(other, horizon_of(scene.duration)).stable) return "";
  return fmt::format(
      "{} goes through the damping of elements cell by cell, there and back; rk4 is stable at this step too, and takes it "
      "in less than half of the time",
      scene.integrator);
}

/// The size of the factor of implicit steps, where each takes a second or more; a body too small for that is not asked.
std::string large_factor(const SceneFile& scene, const Simulation& simulation) {
  constexpr std::size_t enough_vertices = 10'000;
  if (simulation.body().counts().vertices < enough_vertices) return "";
  double unknowns = 3.0 * static_cast<double>(simulation.body().counts().vertices);
  std::string size;
  try {
    const std::optional<FactorForecast> factor = simulation.factor_forecast();
    if (!factor || factor->seconds < 1.0) return "";
    unknowns = static_cast<double>(factor->unknowns);
    const auto numbers = static_cast<double>(factor->numbers);
    size = fmt::format("has {:.3g} million numbers ({:.2g} GB) and takes some {:.2g} s each time that it is made",
                       1e-6 * numbers, 8e-9 * numbers, factor->seconds);
  } catch (const SolverError&) {
    size = "does not fit into memory";
  }
  const bool has_choice = std::ranges::any_of(integrators(), [&scene](const IntegratorEntry& entry) {
    return entry.name == scene.integrator && entry.make_with != nullptr;
  });
  return fmt::format("an implicit step has {:.3g} thousand unknowns here: a factor of its matrix {}{}", 1e-3 * unknowns,
                     size, has_choice ? "; \"solver\": \"conjugate-gradients\" needs none" : "");
}

}  // namespace

SceneSurvey survey_scene(const SceneFile& scene, const Problem& problem, const Simulation& simulation) {
  SceneSurvey survey;
  const CellMaterials materials = problem.cell_materials();
  for (std::size_t m = model_names.size(); m-- > 0;)
    if (materials.any(static_cast<Model>(m))) survey.models.push_back(static_cast<Model>(m));
  std::map<CellKind, std::size_t> cells_of_springs;
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c)
    if (materials[c].model == Model::springs) ++cells_of_springs[problem.mesh.kinds[c]];
  survey.free_shapes = free_shapes_of(cells_of_springs, scene.diagonals);
  try {
    survey.selections = count_all(scene, problem.mesh, simulation);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", scene.file, error.what()));
  }
  survey.stiff_bodies = find_stiff_bodies(scene, problem);
  survey.sags = find_sags(scene, problem);
  for (std::string note : {cheaper_integrator(scene, materials, simulation), large_factor(scene, simulation)})
    if (!note.empty()) survey.notes.push_back(std::move(note));
  // steps too long and coordinates too large have warnings of their own
  const Preflight found = simulation.check_before_run();
  if (found.warns_of(StepCode::coordinate_precision)) survey.coarse_coordinate = simulation.find_coarse_coordinate();
  for (StepResult warning : found.warnings) {
    if (warning.code == StepCode::unstable_step || warning.code == StepCode::coordinate_precision ||
        warning.quantity == step_times_frequency)
      continue;
    if (warning.witness == Witness::vertex) warning.number = simulation.file_number(warning.number);
    survey.warnings.push_back(warning);
  }
  return survey;
}

}  // namespace dartboard
