#pragma once
// A loose component becomes a body of its own: what it takes along, and whether its motion is unchanged.

#include <cstdint>

#include "validation/conservation/conservation_ledger.h"
#include "validation/conservation/subjects.h"

namespace dartboard {

/// Split the component of a cell off a body, compare, and drop it; the rest and its views have followed.
///
/// Part and rest must have the cells, vertices and springs that the witness and the body predict. All their embeddings
/// keep their bits, so the conserved sums of the two and of the whole have exactly the same terms, and differ by the
/// rounding of twofold sums: gamma_4 of the absolute values (conserved_sums.h). Some steps of the part must give the
/// bits of the same steps of the whole.
/// pre  `leaving` are all cells of one component that are still there in the witness
template <class Map>
void split_off_and_compare(Subject<Map>& at, std::span<const std::uint32_t> leaving, ConservationLedger& ledger);

extern template void split_off_and_compare(Subject<Map2>&, std::span<const std::uint32_t>, ConservationLedger&);
extern template void split_off_and_compare(Subject<Map3>&, std::span<const std::uint32_t>, ConservationLedger&);
extern template void split_off_and_compare(Subject<TetMap>&, std::span<const std::uint32_t>, ConservationLedger&);

}  // namespace dartboard
