#pragma once
// The event that releases vertices held still.

#include <cstdint>
#include <string>
#include <vector>

#include "core/mechanics/vertex_columns.h"
#include "core/scene/body/simulated_body.h"

namespace dartboard {

/// Vertices are known by the mesh point they came from, as driven ones are: all parts of one that came apart are
/// released.
class ReadyRelease final : public ReadyEvent {
 public:
  /// pre     the vertices are at rest, and outlive this
  /// throws  InputError "PATH: ..." if no selected vertex is fixed
  ReadyRelease(VertexColumns& vertices, const Release& release, const std::string& path);

  /// returns  the number of vertices released; their points are chosen at the start, and none is added to the targets
  /// cost     O(vertices log(points))
  std::size_t apply(EventTargets*) override;
  std::size_t repeat(const EventTargets&) override { return apply(nullptr); }
  std::size_t bytes() const override;

 private:
  VertexColumns& vertices_;
  std::vector<std::uint32_t> points_;  // of the mesh, ascending
};

}  // namespace dartboard
