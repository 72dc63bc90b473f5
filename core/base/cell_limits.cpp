#include "core/base/cell_limits.h"

#include <fmt/format.h>

namespace dartboard {

std::string beyond_a_map(const CountsByKind& cells) {
  double all = 0.0, darts = 0.0;
  int dimension_of_all = 2;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto kind = static_cast<CellKind>(k);
    all += cells[k];
    darts += cells[k] * static_cast<double>(darts_of(kind));
    if (cells[k] > 0.0 && dimension(kind) == 3) dimension_of_all = 3;
  }
  const double tetrahedra = cells[static_cast<std::size_t>(CellKind::tetrahedron)];
  if (all == tetrahedra) {
    if (tetrahedra <= static_cast<double>(most_tetrahedra)) return "";
    return fmt::format("{:.17g} tetrahedra, where a map numbers at most {}", tetrahedra, most_tetrahedra);
  }
  if (darts <= static_cast<double>(most_darts(dimension_of_all))) return "";
  return fmt::format("{:.17g} cells with {:.17g} darts, where a map numbers at most {}", all, darts,
                     most_darts(dimension_of_all));
}

}  // namespace dartboard
