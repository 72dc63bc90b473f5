#pragma once
// The least box along the axes around some places.

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace dartboard {

struct BoxAround {
  Eigen::Vector3d low, high;
};

/// pre   not empty
/// cost  some half of a nanosecond per place: four are compared at a time
inline BoxAround box_around(std::span<const Eigen::Vector3d> x) {
  using Four = Eigen::Array<double, 12, 1>;
  Four low = x[0].array().replicate<4, 1>(), high = low;
  std::size_t k = 0;
  for (; k + 4 <= x.size(); k += 4) {
    const Eigen::Map<const Four> next(x[k].data());
    low = low.min(next);
    high = high.max(next);
  }
  BoxAround box{low.segment<3>(0), high.segment<3>(0)};
  for (int j = 3; j < 12; j += 3) {
    box.low = box.low.cwiseMin(low.segment<3>(j).matrix());
    box.high = box.high.cwiseMax(high.segment<3>(j).matrix());
  }
  for (; k < x.size(); ++k) {
    box.low = box.low.cwiseMin(x[k]);
    box.high = box.high.cwiseMax(x[k]);
  }
  return box;
}

}  // namespace dartboard
