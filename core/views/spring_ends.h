#pragma once
// The two ends of every spring, by edge number: all that a force loop needs to know of the topology.

#include <cstdint>
#include <vector>

#include "core/forces/springs.h"
#include "core/mechanics/adapt.h"

namespace dartboard {

/// The ends of every edge: the vertices at its lowest dart and across alpha_0. Eight bytes per edge, in one stream.
class SpringEndsView {
 public:
  std::vector<SpringEnds> ends;
  friend bool operator==(const SpringEndsView&, const SpringEndsView&) = default;

  /// cost    O(edges)
  template <class Body>
  void rebuild(const Body& body) {
    ends.resize(body.edge_dart.size());
    for (std::uint32_t k = 0; k < ends.size(); ++k) ends[k] = ends_of(body, k);
  }

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(changed edges), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    ends.resize(changed.edge_count);
    for (const std::uint32_t k : changed.edges) ends[k] = ends_of(body, k);
  }

  template <class Archive>
  void state(Archive& archive) {
    archive(ends);
  }
  std::size_t bytes() const { return sizeof(SpringEnds) * ends.capacity(); }

 private:
  template <class Body>
  static SpringEnds ends_of(const Body& body, std::uint32_t k) {
    const Dart d = body.edge_dart[k];
    return {body.vertex(body.map, d), body.vertex(body.map, body.map.template alpha<0>(d))};
  }
};

}  // namespace dartboard
