#pragma once
// Conservative refinement of a body: a vertex is put into an edge, a face or a tetrahedron, and embeddings follow.

#include "core/mechanics/adapt.h"
#include "core/operations/subdivide.h"

namespace dartboard {

/// Adapt the embeddings of a body to a subdivision of its map. The body may have cells of other kinds next to the
/// tetrahedra that are subdivided.
///
/// Position and velocity of the new vertex are the means over the cell's vertices, as is its rest position where that
/// is kept, and it is fixed if they all are. Each tetrahedron shares its mass equally among its children, so total
/// mass, centre of mass and linear momentum stay; spin and kinetic energy fall, as lumping at more points lowers the
/// moment of inertia. Rest lengths follow from the surrounding ones, on the rest shape.
///
/// Stiffness and damping: the contribution of a tetrahedron to an edge is shared equally by its children there, and the
/// halves of a subdivided edge are springs in series, twice as stiff each: forces on the old vertices, and elastic
/// energy, are unchanged to rounding for every affine deformation, and the new vertex is in equilibrium. The springs
/// from the new vertex to vertices across get `bracing` times the material's stiffness from each old tetrahedron.
/// No positive value keeps all affine forces: the new springs resist strain too. With bracing 0 the forces
/// are kept exactly, but only the two halves of a subdivided edge hold the new vertex: one put into a face or
/// a tetrahedron moves freely. Elements need no bracing: the rest shape of a child follows from its parent's,
/// and an affine deformation keeps all forces and the energy.
///
/// pre     every dart holds the embedding numbers, `subdivision` was just made on the body's map, bracing >= 0
/// throws  InputError if bracing is negative or not finite
/// cost    O(darts around the vertices of the touched tetrahedra); the first time O(edges of cells), for a column of
///         shares of stiffness that unrefined bodies do not have
/// source  the paper's future work
template <class Map>
ChangedEmbeddings adapt(MassSpringBody<Map, Held::by_every_dart>& body, const Subdivision& subdivision, double bracing);

/// `subdivide` the map of the body, then `adapt`.
template <int i, class Map>
ChangedEmbeddings refine(MassSpringBody<Map, Held::by_every_dart>& body, Cell<i> cell, double bracing) {
  return adapt(body, subdivide(body.map, cell), bracing);
}

extern template ChangedEmbeddings adapt(MassSpringBody<Map3, Held::by_every_dart>&, const Subdivision&, double);
extern template ChangedEmbeddings adapt(MassSpringBody<TetMap, Held::by_every_dart>&, const Subdivision&, double);

}  // namespace dartboard
