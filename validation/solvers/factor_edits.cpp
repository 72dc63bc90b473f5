#include "validation/solvers/factor_edits.h"

#include <cmath>
#include <limits>

#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "core/time/solve/backward_error.h"
#include "core/time/system/accelerations.h"
#include "validation/solvers/solver_bodies.h"

namespace dartboard {
namespace {

constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

// Rates that leave the rule no choice.
EditPolicy policy(std::string name, std::uint32_t renew_after, bool by_terms, bool by_rows, bool refine = false) {
  constexpr double far_too_slow = 1e9;
  CholeskyOptions options{.spare_nodes = 1, .renew_after = renew_after, .ready_for_updates = true};
  if (!by_terms) options.rates.update_flop = far_too_slow;
  if (!by_rows) options.rates.row_flop = far_too_slow;
  if (by_terms != by_rows) options.rates.supernodal_flop = options.rates.simplicial_flop = 1.0;
  return {std::move(name), options, refine};
}

}  // namespace

std::vector<EditPolicy> edit_policies() {
  const std::uint32_t now = CholeskyOptions{}.renew_after;
  return {policy("by terms, never renewed", never, true, false),
          policy("by rows and terms, never renewed", never, true, true), policy("renewed after 500", 500, true, true),
          policy("as by default", now, true, true), policy("never renewed, one refinement", never, true, true, true)};
}

EditRun run_edits(const EditPolicy& policy, int side, double stretch, std::size_t edits, const CpuClock& clock) {
  EditRun run;
  run.policy = policy.name;
  run.stretch = stretch;
  const DissociationPairs pairs = dissociation_pairs(side, stretch, 40);
  const double tau = 20.0 / frequency_bound(pairs.whole.system());
  const SolverMatrix whole(pairs.whole, Compression::projected, tau);
  Cholesky cholesky(policy.options);
  SolveStatus status = cholesky.factorise(whole.blocks);
  StepMatrix followed = whole.step;
  SplitMix64 random(11);
  std::int64_t follow_ns = 0, solve_ns = 0;
  std::size_t solutions = 0;

  const auto follow = [&](const SpringColumns& columns) {
    const SolverMatrix after(columns, Compression::projected, tau);
    const std::int64_t start = clock();
    const auto terms = followed.follow(columns.system(), after.tangents, cholesky.spare_diagonal());
    status = cholesky.follow(after.blocks, terms);
    follow_ns += clock() - start;
    ++run.edits;
    if (status != SolveStatus::ok || run.edits % 20 > 1) return;
    const auto b = drawn_vectors(after.blocks.node_count(), run.edits);
    auto x = b;
    const std::int64_t solve_start = clock();
    status = policy.refine ? cholesky.solve_refined(after.blocks, b, x) : cholesky.solve(b, x);
    solve_ns += clock() - solve_start;
    ++solutions;
    run.last = normwise_backward_error(after.blocks, b, x);
    run.largest = max_or_nan(run.largest, run.last);
    run.componentwise = max_or_nan(run.componentwise, backward_error(after.blocks, b, x));
  };
  while (run.edits < edits && status == SolveStatus::ok) {
    if (run.edits % 4 == 0) {
      SpringColumns without = pairs.whole;
      without.springs[random.below(without.springs.size())].stiffness = 0.0;
      follow(without);
    } else {
      follow(pairs.torn[random.below(pairs.torn.size())]);
    }
    if (status == SolveStatus::ok) follow(pairs.whole);
  }
  if (status != SolveStatus::ok) run.failure = to_string(status);
  run.counters = cholesky.counters();
  run.follow_s = 1e-9 * static_cast<double>(follow_ns) / static_cast<double>(run.edits);
  run.solve_s = 1e-9 * static_cast<double>(solve_ns) / static_cast<double>(std::max<std::size_t>(solutions, 1));
  return run;
}

}  // namespace dartboard
