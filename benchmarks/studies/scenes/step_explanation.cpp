#include "benchmarks/studies/scenes/step_explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/harness/tell.h"
#include "core/plain/error.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr std::size_t shown = 5;

SpringColumns columns_of(const SimulatedBody& body) {
  const SpringSystem system = body.system();
  SpringColumns columns;
  columns.ends.assign(system.ends.begin(), system.ends.end());
  columns.springs.assign(system.springs.begin(), system.springs.end());
  columns.mass.assign(system.mass.begin(), system.mass.end());
  columns.inverse_mass.assign(system.inverse_mass.begin(), system.inverse_mass.end());
  columns.viscosity.assign(system.viscosity.begin(), system.viscosity.end());
  columns.fixed.assign(system.fixed.begin(), system.fixed.end());
  columns.gravity = system.gravity;
  columns.x.assign(body.vertices().position.begin(), body.vertices().position.end());
  return columns;
}

std::vector<StepShare> largest_shares(const std::vector<double>& energy) {
  std::vector<std::uint32_t> order(energy.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto count = std::min(shown, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count),
                            [&energy](auto a, auto b) { return energy[a] > energy[b]; });
  const double sum = std::accumulate(energy.begin(), energy.end(), 0.0);
  std::vector<StepShare> shares;
  for (std::size_t k = 0; k < count; ++k)
    if (energy[order[k]] > 0.0) shares.push_back({order[k], energy[order[k]] / sum});
  return shares;
}

/// The springs and vertices that the fastest oscillation moves most.
void find_shares(StepExplanation& e) {
  // power iterations for the shape: a tenth of a percent of omega_max is left after 100 of them,
  // and the shape converges at half that rate
  StableStepEstimate estimate;
  const SpringSystem system = e.body.system();
  estimate.refresh(system, e.body.x);
  for (int k = 0; k < 300; ++k) estimate.follow(system, e.body.x);
  const auto shape = estimate.shape();
  if (shape.empty()) return;
  std::vector<double> stretched(system.springs.size(), 0.0), moved(system.vertex_count(), 0.0);
  std::vector<SpringTangent> tangents;
  evaluate_tangents(system, e.body.x, Compression::projected, tangents);
  const auto displacement = [&](std::uint32_t i) -> Vector3d { return shape[i] * std::sqrt(system.inverse_mass[i]); };
  for (std::size_t s = 0; s < stretched.size(); ++s) {
    const auto [i, j] = system.ends[s];
    const Vector3d d = displacement(j) - displacement(i);
    stretched[s] = d.dot(tangents[s].stiffness() * d);
  }
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = shape[i].squaredNorm();
  e.springs = largest_shares(stretched);
  e.vertices = largest_shares(moved);
}

void find_remedies(StepExplanation& e, const Scheme& scheme, const Horizon& horizon) {
  if (e.springs.empty()) return;
  const auto remedy = [&](std::string what, auto&& change) {
    SpringColumns changed = e.body;
    change(changed);
    const StableStep limits = StableStepEstimate().refresh(changed.system(), changed.x);
    e.remedies.push_back({std::move(what), limits.safe_step(scheme, horizon)});
  };
  const auto scale_springs = [&e](std::size_t count, double factor) {
    return [&e, count, factor](SpringColumns& c) {
      for (std::size_t k = 0; k < std::min(count, e.springs.size()); ++k)
        for (double* value : {&c.springs[e.springs[k].number].stiffness, &c.springs[e.springs[k].number].damping})
          *value *= factor;
    };
  };
  const auto double_mass = [](SpringColumns& c, std::uint32_t vertex) {
    c.mass[vertex] *= 2.0;
    c.inverse_mass[vertex] /= 2.0;
  };
  remedy("halve the stiffness of the first spring", scale_springs(1, 0.5));
  remedy("remove the first spring", scale_springs(1, 0.0));
  remedy(fmt::format("halve the stiffness of the {} springs", e.springs.size()), scale_springs(shown, 0.5));
  remedy(fmt::format("remove the {} springs", e.springs.size()), scale_springs(shown, 0.0));
  remedy("double the mass of the first vertex", [&](SpringColumns& c) { double_mass(c, e.vertices.front().number); });
  remedy(fmt::format("double the mass of the {} vertices", e.vertices.size()), [&](SpringColumns& c) {
    for (const StepShare& v : e.vertices) double_mass(c, v.number);
  });
  remedy("hold the first vertex", [&e](SpringColumns& c) { c.inverse_mass[e.vertices.front().number] = 0.0; });
  remedy("halve all stiffnesses", [](SpringColumns& c) {
    for (Spring& s : c.springs) s.stiffness /= 2.0;
  });
}

std::string step_text(double step) { return std::isfinite(step) ? fmt::format("{:.6g} s", step) : "any"; }

}  // namespace

StepExplanation explain_step(SceneFile scene) {
  if (scene.has_contact())
    throw InputError(
        fmt::format("{}: /contact: stiffens a body where it touches, which no spring is to blame for; "
                    "expected none, or 'dartboard explain', which tells the longest stable step",
                    scene.file));
  scene.unstable_step = UnstableStep::warn;  // a step that the scene refuses is what is to be explained
  const Simulation simulation(scene);
  const auto integrator = make_integrator(scene.integrator);
  const Horizon horizon = horizon_of(scene.duration);
  StepExplanation e;
  e.body = columns_of(simulation.body());
  const SpringSystem system = simulation.body().system();
  e.limits = StableStepEstimate().refresh(system, e.body.x);
  e.limit = simulation.step_limit();
  e.quick = quick_stable_step(system).safe_step(integrator->scheme(), horizon);
  if (!system.terms.empty()) return e;  // there is no spring to blame
  find_shares(e);
  find_remedies(e, integrator->scheme(), horizon);
  return e;
}

std::string to_text(const StepExplanation& e, const SceneFile& scene) {
  std::string text = fmt::format("{}\n{}, h = {:.6g} s\n\n", one_line(scene.name), scene.integrator, scene.step);
  const bool bounded = std::isfinite(e.limits.any_state);  // elements stiffen without end as they are deformed
  text += fmt::format("highest frequency: {:.6g} to {:.6g} 1/s ({})\n", e.limits.lower, e.limits.upper,
                      bounded ? fmt::format("in any state at most {:.6g}", e.limits.any_state)
                              : "in the state at the start; elements grow stiffer as they are deformed");
  const Bounds ratio = e.limits.damping_ratio();
  text += fmt::format("damping ratio there: {:.3g} to {:.3g}\n", ratio.lower, ratio.upper);
  text += fmt::format(
      "longest stable step in the state at the start: {}{}{}; the scene's is {}\n", step_text(e.limit.stable),
      std::isfinite(e.limit.unstable) ? fmt::format(" (certainly below {})", step_text(e.limit.unstable)) : "",
      bounded ? fmt::format(", in any state at least {}", step_text(e.quick)) : "",
      scene.step <= e.quick          ? "stable in any"
      : scene.step <= e.limit.stable ? "stable at the start"
                                     : "TOO LONG");
  if (e.springs.empty()) return text;
  Table springs({{"spring", Align::right},
                 {"between", Align::left},
                 {"stiffness [N/m]", Align::right},
                 {"length [m]", Align::right},
                 {"share", Align::right}});
  for (const StepShare& s : e.springs) {
    const auto [i, j] = e.body.ends[s.number];
    springs.add_row({fmt::format("{}", s.number), fmt::format("{} and {}", i, j),
                     fmt::format("{:.4g}", e.body.springs[s.number].stiffness),
                     fmt::format("{:.4g}", (e.body.x[j] - e.body.x[i]).norm()),
                     fmt::format("{:.1f} %", 100 * s.share)});
  }
  Table vertices(
      {{"vertex", Align::right}, {"mass [kg]", Align::right}, {"at [m]", Align::left}, {"share", Align::right}});
  for (const StepShare& v : e.vertices) {
    const Vector3d& x = e.body.x[v.number];
    vertices.add_row({fmt::format("{}", v.number), fmt::format("{:.4g}", e.body.mass[v.number]),
                      fmt::format("{:.4g}, {:.4g}, {:.4g}", x[0], x[1], x[2]), fmt::format("{:.1f} %", 100 * v.share)});
  }
  Table remedies({{"if one would", Align::left}, {"stable step", Align::right}, {"gain", Align::right}});
  for (const StepRemedy& r : e.remedies)
    remedies.add_row({r.what, step_text(r.step),
                      std::isfinite(r.step) && e.limit.stable > 0.0
                          ? fmt::format("{:+.1f} %", 100 * (r.step / e.limit.stable - 1))
                          : ""});
  return text + fmt::format("\nShares of the energy of the fastest oscillation:\n\n{}\n{}\n{}", to_text(springs),
                            to_text(vertices), to_text(remedies));
}

nlohmann::ordered_json to_json(const StepExplanation& e, const SceneFile& scene) {
  const Bounds ratio = e.limits.damping_ratio();
  nlohmann::ordered_json json{{"scene", scene.name},
                              {"integrator", scene.integrator},
                              {"step", scene.step},
                              {"stable", scene.step <= e.limit.stable},
                              {"stable_step", number(e.limit.stable)},
                              {"unstable_step", number(e.limit.unstable)},
                              {"stable_step_quick", number(e.quick)},
                              {"omega_max",
                               {{"lower", number(e.limits.lower)},
                                {"upper", number(e.limits.upper)},
                                {"any_state", number(e.limits.any_state)}}},
                              {"damping_ratio", {{"lower", number(ratio.lower)}, {"upper", number(ratio.upper)}}}};
  for (const char* list : {"springs", "vertices", "remedies"}) json[list] = nlohmann::ordered_json::array();
  for (const StepShare& s : e.springs)
    json["springs"].push_back({{"spring", s.number},
                               {"ends", {e.body.ends[s.number][0], e.body.ends[s.number][1]}},
                               {"stiffness", e.body.springs[s.number].stiffness},
                               {"share", s.share}});
  for (const StepShare& v : e.vertices)
    json["vertices"].push_back({{"vertex", v.number}, {"mass", e.body.mass[v.number]}, {"share", v.share}});
  for (const StepRemedy& r : e.remedies)
    json["remedies"].push_back({{"what", r.what}, {"stable_step", number(r.step)}});
  return json;
}

}  // namespace dartboard
