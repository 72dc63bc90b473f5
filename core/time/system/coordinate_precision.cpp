#include "core/time/system/coordinate_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace dartboard {

std::string to_string(const CoordinatePrecision& found) {
  return fmt::format(
      "coordinate {} = {:.6g} m of vertex {} is rounded by up to {:.2g} of the spring beside it ({:.4g} m); move the "
      "body to the origin",
      "xyz"[found.axis], found.coordinate, found.vertex, found.relative, found.length);
}

std::optional<CoordinatePrecision> find_coarse_coordinate(const SpringSystem& system,
                                                          std::span<const Eigen::Vector3d> x, double bound) {
  std::optional<CoordinatePrecision> found;
  for (std::uint32_t s = 0; s < system.springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    const double from_i = x[i].norm(), from_j = x[j].norm();
    const double length = std::max((x[j] - x[i]).norm(), system.springs[s].rest_length);
    const double relative = std::numeric_limits<double>::epsilon() * std::max(from_i, from_j) / length;
    if (!(length > 0.0 && relative > bound)) continue;
    bound = relative;
    const std::uint32_t far = from_i > from_j ? i : j;
    Eigen::Index axis = 0;
    x[far].cwiseAbs().maxCoeff(&axis);
    found = {s, far, static_cast<int>(axis), x[far][axis], length, relative};
  }
  return found;
}

}  // namespace dartboard
