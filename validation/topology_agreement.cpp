#include "validation/topology_agreement.h"

#include "core/topology/build.h"
#include "core/topology/summary.h"
#include "reference/cgal_body.h"

namespace dartboard {

std::vector<CountAgreement> compare_counts(const Problem& problem) {
  const MapSummary ours = summarize(build_map<Map3>(problem.mesh).map);
  const auto cgal = reference::CgalBody(problem, reference::CgalWalk::coverage).counts();
  return {{"darts", ours.darts, cgal.darts},        {"vertices", ours.cells[0], cgal.vertices},
          {"edges", ours.cells[1], cgal.edges},     {"faces", ours.cells[2], cgal.faces},
          {"volumes", ours.cells[3], cgal.volumes}, {"components", ours.components, cgal.components}};
}

}  // namespace dartboard
