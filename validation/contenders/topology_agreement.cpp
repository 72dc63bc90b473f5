#include "validation/contenders/topology_agreement.h"

#include "core/topology/build.h"

namespace dartboard {

std::vector<CountAgreement> set_side_by_side(const MapSummary& ours, const reference::CgalCounts& cgal) {
  return {{"darts", ours.darts, cgal.darts},        {"vertices", ours.cells[0], cgal.vertices},
          {"edges", ours.cells[1], cgal.edges},     {"faces", ours.cells[2], cgal.faces},
          {"volumes", ours.cells[3], cgal.volumes}, {"components", ours.components, cgal.components}};
}

std::vector<CountAgreement> compare_counts(const Problem& problem) {
  return set_side_by_side(summarize(build_map<Map3>(problem.mesh).map),
                          reference::CgalBody(problem, reference::CgalWalk::coverage).counts());
}

}  // namespace dartboard
