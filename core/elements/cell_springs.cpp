#include "core/elements/cell_springs.h"

#include "core/elements/spring_pieces.h"
#include "core/forces/rows_of_part.h"

namespace dartboard {
namespace {

/// f(PieceSpring) for every diagonal of a cell.
template <class F>
void for_each_diagonal(const CellSprings& springs, const F& f) {
  const double* rest = springs.rest_length.data();
  for (const CornerSpring& s : diagonals_of(springs.kind, springs.which)) {
    const double length = *rest++;
    f(PieceSpring{static_cast<std::size_t>(s.a), static_cast<std::size_t>(s.b), length,
                  springs.elastic ? s.weight * springs.modulus / (length * length) : springs.modulus});
  }
}

class CellPieces {
 public:
  explicit CellPieces(const CellSpringColumns& columns) : columns_(columns) {}
  static std::string_view name() { return "cells with diagonals"; }
  std::size_t size() const { return columns_.springs.size(); }
  ForceTerm::Nodes nodes(std::size_t c) const {
    const SolidNodes& n = columns_.nodes[c];
    return {n.at.data(), diagonals_of(columns_.springs[c].kind, columns_.springs[c].which).empty() ? 0 : n.count};
  }
  template <class F>
  void for_each(std::size_t c, const F& f) const {
    for_each_diagonal(columns_.springs[c], f);
  }
  TermOfPart of_part(const std::vector<std::uint32_t>& pieces, const VertexSubset& part) const {
    struct Columns {
      std::vector<SolidNodes> nodes;
      std::vector<CellSprings> springs;
    };
    const auto own = std::make_shared<Columns>(
        Columns{rows_of_part(columns_.nodes, pieces, part, [](SolidNodes& nodes) { return nodes.corners(); }),
                rows_of_part(columns_.springs, pieces)});
    return {own, make_cell_springs({own->nodes, own->springs})};
  }

 private:
  CellSpringColumns columns_;
};

}  // namespace

CellSprings cell_springs_of(CellKind kind, Diagonals which, bool elastic, double modulus,
                            std::span<const Eigen::Vector3d> x) {
  CellSprings springs{.kind = kind, .which = which, .elastic = elastic, .modulus = modulus};
  std::size_t k = 0;
  for (const CornerSpring& s : diagonals_of(kind, which))
    springs.rest_length[k++] = (x[static_cast<std::size_t>(s.b)] - x[static_cast<std::size_t>(s.a)]).norm();
  return springs;
}

std::unique_ptr<ForceTerm> make_cell_springs(const CellSpringColumns& columns) {
  return std::make_unique<SpringPieces<CellPieces>>(CellPieces(columns));
}

Virial cell_springs_virial(const CellSprings& springs, std::span<const Eigen::Vector3d> x) {
  std::vector<SolidNodes> nodes(1);
  for (; nodes[0].count < x.size(); ++nodes[0].count) nodes[0].at[nodes[0].count] = nodes[0].count;
  const std::vector<CellSprings> one{springs};
  return SpringPieces<CellPieces>(CellPieces({nodes, one})).virial(x, 0);
}

}  // namespace dartboard
