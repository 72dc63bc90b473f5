#pragma once
// The first gate: our map of a mesh has the cells that CGAL counts in its own.

#include <string>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard {

struct CountAgreement {
  std::string what;  // "darts", "vertices" ...
  std::size_t ours = 0, cgal = 0;
  bool agrees() const { return ours == cgal; }
};

/// Darts, i-cells and components of the problem's mesh, counted by coverages of our map and by CGAL of its own.
std::vector<CountAgreement> compare_counts(const Problem& problem);

}  // namespace dartboard
