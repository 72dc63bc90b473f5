#include "validation/paper/other_cells.h"

#include <fmt/format.h>

#include <set>

#include "validation/paper/moves_as_reference.h"
#include "validation/paper/removals_share.h"
#include "validation/paper/shares_after_cuts.h"

namespace dartboard {

ClaimAnswer try_other_cells(const Mesh& mesh, int operations, std::uint64_t seed, const Adapt& follow) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1000.0, .stiffness = 48.0, .damping = 0.1, .viscosity = 0.5};
  const SharesAfterCuts cut = try_dissociations(problem, operations, seed, follow);
  const RemovalAnswers removed = try_removals(problem, operations / 4, seed, follow);
  const double moved = motion_beside_reference(mesh);
  const std::size_t kinds = std::set<CellKind>(mesh.kinds.begin(), mesh.kinds.end()).size();
  int hold = 0;
  for (const ClaimAnswer& answer :
       {cut.mass, cut.stiffness, cut.viscosity, cut.rest_shape, cut.state, removed.shares, removed.free_faces})
    hold += answer.holds ? 1 : 0;
  return {hold == 7 && moved <= 1.0 && kinds == 4,
          fmt::format("{} kinds of cell in {}: {} of 7 answers on cuts and removals hold; {}; motion {:.2g} of the "
                      "bound from the reference's",
                      kinds, mesh.cell_count(), hold, cut.mass.measured, moved)};
}

}  // namespace dartboard
