#pragma once
// Twins of our maps that CGAL carries, in two kinds of its maps.

#include <memory>
#include <string>

#include "validation/cgal/map_twin.h"

namespace dartboard {

/// The map carried by CGAL::Generalized_map<2 or 3>, built dart by dart.
///
/// Where its verdicts differ: is_sewable<i>(a, b) is false when b lies on the line of darts of a ("folded cells", which
/// generalized maps allow and CGAL leaves out by choice), and true for a == b when i is 1. Folds are therefore linked
/// pair by pair along CGAL's own involution iterators.
std::unique_ptr<MapTwin> make_cgal_gmap_twin(const AlphaList& alphas);

/// The map carried by CGAL::Combinatorial_map<2 or 3>: one dart per positive dart of a 2-colouring, beta_i = alpha_i
/// after alpha_0, and null for free. Null, with the reason in `why_not`, for a map that has none: 0- or 1-free darts,
/// non-orientable, or folded (beta_i would fix a dart).
///
/// It walks the orbits of sets that contain alpha_0, and vertices; operations that would leave the class are not
/// carried: any but i-sews, 2 <= i, of darts of opposite colours.
std::unique_ptr<MapTwin> make_cgal_cmap_twin(const AlphaList& alphas, std::string* why_not);

/// Whether a twin made by one of the two functions above, after all it lived through, is isomorphic to the fresh one
/// that CGAL makes of `alphas`: by are_cc_isomorphic, component by component, from equally named darts.
/// (is_isomorphic_to looks at one component only and would accept any relabelling.)
bool are_isomorphic(const MapTwin& cgal_twin, const AlphaList& alphas);

}  // namespace dartboard
