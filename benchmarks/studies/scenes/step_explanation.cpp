#include "benchmarks/studies/scenes/step_explanation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/harness/tell.h"
#include "core/base/counted.h"
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
  columns.held_axes.assign(system.held_axes.begin(), system.held_axes.end());
  columns.terms.assign(system.terms.begin(), system.terms.end());
  columns.x.assign(body.vertices().position.begin(), body.vertices().position.end());
  return columns;
}

/// The numbers of the largest, in descending order.
std::vector<std::uint32_t> largest(const std::vector<double>& energy) {
  std::vector<std::uint32_t> order(energy.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto count = std::min(shown, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count),
                            [&energy](auto a, auto b) { return energy[a] > energy[b]; });
  order.resize(count);
  std::erase_if(order, [&energy](std::uint32_t k) { return !(energy[k] > 0.0); });
  return order;
}

std::vector<StepShare> largest_shares(const std::vector<double>& energy, double sum) {
  std::vector<StepShare> shares;
  for (const std::uint32_t k : largest(energy)) shares.push_back({k, energy[k] / sum});
  return shares;
}

double sum_of(const std::vector<double>& energy) { return std::accumulate(energy.begin(), energy.end(), 0.0); }

/// Of each piece of a force term twice the energy of a displacement.
std::vector<double> energies(const ForceTerm& term, std::span<const Vector3d> x, std::span<const Vector3d> d) {
  std::vector<double> energy;
  term.for_each_tangent({x}, Compression::projected,
                        [&energy, d](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
                          double sum = 0.0;
                          for (std::size_t a = 0, k = 0; a < nodes.size(); ++a)
                            for (std::size_t b = 0; b <= a; ++b, ++k)
                              sum += (a == b ? 1.0 : 2.0) * d[nodes[a]].dot(blocks[k] * d[nodes[b]]);
                          energy.push_back(sum);
                        });
  return energy;
}

/// Of a simplex its least altitude, else the least distance of two corners [m].
double width_of(std::span<const Vector3d> corners) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0, largest_face = 0.0;
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double length = (corners[a] - corners[b]).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
      for (std::size_t c = 0; c < b; ++c)
        largest_face =
            std::max(largest_face, (corners[b] - corners[a]).cross(corners[c] - corners[a]).norm());  // twice its area
    }
  if (corners.size() == 3) return largest_face / longest;
  if (corners.size() != 4 || largest_face == 0.0) return shortest;
  const Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0], w = corners[3] - corners[0];
  return std::abs(u.cross(v).dot(w)) / largest_face;
}

/// Finds the springs, elements and vertices that the fastest oscillation moves most.
void find_shares(StepExplanation& e, bool has_elements) {
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
  std::vector<Vector3d> displacement;
  for (std::size_t i = 0; i < shape.size(); ++i) displacement.push_back(shape[i] * std::sqrt(system.inverse_mass[i]));
  for (std::size_t s = 0; s < stretched.size(); ++s) {
    const auto [i, j] = system.ends[s];
    const Vector3d d = displacement[j] - displacement[i];
    stretched[s] = d.dot(tangents[s].stiffness() * d);
  }
  double sum = sum_of(stretched);
  std::vector<double> of_cells;
  for (const ForceTerm* term : system.terms) {
    const std::vector<double> energy = energies(*term, e.body.x, displacement);
    sum += sum_of(energy);
    if (has_elements && term == system.terms.front()) of_cells = energy;  // other terms come after elements
  }
  for (const std::uint32_t k : largest(of_cells)) {
    CellStepShare cell{.number = k, .corners = {}, .share = of_cells[k] / sum};
    std::vector<Vector3d> places;
    for (const std::uint32_t i : system.terms.front()->nodes(k)) {
      cell.corners.push_back(e.name(i));
      places.push_back(e.body.x[i]);
    }
    cell.width = width_of(places);
    e.cells.push_back(cell);
  }
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = shape[i].squaredNorm();
  e.springs = largest_shares(stretched, sum);
  e.vertices = largest_shares(moved, sum_of(moved));
}

void find_remedies(StepExplanation& e, const Scheme& scheme, const Horizon& horizon) {
  if (e.vertices.empty()) return;
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
  if (!e.springs.empty()) {
    const std::string springs = counted(e.springs.size(), "spring");
    remedy("halve the stiffness of the first spring", scale_springs(1, 0.5));
    remedy("remove the first spring", scale_springs(1, 0.0));
    remedy("halve the stiffness of the " + springs, scale_springs(shown, 0.5));
    remedy("remove the " + springs, scale_springs(shown, 0.0));
  }
  remedy("double the mass of the first vertex", [&](SpringColumns& c) { double_mass(c, e.vertices.front().number); });
  remedy(fmt::format("double the mass of the {}", counted(e.vertices.size(), "vertex", "vertices")),
         [&](SpringColumns& c) {
           for (const StepShare& v : e.vertices) double_mass(c, v.number);
         });
  remedy("hold the first vertex", [&e](SpringColumns& c) { c.inverse_mass[e.vertices.front().number] = 0.0; });
  if (e.body.terms.empty())
    remedy("halve all stiffnesses", [](SpringColumns& c) {
      for (Spring& s : c.springs) s.stiffness /= 2.0;
    });
}

std::string step_text(double step) { return std::isfinite(step) ? fmt::format("{:.6g} s", step) : "any"; }

}  // namespace

StepExplanation explain_step(SceneFile scene) {
  if (scene.has_contact())
    throw InputError(
        fmt::format("{}: /contact: a body that touches something is stiffer there, by no spring of its own; expected a "
                    "scene without contact. 'dartboard explain' reports the longest stable step with it",
                    scene.file));
  scene.unstable_step = UnstableStep::warn;  // a refused step is the one to be explained
  const Simulation simulation(scene);
  const auto integrator = make_integrator(scene.integrator);
  const Horizon horizon = horizon_of(scene.duration);
  StepExplanation e;
  e.body = columns_of(simulation.body());
  const SpringSystem system = simulation.body().system();
  e.limits = StableStepEstimate().refresh(system, e.body.x);
  e.limit = simulation.step_limit();
  e.quick = quick_stable_step(system).safe_step(integrator->scheme(), horizon);
  for (std::uint32_t k = 0; k < system.vertex_count(); ++k) e.names.push_back(simulation.file_number(k));
  find_shares(e, scene.has_elements());
  find_remedies(e, integrator->scheme(), horizon);
  e.body.terms.clear();  // they end with the simulation
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
  if (e.vertices.empty()) return text;
  text += "\nShares of the energy of the fastest oscillation:\n\n";
  Table springs({{"spring", Align::right},
                 {"between", Align::left},
                 {"stiffness [N/m]", Align::right},
                 {"length [m]", Align::right},
                 {"share", Align::right}});
  for (const StepShare& s : e.springs) {
    const auto [i, j] = e.body.ends[s.number];
    springs.add_row({fmt::format("{}", s.number), fmt::format("{} and {}", e.name(i), e.name(j)),
                     fmt::format("{:.4g}", e.body.springs[s.number].stiffness),
                     fmt::format("{:.4g}", (e.body.x[j] - e.body.x[i]).norm()),
                     fmt::format("{:.1f} %", 100 * s.share)});
  }
  Table cells(
      {{"cell", Align::right}, {"corners", Align::left}, {"least width [m]", Align::right}, {"share", Align::right}});
  for (const CellStepShare& c : e.cells)
    cells.add_row({fmt::format("{}", c.number), fmt::format("{}", fmt::join(c.corners, ", ")),
                   fmt::format("{:.4g}", c.width), fmt::format("{:.1f} %", 100 * c.share)});
  Table vertices(
      {{"vertex", Align::right}, {"mass [kg]", Align::right}, {"at [m]", Align::left}, {"share", Align::right}});
  for (const StepShare& v : e.vertices) {
    const Vector3d& x = e.body.x[v.number];
    vertices.add_row({fmt::format("{}", e.name(v.number)), fmt::format("{:.4g}", e.body.mass[v.number]),
                      fmt::format("{:.4g}, {:.4g}, {:.4g}", x[0], x[1], x[2]), fmt::format("{:.1f} %", 100 * v.share)});
  }
  Table remedies({{"if one would", Align::left}, {"stable step", Align::right}, {"gain", Align::right}});
  for (const StepRemedy& r : e.remedies)
    remedies.add_row({r.what, step_text(r.step),
                      std::isfinite(r.step) && e.limit.stable > 0.0
                          ? fmt::format("{:+.1f} %", 100 * (r.step / e.limit.stable - 1))
                          : ""});
  for (const Table* table : {&springs, &cells})
    if (!table->rows().empty()) text += to_text(*table) + "\n";
  return text + to_text(vertices) + "\n" + to_text(remedies);
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
  for (const char* list : {"springs", "cells", "vertices", "remedies"}) json[list] = nlohmann::ordered_json::array();
  for (const StepShare& s : e.springs)
    json["springs"].push_back({{"spring", s.number},
                               {"ends", {e.name(e.body.ends[s.number][0]), e.name(e.body.ends[s.number][1])}},
                               {"stiffness", e.body.springs[s.number].stiffness},
                               {"share", s.share}});
  for (const CellStepShare& c : e.cells)
    json["cells"].push_back(
        {{"cell", c.number}, {"corners", c.corners}, {"least_width", number(c.width)}, {"share", c.share}});
  for (const StepShare& v : e.vertices)
    json["vertices"].push_back({{"vertex", e.name(v.number)}, {"mass", e.body.mass[v.number]}, {"share", v.share}});
  for (const StepRemedy& r : e.remedies)
    json["remedies"].push_back({{"what", r.what}, {"stable_step", number(r.step)}});
  return json;
}

}  // namespace dartboard
