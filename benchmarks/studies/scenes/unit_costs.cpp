#include "benchmarks/studies/scenes/unit_costs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/statistics.h"
#include "core/base/overloads.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {
namespace {

/// The median of some runs [ns per call]: the time that the scene will take on a machine as busy as now.
template <class F>
double median_ns(int runs, int calls, F&& f) {
  std::vector<double> ns;
  for (int run = 0; run < runs; ++run) {
    const std::int64_t start = thread_cpu_ns();
    for (int k = 0; k < calls; ++k) f();
    ns.push_back(static_cast<double>(thread_cpu_ns() - start) / calls);
  }
  return median(ns);
}

/// So many calls that they take a millisecond.
template <class F>
int calls_for(F&& f) {
  const std::int64_t start = thread_cpu_ns();
  f();
  return static_cast<int>(
      std::clamp(1e6 / std::max<double>(1.0, static_cast<double>(thread_cpu_ns() - start)), 1.0, 1e4));
}

template <class F>
double cost_of(F&& f) {
  const int calls = calls_for(f);  // a first call, which also takes the memory
  return median_ns(7, calls, f);
}

/// The same for several calls that are compared: by turns, so that a disturbance affects all of them.
std::vector<double> costs_of(std::vector<std::function<void()>> calls) {
  std::vector<int> times;
  for (const auto& call : calls) times.push_back(calls_for(call));
  std::vector<std::vector<double>> ns(calls.size());
  for (int round = 0; round < 9; ++round)
    for (std::size_t k = 0; k < calls.size(); ++k) ns[k].push_back(median_ns(1, times[k], calls[k]));
  std::vector<double> medians;
  for (const auto& of_call : ns) medians.push_back(median(of_call));
  return medians;
}

/// A step on arrays of its own, from the same state every few steps, so that the state cannot run away.
std::function<void()> stepper(const SceneFile& scene, const SpringSystem& system, const SystemArrays& start) {
  struct State {
    std::unique_ptr<Integrator> integrator;
    std::vector<Eigen::Vector3d> x, v;
    int steps = 0;
  };
  const auto state = std::make_shared<State>(State{make_integrator(scene.integrator, scene.solver), start.x, start.v});
  return [state, system, &start, h = scene.step] {
    if (state->steps++ % 64 == 0) {
      std::ranges::copy(start.x, state->x.begin());
      std::ranges::copy(start.v, state->v.begin());
    }
    state->integrator->step(system, {state->x, state->v}, h);
  };
}

/// The same problem without damping of its elements.
Problem without_element_damping(Problem problem) {
  problem.material.damping_time = 0.0;
  for (Material& material : problem.materials) material.damping_time = 0.0;
  return problem;
}

void measure_step(UnitCosts& costs, const SceneFile& scene, SystemArrays& arrays, ForceTerms undamped_terms) {
  const SpringSystem whole = arrays.system();
  const Scheme& scheme = make_integrator(scene.integrator)->scheme();
  if (scheme.implicit) {
    costs.solver = cost_of(stepper(scene, whole, arrays));
  } else {
    std::vector<UndampedSpring> undamped;
    for (const Spring spring : whole.springs) undamped.push_back({spring.rest_length, spring.stiffness});
    std::vector<Eigen::Vector3d> a(arrays.x.size());
    SpringSystem system = whole;
    system.springs = undamped;
    system.viscosity = {};
    system.fixed = {};
    const bool contact = scene.has_contact();
    const auto but_contact = [&arrays](ForceTerms terms) { return arrays.body().terms_but_contact(terms); };
    system.terms = but_contact(undamped_terms);
    // term after term, from none to all
    std::vector<std::function<void()>> calls{[&, system] { accelerations(system, {}, arrays.x, arrays.v, a); },
                                             stepper(scene, system, arrays)};
    std::vector<double UnitCosts::*> terms;
    const auto add = [&](bool present, double UnitCosts::*cost) {
      if (!present) return;
      terms.push_back(cost);
      calls.push_back(stepper(scene, system, arrays));
    };
    system.fixed = whole.fixed;
    add(!whole.fixed.empty(), &UnitCosts::fixed);
    system.viscosity = whole.viscosity;
    add(!whole.viscosity.empty(), &UnitCosts::viscosity);
    system.springs = whole.springs;
    add(terms_of(system).damping, &UnitCosts::damping);
    system.terms = but_contact(whole.terms);
    add(has_damped_terms(whole), &UnitCosts::element_damping);
    system.terms = whole.terms;
    add(contact, &UnitCosts::contact);
    costs = step_costs(scheme.stages, costs_of(std::move(calls)), terms);
  }

  DivergenceDetector detector;
  if (detector.start(whole, arrays.motion(), scene.step).ok())
    costs.detector = median_ns(3, 512, [&] { detector.after_step(whole, arrays.motion()); });
  volatile bool slower = false;
  costs.speed_check = cost_of([&] { slower = all_slower(arrays.v, 3e8); }) / DivergenceDetector::check_steps;

  const Horizon horizon = horizon_of(scene.duration);
  costs.look = median_ns(2, 1, [&] {
    StableStep limits = quick_stable_step(whole);
    if (!limits.is_stable(scheme, scene.step, horizon))
      limits = StableStepEstimate().refresh(whole, arrays.x), limits.safe_step(scheme, horizon);
    terms_of(whole);
    detector.system_changed(whole, arrays.motion());
  });
}

/// A body of the same kind as the scene's, stretched the more towards its top, as one that hangs, and a little
/// jittered.
struct Standard {
  Problem problem;
  MeshTally counts;
  std::unique_ptr<SimulatedBody> body;

  Standard(const Problem& of, const BodyNeeds& needs) {
    const double spacing = 0.1;
    if (needs.storage == Storage::links)
      for (std::uint32_t k = 0; k < 500; ++k) {
        problem.mesh.points.emplace_back(k * spacing, 0, 0);
        if (k > 0) problem.mesh.links.push_back({k - 1, k});
      }
    else
      problem.mesh = needs.storage == Storage::surface      ? triangle_sheet(24, 24, spacing)
                     : needs.storage == Storage::tetrahedra ? kuhn_box(6, 6, 6, spacing)
                                                            : mixed_box(8, 8, 8, spacing);
    problem.material = of.material;
    counts = tally_of(problem.mesh);
    BodyNeeds own = body_needs(problem, needs.topology_changes);
    own.rest = needs.rest;
    own.obstacles = needs.obstacles;
    // one body, which touches itself by the first of the laws
    if (!needs.touches.empty()) {
      own.touches = {{0, 0, needs.touches.front().law}};
      own.first_cell = {0};
    }
    body = make_simulated_body(problem, own);
    // how many vertices must be looked at closely for the largest stress depends on the state
    const int up = needs.storage == Storage::surface ? 1 : 2;
    SplitMix64 random(1);
    for (Eigen::Vector3d& x : body->motion().x) {
      for (double& coordinate : x) coordinate += 0.002 * spacing * random.next_signed();
      x[up] += 0.03 * x[up] * x[up];
    }
  }
  std::unique_ptr<ReadyEvent> ready(Action action) { return body->make_ready({std::move(action), 0.0, 0.0, {}, ""}); }
};

double over(std::size_t a, std::size_t b) { return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b); }

void measure_output(UnitCosts& costs, const SceneFile& scene, const Problem& problem, const ScenePlan& plan) {
  const Standard s(problem, plan.needs.body);
  const SpringSystem system = s.body->system();
  const auto& v = s.body->vertices();
  volatile double sink = 0.0;
  const double springs = over(plan.counts.edges, s.counts.edges),
               vertices = over(plan.counts.vertices, s.counts.vertices),
               cells = plan.counts.cells == 0 ? springs : over(plan.counts.cells, s.counts.cells);
  const double facets = plan.needs.body.topology_changes ? over(plan.counts.faces, s.counts.faces)
                                                         : over(plan.counts.boundary_facets, s.counts.boundary_facets);
  costs.row = vertices * cost_of([&] { sink = s.body->largest_stress(); }) +
              facets * cost_of([&] { sink = s.body->boundary(); }) + cells * cost_of([&] { sink = s.body->mass(); }) +
              springs * cost_of([&] { sink = elastic_energy(system, v.position); }) +
              vertices * cost_of([&] {
                sink = kinetic_energy(system, v.velocity) + gravity_energy(system, v.position) +
                       linear_momentum(system, v.velocity)[0] + angular_momentum(system, v.position, v.velocity)[0];
              });
  costs.frame = cells * cost_of([&] { s.body->frame(scene.output.fields); });
}

void measure_events(UnitCosts& costs, const SceneFile& scene, const Problem& problem, const ScenePlan& plan) {
  const PlaneSelection far{{1e9, 0, 0}, {1, 0, 0}}, middle{{0.25, 0, 0}, {1, 0, 0}};
  const auto fresh = [&] { return Standard(problem, plan.needs.body); };
  const auto timed = [](ReadyEvent& event, std::size_t& operations) {
    const std::int64_t start = thread_cpu_ns();
    operations = event.apply();
    return static_cast<double>(thread_cpu_ns() - start);
  };
  const auto each = [&](const Action& action, int times, double besides) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 2; ++run) {
      Standard s = fresh();
      const auto event = s.ready(action);
      double sum = 0.0, count = 0.0;
      for (int k = 0; k < times; ++k) {
        std::size_t operations = 0;
        sum += timed(*event, operations) - besides;
        count += static_cast<double>(operations);
      }
      if (count > 0.0) least = std::min(least, std::max(0.0, sum) / count);
    }
    return std::isfinite(least) ? least : 0.0;
  };
  const auto choosing = [&](Action action) {
    Standard s = fresh();
    const auto event = s.ready(std::move(action));
    return cost_of([&] { event->apply(); });
  };
  Standard s = fresh();
  const double cells = over(plan.counts.cells, s.counts.cells);
  const bool removes = has<Remove>(scene.events), refines = has<Refine>(scene.events);
  if (removes || refines) {
    const double here = choosing(Remove{SphereSelection{{1e9, 0, 0}, 0.0}});
    costs.by_place = cells * here;
    costs.by_lot = 1.5 * static_cast<double>(plan.counts.cells);  // to write their numbers down
    if (removes) costs.remove = each(Remove{RandomSelection{10, 1}}, 20, 1.5 * static_cast<double>(s.counts.cells));
    if (refines) {
      // as the first event that refines does it
      const auto found = std::ranges::find_if(
          scene.events, [](const SceneEvent& e) { return std::holds_alternative<Refine>(e.action); });
      Refine refine = std::get<Refine>(found->action);
      refine.cells = RandomSelection{10, 1};
      costs.refine = each(refine, 10, 0.0);
    }
  }
  if (has<Dissociate>(scene.events)) {
    const double here = choosing(Dissociate{far});
    costs.across = cells * here;
    costs.dissociate = each(Dissociate{middle}, 1, here);
  }
  if (has<Tear>(scene.events)) {
    const auto near = [&](double x) { return Tear{Eigen::Vector3d(x, 0.3, 0.3), Eigen::Vector3d(1, 0, 0)}; };
    std::size_t operations = 0;
    double sum = 0.0;
    int count = 0;
    for (const double x : {0.1, 0.2, 0.3, 0.4, 0.5}) {
      sum += timed(*s.ready(near(x)), operations);
      ++count;
    }
    costs.tear = sum / count;
  }
  if (plan.needs.stress_watch) {
    Standard stretched = fresh();
    const auto event = stretched.ready(TearWhereStressed{1e300, {}, {}});
    costs.stress = over(plan.counts.edges, stretched.counts.edges) * cost_of([&] { event->apply(); });
  }
}

}  // namespace

double make_ascending(std::span<double> ns) {
  double most = 0.0;
  for (std::size_t k = ns.size(); k-- > 1;) {
    most = std::max(most, ns[k - 1] - ns[k]);
    ns[k - 1] = std::min(ns[k - 1], ns[k]);
  }
  return most;
}

UnitCosts step_costs(double evaluations, std::vector<double> ns, std::span<double UnitCosts::*const> terms) {
  UnitCosts costs;
  costs.evaluations = evaluations;
  ns[0] *= evaluations;
  costs.noise = make_ascending(ns);
  costs.force = ns[0] / evaluations;
  costs.stages = ns[1] - ns[0];
  for (std::size_t k = 0; k < terms.size(); ++k) costs.*terms[k] = ns[k + 2] - ns[k + 1];
  return costs;
}

UnitCosts measure_unit_costs(const SceneFile& scene, const Problem& problem, const ScenePlan& plan) {
  UnitCosts costs;
  if (plan.counts.edges == 0) return costs;
  SystemArrays arrays(problem, plan.needs.body);
  if (plan.needs.cell_damping) {
    const Problem plain = without_element_damping(problem);
    SystemArrays undamped(plain, plan.needs.body);
    measure_step(costs, scene, arrays, undamped.system().terms);
  } else {
    measure_step(costs, scene, arrays, arrays.system().terms);
  }
  measure_output(costs, scene, problem, plan);
  if (!scene.events.empty()) measure_events(costs, scene, problem, plan);
  return costs;
}

namespace {

double event_ns(const SceneEvent& event, const EventForecast& f, const UnitCosts& c, const MeanSizes& mean) {
  const auto times = static_cast<double>(f.times);
  const auto choosing = [&](const CellSelection& cells) {
    return times * mean.cells * (std::holds_alternative<RandomSelection>(cells) ? c.by_lot : c.by_place);
  };
  return std::visit(Overloads{[&](const Dissociate& cut) {
                                const bool by_place = !std::holds_alternative<FacetPoints>(cut.faces);
                                return (by_place ? times * mean.cells * c.across : 0.0) + f.operations * c.dissociate;
                              },
                              [&](const Remove& remove) { return choosing(remove.cells) + f.operations * c.remove; },
                              [&](const Tear&) { return times * c.tear; },
                              [&](const TearWhereStressed&) { return times * mean.springs * c.stress; },
                              [&](const Refine& refine) { return choosing(refine.cells) + f.operations * c.refine; },
                              [](const Release&) { return 0.0; }},  // one pass over the vertices, once
                    event.action);
}

// The first state, those that are due, and the last.
double times_of(const std::optional<std::uint64_t>& every, std::uint64_t steps) {
  if (steps == 0) return 1.0;
  if (!every) return 2.0;
  const std::uint64_t due = steps / *every + (steps % *every != 0);
  return 1.0 + static_cast<double>(due);
}

}  // namespace

void add_times(ScenePlan& plan, const SceneFile& scene, const UnitCosts& c) {
  const double steps = std::max<double>(1.0, static_cast<double>(plan.steps));
  const MeanSizes& m = plan.mean;
  double changes = 0.0;
  for (const EventForecast& f : plan.events) changes += f.with_operations;
  const auto charge = [&c](PlanItem& item, double size, double cost) {
    item.ns = size * cost;
    item.ns_below = cost > 0.0 ? 0.0 : size * c.noise;
  };
  const bool has_elements = scene.has_elements();
  for (PlanItem& item : plan.items) {
    switch (item.part) {
      case Part::springs: item.ns = has_elements ? 0.0 : m.springs * c.evaluations * c.force; break;
      case Part::elements: item.ns = m.cells * c.evaluations * c.force; break;
      case Part::damping: charge(item, m.springs, c.damping); break;
      case Part::cell_damping: charge(item, m.cells, c.element_damping); break;
      case Part::pull:  // an additional column next to the masses, as for viscosity
      case Part::viscosity: charge(item, m.vertices, c.viscosity); break;
      case Part::fixed: charge(item, m.vertices, c.fixed); break;
      case Part::contact: charge(item, m.vertices, c.contact); break;
      case Part::integrator: charge(item, m.vertices, c.stages); break;
      case Part::solver: item.ns = m.springs * c.solver; break;
      case Part::driven:  // each is a term of one spring
        item.ns = static_cast<double>(plan.driven_springs) / static_cast<double>(plan.counts.edges) * c.force;
        break;
      case Part::detector: item.ns = m.vertices * c.detector; break;
      case Part::speed_check: item.ns = m.vertices * c.speed_check; break;
      case Part::step_check: item.ns = changes / steps * m.springs * c.look; break;
      case Part::event: item.ns = event_ns(scene.events[item.event], plan.events[item.event], c, m) / steps; break;
      case Part::frames: item.ns = times_of(scene.output.frame_steps, plan.steps) / steps * m.cells * c.frame; break;
      case Part::diagnostics:
        item.ns = times_of(scene.output.diagnostic_steps, plan.steps) / steps * m.springs * c.row;
        break;
      default: break;
    }
  }
}

}  // namespace dartboard
