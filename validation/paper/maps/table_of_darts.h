#pragma once
// Fig. 5 and its table: a subdivision with three faces and its 2-g-map, as printed.

#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// The 2-g-map of Fig. 5, its dart k the paper's dart k + 1. The table gives the links of the first ten darts and the
/// text three cells; the others, which only the figure shows, are linked to the remaining ones.
Map2 map_of_fig_5();

/// Whether it is a 2-g-map with the table's links and with the cells that the text names: vertex <alpha_1, alpha_2>(2),
/// edge <alpha_0, alpha_2>(3) and face <alpha_0, alpha_1>(9).
ClaimAnswer is_fig_5(const Map2& map);

}  // namespace dartboard
