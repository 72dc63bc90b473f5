#pragma once
// A body on a map as its events see it.

#include <cstdint>
#include <span>

#include "core/forces/force_term.h"
#include "core/forces/springs.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/operations/subdivide.h"
#include "core/operations/topology_change.h"

namespace dartboard {

/// Events operate on its map, and it follows what they report.
template <class Map>
class ChangingBody {
 public:
  using Body = MassSpringBody<Map, Held::by_every_dart>;

  virtual Body& body() = 0;
  virtual const Body& body() const = 0;
  virtual std::span<const SpringEnds> ends() const = 0;
  /// For each cell its number in the mesh.
  virtual std::span<const std::uint32_t> mesh_cell() const = 0;
  virtual CornerRows corners() const = 0;
  virtual ForceTerms terms() const = 0;

  /// Let embeddings and views follow a change of the map.
  virtual void follow(const TopologyChange& change) = 0;
  /// Let them follow a subdivision of tetrahedra.
  /// pre  the map is of a solid
  virtual void follow(const Subdivision& subdivision, double bracing) = 0;
  virtual void count_removed(double mass) = 0;

 protected:
  ~ChangingBody() = default;
};

}  // namespace dartboard
