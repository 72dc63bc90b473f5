#include "validation/solvers/solver_accuracy.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/plain/eigenvalues.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "core/time/solve/backward_error.h"
#include "core/time/solve/conjugate_gradients.h"
#include "core/time/system/accelerations.h"
#include "validation/solvers/solver_bodies.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// A number from `low` to `high`, evenly on a logarithmic scale; the same for the same bits of `key`.
double drawn(double key, double low, double high) {
  SplitMix64 random(std::bit_cast<std::uint64_t>(key));
  return low * std::pow(high / low, 0.5 + 0.5 * random.next_signed());
}

struct System {
  SpringColumns whole, torn;
  double tau = 0.0;
};

SolveCell solve_factored(SolveCell cell, Cholesky& cholesky, const BlockMatrix& matrix) {
  if (cell.status != SolveStatus::ok) return cell;
  const auto b = drawn_vectors(matrix.node_count(), 3);
  auto x = b;
  cell.status = cholesky.solve(b, x);
  if (cell.status != SolveStatus::ok) return cell;
  cell.before = backward_error(matrix, b, x);
  cell.normwise = normwise_backward_error(matrix, b, x);
  cell.status = cholesky.solve_refined(matrix, b, x);
  if (cell.status == SolveStatus::ok) cell.after = backward_error(matrix, b, x);
  return cell;
}

SolveCell solve_iteratively(SolveCell cell, const BlockMatrix& matrix, double tolerance) {
  const auto b = drawn_vectors(matrix.node_count(), 3);
  std::vector<Vector3d> x(b.size(), Vector3d::Zero()), more = x;
  ConjugateGradients solver;
  const ConjugateGradientsOptions options{.tolerance = tolerance, .max_iterations = 4000};
  const auto result = solver.solve(matrix, b, x, options);
  cell.status = result.status;
  cell.iterations = result.iterations;
  if (cell.status != SolveStatus::ok) return cell;
  cell.before = backward_error(matrix, b, x);
  cell.normwise = normwise_backward_error(matrix, b, x);
  std::vector<Vector3d> left;
  for (const ExtendedVector& r : extended_residual(matrix, b, x)) left.push_back(r.cast<double>());
  // the sum shows the effect of a correction, whether or not the correction itself met the tolerance
  (void)solver.solve(matrix, left, more, options);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += more[i];
  cell.after = backward_error(matrix, b, x);
  return cell;
}

SolveCell solve_cell(SolveCell cell, const System& system, Compression compression, double tolerance) {
  const SolverMatrix after(system.torn, compression, system.tau);
  if (cell.path == SolvePath::conjugate_gradients) return solve_iteratively(cell, after.blocks, tolerance);
  if (cell.path == SolvePath::updated) {
    CholeskyOptions options{.spare_nodes = 1, .ready_for_updates = true};
    // on a body this small a new factor is always cheaper: leave that to cancellation alone
    options.rates.supernodal_flop = options.rates.simplicial_flop = 1.0;
    Cholesky cholesky(options);
    SolverMatrix before(system.whole, compression, system.tau);
    cell.status = cholesky.factorise(before.blocks);
    if (cell.status == SolveStatus::ok) {
      const auto terms = before.step.follow(system.torn.system(), after.tangents, cholesky.spare_diagonal());
      cell.status = cholesky.follow(after.blocks, terms);
      cell.was_updated = cholesky.counters().factorisations == 1;
    }
    return solve_factored(cell, cholesky, after.blocks);
  }
  Cholesky cholesky({.kind = cell.path == SolvePath::simplicial ? FactorKind::simplicial : FactorKind::supernodal});
  cell.status = cholesky.factorise(after.blocks);
  return solve_factored(cell, cholesky, after.blocks);
}

// Least over largest eigenvalue, of the dense matrix.
double definiteness(const BlockMatrix& m) {
  const auto n = static_cast<Eigen::Index>(3 * m.node_count());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t j = 0; j < m.node_count(); ++j) {
    const auto c = static_cast<Eigen::Index>(3 * j);
    dense.block<3, 3>(c, c) = m.diagonal[j];
    for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k)
      dense.block<3, 3>(3 * static_cast<Eigen::Index>(m.pattern.row[k]), c) = m.below[k];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense, Eigen::EigenvaluesOnly);  // of the lower triangle
  const auto& values = solver.eigenvalues();
  return values[0] / std::max(std::abs(values[0]), values[n - 1]);
}

// The terms from the projected matrix to the exact one: what compressed springs subtract across their directions.
std::vector<RankOneTerm> terms_to_exact(const SpringColumns& columns, const SolverMatrix& exact,
                                        const SolverMatrix& projected, double tau) {
  std::vector<RankOneTerm> terms;
  for (std::size_t e = 0; e < columns.springs.size(); ++e) {
    const SpringTangent &t = exact.tangents[e], &u = projected.tangents[e];
    const double change = tau * tau * (t.across - u.across);
    if (change == 0.0) continue;
    const Vector3d first = t.direction.unitOrthogonal();
    for (const Vector3d& across : {first, Vector3d(t.direction.cross(first))})
      terms.push_back({columns.ends[e][0], columns.ends[e][1], across, change});
  }
  return terms;
}

}  // namespace

void spread_scales(SpringColumns& columns, bool masses, bool stiffnesses) {
  if (masses)
    for (std::size_t i = 0; i < columns.mass.size(); ++i)
      columns.set_mass(i, columns.mass[i] * drawn(columns.x[i].x(), 1e-6, 1e6));
  if (stiffnesses)
    for (Spring& s : columns.springs) s.stiffness *= drawn(s.rest_length, 1.0, 1e14);
}

std::string_view name(SolvePath path) {
  switch (path) {
    case SolvePath::simplicial: return "simplicial";
    case SolvePath::supernodal: return "supernodal";
    case SolvePath::updated: return "updated";
    case SolvePath::conjugate_gradients: return "conjugate gradients";
  }
  return "?";
}

std::vector<SolveCell> solve_accuracy(const SolveAccuracyOptions& options) {
  std::vector<SolveCell> cells;
  for (const std::string_view state : {"rest", "stretched", "crushed"}) {
    const double stretch = state == "stretched" ? 0.3 : state == "crushed" ? -0.3 : 0.0;
    const DissociationPairs pairs = dissociation_pairs(options.side, stretch, 1);
    for (const bool masses : {false, true})
      for (const bool stiffnesses : {false, true}) {
        System system{pairs.whole, pairs.torn.at(0)};
        spread_scales(system.whole, masses, stiffnesses);
        spread_scales(system.torn, masses, stiffnesses);
        const double omega = frequency_bound(system.torn.system());
        for (double h_omega = 1e-3; h_omega < 1.001e8; h_omega *= options.h_omega_step) {
          system.tau = h_omega / omega;
          for (const SolvePath path : solve_paths) {
            SolveCell cell;
            cell.masses = masses ? "1e-6 .. 1e6" : "equal";
            cell.stiffnesses = stiffnesses ? "1 .. 1e14" : "equal";
            cell.state = state;
            cell.h_omega = h_omega;
            cell.path = path;
            cells.push_back(solve_cell(cell, system, Compression::projected, options.pcg_tolerance));
          }
        }
      }
  }
  return cells;
}

std::vector<IndefiniteCell> indefinite_systems() {
  std::vector<IndefiniteCell> cells;
  for (const double crush : {-0.3, -0.6})
    for (const bool spread_out : {false, true}) {
      DissociationPairs pairs = dissociation_pairs(4, crush, 1);
      SpringColumns& columns = pairs.whole;
      spread_scales(columns, spread_out, spread_out);
      const double omega = frequency_bound(columns.system());
      for (double h_omega = 1.0; h_omega < 1.001e8; h_omega *= 10.0) {
        const double tau = h_omega / omega;
        const SolverMatrix exact(columns, Compression::exact, tau), projected(columns, Compression::projected, tau);
        const double least = definiteness(exact.blocks);
        if (!(least < -1e-8)) continue;
        const auto add = [&](std::string path, SolveStatus status) {
          cells.push_back({std::move(path), h_omega, least, status});
        };
        const auto b = drawn_vectors(exact.blocks.node_count(), 5);
        auto x = b;
        for (const auto& [label, kind] :
             {std::pair("simplicial", FactorKind::simplicial), std::pair("supernodal", FactorKind::supernodal)}) {
          Cholesky cholesky({.kind = kind});
          SolveStatus status = cholesky.factorise(exact.blocks);
          if (status == SolveStatus::ok) status = cholesky.solve(b, x);
          add(label, status);
        }
        const auto terms = terms_to_exact(columns, exact, projected, tau);
        for (const bool rule : {false, true}) {
          Cholesky cholesky({.kind = FactorKind::simplicial});
          if (cholesky.factorise(projected.blocks) != SolveStatus::ok) continue;  // at the rounding of its stiffness
          add(rule ? "updated, by the rule" : "updated",
              rule ? cholesky.follow(exact.blocks, terms) : cholesky.update(terms));
        }
        ConjugateGradients iterative;
        std::ranges::fill(x, Vector3d(0, 0, 0));
        add("conjugate gradients",
            iterative.solve(exact.step, b, x, {.tolerance = 1e-6, .max_iterations = 4000}).status);
        Cholesky kept;
        if (kept.factorise(projected.blocks) == SolveStatus::ok)
          add("conjugate gradients, kept factor",
              iterative.solve(exact.step, kept, b, x, {.tolerance = 1e-6, .max_iterations = 4000}).status);
      }
    }
  return cells;
}

}  // namespace dartboard
