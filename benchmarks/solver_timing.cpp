#include "benchmarks/solver_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "core/plain/error.h"
#include "core/time/accelerations.h"
#include "core/time/baraff_witkin.h"
#include "validation/scene_stage.h"
#include "validation/solver_bodies.h"

namespace dartboard {
namespace {

void require(SolveStatus status) {
  if (status != SolveStatus::ok)
    throw SolverError(fmt::format("a factorisation that is timed ended: {}", to_string(status)));
}

// One contender: a factor of the whole body, and what it does when a vertex is dissociated.
struct FactorTask {
  std::string name;
  CholeskyOptions options;
  bool again = false;
  std::optional<Cholesky> cholesky;
  StepMatrix followed;
  std::size_t pair = 0;  // which dissociation comes next
};

}  // namespace

Figure SolverTimes::ratio(const std::string& task, const std::string& baseline) const {
  std::map<int, double> above, below;
  for (const Sample& s : samples) {
    if (s.task == task) above[s.round] = static_cast<double>(s.cpu_ns);
    if (s.task == baseline) below[s.round] = static_cast<double>(s.cpu_ns);
  }
  std::vector<double> ratios;
  for (const auto& [round, ns] : above) ratios.push_back(ns / below.at(round));
  return {median(ratios), median_interval(ratios)};
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
                       result.terms = terms.size();
                     },
                     [] { return std::uint64_t{0}; }});
  }
  run_rounds(tasks, {.rounds = rounds, .warmup = 1, .seed = seed},
             [&](const Sample& sample) { result.samples.push_back(sample); });
  result.rows = factors.front()->cholesky->counters().rows_replaced;
  return result;
}

SolverTimes time_implicit_step(double h_omega, int rounds, std::uint64_t seed) {
  const TradeoffScene scene =
      make_tradeoff_scene("smooth", std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes");
  const double h = h_omega / scene.fastest_rate;
  SolverTimes result;
  result.vertices = scene.motion.network.point_count();
  result.h_omega = h_omega;
  result.body = fmt::format("liver564, h omega_max = {:g}", h_omega);
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
                     [] { return std::uint64_t{0}; }});
  }
  run_rounds(tasks, {.rounds = rounds, .warmup = 3, .seed = seed},
             [&](const Sample& sample) { result.samples.push_back(sample); });
  return result;
}

}  // namespace dartboard
