#include "benchmarks/studies/solvers/solver_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/error.h"
#include "core/time/implicit/baraff_witkin.h"
#include "core/time/solve/backward_error.h"
#include "core/time/system/accelerations.h"
#include "core/topology/storage/hash.h"
#include "validation/contenders/contender_body.h"
#include "validation/scenes/scene_stage.h"
#include "validation/solvers/solver_bodies.h"

namespace dartboard {
namespace {

void require(SolveStatus status) {
  if (status != SolveStatus::ok)
    throw SolverError(fmt::format("a factorisation that is timed ended: {}", to_string(status)));
}

// One contender: a factor of the whole body, and its update when a vertex is dissociated.
struct FactorTask {
  std::string name;
  CholeskyOptions options;
  bool again = false;
  std::optional<Cholesky> cholesky;
  StepMatrix followed;
  std::size_t pair = 0;     // which dissociation comes next
  std::size_t updates = 0;  // that the factor has been through

  /// Solves the system that the factor was last made for; returns the hash of the solution.
  std::uint64_t solve(const std::vector<SolverMatrix>& torn, std::span<const Eigen::Vector3d> b) {
    std::vector<Eigen::Vector3d> x(b.size());
    require(cholesky->solve(b, x));
    require_agreement(name, torn[(pair - 1) % torn.size()].blocks, b, x, factor_bound(3 * b.size(), updates));
    Hash hash;
    hash.add(x);
    return hash.value();
  }
};

/// The equations of a linearly implicit step from the start of a scene: (M + h C + h^2 K) v = M v0 + h f.
class StepEquations {
 public:
  StepEquations(const TradeoffScene& scene, double h) {
    SceneStage stage(scene);
    const SpringSystem system = stage.system();
    const PointState start = stage.state();
    std::vector<SpringTangent> tangents;
    evaluate_tangents(system, start.x, Compression::exact, tangents);
    StepMatrix step;
    step.evaluate(system, tangents, h);
    step.assemble(node_pattern_of(system), matrix_);
    right_.resize(start.x.size());
    accelerations(system, terms_of(system), start.x, start.v, right_);
    for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = system.mass[i] * (start.v[i] + h * right_[i]);
  }

  /// `tolerance` is that of |b - A v| / |b| by Euclidean lengths: in the largest norm the root of n times as much.
  void check(const std::string& task, const std::vector<Eigen::Vector3d>& v, double tolerance) const {
    const std::size_t unknowns = 3 * right_.size();
    require_agreement(task, matrix_, right_, v,
                      factor_bound(unknowns, 0) + tolerance * std::sqrt(static_cast<double>(unknowns)));
  }

 private:
  BlockMatrix matrix_;
  std::vector<Eigen::Vector3d> right_;
};

}  // namespace

void require_agreement(const std::string& task, const BlockMatrix& matrix, std::span<const Eigen::Vector3d> b,
                       std::span<const Eigen::Vector3d> x, double bound) {
  const double error = normwise_backward_error(matrix, b, x);
  if (!(error <= bound))
    throw SolverError(fmt::format(
        "'{}' is not timed: the backward error of its solution is {:.1e}, the bound is {:.1e}", task, error, bound));
}

double factor_bound(std::size_t unknowns, std::size_t updates) {
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  const auto n = static_cast<double>(unknowns);
  return (3.0 * n + 1.0) * u * n * (1.0 + static_cast<double>(updates));
}

Figure SolverTimes::ratio(const std::string& task, const std::string& baseline) const {
  std::map<int, double> above, below;
  for (const Sample& s : samples) {
    if (s.task == task) above[s.round] = static_cast<double>(s.cpu_ns);
    if (s.task == baseline) below[s.round] = static_cast<double>(s.cpu_ns);
  }
  std::vector<double> ratios;
  for (const auto& [round, ns] : above) ratios.push_back(ns / below.at(round));
  return figure_of(ratios);
}

Figure SolverTimes::time_ms(const std::string& task) const {
  std::vector<double> ms;
  for (const Sample& s : samples)
    if (s.task == task) ms.push_back(1e-6 * static_cast<double>(s.cpu_ns));
  return figure_of(ms);
}

double SolverTimes::milliseconds(const std::string& task) const { return 1e-6 * times_of(samples, task).cpu_median; }

SolverTimes time_updates(int side, double stretch, int rounds, std::uint64_t seed) {
  const DissociationPairs pairs = dissociation_pairs(side, stretch, 8);
  const double h_omega = 20.0, tau = h_omega / frequency_bound(pairs.whole.system());
  const SolverMatrix whole(pairs.whole, Compression::projected, tau);
  std::vector<SolverMatrix> torn;
  for (const SpringColumns& columns : pairs.torn) torn.emplace_back(columns, Compression::projected, tau);

  SolverTimes result;
  result.vertices = pairs.whole.mass.size();
  result.stretched = stretch != 0.0;
  result.h_omega = h_omega;
  result.body = fmt::format("{} vertices, {}", result.vertices, result.stretched ? "stretched" : "at rest");

  // every torn body has one vertex more
  const std::vector<Eigen::Vector3d> b = drawn_vectors(result.vertices + 1, seed);

  std::vector<std::shared_ptr<FactorTask>> factors;
  for (const Ordering ordering : {Ordering::amd, Ordering::metis}) {
    const std::string label = ordering == Ordering::amd ? "AMD" : "METIS";
    CholeskyOptions options{.ordering = ordering, .spare_nodes = 1, .ready_for_updates = true};
    factors.push_back(std::make_shared<FactorTask>(FactorTask{"follows, " + label, options, false, {}, {}, 0}));
    // rates that leave the rule no choice
    constexpr double far_too_slow = 1e9;
    options.rates.supernodal_flop = options.rates.simplicial_flop = 1.0;
    CholeskyOptions terms = options, rows = options;
    terms.rates.row_flop = far_too_slow;
    rows.rates.update_flop = far_too_slow;
    factors.push_back(std::make_shared<FactorTask>(FactorTask{"by terms, " + label, terms, false, {}, {}, 0}));
    factors.push_back(std::make_shared<FactorTask>(FactorTask{"by rows, " + label, rows, false, {}, {}, 0}));
    factors.push_back(std::make_shared<FactorTask>(FactorTask{"again, " + label, options, true, {}, {}, 0}));
    factors.back()->options.ready_for_updates = false;
  }
  std::vector<TimedTask> tasks;
  for (const auto& f : factors) {
    result.tasks.push_back(f->name);
    tasks.push_back({f->name,
                     [f, &whole] {
                       f->cholesky.emplace(f->options);
                       require(f->cholesky->factorise(whole.blocks));
                       f->followed = whole.step;
                     },
                     [f, &pairs, &torn, &result] {
                       const std::size_t k = f->pair++ % torn.size();
                       if (f->again) {
                         require(f->cholesky->factorise(torn[k].blocks));
                         return;
                       }
                       const auto terms =
                           f->followed.follow(pairs.torn[k].system(), torn[k].tangents, f->cholesky->spare_diagonal());
                       require(f->cholesky->follow(torn[k].blocks, terms));
                       result.terms = f->updates = terms.size();
                     },
                     [f, &torn, &b] { return f->solve(torn, b); }});
  }
  for (const TimedTask& task : tasks) {
    task.restore();
    task.run();
    task.hash();
  }
  run_rounds(tasks, {.rounds = rounds, .warmup = 1, .seed = seed},
             [&](const Sample& sample) { result.samples.push_back(sample); });
  result.rows = factors.front()->cholesky->counters().rows_replaced;
  return result;
}

SolverTimes time_implicit_step(double h_omega, int rounds, std::uint64_t seed) {
  const TradeoffScene scene = make_tradeoff_scene("smooth", source_folder() / "benchmarks" / "meshes");
  const double h = h_omega / scene.fastest_rate;
  SolverTimes result;
  result.vertices = scene.motion.network.point_count();
  result.h_omega = h_omega;
  result.body = fmt::format("liver564, h omega_max = {:g}", h_omega);
  const StepEquations equations(scene, h);
  std::vector<TimedTask> tasks;
  for (const auto& [name, solver] :
       {std::pair("conjugate gradients", LinearSolver::conjugate_gradients),
        std::pair("fresh factor", LinearSolver::fresh_factor), std::pair("kept factor", LinearSolver::kept_factor)}) {
    ImplicitOptions options;
    options.solver = solver;
    options.conjugate_gradients.tolerance = 1e-6;
    const auto integrator = std::make_shared<BaraffWitkin>(options);
    const auto stage = std::make_shared<SceneStage>(scene);
    const PointState start = scene.motion.start;
    result.tasks.emplace_back(name);
    tasks.push_back({name,
                     [stage, start] {
                       std::ranges::copy(start.x, stage->motion().x.begin());
                       std::ranges::copy(start.v, stage->motion().v.begin());
                     },
                     [stage, integrator, h] {
                       const StepResult step = integrator->step(stage->system(), stage->motion(), h);
                       if (!step.ok()) throw SolverError(to_string(step));
                     },
                     [stage] { return state_hash(stage->state()); }});
    // the second step from the start is the first that a kept factor serves
    for (int step = 0; step < 2; ++step) {
      tasks.back().restore();
      tasks.back().run();
      equations.check(tasks.back().name, stage->state().v,
                      solver == LinearSolver::fresh_factor ? 0.0 : options.conjugate_gradients.tolerance);
    }
  }
  run_rounds(tasks, {.rounds = rounds, .warmup = 3, .seed = seed},
             [&](const Sample& sample) { result.samples.push_back(sample); });
  check_repeats(result.samples);
  return result;
}

}  // namespace dartboard
