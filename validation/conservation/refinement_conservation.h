#pragma once
// Refinements among cuts and removals of a moving body, and what they must keep or change by a known amount.

#include "core/mechanics/refine.h"
#include "validation/conservation/conservation.h"

namespace dartboard {

/// Called with the body and its views after each series, for tests that plant a fault.
template <class Map>
using Tamper = std::function<void(LiveBody<Map>&, Views&)>;

/// The function that makes a body follow a subdivision: core's, or a faulty stand-in.
template <class Map>
using FollowSubdivision = std::function<ChangedEmbeddings(LiveBody<Map>&, const Subdivision&, double bracing)>;
template <class Map>
ChangedEmbeddings follow_subdivision(LiveBody<Map>& body, const Subdivision& subdivision, double bracing) {
  return adapt(body, subdivision, bracing);
}

/// Refine edges, faces and volumes of a moving body of tetrahedra at random, with dissociations, torn fans and removals
/// in between, until it has twice its cells; then take it apart until nothing is left; then again with a fresh one.
///
/// The witness is SubdividedCells, which knows the rule of refinement and no dart. After each operation or series of
/// them it checks masses and springs of all that changed, and the conserved sums. Now and then, and always once the
/// body is small, everything, and all views against rebuilt ones. In a refinement of a cell with s vertices, M the mass
/// of the tetrahedra around it, (x_i, v_i) the states of the vertices and (x, v) their mean:
///
///     mass, linear momentum, area          unchanged
///     stiffness, damping, elastic energy   more by the bracing; the halves of an edge have four times its stiffness
///     angular momentum                     less M / (4 s) sum (x_i - x) x (v_i - v)
///     kinetic energy                       less M / (8 s) sum |v_i - v|^2
///     forces                               unchanged without bracing, in any deformation, and none on the vertex put
///     in
///
/// because each of the s vertices gives the s-th part of M / 4 away, and the new vertex gets all of these.
/// A body from scratch has no refined cells, so the rebuild oracle is left to validate_conservation.
///
/// `oracle_every` and `oracle_steps` of the plan are not used.
/// throws  InputError if the mesh has other cells than tetrahedra, or is one that build_body refuses
template <class Map>
ConservationResult validate_refinement(const Problem& start, const ConservationPlan& plan,
                                       const Tamper<Map>& tamper = {},
                                       const FollowSubdivision<Map>& followed = follow_subdivision<Map>);

extern template ConservationResult validate_refinement(const Problem&, const ConservationPlan&, const Tamper<Map3>&,
                                                       const FollowSubdivision<Map3>&);
extern template ConservationResult validate_refinement(const Problem&, const ConservationPlan&, const Tamper<TetMap>&,
                                                       const FollowSubdivision<TetMap>&);

}  // namespace dartboard
