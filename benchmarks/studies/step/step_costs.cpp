#include "benchmarks/studies/step/step_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/step/finer_mesh.h"
#include "benchmarks/studies/step/machine_limits.h"
#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/meshes/touching.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/scene/body/simulated_body.h"
#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/force_shares.h"
#include "validation/contenders/contenders.h"
#include "validation/contenders/motion_agreement.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

struct Box {
  std::size_t about;
  int x, y, z;  // cubes of six tetrahedra
};
constexpr Box boxes[] = {{1'000, 5, 6, 6}, {10'000, 12, 12, 12}, {100'000, 26, 26, 25}, {1'000'000, 55, 55, 55}};
/// The largest body that is put on a map for its cell arrays. So small a body is stored in the order of its mesh, so
/// that they add in the same order as columns.
constexpr std::size_t most_for_arrays = 20'000;
/// Springs that a sample takes through a step, so that small bodies take as long as large ones.
constexpr std::size_t springs_in_sample = 150'000;
constexpr double copied_in_sample = 40e6;  // bytes
constexpr double spacing = 0.1;            // [m] the edge of a cube
const Material box_material{.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};
constexpr std::size_t roots_in_sample = 1024 * 1024;
/// For bounds of rounding, which grow with the exponential of the number of steps.
constexpr int steps_compared = 4;

struct StepBody {
  std::string name;
  std::size_t about;  // tetrahedra
  std::function<Problem()> make;
};

template <class T>
void shuffle(std::vector<T>& column, SplitMix64& random) {
  for (std::size_t k = column.size(); k > 1; --k) std::swap(column[k - 1], column[random.below(k)]);
}

/// Points and cells in an order drawn at random.
Mesh shuffled(const Mesh& mesh, std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<std::uint32_t> number(mesh.points.size()), cells(mesh.cell_count());
  std::iota(number.begin(), number.end(), 0u);
  std::iota(cells.begin(), cells.end(), 0u);
  shuffle(number, random);
  shuffle(cells, random);
  Mesh other;
  other.points.resize(mesh.points.size());
  for (std::size_t p = 0; p < number.size(); ++p) other.points[number[p]] = mesh.points[p];
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t c : cells) {
    nodes.clear();
    for (const std::uint32_t p : mesh.cell(c)) nodes.push_back(number[p]);
    other.add_cell(mesh.kinds[c], nodes);
  }
  return other;
}

/// Cubes of a kilogramme each, the lowest layer of points held, damped, in a viscous medium; h omega is about 0.3.
Problem box_problem(const Box& box, bool in_shuffled_order, std::uint64_t seed) {
  Problem problem;
  problem.mesh = kuhn_box(box.x, box.y, box.z, spacing);
  if (in_shuffled_order) problem.mesh = shuffled(problem.mesh, seed);
  problem.material = box_material;
  problem.h = 1e-2;
  SplitMix64 random(seed);
  for (std::uint32_t i = 0; i < problem.mesh.points.size(); ++i) {
    if (problem.mesh.points[i].z() == 0.0) problem.fixed.push_back(i);
    problem.initial_velocity.push_back(0.01 * random.next_in_ball());
  }
  for (const std::uint32_t i : problem.fixed) problem.initial_velocity[i].setZero();
  return problem;
}

/// The mesh of a file, of so many tetrahedra at least, in the order of the file.
Mesh mesh_of_file(const std::filesystem::path& file, std::size_t least) {
  Mesh mesh = read_mesh(file).mesh;
  if (mesh.dimension() != 3) throw InputError(fmt::format("{}: is a surface, expected tetrahedra", file.string()));
  try {
    mesh = finer_mesh_of(std::move(mesh), least);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  split_touching_points(mesh);  // now, as edges that touch have middles that do
  return mesh;
}

/// As heavy and as stiff as a box of as many cubes; slow enough for its worst cells.
Problem mesh_problem(const std::filesystem::path& file, std::size_t least, std::uint64_t seed) {
  Problem problem;
  problem.mesh = mesh_of_file(file, least);
  double volume = 0.0;
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) volume += signed_measure(problem.mesh, c);
  const double scale = spacing * std::cbrt(static_cast<double>(problem.mesh.cell_count()) / (6.0 * volume));
  for (Vector3d& point : problem.mesh.points) point *= scale;
  problem.material = box_material;
  SplitMix64 random(seed);
  for (std::size_t i = 0; i < problem.mesh.points.size(); ++i)
    problem.initial_velocity.push_back(0.01 * random.next_in_ball());
  const auto body = make_simulated_body(problem, false);
  problem.h = 0.3 / frequency_bound(body->system());
  return problem;
}

Problem paper_problem(bool damped) {
  Problem problem = paper_body("liver").make();
  if (!damped) problem.material.damping = 0.0;
  return problem;
}

std::vector<StepBody> bodies_of(const StepCostPlan& plan) {
  std::vector<StepBody> bodies;
  for (const bool damped : {true, false})
    bodies.push_back({paper_step_body(damped), 1856, [damped] { return paper_problem(damped); }});
  for (const Box& box : boxes)
    for (const bool in_shuffled_order : {false, true})
      if (box.about <= plan.largest)
        bodies.push_back({step_box(box.about, in_shuffled_order), box.about,
                          [=, seed = plan.seed] { return box_problem(box, in_shuffled_order, seed); }});
  const std::vector<std::string> names = step_meshes(plan.meshes);
  for (std::size_t k = 0; k < names.size(); ++k)
    bodies.push_back({names[k], plan.least_of_mesh,
                      [=, file = plan.meshes[k]] { return mesh_problem(file, plan.least_of_mesh, plan.seed); }});
  return bodies;
}

/// How the columns of a scene are stepped.
struct Manner {
  const char* task;
  bool lanes = true;
  unsigned threads = 1;
};

bool has_lanes() {
  use_lanes(true);
  return use_lanes(true);
}

unsigned processors() {
  const unsigned before = use_threads(0), all = use_threads(before);
  return all;
}

/// A scene's body of springs, stepped in one manner. Several share the columns.
class SceneColumns : public ContenderBody {
 public:
  SceneColumns(std::shared_ptr<SimulatedBody> body, double h, Manner manner)
      : body_(std::move(body)), integrator_(make_integrator("rk4")), h_(h), manner_(manner) {}
  void step(int n) override {
    for (int k = 0; k < n; ++k)
      if (const StepResult result = integrator_->step(body_->system(), body_->motion(), h_); !result.ok())
        throw SolverError(fmt::format("a step of '{}' failed: {}", manner_.task, to_string(result)));
  }
  PointState state() const override {
    const VertexColumns& v = std::as_const(*body_).vertices();
    PointState state{std::vector<Vector3d>(v.size()), std::vector<Vector3d>(v.size())};
    for (std::size_t k = 0; k < v.size(); ++k) {
      state.x[v.point[k]] = v.position[k];
      state.v[v.point[k]] = v.velocity[k];
    }
    return state;
  }
  void set_state(const PointState& state) override {
    choose();
    VertexColumns& v = body_->vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      v.position[k] = state.x[v.point[k]];
      v.velocity[k] = state.v[v.point[k]];
    }
  }
  std::vector<Vector3d> forces() override {
    const VertexColumns& v = body_->vertices();
    return spring_and_drag_forces(body_->system(), v.position, v.velocity, v.point);
  }
  /// From now on step in this manner; several threads are awake then.
  void choose() const {
    use_lanes(manner_.lanes);
    use_threads(manner_.threads);
    if (manner_.threads > 1) thread_team().run([](unsigned) {});
  }

 private:
  std::shared_ptr<SimulatedBody> body_;
  std::unique_ptr<Integrator> integrator_;
  double h_;
  Manner manner_;
};

/// Lanes and threads as they were, whatever happens.
class MannerBefore {
 public:
  MannerBefore() : lanes_(use_lanes(true)), threads_(threads_in_use()) { use_lanes(lanes_); }
  MannerBefore(const MannerBefore&) = delete;
  MannerBefore& operator=(const MannerBefore&) = delete;
  ~MannerBefore() {
    use_lanes(lanes_);
    use_threads(threads_);
  }

 private:
  bool lanes_;
  unsigned threads_;
};

unsigned threads_for(const SimulatedBody& body) {
  const unsigned all = processors(), before = use_threads(all);
  const bool shares = all > 1 && !share_forces(body.system()).empty();
  use_threads(before);
  return shares ? all : 1;
}

/// All ways to step one body.
struct Stepped {
  Problem problem;
  std::shared_ptr<SimulatedBody> columns;
  std::vector<Manner> manners;
  StepCounts counts;

  Stepped(const StepBody& body) : problem(body.make()), columns(make_simulated_body(problem, false)) {
    const SpringSystem system = columns->system();
    const std::size_t vertices = system.vertex_count(), springs = system.springs.size();
    counts = {.body = body.name,
              .tetrahedra = problem.mesh.cell_count(),
              .vertices = vertices,
              .springs = springs,
              .steps = static_cast<int>(std::max<std::size_t>(1, springs_in_sample / springs)),
              .lanes = has_lanes(),
              .threads = threads_for(*columns),
              .arrays = problem.mesh.cell_count() <= most_for_arrays,
              .bytes = bytes_of_evaluation(system)};
    counts.copied_bytes = static_cast<double>(copied().bytes()) * passes();
    counts.roots = static_cast<double>(roots_in_sample);
    manners = {{step_task::one, false, 1}};
    if (counts.lanes) manners.push_back({step_task::lanes, true, 1});
    if (counts.threads > 1) manners.push_back({step_task::threads, true, counts.threads});
  }

  /// What an evaluation reads and writes, each column once for each loop over it, in the mean over the four of a step:
  /// accelerations.cpp and classical_runge_kutta.cpp have the loops.
  static double bytes_of_evaluation(const SpringSystem& system) {
    const bool damped = !system.springs.damped().empty(), viscous = !system.viscosity.empty();
    constexpr std::size_t row = sizeof(Vector3d);
    const std::size_t spring = sizeof(SpringEnds) + (damped ? sizeof(Spring) : sizeof(UndampedSpring));
    const std::size_t cleared = row, added = (damped ? 4 : 3) * row;
    const std::size_t divided = 2 * row + sizeof(double) + (viscous ? row + sizeof(double) : 0) + 1;
    const double updated = (7.0 + 2 * 10.0 + 8.0 + 6.0) / 4.0 * static_cast<double>(row);  // of four stages; the end
    return static_cast<double>(system.springs.size() * spring) +
           static_cast<double>(system.vertex_count()) * (static_cast<double>(cleared + added + divided) + updated);
  }
  /// Columns of the size of those that a step reads and writes.
  CopiedColumns copied() const {
    const bool damped = !columns->system().springs.damped().empty();
    return CopiedColumns(counts.springs * (sizeof(SpringEnds) + (damped ? sizeof(Spring) : sizeof(UndampedSpring))) +
                         counts.vertices * (7 * sizeof(Vector3d) + 2 * sizeof(double) + 1));
  }
  int passes() const {
    return 2 * std::max(1, static_cast<int>(copied_in_sample / 2.0 / static_cast<double>(copied().bytes())));
  }
  std::shared_ptr<SceneColumns> in(const Manner& manner) const {
    return std::make_shared<SceneColumns>(columns, problem.h, manner);
  }
};

/// The columns in each manner and the graph; the first of them is what the others must agree with.
std::size_t count_differing(const Stepped& body) {
  std::vector<Contender> all;
  for (const Manner& manner : body.manners)
    all.push_back({manner.task, "columns", "", 0.0, Carrier::core_map, [&body, manner](const Problem&) {
                     auto columns = std::make_unique<SceneColumns>(body.columns, body.problem.h, manner);
                     columns->choose();
                     return columns;
                   }});
  all.push_back(contender(baseline_id));
  if (body.counts.arrays) all.push_back(contender("arrays"));
  const auto compared = compare_motion(body.problem, steps_compared, all);
  return static_cast<std::size_t>(std::ranges::count(compared, false, &MotionAgreement::agrees));
}

void measure_body(const Stepped& body, const PairedOptions& options, const std::function<void(const Sample&)>& sink) {
  const StepCounts& counts = body.counts;
  std::vector<TimedTask> tasks;
  // in motion, and with the damping at work
  const auto first = body.in(body.manners.front());
  first->choose();
  first->step(10);
  const PointState start = first->state();
  for (const Manner& manner : body.manners) {
    const auto columns = body.in(manner);
    tasks.push_back({counts.body + manner.task, [columns, &start] { columns->set_state(start); },
                     [columns, n = counts.steps] { columns->step(n); },
                     [scene = body.columns] { return scene->state_hash(); }});
  }
  const auto add_contender = [&](const char* task, std::string_view id) {
    const std::shared_ptr<ContenderBody> other = contender(id).make(body.problem);
    tasks.push_back({counts.body + task,
                     [other, &start] {
                       use_threads(1);
                       other->set_state(start);
                     },
                     [other, n = counts.steps] { other->step(n); }, [other] { return state_hash(other->state()); }});
  };
  add_contender(step_task::graph, baseline_id);
  if (counts.arrays) add_contender(step_task::arrays, "arrays");
  const auto copied = std::make_shared<CopiedColumns>(body.copied());
  tasks.push_back({counts.body + step_task::copy, [] {}, [copied, n = body.passes()] { copied->run(n); },
                   [copied] { return copied->hash(); }});
  const auto roots = std::make_shared<RootsAndQuotients>();
  tasks.push_back({counts.body + step_task::roots, [] {}, [roots] { roots->run(roots_in_sample); },
                   [roots] { return roots->hash(); }});
  run_rounds(tasks, options, sink);
}

}  // namespace

std::string paper_step_body(bool damped) { return damped ? "liver564, damped" : "liver564, undamped"; }

std::string step_box(std::size_t tetrahedra, bool in_shuffled_order) {
  return fmt::format("10^{:.0f} {}", std::log10(static_cast<double>(tetrahedra)),
                     in_shuffled_order ? "shuffled" : "in grid order");
}

std::vector<std::string> step_bodies(std::size_t largest) {
  std::vector<std::string> names;
  for (const StepBody& body : bodies_of({.largest = largest})) names.push_back(body.name);
  return names;
}

std::vector<std::string> step_meshes(const std::vector<std::filesystem::path>& meshes) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : meshes) {
    names.push_back(file.stem().string());
    if (std::ranges::count(names, names.back()) > 1)
      throw InputError(fmt::format("two meshes are called '{}', expected different names", names.back()));
  }
  return names;
}

void compare_steps(const StepCostPlan& plan, const std::function<void(const StepCounts&)>& sink) {
  const MannerBefore before;
  for (const StepBody& each : bodies_of(plan)) {
    Stepped body(each);
    body.counts.differing = count_differing(body);
    sink(body.counts);
  }
}

void measure_step_costs(const StepCostPlan& plan, const std::function<void(const Sample&)>& sink) {
  const MannerBefore before;
  for (const StepBody& each : bodies_of(plan)) {
    const int rounds = each.about < 1'000'000 ? plan.rounds : std::max(1, plan.rounds / 5);
    measure_body(Stepped(each), {.rounds = rounds, .warmup = 1, .process = plan.process, .seed = plan.seed}, sink);
  }
}

void to_json(nlohmann::json& json, const StepCounts& c) {
  json = {{"body", c.body},         {"tetrahedra", c.tetrahedra},
          {"vertices", c.vertices}, {"springs", c.springs},
          {"steps", c.steps},       {"lanes", c.lanes},
          {"threads", c.threads},   {"arrays", c.arrays},
          {"bytes", c.bytes},       {"copied_bytes", c.copied_bytes},
          {"roots", c.roots},       {"differing", c.differing}};
}
void from_json(const nlohmann::json& json, StepCounts& c) {
  json.at("body").get_to(c.body);
  json.at("tetrahedra").get_to(c.tetrahedra);
  json.at("vertices").get_to(c.vertices);
  json.at("springs").get_to(c.springs);
  json.at("steps").get_to(c.steps);
  json.at("lanes").get_to(c.lanes);
  json.at("threads").get_to(c.threads);
  json.at("arrays").get_to(c.arrays);
  json.at("bytes").get_to(c.bytes);
  json.at("copied_bytes").get_to(c.copied_bytes);
  json.at("roots").get_to(c.roots);
  json.at("differing").get_to(c.differing);
}

}  // namespace dartboard
