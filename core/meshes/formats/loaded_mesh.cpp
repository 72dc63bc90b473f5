#include "core/meshes/formats/loaded_mesh.h"

#include <algorithm>
#include <numeric>

namespace dartboard {

std::size_t LoadedMesh::number_in_file(std::uint32_t point) const {
  if (const std::size_t kept = mesh.points.size() - copied.size(); point >= kept) point = copied[point - kept];
  if (place_of_point.empty()) return point;
  return static_cast<std::size_t>(std::ranges::find(place_of_point, point) - place_of_point.begin());
}

std::vector<std::uint32_t> LoadedMesh::numbers_in_file() const {
  if (place_of_point.empty() && copied.empty()) return {};
  std::vector<std::uint32_t> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0u);
  for (auto k = static_cast<std::uint32_t>(place_of_point.size()); k-- > 0;)  // of several points the first
    if (place_of_point[k] != dropped) number[place_of_point[k]] = k;
  const std::size_t kept = number.size() - copied.size();
  for (std::size_t k = 0; k < copied.size(); ++k) number[kept + k] = number[copied[k]];
  return number;
}

}  // namespace dartboard
