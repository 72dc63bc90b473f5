#include "benchmarks/studies/step/step_costs.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/json_fields.h"
#include "benchmarks/studies/step/machine_limits.h"
#include "benchmarks/studies/step/scene_columns.h"
#include "core/base/padded_vector.h"
#include "core/base/thread_team.h"
#include "core/scene/body/simulated_body.h"
#include "core/time/system/force_shares.h"
#include "validation/contenders/contenders.h"
#include "validation/contenders/motion_agreement.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The largest body that is put on a map for its cell arrays. So small a body is stored in the order of its mesh, so
/// that they add in the same order as columns.
constexpr std::size_t most_for_arrays = 20'000;
constexpr double copied_in_sample = 40e6;  // bytes
constexpr std::size_t roots_in_sample = 1024 * 1024;

std::vector<StepBody> bodies_of(const StepCostPlan& plan) {
  if (!plan.only.empty()) return {find_step_body(plan.only, plan.seed)};
  std::vector<StepBody> bodies = make_step_bodies(plan.largest, plan.seed);
  for (StepBody& body : make_bodies_of_files(plan.meshes, plan.least_of_mesh, plan.seed))
    bodies.push_back(std::move(body));
  return bodies;
}

unsigned threads_for(const SimulatedBody& body) {
  const unsigned all = count_processors(), before = use_threads(all);
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
              .bytes = bytes_of_evaluation(system, has_lanes())};
    counts.copied_bytes = static_cast<double>(copied().bytes()) * passes();
    counts.roots = static_cast<double>(roots_in_sample);
    manners = {{.task = step_task::one, .lanes = false}};
    if (counts.lanes) {
      manners.push_back({.task = step_task::lanes, .padded = false});
      manners.push_back({.task = step_task::padded});
    }
    if (counts.threads > 1) manners.push_back({.task = step_task::threads, .threads = counts.threads});
  }

  /// What an evaluation of the fastest way on one thread reads and writes, each column once for each loop over it, in
  /// the mean over the four of a step.
  static double bytes_of_evaluation(const SpringSystem& system, bool padded) {
    const bool damped = !system.springs.damped().empty();
    const double row = padded ? sizeof(PaddedVector) : sizeof(Vector3d), three = sizeof(Vector3d);
    const double added = (damped ? 4 : 3) * row;
    // accelerations.cpp: cleared, divided; classical_runge_kutta.cpp: four stages; the end
    const double by_threes = 3 * three + (7 + 2 * 10 + 8 + 6) / 4.0 * three;
    // padded_runge_kutta.cpp: four stages, the start and the end; and three of motions that are not padded
    const double by_fours = (7 + 2 * 9 + 7 + 4) / 4.0 * row + 3 * three;
    const double divided = sizeof(double) + (system.viscosity.empty() ? 0 : sizeof(double) + (padded ? 0 : three)) + 1;
    return static_cast<double>(system.springs.size() * bytes_of_spring(system)) +
           static_cast<double>(system.vertex_count()) * (added + divided + (padded ? by_fours : by_threes));
  }
  static std::size_t bytes_of_spring(const SpringSystem& system) {
    return sizeof(SpringEnds) + (system.springs.damped().empty() ? sizeof(UndampedSpring) : sizeof(Spring));
  }
  /// Columns of the size of those that a step reads and writes.
  CopiedColumns copied() const {
    const std::size_t stage_row = counts.lanes ? sizeof(PaddedVector) : sizeof(Vector3d);
    return CopiedColumns(counts.springs * bytes_of_spring(columns->system()) +
                         counts.vertices * (2 * sizeof(Vector3d) + 5 * stage_row + 2 * sizeof(double) + 1));
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
  if (counts.threads > 1)
    tasks.push_back({counts.body + step_task::copy_by_threads, [n = counts.threads] { use_threads(n); },
                     [copied, n = body.passes()] { copied->run_by_threads(n); }, [copied] { return copied->hash(); }});
  const auto roots = std::make_shared<RootsAndQuotients>();
  tasks.push_back({counts.body + step_task::roots, [] {}, [roots] { roots->run(roots_in_sample); },
                   [roots] { return roots->hash(); }});
  run_rounds(tasks, options, sink);
}

}  // namespace

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

DARTBOARD_JSON_FIELDS(StepCounts, body, tetrahedra, vertices, springs, steps, lanes, threads, arrays, bytes,
                      copied_bytes, roots, differing)

}  // namespace dartboard
