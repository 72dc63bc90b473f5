#pragma once
// A Cholesky factor that follows thousands of edits of a body: its error, and the cost of keeping it accurate.

#include <string>
#include <vector>

#include "core/time/solve/cholesky.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {

/// The way in which the factor follows.
struct EditPolicy {
  std::string name;
  CholeskyOptions options;
  bool refine = false;  // one step of refinement in each solution
};
/// The policies that are compared: updates that are never renewed, by terms and by rows, renewed after several numbers
/// of rank-one updates, and refinement.
std::vector<EditPolicy> edit_policies();

struct EditRun {
  std::string policy;
  double stretch = 0.0;
  std::size_t edits = 0;
  CholeskyCounters counters;
  double largest = 0.0, last = 0.0;  // normwise backward error of solutions, after every 20th edit
  double componentwise = 0.0;        // the largest
  double follow_s = 0.0;             // seconds for an edit, mean
  double solve_s = 0.0;              // seconds for a solution, mean
  std::string failure;               // empty when all went well
};

/// Edits in pairs, there and back: a spring removed and put back, or an interior vertex dissociated and joined again,
/// in turn. `side`^3 vertices, h omega_max = 20.
EditRun run_edits(const EditPolicy& policy, int side, double stretch, std::size_t edits, const CpuClock& clock);

}  // namespace dartboard
