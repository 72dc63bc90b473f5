#pragma once
// What a refined body is compared with, and when.

#include "validation/conservation/conservation_ledger.h"
#include "validation/conservation/refinement_subject.h"

namespace dartboard {

/// The comparisons of validate_refinement, each written into the ledger.
template <class Map>
class RefinementChecks {
 public:
  RefinementChecks(const RefinedSubject<Map>& subject, ConservationLedger& ledger) : at_(subject), ledger_(ledger) {}

  /// For a fresh body.   cost    O(cells)
  void begin();
  ConservedSums all_sums() const;
  long euler() const;

  /// What an operation changed by number: against the witness.
  void changed_cells(const ChangedEmbeddings& changed);
  /// `removed` is what went away; `more` roundings in a term, `elastic` what else may be off of the energy [J].
  void sums(const ConservedSums& before, const ConservedSums& after, const ConservedSums& removed, std::size_t more,
            double elastic);
  void everything();

 private:
  void vertex(std::uint32_t k, SubdividedCells::Corner first);
  void edge(std::uint32_t k, SubdividedCells::EdgeOfCell first);
  void cell(std::uint32_t c);

  const RefinedSubject<Map>& at_;
  ConservationLedger& ledger_;
  std::size_t most_cells_ = 1;  // around a vertex, so far
};

extern template class RefinementChecks<Map3>;
extern template class RefinementChecks<TetMap>;

}  // namespace dartboard
