#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/json_number.h"
#include "benchmarks/json_text.h"
#include "benchmarks/scene_names.h"
#include "benchmarks/settle_accuracy.h"
#include "benchmarks/table.h"
#include "benchmarks/tell.h"
#include "core/scene/simulation.h"
#include "core/time/integrators.h"
#include "core/time/stable_step.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

struct Options {
  std::string scene;
  bool json = false;
};

constexpr std::size_t shown = 5;

/// A spring or a vertex and its share of the energy of the fastest oscillation.
struct Share {
  std::uint32_t number;
  double share;
};

std::vector<Share> largest(const std::vector<double>& energy) {
  std::vector<std::uint32_t> order(energy.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto count = std::min(shown, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count),
                            [&energy](auto a, auto b) { return energy[a] > energy[b]; });
  const double sum = std::accumulate(energy.begin(), energy.end(), 0.0);
  std::vector<Share> shares;
  for (std::size_t k = 0; k < count; ++k)
    if (energy[order[k]] > 0.0) shares.push_back({order[k], energy[order[k]] / sum});
  return shares;
}

/// A change of the body, and the step that it makes stable.
struct Remedy {
  std::string what;
  double step;
};

/// What the body is made of, in columns of its own that can be changed.
struct Columns {
  explicit Columns(const SimulatedBody& body) : system(body.system()), position(body.vertices().position) {
    springs.assign(system.springs.begin(), system.springs.end());
    inverse_mass.assign(system.inverse_mass.begin(), system.inverse_mass.end());
    mass.assign(system.mass.begin(), system.mass.end());
  }
  SpringSystem changed() const {
    SpringSystem s = system;
    s.springs = springs;
    s.inverse_mass = inverse_mass;
    s.mass = mass;
    return s;
  }
  SpringSystem system;
  std::vector<Vector3d> position;
  std::vector<Spring> springs;
  std::vector<double> inverse_mass, mass;
};

struct Explanation {
  const SceneFile& scene;
  StableStep limits;
  double safe, quick;  // [s] the longest stable step, by the close bracket and by Gershgorin's bound
  std::vector<Share> springs, vertices;
  std::vector<Remedy> remedies;
  Columns columns;
};

double safe_step(const Columns& columns, const Scheme& scheme, const Horizon& horizon) {
  StableStepEstimate estimate;
  return estimate.refresh(columns.changed(), columns.position).safe_step(scheme, horizon);
}

Explanation explain(const SceneFile& scene) {
  const Simulation simulation(scene);
  const auto integrator = make_integrator(scene.integrator);
  const Scheme& scheme = integrator->scheme();
  const Horizon horizon{.steps = static_cast<double>(std::max<std::uint64_t>(1, simulation.step_count())), .gain = 2.0};
  Explanation e{scene, {}, 0.0, 0.0, {}, {}, {}, Columns(simulation.body())};
  // power iterations for the shape: a tenth of a percent of omega_max is left after 100 of them,
  // and the shape converges at half that rate
  StableStepEstimate estimate;
  const SpringSystem system = e.columns.changed();
  estimate.refresh(system, e.columns.position);
  for (int k = 0; k < 300; ++k) estimate.follow(system, e.columns.position);
  e.limits = estimate.latest();
  e.safe = e.limits.safe_step(scheme, horizon);
  e.quick = quick_stable_step(system).safe_step(scheme, horizon);

  const auto shape = estimate.shape();
  std::vector<double> stretched(system.springs.size(), 0.0), moved(system.vertex_count(), 0.0);
  if (!shape.empty()) {
    std::vector<SpringTangent> tangents;
    evaluate_tangents(system, e.columns.position, Compression::projected, tangents);
    const auto displacement = [&](std::uint32_t i) -> Vector3d { return shape[i] * std::sqrt(system.inverse_mass[i]); };
    for (std::size_t s = 0; s < stretched.size(); ++s) {
      const auto [i, j] = system.ends[s];
      const Vector3d d = displacement(j) - displacement(i);
      stretched[s] = d.dot(tangents[s].stiffness() * d);
    }
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = shape[i].squaredNorm();
  }
  e.springs = largest(stretched);
  e.vertices = largest(moved);

  const auto remedy = [&](std::string what, auto&& change) {
    Columns columns = e.columns;
    change(columns);
    e.remedies.push_back({std::move(what), safe_step(columns, scheme, horizon)});
  };
  if (!e.springs.empty()) {
    const auto scale_springs = [&e](std::size_t count, double factor) {
      return [&e, count, factor](Columns& c) {
        for (std::size_t k = 0; k < std::min(count, e.springs.size()); ++k)
          for (double* value : {&c.springs[e.springs[k].number].stiffness, &c.springs[e.springs[k].number].damping})
            *value *= factor;
      };
    };
    remedy("halve the stiffness of the first spring", scale_springs(1, 0.5));
    remedy("remove the first spring", scale_springs(1, 0.0));
    remedy(fmt::format("halve the stiffness of the {} springs", e.springs.size()), scale_springs(shown, 0.5));
    remedy(fmt::format("remove the {} springs", e.springs.size()), scale_springs(shown, 0.0));
    remedy("double the mass of the first vertex", [&e](Columns& c) {
      c.mass[e.vertices.front().number] *= 2.0;
      c.inverse_mass[e.vertices.front().number] /= 2.0;
    });
    remedy(fmt::format("double the mass of the {} vertices", e.vertices.size()), [&e](Columns& c) {
      for (const Share& v : e.vertices) {
        c.mass[v.number] *= 2.0;
        c.inverse_mass[v.number] /= 2.0;
      }
    });
    remedy("hold the first vertex", [&e](Columns& c) { c.inverse_mass[e.vertices.front().number] = 0.0; });
    remedy("halve all stiffnesses", [](Columns& c) {
      for (Spring& s : c.springs) s.stiffness /= 2.0;
    });
  }
  return e;
}

std::string step_text(double step) { return std::isfinite(step) ? fmt::format("{:.6g} s", step) : "any"; }

void print(const Explanation& e) {
  tell("{}\n{}, h = {:.6g} s\n\n", one_line(e.scene.name), e.scene.integrator, e.scene.step);
  tell("highest frequency: {:.6g} to {:.6g} 1/s (in any state at most {:.6g})\n", e.limits.lower, e.limits.upper,
       e.limits.any_state);
  const Bounds ratio = e.limits.damping_ratio();
  tell("damping ratio there: {:.3g} to {:.3g}\n", ratio.lower, ratio.upper);
  tell("longest stable step in the state at the start: {}, in any state at least {}; the scene's is {}\n",
       step_text(e.safe), step_text(e.quick),
       e.scene.step <= e.quick  ? "stable in any"
       : e.scene.step <= e.safe ? "stable at the start"
                                : "TOO LONG");
  if (e.springs.empty()) return;
  Table springs({{"spring", Align::right},
                 {"between", Align::left},
                 {"stiffness [N/m]", Align::right},
                 {"length [m]", Align::right},
                 {"share", Align::right}});
  for (const Share& s : e.springs) {
    const auto [i, j] = e.columns.system.ends[s.number];
    springs.add_row({fmt::format("{}", s.number), fmt::format("{} and {}", i, j),
                     fmt::format("{:.4g}", e.columns.springs[s.number].stiffness),
                     fmt::format("{:.4g}", (e.columns.position[j] - e.columns.position[i]).norm()),
                     fmt::format("{:.1f} %", 100 * s.share)});
  }
  Table vertices(
      {{"vertex", Align::right}, {"mass [kg]", Align::right}, {"at [m]", Align::left}, {"share", Align::right}});
  for (const Share& v : e.vertices) {
    const Vector3d& x = e.columns.position[v.number];
    vertices.add_row({fmt::format("{}", v.number), fmt::format("{:.4g}", e.columns.mass[v.number]),
                      fmt::format("{:.4g}, {:.4g}, {:.4g}", x[0], x[1], x[2]), fmt::format("{:.1f} %", 100 * v.share)});
  }
  Table remedies({{"if one would", Align::left}, {"stable step", Align::right}, {"gain", Align::right}});
  for (const Remedy& r : e.remedies)
    remedies.add_row(
        {r.what, step_text(r.step),
         std::isfinite(r.step) && e.safe > 0.0 ? fmt::format("{:+.1f} %", 100 * (r.step / e.safe - 1)) : ""});
  tell("\nShares of the energy of the fastest oscillation:\n\n{}\n{}\n{}", to_text(springs), to_text(vertices),
       to_text(remedies));
}

// JSON has no infinity: a step without a limit is null.
nlohmann::ordered_json to_json(const Explanation& e) {
  const Bounds ratio = e.limits.damping_ratio();
  nlohmann::ordered_json json{{"scene", e.scene.name},
                              {"integrator", e.scene.integrator},
                              {"step", e.scene.step},
                              {"stable", e.scene.step <= e.safe},
                              {"stable_step", number(e.safe)},
                              {"stable_step_quick", number(e.quick)},
                              {"omega_max",
                               {{"lower", number(e.limits.lower)},
                                {"upper", number(e.limits.upper)},
                                {"any_state", number(e.limits.any_state)}}},
                              {"damping_ratio", {{"lower", number(ratio.lower)}, {"upper", number(ratio.upper)}}}};
  for (const char* list : {"springs", "vertices", "remedies"}) json[list] = nlohmann::ordered_json::array();
  for (const Share& s : e.springs)
    json["springs"].push_back({{"spring", s.number},
                               {"ends", {e.columns.system.ends[s.number][0], e.columns.system.ends[s.number][1]}},
                               {"stiffness", e.columns.springs[s.number].stiffness},
                               {"share", s.share}});
  for (const Share& v : e.vertices)
    json["vertices"].push_back({{"vertex", v.number}, {"mass", e.columns.mass[v.number]}, {"share", v.share}});
  for (const Remedy& r : e.remedies) json["remedies"].push_back({{"what", r.what}, {"stable_step", number(r.step)}});
  return json;
}

void explain_dt(const Options& options, Outcome& outcome) {
  SceneFile scene = read_scene(scene_file(options.scene));
  const std::optional<SettledAccuracy> settled = settle_accuracy(scene, thread_cpu_ns);
  scene.unstable_step = UnstableStep::warn;  // a step that the scene refuses is what is to be explained
  const Explanation explanation = explain(scene);
  outcome.exit_code = scene.step <= explanation.safe ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json = to_json(explanation);
    if (settled) json["settled"] = nlohmann::json(*settled);
    tell("{}\n", json_text(json, 2));
  } else {
    if (settled) tell("{}\n", to_string(*settled));
    print(explanation);
  }
}

}  // namespace

void add_explain_dt(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand(
      "explain-dt", "Which springs and vertices limit the time step of a scene, and what changing them would buy.");
  verb->add_option("SCENE", options->scene, "a scene file (dartboard scene --keys), or the name of one of the gallery")
      ->required();
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { explain_dt(*options, outcome); });
}

}  // namespace dartboard
