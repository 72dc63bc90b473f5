#include "benchmarks/studies/contact/contact_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/json_fields.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"
#include "core/topology/storage/hash.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double spacing = 0.05;
/// The most pairs of a sample and a tetrahedron that brute force compares.
constexpr std::size_t affordable = 60'000'000;
/// Tetrahedra evaluated in each sample, so that small bodies take as long as large ones.
constexpr std::size_t evaluated = 400'000;

Json scene_of(const std::string& name, const char* material) {
  Json scene = Json::parse(R"({"step": 1e-4, "duration": 1000, "integrator": "verlet", "gravity": [0, 0, 0]})");
  scene["name"] = name;
  scene["material"] = Json::parse(material);
  return scene;
}
constexpr const char* elastic = R"({"density": 1000, "young": 200000, "poisson": 0.3, "viscosity": 0})";
constexpr const char* springs = R"({"density": 1000, "stiffness": 20, "damping": 0, "viscosity": 0})";

/// A law with losses: contact then has work before and after each step, too.
Json contact() { return {{"pressure", 20000}, {"depth", 0.01}, {"restitution", 0.5}, {"friction", 0.3}}; }
Json plane_at(double z) { return Json::array({{{"plane", {{"point", {0, 0, z}}, {"normal", {0, 0, 1}}}}}}); }
Json box(int nx, int ny, int nz) {
  return {{"generate", {{"box", {{"cells", {nx, ny, nz}}, {"spacing", spacing}, {"pattern", "kuhn"}}}}}};
}

/// Cubes in columns of four, each on the one below, moved sideways at random.
Json pile_of_100(std::uint64_t seed) {
  Json scene = scene_of("pile", elastic);
  SplitMix64 random(seed);
  for (int k = 0; k < 100; ++k) {
    Json body = box(2, 2, 2);
    const auto place = [&random](int cubes) { return 2.5 * spacing * cubes + 0.2 * spacing * random.next_signed(); };
    const double x = place(k % 5), y = place(k / 5 % 5);
    const int layer = k / 25;
    body["translate"] = {x, y, 1.98 * spacing * layer};
    scene["bodies"].push_back(body);
  }
  scene["gravity"] = {0, 0, -9.81};
  scene["contact"] = contact();
  scene["contact"]["bodies"] = "others";
  scene["contact"]["obstacles"] = plane_at(0.02 * spacing);
  return scene;
}

/// Two plates, each two cubes high, one on the other: all tetrahedra are along the boundary.
Json plates(int across) {
  Json scene = scene_of("plates", elastic);
  scene["step"] = 1e-6;
  scene["bodies"] = {box(across, across, 2), box(across, across, 2)};
  scene["bodies"][1]["translate"] = {0.3 * spacing, 0.2 * spacing, 1.96 * spacing};
  scene["contact"] = contact();
  scene["contact"]["bodies"] = "others";
  return scene;
}
constexpr int plates_across[] = {7, 20, 65, 204};
std::size_t tetrahedra_of_plates(int across) {
  const auto squares = static_cast<std::size_t>(across);
  return 24 * squares * squares;
}
std::string name_of_plates(int across) { return fmt::format("plates of {}", tetrahedra_of_plates(across)); }

struct Situation {
  std::string name;
  Json scene;
  int steps = 0;    // taken before forces are timed
  int stretch = 0;  // the steps after them over which they are timed; none: at one place
};

Situation idle(const char* name, const char* material, bool plane) {
  Json scene = scene_of(name, material);
  scene["body"] = {{"mesh", "liver564.mesh"}};
  scene["contact"] = contact();
  if (plane)
    scene["contact"]["obstacles"] = plane_at(-1.0);
  else
    scene["contact"]["bodies"] = "themselves";
  return {name, scene};
}

std::vector<Situation> all_idle() {
  return {idle("elements far from a plane", elastic, true), idle("elements far from themselves", elastic, false),
          idle("springs far from a plane", springs, true), idle("springs far from themselves", springs, false)};
}

Situation pile(std::uint64_t seed) { return {"a pile of 100", pile_of_100(seed), 20}; }

Situation on_a_plane() {
  Json scene = scene_of("rest", elastic);
  scene["body"] = box(8, 8, 4);
  scene["contact"] = contact();
  scene["contact"]["obstacles"] = plane_at(0.002);
  return {"on a plane", scene};
}

/// Cut through, and its parts flying into each other.
Situation liver_cut() {
  Json scene = scene_of("cut", elastic);
  scene["body"] = {{"mesh", "liver564.mesh"}};
  scene["initial_velocity"] = Json::parse(R"({"linear": [[-6, 0, 0], [0, 0, 0], [0, 0, 0]]})");
  scene["events"] = Json::parse(R"([{"at": 0, "dissociate": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0.2]}}}])");
  scene["contact"] = contact();
  scene["contact"]["bodies"] = "themselves";
  return {"the liver, cut through", scene, 200, 63};
}

/// Cubes on a plane apart from each other; the first moves along it, and vibrates.
Json cubes_on_a_plane(int count, int across, const char* material, bool touching) {
  Json scene = scene_of("asleep", material);
  for (int k = 0; k < count; ++k) {
    Json body = box(across, across, across);
    const int column = k % 10, row = k / 10;
    body["translate"] = {2 * across * spacing * column, 2 * across * spacing * row, 0};
    if (k == 0)
      body["initial_velocity"] =
          Json::parse(R"({"constant": [0, 0.3, 0.1], "linear": [[1, 0, 0], [0, -1, 0], [0, 0, 0.5]]})");
    scene["bodies"].push_back(body);
  }
  scene["sleep"] = Json::parse(R"({"speed": 1e-3, "time": 1e-3})");
  if (!touching) return scene;
  scene["contact"] = contact();
  scene["contact"]["bodies"] = "all";
  scene["contact"]["obstacles"] = plane_at(0);
  return scene;
}
constexpr int cubes = 100;
struct Asleep {
  const char* name;
  const char* material;
  bool touching;
};
constexpr Asleep all_asleep[] = {{"cubes of elements", elastic, false},
                                 {"cubes of elements, with contact", elastic, true},
                                 {"cubes of springs", springs, false},
                                 {"cubes of springs, with contact", springs, true}};

SceneFile parsed(const Json& scene) {
  return parse_scene(scene.dump(), "scene of contact", source_folder() / "benchmarks" / "meshes");
}

void advance(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k)
    if (simulation.advance()) throw SolverError("a scene of contact diverged");
}

std::vector<std::string> names_of(const std::vector<Situation>& situations) {
  std::vector<std::string> names;
  for (const Situation& s : situations) names.push_back(s.name);
  return names;
}

// ---- counts

bool same(const BodyTouch& a, const BodyTouch& b) {
  return a.sample == b.sample && a.tetrahedron == b.tetrahedron && a.triangle == b.triangle && a.depth == b.depth;
}
std::size_t count_differing(std::span<const BodyTouch> a, std::span<const BodyTouch> b) {
  std::size_t differing = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) differing += same(a[k], b[k]) ? 0 : 1;
  return differing;
}

ContactCounts count(const std::string& situation, const Simulation& simulation) {
  const SimulatedBody& body = simulation.body();
  const std::vector<Vector3d>& x = body.vertices().position;
  ContactCounts counts{.situation = situation, .tetrahedra = body.counts().cells};
  const Contacts contacts = body.contacts();
  counts.samples = contacts.samples(contacts.bodies != nullptr).size();
  counts.contacts = contacts.state_at(x).contacts;
  if (const BodyContact* bodies = contacts.bodies) {
    const auto touching = bodies->touching({x});
    counts.candidates = bodies->candidates().pair_count();
    BodyContact other(bodies->samples(), bodies->solids(), *bodies);
    other.set_margin(0.5);
    counts.differing = count_differing(touching, other.touching({x}));
    if (counts.samples * bodies->solids().tetrahedra().size() <= affordable)
      counts.differing += count_differing(touching, bodies->touching_by_brute_force({x}, nullptr));
    std::vector<Vector3d> force(x.size(), Vector3d(0, 0, 0));
    bodies->add_forces({x}, force);
    Vector3d sum(0, 0, 0);
    double sizes = 0.0;
    for (const Vector3d& f : force) {
      sum += f;
      sizes += f.norm();
    }
    if (sizes > 0.0) counts.unbalanced = sum.norm() / sizes;
  }
  return counts;
}

// ---- tasks

TimedTask step_task(const std::string& name, SceneFile scene, int steps, int before = 5) {
  auto simulation = std::make_shared<std::unique_ptr<Simulation>>();
  return {.name = name,
          .restore =
              [simulation, before, scene = std::move(scene)] {
                *simulation = std::make_unique<Simulation>(scene);
                advance(**simulation, before);
              },
          .run = [simulation, steps] { advance(**simulation, steps); },
          .hash = [simulation] { return (*simulation)->body().state_hash(); }};
}

/// The step with contact and without. Returns their hashes after a run.
std::pair<std::uint64_t, std::uint64_t> add_step_tasks(const Situation& situation, int steps,
                                                       std::vector<TimedTask>& tasks) {
  SceneFile scene = parsed(situation.scene);
  tasks.push_back(step_task(situation.name + ": step", scene, steps));
  scene.obstacles.clear();
  scene.touches.clear();
  tasks.push_back(step_task(situation.name + ": step without", scene, steps));
  for (std::size_t k = tasks.size() - 2; k < tasks.size(); ++k) {
    tasks[k].restore();
    tasks[k].run();
  }
  return {tasks[tasks.size() - 2].hash(), tasks.back().hash()};
}

/// All cubes but one asleep, and that one alone. The counts have the bodies asleep as samples.
void add_sleep_tasks(const Asleep& asleep, int across, int steps, std::vector<TimedTask>& tasks,
                     const std::function<void(const ContactCounts&)>& counts_sink) {
  constexpr int until_asleep = 15;
  const std::string name = asleep.name;
  const SceneFile many = parsed(cubes_on_a_plane(cubes, across, asleep.material, asleep.touching)),
                  one = parsed(cubes_on_a_plane(1, across, asleep.material, asleep.touching));
  Simulation simulation(many), alone(one);
  advance(simulation, until_asleep + steps);
  advance(alone, until_asleep + steps);
  ContactCounts counts{.situation = name, .tetrahedra = alone.body().counts().cells};
  counts.samples = simulation.diagnostics().sleep->asleep;
  const auto &x = simulation.body().vertices().position, &own = alone.body().vertices().position;
  if (counts.samples + 1 != cubes || !std::equal(own.begin(), own.end(), x.begin())) ++counts.differing;
  counts_sink(counts);
  tasks.push_back(step_task(name + ": step", many, steps, until_asleep));
  tasks.push_back(step_task(name + ": step alone", one, steps, until_asleep));
}

/// A body whose forces are taken over and over, to and fro along a stretch of its motion, so that lists age and are
/// made anew as in a run; or at two places next to each other in turn: contacts are not searched twice at the same.
struct Pressed {
  Simulation simulation;
  std::vector<std::vector<Vector3d>> x;
  std::vector<Vector3d> force;
  std::unique_ptr<BodyContact> own;  // whose lists are made anew
  int evaluations = 1;               // whole ways to and fro

  Pressed(const SceneFile& scene, const Situation& situation) : simulation(scene) {
    advance(simulation, situation.steps);
    const auto add_places = [this] { x.push_back(simulation.body().vertices().position); };
    add_places();
    for (int k = 0; k < situation.stretch; ++k) {
      advance(simulation, 1);
      add_places();
    }
    if (situation.stretch > 0) return;
    add_places();
    for (Vector3d& place : x[1]) place[0] += 1e-6 * spacing;
  }
  int to_and_fro() const { return 2 * (static_cast<int>(x.size()) - 1); }
  StagePlaces at(int evaluation) const {
    const int k = evaluation % to_and_fro();
    return {x[static_cast<std::size_t>(std::min(k, to_and_fro() - k))]};
  }
  void start() { force.assign(x[0].size(), Vector3d(0, 0, 0)); }
  std::uint64_t hash() const {
    Hash hash;
    hash.add(force);
    return hash.value();
  }
};

void add_force_tasks(const Situation& situation, bool lists, std::vector<TimedTask>& tasks,
                     const std::function<void(const ContactCounts&)>& counts_sink) {
  const SceneFile scene = parsed(situation.scene);
  const auto s = std::make_shared<Pressed>(scene, situation);
  ContactCounts counts = count(situation.name, s->simulation);
  const auto ways = static_cast<std::size_t>(s->to_and_fro()) * counts.tetrahedra;
  counts.evaluations = s->to_and_fro() * static_cast<int>(std::max<std::size_t>(1, evaluated / ways));
  counts_sink(counts);
  s->evaluations = counts.evaluations;
  const auto add_task = [&](const char* name, bool of_contact) {
    tasks.push_back({situation.name + name, [s] { s->start(); },
                     [s, of_contact] {
                       const SimulatedBody& body = s->simulation.body();
                       const ForceTerms terms = body.system().terms;
                       const std::size_t others = body.terms_but_contact(terms).size();
                       const ForceTerms chosen = of_contact ? terms.subspan(others) : terms.first(others);
                       for (int k = 0; k < s->evaluations; ++k)
                         for (const ForceTerm* term : chosen) term->add_forces(s->at(k), s->force);
                     },
                     [s] { return s->hash(); }});
  };
  add_task(": contact", true);
  add_task(": elements", false);
  if (!lists) return;
  const BodyContact& contact = *s->simulation.body().contacts().bodies;
  s->own = std::make_unique<BodyContact>(contact.samples(), contact.solids(), contact);
  tasks.push_back({situation.name + ": list", [] {},
                   [s] {
                     for (int k = 0; k < s->evaluations; ++k) {
                       s->own->set_margin(s->own->candidates().margin_share());
                       s->own->touching(s->at(k));
                     }
                   },
                   [s] { return static_cast<std::uint64_t>(s->own->candidates().pair_count()); }});
}

}  // namespace

std::vector<std::string> idle_situations() { return names_of(all_idle()); }

std::vector<std::string> stepped_situations() {
  std::vector<std::string> names = idle_situations();
  names.push_back(pile(1).name);
  return names;
}

std::vector<std::string> pressed_situations() { return names_of({on_a_plane(), liver_cut(), pile(1)}); }

std::vector<std::string> asleep_situations() {
  std::vector<std::string> names;
  for (const Asleep& one : all_asleep) names.emplace_back(one.name);
  return names;
}

std::string cut_situation() { return liver_cut().name; }

std::vector<std::string> plate_situations(std::size_t largest) {
  std::vector<std::string> names;
  for (const int across : plates_across)
    if (tetrahedra_of_plates(across) <= largest) names.push_back(name_of_plates(across));
  return names;
}

void measure_contact_costs(const ContactCostPlan& plan, const std::function<void(const ContactCounts&)>& counts_sink,
                           const std::function<void(const Sample&)>& sink) {
  const PairedOptions paired{.rounds = plan.rounds, .warmup = 1, .process = plan.process, .seed = plan.seed};
  std::vector<TimedTask> tasks;
  for (const Situation& s : all_idle()) {
    const auto [with, without] = add_step_tasks(s, plan.steps, tasks);
    const SceneFile scene = parsed(s.scene);
    ContactCounts counts = count(s.name, Simulation(scene));
    if (with != without) ++counts.differing;
    counts_sink(counts);
  }
  add_step_tasks(pile(plan.seed), plan.steps, tasks);
  run_rounds(tasks, paired, sink);

  tasks.clear();
  for (const Situation& s : {on_a_plane(), liver_cut(), pile(plan.seed)}) add_force_tasks(s, false, tasks, counts_sink);
  for (const int across : plates_across)
    if (tetrahedra_of_plates(across) <= plan.largest)
      add_force_tasks({name_of_plates(across), plates(across)}, true, tasks, counts_sink);
  for (const Asleep& one : all_asleep) add_sleep_tasks(one, plan.across, plan.steps, tasks, counts_sink);
  PairedOptions fewer = paired;
  fewer.rounds = std::max(1, plan.rounds / 3);
  run_rounds(tasks, fewer, sink);
}

DARTBOARD_JSON_FIELDS(ContactCounts, situation, tetrahedra, samples, candidates, contacts, evaluations, differing,
                      unbalanced)

}  // namespace dartboard
