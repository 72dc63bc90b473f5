#include "core/time/system/coordinate_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace dartboard {

std::string to_string(const CoordinatePrecision& found) {
  return fmt::format(
      "coordinate {} = {:.6g} m of vertex {} is rounded by up to {:.2g} of the {} next to it ({:.4g} m); move the "
      "body to the origin",
      "xyz"[found.axis], found.coordinate, found.vertex, found.relative,
      found.edge == CoordinatePrecision::of_element ? "shortest edge of an element" : "spring", found.length);
}

namespace {

/// The worst place so far.
struct Search {
  std::span<const Eigen::Vector3d> x;
  double bound;
  std::optional<CoordinatePrecision> found{};

  /// From vertex i to vertex j.
  void look_at(std::uint32_t edge, std::uint32_t i, std::uint32_t j, double length) {
    const double from_i = x[i].norm(), from_j = x[j].norm();
    const double relative = std::numeric_limits<double>::epsilon() * std::max(from_i, from_j) / length;
    if (!(length > 0.0 && relative > bound)) return;
    bound = relative;
    const std::uint32_t far = from_i > from_j ? i : j;
    Eigen::Index axis = 0;
    x[far].cwiseAbs().maxCoeff(&axis);
    found = {edge, far, static_cast<int>(axis), x[far][axis], length, relative};
  }
};

// Between any two vertices of a piece, diagonals too: where rounding is coarse for a diagonal, it is coarse for the
// shorter edges next to it.
void look_at_pieces(const SpringSystem& system, Search& search) {
  std::vector<std::uint8_t> has_spring(system.vertex_count(), 0);
  for (const auto& [i, j] : system.ends) has_spring[i] = has_spring[j] = 1;
  for (const ForceTerm* term : system.terms)
    for (std::size_t piece = 0; piece < term->size() && term->is_within_cells(); ++piece) {
      const ForceTerm::Nodes nodes = term->nodes(piece);
      if (std::ranges::all_of(nodes, [&](std::uint32_t i) { return has_spring[i] != 0; })) continue;
      for (std::size_t a = 1; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          search.look_at(CoordinatePrecision::of_element, nodes[b], nodes[a],
                         (search.x[nodes[a]] - search.x[nodes[b]]).norm());
    }
}

}  // namespace

std::optional<CoordinatePrecision> find_coarse_coordinate(const SpringSystem& system,
                                                          std::span<const Eigen::Vector3d> x, double bound) {
  Search search{x, bound};
  for (std::uint32_t s = 0; s < system.springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    search.look_at(s, i, j, std::max((x[j] - x[i]).norm(), system.springs[s].rest_length));
  }
  if (!system.terms.empty()) look_at_pieces(system, search);
  return search.found;
}

}  // namespace dartboard
