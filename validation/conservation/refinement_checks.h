#pragma once
// Comparisons of a refined body.

#include "validation/conservation/conservation_checks.h"

namespace dartboard {

/// For a body that is refined and taken apart: within the roundings of the rule of refinement.
template <class Map>
class RefinementChecks : public OperationChecks<RefinedSubject<Map>> {
 public:
  using OperationChecks<RefinedSubject<Map>>::OperationChecks;

 private:
  using Base = OperationChecks<RefinedSubject<Map>>;
  using Base::at_, Base::ledger_, Base::most_cells_;

  void vertex(std::uint32_t k, SubdividedCells::Corner first) override;
  void edge(std::uint32_t k, SubdividedCells::EdgeOfCell first) override;
  void cell(std::uint32_t c) override;
  // stiffness is a sum over cells, not a product: one more rounding for each cell
  std::size_t more_roundings() const override { return most_cells_; }
};

extern template class RefinementChecks<Map3>;
extern template class RefinementChecks<TetMap>;

}  // namespace dartboard
