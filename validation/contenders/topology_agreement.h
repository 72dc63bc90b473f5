#pragma once
// The first gate: our map of a mesh has the same numbers of cells as CGAL's.

#include <string>
#include <vector>

#include "core/plain/problem.h"
#include "core/topology/summary.h"
#include "reference/cgal/cgal_body.h"

namespace dartboard {

struct CountAgreement {
  std::string what;  // "darts", "vertices" ...
  std::size_t ours = 0, cgal = 0;
  bool agrees() const { return ours == cgal; }
};

/// The quantities counted, by name, with both answers.
std::vector<CountAgreement> set_side_by_side(const MapSummary& ours, const reference::CgalCounts& cgal);

/// Darts, i-cells and components of the problem's mesh, counted by coverages of our map and by CGAL of its own.
std::vector<CountAgreement> compare_counts(const Problem& problem);

}  // namespace dartboard
