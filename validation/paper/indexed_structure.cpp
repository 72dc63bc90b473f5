#include "validation/paper/indexed_structure.h"

#include <fmt/format.h>

#include <array>

#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "validation/conservation/conservation_checks.h"

namespace dartboard {

ClaimAnswer translate_operations(const Problem& problem, int operations, std::uint64_t seed,
                                 const Follow<Map3>& translate) {
  CutSubject s(problem);
  ConservationResult result;
  ConservationLedger ledger(
      result, seed,
      std::array{Check::counts, Check::euler, Check::valid, Check::mass_of_vertex, Check::spring_of_edge, Check::ends});
  ConservationChecks<Map3> checks(s, ledger);
  SplitMix64 random(seed);
  int done = 0, removed = 0;
  for (; done < operations; ++done) {
    const auto side = s.cells.joined_side(random);
    if (!side) break;
    if (done % 8 == 7) {
      translate(s.body, s.views, remove_volume(s.body.map, s.places.side[*side]));
      s.cells.remove(s.cell_of_side(*side));
      ++removed;
    } else {
      translate(s.body, s.views, dissociate_face(s.body.map, s.places.side[*side]));
      s.cells.dissociate(*side);
    }
    checks.all_cells();
    if (result.violation) return {false, fmt::format("operation {}: {}", done, result.violation->what)};
  }
  return {removed > 0, fmt::format("{} dissociations and {} removals translated, the arrays right after each",
                                   done - removed, removed)};
}

}  // namespace dartboard
