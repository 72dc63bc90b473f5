#include "core/scene/survey/scene_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/time/integrators.h"
#include "core/time/watch/preflight.h"

namespace dartboard {
namespace {

std::string what_to_do_about(const StepWarning& warning, const SceneFile& scene, const Simulation& simulation) {
  if (warning.parts > 1) return "";
  std::string other = "an implicit integrator";
  const StableStep& limits = simulation.stable_step();
  const bool is_close = limits.lower > 0.0;
  const Scheme& verlet = scheme_of("verlet");
  if (const double step = limits.safe_step(verlet, horizon_of(scene.duration)); is_close && step > 2.0 * warning.stable)
    other = fmt::format("verlet, whose step the damping does not limit: {:.3g} s is stable", step);
  return fmt::format("; set {} to at most {:.3g}, \"unstable_step\" to \"substep\", or take {}",
                     scene.accuracy ? "'step' in place of /accuracy" : "/step", warning.stable, other);
}

/// For tearing by stress: how far the stress is from the threshold.
std::string why_idle(const std::string& path, const SceneFile& scene, const Simulation& simulation) {
  for (const SceneEvent& event : scene.events)
    if (const auto* tear = std::get_if<TearWhereStressed>(&event.action); tear != nullptr && event.path == path)
      return fmt::format(": the largest principal stress is {:.4g}, its threshold {:.4g}",
                         simulation.body().largest_stress(), tear->threshold);
  return "";
}

}  // namespace

std::vector<std::string> warnings_of(const SceneFile& scene, const SceneSurvey& survey, const Simulation& simulation) {
  std::vector<std::string> said;
  if (const auto& warning = simulation.step_warning())
    said.push_back(to_string(*warning, simulation.step(), scene.integrator) +
                   what_to_do_about(*warning, scene, simulation));
  std::ranges::move(warnings_but_of_step(scene, survey, simulation), std::back_inserter(said));
  return said;
}

std::vector<std::string> warnings_but_of_step(const SceneFile& scene, const SceneSurvey& survey,
                                              const Simulation& simulation) {
  std::vector<std::string> said;
  const auto& coarse = survey.coarse_coordinate ? survey.coarse_coordinate : simulation.coordinate_warning();
  if (coarse) said.push_back(to_string(*coarse) + " (/body/translate)");
  for (const StepResult& warning : survey.warnings) said.push_back(explained(warning));
  std::vector<std::string> obstacles, bodies;
  for (const BodySource& one : scene.bodies()) bodies.push_back(one.path);
  for (const SceneObstacle& one : scene.obstacles) obstacles.push_back(one.path);
  for (ContactWarning warning : simulation.contact_warnings()) {
    for (std::uint32_t& vertex : warning.nodes) vertex = simulation.file_number(vertex);
    said.push_back(to_string(warning, obstacles, bodies));
  }
  for (const StiffBody& body : survey.stiff_bodies) said.push_back(to_string(body));
  for (const Sag& sag : survey.sags) said.push_back(to_string(sag));
  for (const SelectionCount& count : survey.selections)
    if (count.just_outside > 0) said.push_back(near_miss(count));
  if (!survey.free_shapes.empty()) said.push_back(survey.free_shapes);
  // an event that was due at the start may still have an effect
  if (simulation.steps_done() == 0 && simulation.step_count() > 0) return said;
  for (const std::string& path : simulation.idle_events())
    said.push_back(fmt::format("the event at {} never did anything{}", path, why_idle(path, scene, simulation)));
  return said;
}

std::string step_in_words(const Simulation& simulation, const SceneFile& scene) {
  if (scheme_of(scene.integrator).implicit)
    return fmt::format("motions faster than {:.3g} Hz are not resolved",
                       1.0 / (2.0 * std::numbers::pi * simulation.step()));
  // a close estimate takes a third of the start of a body of two million tetrahedra
  constexpr std::size_t many_vertices = 50'000;
  const bool has_close = simulation.stable_step().lower > 0.0;
  const bool is_quick = !has_close && simulation.body().vertices().size() >= many_vertices;
  const double longest = (has_close || is_quick ? simulation.step_limit_found() : simulation.step_limit()).stable;
  if (!std::isfinite(longest)) return "every step is stable";
  const std::uint64_t parts = simulation.step_warning() ? simulation.step_warning()->parts : 1;
  const double share = simulation.step() / static_cast<double>(parts) / longest;
  // with enough digits to distinguish it from the longest
  const std::string digits = std::abs(share - 1.0) < 0.05 ? fmt::format("{:.4g}", share) : fmt::format("{:.2g}", share);
  return parts > 1 ? fmt::format("taken in {} parts, each {} of the longest stable step", parts, digits)
                   : fmt::format("{}{} of the longest stable step", is_quick ? "at most " : "", digits);
}

}  // namespace dartboard
