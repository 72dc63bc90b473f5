#pragma once
// Loss of connectivity: "the mechanical model can be split in two parts to compute the behavior of the two resulting
// bodies separately" (the paper's conclusion).

#include "core/mechanics/adapt.h"

namespace dartboard {

/// A component that became a body of its own, and the change of the body that it left.
template <class Map>
struct SplitOff {
  MassSpringBody<Map, Held::by_every_dart> part;
  TopologyChange change;      // of the body it left
  ChangedEmbeddings changed;  // of the same body, which has been adapted
};

/// Take the component of `d` out of a body and make it a body of its own, with the columns it had.
///
/// Embeddings of the part keep their order, so it moves, bit for bit, as it would have within the body. Masses, momenta
/// and energies of the two sum to those of the whole, because no spring joins components.
///
/// pre     every dart holds the embedding numbers
/// throws  TopologyError if d is dead; nothing has changed then
/// cost    O(darts of the component), whatever the size of the rest: take out the smaller part
/// source  the paper's conclusion
template <class Map>
SplitOff<Map> split_off(MassSpringBody<Map, Held::by_every_dart>& body, Dart d);

extern template SplitOff<Map2> split_off(MassSpringBody<Map2, Held::by_every_dart>&, Dart);
extern template SplitOff<Map3> split_off(MassSpringBody<Map3, Held::by_every_dart>&, Dart);
extern template SplitOff<TetMap> split_off(MassSpringBody<TetMap, Held::by_every_dart>&, Dart);

}  // namespace dartboard
