#include "core/contact/box_around.h"

namespace dartboard {
namespace {

// comparisons, which leave out what is not a number, as minima need not
void widen(BoxAround& box, const Eigen::Vector3d& value) {
  for (int c = 0; c < 3; ++c) {
    box.low[c] = value[c] < box.low[c] ? value[c] : box.low[c];
    box.high[c] = value[c] > box.high[c] ? value[c] : box.high[c];
  }
}

}  // namespace

BoxAround box_around(std::span<const Eigen::Vector3d> x) {
  BoxAround box;
  for (const Eigen::Vector3d& place : x) widen(box, place);
  return box;
}

void add_ways(BoxAround& box, std::span<const Eigen::Vector3d> from, const StagePlaces& to, std::size_t first) {
  for (std::size_t k = 0; k < from.size(); ++k) {
    Eigen::Vector3d way = to.x[first + k] - from[k];
    if (!to.w.empty()) way += to.t * to.w[first + k];
    widen(box, way);
  }
}

}  // namespace dartboard
