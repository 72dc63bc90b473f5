#include "benchmarks/paper/paper_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/plain/error.h"

namespace dartboard {

std::span<const PaperClaim> paper_claims() {
  static const std::array<PaperClaim, 16> table{{
      {"graphs-ambiguous", "two bodies that are topologically different can have the same adjacency graph", "1",
       "possible"},
      {"non-manifold-refused", "the non-manifold objects of Fig. 2 cannot be represented", "1", "impossible"},
      {"class-closed", "operations cannot leave the class of objects in which a face joins at most two volumes", "1, 2",
       "never"},
      {"combinatorial-export", "a generalized map can be exported to a combinatorial map of half the size", "2",
       "known method"},
      {"map-valid", "the body's map satisfies the three conditions of a 3-g-map", "2.1", "valid"},
      {"cells-partition", "the i-cells partition the darts, for each i", "2.1", "each dart in 1 cell per i"},
      {"mass-sum", "the masses of the vertices, eq. (1), sum up to the masses of the tetrahedra", "4.3", "equal"},
      {"stiffness-sum", "the stiffness of the edges is what their tetrahedra contribute, 6 k each", "4.3", "equal"},
      {"body-size", "the body has 564 nodes, 2850 springs and 1856 tetrahedra", "5.1", "564 / 2850 / 1856"},
      {"dart-count", "its map has 44544 darts, 24 per tetrahedron", "5.1", "44544"},
      {"coverage-slower", "full dart coverage costs more than the adjacency graph", "5.1", "6 (12 ms / 2 ms)",
       About::times},
      {"lists-faster", "lists of embeddings cost less than full dart coverage", "5.2", "0.67 (8 ms / 12 ms)",
       About::times},
      {"arrays-overhead", "cell arrays cost at most 10 % more than the adjacency graph", "5.2", "<= 1.10",
       About::times},
      {"arrays-step", "a step over cell arrays takes no more than the paper's 2 ms", "5.2", "2 ms", About::times},
      {"paper-ladder", "coverage : lists : arrays : graph cost 6 : 4 : 1 : 1", "5", "6 : 4 : 1 : 1", About::times,
       "contiguous arrays have gained more from processors since 2010 than walks through links, each of "
       "which waits for the one before"},
      {"rebuild-negligible", "rebuilding the arrays is negligible beside the topological changes", "5.2", "negligible",
       About::times, "rebuilding covers every dart, while a removal has come down to microseconds"},
  }};
  return table;
}

namespace {

const PaperClaim& row_of(std::string_view id) {
  const auto all = paper_claims();
  const auto found = std::find_if(all.begin(), all.end(), [&](const PaperClaim& c) { return c.id == id; });
  if (found == all.end()) throw InputError(fmt::format("no claim is called '{}'", id));
  return *found;
}

}  // namespace

Claim claim_of(std::string_view id) {
  const PaperClaim& row = row_of(id);
  return {.id = row.id,
          .text = row.text,
          .section = row.section,
          .paper_value = row.paper_value,
          .expected = row.does_not_carry_over.empty() ? Verdict::holds : Verdict::does_not_carry_over};
}

Claim answered(std::string_view id, Met met, std::string measured, std::string bound_or_interval) {
  const PaperClaim& row = row_of(id);
  Claim claim = claim_of(id);
  claim.measured = std::move(measured);
  claim.bound_or_interval = std::move(bound_or_interval);
  judge(claim, met);
  if (claim.verdict == Verdict::falls_short && row.about == About::times) {
    claim.verdict = Verdict::does_not_carry_over;
    claim.reason = row.does_not_carry_over;
  }
  return claim;
}

}  // namespace dartboard
