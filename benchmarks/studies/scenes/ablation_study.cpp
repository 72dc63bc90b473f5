#include "benchmarks/studies/scenes/ablation_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/studies/scenes/output_tasks.h"
#include "benchmarks/studies/scenes/plain_loop.h"
#include "core/plain/error.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "core/topology/storage/hash.h"

namespace dartboard {
namespace {

using Json = nlohmann::json;
constexpr double h = 1e-4;
constexpr int output_steps = 10;

Json bare_scene() {
  return Json::parse(R"({
    "name": "ablation", "step": 1e-4, "duration": 1000, "integrator": "rk4",
    "body": {"mesh": "liver564.mesh"},
    "material": {"density": 1000, "stiffness": 5, "damping": 0, "viscosity": 0},
    "gravity": [0, 0, 0],
    "initial_velocity": {"linear": [[0, -0.5, 0], [0.5, 0, 0], [0, 0, 0]]}})");
}

/// A feature that a scene may have: its addition to the scene, and the variant of the scene without it if that is not
/// the scene with all others.
struct Feature {
  std::string name;
  std::function<void(AblationVariant&, Json&)> add;
};

void add_event(Json& scene, const char* event) { scene["events"].push_back(Json::parse(event)); }

const std::vector<Feature>& features() {
  static const std::vector<Feature> all{
      {"damping", [](auto&, Json& s) { s["material"]["damping"] = 0.005; }},
      {"viscosity", [](auto&, Json& s) { s["material"]["viscosity"] = 0.5; }},
      {"gravity",
       [](auto&, Json& s) {
         s["gravity"] = Json::array({0, 0, -9.81});
       }},
      {"fixed vertices",
       [](auto&, Json& s) {
         s["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0.06], "normal": [0, 0, 1]}}])");
       }},
      {"map", [](auto&, Json& s) { add_event(s, R"({"at": 999, "remove": {"ids": [0]}})"); }},
      {"stress watch", [](auto&, Json& s) { add_event(s, R"({"tear_where_stressed": {"threshold": 1e30}})"); }},
      {"frames", [](AblationVariant& v, Json&) { v.frames = true; }},
      {"diagnostics", [](AblationVariant& v, Json&) { v.diagnostics = true; }},
  };
  return all;
}

template <class Has>
AblationVariant make_variant(std::string name, Has&& has, const char* integrator = "rk4") {
  AblationVariant variant;
  variant.name = std::move(name);
  Json scene = bare_scene();
  scene["integrator"] = integrator;
  for (const Feature& feature : features())
    if (has(feature.name)) feature.add(variant, scene);
  variant.scene = parse_scene(scene.dump(), variant.name, source_folder() / "benchmarks" / "meshes");
  return variant;
}

const char* const other_integrator = "verlet";

}  // namespace

std::vector<AblationVariant> ablation_variants() {
  std::vector<AblationVariant> all;
  const auto none = [](const std::string&) { return false; };
  const auto every = [](const std::string&) { return true; };
  all.push_back(make_variant("bare", none));
  // a watch on the stress needs a map, so it is switched on together with an event that never comes
  for (const Feature& f : features())
    all.push_back(make_variant("bare + " + f.name, [&f](const std::string& name) {
      return name == f.name || (f.name == "stress watch" && name == "map");
    }));
  all.push_back(make_variant(fmt::format("bare, {}", other_integrator), none, other_integrator));
  all.push_back(make_variant("full", every));
  for (const Feature& f : features())
    all.push_back(make_variant("full - " + f.name, [&f](const std::string& name) {
      return name != f.name && !(f.name == "map" && name == "stress watch");
    }));
  all.push_back(make_variant(fmt::format("full, {}", other_integrator), every, other_integrator));
  return all;
}

std::size_t bytes_not_asked_for(const MemoryReport& report) {
  std::size_t bytes = 0;
  for (const MemoryItem& item : report) {
    const bool needed = item.part == Part::vertices || item.part == Part::springs || item.part == Part::integrator ||
                        item.part == Part::detector || item.part == Part::output_cells;
    if (!needed) bytes += item.bytes;
  }
  return bytes;
}

std::size_t bytes_of_damping(const MemoryReport& report, std::size_t springs) {
  std::size_t bytes = 0;
  for (const MemoryItem& item : report)
    if (item.part == Part::springs || item.part == Part::damping) bytes += item.bytes;
  return bytes - springs * (sizeof(Spring::rest_length) + sizeof(Spring::stiffness) + sizeof(SpringEnds));
}

std::vector<AblationPair> switched_on() {
  std::vector<AblationPair> pairs;
  for (const Feature& f : features())
    pairs.push_back({f.name, "bare + " + f.name, f.name == "stress watch" ? "bare + map" : "bare"});
  pairs.push_back({fmt::format("rk4 for {}", other_integrator), "bare", fmt::format("bare, {}", other_integrator)});
  return pairs;
}

std::vector<AblationPair> switched_off() {
  std::vector<AblationPair> pairs;
  for (const Feature& f : features())
    pairs.push_back({f.name, f.name == "map" ? "full - stress watch" : "full", "full - " + f.name});
  pairs.push_back({fmt::format("rk4 for {}", other_integrator), "full", fmt::format("full, {}", other_integrator)});
  return pairs;
}

std::vector<AblationPair> staircase() {
  return {{"damping, viscosity, fixed vertices; finite states", "loop", "plain loop"},
          {"divergence detector", "loop and detector", "loop"},
          {"speed check", "watched loop", "loop and detector"},
          {"events, map, stress watch, frames, diagnostics", "simulation", "watched loop"},
          {"all of them", "simulation", "loop"}};
}

Verdict verdict_on_time(const Figure& figure) {
  if (figure.interval.high < 1.0) return Verdict::undecided;
  Claim claim;
  judge(claim, at_most(figure, 1.005));
  return claim.verdict;
}

namespace {

/// The bare scene's arrays, copied out of a simulation: the same numbers in the same order.
struct Arrays {
  std::vector<SpringEnds> ends;
  std::vector<UndampedSpring> springs;
  std::vector<double> mass, inverse_mass;
  std::vector<Eigen::Vector3d> x, v;

  explicit Arrays(const SimulatedBody& body) {
    const SpringSystem s = body.system();
    ends.assign(s.ends.begin(), s.ends.end());
    springs.assign(s.springs.undamped().begin(), s.springs.undamped().end());
    mass.assign(s.mass.begin(), s.mass.end());
    inverse_mass.assign(s.inverse_mass.begin(), s.inverse_mass.end());
    x = body.vertices().position;
    v = body.vertices().velocity;
  }
  SpringSystem system() const { return {ends, springs, mass, inverse_mass, {}, {}, {0, 0, 0}}; }
  Motion motion() { return {x, v}; }
  std::uint64_t hash() const {
    Hash hash;
    hash.add(x);
    hash.add(v);
    return hash.value();
  }
};

/// One of the loops around the integrator, on arrays of its own.
struct Loop {
  Arrays arrays;
  std::unique_ptr<Integrator> integrator = make_integrator("rk4");
  PlainLoop plain;
  DivergenceDetector detector;
  bool written_out = false, detects = false, checks_speed = false;
  bool good = true;

  explicit Loop(const SimulatedBody& body) : arrays(body) {}
  void start() { detector.start(arrays.system(), arrays.motion(), h); }
  void run(int steps) {
    if (written_out) {
      for (int k = 0; k < steps; ++k)
        plain.step(arrays.ends, arrays.springs, arrays.inverse_mass, arrays.x, arrays.v, h);
      return;
    }
    const SpringSystem system = arrays.system();
    for (int k = 0; k < steps; ++k) {
      good = good && integrator->step(system, arrays.motion(), h).ok();
      const std::uint64_t checks = detector.checks();
      if (detects) good = good && detector.after_step(system, arrays.motion()).ok();
      if (checks_speed && detector.checks() != checks) good = good && all_slower(arrays.v, speed_of_light);
    }
  }
};

TimedTask loop_task(const std::string& name, const SceneFile& scene, int steps) {
  auto loop = std::make_shared<std::unique_ptr<Loop>>();
  return {.name = name,
          .restore =
              [loop, name, scene, steps] {
                const Simulation simulation(scene);
                *loop = std::make_unique<Loop>(simulation.body());
                (*loop)->written_out = name == "plain loop";
                (*loop)->detects = name == "loop and detector" || name == "watched loop";
                (*loop)->checks_speed = name == "watched loop";
                (*loop)->start();
                (*loop)->run(std::min(steps, output_steps));
              },
          .run = [loop, steps] { (*loop)->run(steps); },
          .hash = [loop] { return (*loop)->arrays.hash(); }};
}

void advance(Simulation& simulation, const AblationVariant& variant, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (simulation.advance()) throw SolverError(fmt::format("the scene '{}' diverged", variant.name));
    if (simulation.steps_done() % output_steps != 0) continue;
    if (variant.frames) simulation.frame();
    if (variant.diagnostics) simulation.diagnostics();
  }
}

TimedTask scene_task(const AblationVariant& variant, int steps) {
  auto simulation = std::make_shared<std::unique_ptr<Simulation>>();
  return {.name = variant.name,
          .restore =
              [simulation, variant, steps] {
                *simulation = std::make_unique<Simulation>(variant.scene);
                advance(**simulation, variant, std::min(steps, output_steps));
              },
          .run = [simulation, variant, steps] { advance(**simulation, variant, steps); },
          .hash = [simulation] { return (*simulation)->body().state_hash(); }};
}

/// No timing without agreement.
void require_agreement(const std::vector<TimedTask>& tasks, std::size_t count) {
  std::uint64_t first = 0;
  for (std::size_t k = 0; k < count; ++k) {
    tasks[k].restore();
    tasks[k].run();
    if (k == 0) first = tasks[k].hash();
    if (tasks[k].hash() != first)
      throw SolverError(fmt::format("'{}' leaves another state than '{}'", tasks[k].name, tasks[0].name));
  }
}

}  // namespace

void study_ablation(const AblationOptions& options, const std::function<void(const Sample&)>& sink) {
  std::vector<AblationVariant> variants = ablation_variants();
  std::vector<TimedTask> tasks;
  AblationVariant simulation = variants.front();
  simulation.name = "simulation";
  tasks.push_back(scene_task(simulation, options.steps));
  for (const char* loop : {"watched loop", "loop and detector", "loop", "plain loop"})
    tasks.push_back(loop_task(loop, variants.front().scene, options.steps));
  require_agreement(tasks, tasks.size());
  // few steps per sample, and many rounds: the differences here are less than a hundredth
  run_rounds(tasks, {.rounds = 3 * options.rounds, .process = options.process, .seed = options.seed}, sink);

  tasks.clear();
  for (const AblationVariant& variant : variants) tasks.push_back(scene_task(variant, options.steps));
  const PairedOptions paired{.rounds = options.rounds, .warmup = 1, .process = options.process, .seed = options.seed};
  run_rounds(tasks, paired, sink);

  tasks = output_tasks();
  require_agreement(tasks, 2);  // the third moves nothing
  run_rounds(tasks, paired, sink);
}

}  // namespace dartboard
