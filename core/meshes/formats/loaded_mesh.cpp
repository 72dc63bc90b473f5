#include "core/meshes/formats/loaded_mesh.h"

#include <algorithm>

namespace dartboard {

std::size_t LoadedMesh::number_in_file(std::uint32_t point) const {
  if (const std::size_t kept = mesh.points.size() - copied.size(); point >= kept) point = copied[point - kept];
  if (place_of_point.empty()) return point;
  return static_cast<std::size_t>(std::ranges::find(place_of_point, point) - place_of_point.begin());
}

}  // namespace dartboard
