#pragma once
// The errors of solutions of linear systems, over all scales of mass, stiffness and step; and whether a matrix that is
// not positive definite is ever taken for one that is.

#include <string>
#include <string_view>
#include <vector>

#include "core/time/solve/cholesky.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// The ways to a solution that are compared.
enum class SolvePath : std::uint8_t { simplicial, supernodal, updated, conjugate_gradients };
std::string_view name(SolvePath path);
inline constexpr SolvePath solve_paths[]{SolvePath::simplicial, SolvePath::supernodal, SolvePath::updated,
                                         SolvePath::conjugate_gradients};

/// One system, solved one way. Componentwise backward errors, before and after one step of refinement with the
/// residual in extended precision.
struct SolveCell {
  std::string masses, stiffnesses, state;  // "equal" or "1e-6 .. 1e6"; "rest", "stretched", "crushed"
  double h_omega = 0.0;
  SolvePath path = SolvePath::simplicial;
  SolveStatus status = SolveStatus::ok;
  double before = 0.0, after = 0.0;
  double normwise = 0.0;     // before
  bool was_updated = false;  // of `updated`: the rule did not choose to factor again
  int iterations = 0;        // of conjugate gradients
};

struct SolveAccuracyOptions {
  int side = 6;                // vertices along an edge of the box
  double h_omega_step = 10.0;  // between 1e-3 and 1e8
  double pcg_tolerance = 1e-10;
};

/// Multiply masses by 1e-6 to 1e6 and stiffnesses by 1 to 1e14, drawn evenly on a logarithmic scale: the same for the
/// same place, and for the same rest length.
void spread_scales(SpringColumns& columns, bool masses, bool stiffnesses);

/// All combinations. Masses and stiffnesses are drawn on a logarithmic scale by place, so that parts of a dissociated
/// vertex or edge get the same; omega_max is Gershgorin's bound. The body floats: at h omega = 1e8 its inertia is at
/// the rounding of its stiffness, and a factor may fail, which it must report.
std::vector<SolveCell> solve_accuracy(const SolveAccuracyOptions& options);

/// An indefinite matrix, and the status that a path reports for it.
struct IndefiniteCell {
  std::string path;
  double h_omega = 0.0;
  double least = 0.0;  // eigenvalue, over the largest: negative
  SolveStatus status = SolveStatus::ok;
  bool diagnosed() const { return status != SolveStatus::ok; }
};

/// Matrices of crushed bodies with exact tangents whose least eigenvalue, by a dense solver, is below -1e-8 of the
/// largest: by every kind of factor, by updates that lead to them, by replaced rows, by conjugate gradients.
std::vector<IndefiniteCell> indefinite_systems();

}  // namespace dartboard
